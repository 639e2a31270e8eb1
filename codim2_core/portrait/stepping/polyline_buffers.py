"""The polylines of the lanes as they grow, and of the trajectories that have ended, one behind the other."""

from __future__ import annotations

import math

import numpy as np

from ...formulas.jit import fast_kernel
from .layout import LANES
from .polyline import X, Y, start

BEGUN = -1.0  # in the place of `accepted`, in a lane whose trajectory begins


@fast_kernel
def longer(array):
    """Twice the room along the second axis (of lines) or the first (of a table)."""
    k, n, m = array.shape
    larger = np.empty((k, 2 * n, m))
    for i in range(k):  # assigning a slice would have Numba compile its error messages: seconds
        for j in range(n):
            for c in range(m):
                larger[i, j, c] = array[i, j, c]
    return larger


@fast_kernel
def begin_lines(S, P, cursor, lines, accepted):
    """Put the first point on the line of each lane that begins; K0 is the field there."""
    for k in range(LANES):
        if accepted[k] == BEGUN:
            start(S, P, k, cursor)
            lines[k, 0, 0], lines[k, 0, 1], lines[k, 0, 2] = cursor[X, k], cursor[Y, k], 0.0


@fast_kernel
def length_of(lines, k, first, last):
    """Length of the line of a lane between two of its points."""
    total = 0.0
    for j in range(first, last):
        total += math.hypot(lines[k, j + 1, 0] - lines[k, j, 0], lines[k, j + 1, 1] - lines[k, j, 1])
    return total


@fast_kernel
def end_line(lines, counts, k, sign, ends, i, stop):
    """Put the end of trajectory i on the line of its lane k, unless it is there; the line must not be full."""
    scale = 1.0 + ends[i, 2] if sign > 0.0 else 1.0
    if stop > lines[k, counts[k] - 1, 2] or counts[k] == 1:
        lines[k, counts[k], 0] = scale * ends[i, 0]
        lines[k, counts[k], 1] = scale * ends[i, 1]
        lines[k, counts[k], 2] = stop
        counts[k] += 1


@fast_kernel
def keep_line(store, stored, lines, counts, k):
    """Put the line of a lane behind those that have ended, where there must be room; returns where they end now."""
    for j in range(counts[k]):
        for c in range(3):
            store[0, stored + j, c] = lines[k, j, c]
    return stored + counts[k]


@fast_kernel
def in_order(store, stored, where, length):
    """Lines as they were kept, put in the order of their trajectories: points, times, offsets."""
    n = len(where)
    points, clock, offsets = np.empty((stored, 2)), np.empty(stored), np.zeros(n + 1, np.int64)
    for i in range(n):
        offsets[i + 1] = offsets[i] + length[i]
        for j in range(length[i]):
            points[offsets[i] + j, 0] = store[0, where[i] + j, 0]
            points[offsets[i] + j, 1] = store[0, where[i] + j, 1]
            clock[offsets[i] + j] = store[0, where[i] + j, 2]
    return points, clock, offsets
