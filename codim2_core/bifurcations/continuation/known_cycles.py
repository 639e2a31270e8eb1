"""Cycles as closed lines: whether two are one, and where one meets a ray."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ...numerics.curves.polyline import distance
from ...portrait.cycles.limit_cycles import LimitCycle
from ...results.arrays import Array
from .continuation_points import ReturnMapPoint

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
