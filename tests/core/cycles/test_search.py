"""Fixed points of a return map are found in its samples, on sections made up so that every answer is known."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from codim2_core.cycles import search
from codim2_core.cycles.limit_cycles import _cycle
from codim2_core.cycles.section import COARSE, FixedPoint
from codim2_core.words import recognise

from .sections import Line, circle

INF = math.inf


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


@pytest.mark.parametrize("backward", [False, True])
@pytest.mark.parametrize(
    "f",
    [
        lambda xi: np.tanh(1e5 * (xi - 0.4)),  # flat on both sides: samples of one value
        lambda xi: np.where(xi < 0.4, 1e-3 * xi - 1.0, 5.0 + 1e-3 * xi),  # an interpolant of a jump goes astray
        lambda xi: np.where(xi < 0.4, 1e-4 * xi - 1e-3, 5.0 + np.cos(3e4 * xi)),
    ],
)
def test_a_steep_change_of_sign_is_placed_between_its_sides(f, backward):
    section = Line(f)
    xi = np.linspace(-1.0, 1.0, 8)
    shift = section.displacement(xi, backward=backward)
    i = int(np.flatnonzero(np.sign(shift[1:]) != np.sign(shift[:-1]))[0])
    assert search._polished(section, xi, shift, i, i + 1, backward) == pytest.approx(0.4, abs=2e-3)


@pytest.mark.parametrize(
    ("y", "expected"),
    [
        ([-1.0, 0.5, 2.0], True),
        ([2.0, 0.5, -1.0], True),
        ([-1.0, -1.0, 2.0], False),
        ([-1.0, 2.0, 1.0], False),
        ([2.0, -1.0, 0.0], False),
        ([-INF, 0.5, 2.0], False),
        ([-1.0, 0.5, math.nan], False),
    ],
)
def test_samples_that_all_rise_or_all_fall(y, expected):
    assert search._one_way(np.array(y)) is expected
    assert search._one_way(-np.array(y)) is expected


@pytest.mark.parametrize(
    ("fine", "shown"),
    [
        (lambda xi: xi - 0.4, True),
        (lambda xi: 0.4 - xi, True),
        (lambda xi: xi + 5.0, False),  # no zero among the six
        (lambda xi: (xi - 0.4) ** 2 - 1e-5, False),  # two
        (lambda xi: np.where(xi < 0.4, -1.0, 5.0) + 1e-3 * xi, False),  # a jump: the interpolants differ
        (lambda xi: np.where(xi < 0.4, np.nan, xi - 0.3), False),
        (lambda xi: np.sign(xi - 0.4), False),  # of equal values there is no interpolant
    ],
)
def test_six_samples_show_a_fixed_point_or_nothing_is_said(fine, shown):
    x = np.array([-1.0, 0.0, 1.0, 2.0])
    found = search._interpolated(Line(fine), x, x - 0.4, 0.0, 1.0, False)
    assert found == (pytest.approx(0.4, abs=1e-12) if shown else None)
    beside = Line(fine)
    assert search._interpolated(beside, x, x - 1.5, 0.0, 1.0, False) is None  # the cubic's zero lies elsewhere
    assert beside.asked == []


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
        ([-1, -1, -1, -inf, inf, inf], [3]),
    ):
        assert search._ends(xi, np.array(shift, float)) == expected, shift
    levels = np.array([1.0, 1.0, 1.05, 1.06, 1.07, inf])
    for width, shift, expected in ((0.1, levels, [4]), (0.01, levels, []), (0.01, levels - 1.0, [4])):
        assert search._ends(width * xi, shift) == expected  # a narrow end that has settled hides nothing


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_cycle_just_born_is_where_its_expansion_vanishes(sign):
    """displacement = linear + r^2 (square + 300 r + 1e5 r^2): the terms after the square are told from it."""
    trace, omega = sign * 1e-9, 2.0
    linear, square = 2.0 * math.pi * trace / omega, -sign * 0.7

    def made(square, linear=linear):
        r = lambda xi: 1.0 / (1.0 + np.exp(-xi))
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
    cycle = _cycle(search.FixedPoint(0.0, **crossing), circle(divergence=divergence), -1)
    assert (cycle.kind, cycle.direction) == (kind, -1)
    assert math.log(cycle.divergence_multiplier) == pytest.approx(max(min(divergence, 700.0), -700.0))


@pytest.mark.parametrize("root", [-4.93, -0.7, 0.031, 4.6])
@pytest.mark.parametrize("apart", [0.25, 0.05])
@pytest.mark.parametrize("backward", [False, True])
def test_a_smooth_displacement_is_asked_six_times(root, apart, backward):
    """Near its zero, in the interval of the samples, at the fine tolerance: and that is all, also at the ends."""
    places = []

    class Kept(Line):
        def displacement(self, xi, rtol=1e-9, backward=False):
            places.append((xi, rtol))
            return super().displacement(xi, rtol, backward)

    section = Kept(lambda xi: np.sinh(0.3 * (xi - root)))
    xi = np.arange(-5.0, 5.0, apart)
    shift = section.displacement(xi, COARSE, backward)
    i = int(np.flatnonzero(np.sign(shift[1:]) != np.sign(shift[:-1]))[0])
    places.clear()
    found = search._polished(section, xi, shift, i, i + 1, backward)
    assert found == pytest.approx(root, abs=1e-12)
    ((six, rtol),) = places
    assert len(six) == 6
    assert rtol < COARSE
    gaps = np.diff(six)
    np.testing.assert_allclose(gaps, min(0.02, 0.1 * apart), rtol=1e-9)
    assert six[0] < root < six[-1]
    assert abs(six.mean() - root) < 0.1 * gaps[0]


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


# ---- all that a section shows ----------------------------------------------------------------------------------------


def sought(displacement, trace=1.0, discriminant=1.0, backward=None):
    """Fixed points (place, repelling, touching), and the names of what is said."""

    class Ray(Line):
        critical = SimpleNamespace(trace=trace, discriminant=discriminant)

        def grid(self):
            return np.linspace(-5.0, 5.0, 41)

        def displacement(self, xi, rtol=1e-9, backward=False):
            if backward and against is not None:
                return against(np.asarray(xi, float))
            return super().displacement(xi, rtol, backward)

    against = backward
    found, notes = search.search(search.shown(Ray(displacement)))
    assert all(not one.born or one.xi == -20.0 for one in found)
    return [(one.xi, one.repelling, one.touching) for one in found], [key for n in notes for key, _ in recognise(n)]


def at(x, repelling=False, touching=False):
    return pytest.approx(x, abs=1e-9 if not touching else 1e-4), repelling, touching


@pytest.mark.parametrize(
    ("displacement", "found", "said"),
    [
        (lambda xi: 1.03 - xi, [at(1.03)], []),
        (lambda xi: xi - 1.03, [at(1.03, True)], []),
        (lambda xi: (xi + 2.04) * (1.03 - xi), [at(-2.04, True), at(1.03)], []),
        (lambda xi: 1.0 + xi**2, [], []),
        (lambda xi: 5e-9 * np.sin(9.0 * xi), [], ["identity"]),
        (lambda xi: np.where(abs(xi) < 4.0, 5e-9, INF), [], ["identity"]),
        (lambda xi: (xi - 1.03) ** 2, [at(1.03, touching=True)], ["near a fold"]),
        (lambda xi: (xi - 1.03) ** 2 + 1e-7, [], ["near a fold"]),
        (lambda xi: (xi - 1.03) ** 2 + 1e-5, [], []),
        (lambda xi: (xi + 4.03) ** 2, [], ["near a fold"]),  # so near C that all displacements are small
        (lambda xi: np.where(xi > 3.1, np.nan, 1.03 - xi), [at(1.03)], ["not all followed"]),
        (lambda xi: np.where(xi > 3.1, INF, 5e-4 + (xi - 3.1) ** 2), [], ["near a loop"]),
        (lambda xi: np.where(xi > 3.1, INF, -5e-4 - (xi - 3.1) ** 2), [at(3.1, True)], ["near a loop"]),
        (lambda xi: np.where(xi > 3.1, INF, 5e-3 + (xi - 3.1) ** 2), [], []),
        (lambda xi: np.where(xi > 3.1, -INF, 5e-4 + (xi - 3.1) ** 2), [], []),  # no way to the equator
        (lambda xi: np.where(xi < 0.3, INF, -INF), [], []),
        (lambda xi: np.where(xi < 0.3, -INF, INF), [at(0.3, True)], []),  # so repelling that only the way back shows it
        (lambda xi: np.where(xi < 0.3, -INF, 1.0), [at(0.3, True)], []),
        (lambda xi: np.where(xi < 0.3, -1.0, INF), [at(0.3, True)], []),
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


def test_only_of_what_repels_is_the_way_back_asked():
    """Forward orbits come to a cycle that attracts, however strongly: beside a jump the other way there is none."""
    jump = lambda xi: np.where(xi < 0.3, INF, -INF)
    assert sought(jump, backward=lambda xi: 0.3 - xi) == ([], [])


def test_a_whole_interval_of_fixed_points_is_a_band():
    _, said = sought(lambda xi: np.where(abs(xi) < 2.0, 0.0, xi))
    assert "band" in said
    few = sought(lambda xi: np.where(abs(xi) < 0.8, 0.0, INF * np.sign(xi)))  # too few samples to say more
    assert "identity" not in few[1]


@pytest.mark.parametrize("newborn", [FixedPoint(-20.0, born=True), None])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_cycle_is_born_between_the_critical_set_and_the_samples(monkeypatch, newborn, sign):
    """C attracts, and beside it orbits go away from it: there is one too small to be sampled."""
    monkeypatch.setattr(search, "_newborn", lambda _: newborn)
    plain = [at(1.03, sign < 0.0)]
    one = [(-20.0, False, False), *plain] if newborn else plain
    displacement = lambda xi: sign * (1.03 - xi)
    assert sought(displacement, -sign, -1.0) == (one, [] if newborn else ["too small, about C"])
    assert sought(displacement, sign, -1.0) == (plain, [])
    assert sought(displacement, 0.0, -1.0) == (plain, [])
    assert sought(displacement, -sign, 1.0) == (plain, [])  # a node: nothing turns about it
    lost = lambda xi: np.where(xi < -4.0, np.nan, displacement(xi))
    assert sought(lost, -sign, -1.0) == (one, ["not all followed"] + ([] if newborn else ["too small, about C"]))
    gone = lambda xi: np.where(xi < -4.0, INF, displacement(xi))
    if sign > 0.0:
        assert sought(gone, -sign, -1.0) == (plain, [])
