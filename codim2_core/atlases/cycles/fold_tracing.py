"""A fold of cycles over the plane: followed both ways from a start, on as many rays as it takes."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...arrays import Array
from ...continuation.section_base import e_at
from ...curves.arclength import CurveEdge, StepBounds, square_edges, tangent, trace_one_way
from ...curves.newton import newton
from ...cycles.ray import best_crossing
from ...cycles.ray_section import room
from ...families.family import SystemFamily
from ...layer_problem.critical import critical_sets
from .encircling_turns import LOG_SIZE_SCALE, EncirclingTurns

CENTRE = "critical set"  # how a curve ends whose cycles shrink to one
STEP_BOUNDS = StepBounds(0.03, 0.15, 300, close=1e-9, least=1e-5)
MIN_LOG_SIZE, MAX_LOG_SIZE = (
    math.log(6e-3) / LOG_SIZE_SCALE,
    9.0 / LOG_SIZE_SCALE,
)  # x at which cycles have come to the point, to the equator
MAX_SEED_ERROR = 0.3  # in (x, u, v), that a start may be off
MAX_RAYS = 8  # of a curve, each way
RAY_GAIN = 1.3  # times as well another ray is crossed that is worth taking


@dataclass(frozen=True, eq=False)
class CycleStart:
    """The seed of a curve: a place on a ray, near v."""

    around: EncirclingTurns
    v: Array


@dataclass(frozen=True, eq=False)
class FoldCurve:
    """A curve: places (m, 2) in the unit square, sizes (m,) of the cycles, and how both ends come about."""

    plane: Array
    sizes: Array
    ends: tuple[str, str]


def trace_fold(family: SystemFamily, start: CycleStart) -> FoldCurve | None:
    """Return the curve through a start; None if it is not caught."""
    first = newton(start.around.fold, start.v, MAX_SEED_ERROR)
    along = None if first is None else tangent(start.around.fold, first)
    if first is None or along is None or not 0.0 <= min(first[1:]) <= max(first[1:]) <= 1.0:
        return None
    ahead, end = _one_way(family, start.around, first, along)
    if not end:
        behind, other = [], ""
    else:
        behind, other = _one_way(family, start.around, first, -along)
    rows = [*behind[::-1], (start.around, first), *ahead]
    sizes = [found.turn.amplitude if (found := around.turn(v)) is not None else math.nan for around, v in rows]
    return FoldCurve(np.array([v[1:] for _, v in rows]), np.array(sizes), (other, end))


def _one_way(
    family: SystemFamily, around: EncirclingTurns, here: Array, along: Array
) -> tuple[list[tuple[EncirclingTurns, Array]], str]:
    """Places after one, each with its ray, and how the curve ends; "" where it has come round."""
    rows: list[tuple[EncirclingTurns, Array]] = []
    end = "lost"
    for _ in range(MAX_RAYS):
        points, end = trace_one_way(around.fold, here, along, _fold_edges(), STEP_BOUNDS)
        rows += [(around, v) for v in points]
        if end != "lost" or len(points) < 2:
            break
        again = _again(family, around, points[-1], points[-1] - points[-2])
        if again is None:
            break
        around, here, along = again
    return rows, end


def _again(
    family: SystemFamily, around: EncirclingTurns, last: Array, way: Array
) -> tuple[EncirclingTurns, Array, Array] | None:
    """Find the last cycle on a ray that it crosses better, and the direction there; None if there is none."""
    turned, ray = around.turn(last), around.ray(last[1:])
    if turned is None or ray is None:
        return None
    closed = np.concatenate([turned.states, turned.states[:1]])[:, :2]
    arounds = [around, *_encircled_points(family, last[1:], closed)]
    rays = [one.ray(last[1:]) for one in arounds]
    crossed = [(*best_crossing(closed, found.critical), one) for one, found in zip(arounds, rays, strict=True) if found]
    quality, index, best = max(crossed, key=lambda one: one[0])
    step = closed[1] - closed[-2]
    here = abs(float(step[0] * around.u[1] - step[1] * around.u[0])) / max(math.hypot(*step), 1e-300)
    if quality < RAY_GAIN * here:
        return None
    start = _start_on_ray(best, last[1:], closed[index])
    if start is None:
        return None
    found = newton(start.around.fold, start.v, MAX_SEED_ERROR)
    along = None if found is None else tangent(start.around.fold, found)
    if found is None or along is None:
        return None
    return start.around, found, along if float(along[1:] @ way[1:]) > 0.0 else -along


def _encircled_points(family: SystemFamily, place: Array, closed: Array) -> list[EncirclingTurns]:
    """Points inside a cycle: critical sets that are no saddles, others, and its middle."""
    psi, nowhere = family.psi_at(place), np.array([1.0, 0.0])
    sets = sorted(critical_sets(family.frozen(place), psi), key=lambda C: C.kind == "saddle")
    middle = closed[:-1].mean(axis=0)
    x2 = middle / math.sqrt(max(1.0 - float(middle @ middle), 1e-300))
    return [
        *(EncirclingTurns(family, place, np.asarray(C.e), nowhere) for C in sets),
        EncirclingTurns(family, place, e_at(psi, x2), nowhere, critical=False),
    ]


def _start_on_ray(around: EncirclingTurns, place: Array, point: Array) -> CycleStart | None:
    """Return the start at a point of a cycle, on the ray from another point through it."""
    ray = around.ray(place)
    if ray is None:
        return None
    away = point - ray.critical.p
    r = math.hypot(*away)
    turned = around.towards(away / r)
    reach, _ = room(ray.critical, away / r)
    return CycleStart(turned, np.array([math.log(r / max(reach - r, 1e-300)) / LOG_SIZE_SCALE, *place]))


def _fold_edges() -> list[CurveEdge]:
    unit = np.eye(3)
    centre = CurveEdge(CENTRE, lambda v: (MIN_LOG_SIZE - float(v[0]), -unit[0]))
    return [centre, CurveEdge("equator", lambda v: (float(v[0]) - MAX_LOG_SIZE, unit[0])), *square_edges(3)]
