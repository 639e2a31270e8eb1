"""The drawn polyline: points on the dense output, as far apart as the curve allows.

A chord of length L whose end tangents make angles alpha and beta with it stays within ``L max(sin)/4`` of the curve:
exactly the sagitta for an arc, twice the truth for an S. Spacing runs on across steps of the integrator, so that a
straight leg has few points however many steps it took.
"""

from __future__ import annotations

import math

from ...formulas.jit import fast_kernel
from .dop853 import dense
from .layout import K0, LANES, SIDE_SIGN, STATE

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
    """Add the points of one step, from time t0 to `stop` <= t0 + h, to a lane's line.

    Returns the new count; -1 - count when the line is full: make room and call again.
    """
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
