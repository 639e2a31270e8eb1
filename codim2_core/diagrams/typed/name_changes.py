"""The names of what happens between two states beside each other."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import combinations

import numpy as np

from ...layer_problem.critical import CriticalSet
from ...special_kinds import DETERMINANT, change_between
from ...words import say
from ..result import SpecialValue
from .state import Array, State

_SAME_EVENT_DISTANCE = 0.05  # radians, or distance in p, within which lies what is one at the special value, beside it
_EQUATOR_DISTANCE = 1e-3  # 1 - |e| of a critical set that reaches the equator at the special value, beside it


def name_changes(value: float, before: State, after: State) -> list[SpecialValue]:
    """Name all that happens between two states beside each other."""
    return [*_name_equator_changes(value, before, after), *_of_sets(value, before, after)]


def _name_equator_changes(value: float, before: State, after: State) -> list[SpecialValue]:
    """Name what limit directions do, and the closed equator."""
    out = []
    one, two = before.equator.theta, after.equator.theta
    if len(one) != len(two):
        more, fewer = (one, two) if len(one) > len(two) else (two, one)
        out += [_meeting_value(value, *met) for met in _merged_directions(more, fewer)]
    elif len(one):
        # as many on both sides: some may have gone while others came
        away = abs(np.angle(np.exp(1j * (one[:, None] - two))))
        gone, come = one[away.min(axis=1) > _SAME_EVENT_DISTANCE], two[away.min(axis=0) > _SAME_EVENT_DISTANCE]
        out += [_meeting_value(value, *met) for side in (gone, come) for met in _merged_directions(side, side[:0])]
    if before.exponent is not None and after.exponent is not None and before.part(2) != after.part(2):
        out.append(SpecialValue("neutral equator", value, (0.0, 0.0), say("equator neutral")))
    return out


def _of_sets(value: float, before: State, after: State) -> list[SpecialValue]:
    """Name what critical sets do: meet, reach the equator, or change their kind."""
    out = []
    pairs, gone, come = _match_states(before.critical, after.critical)
    for side, other in ((gone, after), (come, before)):
        inner = []
        for C in side:
            t = math.atan2(float(C.e[1]), float(C.e[0]))
            away = abs(np.angle(np.exp(1j * (other.equator.theta - t)))).min(initial=math.inf)
            if 1.0 - float(np.hypot(*C.e)) < _EQUATOR_DISTANCE and away < _SAME_EVENT_DISTANCE:
                t %= 2.0 * math.pi
                out.append(
                    SpecialValue(
                        "transcritical", value, (math.cos(t), math.sin(t)), say("set reaches the equator", theta=t)
                    )
                )
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
            out.append(
                SpecialValue(
                    "fold of critical sets", value, _midpoint(near), say("two sets meet", one=kinds[1], other=kinds[0])
                )
            )
        for C in inner:
            place = (float(C.p[0]), float(C.p[1]))
            out.append(SpecialValue("change of critical sets", value, place, say("one comes or goes")))
    for C, D in pairs:
        if C.kind == D.kind:
            continue
        place = (float(D.p[0]), float(D.p[1]))
        change = change_between(C.kind, D.kind)
        out.append(SpecialValue(change.kind, value, place, change.says))
    return out


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


def _meeting_value(value: float, count: int, theta: float) -> SpecialValue:
    place, at = (math.cos(theta), math.sin(theta)), f"θ = {theta:.4g}"
    if count == 2:
        return SpecialValue("saddle-node", value, place, say("meet at", at=at))
    return SpecialValue("pitchfork", value, place, say("splits", at=at))


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
