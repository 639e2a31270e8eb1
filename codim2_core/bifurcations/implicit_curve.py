"""Curves on which n - 1 functions of n numbers are zero: pseudo-arclength with Newton's method, in double precision.

Edges bound the room in which a curve is followed; its last point lies on the one that it crosses.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..numerics.root_between import root_between

Array = NDArray[np.float64]
Condition = Callable[[Array], tuple[Array, Array]]  # values (k,) and their derivatives (k, n)

ROUNDS = 12  # of Newton's method
CLOSE = 1e-12  # correction at which it stops,
ENOUGH = 1e-9  # or, where rounding does not let it come so far, at which a point counts as found
FAR = 1e3
PATIENCE, SLOW = 3, 0.4  # rounds after which corrections that do not fall faster than this tell of no regular zero
LEAST_STEP, FIRST_STEP = 1e-6, 0.2  # shortest step, and the first as a part of the longest
GROWTH, SHRINKAGE = 1.5, 0.4
QUICK = 4  # rounds within which a step was not too long
PART = 0.6  # of the largest turn, that the next step is to make
DULL = 1e-7  # a point is no regular one where the least singular value is so small a part of the largest
WITHIN = 1e-12  # an edge is crossed beyond this
SAME = 1e-12  # part of a step, of a place between two points


@dataclass(frozen=True)
class Edge:
    """Where a curve ends.

    Attributes
    ----------
    name : str
    of : callable
        Value (negative within) and derivatives (n,) at a point.
    """

    name: str
    of: Callable[[Array], tuple[float, Array]]


@dataclass(frozen=True)
class Steps:
    """How long steps may be.

    Attributes
    ----------
    longest : float
    turn : float
        Largest angle between tangents at neighbouring points.
    most : int
        Points each way.
    period : float
        Of the first coordinate; infinite where it has none.
    close : float
        Correction at which Newton's method stops.
    least : float
        Shortest step.
    """

    longest: float
    turn: float
    most: int
    period: float = math.inf
    close: float = CLOSE
    least: float = LEAST_STEP

    def apart(self, one: Array, other: Array) -> Array:
        """Return ``other - one``, by the shorter way round."""
        away = other - one
        if self.period < math.inf:
            away[..., 0] -= self.period * np.round(away[..., 0] / self.period)
        return away


@dataclass(frozen=True, eq=False)
class Traced:
    """A curve.

    Attributes
    ----------
    points : ndarray (m, n)
        A closed curve ends where it began, but for a period.
    closed : bool
    ends : (str, str)
        Name of the edge on which each end lies; "lost" where Newton's method went no further, "many" where points were
        too many, "" of a closed curve.
    """

    points: Array
    closed: bool
    ends: tuple[str, str]


def differenced(function: Callable[[Array], float], step: float) -> Condition:
    """Return a condition of one function, whose derivatives are central differences."""

    def condition(v: Array) -> tuple[Array, Array]:
        value = function(v)
        if not math.isfinite(value):
            return np.full(1, math.nan), np.full((1, len(v)), math.nan)
        ways = step * np.eye(len(v))
        slope = [(function(v + way) - function(v - way)) / (2.0 * step) for way in ways]
        return np.array([value]), np.array([slope])

    return condition


def solved(condition: Condition, start: Array, reach: float = math.inf) -> Array | None:
    """Find a common zero of at most n functions of n numbers, by least changes; None if there is none within reach.

    Parameters
    ----------
    condition : callable
    start : ndarray (n,)
    reach : float
        How far from the start it may be.
    """
    v, size = start, math.inf
    for rounds in range(ROUNDS):
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
        if not size < FAR or math.dist(v, start) > reach:
            return None
        if size < CLOSE:
            return v
        if rounds > PATIENCE and size > SLOW * last:
            break
    return v if size < ENOUGH else None


def tangent(condition: Condition, at: Array) -> Array | None:
    """Return the direction (n,) of the curve through a point on it; None where it is no regular one."""
    slope = condition(at)[1]
    if not np.isfinite(slope).all():
        return None
    _, sizes, rows = np.linalg.svd(slope)
    return rows[-1] if sizes[-1] > DULL * sizes[0] else None


def between(condition: Condition, one: Array, other: Array, part: float) -> Array | None:
    """Return the point of a curve on the plane across the chord of two neighbours at a part of it."""
    chord = other - one
    return _across(condition, one + part * chord, chord / max(math.sqrt(chord @ chord), 1e-300))


def zero_between(condition: Condition, test: Callable[[Array], float], one: Array, other: Array) -> Array:
    """Find the point of a curve between two neighbours at which a function changes its sign."""
    found = [one]

    def value(part: float) -> float:
        at = between(condition, one, other, part)
        if at is None:
            at = one + part * (other - one)
        found[0] = at
        return test(at)

    value(root_between(value, 0.0, 1.0, SAME))
    return found[0]


def traced(condition: Condition, start: Array, edges: Sequence[Edge], steps: Steps) -> Traced | None:
    """Follow a curve both ways from a point on it; None where that is no regular point.

    Parameters
    ----------
    condition : callable
    start : ndarray (n,)
    edges : sequence of Edge
    steps : Steps
    """
    along = tangent(condition, start)
    if along is None:
        return None
    ahead, end = followed(condition, start, along, edges, steps)
    if not end:
        return Traced(np.array([start, *ahead]), True, ("", ""))
    behind, other = followed(condition, start, -along, edges, steps)
    return Traced(np.array([*behind[::-1], start, *ahead]), False, (other or "many", end))


def followed(
    condition: Condition, start: Array, first: Array, edges: Sequence[Edge], steps: Steps
) -> tuple[list[Array], str]:
    """Points along a curve from a start, and where it ends; "" where it has come round."""
    points: list[Array] = []
    here, along, step = start, first, FIRST_STEP * steps.longest
    while len(points) < steps.most:
        found = _stepped(condition, here, along, step, steps.close)
        if found is None or float(found[1] @ along) < math.cos(steps.turn):
            step *= SHRINKAGE
            if step < steps.least:
                return points, "lost"
            continue
        there, onward, quick = found
        crossed = [edge for edge in edges if edge.of(there)[0] > WITHIN]
        if crossed:
            last = _first_edge(condition, here, there, crossed)
            if last is not None:
                return [*points, last[0]], last[1]
            step *= SHRINKAGE
            if step < steps.least:
                return points, crossed[0].name
            continue
        if len(points) > 2 and _comes_round(steps, start, first, here, there):
            return [*points, there + steps.apart(there, start)], ""
        points.append(there)
        bend = math.acos(min(max(float(onward @ along), -1.0), 1.0))
        here, along = there, onward
        if quick:
            step = min(step * min(GROWTH, PART * steps.turn / max(bend, 1e-9)), steps.longest)
    return points, "many"


def _stepped(
    condition: Condition, here: Array, along: Array, step: float, close: float
) -> tuple[Array, Array, bool] | None:
    """Return the point a step further, the tangent there, and whether it was found quickly."""
    expected = here + step * along
    v, n = expected, len(here)
    right = np.zeros((n, 2))
    right[-1, 1] = 1.0
    matrix = np.empty((n, n))
    matrix[-1] = along
    for rounds in range(ROUNDS):
        value, slope = condition(v)
        if not (np.isfinite(value).all() and np.isfinite(slope).all()):
            return None
        matrix[:-1] = slope
        right[:-1, 0], right[-1, 0] = -value, -float(along @ (v - expected))
        try:
            change, onward = np.linalg.solve(matrix, right).T
        except np.linalg.LinAlgError:
            return None
        v, size = v + change, math.sqrt(change @ change)
        if not size < step:
            return None
        if size < close or (rounds == ROUNDS - 1 and size < ENOUGH):
            return v, onward / math.sqrt(onward @ onward), rounds < QUICK
    return None


def _across(condition: Condition, middle: Array, normal: Array) -> Array | None:
    def both(v: Array) -> tuple[Array, Array]:
        value, slope = condition(v)
        return np.append(value, normal @ (v - middle)), np.vstack([slope, normal])

    return solved(both, middle)


def _first_edge(condition: Condition, here: Array, there: Array, crossed: Sequence[Edge]) -> tuple[Array, str] | None:
    """Find where a step crosses the first of some edges."""
    best: tuple[float, Array, str] | None = None
    chord = there - here
    for edge in crossed:

        def both(v: Array, edge: Edge = edge) -> tuple[Array, Array]:
            value, slope = condition(v)
            level, rise = edge.of(v)
            return np.append(value, level), np.vstack([slope, rise])

        low, high = edge.of(here)[0], edge.of(there)[0]
        part = min(max(-low / (high - low), 0.0), 1.0) if high != low else 0.0
        found = solved(both, here + part * chord, 2.0 * math.sqrt(chord @ chord))
        if found is not None:
            how = float(chord @ (found - here))
            if best is None or how < best[0]:
                best = how, found, edge.name
    return None if best is None else best[1:]


def _comes_round(steps: Steps, start: Array, first: Array, here: Array, there: Array) -> bool:
    """Whether a step passes the start in the start's direction."""
    before, after = steps.apart(start, here), steps.apart(start, there)
    long = math.sqrt((there - here) @ (there - here))
    near = max(math.sqrt(before @ before), math.sqrt(after @ after)) < 1.5 * long
    return bool(near and before @ first < 0.0 <= after @ first)
