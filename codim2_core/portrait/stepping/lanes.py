"""Compiled stepping of many trajectories at once: DOP853 in SIMD lanes, each lane with its own step size.

A lane whose trajectory has ended is given the next one, so that all lanes stay busy. See `layout` for the
workspace, `fields` for right-hand sides.
"""

from __future__ import annotations

import math

import numpy as np

from ...formulas.jit import call_field, fast_kernel
from .dop853 import advance, dense, interpolate
from .layout import (
    ERROR_3,
    ERROR_5,
    K0,
    K12,
    LANES,
    NEW,
    PARAMETERS,
    SIDE_SIGN,
    STATE,
    STEP_ROW,
    WORKSPACE,
)
from .polyline import (
    BEGUN,
    CURSOR,
    INTERIOR,
    MIRROR,
    NO_ATTRACTOR,
    append_step,
    begin_lines,
    end_line,
    in_order,
    is_captured,
    keep_line,
    left_view,
    length_of,
    longer,
    winding,
)

# Outcomes; `orbits.trajectories.Status` lists their sentences in this order.
T_MAX, EQUILIBRIUM, LEFT_VIEW, AT_LIMIT_DIRECTION, SPIRALLED, STAYS_ON_EQUATOR, STEP_LIMIT, LENGTH = range(8)
RUNNING = -1

STEP_SAFETY, MAX_SHRINKAGE, MAX_GROWTH = 0.9, 0.2, 6.0
# Of the tolerance, for one step: what keeps the error of a whole trajectory below ten times the tolerance (measured
# on 1000 orbits of SO(2, 1), T = 8: at most 20 times with 1).
STEP_TOLERANCE_SHARE = 0.1
FIRST_STEP = 1.0  # times rtol^(1/8): about what the error estimate asks for where |U| = 1
SPIRAL_HEIGHT = 1e-6  # ebar and rho below which (or below `capture`) a trajectory has spiralled onto the equator
EXTREME = 1e-300
LEAVING, SLOW_MARK, OTHER = 1, 2, 4  # marks of lanes to look at
IDLE = -(1 << 60)  # steps spent by a lane without a trajectory


@fast_kernel
def _load(S, P, lane, states, signs, i):
    for c in range(3):
        S[STATE + c * LANES + lane] = states[i, c]
    P[SIDE_SIGN + lane] = signs[i]


@fast_kernel
def _judge(S, P, times, steps, tried, accepted, t_max, rtol, atol):
    """Error norms, projection of NEW to the sphere, and the next step of every lane. Vectorised."""
    rtol, atol = STEP_TOLERANCE_SHARE * rtol, STEP_TOLERANCE_SHARE * atol
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
        factor = STEP_SAFETY / math.sqrt(math.sqrt(math.sqrt(error + 1e-30)))
        factor = factor if factor > MAX_SHRINKAGE else MAX_SHRINKAGE  # and NaN shrinks
        factor = min(factor, MAX_GROWTH)
        inside = 0.5 - 0.5 * P[SIDE_SIGN + k]
        length = 1.0 / math.sqrt(x * x + y * y + inside * w * w)
        S[NEW + k] = x * length
        S[NEW + LANES + k] = y * length
        S[NEW + 2 * LANES + k] = w * length if inside > 0.5 else w
        accepted[k] = 1.0 if good else 0.0
        last = tried[k] < steps[k]
        times[LANES + k] = t_max if last else times[k] + tried[k]
        steps[k] = tried[k] * factor if tried[k] > 0.0 else steps[k]


@fast_kernel
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
        leaving = good & (P[SIDE_SIGN + k] > 0.0) & (extent > view) & (extent > before)
        still = good & (ux * ux + uy * uy + uw * uw <= slow)
        other = (good & ((times[LANES + k] >= t_max) | ((w > 0.0) & (w < near)))) | (busy & (spent[k] >= limit))
        flags[k] = (LEAVING if leaving else 0) | (SLOW_MARK if still else 0) | (OTHER if other else 0)
        marks |= flags[k]
    return marks


@fast_kernel
def _begin_trajectories(S, P, states, signs, following, first, who, times, steps, spent, counts, travelled, accepted):
    """Give each free lane the next trajectory, at the start of its time; return which is the next after these."""
    for k in range(LANES):
        if who[k] < 0 and following < len(states):
            _load(S, P, k, states, signs, following)
            who[k], times[k], steps[k], spent[k], counts[k] = following, 0.0, first, 0, 1
            travelled[k] = 0.0
            accepted[k] = BEGUN
            following += 1
    return following


@fast_kernel
def _try(S, who, times, steps, tried, t_max):
    """Choose the step that each lane tries: its own, or what is left of the time; 0 in a lane without a trajectory."""
    for k in range(LANES):
        h = min(steps[k], t_max - times[k]) if who[k] >= 0 else 0.0
        tried[k] = h
        S[STEP_ROW + k] = h
        S[STEP_ROW + LANES + k] = h
        S[STEP_ROW + 2 * LANES + k] = h


