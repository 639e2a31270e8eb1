"""Trajectories against exact solutions, at every tolerance."""

import math

import numpy as np
import pytest
from scipy.linalg import expm

from codim2_core import hemisphere, psi
from codim2_core.portrait.orbits.trajectories import Status
from codim2_core.systems.elinear import ELinear

from .seeds import CASE_I, FAMILIES, NAMES, ends, ring, sunflower

TOLERANCES = [10.0**-k for k in range(3, 14)]


def lorentz(b, f, T):
    """Flow of (x2, y2, sqrt(1 + |x2|^2)) for Psi = 1, a = d = 0: an element of SO(2, 1)."""
    return expm(T * np.array([[0.0, -b, f[0]], [b, 0.0, f[1]], [f[0], f[1], 0.0]]))


@pytest.mark.parametrize("p", FAMILIES, ids=NAMES)
def test_finite_at_the_bottom_and_at_the_rim(p):
    seeds = [(0.0, 0.0), (1.0, 0.0), (0.0, -1.0), (math.nextafter(1.0, 0.0), 0.0), (1e-300, 0.0), (1.0 + 1e-15, 0.0)]
    for system in (CASE_I, ELinear(0.0, 0.0, 0.0), ELinear(1.0, 1.0, 1.0)):
        result = ends(system, p, seeds, 1e-9)
        assert np.isfinite(result.ends).all()


@pytest.mark.parametrize("tolerance", TOLERANCES)
def test_matrix_exponential_of_so21_at_every_tolerance(tolerance):
    b, f = 1.3, (0.4, -0.7)
    seeds = sunflower(40)
    w = hemisphere.height(seeds)
    X = np.column_stack([seeds / w[:, None], 1.0 / w]) @ lorentz(b, f, 8.0).T
    result = ends(ELinear(0.0, b, 0.0, f), psi.constant(), seeds, tolerance)
    assert np.abs(result.ends[:, :2] - X[:, :2] / X[:, 2:]).max() <= 10 * tolerance
    assert np.abs(result.ends[:, 2] * X[:, 2] - 1.0).max() <= 10 * tolerance + 1e-13


@pytest.mark.parametrize("tolerance", TOLERANCES)
def test_riccati_equation_outside_at_every_tolerance(tolerance):
    a, b, f = -0.3, 1.3, np.array([0.4, -0.7])
    seeds = ring(40, 1.7)
    X = np.column_stack([seeds / 1.7, np.ones(40)]) @ lorentz(b, f, 8.0).T
    result = ends(ELinear(a, b, a, tuple(f)), psi.rational(), seeds, tolerance)
    assert np.abs(result.ends[:, :2] - X[:, :2] / X[:, 2:]).max() <= 10 * tolerance
    rho = 0.7 * math.exp(8.0 * a) * X[:, 2]
    assert np.abs(result.ends[:, 2] / rho - 1.0).max() <= 10 * tolerance + 1e-13


@pytest.mark.parametrize("tolerance", TOLERANCES)
def test_the_equator_is_followed_exactly_in_theta(tolerance):
    b, f = 1.3, (0.4, -0.7)
    seeds = ring(16, 1.0)
    X = np.column_stack([seeds, np.ones(16)]) @ lorentz(b, f, 8.0).T
    result = ends(ELinear(0.5, b, 0.5, f), psi.tanh(), seeds, tolerance)
    assert np.abs(result.ends[:, :2] - X[:, :2] / X[:, 2:]).max() <= 10 * tolerance
    assert (result.ends[:, 2] == 0.0).all()
    assert set(result.status) == {Status.ON_EQUATOR}


@pytest.mark.parametrize("p", FAMILIES, ids=NAMES)
@pytest.mark.parametrize("tolerance", [1e-4, 1e-7, 1e-10])
def test_orbits_without_f_are_those_of_the_linear_system_for_any_psi(p, tolerance):
    # A node: d ln|x2| - a ln|y2| is constant along x2' = A x2; a focus: theta - (b/a) ln|x2| is.
    seeds = sunflower(48)
    start = seeds / hemisphere.height(seeds)[:, None]
    a, d = -1.0, 0.6
    result = ends(ELinear(a, 0.0, d), p, seeds, tolerance, t_max=4.0)
    x = result.ends[:, :2] / result.ends[:, 2:]
    drift = d * np.log(np.abs(x[:, 0] / start[:, 0])) - a * np.log(np.abs(x[:, 1] / start[:, 1]))
    # Relative errors of small p grow by |p|^-1: the tolerance on p is absolute there.
    least = np.minimum(np.abs(result.ends[:, :2]).min(axis=1), np.abs(seeds).min(axis=1))
    assert (np.abs(drift) <= 10 * tolerance * (1.0 + 1.0 / least)).all()
    a, b = 0.4, 1.1
    result = ends(ELinear(a, b, a), p, seeds, tolerance, t_max=4.0)
    x = result.ends[:, :2] / result.ends[:, 2:]
    turn = np.arctan2(x[:, 1], x[:, 0]) - np.arctan2(start[:, 1], start[:, 0])
    turn -= b / a * np.log(np.hypot(*x.T) / np.hypot(*start.T))
    r = np.hypot(*seeds.T)
    assert (np.abs(np.exp(1j * turn) - 1.0) <= 10 * tolerance * (1.0 + 3.0 / r)).all()
