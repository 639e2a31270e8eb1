"""Fixed points of a return map are found in its samples, on sections made up so that every answer is known."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from codim2_core.portrait.cycles import cycle_search
from codim2_core.results.words import recognise

from .sections import Line

INF = math.inf


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_cycle_just_born_is_where_its_expansion_vanishes(sign):
    """displacement = linear + r^2 (square + 300 r + 1e5 r^2): the terms after the square are told from it."""
    trace, omega = sign * 1e-9, 2.0
    linear, square = 2.0 * math.pi * trace / omega, -sign * 0.7

    def made(square, linear=linear):
        r = lambda xi: 1.0 / (1.0 + np.exp(-xi))
        section = Line(lambda xi: linear + r(xi) ** 2 * (square + 300.0 * r(xi) + 1e5 * r(xi) ** 2))
        section.critical = SimpleNamespace(trace=linear * omega / (2.0 * math.pi), discriminant=-(omega**2))
        return cycle_search._near_hopf(section)[1]

    found = made(square)
    size = math.sqrt(-linear / square)
    assert 1.0 / (1.0 + math.exp(-found.xi)) == pytest.approx(size, rel=1e-5)
    assert found.born
    assert found.repelling == (square > 0.0)
    assert made(-square) is None  # of the other kind: no cycle
    assert made(square, linear * 1e4) is None  # larger than what is sampled: found there
    assert made(square, linear * 1e-9) is None  # smaller than the trace of J can tell


def sought(displacement, trace=1.0, discriminant=1.0, backward=None):
    """Fixed points (place, repelling, touching), and the names of what is said."""

    class Ray(Line):
        critical = SimpleNamespace(trace=trace, discriminant=discriminant)

        def grid(self):
            return np.linspace(-5.0, 5.0, 41)

        def displacement(self, xi, rtol=1e-9, backward=False, noise=10.0):
            if backward and against is not None:
                return against(np.asarray(xi, float))
            shift = super().displacement(xi, rtol, backward)
            return np.where(np.abs(shift) < noise * rtol, 0.0, shift)

    against = backward
    found, notes = cycle_search._search_ray(Ray(displacement))
    said = dict.fromkeys(key for n in notes for key, _ in recognise(n))
    return [(one.xi, one.repelling, one.touching) for one in found], list(said)


def at(x, repelling=False, touching=False):
    return pytest.approx(x, abs=1e-9 if not touching else 1e-4), repelling, touching


@pytest.mark.parametrize(
    ("displacement", "found", "said"),
    [
        (lambda xi: 1.03 - xi, [at(1.03)], []),
        (lambda xi: xi - 1.03, [at(1.03, True)], []),
        (lambda xi: (xi + 2.04) * (1.03 - xi), [at(-2.04, True), at(1.03)], []),
        (lambda xi: 1.0 + xi**2, [], []),
        (lambda xi: 5e-9 * np.sin(9.0 * xi), [], ["band counted"]),
        (lambda xi: np.where(abs(xi) < 4.0, 5e-9, INF), [], ["band counted"]),
        (lambda xi: (xi - 1.03) ** 2, [at(1.03, touching=True)], ["near a fold"]),
        (lambda xi: (xi - 1.03) ** 2 + 1e-7, [], ["near a fold"]),
        (lambda xi: (xi - 1.03) ** 2 + 1e-5, [], []),
        (lambda xi: (xi + 4.03) ** 2, [], ["near a fold"]),  # so near C that all displacements are small
        (lambda xi: np.where(xi > 3.1, np.nan, 1.03 - xi), [at(1.03)], ["not all followed"]),
        (lambda xi: np.where(xi > 3.1, INF, 5e-4 + (xi - 3.1) ** 2), [], ["near a loop"]),
        (lambda xi: np.where(xi > 3.1, INF, -5e-4 - (xi - 3.1) ** 2), [], ["near a loop"]),
        (lambda xi: np.where(xi > 3.1, INF, 5e-3 + (xi - 3.1) ** 2), [], []),
        (lambda xi: np.where(xi > 3.1, -INF, 5e-4 + (xi - 3.1) ** 2), [], []),  # no way to the equator
        (lambda xi: np.where(xi < 0.3, INF, -INF), [], []),
        (lambda xi: np.where(xi < 0.3, INF, -1.0), [], []),
    ],
)
def test_what_a_section_shows(displacement, found, said):
    places, words = sought(displacement)
    assert places == found
    assert words == said


def test_a_jump_that_the_way_back_does_not_show_is_none():
    jump = lambda xi: np.where(xi < 0.3, -INF, INF)
    for back in (lambda xi: 1.0 + 0.0 * xi, lambda xi: -1.0 + 0.0 * xi, lambda xi: np.full_like(xi, np.nan)):
        assert sought(jump, backward=back) == ([], [])


def test_a_whole_interval_of_fixed_points_is_a_band():
    _, said = sought(lambda xi: np.where(abs(xi) < 2.0, 0.0, xi))
    assert "band counted" in said


def test_a_cycle_so_repelling_that_forward_no_orbit_returns_is_found_on_the_way_back():
    for jump in (lambda xi: np.where(xi < 0.3, -INF, INF), lambda xi: np.where(xi < 0.3, -INF, 1.0)):
        assert sought(jump, backward=lambda xi: 0.3 - xi) == ([at(0.3, True)], [])
