"""The names of what happens between two states next to each other."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import combinations

import numpy as np

from ...formulas.switches import kinks
from ...portrait.layer_problem.critical import CriticalSet
from ...results.arrays import Array
from ...results.special_kinds import DETERMINANT, HOPF, SpecialKind, change_between
from ...results.words import say
from ..families.family import SystemFamily
from ..families.first_lyapunov import lyapunov
from ..families.special_points import equator_numbers
from .candidates import Candidate, portrait_place
from .changes import Change
from .result import SpecialValue

__all__ = ["name_changes", "triple_zero"]

_SAME_EVENT_DISTANCE = 0.05  # radians, or distance in p, within which lies what is one at the special value, next to it
_EQUATOR_DISTANCE = 1e-3  # 1 - |e| of a critical set that reaches the equator at the special value, next to it
_SYMMETRY_ANGLES, _SYMMETRY_TOLERANCE = np.linspace(0.1, 3.1, 16), 1e-6  # of Theta about a triple zero


def name_changes(family: SystemFamily, change: Change, points: Sequence[Candidate]) -> list[SpecialValue]:
    """Name all that happens between two states next to each other; `points` are those solved for at the value."""
    return [*_of_equator(family, change, points), *_of_sets(family, change, points)]


def _of_equator(family: SystemFamily, change: Change, points: Sequence[Candidate]) -> list[SpecialValue]:
    """Name what limit directions do, and the closed equator."""
    value, before, after = change
    out = []
    one, two = before.equator.theta, after.equator.theta
    met: list[tuple[int, float]] = []
    if len(one) != len(two):
        met = _merged_directions(*((one, two) if len(one) > len(two) else (two, one)))
    elif len(one):
        # as many on both sides: some may have gone while others came
        away = abs(np.angle(np.exp(1j * (one[:, None] - two))))
        gone, come = one[away.min(axis=1) > _SAME_EVENT_DISTANCE], two[away.min(axis=0) > _SAME_EVENT_DISTANCE]
        met = [pair for side in (gone, come) for pair in _merged_directions(side, side[:0])]
    turn = _axes_angle(family, change)
    for count, theta in met:
        theta = _solved_angle(theta, points, turn)
        if count == 2:
            at = f"θ = {theta:.4g}"
            out.append(SpecialValue("saddle-node", value, _on_equator(theta), say("meet at", at=at)))
        else:
            out.append(triple_zero(family, value, theta, turn))
    if before.exponent is not None and after.exponent is not None and before.parts[2] != after.parts[2]:
        out.append(SpecialValue("neutral equator", value, (0.0, 0.0), say("equator neutral, a cycle may leave")))
    return out


def _axes_angle(family: SystemFamily, change: Change) -> float:
    """Return the angle from the axes of the family to those of the system at a change."""
    before, after = change.before.turn, change.after.turn
    return before + 0.5 * math.remainder(after - before, math.tau) if family.turns else 0.0


def triple_zero(family: SystemFamily, value: float, theta: float, turn: float) -> SpecialValue:
    """Name a triple zero of Theta at an angle of axes that are turned from those of the family."""
    at = f"θ = {theta:.4g}"
    if _is_symmetric(family, value, theta - turn):
        sentence = say("splits, D2" if family.affine else "splits", at=at)
        return SpecialValue("pitchfork", value, _on_equator(theta), sentence)
    return SpecialValue("cusp", value, _on_equator(theta), say("passes a cusp", at=at))


def _on_equator(theta: float) -> tuple[float, float]:
    return math.cos(theta), math.sin(theta)


def _solved_angle(theta: float, points: Sequence[Candidate], turn: float) -> float:
    """Return the angle of the point on the equator that was solved for nearest to an angle, in [0, 2 pi)."""
    angles = [math.atan2(one.y[1], one.y[0]) if one.what == "equator" else float(one.y[0]) for one in points
              if len(one.y) == 2 or one.what == "equator"]  # fmt: skip
    away = [math.remainder(angle + turn - theta, math.tau) for angle in angles]
    nearest = min(away, key=abs, default=math.inf)
    return (theta + nearest if abs(nearest) < _SAME_EVENT_DISTANCE else theta) % math.tau


def _is_symmetric(family: SystemFamily, value: float, theta: float) -> bool:
    """Whether Theta is odd about an angle: a triple zero there is then a pitchfork."""
    angles = theta + np.stack([_SYMMETRY_ANGLES, -_SYMMETRY_ANGLES])
    there = equator_numbers(family, np.stack([angles, np.full(angles.shape, family.unit(value))]))[0]
    return bool(np.abs(there.sum(axis=0)).max() <= _SYMMETRY_TOLERANCE * np.abs(there).max())


def _of_sets(family: SystemFamily, change: Change, points: Sequence[Candidate]) -> list[SpecialValue]:
    """Name what critical sets do: meet, reach the equator, or change their kind."""
    value, before, after = change
    out = []
    pairs, gone, come = _match_states(before.critical, after.critical)
    for side, other in ((gone, after), (come, before)):
        inner = []
        for C in side:
            t = math.atan2(float(C.e[1]), float(C.e[0]))
            turn = _axes_angle(family, change)
            angles = [
                *other.equator.theta,
                *(math.atan2(*one.y[1::-1]) + turn for one in points if one.what == "equator"),
            ]
            away = min((abs(math.remainder(angle - t, math.tau)) for angle in angles), default=math.inf)
            if 1.0 - float(np.hypot(*C.e)) < _EQUATOR_DISTANCE and away < _SAME_EVENT_DISTANCE:
                t = _solved_angle(t, points, turn)
                sentence = say("set reaches the equator", theta=t)
                out.append(SpecialValue("transcritical", value, _on_equator(t), sentence))
            else:
                inner.append(C)
        while len(inner) > 1:
            near = min(combinations(inner, 2), key=lambda pair: math.dist(pair[0].p, pair[1].p))
            inner = [C for C in inner if C is not near[0] and C is not near[1]]
            third = _turned_set(near, pairs)
            if third is not None:  # it goes on, and turned where the two came to it
                pairs.remove(third)
                place = (float(third[1].p[0]), float(third[1].p[1]))
                out.append(SpecialValue(DETERMINANT.kind, value, place, say("set splits")))
                continue
            kinds = sorted("saddle" if C.kind == "saddle" else "node" for C in near)
            sentence = say("two sets meet", one=kinds[1], other=kinds[0])
            place = _solved_place(family, change, points, "fold", _midpoint(near))[0]
            out.append(SpecialValue("fold of critical sets", value, place, sentence))
        for C in inner:
            place = (float(C.p[0]), float(C.p[1]))
            out.append(SpecialValue("change of critical sets", value, place, say("one comes or goes")))
    for C, D in pairs:
        if C.kind == D.kind:
            continue
        kind = change_between(C.kind, D.kind)
        place, y = _solved_place(family, change, points, kind, (float(D.p[0]), float(D.p[1])))
        if kind is HOPF:
            out.append(_hopf(family, value, place, np.array([*D.e, family.unit(value)]) if y is None else y))
        elif not (kind is DETERMINANT and family.affine):  # which is on a line of equilibria
            out.append(SpecialValue(kind.kind, value, place, kind.says))
    return out


def _solved_place(
    family: SystemFamily,
    change: Change,
    points: Sequence[Candidate],
    what: str | SpecialKind,
    place: tuple[float, float],
) -> tuple[tuple[float, float], Array | None]:
    """Return the solved point of a kind nearest to a place, and its (c, s, u); if there is none, the place."""
    solved = [(portrait_place(family, one.y, _axes_angle(family, change)), one.y) for one in points if one.what == what]
    near = [pair for pair in solved if math.dist(pair[0], place) < _SAME_EVENT_DISTANCE]
    return min(near, key=lambda pair: math.dist(pair[0], place), default=(place, None))


def _hopf(family: SystemFamily, value: float, place: tuple[float, float], y: Array) -> SpecialValue:
    """Describe a Hopf point at (c, s, u) with its first Lyapunov coefficient."""
    number = math.nan if kinks(family.rows, ("c", "s")) else float(lyapunov(family, y[None])[0])
    if not math.isfinite(number):
        return SpecialValue(HOPF.kind, value, place, HOPF.says)
    born = "supercritical" if number < 0.0 else "subcritical" if number > 0.0 else "degenerate"
    return SpecialValue(HOPF.kind, value, place, say(f"Hopf, {born}", number=number), number)


def _match_states(
    before: Sequence[CriticalSet], after: Sequence[CriticalSet]
) -> tuple[list[tuple[CriticalSet, CriticalSet]], list[CriticalSet], list[CriticalSet]]:
    """Critical sets that go on from one state to the other, those that went, and those that came."""
    # the nearest first: at two values so close together what goes on has hardly moved
    near = sorted((math.dist(C.p, D.p), i, j) for i, C in enumerate(before) for j, D in enumerate(after))
    joined: list[tuple[int, int]] = []
    for gap, i, j in near:
        if gap < _SAME_EVENT_DISTANCE and not any(i == k or j == m for k, m in joined):
            joined.append((i, j))
    gone = [C for i, C in enumerate(before) if i not in {i for i, _ in joined}]
    come = [D for j, D in enumerate(after) if j not in {j for _, j in joined}]
    return [(before[i], after[j]) for i, j in joined], gone, come


def _merged_directions(more: Array, fewer: Array) -> list[tuple[int, float]]:
    """Return how many limit directions meet and where, by comparing the two sides."""
    away = np.abs(np.remainder(more[:, None] - fewer + math.pi, 2.0 * math.pi) - math.pi)
    own = away.argmin(axis=1) if len(fewer) else np.zeros(len(more), int)
    close = away.min(axis=1, initial=math.inf) < _SAME_EVENT_DISTANCE
    met = [(3, float(fewer[j])) for j in range(len(fewer)) if (close & (own == j)).sum() == 3]
    alone = more[~close]
    if len(alone):
        gaps = np.remainder(np.roll(alone, -1) - alone, 2.0 * math.pi)
        first = int(gaps.argmin())  # of a pair: from there on every second gap is one
        pairs = range(first, first + len(alone) - 1, 2)
        met += [(2, float((alone[i % len(alone)] + 0.5 * gaps[i % len(alone)]) % (2.0 * math.pi))) for i in pairs]
    return sorted(met, key=lambda m: m[1])


def _turned_set(
    near: tuple[CriticalSet, CriticalSet], pairs: Sequence[tuple[CriticalSet, CriticalSet]]
) -> tuple[CriticalSet, CriticalSet] | None:
    """Return the critical set that turned between two of the other kind, which came from it or went into it."""
    saddles = [C.kind == "saddle" for C in near]
    if saddles[0] != saddles[1]:
        return None
    middle, reach = _midpoint(near), _SAME_EVENT_DISTANCE + 0.5 * math.dist(near[0].p, near[1].p)
    turned = [pair for pair in pairs if sum(C.kind == "saddle" for C in pair) == 1]
    return next((pair for pair in turned if math.dist(pair[1].p, middle) < reach), None)


def _midpoint(pair: tuple[CriticalSet, CriticalSet]) -> tuple[float, float]:
    p = 0.5 * (pair[0].p + pair[1].p)
    return float(p[0]), float(p[1])
