"""The first, short step away from Sigma."""

from __future__ import annotations

import math

import numpy as np
import pytest

from codim2_core import System
from codim2_core.initial_value import leaving
from codim2_core.initial_value.field import field
from codim2_core.initial_value.kernels.leave import _polished, leave
from codim2_core.initial_value.leaving import START, TILT
from codim2_core.initial_value.line import InvariantLine

from .placing import CURVED, directions, placed


@pytest.mark.parametrize("ahead", [2.0, 1e6])  # so long that how fast it turns bounds the step
def test_the_first_step_away_is_that_in_python(ahead):
    told = set()
    for z in ((1.2, 0.4), (-1.0, 0.3), (2.5, -1.0)):
        for theta in directions(CURVED, z):
            S, linear, square = placed(CURVED, z), np.full(4, math.nan), np.full(4, math.nan)
            own = leaving.leave(field(CURVED), theta + 1e-3, 0.0, np.array(z), ahead)
            h = leave(S, 2, 0.0, 0.0, theta + 1e-3, ahead, linear, square)
            told.add(isinstance(own, str))
            if isinstance(own, str):
                assert h == 0.0
                continue
            assert h == pytest.approx(own.h, rel=1e-9)
            np.testing.assert_allclose(linear, own.polynomial[:, 0], rtol=1e-8, atol=1e-24)
            np.testing.assert_allclose(square, own.polynomial[:, 1], rtol=1e-8, atol=1e-24)
    assert told == {False, True}


REACHED = System(  # e = (0.6, 0.8) is critical at z1 = 0, and moves out of the disc with z1
    U=("-(c - 0.6) + 0.5*(s - 0.8) + 1.3*z1", "-0.2*(c - 0.6) - 1.4*(s - 0.8) + 0.4*z1 + 0.1*z2"),
    W=("1.0 + 0.3*c", "0.7*s - 0.2*z1*c"),
)


@pytest.mark.parametrize("line", [False, True])
def test_the_first_step_away_from_where_a_set_reaches_the_equator_is_that_in_python(line):
    system, z, n = REACHED, np.zeros(2), (0.6, 0.8)
    if line:  # U along n only
        system = System(U=("0.6*(z1 - (0.6*c + 0.8*s) + 1)", "0.8*(z1 - (0.6*c + 0.8*s) + 1)"), W=("1.5 + 0.2*c", "-s"))
    S, linear, square = placed(system, z), np.full(4, math.nan), np.full(4, math.nan)
    own = leaving.leave(
        field(system), math.atan2(0.8, 0.6), 0.0, z, 3.0, InvariantLine(field(system), np.array(n)) if line else None
    )
    h = leave(S, 2, *(n if line else (0.0, 0.0)), math.atan2(0.8, 0.6), 3.0, linear, square)
    assert h == pytest.approx(own.h, rel=1e-6)
    assert square[:2].all()
    np.testing.assert_allclose(linear, own.polynomial[:, 0], rtol=1e-6, atol=1e-20)
    np.testing.assert_allclose(square, own.polynomial[:, 1], rtol=1e-5, atol=1e-20)
    other = leave(S, 2, *(n if line else (0.0, 0.0)), math.atan2(-0.8, -0.6), 3.0, linear, square)
    assert (other > 0.0) is not isinstance(
        leaving.leave(
            field(system), math.atan2(-0.8, -0.6), 0.0, z, 3.0,
            InvariantLine(field(system), np.array(n)) if line else None,
        ),
        str,
    )  # fmt: skip


def test_an_angle_nearby_is_made_that_of_the_direction():
    """Newton's method: to all digits from 0.03 away; what needs a longer step is none."""
    for z in ((1.2, 0.4), (-1.0, 0.3), (2.5, -1.0)):
        S = placed(CURVED, z)
        for theta in directions(CURVED, z):
            for away in (0.03, -0.03):
                assert _polished(S, 2, theta + away) == pytest.approx(theta, abs=1e-13)
            assert math.isnan(_polished(S, 2, theta + 0.2))


@pytest.mark.parametrize("line", [(0.0, 0.0), (0.8, 0.6), (-0.8, -0.6)])
def test_a_straight_way_out_is_as_long_as_a_part_of_the_time(line):
    """U = (0.4, 0.3), W = (2, -1): nothing turns."""
    S, linear, square = placed(System(U=("0.4", "0.3"), W=("2", "-1")), (1.0, 2.0)), np.empty(4), np.empty(4)
    h = leave(S, 2, *line, math.atan2(0.6, 0.8), 1e6, linear, square)
    assert h == pytest.approx(START * 1e6, rel=1e-12)
    np.testing.assert_allclose(linear, h * np.array([0.4, 0.3, 2.0, -1.0]), rtol=1e-12)
    np.testing.assert_array_equal(square, 0.0)
    assert leave(S, 2, *line, math.atan2(-0.6, -0.8), 1e6, linear, square) == 0.0  # there it leads inward


def test_along_a_direction_that_repels_on_the_equator_nothing_leaves_by_itself():
    """lambda_rho = 2 and lambda_theta = 3 at (1, 0); in a line it is the way out all the same."""
    S = placed(System(U=("2*c", "5*s"), W=("1",)), (0.0,))
    assert leave(S, 1, 0.0, 0.0, 0.0, 1.0, np.empty(3), np.empty(3)) == 0.0
    assert leave(S, 1, 1.0, 0.0, 0.0, 1.0, np.empty(3), np.empty(3)) == START


@pytest.mark.parametrize("faster", [0.0, 0.7])
def test_a_way_out_turns_as_the_field_outside_and_z_make_it(faster):
    """lambda_rho = 1 and lambda_theta = -3 at n = (0.6, 0.8): theta' = t.(D_x U n + D_z U W)/4 along the way.

    It is short against the time in which lambda_rho, which changes at n.(D_x U n + D_z U W), becomes another.
    """
    M, N, W = np.array([[0.7, -1.1], [0.4, 1.3]]), np.array([[0.5, -0.8], [-0.3, 0.9]]), np.array([2.0, -1.5])
    outward = np.array([0.6, 0.8])
    N += np.outer(outward, W) * (faster - outward @ (M @ outward + N @ W)) / (W @ W)
    U = [
        f"{n} + {-2.0 * t}*(-0.8*c + 0.6*s) + {M[i, 0]}*x + {M[i, 1]}*y + {N[i, 0]}*z1 + {N[i, 1]}*z2"
        for i, (n, t) in enumerate(((0.6, -0.8), (0.8, 0.6)))
    ]
    S, linear, square = placed(System(U=U, W=("2", "-1.5")), (0.0, 0.0)), np.empty(4), np.empty(4)
    theta, n, t = math.atan2(0.8, 0.6), np.array([0.6, 0.8]), np.array([-0.8, 0.6])
    turning = t @ (M @ n + N @ W) / 4.0
    h = leave(S, 2, 0.0, 0.0, theta, 1e9, linear, square)
    expected = START / faster if faster else TILT / abs(turning)
    assert h == pytest.approx(expected, rel=1e-9)
    np.testing.assert_allclose(linear[:2] / h, n + t * turning * h, atol=1e-10)
    np.testing.assert_allclose(linear[2:], W * h, rtol=1e-12)
    np.testing.assert_array_equal(square, 0.0)
