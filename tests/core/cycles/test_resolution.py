"""Samples of a displacement, on sections made up so that every answer is known."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from codim2_core.cycles import first_turns, search
from codim2_core.cycles.limit_cycles import _cycle
from codim2_core.cycles.orbit import Orbit, gauss
from codim2_core.cycles.resolution import Samples, _doubtful, cubics, differences, near_fold, unresolved, zeros
from codim2_core.cycles.section import COARSE

UNEVEN = np.array([0.0, 0.3, 0.5, 1.1, 1.2, 2.0, 2.3, 3.1])


class Line:
    """A section with a displacement that is a function of xi; q is 2 xi."""

    def __init__(self, displacement):
        self.given, self.asked = displacement, []

    def states(self, xi):
        return np.zeros((len(xi), 3)), 2.0 * xi

    def displacement(self, xi, rtol=1e-9, backward=False):
        self.asked.append((len(xi), rtol, backward))
        with np.errstate(all="ignore"):
            return self.given(np.asarray(xi, float)) * (-1.0 if backward else 1.0)


def test_fourth_differences_are_the_leading_coefficient():
    for degree, expected in ((3, 0.0), (4, 2.5)):
        np.testing.assert_allclose(differences(UNEVEN, 2.5 * UNEVEN**degree - UNEVEN**2), expected, atol=1e-9)
    assert len(differences(UNEVEN, UNEVEN)) == len(UNEVEN) - 4


def test_a_cubic_is_itself_and_of_a_quartic_the_remainder_is_known():
    places = UNEVEN[:-1, None] + np.diff(UNEVEN)[:, None] * np.linspace(0.0, 1.0, 17)
    for f, far in ((lambda x: x**3 - 2.0 * x + 1.0, False), (lambda x: 3.0 * x**4 - x, True)):
        values, error = cubics(UNEVEN, f(UNEVEN))
        assert values.shape == error.shape == places.shape
        np.testing.assert_allclose(np.abs(f(places) - values), error, atol=1e-11)
        assert (error.max() > 0.1) == far
        assert not error[:, [0, -1]].any()  # both ends of an interval are among its samples
    # in the middle of the samples the four about an interval are used: the product of distances is smaller there
    assert error[3].max() < error[0].max()


def test_the_largest_of_the_differences_near_an_interval_counts():
    """Only the last sample is off: the error is large where it enters, and nothing far from it."""
    q = np.arange(12.0)
    shift = np.zeros(12)
    shift[-1] = 1.0
    _, error = cubics(q, shift)
    fourth = 1.0 / 24.0
    assert (error.max(axis=1) > 0.0).tolist() == [False] * 7 + [True] * 4
    assert error[9].max() == pytest.approx(
        fourth * max(abs(x * (x - 1) * (x - 2) * (x - 3)) for x in 1 + np.arange(17) / 16)
    )


@pytest.mark.parametrize(
    ("values", "doubtful"),
    [
        ([1.0, 1.0, 1.0], False),
        ([1.0, 0.05, 1.0], True),
        ([1.0, -0.5, 1.0], True),
        ([1.0, 0.2, -1.0], False),
        ([1.0, -0.5, 0.05, -1.0], True),
        ([1.0, 0.05, 0.05, -1.0], True),
        ([1.0, 0.5, 0.05, -1.0], False),
    ],
)
def test_other_zeros_than_the_signs_ask_for(values, doubtful):
    row = np.array([values])
    for sign in (1.0, -1.0):
        assert _doubtful(sign * row, np.full_like(row, 0.1)).tolist() == [doubtful]
        assert _doubtful(0.01 * sign * row, np.full_like(row, 0.001)).tolist() == [doubtful]  # in another unit


def test_what_samples_do_and_do_not_show():
    q = np.linspace(-3.0, 3.0, 26)
    none = np.zeros(26)
    assert unresolved(q, np.sin(q), none) == []
    assert unresolved(q, np.sin(q), none + 0.3) != []  # zero cannot be told apart any more
    assert unresolved(q, q**2 + 1.0, none) == []
    hidden = unresolved(
        q, (q - 0.12) ** 2 - 1e-4, none
    )  # two zeros between two samples, on none of which it is negative
    assert 12 in hidden
    assert set(hidden) <= {11, 12, 13}
    assert unresolved(q[:4], np.ones(4), none[:4]) == [0, 1, 2]  # too few to know
    gap = np.where(np.abs(q) < 0.3, np.inf, np.where(q > 0, 1.0, -1.0))
    assert unresolved(q, gap, none) == []
    few = np.where((q > -0.3) & (q < 0.4), 1.0, np.nan)
    assert unresolved(q, few, none) == [12, 13]


def test_a_dip_of_few_samples_is_looked_into_on_both_sides():
    q = np.arange(12.0)
    shift = np.ones(12)
    shift[6] = 0.4
    found = unresolved(q, shift, np.zeros(12))
    assert {5, 6} <= set(found)
    shift[6] = 0.999
    assert unresolved(q, shift, np.zeros(12)) == []


@pytest.mark.parametrize(
    ("shift", "expected"),
    [
        ([1, 2, -1, -2], ([(1, 2)], [], False)),
        ([-1, 1, -np.inf, np.inf], ([(0, 1), (1, 2), (2, 3)], [], False)),
        ([1, 0, -1], ([(0, 2)], [], False)),
        ([1, 0, 1], ([], [1], False)),
        ([1, 0.05, 0.01, 0.08, 2], ([], [2], True)),
        ([1, 0, np.nan, 1], ([], [], False)),
        ([-1, -2, -3], ([], [], False)),
    ],
)
def test_signs_folds_and_bands(shift, expected):
    shift = np.array(shift, float)
    noise = np.full(len(shift), 0.1)
    near = 0.001 * np.arange(len(shift))
    changes, touching, band = zeros(near, shift, noise)
    if expected[2]:
        assert (changes, touching, band) == ([], expected[1], False)
        assert zeros(np.arange(len(shift)), shift, noise) == ([], [], True)
    else:
        assert (changes, touching, band) == expected


def test_samples_stay_in_order_and_know_which_are_fine():
    section = Line(lambda xi: xi**2)
    samples = Samples(section, np.array([-1.0, 0.0, 1.0, 2.0]))
    coarse = samples.noise
    np.testing.assert_allclose(coarse, 1e-8 * (1.0 + np.exp(-samples.q)))
    samples.refine(np.array([1.5, -0.5]), np.array([False, True, False, False]))
    assert samples.xi.tolist() == [-1.0, -0.5, 0.0, 1.0, 1.5, 2.0]
    assert samples.q.tolist() == (2.0 * samples.xi).tolist()
    assert samples.shift.tolist() == (samples.xi**2).tolist()
    assert samples.fine.tolist() == [False, True, True, False, True, False]
    assert [count for count, *_ in section.asked] == [4, 3]
    assert section.asked[0][1] > section.asked[1][1]
    np.testing.assert_allclose(samples.noise[[1, 2]], 1e-11 * (1.0 + np.exp(-samples.q[[1, 2]])))
    samples.refine(np.array([0.1]), np.ones(6, bool))
    assert section.asked[-1][0] == 4  # what is fine already is not asked for again


@pytest.mark.parametrize("apart", [1e-1, 1e-2, 1e-3])
@pytest.mark.parametrize("backward", [False, True])
def test_two_zeros_close_together_are_separated(apart, backward):
    at = (0.3123, 0.3123 + apart, -1.1)
    f = lambda xi: (xi - at[0]) * (xi - at[1]) * (xi - at[2])  # noqa: E731
    samples = Samples(Line(f), np.linspace(-3.0, 3.0, 24), backward)
    assert samples.resolve(lambda xi, shift: [])
    changes, touching, band = zeros(samples.q, samples.shift, samples.noise)
    assert (len(changes), touching, band) == (3, [], False)
    for (i, j), root in zip(changes, sorted(at), strict=True):
        assert samples.xi[i] <= root <= samples.xi[j]
    assert len(samples.xi) < 200
    assert np.sign(samples.shift[0]) == (1.0 if backward else -1.0)


def test_a_fold_is_touched_and_a_map_too_wild_is_said_to_be():
    samples = Samples(Line(lambda xi: (xi - 0.4) ** 2), np.linspace(-3.0, 3.0, 24))
    assert samples.resolve(lambda xi, shift: [])
    changes, touching, _ = zeros(samples.q, samples.shift, samples.noise)
    assert changes == []
    assert [samples.xi[i] for i in touching] == [pytest.approx(0.4, abs=1e-4)]
    assert np.diff(samples.xi).min() > 2e-6 / 33  # narrower than `NARROWEST` nothing is divided
    wild = Samples(Line(lambda xi: np.sin(3e4 * xi) + 0.5), np.linspace(-3.0, 3.0, 24))
    assert not wild.resolve(lambda xi, shift: [])
    assert 900 < len(wild.xi) <= 4 * 900
    lost = Samples(Line(lambda xi: np.where(xi < 1.0, np.nan, 1.0)), np.linspace(-3.0, 3.0, 24))
    assert not lost.resolve(lambda xi, shift: [0])
    assert len(lost.xi) == 24
    looked = Samples(Line(lambda xi: 1.0 + 0.0 * xi), np.linspace(-3.0, 3.0, 24))
    assert looked.resolve(lambda xi, shift: [i for i in (3, 9) if xi[i + 1] - xi[i] > 0.1])
    assert len(looked.xi) == 24 + 2 * 16


def test_a_jump_is_told_from_a_steep_slope_down_to_rounding():
    samples = Samples(Line(lambda xi: np.where(xi < 0.4321, -1.0, 1.0) + 0.0 * xi), np.linspace(-3.0, 3.0, 24))
    assert samples.resolve(lambda xi, shift: [], 1e-5)
    ((i, j),), touching, _ = zeros(samples.q, samples.shift, samples.noise)
    assert touching == []
    assert 0.0 < samples.xi[j] - samples.xi[i] < 1e-4


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


def test_fixed_points_of_a_first_turn_are_told_from_jumps():
    section = Line(lambda xi: -(xi - 0.3) * (1.0 + xi**2))
    assert first_turns._narrowed(section, 0.1, 0.6, False) == [pytest.approx(0.3, abs=1e-13)]
    jump = Line(lambda xi: np.where(xi < 0.3, 1.0, -1.0))
    assert first_turns._narrowed(jump, 0.1, 0.6, False) == []
    beyond = Line(lambda xi: 0.65 - xi)  # the samples were of another tolerance
    assert first_turns._narrowed(beyond, 0.1, 0.6, False) == [pytest.approx(0.65, abs=1e-13)]
    repelling = Line(lambda xi: xi - 0.3)
    assert first_turns._narrowed(repelling, 0.1, 0.6, False) == []
    assert first_turns._narrowed(repelling, 0.1, 0.6, True) == [pytest.approx(0.3, abs=1e-13)]
    assert first_turns._brackets(np.array([1.0, 2.0, 0.0, -1.0, 3.0, -np.inf, 2.0, -2.0])) == [1, 6]
    shift = np.array([1.0, np.inf, np.inf, 2.0, np.nan])
    assert first_turns._ends(np.arange(5.0), shift) == [0, 2, 3]
    assert first_turns._ends(1e-13 * np.arange(5.0), shift) == []


def circle(radius=1.0, sense=1, period=2.0, divergence=-1.0, n=50):
    angle = sense * 2.0 * math.pi * np.arange(n + 1) / n
    points = radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return Orbit(points, period, period, 0.5, divergence, np.zeros(2), 0.0, points[:1], np.ones(1))


def test_orbits_are_told_apart_and_have_a_sense():
    assert first_turns._sense(circle().points) == 1
    assert first_turns._sense(circle(sense=-1).points) == -1
    for away in ((3.0, -2.0), (-5.0, 0.1), (0.0, 4.0)):  # the origin need not lie inside
        assert [first_turns._sense(circle(sense=sense).points + away) for sense in (1, -1)] == [1, -1]
    one = circle()
    assert first_turns._same(one, circle(n=37))
    assert not first_turns._same(one, circle(period=2.1))
    assert not first_turns._same(one, circle(divergence=1.0))
    assert not first_turns._same(one, circle(radius=0.5))
    assert not first_turns._same(one, circle(period=2.0001))
    assert not first_turns._same(circle(divergence=1e-4), circle(divergence=3e-4))

    class Ray:
        def states(self, xi):
            return np.stack([xi, 0.0 * xi, 0.0 * xi], axis=-1), xi

    def crossing(x):
        return first_turns.Crossing(x)

    assert first_turns._on(Ray(), crossing(1.0), circle())
    between = math.cos(math.pi / 50)  # of two of its points, on the chord
    turned = circle()
    rotate = np.array(
        [[math.cos(math.pi / 50), -math.sin(math.pi / 50)], [math.sin(math.pi / 50), math.cos(math.pi / 50)]]
    )
    object.__setattr__(turned, "points", turned.points @ rotate.T)
    assert first_turns._on(Ray(), crossing(between), turned)
    assert not first_turns._on(Ray(), crossing(between - 0.01), turned)


def test_nodes_of_the_collocation_integrate_polynomials():
    c, w, a = gauss()
    for degree in range(12):
        assert w @ c**degree == pytest.approx(1.0 / (degree + 1), abs=1e-15)
    for degree in range(6):
        np.testing.assert_allclose(a @ c**degree, c ** (degree + 1) / (degree + 1), atol=1e-14)


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


def sought(monkeypatch, orbits, kinds=("stable focus",), touching=False):
    """Search about critical sets of these kinds; from each in turn one of the orbits is found, or None."""
    sections, given = [], iter(orbits)

    class Ray:
        def __init__(self, _at, _psi, critical, _others):
            sections.append(critical)

        def states(self, xi):
            return np.stack([xi, 0.0 * xi, 0.0 * xi], axis=-1), xi

    crossings = [first_turns.Crossing(7.0, touching=touching)]  # on none of the circles
    monkeypatch.setattr(first_turns, "TurnSection", Ray)
    monkeypatch.setattr(first_turns, "_searched", lambda _: (crossings, []))
    monkeypatch.setattr(first_turns, "orbit", lambda *_: next(given))
    critical = tuple(SimpleNamespace(kind=kind, discriminant=float(i % 5)) for i, kind in enumerate(kinds))
    return *first_turns.find(None, None, critical), sections


def test_an_orbit_that_does_not_close_is_no_cycle_and_said_to_be_none(monkeypatch):
    open_ = circle()
    object.__setattr__(open_, "closure", 1e-3)
    for found in (None, open_):
        cycles, _, notes, _ = sought(monkeypatch, [found])
        assert cycles == []
        assert len(notes) == 1
        assert "could not be closed" in notes[0]


def test_a_closed_orbit_of_a_band_is_none_unless_it_is_touched(monkeypatch):
    cycles, _, notes, _ = sought(monkeypatch, [circle(divergence=1e-11)])
    assert (cycles, notes) == ([], (first_turns.BAND_NOTE,))
    cycles, _, notes, _ = sought(monkeypatch, [circle(divergence=1e-11)], touching=True)
    assert (len(cycles), notes) == (1, ())
    for divergence in (1e-7, -1e-7):
        cycles, _, notes, _ = sought(monkeypatch, [circle(divergence=divergence, sense=-1)])
        assert ([sense for *_, sense in cycles], notes) == ([-1], ())


def test_a_cycle_around_two_sets_is_found_once(monkeypatch):
    kinds = ("stable focus", "saddle", "unstable node")
    cycles, reason, notes, about = sought(monkeypatch, [circle(), circle(n=37)], kinds)
    assert [C.kind for C in about] == ["stable focus", "unstable node"]
    assert (len(cycles), notes) == (1, ())
    assert "the critical sets that are no saddles" in reason
    cycles, reason, _, _ = sought(monkeypatch, [circle(), circle(radius=0.5)], kinds)
    assert len(cycles) == 2
    assert "the critical sets that are no saddles" not in sought(monkeypatch, [None])[1]


def test_without_a_set_to_surround_there_is_no_search(monkeypatch):
    assert sought(monkeypatch, [], ())[:3] == ([], first_turns.NO_CRITICAL_SET, ())
    assert sought(monkeypatch, [], ("saddle",) * 2)[:3] == ([], first_turns.ONLY_SADDLES, ())


def test_of_many_sets_those_about_which_orbits_turn_fastest_are_searched(monkeypatch):
    _, _, notes, about = sought(monkeypatch, [circle()] * 14, ("stable focus",) * 14)
    assert notes == ("Searched about 12 of 14 critical sets only: cycles around others may be missing.",)
    assert [C.discriminant for C in about] == [0.0] * 3 + [1.0] * 3 + [2.0] * 3 + [3.0] * 3
    assert sought(monkeypatch, [circle()] * 12, ("stable focus",) * 12)[2] == ()


@pytest.mark.parametrize(
    ("displacement", "trace", "discriminant", "crossings", "words"),
    [
        (lambda xi: 1.0 - xi, 1.0, -1.0, [(1.0, False)], []),
        (lambda xi: xi - 1.0, -1.0, -1.0, [(1.0, True)], []),
        (lambda xi: (xi + 2.0) * (1.0 - xi), -1.0, -1.0, [(-2.0, True), (1.0, False)], []),
        (lambda xi: 1.0 - xi, -1.0, -1.0, [(1.0, False)], ["too small"]),  # C attracts, and orbits go away from it
        (lambda xi: xi - 1.0, 1.0, -1.0, [(1.0, True)], ["too small"]),
        (lambda xi: 1.0 - xi, -1.0, 1.0, [(1.0, False)], []),  # a node: nothing turns about it
        (lambda xi: np.where(xi < -3.0, np.inf, 1.0 - xi), -1.0, -1.0, [(1.0, False)], []),
        (lambda xi: np.where(xi > 3.0, np.nan, 1.0 - xi), 1.0, -1.0, [(1.0, False)], ["not followed", "so steep"]),
        (lambda xi: 0.0 * xi, 1.0, -1.0, [], ["a band"]),
        (lambda xi: np.where(abs(xi) < 2.0, 0.0, xi), 1.0, 1.0, None, ["a band", "so steep"]),
        (lambda xi: (xi - 1.03) ** 2 + 1e-7, 1.0, 1.0, [], ["fold"]),
        (lambda xi: (xi - 1.03) ** 2 + 1e-4, 1.0, 1.0, [], []),
    ],
)
def test_what_a_ray_shows(displacement, trace, discriminant, crossings, words):
    class Ray(Line):
        critical = SimpleNamespace(trace=trace, discriminant=discriminant)

        def grid(self):
            return np.linspace(-5.0, 5.0, 41)

    found, notes = first_turns._searched(Ray(displacement))
    if crossings is not None:
        assert [(c.xi, c.repelling) for c in found] == [(pytest.approx(x, abs=1e-9), way) for x, way in crossings]
    assert len(set(notes)) == len(words)
    for word in words:
        assert any(word in note for note in notes), (word, notes)


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize(("centre", "height", "bend"), [(0.37, 3e-4, 2.0), (1.62, -0.2, 0.3), (2.11, 5.0, 70.0)])
def test_how_near_a_fold_is_the_height_of_a_parabola(centre, height, bend, sign):
    """Wherever its vertex lies between uneven samples."""
    shift = sign * (height + bend * (UNEVEN - centre) ** 2)
    assert near_fold(UNEVEN, shift, np.zeros(8)) == pytest.approx(abs(height), rel=1e-9, abs=1e-12)
    assert near_fold(-UNEVEN[::-1], shift[::-1], np.zeros(8)) == pytest.approx(abs(height), rel=1e-9, abs=1e-12)
    broken = np.where(np.abs(UNEVEN - centre) < 0.45, np.nan, shift)
    assert near_fold(UNEVEN, broken, np.zeros(8)) == math.inf  # its vertex is not seen


def test_without_an_extremum_there_is_no_fold_near():
    assert near_fold(UNEVEN, UNEVEN**3 - 2.0, np.zeros(8)) == math.inf
    assert near_fold(UNEVEN, np.full(8, 0.3), np.zeros(8)) == math.inf
    small = 1e-3 * np.array([5.0, 4.0, 3.0, 3.1, 3.0, 4.0, 5.0, 6.0])
    assert near_fold(UNEVEN, small, np.full(8, 1e-3)) == math.inf  # it falls and rises by no more than noise


def test_a_row_that_is_zero_within_noise_is_as_near_a_fold_as_its_largest():
    row = np.array([1.0, 1e-4, -2e-4, 5e-5, 1.0, 2.0, 3.0, 4.0])
    noise = np.full(8, 1e-4)
    assert near_fold(UNEVEN, row, noise) == pytest.approx(2e-4, rel=1.0)
    assert near_fold(UNEVEN, row, noise) <= 2e-4
    crossing = np.where(np.arange(8) > 3, -row, row)  # of one sign before, of the other behind
    assert near_fold(UNEVEN, crossing, noise) > 0.1


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
