"""Seeds of drawn trajectories: fixed places, so that a seed keeps its identity while a slider moves.

The places show the structure of any portrait: a ring outside, from which every limit direction that attracts is
reached, and rings over the disc, evenly spaced. They are symmetric about both axes, as the normal form is for b = 0
with f on an axis, and no seed lies on an axis, where such systems have their equilibria.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

OUTSIDE_SHARE = 0.375  # of all seeds; outside, orbits are simpler
OUTSIDE_RADIUS = 0.62  # of the way from the equator to the edge of the view
INSIDE_RADIUS = 0.93  # of the outermost ring on the hemisphere


def ring(radius: float, count: int) -> NDArray[np.float64]:
    """`count` points at even angles on a circle about the origin, none on the first axis; (count, 2)."""
    angle = 2.0 * math.pi * (np.arange(count) + 0.5) / max(count, 1)
    return radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def _ring_sizes(count: int) -> list[int]:
    """Points on each ring, outermost first: in proportion to the radii 1, 1 - 1/R, ..., multiples of 4 but one."""
    rings = max(1, round(math.sqrt(count / 4.0)))
    weights = [rings - j for j in range(rings)]
    sizes = [4 * round(count * w / sum(weights) / 4.0) for w in weights]
    sizes[0] += count - sum(sizes)
    return sizes


@lru_cache(maxsize=32)
def structured_seeds(count: int, view: float = 2.0) -> NDArray[np.float64]:
    """`count` starting points of the picture, (count, 2), outside first; the same ones on each call."""
    if not 0 <= count <= 2000:
        raise ValueError(f"the number of trajectories is {count}; give 0 to 2000.")
    outside = round(OUTSIDE_SHARE * count)
    parts = [ring(1.0 + OUTSIDE_RADIUS * (view - 1.0), outside)]
    sizes = _ring_sizes(count - outside)
    parts += [ring(INSIDE_RADIUS * (1.0 - j / len(sizes)), size) for j, size in enumerate(sizes)]
    seeds = np.concatenate(parts)
    seeds.flags.writeable = False
    return seeds


@lru_cache(maxsize=32)
def window_seeds(count: int, window: tuple[float, float, float, float]) -> NDArray[np.float64]:
    """Return about `count` starting points (k, 2) spread evenly over a rectangle, the same ones on each call."""
    left, right, bottom, top = window
    side = math.sqrt((right - left) * (top - bottom) / max(count, 1))
    columns, rows = max(1, round((right - left) / side)), max(1, round((top - bottom) / side))
    i, j = np.divmod(np.arange(columns * rows if count else 0), rows)
    # every other column is shifted by half a cell, so that no line of seeds lies along an orbit for long
    x = left + (right - left) * (i + 0.5) / columns
    y = bottom + (top - bottom) * ((j + 0.25 + 0.5 * (i % 2)) / rows)
    seeds = np.column_stack([x, y])
    seeds.flags.writeable = False
    return seeds


def checked_seeds(seeds: ArrayLike) -> NDArray[np.float64]:
    """Check seeds: a (k, 2) array of finite picture points; a read-only copy.

    Raises ValueError: Wrong shape, or a seed that is not finite.
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
    if not np.isfinite(points).all():
        bad = np.flatnonzero(~np.isfinite(points).all(axis=1))[0]
        raise ValueError(f"seed {bad} is {tuple(points[bad])}; every seed needs two finite numbers.")
    points.flags.writeable = False
    return points
