"""The angle along a curve in the plane, without jumps; near the middle, where there is none, the last one is kept."""

from __future__ import annotations

import numpy as np

from ...results.arrays import Array

LEAST_RADIUS = 1e-6  # of the picture: nearer to its middle a motion followed to 1e-7 is its own error


def angle_along(points: Array, least: float) -> Array:
    """Return the angle of each point of a curve, which changes by less than pi from one to the next.

    Shapes: points (k, 2).
    """
    known = np.flatnonzero(np.hypot(points[:, 0], points[:, 1]) >= least)
    if not len(known):
        return np.zeros(len(points))
    angle = np.unwrap(np.arctan2(points[known, 1], points[known, 0]))
    return angle[np.maximum(np.searchsorted(known, np.arange(len(points)), side="right") - 1, 0)]
