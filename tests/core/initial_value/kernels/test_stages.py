"""The stages of an implicit step."""

from __future__ import annotations

import numpy as np

from codim2_core.initial_value.compiled import numbers_of_tableau
from codim2_core.initial_value.kernels.stages import guess, tableau_of
from codim2_core.numerics.radau import tableau


def test_a_guess_continues_the_last_polynomial():
    table = tableau_of(numbers_of_tableau())
    polynomial = np.array([[1.0, -0.5, 0.25, 0.1, 0.3], [2.0, 0.0, -1.0, 0.0, 0.5]])
    first, Z = np.array([0.3, -0.2]), np.empty((5, 2))
    y = first + polynomial.sum(axis=1)
    for ratio, goes in ((0.7, True), (1.9, True), (1e6, False)):
        assert bool(guess(table, polynomial, first, ratio, y, Z)) is goes
        u = 1.0 + ratio * tableau().nodes[:, None]
        expected = (polynomial[:, None] * u ** np.arange(1, 6)).sum(axis=-1).T + first - y
        np.testing.assert_allclose(Z, expected if goes else 0.0 * expected, atol=1e-12)
