"""Points of the drawn polyline along a step, and events that end a trajectory.

An event is at an attractor, at the equator, or at the edge of the view.

A chord of length L whose end tangents make angles alpha and beta with it stays within ``L max(sin)/4`` of the curve:
exactly the sagitta for an arc, twice the truth for an S. Spacing runs on across steps of the integrator, so that a
straight leg has few points however many steps it took.
"""

from __future__ import annotations

import math

import numpy as np

from ...formulas.jit import call_field, fast_kernel
from .dop853 import dense
from .layout import K0, LANES, NEW, PARAMETERS, ROW_WIDTH, SIDE_SIGN, STATE

NO_ATTRACTOR, INTERIOR, ON_EQUATOR_ATTRACTOR = range(3)
DIFFERENCE_STEP = 1e-5  # of central differences; their error, 1e-10 at unit scale, only has to decide signs
NEUTRAL_RATIO = 1e-8  # |det| below NEUTRAL tr^2: an eigenvalue that the differences cannot tell from 0
REST_SPEED = 4e-16  # a speed that is rounding, at unit scale
MIN_SCALE = 1e-150
MIRROR = 2 * ROW_WIDTH + PARAMETERS  # room that `is_captured` and `winding` need
EQUATOR_SAMPLES = 8 * LANES  # points of the equator at which `winding` looks


@fast_kernel
def is_captured(S, P, field, lane, capture, scratch):
    """Whether the state NEW of a lane is within `capture` (arc on the sphere) of an attracting equilibrium."""
    x, y, w = S[NEW + lane], S[NEW + LANES + lane], S[NEW + 2 * LANES + lane]
    kind, x, y, w = _newton_distance(x, y, w, P, field, lane, capture, scratch)
    if kind == NO_ATTRACTOR or w < 0.0:
        return kind
    return _newton_distance(x, y, w, P, field, lane, capture, scratch)[0]


@fast_kernel
def _newton_distance(x, y, w, P, field, lane, capture, scratch):
    """Return what is within `capture` by a Newton step, and where that leads: w is -1 where the answer is final."""
    sign = P[SIDE_SIGN + lane]
    r = math.sqrt(x * x + y * y)
    # Tangent frame: along the parallel, and along the meridian (outside: along rho).
    if r > 1e-8:
        ax, ay = -y / r, x / r
        bx, by, bw = (w * x / r, w * y / r, -r) if sign < 0.0 else (0.0, 0.0, 1.0)
    else:
        ax, ay, bx, by, bw = 1.0, 0.0, 0.0, 1.0, 0.0
    S2, P2 = scratch[: 2 * ROW_WIDTH], scratch[2 * ROW_WIDTH :]
    for i in range(PARAMETERS):
        P2[i] = P[i] if i < SIDE_SIGN else sign
    for i in range(LANES):
        p = DIFFERENCE_STEP if i == 0 else -DIFFERENCE_STEP if i == 1 else 0.0
        q = DIFFERENCE_STEP if i == 2 else -DIFFERENCE_STEP if i == 3 else 0.0
        S2[i] = x + p * ax + q * bx
        S2[LANES + i] = y + p * ay + q * by
        S2[2 * LANES + i] = w + q * bw
        # Back on the sphere (outside: the circle): a formula such as sqrt(1 - c^2 - s^2) ends there.
        height = S2[2 * LANES + i] if sign < 0.0 else 0.0
        length = 1.0 / math.sqrt(S2[i] * S2[i] + S2[LANES + i] * S2[LANES + i] + height * height)
        S2[i] *= length
        S2[LANES + i] *= length
        S2[2 * LANES + i] *= length if sign < 0.0 else 1.0
    call_field(field, S2, 0, ROW_WIDTH, P2)
    F = S2[ROW_WIDTH:]
    speed = math.sqrt(F[4] ** 2 + F[LANES + 4] ** 2 + F[2 * LANES + 4] ** 2)
    place = ON_EQUATOR_ATTRACTOR if w < 1e-6 else INTERIOR
    # Near the equator only a rest of ebar itself, not its smallness, is rest.
    if speed <= REST_SPEED and abs(F[2 * LANES + 4]) <= REST_SPEED * w:
        return place, x, y, -1.0
    f = F[4] * ax + F[LANES + 4] * ay
    g = F[4] * bx + F[LANES + 4] * by + F[2 * LANES + 4] * bw
    j11 = ((F[0] - F[1]) * ax + (F[LANES] - F[LANES + 1]) * ay) / (2.0 * DIFFERENCE_STEP)
    if w == 0.0:
        return (ON_EQUATOR_ATTRACTOR if j11 < 0.0 and abs(f) <= -j11 * capture else NO_ATTRACTOR), x, y, -1.0
    j12 = ((F[2] - F[3]) * ax + (F[LANES + 2] - F[LANES + 3]) * ay) / (2.0 * DIFFERENCE_STEP)
    dx, dy, dw = F[0] - F[1], F[LANES] - F[LANES + 1], F[2 * LANES] - F[2 * LANES + 1]
    j21 = (dx * bx + dy * by + dw * bw) / (2.0 * DIFFERENCE_STEP)
    dx, dy, dw = F[2] - F[3], F[LANES + 2] - F[LANES + 3], F[2 * LANES + 2] - F[2 * LANES + 3]
    j22 = (dx * bx + dy * by + dw * bw) / (2.0 * DIFFERENCE_STEP)
    trace, det = j11 + j22, j11 * j22 - j12 * j21
    if not (trace < 0.0 and det >= -NEUTRAL_RATIO * trace * trace):  # also NaN
        return NO_ATTRACTOR, x, y, w
    if det <= NEUTRAL_RATIO * trace * trace:  # a line of equilibria: only what is far closer counts
        return (place if speed <= 1e-3 * capture * -trace else NO_ATTRACTOR), x, y, -1.0
    # On a weak focus the Jacobian must still beat its own rounding.
    u, v = (-f * j22 + g * j12) / det, (-g * j11 + f * j21) / det
    if trace > -1e-9 or math.sqrt(u * u + v * v) > capture:
        return NO_ATTRACTOR, x, y, w
    ahead = w + v * bw
    x, y = x + u * ax + v * bx, y + u * ay + v * by
    height = ahead if sign < 0.0 else 0.0
    length = 1.0 / math.sqrt(x * x + y * y + height * height)
    kind = ON_EQUATOR_ATTRACTOR if ahead <= 0.05 * capture else INTERIOR
    return kind, x * length, y * length, max(ahead * (length if sign < 0.0 else 1.0), 0.0)


