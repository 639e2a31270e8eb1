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
MAX_TURN = 0.1
ARROW_LENGTH = 0.09


def thin(pieces: Sequence[Points], size: float) -> Lines:
    """Leave out points of polylines that nobody could see; corners and ends stay. All pieces take one pass.

    Parameters
    ----------
    pieces : sequence of ndarray (m, 2)
    size : float
        The length to compare with, positive.

    Returns
    -------
    offsets (k + 1,), points (n, 2) over `size`
    """
    offsets, points = join(pieces)
    points = points / size
    if len(points) < 4:
        return offsets, points
    steps = points[1:] - points[:-1]
    before, after = steps[:-1], steps[1:]
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    turn = np.abs(np.arctan2(cross, before[:, 0] * after[:, 0] + before[:, 1] * after[:, 1]))
    progress = turn * (1.0 / MAX_TURN) + np.hypot(before[:, 0], before[:, 1]) * (1.0 / ARROW_LENGTH)
    ends = np.concatenate([offsets[:-1], offsets[1:] - 1])
    between = ends[(ends > 0) & (ends < len(points) - 1)] - 1
    turn[between] = progress[between] = 0.0  # the step from one piece to the next is no part of either
    # how far each inner point is along, counted in allowed turns and lengths: one is kept at each whole number
    whole = np.floor(np.cumsum(progress))
    kept = np.ones(len(points), bool)
    kept[1] = whole[0] > 0.0
    kept[2:-1] = whole[1:] > whole[:-1]
    # before a corner the point left out would be the one that the corner cuts: keep both its neighbours
    corner = 1 + np.flatnonzero(turn > 3.0 * MAX_TURN)
    kept[corner] = kept[corner - 1] = kept[corner + 1] = kept[ends] = True
    kept[offsets[:-1][np.diff(offsets) == 3] + 1] = True  # a triangle stays one
    return np.concatenate([[0], np.cumsum(kept)])[offsets], points[kept]


def size_of(curves: Sequence[BifurcationCurve]) -> float:
    """Return the largest coordinate on the curves, or 1 if they are the point f = 0."""
    return max((float(abs(branch).max()) for curve in curves for branch in curve.branches), default=0.0) or 1.0


def curve_lines(curve: BifurcationCurve, size: float) -> Lines:
    """Return offsets (k + 1,) and points (n, 2), over `size`, of a curve's branches; one of one point is a point."""
    return thin(curve.branches, size)


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
    return thin([loop for region in regions for loop in region.boundary], size)
