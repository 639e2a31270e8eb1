"""Trajectories from limit directions: along the invariant manifold, to the critical set."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from codim2_core import hemisphere, psi
from codim2_core.orbits.trajectories import Status, continuation

from .seeds import CASE_I, only


@pytest.mark.parametrize("p", [psi.constant(), psi.rational(), psi.custom("2/(2+sqrt(1+s))")], ids=str)
def test_continuation_starts_on_the_invariant_manifold(p):
    from codim2_core.layer_problem.equator import equator_equilibria
    from codim2_core.orbits.departures import departures

    equator = equator_equilibria(CASE_I)
    theta = equator.theta[(equator.lambda_rho < 0.0) & (equator.lambda_theta < 0.0)]
    assert len(theta)
    coefficients = CASE_I.at(())
    high = departures(coefficients, p, theta, 1e-6, False)
    low = departures(coefficients, p, theta, 1e-12, False)
    assert high[0, 2] > 1.7 * low[0, 2]
    for above, below in zip(high, low, strict=True):

        def event(t, q, level=math.sqrt(1.0 - above[2] ** 2)):  # noqa: B008
            return np.hypot(*q) - level

        curve = solve_ivp(
            lambda t, q: hemisphere.flow(coefficients, p, q),
            (0, 20),
            below[:2],
            rtol=1e-12,
            atol=1e-14,
            events=event,
        )
        assert event(0, below[:2]) > 0.0
        reached = curve.y_events[0][0]
        angle = math.atan2(reached[1], reached[0]) - math.atan2(above[1], above[0])
        assert abs(angle) < 1e-9


def test_continuation_ends_on_the_critical_set():
    from codim2_core.layer_problem.equator import equator_equilibria

    equator = equator_equilibria(CASE_I)
    theta = equator.theta[equator.lambda_rho < 0.0]
    result = continuation(CASE_I, psi.rational(), theta, t_max=60.0)
    assert len(result) == len(theta)
    assert only(result) is Status.EQUILIBRIUM
    first = np.array([line[0] for line in result.points])
    assert np.abs(first - np.stack([np.cos(theta), np.sin(theta)], axis=-1)).max() < 1e-5
    with pytest.raises(ValueError, match="no limit direction"):
        continuation(CASE_I, psi.constant(), [theta[0] + 0.1])
    with pytest.raises(ValueError, match="lambda_rho"):
        continuation(CASE_I, psi.constant(), theta, backward=True)
    with pytest.raises(ValueError, match="finite"):
        continuation(CASE_I, psi.constant(), [math.nan])
