"""Charts and flows at many points at once, and by their values."""

import numpy as np
import pytest

from codim2_core import ELinear, hemisphere, psi


def test_outside_flow_is_lambda_rho_and_theta():
    at = ELinear(1.5, 0.7, -2.0, (0.3, -0.4)).at()
    t = np.linspace(0.0, 6.0, 7)
    c, s = np.cos(t), np.sin(t)
    rho, theta = hemisphere.outside_flow(at, t)
    np.testing.assert_allclose(rho, 1.5 * c**2 - 2.0 * s**2 + 0.3 * c - 0.4 * s, rtol=0.0, atol=1e-15)
    np.testing.assert_allclose(theta, -3.5 * s * c - 0.4 * c - 0.3 * s + 0.7, rtol=0.0, atol=1e-15)


def test_entry_chart_has_rho():
    x2 = np.array([[3.0, 4.0], [0.0, -1.0]])
    rho, epsilon_1, theta = hemisphere.entry_from_scaling(x2, 0.5)
    np.testing.assert_allclose(epsilon_1, 1.0 / np.sqrt([26.0, 2.0]))
    np.testing.assert_allclose(rho, 0.5 * epsilon_1)
    np.testing.assert_allclose(theta, [np.arctan2(4, 3), -np.pi / 2])
    assert (hemisphere.entry_from_scaling(x2)[0] == 0.0).all()


def test_flow_of_many_points_is_that_of_each():
    at = ELinear(1.5, 0.7, -2.0, (0.3, -0.4)).at()
    p = np.array([[0.0, 0.0], [0.3, -0.2], [0.6, 0.8], [-1.0, 0.0]])
    for family in (psi.constant(), psi.tanh(), psi.hill(2)):
        many = hemisphere.flow(at, family, p)
        np.testing.assert_allclose(many, [hemisphere.flow(at, family, q) for q in p], rtol=1e-13, atol=1e-14)
        square = hemisphere.flow(at, family, p.reshape(2, 2, 2))
        np.testing.assert_allclose(many.reshape(2, 2, 2), square, rtol=1e-13, atol=1e-14)
        np.testing.assert_allclose(hemisphere.e_psi(family, p)[2:], p[2:], rtol=0.0, atol=1e-15)
        assert (hemisphere.e_psi(family, p)[0] == 0.0).all()
    assert hemisphere.height([1.0, 0.0]) == 0.0
    assert hemisphere.height([0.6, 0.0]) == pytest.approx(0.8)


@pytest.mark.parametrize("epsilon_1", [1.01, -0.01, [0.5, 1.2]])
def test_the_entry_chart_ends_at_the_top_and_at_the_equator(epsilon_1):
    with pytest.raises(ValueError, match="beyond 0 to 1"):
        hemisphere.disc_from_entry(epsilon_1, 0.3)