@fast_kernel
def _event(S, P, field, k, flag, times, tried, t_max, capture, view, near, turn, scratch):
    """Whether an accepted step ends its trajectory: the outcome or RUNNING, the time, and the fraction of the step."""
    if flag & LEAVING != 0:
        fraction = left_view(S, k, view)
        return LEFT_VIEW, times[k] + fraction * tried[k], fraction
    t = times[LANES + k]
    if flag & SLOW_MARK != 0:
        kind = is_captured(S, P, field, k, capture, scratch)
        if kind != NO_ATTRACTOR:
            return EQUILIBRIUM if kind == INTERIOR else AT_LIMIT_DIRECTION, t, 1.0
    if 0.0 < S[NEW + 2 * LANES + k] < near and S[K12 + 2 * LANES + k] < 0.0:
        if turn[1] == 0.0:
            turn[0], turn[1] = winding(P, field, scratch), 1.0
        if turn[0] * P[SIDE_SIGN + k] < 0.0:
            return SPIRALLED, t, 1.0
    return T_MAX if t >= t_max else RUNNING, t, 1.0


@fast_kernel
def _write_end(S, k, fraction, ends, i):
    """Write the state of a lane at a fraction of its step as the end of trajectory i."""
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
        for c in range(3):
            ends[i, c] = S[NEW + c * LANES + k]


@fast_kernel
def _accept_steps(S, times, accepted):
    """Let each lane stand where its step has led, if that was accepted. Vectorised."""
    for k in range(LANES):
        good = accepted[k] > 0.0
        times[k] = times[LANES + k] if good else times[k]
        for c in range(3):
            m = c * LANES + k
            S[STATE + m] = S[NEW + m] if good else S[STATE + m]
            S[K0 + m] = S[K12 + m] if good else S[K0 + m]


# In one piece: with the stages of a step, the drawing of a line and its end as inlined functions of their own, results
# were the same and took 6 to 11 % longer (medians of paired runs, process time).
@fast_kernel
def integrate(states, signs, shared, field, t_max, rtol, atol, limit, capture, view, distance, longest):
    """Integrate every row of `states` (n, 3), with signs (n,); |U| is about 1."""
    n = states.shape[0]
    draw = distance > 0.0
    S, P, scratch = np.zeros(WORKSPACE), np.zeros(PARAMETERS), np.empty(MIRROR)
    for m in range(SIDE_SIGN):
        P[m] = shared[m]
    cursor = np.zeros((CURSOR, LANES))
    times, steps, tried, accepted = np.zeros(2 * LANES), np.zeros(LANES), np.zeros(LANES), np.zeros(LANES)
    flags = np.zeros(LANES, np.int64)
    travelled = np.zeros(LANES)
    who, spent = np.full(LANES, -1), np.full(LANES, IDLE)
    lines, counts = np.empty((LANES, 128 if draw else 2, 3)), np.zeros(LANES, np.int64)
    store, stored = np.empty((1, 64 * n if draw else 2 * n, 3)), 0
    where, length = np.zeros(n, np.int64), np.zeros(n, np.int64)
    ends, codes = np.empty((n, 3)), np.full(n, RUNNING)
    turn = np.zeros(2)
    first = FIRST_STEP * rtol**0.125
    slow, near = (4.0 * capture) ** 2, max(SPIRAL_HEIGHT, capture)
    for k in range(LANES):
        _load(S, P, k, states, signs, 0)  # an idle lane repeats a harmless state with steps of length 0
    following, evaluations, done, free = 0, 0, 0, True
    while done < n:
        if free:
            following = _begin_trajectories(
                S, P, states, signs, following, first, who, times, steps, spent, counts, travelled, accepted
            )
            call_field(field, S, STATE, K0, P)
            begin_lines(S, P, cursor, lines, accepted)
            free = False
        _try(S, who, times, steps, tried, t_max)
        advance(S, P, field)
        _judge(S, P, times, steps, tried, accepted, t_max, rtol, atol)
        call_field(field, S, NEW, K12, P)
        events = _flag(S, P, times, accepted, spent, flags, t_max, slow, near, view, limit)
        interpolated = draw or events & LEAVING != 0
        if interpolated:
            interpolate(S, P, field)
        for k in range(LANES if draw or events != 0 else 0):
            if who[k] < 0 or (not draw and flags[k] == 0):
                continue
            code, stop, fraction = RUNNING, times[LANES + k], 1.0
            if accepted[k] > 0.0:
                if flags[k] != 0:
                    code, stop, fraction = _event(
                        S, P, field, k, flags[k], times, tried, t_max, capture, view, near, turn, scratch
                    )
                if draw:
                    count = append_step(S, P, k, cursor, lines, counts[k], times[k], tried[k], stop, distance)
                    while count < 0:
                        lines = longer(lines)
                        count = append_step(S, P, k, cursor, lines, -1 - count, times[k], tried[k], stop, distance)
                    travelled[k] += length_of(lines, k, counts[k] - 1, count - 1)
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
            _write_end(S, k, fraction, ends, i)
            codes[i] = STAYS_ON_EQUATOR if ends[i, 2] == 0.0 and states[i, 2] == 0.0 else code
            if counts[k] == lines.shape[1]:
                lines = longer(lines)
            end_line(lines, counts, k, P[SIDE_SIGN + k], ends, i, stop)
            while stored + counts[k] > store.shape[1]:
                store = longer(store)
            where[i], length[i] = stored, counts[k]
            stored = keep_line(store, stored, lines, counts, k)
            evaluations += 1 + spent[k] * (15 if interpolated else 12)
            who[k], spent[k] = -1, IDLE
            done += 1
            free = True
        _accept_steps(S, times, accepted)
    points, clock, offsets = in_order(store, stored, where, length)
    return points, clock, offsets, ends, codes, evaluations
