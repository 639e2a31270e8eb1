"""Borders between classes of portraits that no equation of a regular curve has, followed by bisection.

Where U vanishes to higher order than a fold asks for, all along a curve, Newton's method finds no regular zero, and the
portrait changes all the same.

So are the borders of the part of the plane in which U has a value, as log(k) has one for k > 0 only.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import count

import numpy as np
from numpy.typing import NDArray

from ...numerics.arclength import distance
from ...results.arrays import Array
from ..diagrams.classes import classes_over
from ..families.family import SystemFamily

Indices = NDArray[np.intp]

CIRCLE_ANGLES = 2.0 * np.pi * np.arange(12) / 12.0
TRIAL_PLACES = np.concatenate(
    [r * np.stack([np.cos(CIRCLE_ANGLES), np.sin(CIRCLE_ANGLES)], axis=-1) for r in (0.0, 0.5, 1.0)]
)
#: Cells along each side of a first net, and of that by which borders are found.
FIRST_NET_CELLS, BORDER_NET_CELLS = 24, 96
EDGE_INSET = 1e-7  # what lies on the very edge of the square is decided just inside
MAX_HALVINGS = 32  # of an edge, until the border is found on it
MIN_BEND = 1e-6  # a part of the square; what turns less than this is straight


def undefined_borders(family: SystemFamily) -> list[Array]:
    """Return borders (m, 2) of where U has a value: they cross triangles of a net of which one corner has none."""
    if _is_defined(family, _net(FIRST_NET_CELLS)).all():
        return []
    places = _net(BORDER_NET_CELLS)
    known = _is_defined(family, places)
    first = (np.arange(BORDER_NET_CELLS)[:, None] * (BORDER_NET_CELLS + 1) + np.arange(BORDER_NET_CELLS)).ravel()
    right, up, across = first + BORDER_NET_CELLS + 1, first + 1, first + BORDER_NET_CELLS + 2
    triangles = np.concatenate([np.stack([first, right, across], axis=1), np.stack([first, across, up], axis=1)])
    edges = np.sort(np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=-1), axis=-1)
    crossed = known[edges[..., 0]] != known[edges[..., 1]]  # two of a triangle, or none
    unique, pieces = np.unique(edges[crossed], axis=0, return_inverse=True)
    points = _edge_crossings(family, places[unique[:, 0]], places[unique[:, 1]], known[unique[:, 0]])
    return [_straighten(points[line]) for line in _chains(pieces.reshape(-1, 2))]


def _net(cells: int) -> Array:
    side = np.linspace(0.0, 1.0, cells + 1)
    return np.stack(np.meshgrid(side, side, indexing="ij"), axis=-1).reshape(-1, 2)


def _is_defined(family: SystemFamily, at: Array) -> NDArray[np.bool_]:
    """Whether U has a value at places (k, 2) of the square."""
    c, s = TRIAL_PLACES[:, :, None].swapaxes(0, 1)
    with np.errstate(all="ignore"):
        U = family.speed_on_net(c, s, *np.clip(at, EDGE_INSET, 1.0 - EDGE_INSET).T)
    return np.asarray(np.isfinite(U).all(axis=(0, 1)))


def _edge_crossings(family: SystemFamily, start: Array, end: Array, known: NDArray[np.bool_]) -> Array:
    """Places (k, 2) on edges at which U begins, or ceases, to have a value; `known`: it has one at the start."""
    low, high = np.zeros(len(start)), np.ones(len(start))
    for _ in range(MAX_HALVINGS):
        t = 0.5 * (low + high)
        same = _is_defined(family, start + t[:, None] * (end - start)) == known
        low, high = np.where(same, t, low), np.where(same, high, t)
    return start + 0.5 * (low + high)[:, None] * (end - start)


def _chains(pairs: Indices) -> list[list[int]]:
    """Join pieces (from, to) to lines as long as they go on without a fork; closed ones repeat their first point."""
    near: dict[int, list[int]] = {}
    for u, v in pairs.tolist():
        near.setdefault(u, []).append(v)
        near.setdefault(v, []).append(u)
    lines = []
    for start in [u for u, others in near.items() if len(others) != 2] + list(near):
        while near[start]:
            line = [start]
            while near[line[-1]]:
                here = line[-1]
                then = near[here].pop()
                near[then].remove(here)
                line.append(then)
                if len(near[then]) != 1:
                    break
            lines.append(line)
    return lines


def _straighten(line: Array) -> Array:
    """Leave out points between neighbours that lie on a straight line with them."""
    kept = [0]
    for i in range(1, len(line) - 1):
        way, onward = line[i] - line[kept[-1]], line[i + 1] - line[kept[-1]]
        if abs(way[0] * onward[1] - way[1] * onward[0]) > MIN_BEND * np.hypot(*onward):
            kept.append(i)
    return line[[*kept, len(line) - 1]]


MAX_PLACES = 4  # next to which a border is looked for
FIRST_REACH, MAX_REACH = 1e-3, 0.6  # of the square, along each axis
KNOWN_DISTANCE = 4e-3  # of the square: a border that lies so near to a curve, or to another border, is known
BORDER_STEP, MIN_BORDER_STEP = 0.01, 1e-3  # of the square, along a border
MAX_BORDER_STEPS = 240  # each way
MAX_PORTRAITS, NOT_ASKED = 2000, -2  # that are looked at in all; what each is after these
STEP_HALVINGS = 9  # of a step: to so small a part a border is found
MIN_COSINE = 0.7  # between directions of a border, from one step to the next

ClassAt = Callable[[Array], int]


def class_borders(family: SystemFamily, unlike: Sequence[tuple[float, float]], known: Sequence[Array]) -> list[Array]:
    """Return borders (m, 2) in the square around places (values) whose class is not that of their region.

    Shapes: known (m, 2), curves of the square that are followed already.
    """
    classes = classes_over(family.system, family.psi, family.z, family.names, family.ranges)

    asked = count(1)

    def class_at(u: Array) -> int:
        return int(classes.decided(family.values(u)[None])[0]) if next(asked) < MAX_PORTRAITS else NOT_ASKED

    found: list[Array] = []
    for place in unlike[:MAX_PLACES]:
        start = family.units(np.array(place))
        own = class_at(start)
        for way in (*np.eye(2), *-np.eye(2)):
            at = _border_along(class_at, own, start, way)
            if at is None or any(distance(at, line) < KNOWN_DISTANCE for line in (*known, *found)):
                continue
            both = (_follow_border(class_at, at, way, sense) for sense in (1.0, -1.0))
            ahead, behind = (_until_known(points, known) for points in both)
            line = np.array([*reversed(behind), at, *ahead])
            found += [line] if len(line) > 2 else []
    return found


def _border_along(class_at: ClassAt, own: int, start: Array, way: Array) -> Array | None:
    """Find where the class of a place ends along one direction; None if it does not within reach."""
    low, high = 0.0, FIRST_REACH
    while _in_square(start + high * way) and class_at(start + high * way) == own:
        low, high = high, 1.5 * high
        if high > MAX_REACH:
            return None
    if not _in_square(start + high * way):
        return None
    return _bisect(class_at, own, start + low * way, start + high * way)


def _bisect(class_at: ClassAt, own: int, inside: Array, outside: Array) -> Array:
    """Return the border between a place of a class and one of another."""
    for _ in range(STEP_HALVINGS):
        middle = 0.5 * (inside + outside)
        inside, outside = (middle, outside) if class_at(middle) == own else (inside, middle)
    return 0.5 * (inside + outside)


def _follow_border(class_at: ClassAt, start: Array, out: Array, sense: float) -> list[Array]:
    """Return places along a border, to where it ends or leaves the square; classes on its two sides may change."""
    points: list[Array] = []
    here, step = start, BORDER_STEP
    while len(points) < MAX_BORDER_STEPS and step >= MIN_BORDER_STEP:
        middle = here + step * sense * np.array([-out[1], out[0]])
        if not _in_square(middle):
            edge = _on_frame(here, middle)
            return [*points, edge] if np.hypot(*(edge - here)) > 0.0 else points
        inside, outside = (np.clip(middle + side * step * out, 0.0, 1.0) for side in (-1.0, 1.0))
        own = class_at(inside)
        there = None if class_at(outside) == own else _bisect(class_at, own, inside, outside)
        away = here - here if there is None else there - here
        onward = sense * np.array([away[1], -away[0]]) / max(np.hypot(*away), 1e-300)
        if there is None or onward @ out < MIN_COSINE:
            step *= 0.5
            continue
        here, out = there, onward
        points.append(here)
        step = min(1.5 * step, BORDER_STEP)
    return points


def _until_known(points: list[Array], known: Sequence[Array]) -> list[Array]:
    """Return places up to where they go on along a curve that is known."""
    if not points or not known:
        return points
    near = np.min([distance(np.array(points), line) for line in known], axis=0) < KNOWN_DISTANCE
    along = np.flatnonzero(near[:-1] & near[1:])
    return points[: int(along[0]) + 1] if len(along) else points


def _on_frame(here: Array, beyond: Array) -> Array:
    """Return where a step leaves the square."""
    away = beyond - here
    with np.errstate(divide="ignore", invalid="ignore"):
        parts = np.where(away > 0.0, (1.0 - here) / away, np.where(away < 0.0, -here / away, np.inf))
    return np.clip(here + parts.min() * away, 0.0, 1.0)


def _in_square(u: Array) -> bool:
    return bool(u.min() >= 0.0 and u.max() <= 1.0)
