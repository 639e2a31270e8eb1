"""Compiled return map of the layer problem on the section where x2' has one given direction; see `global_section`.

With ``x2' = U``, the field of `stepping.fields` gives ``U = p' - p w'/w``: the section ``u.U = 0`` needs nothing of
Psi. Lanes step as in `stepping`; a lane that has crossed goes back to the start of its step and finds the length
that ends on the section, so that a crossing is as accurate as a step, not as its dense output.
"""

from __future__ import annotations

import math

import numpy as np

from ..jit import call_field, fast_kernel, inlined_fast_kernel
from ..stepping.dop853 import advance
from ..stepping.layout import K0, K12, LANES, NEW, STATE, STEP_ROW
from .return_map_steps import (
    LANE_TOLERANCE_SHARE,
    TRIALS,
    growth,
    load_state,
    load_system,
    log_step,
    narrow,
    next_length,
    set_lengths,
    step_error,
    to_sphere,
    workspace,
)

RETURNED, TO_CRITICAL_SET, OUTWARD, NO_RETURN_YET = range(4)  # inward: onto C; outward: onto the equator
DONE, FIRST_HALF, AT_HALF_TURN, SECOND_HALF, REFINING = range(5)


@inlined_fast_kernel
def _velocity(S, state, slope, k):
    """``U = x2'`` of one lane."""
    q = S[slope + 2 * LANES + k] / S[state + 2 * LANES + k]
    return S[slope + k] - S[state + k] * q, S[slope + LANES + k] - S[state + LANES + k] * q


