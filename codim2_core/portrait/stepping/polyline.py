"""The drawn polyline: points on the dense output, as far apart as the curve allows.

A chord of length L whose end tangents make angles alpha and beta with it stays within ``L max(sin)/4`` of the curve:
exactly the sagitta for an arc, twice the truth for an S. Spacing runs on across steps of the integrator, so that a
straight leg has few points however many steps it took.
"""

from __future__ import annotations

import math

import numpy as np

from ...formulas.jit import fast_kernel
from .dop853 import dense
from .layout import K0, LANES, SIDE_SIGN, STATE

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


# Rows of the cursor, a number a lane each: the last point and the velocity there, its time, the next spacing.
X, Y, VX, VY, TIME, POINT_SPACING = range(6)
CURSOR = 6
LONGER = 4.0  # growth of the spacing from one chord to the next
AIM, ALLOWED = 0.8, 0.9  # of the distance: what a chord aims at, and what it may have


@fast_kernel
def picture_state(S, P, lane, x):
    """Picture point and picture velocity (a step's fraction as time) at the fraction x of the step in DENSE."""
    px, ux = dense(S, lane, x)
    py, uy = dense(S, LANES + lane, x)
    if P[SIDE_SIGN + lane] < 0.0:
        return px, py, ux, uy
    w, uw = dense(S, 2 * LANES + lane, x)
    radius = (1.0 + w) / math.sqrt(px * px + py * py)  # p is on the circle, but for the error of the interpolant
    return radius * px, radius * py, (1.0 + w) * ux + uw * px, (1.0 + w) * uy + uw * py


@fast_kernel
def start(S, P, lane, cursor):
    """Put the cursor at a lane's STATE, where K0 is the field."""
    px, py, w = S[STATE + lane], S[STATE + LANES + lane], S[STATE + 2 * LANES + lane]
    ux, uy, uw = S[K0 + lane], S[K0 + LANES + lane], S[K0 + 2 * LANES + lane]
    if P[SIDE_SIGN + lane] < 0.0:
        w, uw = 0.0, 0.0
    cursor[X, lane] = (1.0 + w) * px
    cursor[Y, lane] = (1.0 + w) * py
    cursor[VX, lane] = (1.0 + w) * ux + uw * px
    cursor[VY, lane] = (1.0 + w) * uy + uw * py
    cursor[TIME, lane] = 0.0
    cursor[POINT_SPACING, lane] = 1e300  # to the end of the first step, or what its bend allows


@fast_kernel
def append_step(S, P, lane, cursor, lines, count, t0, h, stop, distance):
    """Add the points of one step, from t0 to `stop`, to a lane's line: the new count, or -1 - count when it is full."""
    x0, y0, ux, uy = cursor[X, lane], cursor[Y, lane], cursor[VX, lane], cursor[VY, lane]
    last, spacing = cursor[TIME, lane], cursor[POINT_SPACING, lane]
    aim, allowed = AIM * distance, ALLOWED * distance
    while True:
        beyond = last + spacing >= stop
        t = stop if beyond else max(last + spacing, t0)
        x, y, vx, vy = picture_state(S, P, lane, (t - t0) / h)
        lx, ly = x - x0, y - y0
        bend = 0.25 * max(
            abs(ux * ly - uy * lx) / math.sqrt(ux * ux + uy * uy + 1e-300),
            abs(vx * ly - vy * lx) / math.sqrt(vx * vx + vy * vy + 1e-300),
        )
        # Ends alone cannot tell an arc from a corner: look at one point between them too.
        if last >= t0:
            mx, my, _vx, _vy = picture_state(S, P, lane, (0.5 * (last + t) - t0) / h)
        else:
            scale = 1.0 if P[SIDE_SIGN + lane] < 0.0 else 1.0 + S[STATE + 2 * LANES + lane]
            mx, my = scale * S[STATE + lane], scale * S[STATE + LANES + lane]
        bend = max(bend, abs(lx * (my - y0) - ly * (mx - x0)) / math.sqrt(lx * lx + ly * ly + 1e-300))
        ratio = math.sqrt(aim / (bend + 1e-30))
        if bend > allowed and t > t0 and t - last > 1e-13 * h:
            spacing = (t - last) * max(0.3, ratio)
            continue
        if beyond:
            break
        if count == lines.shape[1]:
            count = -1 - count
            break
        lines[lane, count, 0] = x
        lines[lane, count, 1] = y
        lines[lane, count, 2] = t
        count += 1
        x0, y0, ux, uy = x, y, vx, vy
        spacing = (t - last) * min(LONGER, ratio)
        if t == last:
            spacing = 1e-3 * h
        last = t
    cursor[X, lane], cursor[Y, lane], cursor[VX, lane], cursor[VY, lane] = x0, y0, ux, uy
    cursor[TIME, lane], cursor[POINT_SPACING, lane] = last, spacing
    return count
