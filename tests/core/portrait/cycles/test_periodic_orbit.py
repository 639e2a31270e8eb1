"""A closed orbit in closed form: under Psi = 1 the circle |e|^2 = h of ``U = +-e (h - |e|^2) + turn e_perp``.

With e = p and dT = ebar dtau: r' = r (h - r^2) in p at the rate ebar, so the period is 2 pi/|turn| in T and that over
sqrt(1 - h) in tau; the exponent is that of d zeta'/d zeta = -2 h (1 - h)^(3/2), zeta = |x2|, over the period in tau.
"""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.portrait.cycles.periodic_orbit import orbit
from codim2_core.portrait.cycles.ray_section import FixedPoint, TurnSection
from codim2_core.portrait.layer_problem.problem import LayerProblem

H = 0.36


def circle(sign, turn):
    factor = f"({sign})*({H!r} - c**2 - s**2)"
    at = c2.System(U=(f"c*{factor} - ({turn!r})*s", f"s*{factor} + ({turn!r})*c")).at()
    problem = LayerProblem(at, c2.psi.constant())
    section = TurnSection(problem, problem.critical[0])
    r = math.sqrt(H)
    return section, math.log(r / (1.0 - r))


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("turn", [1.3, -0.8])
def test_a_circle_has_the_period_and_the_multiplier_that_it_must(sign, turn):
    section, xi = circle(sign, turn)
    found = orbit(section, FixedPoint(xi, repelling=sign < 0))
    assert found is not None
    tau = 2.0 * math.pi / abs(turn) / math.sqrt(1.0 - H)
    exponent = -2.0 * sign * H * (1.0 - H) * 2.0 * math.pi / abs(turn)
    assert found.period == pytest.approx(tau, rel=1e-11)
    assert found.period_T == pytest.approx(2.0 * math.pi / abs(turn), rel=1e-11)
    assert math.log(found.multiplier) == pytest.approx(exponent, rel=1e-9)
    assert found.divergence == pytest.approx(exponent, rel=1e-9)
    assert found.closure < 1e-12
    np.testing.assert_allclose(found.mean_e, 0.0, atol=1e-11)
    np.testing.assert_allclose(np.hypot(*found.points.T), math.sqrt(H), rtol=1e-11)
    np.testing.assert_allclose(np.hypot(*found.e.T), math.sqrt(H), rtol=1e-11)
    assert found.share.sum() == pytest.approx(1.0, rel=1e-13)
    assert (found.share > 0.0).all()
    np.testing.assert_array_equal(found.points[0], found.points[-1])
    steps = np.diff(np.unwrap(np.arctan2(*found.points.T[::-1])))
    assert (np.sign(steps) == np.sign(turn)).all()  # in order of time, whichever way it was followed
    assert abs(steps.sum()) == pytest.approx(2.0 * math.pi, rel=1e-12)
    for array in (found.points, found.mean_e, found.e, found.share):
        assert not array.flags.writeable
