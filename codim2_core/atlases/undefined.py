"""Borders of the part of the plane in which U has a value, as log(k) has one for k > 0 only."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..diagrams.class_maps.classes import Codes
from ..diagrams.class_maps.grid import tree
from ..diagrams.class_maps.trace import chains, traced
from .family import Family

Array = NDArray[np.float64]

ANGLES = 2.0 * np.pi * np.arange(12) / 12.0
PLACES = np.concatenate([r * np.stack([np.cos(ANGLES), np.sin(ANGLES)], axis=-1) for r in (0.0, 0.5, 1.0)])
SIDES, HALVED = 24, 2  # cells of the net, and how often those at a border are halved
HALVINGS = 32  # of an edge, until the border is found on it
FLAT = 1e-6  # a part of the square; what turns less than this is straight


class _Defined:
    """Whether U has a value, as classes: 0, or 1 where it has none."""

    most_cells = 6_000

    def __init__(self, family: Family) -> None:
        self._family = family

    def measured(self, at: Array) -> tuple[Codes, Array]:
        return self.decided(at), np.zeros((0, len(at)))

    def decided(self, at: Array) -> Codes:
        c, s = PLACES[:, :, None].swapaxes(0, 1)
        with np.errstate(all="ignore"):
            U = self._family.speed_on_net(c, s, *at.T)
        return np.asarray(~np.isfinite(U).all(axis=(0, 1)), np.int64)

    def happening(self, before: int, after: int) -> tuple[str, ...]:
        return () if before == after else ("undefined",)


def borders(family: Family) -> list[Array]:
    """Borders, as lines (m, 2) of the unit square; none where U has a value at all places of a net."""
    classes = _Defined(family)
    side = np.linspace(0.0, 1.0, SIDES + 1)
    if not classes.decided(np.stack(np.meshgrid(side, side), axis=-1).reshape(-1, 2)).any():
        return []
    square = (0.0, 1.0), (0.0, 1.0)
    found = traced(classes, tree(classes, square, SIDES, HALVED, 0), square, HALVINGS)
    inner = found.pieces[found.pieces[:, 3] >= 0, :2]
    return [_straightened(found.points[line]) for line in chains(inner)]


def _straightened(line: Array) -> Array:
    """Leave out points between neighbours that lie on a straight line with them."""
    kept = [0]
    for i in range(1, len(line) - 1):
        way, onward = line[i] - line[kept[-1]], line[i + 1] - line[kept[-1]]
        if abs(way[0] * onward[1] - way[1] * onward[0]) > FLAT * np.hypot(*onward):
            kept.append(i)
    return line[[*kept, len(line) - 1]]