@fast_kernel
def left_view(S, lane, view):
    """Fraction of the step in DENSE at which an outside lane leaves |(1 + rho) p|_inf <= view, by bisection."""
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        x, _u = dense(S, lane, middle)
        y, _u = dense(S, LANES + lane, middle)
        w, _u = dense(S, 2 * LANES + lane, middle)
        if (1.0 + w) * max(abs(x), abs(y)) > view * math.sqrt(x * x + y * y):
            high = middle
        else:
            low = middle
        if high - low <= 1e-14:
            break
    return high


@fast_kernel
def winding(P, field, scratch):
    """-1, 0 or +1: the closed equator repels, is absent or neutral, attracts on the hemisphere (Theorem 3.1(c))."""
    S2, P2 = scratch[: 2 * ROW_WIDTH], scratch[2 * ROW_WIDTH :]
    for m in range(PARAMETERS):
        P2[m] = P[m] if m < SIDE_SIGN else 1.0  # outside, at w = rho = FAINT, where w' = w lambda_rho
    total, size, first = 0.0, 0.0, 0.0
    for base in range(0, EQUATOR_SAMPLES, LANES):
        for k in range(LANES):
            angle = 2.0 * math.pi * (base + k) / EQUATOR_SAMPLES
            S2[k], S2[LANES + k], S2[2 * LANES + k] = math.cos(angle), math.sin(angle), MIN_SCALE
        call_field(field, S2, 0, ROW_WIDTH, P2)
        for k in range(LANES):
            turning = S2[k] * S2[ROW_WIDTH + LANES + k] - S2[LANES + k] * S2[ROW_WIDTH + k]
            growth = S2[ROW_WIDTH + 2 * LANES + k] / MIN_SCALE
            if base + k == 0:
                first = turning
            if turning * first <= 0.0:
                return 0.0
            total += growth / abs(turning)
            size += abs(growth / turning)
    if abs(total) <= 1e-10 * size:
        return 0.0
    return 1.0 if total > 0.0 else -1.0


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
