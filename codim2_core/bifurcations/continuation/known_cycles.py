"""Cycles as closed lines: whether two are one, where one meets a ray, and which a piece of a branch passes.

And whether a branch has passed a loop unseen. Where a cycle becomes a loop through a saddle, the map of first turns
goes on to larger cycles, or smaller ones, on the other side of the saddle: so steps may lead over it. Then the cycle
surrounds other critical sets.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from ...numerics.arclength import distance
from ...portrait.cycles.limit_cycles import LimitCycle, surrounds
from ...results.arrays import Array
from .branch_ends import BranchEnd
from .corrector import BranchTracer
from .turns import (
    ContinuationPoint,
    ContinuationPoints,
    Problems,
    ReturnMapPoint,
    TurnGuess,
    points_at_value,
    reversed_trace,
)

MAX_HALVINGS = 40  # of the step that leads over a loop
LOOP_TOLERANCE = 1e-9  # of the span: how near to it that is


def line_of(tracer: BranchTracer, turn: ReturnMapPoint) -> Array | None:
    """Return a cycle as a closed line; None if it is lost."""
    course = tracer.family.course(turn.xi, turn.value, turn.exponent > 0.0)
    return None if course is None else np.concatenate([[turn.p], course.states[:, :2], [turn.p]])


def split_at_homoclinic(
    tracer: BranchTracer, trace: ContinuationPoints, problem: Problems
) -> tuple[ContinuationPoints, ContinuationPoints] | None:
    """Part a trace at the first loop that it has passed, with points close to it; None if it has passed none."""
    rounds = [_count_surrounded(tracer, point.turn, problem) for point in trace.points]
    for i in range(1, len(rounds)):
        one, two = rounds[i - 1], rounds[i]
        if one is None or two is None or one[1] != two[1] or one[0] == two[0]:
            continue
        before, after = list(trace.points[:i]), list(trace.points[i:])
        for _ in range(MAX_HALVINGS):
            here, there = before[-1], after[0]
            if abs(here.nu - there.nu) < LOOP_TOLERANCE:
                break
            found = _middle_point(tracer, here, there)
            inside = None if found is None else _count_surrounded(tracer, found.turn, problem)
            if found is None or inside not in (one, two):
                break
            if inside == one:
                before.append(found)
            else:
                after.insert(0, found)
        added = len(after) - (len(trace.points) - i) - i  # to the index of each fold
        ahead = replace(trace, points=tuple(after), folds=tuple(k + added for k in trace.folds if k >= i))
        return ContinuationPoints(tuple(before), tuple(k for k in trace.folds if k < i), "stuck"), ahead
    return None


def _count_surrounded(tracer: BranchTracer, turn: ReturnMapPoint, problem: Problems) -> tuple[int, int] | None:
    """Count the critical sets that a cycle surrounds, and all; None if there is nothing to tell."""
    critical = problem(turn.value).critical
    line = line_of(tracer, turn) if len(critical) > 1 else None
    return None if line is None else (sum(surrounds(line, C.p) for C in critical), len(critical))


def _middle_point(tracer: BranchTracer, here: ContinuationPoint, there: ContinuationPoint) -> ContinuationPoint | None:
    """Find the point of the branch half way between two."""
    dx, dn = there.turn.xi - here.turn.xi, there.nu - here.nu
    guess = TurnGuess(
        0.5 * (here.turn.xi + there.turn.xi), 0.5 * (here.nu + there.nu), (dx, dn), here.turn.exponent > 0.0
    )
    found = tracer.closed(guess)
    return None if found is None else tracer.point(found, here.tangent)


LOW_SHARE, ROUNDING_OF_HEIGHT = 3.0, 1e-7  # times the height of the last cycle; ebar that p resolves
SAME_PERIOD_SHARE, SAME_CYCLE_DISTANCE = 1e-5, 1e-4  # of the period, and of the disc: two cycles are one


@dataclass(frozen=True)
class KnownCycle:
    """A cycle as a closed line, and its period."""

    points: Array
    period: float


def is_same_cycle(turn: ReturnMapPoint, cycle: LimitCycle | KnownCycle) -> bool:
    """Whether a closed turn is a cycle that was seen."""
    if abs(turn.period - cycle.period) > SAME_PERIOD_SHARE * cycle.period:
        return False
    return bool(distance(np.array(turn.p), cycle.points) < SAME_CYCLE_DISTANCE)


def distance_along_ray(points: Array, foot: Array, u: Array, near: float) -> float:
    """Return the distance along a ray at which a closed line meets it, next to a given distance."""
    away = points - foot
    side, along = away[:, 0] * u[1] - away[:, 1] * u[0], away @ u
    found = [
        along[i] + (along[j] - along[i]) * side[i] / (side[i] - side[j])
        for i, j in pairwise(range(len(points)))
        if (side[i] < 0.0) != (side[j] < 0.0)
    ]
    return float(min((r for r in found if r > 0.0), key=lambda r: abs(r - near), default=near))


@dataclass(frozen=True)
class RayPiece:
    """A part of a branch that was followed on one ray."""

    tracer: BranchTracer
    trace: ContinuationPoints


def lies_beyond(cycle: LimitCycle | KnownCycle, value: float, last: ReturnMapPoint, end: BranchEnd) -> bool:
    """Whether a cycle lies between the last one of a branch and its limit on the equator, lower than is followed."""
    if not (math.isinf(end.point.period) and min(last.value, end.point.value) <= value):
        return False
    height = math.sqrt(max(1.0 - float((cycle.points**2).sum(axis=1).max()), 0.0))
    return value <= max(last.value, end.point.value) and height < LOW_SHARE * max(last.height, ROUNDING_OF_HEIGHT)


def some_cycles(piece: RayPiece) -> Iterator[tuple[KnownCycle, float]]:
    """Yield three cycles along a piece, and the values at which they are."""
    points = piece.trace.points
    for turn in (points[k * (len(points) - 1) // 4].turn for k in (1, 2, 3)):
        line = line_of(piece.tracer, turn)
        if line is not None:
            yield KnownCycle(line, turn.period), turn.value


def passes(piece: RayPiece, cycle: LimitCycle | KnownCycle, nu: float) -> bool:
    """Whether a piece passes a cycle at nu."""
    closed = (piece.tracer.closed(guess) for _, guess in points_at_value(piece.trace, nu))
    return any(found is not None and is_same_cycle(found.turn, cycle) for found in closed)


def reverse_piece(piece: RayPiece) -> RayPiece:
    """Return a piece followed the other way."""
    return RayPiece(piece.tracer, reversed_trace(piece.trace))
