"""One explicit step: its error, what it asks of the next one, and when it is stiff."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from codim2_core import System
from codim2_core.initial_value.field import field
from codim2_core.initial_value.kernels import explicit, rate
from codim2_core.initial_value.kernels.stages import workspace
from codim2_core.initial_value.problem import plane_problem
from codim2_core.numerics.radau import GROW, SAFETY, SHRINK

from .placing import CURVED, TANH, motion_of

START = np.array([0.4, 0.3, 0.7, -0.2])


def _tried(system, y, h, eps=0.3, rtol=1e-6, floor=0.01):
    motion, work, clock = motion_of(system, TANH, eps, rtol, floor), workspace(len(y), 0.0), np.zeros(4)
    explicit.begin(motion, y, work)
    rate.sizes(motion, y, work.size)
    return explicit.attempt(motion, h, clock, work), motion, work, clock


def test_the_estimate_of_its_error_is_of_order_eight():
    """Half a step, 2^-8 of the error: the factor doubles."""
    changes = [_tried(CURVED, START, h, rtol=1e-10)[0][1] for h in (0.12, 0.06, 0.03)]
    assert all(SHRINK < change < GROW for change in changes)
    assert changes[1] / changes[0] == pytest.approx(2.0, rel=0.1)
    assert changes[2] / changes[1] == pytest.approx(2.0, rel=0.05)


def test_its_error_is_less_than_is_allowed_and_not_ten_thousand_times_less():
    """Where its factor is SAFETY the estimate is a tenth of rtol, in units of the smaller size."""
    F = plane_problem(field(CURVED), TANH, 0.3, 1e-6, 1e-8).F
    low, high = 0.01, 1.0
    for _ in range(30):
        h = math.sqrt(low * high)
        low, high = (h, high) if _tried(CURVED, START, h)[0][1] > SAFETY else (low, h)
    (accepted, change), _, work, _ = _tried(CURVED, START, low)
    assert accepted
    assert change == pytest.approx(SAFETY, rel=1e-3)
    exact = solve_ivp(lambda t, y: F(y), (0.0, low), START, "DOP853", rtol=1e-13, atol=1e-14).y[:, -1]
    error = np.abs(work.S[explicit.NEW : explicit.NEW + 4] - exact) / np.minimum(work.size, work.end_size)
    assert 1e-11 < error.max() < 1e-7
    five, three = (
        float((((work.S[k : k + 4]) / np.minimum(work.size, work.end_size)) ** 2).sum())
        for k in (explicit.ERROR_5, explicit.ERROR_3)
    )
    assert five / math.sqrt(five + 0.01 * three) == pytest.approx(1e-7, rel=1e-2)


def test_it_is_measured_at_both_ends():
    """z falls from 1 to 0.01: in units of what is left the same error is a hundred times as large."""
    falls = System(U=("0*c", "0*c"), W=("-z1 + 0.2*sin(9*z2)", "1"))
    changes = {}
    for z in (1.0, 1e-3):
        (_, changes[z]), _, work, clock = _tried(falls, np.array([1.0, 0.5, z, 0.0]), 0.3, floor=1e-4)
        end = work.S[explicit.NEW : explicit.NEW + 4]
        np.testing.assert_allclose(work.end_size[2:4], np.abs(end[2:]) + 1e-4, rtol=1e-14)
        np.testing.assert_allclose(work.end_size[:2], math.hypot(1.0, 0.5, 0.3), rtol=1e-14)
        assert clock[3] in (11.0, 12.0)
    assert changes[1e-3] < 0.8 * changes[1.0]


def test_a_step_that_leads_nowhere_is_made_shorter():
    """W is too large for a number: by as much as is allowed."""
    pole = System(U=("0*c", "0*c"), W=("(1e200*z1)**2",))
    (accepted, change), *_ = _tried(pole, np.array([1.0, 0.5, 1.0]), 1e-3)
    assert (bool(accepted), change) == (False, SHRINK)


@pytest.mark.parametrize(("part", "is_stiff"), [(0.2, False), (0.75, False), (0.85, True), (3.0, True)])
@pytest.mark.parametrize("across", [False, True])
def test_a_step_is_stiff_by_the_size_of_the_slope_of_u(part, is_stiff, across):
    """From h times it 0.8 on, though the state rests and nothing is to be told from its stages."""
    U = ("-3*x + 2*y", "0*c") if not across else ("0*c", "1*x - 4*y")
    motion, work = motion_of(System(U=U), TANH, 1.0), workspace(2, 0.0)
    y = np.zeros(2)
    explicit.begin(motion, y, work)
    rate.sizes(motion, y, work.size)
    explicit.attempt(motion, part / 5.0, np.zeros(4), work)
    assert bool(explicit.stiff(motion, part / 5.0, work)) is is_stiff


@pytest.mark.parametrize(("part", "is_stiff"), [(0.3, False), (0.5, True)])
def test_a_step_is_stiff_by_the_rate_of_its_last_stages(part, is_stiff):
    """Of z, which the slope of U knows nothing of; in whatever unit."""
    for k, size in ((2.0, 1.0), (2e4, 1e-3)):
        motion = motion_of(System(U=("0*c", "0*c"), W=(f"-{k}*(z1 - {size})",)), TANH, 1.0, floor=1e-3 * size)
        work, y = workspace(3, 0.0), np.array([1.0, 0.5, 2.0 * size])
        explicit.begin(motion, y, work)
        rate.sizes(motion, y, work.size)
        explicit.attempt(motion, part / k, np.zeros(4), work)
        assert bool(explicit.stiff(motion, part / k, work)) is is_stiff
