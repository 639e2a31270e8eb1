"""Branches: outside, held against a curve that is known; how they are drawn to their ends, step by step."""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.portrait.orbits.result import Status
from codim2_core.results.words import say

PSI = c2.psi.constant()


def parabola(bend, tangential, speed, turn):
    """U = speed (c, 2 bend x c + tangential (s - bend x c)), turned: tangent to y = bend x^2, where s = bend x c."""
    k, m = math.cos(turn), math.sin(turn)
    c, s, x = f"(({k!r})*c + ({m!r})*s)", f"(({k!r})*s - ({m!r})*c)", f"(({k!r})*x + ({m!r})*y)"
    u, v = f"({speed!r})*{c}", f"({speed!r})*(2*({bend!r})*{x}*{c} + ({tangential!r})*({s} - ({bend!r})*{x}*{c}))"
    return c2.System(U=(f"({k!r})*({u}) - ({m!r})*({v})", f"({m!r})*({u}) + ({k!r})*({v})"))


@pytest.mark.parametrize("turn", [0.0, 0.7, 2.4])
@pytest.mark.parametrize(("bend", "tangential", "speed"), [(0.4, -1.5, 1.0), (-0.3, 0.5, -0.05), (0.5, 0.2, 30.0)])
def test_a_bent_branch_outside_is_the_invariant_curve(bend, tangential, speed, turn):
    system = parabola(bend, tangential, speed, turn)
    found = c2.separatrices(system, PSI, t_max=1.0 / abs(speed))  # drawn for longer, as it starts slowly
    outside = {one.departure_angle: one for one in found if not one.inside}
    axis = [t for t in outside if abs(math.sin(t - turn)) < 1e-9]
    assert len(axis) == 2  # the curve leaves Sigma along both senses of its tangent
    for angle in axis:
        one = outside[angle]
        assert one.direction == ("unstable" if speed > 0.0 else "stable")
        line = one.points if speed > 0.0 else one.points[::-1]
        np.testing.assert_allclose(line[0], (math.cos(angle), math.sin(angle)), rtol=0.0, atol=1e-15)
        radius = np.hypot(*line.T)
        rho, theta = radius - 1.0, np.arctan2(*line.T[::-1]) - turn
        x, y = rho * np.cos(theta), rho * np.sin(theta)
        np.testing.assert_allclose(y, bend * x * x, rtol=0.0, atol=2e-8)
        assert np.abs(line).max() == pytest.approx(2.0, abs=1e-9)
        assert (np.diff(radius) > 0.0).all()
        assert rho[1] < 2e-4
        assert (one.end, one.connection, one.gap) == ("outside", False, None)
        assert one.arrival_angle == pytest.approx(math.atan2(*line[-1][::-1]), abs=1e-12)
        limits = c2.equator_equilibria(system)
        i = int(np.argmin(np.abs(limits.theta - angle)))
        assert one.origin == f"Q{i + 1}"
        assert one.status == say("branch leaves" if speed > 0.0 else "branch arrives", Q=f"Q{i + 1}")


def test_a_bent_branch_that_stays_in_view_says_why():
    """Slow beyond all time: U leads away from Sigma ever slower, and the branch ends where its time does."""
    system = c2.System(U=("c*exp(-40*(x**2 + y**2))", "s*exp(-40*(x**2 + y**2))/2 + 0*x"))
    outside = [one for one in c2.separatrices(system, PSI, t_max=1.0) if not one.inside]
    assert outside
    for one in outside:
        assert one.status.endswith(Status.T_MAX.value)
        assert np.abs(one.points).max() < 2.0
