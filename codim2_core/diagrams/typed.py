"""The one-parameter diagram of a general system, by the exact functions at single values and bisection."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
from itertools import combinations, pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..layer_problem.critical import CriticalSet
from ..layer_problem.equator import EquatorEquilibria
from ..layer_problem.problem import LayerProblem
from ..layer_problem.vary import varied
from ..numerics.sign_changes import lowest, vertex
from ..psi.function import Psi
from .equator import linked
from .result import ClosedEquator, CriticalBranch, EquatorBranch, SpecialValue

__all__ = ["general_parts"]

Array = NDArray[np.float64]

_GRID = 48
_ANGLES = 2.0 * np.pi * np.arange(256) / 256
_CIRCLE = np.stack([np.cos(_ANGLES), np.sin(_ANGLES)], axis=-1)
_LEAST = 7  # values at least on each piece
_BESIDE = 1e-7  # of the span: where the two sides of a special value are looked at
_CLOSER, _APART = 3, 1e-5  # times that values between those of the grid are added; how far apart, of the span
_MOST_CHANGES = 10  # between two neighbouring values of the grid, nested
_NARROW = 1e-12  # of the span
_TOGETHER = 0.05  # radians, or distance in p, within which lies what is one at the special value, beside it
_NEAR_EQUATOR = 1e-3  # 1 - |e| of a critical set that reaches the equator at the special value, beside it


class _State:
    """What stands still at one value; each part is found when it is asked for."""

    def __init__(self, system: Any, psi: Psi, name: str, value: float, z: ArrayLike) -> None:
        self.value = value
        at, psi_at, z_at = varied(system, psi, z, name, value)
        self._problem = LayerProblem(at.at(z_at), psi_at)

    @property
    def equator(self) -> EquatorEquilibria:
        """The limit directions."""
        return self._problem.equator

    @cached_property
    def near_direction(self) -> float:
        """Smallest |Theta| at which it turns back before zero: where two limit directions are about to appear."""
        U = self._problem.at.U(_CIRCLE)
        value = _CIRCLE[:, 0] * U[:, 1] - _CIRCLE[:, 1] * U[:, 0]
        size, before, after = np.abs(value), np.roll(value, 1), np.roll(value, -1)
        turns = (size <= np.abs(before)) & (size <= np.abs(after)) & (before * value > 0.0) & (after * value > 0.0)
        if not turns.any():
            return float(size.max())
        # by the parabola through three samples
        rise, bend = np.abs(after) - np.abs(before), np.abs(before) - 2.0 * size + np.abs(after)
        return float((size[turns] - rise[turns] ** 2 / (8.0 * np.maximum(bend[turns], 1e-300))).min())

    @property
    def critical(self) -> tuple[CriticalSet, ...]:
        """The critical sets."""
        return self._problem.critical

    @property
    def exponent(self) -> float | None:
        """Of a closed equator; None where there is none."""
        cycle = self._problem.equator_cycle
        return None if cycle is None else cycle.exponent

    def part(self, i: int) -> Any:
        """Return what does not change along a piece: of the equator (0), critical sets (1), a closed equator (2)."""
        if i == 0:
            return Counter(self.equator.kind(k) for k in range(len(self.equator)))
        if i == 1:
            return Counter(C.kind for C in self.critical)
        return None if self.exponent is None else int(np.sign(self.exponent))

    def difference(self, other: _State) -> int | None:
        """First part that is not that of the other; None if all are."""
        return next((i for i in range(3) if self.part(i) != other.part(i)), None)


Parts = tuple[list[EquatorBranch], list[ClosedEquator], list[CriticalBranch], list[SpecialValue]]


def general_parts(system: Any, psi: Psi, name: str, span: tuple[float, float], z: ArrayLike) -> Parts:
    """Branches and special values of any system; see `diagram`."""

    def state(value: float) -> _State:
        return _State(system, psi, name, value, z)

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
    pieces: list[list[_State]] = [[grid[0]]]
    for left, right in pairwise(grid):
        for value, before, after in _changes(state, left, right, width):
            special += _named(value, before, after)
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


def _suspected(grid: Sequence[_State]) -> list[float]:
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


def _runs(grid: Sequence[_State], alike: Callable[[_State, _State], bool]) -> list[list[_State]]:
    """Part the grid into runs of neighbouring states that are alike."""
    runs: list[list[_State]] = [[grid[0]]]
    for s in grid[1:]:
        if alike(runs[-1][-1], s):
            runs[-1].append(s)
        else:
            runs.append([s])
    return runs


def _functions(run: Sequence[_State]) -> Iterator[Array]:
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
    state: Callable[[float], _State], left: _State, right: _State, width: float, deeper: int = _MOST_CHANGES
) -> Iterator[tuple[float, _State, _State]]:
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


def _bisected(state: Callable[[float], _State], left: _State, right: _State, part: int, narrow: float) -> float:
    """Find a value at which that part is no longer what it is at `left`."""
    low, high, here = left.value, right.value, left.part(part)
    while high - low > narrow:
        middle = 0.5 * (low + high)
        if middle in (low, high):
            break
        low, high = (middle, high) if state(middle).part(part) == here else (low, middle)
    return 0.5 * (low + high)


def _named(value: float, before: _State, after: _State) -> list[SpecialValue]:
    """Name all that happens between two states beside each other."""
    return [*_on_equator(value, before, after), *_of_sets(value, before, after)]


def _on_equator(value: float, before: _State, after: _State) -> list[SpecialValue]:
    """Name what limit directions do, and the closed equator."""
    out = []
    one, two = before.equator.theta, after.equator.theta
    if len(one) != len(two):
        more, fewer = (one, two) if len(one) > len(two) else (two, one)
        out += [_meeting(value, *met) for met in _meetings(more, fewer)]
    elif len(one):
        # as many on both sides: some may have gone while others came
        away = abs(np.angle(np.exp(1j * (one[:, None] - two))))
        gone, come = one[away.min(axis=1) > _TOGETHER], two[away.min(axis=0) > _TOGETHER]
        out += [_meeting(value, *met) for side in (gone, come) for met in _meetings(side, side[:0])]
    if before.exponent is not None and after.exponent is not None and before.part(2) != after.part(2):
        sentence = "The closed equator is neutral to first order: it turns its stability."
        out.append(SpecialValue("neutral equator", value, (0.0, 0.0), sentence, "thm:geneps0"))
    return out


def _of_sets(value: float, before: _State, after: _State) -> list[SpecialValue]:
    """Name what critical sets do: meet, reach the equator, or change their kind."""
    out = []
    pairs, gone, come = _followed(before.critical, after.critical)
    for side, other in ((gone, after), (come, before)):
        inner = []
        for C in side:
            t = math.atan2(float(C.e[1]), float(C.e[0]))
            away = abs(np.angle(np.exp(1j * (other.equator.theta - t)))).min(initial=math.inf)
            if 1.0 - float(np.hypot(*C.e)) < _NEAR_EQUATOR and away < _TOGETHER:
                t %= 2.0 * math.pi
                sentence = (
                    f"A critical set reaches the equator at θ = {t:.4g}, and the limit direction turns its stability."
                )
                out.append(SpecialValue("transcritical", value, (math.cos(t), math.sin(t)), sentence, "fig:transcrit"))
            else:
                inner.append(C)
        while len(inner) > 1:
            near = min(combinations(inner, 2), key=lambda pair: math.dist(pair[0].p, pair[1].p))
            inner = [C for C in inner if C is not near[0] and C is not near[1]]
            kinds = sorted("saddle" if C.kind == "saddle" else "node" for C in near)
            sentence = f"Two critical sets meet: a {kinds[1]} and a {kinds[0]}."
            out.append(SpecialValue("fold of critical sets", value, _middle(near), sentence, "eq:critical_set"))
        for C in inner:
            place = (float(C.p[0]), float(C.p[1]))
            sentence = "A critical set comes or goes here, alone."
            out.append(SpecialValue("change of critical sets", value, place, sentence, "eq:critical_set"))
    for C, D in pairs:
        if C.kind == D.kind:
            continue
        place = (float(D.p[0]), float(D.p[1]))
        if C.kind.split()[0] == D.kind.split()[0]:
            sentence = "tr(J)² = 4 det J: the critical set changes between node and focus."
            out.append(SpecialValue("node-focus", value, place, sentence, "fig:bads"))
        elif "saddle" in (C.kind, D.kind):
            sentence = "det J = 0: a critical set turns from a saddle into another kind."
            out.append(SpecialValue("det J = 0", value, place, sentence, "eq:scjaco"))
        else:
            sentence = "Hopf: tr J = 0 < det J."
            out.append(SpecialValue("Hopf", value, place, sentence, "sec:case3"))
    return out


def _followed(
    before: Sequence[CriticalSet], after: Sequence[CriticalSet]
) -> tuple[list[tuple[CriticalSet, CriticalSet]], list[CriticalSet], list[CriticalSet]]:
    """Critical sets that go on from one state to the other, those that went, and those that came."""
    # the nearest first: at two values so close together what goes on has hardly moved
    near = sorted((math.dist(C.p, D.p), i, j) for i, C in enumerate(before) for j, D in enumerate(after))
    joined: list[tuple[int, int]] = []
    for gap, i, j in near:
        if gap < _TOGETHER and not any(i == k or j == m for k, m in joined):
            joined.append((i, j))
    gone = [C for i, C in enumerate(before) if i not in {i for i, _ in joined}]
    come = [D for j, D in enumerate(after) if j not in {j for _, j in joined}]
    return [(before[i], after[j]) for i, j in joined], gone, come


def _meetings(more: Array, fewer: Array) -> list[tuple[int, float]]:
    """How many limit directions meet and where, from what lies on the two sides."""
    away = np.abs(np.remainder(more[:, None] - fewer + math.pi, 2.0 * math.pi) - math.pi)
    own = away.argmin(axis=1) if len(fewer) else np.zeros(len(more), int)
    close = away.min(axis=1, initial=math.inf) < _TOGETHER
    met = [(3, float(fewer[j])) for j in range(len(fewer)) if (close & (own == j)).sum() == 3]
    alone = more[~close]
    if len(alone):
        gaps = np.remainder(np.roll(alone, -1) - alone, 2.0 * math.pi)
        first = int(gaps.argmin())  # of a pair: from there on every second gap is one
        pairs = range(first, first + len(alone) - 1, 2)
        met += [(2, float((alone[i % len(alone)] + 0.5 * gaps[i % len(alone)]) % (2.0 * math.pi))) for i in pairs]
    return sorted(met, key=lambda m: m[1])


def _meeting(value: float, count: int, theta: float) -> SpecialValue:
    place, at = (math.cos(theta), math.sin(theta)), f"θ = {theta:.4g}"
    if count == 2:
        sentence = f"Two limit directions meet at {at}: Θ has a double zero."
        return SpecialValue("saddle-node", value, place, sentence, "fig:SNBIF")
    sentence = f"One limit direction splits into three at {at}: Θ has a triple zero."
    return SpecialValue("pitchfork", value, place, sentence, "fig:SNBIF")


def _middle(pair: tuple[CriticalSet, CriticalSet]) -> tuple[float, float]:
    p = 0.5 * (pair[0].p + pair[1].p)
    return float(p[0]), float(p[1])


def _matched(places: Sequence[Array], critical: Sequence[CriticalSet]) -> list[CriticalSet]:
    """Critical sets in the order of the places nearest to them."""
    left, out = list(critical), []
    for p in places:
        C = min(left, key=lambda C, p=p: math.dist(C.p, p))
        left = [D for D in left if D is not C]
        out.append(C)
    return out


def _directions(values: Array, states: list[_State]) -> list[EquatorBranch]:
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


def _sets(values: Array, states: list[_State]) -> list[CriticalBranch]:
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
