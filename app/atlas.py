"""The plane (f1, f2) of the pad: bifurcation curves and regions as thinned polylines.

Coordinates are divided by `size`, the largest one on the curves, so that they travel as the other polylines do.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from codim2_core.bifurcations import BifurcationCurve, Region

from .glyphs import join

Points = NDArray[np.float64]
Lines = tuple[NDArray[np.int64], Points]

#: A kept point comes at the latest after this turn (in radians) and this length (of `size`): on a pad of 350 px the
#: chord between two is then within a fifth of a pixel of the curve.
TURN = 0.1
LENGTH = 0.09


def thin(points: Points, size: float, closed: bool = False) -> Points:
    """Leave out points of a polyline that nobody could see; corners and ends stay.

    Parameters
    ----------
    points : ndarray (m, 2)
    size : float
        The length to compare with, positive.
    closed : bool
        Whether the last point is joined to the first, which is not repeated.

    Returns
    -------
    ndarray (k, 2), k <= m
    """
    if len(points) < 4:
        return points
    steps = np.diff(points, axis=0)
    direction = np.arctan2(steps[:, 1], steps[:, 0])
    turn = np.diff(direction)
    turn = abs(turn - 2.0 * np.pi * np.rint(turn / (2.0 * np.pi)))
    length = np.hypot(steps[:, 0], steps[:, 1])
    # how far each inner point is along, counted in allowed turns and lengths: one is kept at each whole number
    along = np.cumsum(turn / TURN + length[:-1] / (LENGTH * size))
    kept = np.ones(len(points), bool)
    kept[1:-1] = np.diff(np.floor(along), prepend=0.0) > 0.0
    # before a corner the point left out would be the one that the corner cuts: keep both its neighbours
    corner = 1 + np.flatnonzero(turn > 3.0 * TURN)
    kept[corner] = True
    kept[np.maximum(corner - 1, 0)] = kept[np.minimum(corner + 1, len(points) - 1)] = True
    if closed:
        kept[-1] = True
    return points[kept]


def size_of(curves: Sequence[BifurcationCurve]) -> float:
    """Return the largest coordinate on the curves, or 1 if they are the point f = 0."""
    return max((float(abs(branch).max()) for curve in curves for branch in curve.branches), default=0.0) or 1.0


def curve_lines(curve: BifurcationCurve, size: float) -> Lines:
    """Return offsets (k + 1,) and points (n, 2), over `size`, of a curve's branches; one of one point is a point."""
    return join([thin(branch, size) / size for branch in curve.branches])


def region_columns(regions: Sequence[Region], size: float) -> dict[str, Any]:
    """Return, for each region, its name, a point well inside, whether it is bounded, and how many loops it has."""
    return {
        "name": [region.name for region in regions],
        "inside": [[round(v / size, 4) for v in region.inside] for region in regions],
        "bounded": [region.bounded for region in regions],
        "loops": [len(region.boundary) for region in regions],
        "size": size,
    }


def region_lines(regions: Sequence[Region], size: float) -> Lines:
    """Return offsets and points, over `size`, of the boundary loops of all regions, in order."""
    return join([thin(loop, size, closed=True) / size for region in regions for loop in region.boundary])
