"""Find where the equilibria of a general system change: compare states, and look for changes that may hide."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from operator import attrgetter

import numpy as np

from ...arrays import Array
from ...layer_problem.critical import CriticalSet
from ...numerics.sign_changes import lowest, vertex
from ..equator import link_zeros
from .cancellation_zones import States
from .narrow_changes import narrow_change
from .state import State, WindingTest

__all__ = ["SIDE_STEP", "Change", "match_sets", "pieces_between"]

Minimum = tuple[Array, float, Array]  # of `WindingTest`: its place, size and value
Change = tuple[float, State, State]  # where, and the equilibria on either side

_MIN_VALUES = 7  # values at least on each piece
SIDE_STEP = 1e-7  # of the span: where the two sides of a special value are looked at
_REFINEMENTS, _REFINED_SPACING = (
    3,
    1e-5,
)  # times that values between those of the grid are added; how far apart, of the span
_MAX_CHANGES = 10  # between two neighbouring values of the grid, nested
_MIN_WIDTH = 1e-12  # of the span
_NEARER_STEPS = (3e-11, 3e-10, 3e-9)  # of the span: nearer still, where nothing is degenerate there
_MAX_STEEPNESS = 16.0  # of the slope of a minimum that comes to zero, in units of that of the whole step
_MAX_MOVE, _PLACE_STEP = 0.3, 0.05  # in e: from one value to the next, and two steps of the angles that are sampled
_NEIGHBOUR_SAMPLES = 0.01, 0.1, 0.4  # of the way from a special value to its neighbour on the grid


def pieces_between(
    state: States, grid: Sequence[State], width: float, rounds: int = _REFINEMENTS
) -> tuple[list[list[State]], list[Change]]:
    """Part the states where something changes; look again on each piece, where two changes may undo each other."""
    pieces: list[list[State]] = [[grid[0]]]
    changes: list[Change] = []
    for left, right in pairwise(grid):
        for change in _changes(state, left, right, width):
            changes.append(change)
            pieces[-1].append(change[1])
            pieces.append([change[2]])
        pieces[-1].append(right)
    parts: list[list[State]] = []
    within: list[Change] = []
    for i, piece in enumerate(pieces):
        known = _fill_piece(state, piece)
        if rounds:
            brief = _brief_states(state, known, _REFINED_SPACING * width)
            known = sorted([*known, *brief], key=lambda s: s.value)
        for _ in range(rounds):
            more = [state(v) for v in _suspect_values(known, _REFINED_SPACING * width)]
            known = sorted([*known, *more], key=lambda s: s.value)
            if not more or any(s.difference(known[0]) is not None for s in more):
                break
        if rounds and any(s.difference(known[0]) is not None for s in known):
            inner, between = pieces_between(state, known, width, rounds - 1)
            parts += inner
            within += between
        else:
            parts.append(known)
        within += changes[i : i + 1]
    return parts, within


def _fill_piece(state: States, piece: Sequence[State]) -> list[State]:
    """Add states to a piece that has few, in order."""
    known = sorted(piece, key=lambda s: s.value)
    low, high = known[0].value, known[-1].value
    if len(known) < _MIN_VALUES and high > low:
        known = sorted([*known, *(state(v) for v in np.linspace(low, high, _MIN_VALUES)[1:-1])], key=lambda s: s.value)
    return known


def _suspect_values(run: Sequence[State], least: float) -> list[float]:
    """Values at which something that is not zero at its neighbours may be: two changes that undo each other."""
    alike = [s for s in run if s.difference(run[0]) is None]
    if len(alike) < 3 or alike[-1].value - alike[0].value < len(alike) * least:
        return []
    x = np.array([s.value for s in alike])
    lines = [(x, y) for y in _functions(alike)]
    found: set[float] = set()
    for turns in ([s.near_directions for s in alike], [s.near_sets for s in alike]):
        lines += [(x[i : i + 3], y) for i in range(len(x) - 2) for y in _lined_up(turns[i : i + 3])]
    for x, y in lines:
        for i in lowest(x, y):
            # the extremum of the parabola, and where the lines from either side come to zero
            found.add(vertex(x, y, i))
            for one, two in ((i - 2, i - 1), (i - 1, i), (i, i + 1), (i + 1, i + 2)):
                if one >= 0 and two < len(x) and y[one] != y[two]:
                    zero = float(x[one] - y[one] * (x[two] - x[one]) / (y[two] - y[one]))
                    found.update([zero] if x[i - 1] < zero < x[i + 1] else [])
    known = np.array([s.value for s in run])
    return [v for v in sorted(found) if abs(known - v).min() > least]


def _brief_states(state: States, run: Sequence[State], least: float) -> Iterator[State]:
    """Yield states with a pair of equilibria that is born between two states of a run, where one of a pair dies too.

    Before its birth the pair is a positive minimum of |Theta| or |U|, which is gone at the next state, or has passed
    zero.
    """
    for one, two in [*pairwise(run), *pairwise(run[::-1])]:
        for minima in (attrgetter("near_directions"), attrgetter("near_sets")):
            for minimum in zip(*minima(one), strict=True):
                if _next_minimum(minima(two), minimum, _MAX_MOVE) is None:
                    born = _state_after_birth(state, one, two, minima, minimum, least)
                    yield from () if born is None else (born,)


def _state_after_birth(
    state: States, one: State, two: State, minima: Callable[[State], WindingTest], minimum: Minimum, least: float
) -> State | None:
    """Bisect for where a minimum goes between two states: beside a birth, or None if it has met a maximum."""
    low, high, here, share = one, two, minimum, 1.0
    while abs(high.value - low.value) > least and here[1] <= _MAX_STEEPNESS * minimum[1] * share:
        middle = state(0.5 * (low.value + high.value))
        if middle.difference(one) is not None:
            return middle
        share *= 0.5
        there = _next_minimum(minima(middle), here, _PLACE_STEP + share * _MAX_MOVE)
        low, high, here = (low, middle, here) if there is None else (middle, high, there)
    return None


def _next_minimum(minima: WindingTest, minimum: Minimum, move: float) -> Minimum | None:
    """Return the nearest minimum on the same side of zero, if it may be the same."""
    (places, sizes, values), (place, _, value) = minima, minimum
    away = np.where(values @ value > 0.0, np.hypot(*(places - place).T), math.inf)
    nearest = away.argmin() if len(away) else 0
    return (places[nearest], sizes[nearest], values[nearest]) if away.min(initial=math.inf) < move else None


def _lined_up(turns: Sequence[WindingTest]) -> Iterator[Array]:
    """Sizes of what turns back before zero at three neighbouring values, in the same place."""
    (first, one, _), (middle, two, _), (last, three, _) = turns
    if not (len(first) and len(last)):
        return
    for place, size in zip(middle, two, strict=True):
        before, after = np.hypot(*(first - place).T), np.hypot(*(last - place).T)
        if max(before.min(), after.min()) < _MAX_MOVE:
            yield np.array([one[before.argmin()], size, three[after.argmin()]])


def _functions(run: Sequence[State]) -> Iterator[Array]:
    """Smooth functions along a run of states whose zeros are special values."""
    theta = [s.equator.theta for s in run]
    if len(theta[0]):
        rows = link_zeros(np.array(theta))
        for j in range(rows.shape[1]):
            own = [
                int(abs(np.exp(1j * s.equator.theta) - np.exp(1j * t)).argmin())
                for s, t in zip(run, rows[:, j], strict=True)
            ]
            yield np.array([s.equator.lambda_rho[i] for s, i in zip(run, own, strict=True)])
            yield np.array([s.equator.lambda_theta[i] for s, i in zip(run, own, strict=True)])
    elif run[0].exponent is not None:
        yield np.array([s.exponent for s in run], float)
    sets = [list(run[0].critical)]
    for s in run[1:]:
        sets.append(match_sets([C.p for C in sets[-1]], s.critical))
    for column in zip(*sets, strict=True):
        trace, determinant = np.array([C.trace for C in column]), np.array([C.determinant for C in column])
        size = np.array([np.linalg.norm(C.jacobian) for C in column])
        yield trace / size
        yield determinant / size**2
        yield (trace**2 - 4.0 * determinant) / size**2
        yield np.array([1.0 - float(C.e @ C.e) for C in column])


def _changes(state: States, left: State, right: State, width: float, deeper: int = _MAX_CHANGES) -> Iterator[Change]:
    """All changes between two states, in order: the value, and the states beside it."""
    part = left.difference(right)
    if part is None or not deeper:
        return
    value = narrow_change(state, left, right, part, _MIN_WIDTH * width)
    state.check(value)
    before, after = _state_beside(state, left, value, width), _state_beside(state, right, value, width)
    for one, two in pairwise(_way(state, left, before, width)):
        yield from _changes(state, one, two, width, deeper - 1)
    yield value, before, after
    for one, two in pairwise(_way(state, after, right, width)):
        yield from _changes(state, one, two, width, deeper - 1)


def _state_beside(state: States, far: State, value: float, width: float) -> State:
    """Return the state beside a special value, towards `far`: nearer where that differs, as one more lies between."""
    side = math.copysign(1.0, far.value - value)
    near = far if abs(far.value - value) <= SIDE_STEP * width else state(value + side * SIDE_STEP * width)
    for distance in _NEARER_STEPS:
        if distance * width >= abs(near.value - value):
            break
        nearer = state(value + side * distance * width)
        if nearer.plain and nearer.difference(near) is None:
            return near
        # what rounding makes of a multiple zero is not the same twice as far away
        if nearer.plain and nearer.difference(state(value + side * 2.0 * distance * width)) is None:
            return nearer
    return near


def _way(state: States, left: State, right: State, width: float) -> list[State]:
    """Return the states from one to the other, and between them those in which a short pair of changes may show."""
    room = right.value - left.value
    if room <= _REFINED_SPACING * width:
        return [left, right]
    parts = {1.0 - t if beside else t for beside in (False, True) for t in _NEIGHBOUR_SAMPLES}
    return [left, *(state(left.value + t * room) for t in sorted(parts)), right]


def match_sets(places: Sequence[Array], critical: Sequence[CriticalSet]) -> list[CriticalSet]:
    """Critical sets in the order of the places nearest to them."""
    left, out = list(critical), []
    for p in places:
        C = min(left, key=lambda C, p=p: math.dist(C.p, p))
        left = [D for D in left if D is not C]
        out.append(C)
    return out
