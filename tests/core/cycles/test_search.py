"""Fixed points of a return map are found in its samples, on sections made up so that every answer is known."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from codim2_core.cycles import search
from codim2_core.cycles.limit_cycles import _cycle
from codim2_core.cycles.section import COARSE

from .sections import Line, circle


def test_inverse_interpolation_finds_zeros_of_inverse_polynomials():
    """xi is a polynomial of degree 3 of the displacement: four samples are enough."""
    y = np.array([-1.0, -0.2, 0.5, 2.0])
    assert search._root(0.7 + y - 0.3 * y**2 + 0.1 * y**3, y) == pytest.approx(0.7, abs=1e-15)


@pytest.mark.parametrize("backward", [False, True])
@pytest.mark.parametrize(
    "f",
    [
        lambda xi: np.exp(xi) - 1.5,
        lambda xi: np.tanh(40.0 * (np.exp(xi) - 1.5)),
        lambda xi: np.where(xi < 0.2, -np.inf, np.exp(xi) - 1.5),
    ],
)
def test_a_fixed_point_is_polished_to_all_digits(f, backward):
    section = Line(f)
    xi = np.linspace(-1.0, 1.0, 8)
    shift = section.displacement(xi, backward=backward)
    i = int(np.flatnonzero(np.sign(shift[1:]) != np.sign(shift[:-1]))[0])
    assert search._polished(section, xi, shift, i, i + 1, backward) == pytest.approx(math.log(1.5), abs=1e-9)


def test_between_and_settled_and_where_a_displacement_ends():
    assert search._between(1.0, 2.0, 3).tolist() == [1.25, 1.5, 1.75]
    levels = np.array([1.0, 1.0, 1.05, 1.06, 1.07, np.inf])
    assert search._settled(levels, 4, -1)
    assert not search._settled(levels - 1.0, 4, -1)
    assert not search._settled(levels, 2, -1)  # too few before it
    assert search._settled(levels[::-1], 1, 1)
    xi = np.linspace(0.0, 5.0, 6)
    inf, nan = np.inf, np.nan
    for shift, expected in (
        ([1, 1, 1, inf, inf, inf], [2]),
        ([-1, -1, -1, -inf, -inf, -inf], []),  # onto C continuously: nothing is hidden
        ([1, 1, 1, -inf, -inf, -inf], [2]),
        ([inf, inf, -1, -1, -1, -1], [1]),
        ([-inf, -inf, 1, 1, 1, 1], [1]),
        ([-inf, -inf, inf, inf, inf, inf], [1]),
        ([1, 1, 1, nan, nan, nan], []),
        ([1, 2, 3, 4, 5, 6], []),
    ):
        assert search._ends(xi, np.array(shift, float)) == expected, shift


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_cycle_just_born_is_where_its_expansion_vanishes(sign):
    """displacement = linear + r^2 (square + 300 r + 1e5 r^2): the terms after the square are told from it."""
    trace, omega = sign * 1e-9, 2.0
    linear, square = 2.0 * math.pi * trace / omega, -sign * 0.7

    def made(square, linear=linear):
        r = lambda xi: 1.0 / (1.0 + np.exp(-xi))  # noqa: E731
        section = Line(lambda xi: linear + r(xi) ** 2 * (square + 300.0 * r(xi) + 1e5 * r(xi) ** 2))
        section.critical = SimpleNamespace(trace=linear * omega / (2.0 * math.pi), discriminant=-(omega**2))
        return search._newborn(section)

    found = made(square)
    size = math.sqrt(-linear / square)
    assert 1.0 / (1.0 + math.exp(-found.xi)) == pytest.approx(size, rel=1e-5)
    assert found.born
    assert found.repelling == (square > 0.0)
    assert made(-square) is None  # of the other kind: no cycle
    assert made(square, linear * 1e4) is None  # larger than what is sampled: found there
    assert made(square, linear * 1e-9) is None  # smaller than the trace of J can tell


@pytest.mark.parametrize(
    ("divergence", "crossing", "kind"),
    [
        (-1.0, {}, "stable"),
        (1.0, {}, "unstable"),
        (1e-6, {}, "semistable"),
        (-1.0, {"touching": True}, "semistable"),
        (1e-6, {"born": True}, "stable"),
        (-1e-6, {"born": True, "repelling": True}, "unstable"),
        (1e5, {}, "unstable"),
        (-1e5, {}, "stable"),
    ],
)
def test_the_kind_of_a_cycle(divergence, crossing, kind):
    cycle = _cycle(search.Crossing(0.0, **crossing), circle(divergence=divergence), -1)
    assert (cycle.kind, cycle.direction) == (kind, -1)
    assert math.log(cycle.divergence_multiplier) == pytest.approx(max(min(divergence, 700.0), -700.0))


@pytest.mark.parametrize("fine", [math.nan, 0.5])
def test_where_the_fine_tolerance_shows_nothing_a_fixed_point_is_midway(fine):
    class Coarse(Line):
        def displacement(self, xi, rtol=1e-9, backward=False):
            plain = super().displacement(xi, rtol, backward)
            return plain if rtol == COARSE else np.full_like(plain, fine)

    section = Coarse(lambda xi: 3.3 - xi)
    xi = np.linspace(3.0, 4.0, 5)
    found = search._polished(section, xi, section.displacement(xi, COARSE), 1, 2, False)
    assert found == pytest.approx(3.3, abs=1e-3)
