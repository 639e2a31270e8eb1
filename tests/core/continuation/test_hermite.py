"""Hermite's interpolation."""

import numpy as np
import pytest

from codim2_core.continuation.hermite import hermite


@pytest.mark.parametrize("at", [[0.3], [0.0, -1.0], [0.0, -0.4, -2.5]])
def test_it_is_exact_for_polynomials_up_to_its_degree(at):
    at = np.array(at)
    rng = np.random.default_rng(len(at))
    curves = [np.polynomial.Polynomial(rng.normal(size=2 * len(at))) for _ in range(3)]
    where = np.linspace(-3.0, 2.0, 7)
    values, slopes = (np.stack([c.deriv(k)(at) for c in curves], axis=1) for k in (0, 1))
    found = hermite(at, values, slopes, where)
    np.testing.assert_allclose(found, np.stack([c(where) for c in curves], axis=1), rtol=1e-11, atol=1e-11)


def test_it_has_the_values_and_slopes_it_was_given():
    at, h = np.array([0.0, 0.5, 0.7]), 1e-6
    values, slopes = np.array([[1.0], [3.0], [-2.0]]), np.array([[0.0], [5.0], [1.0]])
    np.testing.assert_allclose(hermite(at, values, slopes, at), values, atol=1e-12)
    rise = (hermite(at, values, slopes, at + h) - hermite(at, values, slopes, at - h)) / (2.0 * h)
    np.testing.assert_allclose(rise, slopes, atol=1e-6)
