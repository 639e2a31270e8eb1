"""The first, short step away from Sigma."""

from __future__ import annotations

import math

import numpy as np
import pytest

from codim2_core import System
from codim2_core.initial_value import leaving
from codim2_core.initial_value.field import field
from codim2_core.initial_value.kernels.leave import leave
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
