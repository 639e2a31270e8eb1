"""A fold of cycles over the plane: followed both ways from a start, on as many rays as it takes."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...continuation.typed.foot import e_at
from ...continuation.typed.ray import best_crossing, room
from ...curves.arclength import Edge, Steps, square_edges, tangent, trace_one_way
from ...curves.newton import newton
from ...layer_problem.critical import critical_sets
from ..family import Family
from .around import SCALE, Around

Array = NDArray[np.float64]

CENTRE = "critical set"  # how a curve ends whose cycles shrink to one
STEPS = Steps(0.03, 0.15, 300, close=1e-9, least=1e-5)
INNER, OUTER = math.log(6e-3) / SCALE, 9.0 / SCALE  # x at which cycles have come to the point, to the equator
REACH = 0.3  # in (x, u, v), that a start may be off
RAYS = 8  # of a curve, each way
BETTER = 1.3  # times as well another ray is crossed that is worth taking


@dataclass(frozen=True, eq=False)
class Start:
    """The seed of a curve: a place on a ray, near v."""

    around: Around
    v: Array


@dataclass(frozen=True, eq=False)
class Curve:
    """A curve: places (m, 2) in the unit square, sizes (m,) of the cycles, and how both ends come about."""

    plane: Array
    sizes: Array
    ends: tuple[str, str]


def trace_fold(family: Family, start: Start) -> Curve | None:
    """Return the curve through a start; None if it is not caught."""
    first = newton(start.around.fold, start.v, REACH)
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
    return Curve(np.array([v[1:] for _, v in rows]), np.array(sizes), (other, end))


def _one_way(family: Family, around: Around, here: Array, along: Array) -> tuple[list[tuple[Around, Array]], str]:
    """Places after one, each with its ray, and how the curve ends; "" where it has come round."""
    rows: list[tuple[Around, Array]] = []
    end = "lost"
    for _ in range(RAYS):
        points, end = trace_one_way(around.fold, here, along, _edges(), STEPS)
        rows += [(around, v) for v in points]
        if end != "lost" or len(points) < 2:
            break
        again = _again(family, around, points[-1], points[-1] - points[-2])
        if again is None:
            break
        around, here, along = again
    return rows, end


def _again(family: Family, around: Around, last: Array, way: Array) -> tuple[Around, Array, Array] | None:
    """Find the last cycle on a ray that it crosses better, and the direction there; None if there is none."""
    turned, ray = around.turn(last), around.ray(last[1:])
    if turned is None or ray is None:
        return None
    closed = np.concatenate([turned.states, turned.states[:1]])[:, :2]
    arounds = [around, *_inside(family, last[1:], closed)]
    rays = [one.ray(last[1:]) for one in arounds]
    crossed = [(*best_crossing(closed, found.critical), one) for one, found in zip(arounds, rays, strict=True) if found]
    quality, index, best = max(crossed, key=lambda one: one[0])
    step = closed[1] - closed[-2]
    here = abs(float(step[0] * around.u[1] - step[1] * around.u[0])) / max(math.hypot(*step), 1e-300)
    if quality < BETTER * here:
        return None
    start = _start_on_ray(best, last[1:], closed[index])
    if start is None:
        return None
    found = newton(start.around.fold, start.v, REACH)
    along = None if found is None else tangent(start.around.fold, found)
    if found is None or along is None:
        return None
    return start.around, found, along if float(along[1:] @ way[1:]) > 0.0 else -along


def _inside(family: Family, place: Array, closed: Array) -> list[Around]:
    """Points inside a cycle: critical sets that are no saddles, others, and its middle."""
    psi, nowhere = family.psi_at(place), np.array([1.0, 0.0])
    sets = sorted(critical_sets(family.frozen(place), psi), key=lambda C: C.kind == "saddle")
    middle = closed[:-1].mean(axis=0)
    x2 = middle / math.sqrt(max(1.0 - float(middle @ middle), 1e-300))
    return [
        *(Around(family, place, np.asarray(C.e), nowhere) for C in sets),
        Around(family, place, e_at(psi, x2), nowhere, critical=False),
    ]


def _start_on_ray(around: Around, place: Array, point: Array) -> Start | None:
    """Return the start at a point of a cycle, on the ray from another point through it."""
    ray = around.ray(place)
    if ray is None:
        return None
    away = point - ray.critical.p
    r = math.hypot(*away)
    turned = around.towards(away / r)
    reach, _ = room(ray.critical, away / r)
    return Start(turned, np.array([math.log(r / max(reach - r, 1e-300)) / SCALE, *place]))


def _edges() -> list[Edge]:
    unit = np.eye(3)
    centre = Edge(CENTRE, lambda v: (INNER - float(v[0]), -unit[0]))
    return [centre, Edge("equator", lambda v: (float(v[0]) - OUTER, unit[0])), *square_edges(3)]
