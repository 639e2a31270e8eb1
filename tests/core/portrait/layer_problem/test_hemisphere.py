"""Charts and the disc flow against the charts' own equations."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from codim2_core import hemisphere
from tests.core.strategies import regularisations, systems

angle = st.floats(0, 2 * math.pi)


@given(st.floats(-8, 6), angle)
def test_charts_agree_where_they_overlap(exponent, theta):
    x2 = 10.0**exponent * np.array([math.cos(theta), math.sin(theta)])
    p = hemisphere.disc_from_scaling(x2)
    _, epsilon_1, t = hemisphere.entry_from_scaling(x2)
    if exponent > -1:  # kappa_1 is singular at its pole epsilon_1 = 1
        np.testing.assert_allclose(hemisphere.disc_from_entry(epsilon_1, t), p, rtol=0.0, atol=2e-14)
    if exponent < 3:
        np.testing.assert_allclose(hemisphere.scaling_from_disc(p), x2, rtol=1e-9)
        assert hemisphere.height(p) == pytest.approx(epsilon_1, rel=1e-9)


def test_kappa_2_has_no_equator():
    with pytest.raises(ValueError, match="infinity"):
        hemisphere.scaling_from_disc([1.0, 0.0])


@given(systems, regularisations, st.floats(0.01, 3.0), angle)
def test_flow_is_the_layer_problem_of_kappa_2(system, regularisation, zeta, theta):
    """p' by the chain rule from x2' = U(e_Psi(x2)) (fast time tau) with dT = ebar dtau."""
    at = system.at()
    x2 = zeta * np.array([math.cos(theta), math.sin(theta)])
    U = at.U(x2 / math.sqrt(zeta**2 + float(regularisation(zeta**2))))
    root = math.hypot(1.0, zeta)
    dp_dtau = U / root - x2 * (x2 @ U) / root**3
    expected = dp_dtau * root  # dT = ebar dtau = dtau / root
    np.testing.assert_allclose(
        hemisphere.flow(at, regularisation, x2 / root), expected, rtol=0.0, atol=1e-13 * (1 + max(map(abs, at.plane)))
    )


@given(systems, regularisations, angle)
def test_equator_is_invariant_and_carries_theta(system, regularisation, theta):
    at = system.at()
    p = np.array([math.cos(theta), math.sin(theta)])
    field = hemisphere.flow(at, regularisation, p)
    _, Theta = hemisphere.outside_flow(at, theta)
    size = 1e-14 * (1 + max(map(abs, at.plane)))
    assert p @ field == pytest.approx(0.0, abs=size)
    assert p[0] * field[1] - p[1] * field[0] == pytest.approx(float(Theta), abs=size)


@pytest.mark.parametrize("epsilon_1", [1.01, -0.01, [0.5, 1.2]])
def test_the_entry_chart_ends_at_the_top_and_at_the_equator(epsilon_1):
    with pytest.raises(ValueError, match="beyond 0 to 1"):
        hemisphere.disc_from_entry(epsilon_1, 0.3)
