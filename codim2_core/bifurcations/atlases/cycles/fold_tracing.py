"""A fold of cycles over the plane: followed both ways from a start, on as many rays as it takes.

Turns about a point of the hemisphere over the plane of two parameters.

A place is v = (x, u, v): x the place on a ray from that point to the equator, ``ln(r/(reach - r))`` over
`LOG_SIZE_SCALE`, and both parameters in the unit square. A cycle closes where `shift` is zero, and is a fold where
its exponent is, too.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from ....numerics.arclength import (
    CurveEdge,
    StepBounds,
    newton,
    point_across,
    square_edges,
    tangent,
    trace_one_way,
    zero_between,
)
from ....portrait.cycles.ray_section import HemispherePoint, Ray, crossing_qualities, room
from ....portrait.layer_problem.critical import critical_sets
from ....portrait.layer_problem.problem import LayerProblem
from ....results.arrays import Array
from ....systems.frozen import FrozenSystem
from ...continuation.turns import FiniteDifference, TurnOrbit, correct_zero, difference, e_at, hemisphere_place, turn
from ...families.family import SystemFamily

LOG_SIZE_SCALE = 20.0  # of x: steps along curves are as long in it as in the unit square
PARAMETER_STEP = 1e-6  # of the square, and of the foot's distance from the equator, for derivatives of the shift
DIFFERENCE_STEPS = np.diag([1e-5, 1e-8, 1e-8])  # for those of the exponent: it may change within a small part of it
MAX_RAY_COORDINATE = 57.0  # |x|
MAX_CACHE_DISTANCE = 0.01  # of the square: so far from where it is known the critical set is kept


class EncirclingTurns:
    """Turns about a critical set that is followed over the plane, or about a point that stays."""

    def __init__(
        self,
        family: SystemFamily,
        place: Array,
        e: Array,
        u: Array,
        critical: bool = True,
        centre: EncirclingTurns | None = None,
    ) -> None:
        self.family, self.u, self.centre = family, u, centre
        self._known = [(np.array(place, float), np.array(e, float))]
        self._still = None if critical else hemisphere_place(family.psi_at(place), self._known[0][1])

    def towards(self, u: Array) -> EncirclingTurns:
        """Return the same in another direction."""
        turned = copy(self)
        turned.u = u
        return turned

    def ray(self, place: Array) -> Ray | None:
        """Return the ray at a place of the square; None where there is none."""
        try:
            at = self.family.frozen(place)
        except ValueError:  # beyond what is allowed
            return None
        psi = self.family.psi_at(place)
        foot = self._still or self._followed(at, place)
        return None if foot is None else Ray(LayerProblem(at, psi), foot, self.u)

    def _followed(self, at: FrozenSystem, place: Array) -> HemispherePoint | None:
        nearest = min(self._known, key=lambda one: math.dist(one[0], place))
        e = correct_zero(at, nearest[1])
        if e is None:
            return None
        if math.dist(nearest[0], place) > MAX_CACHE_DISTANCE:
            self._known.append((place.copy(), e))
        return hemisphere_place(self.family.psi_at(place), e)

    def turn(self, v: Array, slopes: bool = False) -> TurnOrbit | None:
        """Follow one turn, with derivatives of its shift by both parameters if asked; None if it does not return."""
        ray = self.ray(v[1:]) if abs(v[0]) < MAX_RAY_COORDINATE else None
        if ray is None:
            return None
        outer = None if self.centre is None else self.centre.ray(v[1:])
        middle = ray.critical if outer is None else outer.critical
        differences = self._differences(ray, v[1:]) if slopes else []
        if differences is None:
            return None
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            return turn(ray, LOG_SIZE_SCALE * float(v[0]), math.nan, differences, middle, False)

    def _differences(self, ray: Ray, place: Array) -> list[FiniteDifference] | None:
        """Compare the problem on both sides of a place, along each axis."""
        step = PARAMETER_STEP * (1.0 - float(ray.psi.modulus(math.hypot(*ray.critical.x2))))
        found = []
        for way in step * np.eye(2):
            low, high = self.ray(place - way), self.ray(place + way)
            if low is None or high is None:
                return None
            ends, feet = (low.problem, high.problem), (low.critical, high.critical)
            found.append(difference(ends, feet, 2.0 * step, self.u))
        return found

    def exponent(self, v: Array) -> float:
        """Return the exponent of a turn; NaN where it does not return."""
        found = self.turn(v)
        return math.nan if found is None else found.turn.exponent

    def fold(self, v: Array) -> tuple[Array, Array]:
        """Return shift and exponent, both zero on a fold, with derivatives that tell the way; NaN without a turn."""
        found = self.turn(v, slopes=True)
        if found is None:
            return np.full(2, math.nan), np.full((2, 3), math.nan)
        here = np.array([found.turn.shift, found.turn.exponent])
        by_v = [LOG_SIZE_SCALE * found.turn.by_xi, *found.by_values]
        rise = [(self.exponent(v + way) - here[1]) / way.sum() for way in DIFFERENCE_STEPS]
        return here, np.array([by_v, rise])

    def bend(self, v: Array) -> float:
        """Second derivative of the return map, up to a factor: zero at a cusp, where three cycles are one."""
        return self.exponent(v + DIFFERENCE_STEPS[0]) - self.exponent(v - DIFFERENCE_STEPS[0])


CENTRE = "critical set"  # how a curve ends whose cycles shrink to one
CORNER = "corner"  # and one that comes to a saddle-node on the equator
STEP_BOUNDS = StepBounds(0.04, 0.3, 300, close=1e-9, enough=1e-7, least=5e-4)
SHORT_STEPS = replace(STEP_BOUNDS, least=2e-5)  # where no other ray is better
CORNER_DISTANCE = 1.5e-3  # of the square: a curve need not be followed closer to a corner
MIN_EXPONENT_CHANGE = 1e-9  # a difference of exponents that may be rounding's
CUSP_TOLERANCE = 1e-7  # of a step: to which a cusp is found, and the square of it in the plane
#: X at which cycles have come to the point, to the equator.
MIN_LOG_SIZE, MAX_LOG_SIZE = math.log(1.5e-3) / LOG_SIZE_SCALE, 9.0 / LOG_SIZE_SCALE
MAX_SEED_ERROR = 0.3  # in (x, u, v), that a start may be off
MAX_RAYS = 8  # of a curve, each way
MIN_QUALITY, MIN_GAIN = 0.015, 1.0  # of a crossing; of the exponent that a ray is to save
RAY_GAIN = 1.3  # times as well another ray is crossed that is worth taking


@dataclass(frozen=True, eq=False)
class CycleStart:
    """The seed of a curve: a place on a ray, near v; `fixed` where the first fold is looked for at that size."""

    around: EncirclingTurns
    v: Array
    fixed: bool = False


@dataclass(frozen=True, eq=False)
class FoldCurve:
    """A curve."""

    plane: Array  # (m, 2) Of the unit square
    sizes: Array  # (m,) The cycles' largest distances from their point, and least distances from the equator (ebar)
    heights: Array
    cusps: Array  # (k, 2) Where three cycles are one: the curve turns back
    ends: tuple[str, str]  # how both ends come about


def trace_fold(family: SystemFamily, start: CycleStart, corners: Sequence[Array] = ()) -> FoldCurve | None:
    """Return the curve through a start; None if it is not caught. Shapes: corners (2,)."""
    fold = start.around.fold
    # next to a Hopf curve shift and exponent vanish with the size, all along it
    first = point_across(fold, start.v, np.eye(3)[0], MAX_SEED_ERROR) if start.fixed else None
    first = newton(fold, start.v, MAX_SEED_ERROR) if first is None else first
    along = None if first is None else tangent(fold, first)
    if first is None or along is None or not 0.0 <= min(first[1:]) <= max(first[1:]) <= 1.0:
        return None
    edges = _fold_edges(corners)
    ahead, end = _one_way(family, start.around, first, along, edges)
    if not end:
        behind, other = [], ""
    else:
        behind, other = _one_way(family, start.around, first, -along, edges)
    rows = [*behind[::-1], (start.around, first), *ahead]
    found = [(*row, around.turn(row[1])) for row in rows for around in [row[0]]]
    kept = [(around, v, one.turn) for around, v, one in found if one is not None]
    if len(kept) < 2:
        return None
    cusps = _cusps([(around, v) for around, v, _ in kept])
    places = [v[1:] for _, v, _ in kept]
    sizes, heights = ([getattr(turn, name) for *_, turn in kept] for name in ("amplitude", "height"))
    for i, v in reversed(cusps):
        places.insert(i + 1, v[1:])
        sizes.insert(i + 1, 0.5 * (sizes[i] + sizes[i + 1]))
        heights.insert(i + 1, min(heights[i], heights[i + 1]))
    turned_back = np.reshape([v[1:] for _, v in cusps], (-1, 2))
    return FoldCurve(np.array(places), np.array(sizes), np.array(heights), turned_back, (other, end))


def _cusps(rows: Sequence[tuple[EncirclingTurns, Array]]) -> list[tuple[int, Array]]:
    """Find the cusps on a curve: the point after which each comes, and its place; a step may have passed two."""
    bends = np.array([around.bend(v) for around, v in rows])
    sure = np.flatnonzero(np.abs(bends) > MIN_EXPONENT_CHANGE).tolist()
    steps = np.diff([rows[i][1][1:] for i in sure], axis=0)
    found = []
    for k, (i, j) in enumerate(pairwise(sure)):
        (around, one), (onward, other) = rows[i], rows[j]
        if onward is not around:
            continue
        part = [(one, bends[i] < 0.0), (other, bends[j] < 0.0)]
        if 0 < k < len(steps) - 1 and max(steps[k] @ steps[k - 1], steps[k] @ steps[k + 1]) < 0.0:
            middle = newton(around.fold, 0.5 * (one + other), MAX_SEED_ERROR)
            part[1:1] = [] if middle is None else [(middle, around.bend(middle) < 0.0)]
        for (here, before), (there, after) in pairwise(part):
            if before != after:
                found.append((i, zero_between(around.fold, around.bend, here, there, CUSP_TOLERANCE)))
    return found


def _one_way(
    family: SystemFamily, around: EncirclingTurns, here: Array, along: Array, edges: Sequence[CurveEdge]
) -> tuple[list[tuple[EncirclingTurns, Array]], str]:
    """Places after one, each with its ray, and how the curve ends; "" where it has come round."""
    rows: list[tuple[EncirclingTurns, Array]] = []
    end, bounds = "lost", STEP_BOUNDS
    for _ in range(MAX_RAYS):
        points, end = trace_one_way(around.fold, here, along, edges, bounds)
        rows += [(around, v) for v in points]
        if end != "lost":
            break
        last, before = (points[-1], points[-2]) if len(points) > 1 else (points[0], here) if points else (here, None)
        way = along if before is None else last - before
        again = _again(family, around, last, way)
        if again is not None:
            (around, here, along), bounds = again, STEP_BOUNDS
        elif bounds is SHORT_STEPS:
            break
        else:
            here, along, bounds = last, way / max(math.hypot(*way), 1e-300), SHORT_STEPS
    return rows, end


def _again(
    family: SystemFamily, around: EncirclingTurns, last: Array, way: Array
) -> tuple[EncirclingTurns, Array, Array] | None:
    """Find the last cycle on a ray that it crosses better, and the direction there; None if there is none."""
    turned, ray = around.turn(last), around.ray(last[1:])
    if turned is None or ray is None:
        return None
    closed = np.concatenate([turned.states, turned.states[:1]])[:, :2]
    arounds = [around, *_encircled_points(family, last[1:], closed, around.centre or around)]
    rays = [one.ray(last[1:]) for one in arounds]
    crossed = [
        (crossing_qualities(closed, found.critical), one) for one, found in zip(arounds, rays, strict=True) if found
    ]
    step = closed[1] - closed[-2]
    here = abs(float(step[0] * around.u[1] - step[1] * around.u[0])) / max(math.hypot(*step), 1e-300)
    # from a state a change grows by exp(left - min left) on its way, and by exp(max left - left) comes what is new
    uneven = np.abs(turned.left - 0.5 * (turned.left.max() + turned.left.min()))
    gain, index, best = max(
        ((float(uneven[-1] - at[i]), i, one) for quality, one in crossed
         for at in [np.where(quality > MIN_QUALITY, uneven, math.inf)] for i in [int(at.argmin())]),
        key=lambda one: one[0],
    )  # fmt: skip
    if gain < MIN_GAIN:
        quality, index, best = max(
            ((float(quality.max()), int(quality.argmax()), one) for quality, one in crossed), key=lambda one: one[0]
        )
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


def _encircled_points(
    family: SystemFamily, place: Array, closed: Array, centre: EncirclingTurns
) -> list[EncirclingTurns]:
    """Points inside a cycle: critical sets that are no saddles, others, and its middle."""
    psi, nowhere = family.psi_at(place), np.array([1.0, 0.0])
    sets = sorted(critical_sets(family.frozen(place), psi), key=lambda C: C.kind == "saddle")
    middle = closed[:-1].mean(axis=0)
    x2 = middle / math.sqrt(max(1.0 - float(middle @ middle), 1e-300))
    return [
        *(EncirclingTurns(family, place, np.asarray(C.e), nowhere, True, centre) for C in sets),
        EncirclingTurns(family, place, e_at(psi, x2), nowhere, False, centre),
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


def _fold_edges(corners: Sequence[Array]) -> list[CurveEdge]:
    unit = np.eye(3)

    def nearness(v: Array, corner: Array) -> tuple[float, Array]:
        away = v[1:] - corner
        gap = math.hypot(*away)
        return CORNER_DISTANCE - gap, np.array([0.0, *(-away / max(gap, 1e-300))])

    return [
        CurveEdge(CENTRE, lambda v: (MIN_LOG_SIZE - float(v[0]), -unit[0])),
        CurveEdge("equator", lambda v: (float(v[0]) - MAX_LOG_SIZE, unit[0])),
        *(CurveEdge(CORNER, lambda v, corner=corner: nearness(v, corner)) for corner in corners),
        *square_edges(3),
    ]
