"""Motions for eps > 0 that take few steps."""

import math
from functools import partial

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from codim2_core import System, simulate
from codim2_core import psi as families
from codim2_core.motion.initial_value import motion_steps
from codim2_core.motion.initial_value.field import field
from codim2_core.motion.result import SimulationStatus

TANH = families.tanh()
TURNS = System(U=("-2*c + 1.5*c*s + 2.4*sin(z1) + 0.3*x", "-s + 0.9*cos(z1)"), W=("1 + c*y - 0.3*s",))


def _followed(system, psi, eps, first, span, rtol=1e-6, most=1000):
    first = np.atleast_2d(np.array(first, float))
    return simulate(system, psi, first, span, eps=eps, rtol=rtol, atol=0.01 * rtol, max_steps=most)


def test_a_slip_is_what_scipy_finds():
    first, span = [(0.8, -0.5, 0.3), (-0.4, 0.9, 1.0)], (0.5, 1.3)
    F = partial(motion_steps.rate_at, field(TURNS), TANH, 0.3, None)
    for start, one in zip(first, _followed(TURNS, TANH, 0.3, first, span), strict=True):
        exact = solve_ivp(lambda t, y: F(y), span, start, "DOP853", rtol=1e-11, atol=1e-12, dense_output=True)
        assert one.status is SimulationStatus.T_END
        assert one.motion.times[0] == 0.5
        assert one.motion.times[-1] == pytest.approx(1.3, abs=1e-15)
        np.testing.assert_array_equal(one.motion.states[0], start)
        np.testing.assert_allclose(one.motion.states[-1], exact.y[:, -1], atol=2e-6)
        at = np.linspace(0.5, 1.3, 17)
        np.testing.assert_allclose(one.dense(at), exact.sol(at).T, atol=2e-6)
        np.testing.assert_allclose(np.diff(one.motion.times), one.motion.lengths, atol=1e-15)
        steps = len(one.motion.lengths)
        assert 15 * steps <= one.evaluations <= 15 * steps + 2 + 11 * 3  # a few that were not taken
        assert steps <= 16


def test_after_a_slide_it_goes_on_explicitly():
    """It leaves along (1, 0) after z = 0.5, and is then a slip for long."""
    leaves = System(U=("2*z1 - c", "-s"), W=("1",))
    (one,) = _followed(leaves, TANH, 1e-4, (0.01, 0.02, -0.3), (0.0, 30.0))
    assert one.status is SimulationStatus.T_END
    assert len(one.motion.lengths) < 90
    # x' = 2 z - 1 from z = 0.5 on
    assert one.motion.states[-1, 0] == pytest.approx(29.2**2, rel=1e-3)
    late = one.motion.times[:-1] > 2.0
    assert late.any()
    assert one.motion.polynomials[np.flatnonzero(late)[-1]][0, 1] != 0.0
    assert late.sum() <= 12


def test_motions_end_as_they_have_to():
    grows = System(U=("x**2 - c", "-s"))
    (one,) = _followed(grows, families.constant(), 1e-2, (2.0, 0.0), (0.0, 20.0))
    assert one.status is SimulationStatus.BLOW_UP
    assert one.times[-1] == pytest.approx(0.5 * math.log(3.0), rel=1e-3)
    (one,) = _followed(TURNS, TANH, 0.3, (0.8, -0.5, 0.3), (0.0, 9.0), most=4)
    assert one.status is SimulationStatus.STEP_LIMIT
    assert len(one.motion.lengths) <= 4
    assert 0.0 < one.times[-1] < 9.0
    ends = System(U=("-c", "-s"), W=("-1/(2*z)",))  # z = sqrt(1 - t)
    (one,) = _followed(ends, TANH, 0.5, (1.0, 0.4, 1.0), (0.0, 3.0), most=150)
    assert one.status is SimulationStatus.STEP_LIMIT
    assert one.times[-1] == pytest.approx(1.0, abs=1e-5)
