"""Along which steps a slide goes on, and where it ends at the equator."""

from __future__ import annotations

import math

import numpy as np
import pytest

from codim2_core import System
from codim2_core.initial_value.kernels import ends, slow

from .placing import MOVES, placed

EDGE = math.sqrt(1.0 - 0.09)


@pytest.mark.parametrize("seed", range(6))
def test_a_step_of_a_slide_ends_where_its_set_leaves_the_disc(seed):
    """C = (z1, 0.3), and z1 any cubic of the part of the step."""
    S, rng = placed(MOVES, (0.0, 0.0)), np.random.default_rng(seed)
    values, unsure = np.empty((ends.GAUGES, 5)), 0
    for _ in range(6):
        start, coefficients = rng.uniform(-0.9, 0.9), rng.normal(size=3) * 0.6
        polynomial = np.zeros((4, 7))
        polynomial[2, :3] = polynomial[0, :3] = coefficients
        what, u = ends.step_end(S, np.array([start, 0.3, start, 0.1]), polynomial, 1.0, 0.0, 0.0, values)
        net = np.linspace(0.0, 1.0, 2001)
        along = start + coefficients @ net ** np.arange(1, 4)[:, None]
        out = np.abs(along) >= EDGE
        unsure += what == ends.UNSURE
        if what == ends.SAFE:
            assert not out.any()
            assert u == 1.0
            assert S[slow.PLACE] == pytest.approx(along[-1], abs=1e-9)
        elif what == ends.EQUATOR:
            first = net[out.argmax()]
            assert first - 6e-4 < u <= first + 1e-12
            assert abs(S[slow.PLACE]) == pytest.approx(EDGE, abs=1e-9)
            assert abs(start + coefficients @ u ** np.arange(1, 4)) == pytest.approx(EDGE, abs=1e-12)
            np.testing.assert_allclose(S[slow.PLACE + 1 : slow.PLACE + 4], [0.3, 0.0, 0.0], atol=1e-12)
    assert unsure <= 1


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
        (  # along an oblique line
            (
                "-0.6*z1*(0.6*(c - 0.3) + 0.8*s) + 0.8*(0.6*s - 0.8*(c - 0.3))",
                "-0.8*z1*(0.6*(c - 0.3) + 0.8*s) - 0.6*(0.6*s - 0.8*(c - 0.3))",
            ),
            0.3,
            0.3,
            -0.1,
            (0.6, 0.8),
        ),
    ],
)
def test_a_step_along_which_a_set_may_end_otherwise_is_not_sure(U, c, low, high, n):
    system = System(U=U, W=("1",))
    S, values, polynomial = placed(system, (0.0,)), np.empty((ends.GAUGES, 5)), np.zeros((3, 7))
    for end, what in ((0.8 * low, ends.SAFE), (high, ends.UNSURE)):
        polynomial[2, 0] = end - low
        assert ends.step_end(S, np.array([c, 0.0, low]), polynomial, 1.0, *n, values)[0] == what
    if n == (0.0, 0.0):
        polynomial[2, 0] = -0.2 * low
        assert ends.step_end(S, np.array([c, 0.0, low]), polynomial, -1.0, *n, values)[0] == ends.UNSURE
