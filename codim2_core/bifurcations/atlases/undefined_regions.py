"""Borders of the part of the plane in which U has a value, as log(k) has one for k > 0 only."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...results.arrays import Array
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
    """Borders, as lines (m, 2) of the unit square; none where U has a value at all places of a net.

    The cells of a finer net are cut into triangles: where U has a value at one corner and none at another, a border
    crosses two of its edges.
    """
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
