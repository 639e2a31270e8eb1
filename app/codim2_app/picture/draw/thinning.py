"""Polylines of a chart without the points that nobody could see."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from .glyphs import join

Points = NDArray[np.float64]
Lines = tuple[NDArray[np.int64], Points]

#: A kept point comes at the latest after this turn (in radians) and this length, on a chart from -1 to 1: at 350 px the
#: chord between two is then within a fifth of a pixel of the curve.
MAX_TURN = 0.1
ARROW_LENGTH = 0.09


def thin(pieces: Sequence[Points]) -> Lines:
    """Return offsets (k + 1,) and the points (n, 2) of pieces (m, 2) that somebody could see; corners and ends stay."""
    offsets, points = join(pieces)
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
