"""One step of Radau IIA, compiled: the stages, the estimate and the factor are those of `numerics.radau`."""

from __future__ import annotations

import math

import numpy as np
import pytest

from codim2_core import System
from codim2_core.initial_value.compiled import numbers_of_tableau
from codim2_core.initial_value.field import field
from codim2_core.initial_value.kernels import explicit, radau
from codim2_core.initial_value.kernels.stages import tableau_of, workspace
from codim2_core.initial_value.problem import CONTACT, plane_problem
from codim2_core.numerics import radau as in_python
from codim2_core.numerics.radau import FAILED, GROW, SHRINK, Step, tableau

from .placing import CURVED, TANH, motion_of

TABLE = tableau_of(numbers_of_tableau())
STATES = [(0.4, 0.3, 0.7, -0.2), (-0.02, 0.01, 1.3, 0.5)]


class Begun:
    """A step about to be tried, compiled and in Python."""

    def __init__(self, y, eps, rtol, h, system=CURVED):
        self.y, self.rtol, self.h, n = np.array(y, float), rtol, h, len(y)
        self.motion = motion_of(system, TANH, eps, rtol)
        self.problem = plane_problem(field(system), TANH, eps, rtol, 0.01 * rtol)
        self.work, self.clock = workspace(n, 0.0), np.zeros(4)
        radau.linearised(self.motion, self.y, h, self.clock, self.work)
        self.here = in_python._linearised(self.problem, self.y)

    def tried(self, refine=False, previous=None):
        """Whether it is accepted, and the factor; the same in Python, and its stages."""
        before_h = 0.0
        if previous is not None:
            self.work.before[:], self.work.first[:], before_h = previous.polynomial, previous.first, previous.h
        own = radau.attempt(self.motion, TABLE, self.y, self.h, before_h, refine, self.clock, self.work)
        found, factor = in_python._attempt(self.problem, self.here, self.y, self.h, previous, self.rtol, refine)
        return own, factor, None if found is None else found[0]


@pytest.mark.parametrize("y", STATES)
@pytest.mark.parametrize(("eps", "refine"), [(0.3, False), (1e-3, True)])
def test_it_takes_the_steps_that_are_taken_in_python(y, eps, refine):
    told = []
    for rtol in (1e-3, 1e-6):
        for h in math.hypot(y[0], y[1], eps) * np.array([0.03, 0.3, 1.0, 4.0, 30.0]):
            step = Begun(y, eps, rtol, h)
            (accepted, change), factor, Z = step.tried(refine)
            assert bool(accepted) is (Z is not None)
            assert change == pytest.approx(factor, rel=2e-2)
            if Z is not None:
                np.testing.assert_allclose(step.work.Z / step.work.size, Z / step.here.size, atol=3e-2 * rtol)
            told.append((bool(accepted), change not in (FAILED, GROW, SHRINK)))
    assert {accepted for accepted, _ in told} == {False, True}
    assert any(between for _, between in told)


@pytest.mark.parametrize("part", [1.0, 3.0, 5.0])
def test_it_begins_where_the_last_step_leads(part):
    """The fewer iterations the better that leads; past four times the last step it is not asked."""
    eps, h = 0.3, 0.02
    first = Begun(STATES[0], eps, 1e-8, h)
    _, _, Z = first.tried()
    previous = Step(0.0, h, first.y, first.y + Z[-1], (tableau().fit @ Z).T)
    asked = []
    for one in (previous, None):
        step = Begun(previous.last, eps, 1e-8, part * h)
        (accepted, change), factor, Z = step.tried(previous=one)
        assert bool(accepted) is (Z is not None)
        assert change == pytest.approx(factor, rel=2e-2)
        asked.append(step.clock[3])
        assert (step.clock[3] - 1.0) % 5.0 == 0.0  # of all stages, after that of the Jacobian
    assert bool(asked[0] < asked[1]) is (part < 4.0)


def test_a_step_that_a_guess_misleads_is_tried_again_as_long():
    """Without one it is made shorter."""
    step = Begun(STATES[0], 1e-3, 1e-8, 3.0)
    wild = Step(0.0, 1.0, step.y, step.y, np.full((4, 5), 1e3))
    (accepted, change), factor, _ = step.tried(previous=wild)
    assert (bool(accepted), change, factor) == (False, 1.0, 1.0)
    (accepted, change), factor, _ = step.tried()
    assert (bool(accepted), change, factor) == (False, FAILED, FAILED)


