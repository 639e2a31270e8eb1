"""The one-parameter diagram of a general system, by the exact functions at single values and bisection."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...layer_problem.critical import CriticalSet
from ...numerics.sign_changes import lowest, vertex
from ...psi.function import Psi
from ..equator import linked
from ..result import ClosedEquator, CriticalBranch, EquatorBranch, SpecialValue
from .named import named
from .state import Array, State

_GRID = 48
_LEAST = 7  # values at least on each piece
_BESIDE = 1e-7  # of the span: where the two sides of a special value are looked at
_CLOSER, _APART = 3, 1e-5  # times that values between those of the grid are added; how far apart, of the span
_MOST_CHANGES = 10  # between two neighbouring values of the grid, nested
_NARROW = 1e-12  # of the span

Parts = tuple[list[EquatorBranch], list[ClosedEquator], list[CriticalBranch], list[SpecialValue]]


def general_parts(system: Any, psi: Psi, name: str, span: tuple[float, float], z: ArrayLike) -> Parts:
    """Branches and special values of any system; see `diagram`."""

    def state(value: float) -> State:
        return State(system, psi, name, value, z)

    low, high = span
    width = high - low
    # off the round numbers on which special values like to lie
    u = (np.arange(_GRID + 1) + 0.3 * np.sin(2.0 + 1.7 * np.arange(_GRID + 1))) / _GRID
    u[[0, -1]] = 0.0, 1.0
    grid = [state(v) for v in (low + width * np.clip(u, _BESIDE, 1.0 - _BESIDE)).tolist()]
    for _ in range(_CLOSER):
        more = _suspected(grid)
        if not more:
            break
        grid = sorted([*grid, *(state(v) for v in more)], key=lambda s: s.value)
    special: list[SpecialValue] = []
    pieces: list[list[State]] = [[grid[0]]]
    for left, right in pairwise(grid):
        for value, before, after in _changes(state, left, right, width):
            special += named(value, before, after)
            pieces[-1].append(before)
            pieces.append([after])
        pieces[-1].append(right)
    equator: list[EquatorBranch] = []
    closed: list[ClosedEquator] = []
    critical: list[CriticalBranch] = []
    for piece in pieces:
        states = [s for s in sorted(piece, key=lambda s: s.value) if s.difference(piece[0]) is None]
        if len(states) < _LEAST and states[-1].value > states[0].value:
            more = [state(v) for v in np.linspace(states[0].value, states[-1].value, _LEAST).tolist()[1:-1]]
            states = sorted([*states, *(s for s in more if s.difference(piece[0]) is None)], key=lambda s: s.value)
        values = np.array([s.value for s in states])
        equator += _directions(values, states)
        critical += _sets(values, states)
        if states[0].exponent is not None:
            sign = states[len(states) // 2].exponent or 0.0
            kind = "attracting from outside" if sign < 0 else "repelling from outside" if sign > 0 else "neutral"
            x, y = _frozen(values, [s.exponent for s in states])
            closed.append(ClosedEquator(x, y, kind))
    return equator, closed, critical, special


def _suspected(grid: Sequence[State]) -> list[float]:
    """Values at which something that is not zero at its neighbours may be: two changes that undo each other."""
    lines = [
        (np.array([s.value for s in run]), np.array([s.near_direction for s in run]))
        for run in _runs(grid, lambda one, two: len(one.equator) == len(two.equator))
    ]
    for run in _runs(grid, lambda one, two: one.difference(two) is None):
        lines += [(np.array([s.value for s in run]), y) for y in (_functions(run) if len(run) > 2 else [])]
    found: set[float] = set()
    for x, y in lines:
        for i in lowest(x, y):
            # the extremum of the parabola, and where the lines from either side come to zero
            found.add(vertex(x, y, i))
            for one, two in ((i - 2, i - 1), (i - 1, i), (i, i + 1), (i + 1, i + 2)):
                if one >= 0 and two < len(x) and y[one] != y[two]:
                    zero = float(x[one] - y[one] * (x[two] - x[one]) / (y[two] - y[one]))
                    found.update([zero] if x[i - 1] < zero < x[i + 1] else [])
    known = np.array([s.value for s in grid])
    least = _APART * (known[-1] - known[0])
    return [v for v in sorted(found) if abs(known - v).min() > least]


def _runs(grid: Sequence[State], alike: Callable[[State, State], bool]) -> list[list[State]]:
    """Part the grid into runs of neighbouring states that are alike."""
    runs: list[list[State]] = [[grid[0]]]
    for s in grid[1:]:
        if alike(runs[-1][-1], s):
            runs[-1].append(s)
        else:
            runs.append([s])
    return runs


def _functions(run: Sequence[State]) -> Iterator[Array]:
    """Smooth functions along a run of states whose zeros are special values."""
    theta = [s.equator.theta for s in run]
    if len(theta[0]):
        rows = linked(np.array(theta))
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
        sets.append(_matched([C.p for C in sets[-1]], s.critical))
    for column in zip(*sets, strict=True):
        trace, determinant = np.array([C.trace for C in column]), np.array([C.determinant for C in column])
        size = np.array([np.linalg.norm(C.jacobian) for C in column])
        yield trace / size
        yield determinant / size**2
        yield (trace**2 - 4.0 * determinant) / size**2
        yield np.array([1.0 - float(C.e @ C.e) for C in column])


def _changes(
    state: Callable[[float], State], left: State, right: State, width: float, deeper: int = _MOST_CHANGES
) -> Iterator[tuple[float, State, State]]:
    """All changes between two states, in order: the value, and the states beside it."""
    part = left.difference(right)
    if part is None or not deeper:
        return
    value = _bisected(state, left, right, part, _NARROW * width)
    before = state(max(left.value, value - _BESIDE * width))
    after = state(min(right.value, value + _BESIDE * width))
    if before.value > left.value:
        yield from _changes(state, left, before, width, deeper - 1)
    yield value, before, after
    if after.value < right.value:
        yield from _changes(state, after, right, width, deeper - 1)


def _bisected(state: Callable[[float], State], left: State, right: State, part: int, narrow: float) -> float:
    """Find a value at which that part is no longer what it is at `left`."""
    low, high, here = left.value, right.value, left.part(part)
    while high - low > narrow:
        middle = 0.5 * (low + high)
        if middle in (low, high):
            break
        low, high = (middle, high) if state(middle).part(part) == here else (low, middle)
    return 0.5 * (low + high)


def _matched(places: Sequence[Array], critical: Sequence[CriticalSet]) -> list[CriticalSet]:
    """Critical sets in the order of the places nearest to them."""
    left, out = list(critical), []
    for p in places:
        C = min(left, key=lambda C, p=p: math.dist(C.p, p))
        left = [D for D in left if D is not C]
        out.append(C)
    return out


def _directions(values: Array, states: list[State]) -> list[EquatorBranch]:
    first = states[0].equator
    if not len(first):
        return []
    theta = linked(np.array([s.equator.theta for s in states]))
    out = []
    for j in range(len(first)):
        own = [
            int(abs(np.exp(1j * s.equator.theta) - np.exp(1j * t[j])).argmin())
            for s, t in zip(states, theta, strict=True)
        ]
        rho = [s.equator.lambda_rho[i] for s, i in zip(states, own, strict=True)]
        slope = [s.equator.lambda_theta[i] for s, i in zip(states, own, strict=True)]
        x, t, rho_, slope_ = _frozen(values, theta[:, j], rho, slope)
        out.append(EquatorBranch(x, t, rho_, slope_, first.kind(own[0])))
    return out


def _sets(values: Array, states: list[State]) -> list[CriticalBranch]:
    rows = [list(states[0].critical)]
    for s in states[1:]:
        rows.append(_matched([C.p for C in rows[-1]], s.critical))
    out = []
    for column in zip(*rows, strict=True):
        x, e, p = _frozen(values, [C.e for C in column], [C.p for C in column])
        trace, determinant = _frozen([C.trace for C in column], [C.determinant for C in column])
        out.append(CriticalBranch(x, e, p, trace, determinant, column[0].kind))
    return out


def _frozen(*rows: Any) -> tuple[Array, ...]:
    out = tuple(np.array(row, float) for row in rows)
    for array in out:
        array.flags.writeable = False
    return out
