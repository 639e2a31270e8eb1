"""Compiled first turn of the layer problem about a point of the disc; see `cycle_search`.

The angle of p about the point is followed along the orbit, and the turn is complete when it has first changed by 2 pi,
in either sense. Lanes step as in `stepping`: a lane that has turned goes back to the start of its step and finds
the length that ends on the ray, so that the end is as accurate as a step, not as its dense output.
"""

from __future__ import annotations

import math

import numpy as np

from ...formulas.jit import call_field, fast_kernel, inlined_fast_kernel
from ..stepping.dop853 import advance
from ..stepping.layout import (
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

LANE_TOLERANCE_SHARE = 0.1  # of the tolerance, for one step
TRIALS = 40


@fast_kernel
def workspace(shared):
    """Return the workspace and the parameters of a field whose lanes all lie on the hemisphere."""
    S, P = np.zeros(WORKSPACE), np.zeros(PARAMETERS)
    for m in range(SIDE_SIGN):
        P[m] = shared[m]
    for m in range(SIDE_SIGN, PARAMETERS):
        P[m] = -1.0
    return S, P


@fast_kernel
def load_state(S, state, lane):
    """Let a lane stand at a state (3,)."""
    for c in range(3):
        S[STATE + c * LANES + lane] = state[c]


@fast_kernel
def load(S, states, base, active):
    """Put the next states into the lanes; one that is left over repeats the first of them."""
    for k in range(LANES):
        load_state(S, states[base + k if k < active else base], k)


@fast_kernel
def set_lengths(S, step):
    """Let each lane step by its own length."""
    for k in range(LANES):
        for c in range(3):
            S[STEP_ROW + c * LANES + k] = step[k]


@fast_kernel
def to_sphere(S, k):
    """Put NEW back on the sphere, in lane k."""
    x, y, w = S[NEW + k], S[NEW + LANES + k], S[NEW + 2 * LANES + k]
    length = 1.0 / math.sqrt(x * x + y * y + w * w)
    S[NEW + k], S[NEW + LANES + k], S[NEW + 2 * LANES + k] = x * length, y * length, w * length


@fast_kernel
def step_error(S, k, rtol):
    """Error of the step tried in lane k, in units of what is allowed; puts NEW back on the sphere."""
    plane, height = 1.0 / rtol, 1.0 / (rtol * abs(S[NEW + 2 * LANES + k]) + 1e-300)
    five = (S[ERROR_5 + k] * plane) ** 2 + (S[ERROR_5 + LANES + k] * plane) ** 2
    five += (S[ERROR_5 + 2 * LANES + k] * height) ** 2
    three = (S[ERROR_3 + k] * plane) ** 2 + (S[ERROR_3 + LANES + k] * plane) ** 2
    three += (S[ERROR_3 + 2 * LANES + k] * height) ** 2
    to_sphere(S, k)
    return five / math.sqrt(3.0 * (five + 0.01 * three) + 1e-300)


@fast_kernel
def growth(error):
    """By what the next step is longer than one of this error."""
    factor = 0.9 / math.sqrt(math.sqrt(math.sqrt(error + 1e-30)))
    return min(factor if factor > 0.2 else 0.2, 5.0)


@fast_kernel
def narrow(k, before, g, step, low, at_low, high, at_high, side):
    """Note what lane k has found at its length, before the section or behind it; by the Illinois rule."""
    if before:
        low[k], at_low[k] = step[k], g
        at_high[k] *= 0.5 if side[k] == 1 else 1.0  # an end kept twice counts half
        side[k] = 1
    else:
        high[k], at_high[k] = step[k], g
        at_low[k] *= 0.5 if side[k] == -1 else 1.0
        side[k] = -1


@fast_kernel
def next_length(k, low, at_low, high, at_high):
    """Return the length at which the chord meets the section, or the middle."""
    found = (low[k] * at_high[k] - high[k] * at_low[k]) / (at_high[k] - at_low[k])
    return found if low[k] < found < high[k] else 0.5 * (low[k] + high[k])


@fast_kernel
def log_step(log, logged, S, k, h, i):
    """Write down where the step of lane k starts, its length and whose it is, if there is room; return how many are."""
    if logged >= log.shape[0]:
        return logged
    for c in range(3):
        log[logged, c] = S[STATE + c * LANES + k]
    log[logged, 3], log[logged, 4] = h, i
    return logged + 1


RETURNED, TO_CRITICAL_SET, OUTWARD, NO_RETURN_YET = range(4)  # inward: onto C; outward: onto the equator
DONE, STEPPING, REFINING = range(3)
MAX_STEP_ANGLE = 2.0  # radians about the point in one step: more could be a turn unseen
REST_SPEED = 3.0  # times the tolerance: a speed at which an orbit has come to rest


@inlined_fast_kernel
def _excess_angle(angle, goal, sense):
    """By how much an angle is beyond its goal: in one sense, or in either if the sense is 0."""
    return (abs(angle) if sense == 0 else sense * angle) - goal


@inlined_fast_kernel
def _swept_angle(S, centre, k):
    """Angle about the point from STATE to NEW."""
    ax, ay = S[STATE + k] - centre[0], S[STATE + LANES + k] - centre[1]
    bx, by = S[NEW + k] - centre[0], S[NEW + LANES + k] - centre[1]
    return math.atan2(ax * by - ay * bx, ax * bx + ay * by)


# In one piece: with the stages of a step, the search for the end and the judging of errors as inlined functions of
# their own, results were the same and took 7 % longer (median of paired runs, process time).
@fast_kernel
def first_turns(states, shared, field, centre, goal, sense, floor, sunk, t_max, rtol, limit, record):
    """Follow states (n, 3) until each has gone round a centre by its goal (n,); `steps` are those of state 0."""
    n = states.shape[0]
    ends, times, codes = states.copy(), np.zeros(n), np.full(n, NO_RETURN_YET)
    log, logged = np.empty((record, 5)), 0
    S, P = workspace(shared)
    phase, tries, side = np.zeros(LANES, np.int64), np.zeros(LANES, np.int64), np.zeros(LANES, np.int64)
    clock, step, angle, errors = np.zeros(LANES), np.zeros(LANES), np.zeros(LANES), np.zeros(LANES)
    low, high, at_low, at_high = np.zeros(LANES), np.zeros(LANES), np.zeros(LANES), np.zeros(LANES)
    for base in range(0, n, LANES):
        active = min(LANES, n - base)
        load(S, states, base, active)
        for k in range(LANES):
            phase[k] = STEPPING if k < active else DONE
            clock[k], angle[k], step[k] = 0.0, 0.0, 0.5 * rtol**0.125 if k < active else 0.0
        call_field(field, S, STATE, K0, P)
        spent, running = 0, active
        while running > 0 and spent < limit:
            spent += 1
            set_lengths(S, step)
            advance(S, P, field)
            for k in range(LANES):
                if phase[k] == REFINING:
                    to_sphere(S, k)
                elif phase[k] != DONE:
                    errors[k] = step_error(S, k, LANE_TOLERANCE_SHARE * rtol)
            call_field(field, S, NEW, K12, P)
            for k in range(LANES):
                if phase[k] == DONE:
                    continue
                h, swept = step[k], _swept_angle(S, centre, k)
                finished, code = False, RETURNED
                if phase[k] == REFINING:
                    tries[k] += 1
                    g = _excess_angle(angle[k] + swept, goal[base + k], sense)
                    narrow(k, g < 0.0, g, step, low, at_low, high, at_high, side)
                    if abs(g) > 1e-15 and high[k] - low[k] > 4e-16 * high[k] and tries[k] < TRIALS:
                        step[k] = next_length(k, low, at_low, high, at_high)
                        continue
                    finished = True
                else:
                    factor = growth(errors[k])
                    if not errors[k] <= 1.0:
                        step[k] *= factor
                        continue
                    if abs(swept) > MAX_STEP_ANGLE:
                        step[k] *= 0.5
                        continue
                    beyond = _excess_angle(angle[k] + swept, goal[base + k], sense)
                    if beyond >= 0.0:
                        low[k], at_low[k] = 0.0, _excess_angle(angle[k], goal[base + k], sense)
                        high[k], at_high[k] = h, beyond
                        step[k] = h * at_low[k] / (at_low[k] - at_high[k])
                        phase[k], tries[k], side[k] = REFINING, 0, 0
                        continue
                    step[k] *= factor
                    dx, dy = S[NEW + k] - centre[0], S[NEW + LANES + k] - centre[1]
                    if dx * dx + dy * dy < floor * floor:
                        finished, code = True, TO_CRITICAL_SET
                    elif S[NEW + 2 * LANES + k] < sunk * states[base + k, 2]:
                        finished, code = True, OUTWARD
                    else:
                        vx, vy, vw = S[K12 + k], S[K12 + LANES + k], S[K12 + 2 * LANES + k]
                        still = vx * vx + vy * vy + vw * vw < (REST_SPEED * rtol) ** 2
                        if still or clock[k] + h >= t_max:
                            finished, code = True, NO_RETURN_YET
                if base + k == 0:
                    logged = log_step(log, logged, S, k, h, 0)
                clock[k] += h
                angle[k] += swept
                for c in range(3):
                    m = c * LANES + k
                    S[STATE + m] = S[NEW + m]
                    S[K0 + m] = S[K12 + m]
                if finished:
                    codes[base + k], times[base + k], phase[k], step[k] = code, clock[k], DONE, 0.0
                    running -= 1
        for k in range(active):
            for c in range(3):
                ends[base + k, c] = S[STATE + c * LANES + k]
            if phase[k] != DONE:
                times[base + k] = clock[k]
    return ends, times, codes, log[:logged]


@fast_kernel
def single_step(states, lengths, shared, field):
    """Take one step of given length (n,) from each state (n, 3): for short ones as accurate as the stepping."""
    n = states.shape[0]
    out = np.empty((n, 3))
    S, P = workspace(shared)
    for base in range(0, n, LANES):
        load(S, states, base, min(LANES, n - base))
        for k in range(LANES):
            for c in range(3):
                S[STEP_ROW + c * LANES + k] = lengths[min(base + k, n - 1)]
        call_field(field, S, STATE, K0, P)
        advance(S, P, field)
        for k in range(min(LANES, n - base)):
            to_sphere(S, k)
            for c in range(3):
                out[base + k, c] = S[NEW + c * LANES + k]
    return out
