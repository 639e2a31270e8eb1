"""One step of Radau IIA, compiled: the stages, the estimate and the factor are those of `numerics.radau`."""

import math

import numpy as np
import pytest

from codim2_core.initial_value.compiled_motion import numbers_of_tableau
from codim2_core.initial_value.field import field
from codim2_core.initial_value.kernels import radau
from codim2_core.initial_value.kernels.stages import tableau_of, workspace
from codim2_core.initial_value.problem import plane_problem
from codim2_core.numerics import radau as in_python
from codim2_core.numerics.radau import FAILED_SHRINKAGE, MAX_GROWTH, MAX_SHRINKAGE

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
        radau.linearise(self.motion, self.y, h, self.clock, self.work)
        self.here = in_python._linearise(self.problem, self.y)

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
            told.append((bool(accepted), change not in (FAILED_SHRINKAGE, MAX_GROWTH, MAX_SHRINKAGE)))
    assert {accepted for accepted, _ in told} == {False, True}
    assert any(between for _, between in told)
