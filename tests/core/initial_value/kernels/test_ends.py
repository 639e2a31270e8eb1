"""Along which steps a slide goes on, and where it ends at the equator."""

import numpy as np
import pytest

from codim2_core import System
from codim2_core.initial_value.kernels import ends

from .placing import placed


@pytest.mark.parametrize(
    ("U", "c", "low", "high", "n"),
    [
        (("z1 - c**2", "-s"), 0.5, 0.25, -0.1, (0.0, 0.0)),  # a fold, det = 2 c
        (("z1 - c**2", "-s"), 0.5, 0.25, -0.1, (1.0, 0.0)),  # the same in a line
        (("-c*z1 - 3*s", "3*c - s*z1"), 0.0, 0.3, -0.1, (0.0, 0.0)),  # a focus whose trace turns positive
        (("-(c - 0.3)*z1", "-s*z1**2"), 0.3, 0.3, -0.1, (0.0, 0.0)),  # along C alone: the trace stays negative first
        (("-(c - 0.3)", "-s*z1"), 0.3, 0.3, -0.1, (0.0, 0.0)),  # across C alone
        (("-(c - 0.3) - 3*s", "3*(c - 0.3) - 0.4*s*z1"), 0.3, 0.3, -0.1, (0.0, 0.0)),  # the same of a focus
        (("-0.4*(c - 0.3)*z1 - 3*s", "3*(c - 0.3) - s"), 0.3, 0.3, -0.1, (0.0, 0.0)),  # along C, of a focus
        (("-(c - 0.3) + (0.6 - z1)*s", "2*(c - 0.3) - s"), 0.3, 0.3, -0.1, (0.0, 0.0)),  # a saddle, where D12 D21 = 1
        (("-0.6*z1*(0.6*(c - 0.3) + 0.8*s) + 0.8*(0.6*s - 0.8*(c - 0.3))",  # along an oblique line
          "-0.8*z1*(0.6*(c - 0.3) + 0.8*s) - 0.6*(0.6*s - 0.8*(c - 0.3))"), 0.3, 0.3, -0.1, (0.6, 0.8)),
    ],
)  # fmt: skip
def test_a_step_along_which_a_set_may_end_otherwise_is_not_sure(U, c, low, high, n):
    system = System(U=U, W=("1",))
    S, values, polynomial = placed(system, (0.0,)), np.empty((ends.GAUGES, 5)), np.zeros((3, 7))
    for end, what in ((0.8 * low, ends.SAFE), (high, ends.UNSURE_END)):
        polynomial[2, 0] = end - low
        assert ends.step_end(S, np.array([c, 0.0, low]), polynomial, 1.0, *n, values)[0] == what
    if n == (0.0, 0.0):
        polynomial[2, 0] = -0.2 * low
        assert ends.step_end(S, np.array([c, 0.0, low]), polynomial, -1.0, *n, values)[0] == ends.UNSURE_END
