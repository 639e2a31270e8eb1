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
