"""The stages of an implicit step."""

from __future__ import annotations

import math

import numpy as np
import pytest

from codim2_core.initial_value.compiled import numbers_of_tableau
from codim2_core.initial_value.kernels.stages import _converged, factor, guess, matrices, solve, tableau_of
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


def test_how_far_a_guess_goes():
    """Up to four times the last step."""
    table, polynomial = tableau_of(numbers_of_tableau()), np.full((1, 5), 0.25)
    first, Z = np.zeros(1), np.empty((5, 1))
    for ratio, goes in ((4.0, True), (4.0001, False)):
        assert bool(guess(table, polynomial, first, ratio, first, Z)) is goes
        assert bool(Z.any()) is goes


def test_the_tableau_is_that_in_python():
    for own, there in zip(tableau_of(numbers_of_tableau()), tableau(), strict=True):
        np.testing.assert_array_equal(own, there)


@pytest.mark.parametrize("n", [1, 2, 7])
def test_factors_solve_linear_equations(n):
    """Also where the first pivot is 0, or small."""
    rng = np.random.default_rng(n)
    for first in (1.0, 0.0, 1e-20):
        A, b = rng.normal(size=(n, n)), rng.normal(size=n)
        A[0, 0] *= first if n > 1 else 1.0
        inside, pivots, found = np.zeros((n + 1, n + 1)), np.zeros(n + 1, np.int64), np.array([*b, 5.0])
        inside[:n, :n] = A
        assert factor(inside, pivots, n)
        assert np.abs(np.tril(inside[:n, :n], -1)).max() <= 1.0  # the largest of a column is taken
        solve(inside, pivots, found, n)
        np.testing.assert_allclose(found, [*np.linalg.solve(A, b), 5.0], rtol=1e-11)
        assert not inside[n].any()


@pytest.mark.parametrize("bad", [0.0, math.inf, math.nan])
def test_a_matrix_that_has_no_factors_is_refused(bad):
    A = np.array([[2.0, 1.0, 0.0], [4.0, 2.0, 1.0], [0.0, 1.0, 1.0]])
    assert factor(A.copy(), np.zeros(3, np.int64), 3)
    A[:, 2] = bad
    assert not factor(A, np.zeros(3, np.int64), 3)


def test_matrices_are_those_of_the_newton_iteration_in_units_of_size():
    """I - h A x J and I - h gamma J."""
    table, h, n = tableau(), 0.3, 3
    rng = np.random.default_rng(4)
    J, size = rng.normal(size=(n, n)), np.array([0.5, 0.5, 3.0])
    big, small = np.full((5 * n, 5 * n), math.nan), np.full((n, n), math.nan)
    matrices(tableau_of(numbers_of_tableau()), h, J, size, big, small)
    scaled = h * J * size / size[:, None]
    np.testing.assert_allclose(big, np.eye(5 * n) - np.kron(table.A, scaled), rtol=1e-13, atol=1e-15)
    np.testing.assert_allclose(small, np.eye(n) - table.gamma * scaled, rtol=1e-13)


@pytest.mark.parametrize(
    ("iteration", "change", "last", "told"),  # in units of what is enough
    [
        (0, 1e9, math.inf, 0),  # one iteration tells nothing of how it converges,
        (0, 2e-3, math.inf, 0),
        (0, 0.9e-3, math.inf, 1),  # unless the change is tiny
        (1, 1.0, 3.0, 1),  # the rest: theta/(1 - theta) times the change is half of it
        (1, 1.0, 1.9, 0),  # more than all of it
        (1, 1.9, 3.9, 0),
        (1, 1.9, 5.8, 1),
        (1, 2.0, 1.9, -1),  # it diverges
        (1, 1.0, 0.9, 0),  # so would this: but it is small already
        (2, 900.0, 1000.0, 0),  # too slow, but that is not sure yet
        (3, 900.0, 1000.0, -1),  # 0.9^6 900 > 0.1
        (3, 900.0, 90000.0, 0),  # 0.01^6 900
        (3, 1.5, 1.5 / 0.9, -1),  # 0.9^6 1.5 > 0.1
        (3, 1.5, 3.5, 0),
        (4, 99.0, 300.0, 1),  # so near, and as slow: rounding
        (4, 101.0, 300.0, 0),
        (4, 99.0, 340.0, 0),  # not so slow
        (3, 99.0, 300.0, 0),
        (8, 30.0, 90.0, 1),
        (8, 101.0, 300.0, -1),  # 101/3 > 2/3 after the last iteration
        (5, 0.0, 0.0, 1),
        (1, 0.9e-3, 0.95e-3, 1),
    ],
)
def test_when_newtons_iteration_ends(iteration, change, last, told):
    for enough in (1e-5, 1e-12):
        assert _converged(change * enough, last * enough, iteration, enough) == told
