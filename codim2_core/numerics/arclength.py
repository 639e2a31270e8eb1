"""Curves on which n - 1 functions of n numbers are zero: pseudo-arclength with Newton's method, in double precision.

Edges bound the room in which a curve is followed; its last point lies on the one that it crosses.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..results.arrays import Array
from .sign_changes import root_between

Condition = Callable[[Array], tuple[Array, Array]]  # values (k,) and their derivatives (k, n)

MAX_ROUNDS = 12
NEWTON_TOLERANCE = 1e-12  # correction at which it stops,
ROUNDING_TOLERANCE = 1e-9  # or, where rounding does not let it come so far, at which a point counts as found
MAX_SIZE = 1e3
#: Rounds after which corrections that do not fall faster than this tell of no regular zero.
FREE_ROUNDS, MAX_CORRECTION_RATIO = 3, 0.4


def newton(
    condition: Condition, start: Array, reach: float = math.inf, close: float = NEWTON_TOLERANCE
) -> Array | None:
    """Find a common zero near a start (n,) of at most n functions, by least changes; None if none is within reach."""
    v, size = start, math.inf
    for rounds in range(MAX_ROUNDS):
        value, slope = condition(v)
        if not (np.isfinite(value).all() and np.isfinite(slope).all()):
            return None
        try:
            if len(slope) == len(v):
                change = np.linalg.solve(slope, -value)
            else:
                change = slope.T @ np.linalg.solve(slope @ slope.T, -value)
        except np.linalg.LinAlgError:
            return None
        last, size = size, math.sqrt(change @ change)
        v = v + change
        if not size < MAX_SIZE or math.dist(v, start) > reach:
            return None
        if size < close:
            return v
        if rounds > FREE_ROUNDS and size > MAX_CORRECTION_RATIO * last:
            break
    return v if size < ROUNDING_TOLERANCE else None


def feet(points: Array, line: Array) -> tuple[Array, Array, Array]:
    """Find the nearest place to points (..., n) on each piece of a polyline (m, n): its part, place, distance."""
    start, along = line[:-1], np.diff(line, axis=0)
    away = points[..., None, :] - start
    parts = np.clip((away * along).sum(axis=-1) / np.maximum((along**2).sum(axis=1), 1e-300), 0.0, 1.0)
    shares = parts[..., None] * along
    return parts, start + shares, np.sqrt(((away - shares) ** 2).sum(axis=-1))


def distance(points: Array, line: Array) -> Array:
    """Return the distances of points (..., n) from a polyline (m, n)."""
    return feet(points, line)[2].min(axis=-1)


MIN_STEP, FIRST_STEP_SHARE = 1e-6, 0.2  # shortest step, and the first as a part of the longest
STEP_GROWTH, STEP_SHRINKAGE = 1.5, 0.4
QUICK_ROUNDS = 2  # rounds within which a step was not too long
TARGET_TURN_SHARE = 0.6  # of the largest turn, that the next step is to make
MAX_STRETCH = 2.5  # of the last step: a longer one is predicted by the tangent alone
MIN_SINGULAR_SHARE = 1e-7  # a point is no regular one where the least singular value is so small a part of the largest
EDGE_TOLERANCE = 1e-12  # an edge is crossed beyond this
PLACE_TOLERANCE = 1e-12  # part of a step, of a place between two points


@dataclass(frozen=True)
class CurveEdge:
    """A boundary at which a curve ends."""

    name: str
    of: Callable[[Array], tuple[float, Array]]  # value (negative within) and derivatives (n,) at a point


def square_edges(n: int) -> list[CurveEdge]:
    """Return the edges of the unit square, of the last two of n unknowns."""
    unit, found = np.eye(n), []
    for axis, name in ((n - 2, "across"), (n - 1, "up")):
        found.append(CurveEdge(name, lambda v, k=axis: (-float(v[k]), -unit[k])))
        found.append(CurveEdge(name, lambda v, k=axis: (float(v[k]) - 1.0, unit[k])))
    return found


@dataclass(frozen=True)
class StepBounds:
    """Bounds of the steps along a curve."""

    longest: float
    turn: float  # largest angle between tangents at neighbouring points
    most: int  # points each way
    period: float = math.inf  # of the first coordinate; infinite where it has none
    # correction at which Newton's method stops, or, where rounding does not let it come so far, at which a point
    # counts as found
    close: float = NEWTON_TOLERANCE
    enough: float = ROUNDING_TOLERANCE
    least: float = MIN_STEP  # shortest step

    def apart(self, one: Array, other: Array) -> Array:
        """Return ``other - one``, by the shorter way round."""
        away = other - one
        if self.period < math.inf:
            away[..., 0] -= self.period * np.round(away[..., 0] / self.period)
        return away


@dataclass(frozen=True, eq=False)
class TracedLine:
    """A curve."""

    points: Array  # (m, n) A closed curve ends where it began, but for a period
    closed: bool
    # name of the edge on which each end lies; "lost" where Newton's method went no further, "many" where points
    # were too many, "" of a closed curve
    ends: tuple[str, str]


def tangent(condition: Condition, at: Array) -> Array | None:
    """Return the direction (n,) of the curve through a point on it; None where it is no regular one."""
    slope = condition(at)[1]
    if not np.isfinite(slope).all():
        return None
    _, sizes, rows = np.linalg.svd(slope)
    return rows[-1] if sizes[-1] > MIN_SINGULAR_SHARE * sizes[0] else None


def zero_between(
    condition: Condition, test: Callable[[Array], float], one: Array, other: Array, part: float = PLACE_TOLERANCE
) -> Array:
    """Find the point of a curve between neighbours (n,) at which a function changes its sign."""
    chord = other - one
    normal = chord / max(math.sqrt(chord @ chord), 1e-300)
    found = [one]

    def value(t: float) -> float:
        middle = one + t * chord
        at = point_across(condition, middle, normal)
        found[0] = middle if at is None else at
        return test(found[0])

    value(root_between(value, 0.0, 1.0, part))
    return found[0]


def trace_curve(condition: Condition, start: Array, edges: Sequence[CurveEdge], steps: StepBounds) -> TracedLine | None:
    """Follow a curve both ways from a point (n,) on it; None where that is no regular point."""
    along = tangent(condition, start)
    if along is None:
        return None
    ahead, end = trace_one_way(condition, start, along, edges, steps)
    if not end:
        return TracedLine(np.array([start, *ahead]), True, ("", ""))
    behind, other = trace_one_way(condition, start, -along, edges, steps)
    return TracedLine(np.array([*behind[::-1], start, *ahead]), False, (other or "many", end))


def trace_one_way(
    condition: Condition, start: Array, first: Array, edges: Sequence[CurveEdge], steps: StepBounds
) -> tuple[list[Array], str]:
    """Points along a curve from a start, and where it ends; "" where it has come round."""
    points: list[Array] = []
    here, along, step = start, first, FIRST_STEP_SHARE * steps.longest
    before: tuple[Array, Array] | None = None
    while len(points) < steps.most:
        expected = here + step * along if before is None else _predict(*before, here, along, step)
        found = _correct(condition, expected, along, step, steps)
        if found is None or float(found[1] @ along) < math.cos(steps.turn):
            step *= STEP_SHRINKAGE
            if step < steps.least:
                return points, "lost"
            continue
        there, onward, quick = found
        crossed = [edge for edge in edges if edge.of(there)[0] > EDGE_TOLERANCE]
        if crossed:
            last = _first_edge(condition, here, there, crossed)
            if last is not None:
                return [*points, last[0]], last[1]
            step *= STEP_SHRINKAGE
            if step < steps.least:
                return points, crossed[0].name
            continue
        if len(points) > 2 and _comes_round(steps, start, first, here, there):
            return [*points, there + steps.apart(there, start)], ""
        points.append(there)
        bend = math.acos(min(max(float(onward @ along), -1.0), 1.0))
        before, here, along = (here, along), there, onward
        if quick:
            step = min(step * min(STEP_GROWTH, TARGET_TURN_SHARE * steps.turn / max(bend, 1e-9)), steps.longest)
    return points, "many"


def _predict(before: Array, leaving: Array, here: Array, along: Array, step: float) -> Array:
    """Predict the point a step further by the cubic through the last two points and their tangents."""
    chord = here - before
    length = math.sqrt(chord @ chord)
    if step > MAX_STRETCH * length:
        return here + step * along
    part, away = step / length, length * (leaving + along) - 2.0 * chord
    return here + step * along + part * part * (away + length * along - chord + part * away)


def _correct(
    condition: Condition, expected: Array, along: Array, step: float, steps: StepBounds
) -> tuple[Array, Array, bool] | None:
    """Return the point of a curve across `along` from where it is expected, the tangent, and if that was quick."""
    v, n = expected, len(expected)
    right = np.zeros((n, 2))
    right[-1, 1] = 1.0
    matrix = np.empty((n, n))
    matrix[-1] = along
    size = math.inf
    for rounds in range(MAX_ROUNDS):
        value, slope = condition(v)
        if not (np.isfinite(value).all() and np.isfinite(slope).all()):
            return None
        matrix[:-1] = slope
        right[:-1, 0], right[-1, 0] = -value, -float(along @ (v - expected))
        try:
            change, onward = np.linalg.solve(matrix, right).T
        except np.linalg.LinAlgError:
            return None
        last, size = size, math.sqrt(change @ change)
        v = v + change
        if not size < step:
            return None
        left = size * min(size / last, 1.0) if rounds else size  # of the next correction, at most about
        stalled = rounds > 1 and size > MAX_CORRECTION_RATIO * last
        if left < steps.close or (size < steps.enough and (stalled or rounds == MAX_ROUNDS - 1)):
            return v, onward / math.sqrt(onward @ onward), rounds < QUICK_ROUNDS
    return None


def point_across(condition: Condition, middle: Array, normal: Array, reach: float = math.inf) -> Array | None:
    """Find the point of a curve on the plane through a place across a direction; None if there is none within reach."""

    def both(v: Array) -> tuple[Array, Array]:
        value, slope = condition(v)
        return np.append(value, normal @ (v - middle)), np.vstack([slope, normal])

    return newton(both, middle, reach)


def _first_edge(
    condition: Condition, here: Array, there: Array, crossed: Sequence[CurveEdge]
) -> tuple[Array, str] | None:
    """Find where a step crosses the first of some edges."""
    best: tuple[float, Array, str] | None = None
    chord = there - here
    for edge in crossed:

        def both(v: Array, edge: CurveEdge = edge) -> tuple[Array, Array]:
            value, slope = condition(v)
            level, rise = edge.of(v)
            return np.append(value, level), np.vstack([slope, rise])

        low, high = edge.of(here)[0], edge.of(there)[0]
        part = min(max(-low / (high - low), 0.0), 1.0) if high != low else 0.0
        found = newton(both, here + part * chord, 2.0 * math.sqrt(chord @ chord))
        if found is not None:
            how = float(chord @ (found - here))
            if best is None or how < best[0]:
                best = how, found, edge.name
    return None if best is None else best[1:]


def _comes_round(steps: StepBounds, start: Array, first: Array, here: Array, there: Array) -> bool:
    """Whether a step passes the start in the start's direction."""
    before, after = steps.apart(start, here), steps.apart(start, there)
    long = math.sqrt((there - here) @ (there - here))
    near = max(math.sqrt(before @ before), math.sqrt(after @ after)) < 1.5 * long
    return bool(near and before @ first < 0.0 <= after @ first)
