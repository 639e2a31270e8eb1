"""Place arrowheads on curves where there is room, so that curves that run together do not pile them up."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from codim2_core.formulas.jit import kernel

#: In px: how far apart arrowheads are at least, how long a curve is for each that it carries, and at least for one.
CLEARANCE, STRETCH, MIN_LINE_LENGTH = 24.0, 300.0, 16.0
#: Where on its stretch of the curve an arrowhead is tried, as fractions, until there is room.
CANDIDATE_SHARES = np.array([0.5, 0.64, 0.36, 0.78, 0.22, 0.9, 0.1])


def arrowheads(
    offsets: NDArray[np.int64], points: NDArray[np.float64], pixel: float, window: tuple[float, float, float, float]
) -> NDArray[np.float64]:
    """Place arrowheads on curves.

    Parameters
    ----------
    offsets : ndarray (k + 1,)
    points : ndarray (n, 2)
        Curve i is ``points[offsets[i]:offsets[i + 1]]``, in order of increasing time.
    pixel : float
        Size of a pixel in picture units.
    window : (left, right, bottom, top)
        What is seen; there are no arrowheads beyond.

    Returns
    -------
    ndarray (l, 3)
        x, y and direction in radians; no two are nearer than `CLEARANCE`.
    """
    return _place_arrowheads(
        *of_one_type(offsets, points),
        CLEARANCE * pixel,
        STRETCH * pixel,
        MIN_LINE_LENGTH * pixel,
        CANDIDATE_SHARES,
        *map(float, window),
    )


def of_one_type(
    offsets: NDArray[np.int64], points: NDArray[np.float64]
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Return both as kernels take them: arrays of one type, and so one compilation for all that come."""
    offsets, points = np.ascontiguousarray(offsets, np.int64)[:], np.ascontiguousarray(points, np.float64)[:]
    offsets.flags.writeable = points.flags.writeable = False
    return offsets, points


@kernel
def _place_arrowheads(offsets, points, clearance, stretch, shortest, tried, left, right, bottom, top):
    """Try places one after the other; a grid of cells as wide as the clearance tells which arrowheads are near."""
    columns, rows = int((right - left) / clearance) + 3, int((top - bottom) / clearance) + 3
    newest = np.zeros(columns * rows, np.int64)  # of the arrowheads in a cell, from 1; `older` leads to the one before
    travelled = np.zeros(len(points))
    total = 0
    for piece in range(len(offsets) - 1):
        for i in range(offsets[piece] + 1, offsets[piece + 1]):
            dx, dy = points[i, 0] - points[i - 1, 0], points[i, 1] - points[i - 1, 1]
            travelled[i] = travelled[i - 1] + math.sqrt(dx * dx + dy * dy)
        if offsets[piece + 1] > offsets[piece]:
            total += max(1, int(travelled[offsets[piece + 1] - 1] / stretch + 0.5))
    heads = np.empty((total, 3))
    older = np.zeros(total + 1, np.int64)
    count = 0
    for piece in range(len(offsets) - 1):
        first, last = offsets[piece], offsets[piece + 1] - 1
        if last <= first or travelled[last] <= shortest:
            continue
        slots = max(1, int(travelled[last] / stretch + 0.5))
        begin = first  # the step on which the last slot began
        for slot in range(slots):
            for k in range(len(tried)):
                target = travelled[last] * (slot + tried[k]) / slots
                low, high = begin, last
                while high - low > 1:
                    middle = (low + high) // 2
                    if travelled[middle] < target:
                        low = middle
                    else:
                        high = middle
                length = travelled[low + 1] - travelled[low]
                if not length > 0.0:
                    continue
                share = (target - travelled[low]) / length
                dx, dy = points[low + 1, 0] - points[low, 0], points[low + 1, 1] - points[low, 1]
                x, y = points[low, 0] + share * dx, points[low, 1] + share * dy
                if not (left <= x <= right and bottom <= y <= top):
                    continue
                column, row = int((x - left) / clearance) + 1, int((y - bottom) / clearance) + 1
                free = True
                for i in range(column - 1, column + 2):
                    for j in range(row - 1, row + 2):
                        other = newest[i * rows + j]
                        while other > 0:
                            away_x, away_y = heads[other - 1, 0] - x, heads[other - 1, 1] - y
                            if away_x * away_x + away_y * away_y < clearance * clearance:
                                free = False
                                break
                            other = older[other]
                if free:
                    heads[count, 0], heads[count, 1], heads[count, 2] = x, y, math.atan2(dy, dx)
                    cell = column * rows + row
                    count += 1
                    older[count] = newest[cell]
                    newest[cell] = count
                    break
    return heads[:count]