# In one piece: with the judging of errors, the search for the end and the halves of a turn as functions of their own it
# took no longer (0.96 of the time, paired runs), but the compiler then rounds otherwise (states by 5e-15).
@fast_kernel
def returns(states, shared, field, u, centre, sense, floor, sunk, t_max, rtol, limit, record, elsewhere):
    """First return of each state to the section ``u.U = 0``, ``sense (-u2, u1).U > 0`` on which it starts.

    Parameters
    ----------
    states : (n, 3)
        (px, py, w) on the section; w > 0.
    shared : (n, SHARED_SIZE) or (1, SHARED_SIZE)
        Parameters of the field, of size about 1: of each state's own system, or of the one of all.
    field : int
        Address of the field: `fields.field`, or `fields.field_of_each` where systems differ.
    u, centre : (n, 2) or (1, 2)
        Direction of the section, and x2 of the critical set.
    sense : (n,) or (1,)
        Its sign is the sense of rotation.
    floor : (n,) or (1,)
        Distance from the centre in x2 below which an orbit has gone inward.
    sunk : (n,) or (1,)
        Fraction of the first w below which an orbit has gone outward.
    t_max : float
    rtol : (n,) or (1,)
    limit : int
        Steps tried.
    record : int
        Room for all steps; 0 records nothing.
    elsewhere : bool
        The states do not lie on the section: it is their first crossing that is wanted.

    Returns
    -------
    ends (n, 3), times (n,), codes (n,)
    steps : (k, 5)
        Where a step starts, its length and whose it is: those of one state in order, several among one another.
    """
    n = states.shape[0]
    ends, times, codes = states.copy(), np.zeros(n), np.full(n, NO_RETURN_YET)
    log, logged = np.empty((record, 5)), 0
    S, P = workspace(shared[0])
    # times the index: where a state's own numbers are
    own, each = 1 if len(shared) > 1 else 0, 1 if len(rtol) > 1 else 0
    phase, tries, spent = np.zeros(LANES, np.int64), np.zeros(LANES, np.int64), np.zeros(LANES, np.int64)
    who, fresh = np.zeros(LANES, np.int64), np.zeros(LANES, np.int64)
    clock, step, allowed = np.zeros(LANES), np.zeros(LANES), np.zeros(LANES)
    low, high, at_low, at_high = np.zeros(LANES), np.zeros(LANES), np.zeros(LANES), np.zeros(LANES)
    side = np.zeros(LANES, np.int64)
    following, done, free = 0, 0, True
    for k in range(LANES if n > 0 else 0):  # an idle lane repeats a harmless state with steps of length 0
        load_state(S, states[0], k)
        load_system(P, shared[0], k)
        phase[k] = DONE
    while done < n:
        if free:
            free = False
            for k in range(LANES):
                fresh[k] = 0
                if phase[k] == DONE and following < n:
                    load_state(S, states[following], k)
                    load_system(P, shared[own * following], k)
                    who[k], fresh[k], phase[k], spent[k] = following, 1, FIRST_HALF, 0
                    tolerance = rtol[each * following]
                    clock[k], step[k], allowed[k] = 0.0, 0.5 * tolerance**0.125, LANE_TOLERANCE_SHARE * tolerance
                    following += 1
            call_field(field, S, STATE, K0, P)
            for k in range(LANES if elsewhere else 0):
                if fresh[k] == 1:
                    # Orbits go round in one sense: where u.U > 0 they come to this section next, else to the opposite.
                    vx, vy = _velocity(S, STATE, K0, k)
                    m = own * who[k]
                    phase[k] = SECOND_HALF if u[m, 0] * vx + u[m, 1] * vy > 0.0 else AT_HALF_TURN
        set_lengths(S, step)
        advance(S, P, field)
        for k in range(LANES):
            if phase[k] == REFINING:
                to_sphere(S, k)
        # Errors before the field at NEW, which belongs on the sphere.
        for k in range(LANES):
            if phase[k] == DONE or phase[k] == REFINING:
                continue
            error = step_error(S, k, allowed[k])
            tries[k] = 1 if error <= 1.0 else 0
            low[k] = step[k]  # the length just tried
            step[k] *= growth(error)
        call_field(field, S, NEW, K12, P)
        for k in range(LANES):
            if phase[k] == DONE:
                continue
            spent[k] += 1
            m = own * who[k]
            u1, u2 = u[m, 0], u[m, 1]
            vx, vy = _velocity(S, NEW, K12, k)
            g = u1 * vx + u2 * vy
            if phase[k] == REFINING:
                h = step[k]
                tries[k] += 1
                narrow(k, g > 0.0, g, step, low, at_low, high, at_high, side)
                size = math.sqrt(vx * vx + vy * vy)
                if abs(g) > 1e-16 * size and high[k] - low[k] > 4e-16 * high[k] and tries[k] < TRIALS:
                    step[k] = next_length(k, low, at_low, high, at_high)
                    continue
                if record > 0:
                    logged = log_step(log, logged, S, k, h, who[k])
                codes[who[k]], times[who[k]] = RETURNED, clock[k] + h
                phase[k] = DONE
            elif tries[k] == 1:
                h = low[k]
                forward = sense[m] * (u1 * vy - u2 * vx)
                if phase[k] == FIRST_HALF and forward < 0.0:
                    phase[k] = AT_HALF_TURN
                if phase[k] == AT_HALF_TURN and g > 0.0:
                    phase[k] = SECOND_HALF
                elif phase[k] == SECOND_HALF and g <= 0.0:
                    ox, oy = _velocity(S, STATE, K0, k)
                    low[k], at_low[k], high[k], at_high[k] = 0.0, u1 * ox + u2 * oy, h, g
                    step[k] = h * at_low[k] / (at_low[k] - g)
                    phase[k], tries[k], side[k] = REFINING, 0, 0
                    continue
                if record > 0:
                    logged = log_step(log, logged, S, k, h, who[k])
                clock[k] += h
                w = S[NEW + 2 * LANES + k]
                dx, dy = S[NEW + k] / w - centre[m, 0], S[NEW + LANES + k] / w - centre[m, 1]
                if dx * dx + dy * dy < floor[m] * floor[m]:
                    codes[who[k]], times[who[k]], phase[k] = TO_CRITICAL_SET, clock[k], DONE
                elif w < sunk[m] * states[who[k], 2]:
                    codes[who[k]], times[who[k]], phase[k] = OUTWARD, clock[k], DONE
                elif clock[k] >= t_max:
                    times[who[k]], phase[k] = clock[k], DONE
                for c in range(3):
                    S[STATE + c * LANES + k] = S[NEW + c * LANES + k]
                    S[K0 + c * LANES + k] = S[K12 + c * LANES + k]
            if phase[k] == DONE:
                for c in range(3):
                    ends[who[k], c] = S[NEW + c * LANES + k]
                step[k], free = 0.0, True
                done += 1
        for k in range(LANES):
            if phase[k] != DONE and spent[k] >= limit:  # given up: its end stays where it began
                phase[k], step[k], free = DONE, 0.0, True
                done += 1
    return ends, times, codes, log[:logged]


@fast_kernel
def single_step(states, lengths, shared, whose, field):
    """Take one step of given length (n,) from each state (n, 3): for short ones as accurate as the stepping.

    The parameters (m, SHARED) of the field are in the rows whose (n,).
    """
    n = states.shape[0]
    out = np.empty((n, 3))
    S, P = workspace(shared[0])
    for base in range(0, n, LANES):
        for k in range(LANES):
            i = min(base + k, n - 1)
            load_system(P, shared[whose[i]], k)
            for c in range(3):
                S[STATE + c * LANES + k] = states[i, c]
                S[STEP_ROW + c * LANES + k] = lengths[i]
        call_field(field, S, STATE, K0, P)
        advance(S, P, field)
        for k in range(min(LANES, n - base)):
            x, y, w = S[NEW + k], S[NEW + LANES + k], S[NEW + 2 * LANES + k]
            length = 1.0 / math.sqrt(x * x + y * y + w * w)
            out[base + k, 0], out[base + k, 1], out[base + k, 2] = x * length, y * length, w * length
    return out
