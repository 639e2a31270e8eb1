"""Cycles as closed lines: whether two are one, where one meets a ray, and which a piece of a branch passes."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ...numerics.curves.arclength import distance
from ...portrait.cycles.limit_cycles import LimitCycle
from ...results.arrays import Array
from .branch_ends import BranchEnd
from .corrector import BranchTracer
from .homoclinic_detection import line_of
from .turns import ContinuationPoints, ReturnMapPoint, points_at_value, reversed_trace

LOW_SHARE, ROUNDING_OF_HEIGHT = 3.0, 1e-7  # times the height of the last cycle; ebar that p tells
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
