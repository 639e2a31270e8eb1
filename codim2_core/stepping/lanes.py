"""Compiled stepping of many trajectories at once: DOP853 in SIMD lanes, each lane with its own step size.

A lane whose trajectory has ended is given the next one, so that all lanes stay busy. See `layout` for the
workspace, `fields` for right-hand sides.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from .dop853 import ARITHMETIC, advance, dense, interpolate
from .events import EQUATOR, INTERIOR, MIRROR, attracted, left_view, winding
from .layout import ERROR_3, ERROR_5, K0, K12, LANES, NEW, PARAMETERS, SIGN, STATE, STEP, WORKSPACE, call_field
from .polyline import CURSOR, X, Y, follow, start

# Outcomes; `orbits.trajectories.Status` lists their sentences in this order.
T_MAX, EQUILIBRIUM, LEFT_VIEW, ARRIVED, SPIRALLED, ON_EQUATOR, STEP_LIMIT, LENGTH = range(8)
RUNNING = -1

SAFETY, SHRINK, GROW = 0.9, 0.2, 6.0
# Of the tolerance, for one step: what keeps the error of a whole trajectory below ten times the tolerance (measured
# on 1000 orbits of SO(2, 1), T = 8: at most 20 times with 1).
SHARE = 0.1
FIRST_STEP = 1.0  # times rtol^(1/8): about what the error estimate asks for where |U| = 1
NEAR = 1e-6  # ebar and rho below which (or below `capture`) a trajectory has spiralled onto the equator
EXTREME = 1e-300
LEAVING, SLOW, OTHER = 1, 2, 4  # marks of lanes to look at
IDLE = -(1 << 60)  # steps spent by a lane without a trajectory


@njit(cache=True, nogil=True, fastmath=ARITHMETIC, error_model="numpy")
def _load(S, P, lane, state, sign):
    for c in range(3):
        S[STATE + c * LANES + lane] = state[c]
    P[SIGN + lane] = sign


@njit(cache=True, nogil=True, fastmath=ARITHMETIC, error_model="numpy")
def _judge(S, P, times, steps, tried, accepted, t_max, rtol, atol):
    """Error norms, projection of NEW to the sphere, and the next step of every lane. Vectorised."""
    rtol, atol = SHARE * rtol, SHARE * atol
    for k in range(LANES):
        x, y, w = S[NEW + k], S[NEW + LANES + k], S[NEW + 2 * LANES + k]
        # w is multiplicative: its error counts relative to w itself, however small that is.
        in_plane = 1.0 / (atol + rtol * math.sqrt(x * x + y * y))
        in_w = 1.0 / (rtol * abs(w) + EXTREME)
        a, b, c = S[ERROR_5 + k] * in_plane, S[ERROR_5 + LANES + k] * in_plane, S[ERROR_5 + 2 * LANES + k] * in_w
        five = a * a + b * b + c * c
        a, b, c = S[ERROR_3 + k] * in_plane, S[ERROR_3 + LANES + k] * in_plane, S[ERROR_3 + 2 * LANES + k] * in_w
        three = a * a + b * b + c * c
        error = five / math.sqrt(3.0 * (five + 0.01 * three) + EXTREME)
        good = error <= 1.0
        factor = SAFETY / math.sqrt(math.sqrt(math.sqrt(error + 1e-30)))
        factor = factor if factor > SHRINK else SHRINK  # and NaN shrinks
        factor = min(factor, GROW)
        inside = 0.5 - 0.5 * P[SIGN + k]
        length = 1.0 / math.sqrt(x * x + y * y + inside * w * w)
        S[NEW + k] = x * length
        S[NEW + LANES + k] = y * length
        S[NEW + 2 * LANES + k] = w * length if inside > 0.5 else w
        accepted[k] = 1.0 if good else 0.0
        last = tried[k] < steps[k]
        times[LANES + k] = t_max if last else times[k] + tried[k]
        steps[k] = tried[k] * factor if tried[k] > 0.0 else steps[k]


@njit(cache=True, nogil=True, fastmath=ARITHMETIC, error_model="numpy")
def _flag(S, P, times, accepted, spent, flags, t_max, slow, near, view, limit):
    """Count the step, and mark the lanes where something may have happened. Vectorised; returns all marks."""
    marks = 0
    for k in range(LANES):
        x, y, w = S[NEW + k], S[NEW + LANES + k], S[NEW + 2 * LANES + k]
        ux, uy, uw = S[K12 + k], S[K12 + LANES + k], S[K12 + 2 * LANES + k]
        extent = (1.0 + w) * max(abs(x), abs(y))
        before = (1.0 + S[STATE + 2 * LANES + k]) * max(abs(S[STATE + k]), abs(S[STATE + LANES + k]))
        spent[k] += 1
        busy = spent[k] > 0
        good = busy & (accepted[k] > 0.0)
        leaving = good & (P[SIGN + k] > 0.0) & (extent > view) & (extent > before)
        still = good & (ux * ux + uy * uy + uw * uw <= slow)
        other = (good & ((times[LANES + k] >= t_max) | ((w > 0.0) & (w < near)))) | (busy & (spent[k] >= limit))
        flags[k] = (LEAVING if leaving else 0) | (SLOW if still else 0) | (OTHER if other else 0)
        marks |= flags[k]
    return marks


@njit(cache=True, nogil=True, fastmath=ARITHMETIC, error_model="numpy")
def _longer(array):
    """Twice the room along the second axis (of lines) or the first (of a table)."""
    k, n, m = array.shape
    larger = np.empty((k, 2 * n, m))
    larger[:, :n] = array
    return larger


@njit(cache=True, nogil=True, fastmath=ARITHMETIC, error_model="numpy")
def integrate(states, signs, shared, field, t_max, rtol, atol, limit, capture, view, distance, longest):
    """Integrate every row of `states`; scaled so that |U| is about 1.

    Parameters
    ----------
    states : (n, 3)
        (px, py, w).
    signs : (n,)
        -1 on the hemisphere, +1 outside.
    shared : (SHARED,)
        Parameters of the field.
    field : int
        Address of the field.
    t_max, rtol, atol : float
    limit : int
        Steps tried, a trajectory.
    capture : float
        Arc from an attractor at which a trajectory ends.
    view : float
        Edge of the view, outside.
    distance : float
        Of the polyline from the curve; 0: only the two ends.
    longest : float
        Length of a drawn polyline at which its trajectory ends.

    Returns
    -------
    points (N, 2), times (N,), offsets (n + 1,), ends (n, 3), codes (n,), evaluations
    """
    n = states.shape[0]
    draw = distance > 0.0
    S, P, scratch = np.zeros(WORKSPACE), np.zeros(PARAMETERS), np.empty(MIRROR)
    P[:SIGN] = shared
    cursor = np.zeros((CURSOR, LANES))
    times, steps, tried, accepted = np.zeros(2 * LANES), np.zeros(LANES), np.zeros(LANES), np.zeros(LANES)
    flags = np.zeros(LANES, np.int64)
    travelled = np.zeros(LANES)
    who, spent = np.full(LANES, -1), np.full(LANES, IDLE)
    lines, counts = np.empty((LANES, 128 if draw else 2, 3)), np.zeros(LANES, np.int64)
    store, stored = np.empty((1, 64 * n if draw else 2 * n, 3)), 0
    where, length = np.zeros(n, np.int64), np.zeros(n, np.int64)
    ends, codes = np.empty((n, 3)), np.full(n, RUNNING)
    turn, turn_known = 0.0, False
    first = FIRST_STEP * rtol**0.125
    slow, near = (4.0 * capture) ** 2, max(NEAR, capture)
    evaluations, following, done = 0, 0, 0
    for k in range(LANES):
        _load(S, P, k, states[0], signs[0])  # an idle lane repeats a harmless state with steps of length 0
    free = True
    while True:
        if free:
            for k in range(LANES):
                if who[k] < 0 and following < n:
                    _load(S, P, k, states[following], signs[following])
                    who[k], times[k], steps[k], spent[k], counts[k] = following, 0.0, first, 0, 1
                    travelled[k] = 0.0
                    following += 1
                    evaluations += 1
                    accepted[k] = -1.0
            call_field(field, S, STATE, K0, P)
            for k in range(LANES):
                if accepted[k] == -1.0:
                    start(S, P, k, cursor)
                    lines[k, 0, 0], lines[k, 0, 1], lines[k, 0, 2] = cursor[X, k], cursor[Y, k], 0.0
            free = False
        if done == n:
            break
        for k in range(LANES):
            h = min(steps[k], t_max - times[k]) if who[k] >= 0 else 0.0
            tried[k] = h
            S[STEP + k] = h
            S[STEP + LANES + k] = h
            S[STEP + 2 * LANES + k] = h
        advance(S, P, field)
        _judge(S, P, times, steps, tried, accepted, t_max, rtol, atol)
        call_field(field, S, NEW, K12, P)
        events = _flag(S, P, times, accepted, spent, flags, t_max, slow, near, view, limit)
        wanted = events & LEAVING != 0
        if draw or wanted:
            interpolate(S, P, field)
        stages = 15 if draw or wanted else 12
        for k in range(LANES if draw or events != 0 else 0):
            if who[k] < 0 or (not draw and flags[k] == 0):
                continue
            x, y, w = S[NEW + k], S[NEW + LANES + k], S[NEW + 2 * LANES + k]
            code, stop, fraction = RUNNING, times[LANES + k], 1.0
            if accepted[k] > 0.0:
                if flags[k] & LEAVING != 0:
                    code = LEFT_VIEW
                    fraction = left_view(S, k, view)
                    stop = times[k] + fraction * tried[k]
                else:
                    if flags[k] & SLOW != 0:
                        kind = attracted(S, P, field, k, capture, scratch)
                        if kind == INTERIOR:
                            code = EQUILIBRIUM
                        elif kind == EQUATOR:
                            code = ARRIVED
                    if code == RUNNING and 0.0 < w < near and S[K12 + 2 * LANES + k] < 0.0:
                        if not turn_known:
                            turn, turn_known = winding(P, field, scratch), True
                        if turn * P[SIGN + k] < 0.0:
                            code = SPIRALLED
                    if code == RUNNING and stop >= t_max:
                        code = T_MAX
                if draw:
                    count = follow(S, P, k, cursor, lines, counts[k], times[k], tried[k], stop, distance)
                    while count < 0:
                        lines = _longer(lines)
                        count = follow(S, P, k, cursor, lines, -1 - count, times[k], tried[k], stop, distance)
                    for j in range(counts[k], count):
                        travelled[k] += math.hypot(
                            lines[k, j, 0] - lines[k, j - 1, 0], lines[k, j, 1] - lines[k, j - 1, 1]
                        )
                    counts[k] = count
                    if code == RUNNING and travelled[k] >= longest:
                        code = LENGTH
            if code == RUNNING and spent[k] >= limit:
                code = STEP_LIMIT
                if accepted[k] <= 0.0:
                    fraction, stop = 0.0, times[k]
            if code == RUNNING:
                continue
            i = who[k]
            if fraction == 0.0:
                for c in range(3):
                    ends[i, c] = S[STATE + c * LANES + k]
            elif fraction < 1.0:  # left the view, so p is on the circle
                x, _u = dense(S, k, fraction)
                y, _u = dense(S, LANES + k, fraction)
                w, _u = dense(S, 2 * LANES + k, fraction)
                r = math.sqrt(x * x + y * y)
                ends[i, 0], ends[i, 1], ends[i, 2] = x / r, y / r, w
            else:
                ends[i, 0], ends[i, 1], ends[i, 2] = x, y, w
            evaluations += spent[k] * stages
            codes[i] = ON_EQUATOR if ends[i, 2] == 0.0 and states[i, 2] == 0.0 else code
            if counts[k] == lines.shape[1]:
                lines = _longer(lines)
            scale = 1.0 + ends[i, 2] if P[SIGN + k] > 0.0 else 1.0
            if stop > lines[k, counts[k] - 1, 2] or counts[k] == 1:
                lines[k, counts[k], 0] = scale * ends[i, 0]
                lines[k, counts[k], 1] = scale * ends[i, 1]
                lines[k, counts[k], 2] = stop
                counts[k] += 1
            while stored + counts[k] > store.shape[1]:
                store = _longer(store)
            store[0, stored : stored + counts[k]] = lines[k, : counts[k]]
            where[i], length[i] = stored, counts[k]
            stored += counts[k]
            who[k], spent[k] = -1, IDLE
            done += 1
            free = True
        for k in range(LANES):
            good = accepted[k] > 0.0
            times[k] = times[LANES + k] if good else times[k]
            for c in range(3):
                m = c * LANES + k
                S[STATE + m] = S[NEW + m] if good else S[STATE + m]
                S[K0 + m] = S[K12 + m] if good else S[K0 + m]
    points, clock, offsets = np.empty((stored, 2)), np.empty(stored), np.zeros(n + 1, np.int64)
    for i in range(n):
        offsets[i + 1] = offsets[i] + length[i]
        for j in range(length[i]):
            points[offsets[i] + j, 0] = store[0, where[i] + j, 0]
            points[offsets[i] + j, 1] = store[0, where[i] + j, 1]
            clock[offsets[i] + j] = store[0, where[i] + j, 2]
    return points, clock, offsets, ends, codes, evaluations
