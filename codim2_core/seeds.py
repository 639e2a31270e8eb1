"""Where the drawn trajectories start: fixed places, so that a seed keeps its identity while a slider moves.

The places show the structure of any portrait: a ring outside, from which every limit direction that attracts is
reached; a ring just inside the equator, where orbits leave it or arrive; and a sunflower over the disc, whose
spacing is even and which no line of symmetry of the normal form cuts twice.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

GOLDEN_ANGLE = math.pi * (3.0 - math.sqrt(5.0))
OUTSIDE_SHARE = 0.375  # of all seeds; the outside ring is longer, its orbits are simpler
OUTSIDE_RADIUS = 0.62  # of the way from the equator to the edge of the view
INSIDE_RADIUS = 0.9


def structured_seeds(count: int, view: float = 2.0) -> NDArray[np.float64]:
    """`count` starting points of the picture, (count, 2), outside first; the same ones on each call.

    Parameters
    ----------
    count : int
        0 to 2000.
    view : float
        Radius of the view, > 1.
    """
    if not 0 <= count <= 2000:
        raise ValueError(f"the number of trajectories is {count}; give 0 to 2000.")
    outside = round(OUTSIDE_SHARE * count)
    inside = count - outside
    # Offset by an irrational part of a turn, so that no seed lies on an axis, where symmetric systems have equilibria.
    angle = 2.0 * math.pi * (np.arange(outside) + 0.381966) / max(outside, 1)
    radius = 1.0 + OUTSIDE_RADIUS * (view - 1.0)
    ring = radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    k = np.arange(inside)
    r, t = INSIDE_RADIUS * np.sqrt((k + 0.5) / max(inside, 1)), GOLDEN_ANGLE * k + 0.4
    flower = np.stack([r * np.cos(t), r * np.sin(t)], axis=-1)
    seeds = np.concatenate([ring, flower]).reshape(count, 2)
    seeds.flags.writeable = False
    return seeds


def checked_seeds(seeds: ArrayLike) -> NDArray[np.float64]:
    """Check seeds: a (k, 2) array of finite picture points; a read-only copy.

    Raises
    ------
    ValueError
        Wrong shape, or a seed that is not finite.
    """
    try:
        points = np.array(seeds, float)
    except (TypeError, ValueError) as error:
        raise ValueError(f"seeds are {seeds!r}; give points of the picture, an array of shape (k, 2).") from error
    if points.size == 0:
        points = points.reshape(0, 2)
    if points.ndim != 2 or points.shape[1] != 2:
        raise ValueError(
            f"seeds have shape {points.shape}; give points of the picture, shape (k, 2): |p| < 1 on the hemisphere, "
            "|p| = 1 + rho outside."
        )
    bad = np.flatnonzero(~np.isfinite(points).all(axis=1))
    if bad.size:
        raise ValueError(f"seed {bad[0]} is {tuple(points[bad[0]])}; every seed needs two finite numbers.")
    points.flags.writeable = False
    return points
