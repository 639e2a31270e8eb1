"""Predict limit sets of orbits about the one critical set from the limit cycles around it, without integrating them.

Limit cycles about one critical set lie one inside another. An orbit between two of them, or between the set and the
first, stays there and ends at one of both (Poincare and Bendixson: there is no other equilibrium on the hemisphere).
An orbit outside of them all may end at the equator: but once it has turned about the set and come nearer to it, it
winds inwards for good.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from ...results.arrays import Array
from ..layer_problem.problem import LayerProblem, found_once
from .limit_cycles import closed_orbits, excluding_theorem, surrounds
from .ray_section import COARSE_RTOL, TurnSection

ON_C = -1


def predicted_limit_sets(problem: LayerProblem, states: Array) -> list[int | None]:
    """Return to which cycle, from 0 inside, orbits of states (n, 3) go, or `ON_C`; None where it is not decided."""
    told, question = _predictions(problem), states.tobytes()
    if question not in told:
        told[question] = _predict(problem, np.ascontiguousarray(states))
    return told[question]


@found_once()
def _predictions(_: LayerProblem) -> dict[bytes, list[int | None]]:
    """Begin to note what has been said of a problem, by the states: the same are given again."""
    return {}


def _predict(problem: LayerProblem, states: Array) -> list[int | None]:
    undecided: list[int | None] = [None] * len(states)
    if len(problem.critical) != 1 or excluding_theorem(problem) is not None:
        return undecided
    found, (C,) = closed_orbits(problem), problem.critical
    cycles = found.cycles
    if found.notes or any(cycle.kind == "semistable" for cycle in cycles):
        return undecided
    inside = np.array([[surrounds(cycle.points, p) for cycle in cycles] for p in states[:, :2]], bool)
    around = inside.reshape(len(states), len(cycles)).sum(axis=1).tolist()
    # from within, each of these attracts what lies between it and the next one, or repels it
    attracts = [C.kind.startswith("stable"), *(cycle.stable for cycle in cycles)]
    if any(one == other for one, other in pairwise(attracts)):
        return undecided
    outer = [i for i, count in enumerate(around) if count == 0]
    inward = dict(zip(outer, _come_nearer(problem, states[outer]), strict=True)) if outer else {}
    led: list[int | None] = []
    for i, count in enumerate(around):
        within = len(cycles) - count  # of `attracts`: what it lies outside of
        onto = within if attracts[within] else within + 1
        led.append(onto - 1 if (count or (inward[i] and attracts[within])) else None)
    return led


def _come_nearer(problem: LayerProblem, states: Array) -> list[bool]:
    """Whether orbits, when they have turned about the critical set, are nearer to it on the ray through their start."""
    section = TurnSection(problem, problem.critical[0])
    ends, _, codes, _ = section.turn(states, COARSE_RTOL)
    away, after = (np.hypot(*(place[:, :2] - section.critical.p).T) for place in (states, ends))
    return ((codes == section.kernel[0].RETURNED) & (after < away)).tolist()
