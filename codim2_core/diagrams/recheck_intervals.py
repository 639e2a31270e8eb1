"""Whether anything changes between two marked values of a diagram: the class of the portrait, all along each interval.

Special values are looked for as zeros of smooth functions on a grid. Two that lie closer together than its steps, or
one next to the end of a branch, may show nothing there. So the class (name, number of limit directions, kind of the
critical set) is compared from one end of every interval between marked values to the other, close to the ends as well;
where it differs, samples are laid around the change, and the zeros are looked for again.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from ..arrays import Array
from .test_functions import SystemPath, classes

BORDER_TOLERANCE = (
    2e-8  # of the span: nearer to a marked value where two borders touch, rounding decides for either side
)
# of an interval: crowded towards both ends, by powers
_HALF_SAMPLES = np.concatenate([np.geomspace(1e-7, 0.1, 13), np.linspace(0.15, 0.5, 6)])
INTERVAL_SAMPLES = np.concatenate([_HALF_SAMPLES, 1.0 - _HALF_SAMPLES[-2::-1]])
MAX_HALVINGS = 40
MAX_CHANGES = 24  # changes: more are made by rounding, where something is degenerate all along
NEIGHBOUR_OFFSETS = np.concatenate(
    [-np.geomspace(1.0, 1e-6, 13), np.geomspace(1e-6, 1.0, 13)]
)  # of the distance to what is next


def samples_beside(path: SystemPath, grid: Array, marked: Array) -> Array:
    """Choose samples that show the changes that are not marked: around each, close to it and as far as the next one.

    Parameters
    ----------
    path : Line
    grid : ndarray (k,)
        In order; where else to look.
    marked : ndarray (n,)
        In order.
    """
    low, high, room = _changes(path, grid, marked)
    around = np.concatenate([low, high, (0.5 * (low + high)[:, None] + room[:, None] * NEIGHBOUR_OFFSETS).ravel()])
    return np.unique(around[(around > grid[0]) & (around < grid[-1])])


def _changes(path: SystemPath, grid: Array, marked: Array) -> tuple[Array, Array, Array]:
    """Brackets of the changes of class that are not marked, and the distance from each to what is next to it."""
    width = float(grid[-1] - grid[0])
    stops = np.concatenate([grid[:1], marked, grid[-1:]])
    low, high, room = [], [], []
    x: list[Array] = []
    owner: list[Array] = []
    for k, (u, v) in enumerate(pairwise(stops.tolist())):
        if v - u <= 4.0 * BORDER_TOLERANCE * width:
            continue
        inside = grid[(grid > u) & (grid < v)]
        places = np.concatenate([u + (v - u) * INTERVAL_SAMPLES, inside])
        places = np.sort(places[(places >= u + BORDER_TOLERANCE * width) & (places <= v - BORDER_TOLERANCE * width)])
        x.append(np.concatenate([[u + BORDER_TOLERANCE * width], places, [v - BORDER_TOLERANCE * width]]))
        owner.append(np.full(len(x[-1]), k))
    if not x:
        return np.zeros(0), np.zeros(0), np.zeros(0)
    values, of = np.concatenate(x), np.concatenate(owner)
    codes = classes(path(values))
    differ = np.flatnonzero((codes[1:] != codes[:-1]) & (of[1:] == of[:-1]) & (codes[1:] >= 0) & (codes[:-1] >= 0))
    if not 0 < len(differ) <= MAX_CHANGES:
        return np.zeros(0), np.zeros(0), np.zeros(0)
    low, high, first = values[differ].copy(), values[differ + 1].copy(), codes[differ]
    room = np.minimum(high - low, width)
    for _ in range(MAX_HALVINGS):
        middle = 0.5 * (low + high)
        same = classes(path(middle)) == first
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return low, high, room