def test_the_estimate_of_its_error_is_of_order_six():
    """Half a step, 2^-6 of the error: the factor doubles."""
    changes = []
    for h in (0.2, 0.1, 0.05):
        step = Begun(STATES[0], 1.0, 1e-9, h)
        (_, change), *_ = step.tried()
        changes.append(change)
    assert all(SHRINK < change < GROW for change in changes)
    assert changes[1] / changes[0] == pytest.approx(2.0, rel=0.15)
    assert changes[2] / changes[1] == pytest.approx(2.0, rel=0.08)


def test_a_stiff_error_is_filtered_once_more_for_one_evaluation():
    """At the start of a slide: by so much longer is the step."""
    system = System(U=("-(c - 0.4*cos(z1))", "-2*s + 0.3*sin(z1)"), W=("1",))
    y, found = (0.3e-4, -0.2e-4, 0.5), []
    for refine in (False, True):
        step = Begun(y, 1e-4, 1e-5, 2e-3, system)
        (accepted, change), factor, _ = step.tried(refine)
        assert change == pytest.approx(factor, rel=3e-2)
        found.append((bool(accepted), change, step.clock[3]))
    (_, plain, asked), (_, refined, again) = found
    assert refined > plain
    assert again == asked + 1.0


def test_a_step_that_is_not_finite_is_refused():
    """U has a pole at z1 = 1, where a stage falls."""
    system = System(U=("-c", "-s"), W=("1/(1 - z1)",))
    step = Begun((0.4, 0.3, 1.0 - 1e-9), 0.3, 1e-6, 0.5, system)
    (accepted, change), *_ = step.tried()
    assert not accepted
    assert change == FAILED


def test_one_time_of_growth_bounds_a_step():
    """z' = 4 z is slower than the step that is wanted; z' = -4 z is no bound, z1' = z2, z2' = -16 z1 turns."""
    for W, bound, reach in (
        (("4*z1", "-z2"), 0.25, 4.0),
        (("-4*z1", "-z2"), 1e12, 4.0),
        (("4*z2", "-4*z1"), 1e12, 4.0),
        (("z1 + 2*z2", "2*z1 + z2"), 1.0 / 3.0, 3.0),
    ):
        motion, work = motion_of(System(U=("0*c", "0*s"), W=W), TANH, 1e-2), workspace(4, 0.0)
        y = np.array([0.5, 0.2, 1.0, 1.0])
        longest, found = radau.linearised(motion, y, 10.0, np.zeros(4), work)
        assert found == pytest.approx(reach, rel=1e-9)
        assert min(longest, 1e12) == pytest.approx(bound, rel=1e-9)  # but for the rounding of an eigenvalue
        if bound < 1e12:
            assert radau.linearised(motion, y, 1.1 * bound, np.zeros(4), work)[0] == pytest.approx(bound, rel=1e-9)
        # A step that is short enough is not asked for its bound.
        assert radau.linearised(motion, y, 0.1, np.zeros(4), work) == pytest.approx((math.inf, reach), rel=1e-9)


@pytest.mark.parametrize("angle", [0.0, 0.5, math.pi / 2, 2.2, math.pi, -math.pi / 2])
def test_a_step_goes_nine_tenths_of_the_way_to_sigma_at_most(angle):
    """With U = -1.5 e that takes 0.6 of the distance; in contact with Sigma there is no way left to jump over."""
    eps, n = 1e-3, np.array([math.cos(angle), math.sin(angle)])
    motion, work = motion_of(System(U=("-1.5*c", "-1.5*s"), W=("1",)), TANH, eps), workspace(3, 0.0)
    for away in (0.3, 2.0 * CONTACT * eps):
        longest, _ = radau.linearised(motion, np.array([*(away * n), 0.0]), 0.1, np.zeros(4), work)
        assert longest == pytest.approx(0.6 * away, rel=2e-3)
    assert math.isinf(radau.linearised(motion, np.array([*(0.9 * CONTACT * eps * n), 0.0]), 0.0, np.zeros(4), work)[0])


def test_a_step_that_is_kept_goes_through_its_stages():
    step = Begun(STATES[0], 0.3, 1e-6, 0.02)
    (accepted, _), *_ = step.tried()
    assert accepted
    first, polynomial, end = step.y.copy(), np.full((4, explicit.DEGREE), math.nan), np.empty(4)
    radau.keep(TABLE, step.y, step.work, polynomial, end)
    powers = tableau().nodes[:, None] ** np.arange(1, explicit.DEGREE + 1)
    np.testing.assert_allclose(powers @ polynomial.T, step.work.Z, atol=1e-14)
    np.testing.assert_array_equal(step.work.before, polynomial[:, :5])
    np.testing.assert_array_equal(step.work.first, first)
    np.testing.assert_array_equal(end, first + step.work.Z[-1])
    np.testing.assert_array_equal(step.y, end)
