"""Cycles found by the first turn of orbits about a critical set, on rays and orbits made up."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from codim2_core.cycles import first_turns
from codim2_core.stepping.layout import LANES

from .sections import Line, circle


def test_fixed_points_of_a_first_turn_are_told_from_jumps():
    section = Line(lambda xi: -(xi - 0.3) * (1.0 + xi**2))
    assert first_turns._narrowed(section, 0.1, 0.6, False) == [pytest.approx(0.3, abs=1e-13)]
    jump = Line(lambda xi: np.where(xi < 0.3, 1.0, -1.0))
    assert first_turns._narrowed(jump, 0.1, 0.6, False) == []
    beyond = Line(lambda xi: 0.65 - xi)  # the samples were of another tolerance
    assert first_turns._narrowed(beyond, 0.1, 0.6, False) == [pytest.approx(0.65, abs=1e-13)]
    before = Line(lambda xi: 0.05 - xi)
    assert first_turns._narrowed(before, 0.1, 0.6, False) == [pytest.approx(0.05, abs=1e-13)]
    repelling = Line(lambda xi: xi - 0.3)
    assert first_turns._narrowed(repelling, 0.1, 0.6, False) == []
    assert first_turns._narrowed(repelling, 0.1, 0.6, True) == [pytest.approx(0.3, abs=1e-13)]
    assert first_turns._brackets(np.array([1.0, 2.0, 0.0, -1.0, 3.0, -np.inf, 2.0, -2.0])) == [1, 6]
    shift = np.array([1.0, np.inf, np.inf, 2.0, np.nan])
    assert first_turns._ends(np.arange(5.0), shift) == [0, 2, 3]
    assert first_turns._ends(1e-13 * np.arange(5.0), shift) == []


def test_only_a_change_from_an_attracting_side_between_orbits_that_return_is_narrowed(monkeypatch):
    class Ray(Line):
        critical = SimpleNamespace(trace=1.0, discriminant=1.0)

        def grid(self):
            return np.linspace(-5.0, 5.0, 41)

    asked = []
    monkeypatch.setattr(
        first_turns, "_narrowed", lambda _s, low, high, backward: asked.append((low, high, backward)) or []
    )
    for displacement, expected in (
        (lambda xi: 1.03 - xi, [False]),
        (lambda xi: xi - 1.03, [True]),
        (lambda xi: np.where(xi < 1.03, np.inf, -np.inf), []),
        (lambda xi: np.where(xi < 1.03, -np.inf, np.inf), []),
        (lambda xi: np.where(xi < 1.03, 1.0, -np.inf), []),
        (lambda xi: np.where(xi < 1.03, np.inf, -1.0), []),
    ):
        asked.clear()
        first_turns._searched(Ray(displacement))
        assert [backward for *_, backward in asked] == expected
        assert all(low < 1.03 < high for low, high, _ in asked)


def test_narrowing_fills_all_lanes():
    section = Line(lambda xi: 0.3 - xi)
    first_turns._narrowed(section, 0.1, 0.6, False)
    assert section.asked
    assert all(count % LANES == 0 for count, *_ in section.asked)


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
    for period in (1e-3, 1e3):  # in any unit of time
        assert first_turns._same(circle(period=period), circle(period=(1.0 + 5e-7) * period))
        assert not first_turns._same(circle(period=period), circle(period=(1.0 + 5e-6) * period))
    assert not first_turns._same(circle(divergence=1e-4), circle(divergence=3e-4))

    class Ray:
        def states(self, xi):
            return np.stack([xi, 0.0 * xi, 0.0 * xi], axis=-1), xi

    def crossing(x):
        return first_turns.FixedPoint(x)

    assert first_turns._on(Ray(), crossing(1.0), circle())
    between = math.cos(math.pi / 50)  # of two of its points, on the chord
    turned = circle()
    rotate = np.array(
        [[math.cos(math.pi / 50), -math.sin(math.pi / 50)], [math.sin(math.pi / 50), math.cos(math.pi / 50)]]
    )
    object.__setattr__(turned, "points", turned.points @ rotate.T)
    assert first_turns._on(Ray(), crossing(between), turned)
    assert not first_turns._on(Ray(), crossing(between - 0.01), turned)


def sought(monkeypatch, orbits, kinds=("stable focus",), touching=False):
    """Search about critical sets of these kinds; from each in turn one of the orbits is found, or None."""
    sections, given = [], iter(orbits)

    class Ray:
        def __init__(self, _at, _psi, critical, _others):
            sections.append(critical)

        def states(self, xi):
            return np.stack([xi, 0.0 * xi, 0.0 * xi], axis=-1), xi

    crossings = [first_turns.FixedPoint(7.0, touching=touching)]  # on none of the circles
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
