"""Whole motions in the limit eps -> 0, compiled: slip, arrival, slide, end at the equator, and so on.

A phase is followed as far as safe signs tell what comes next: that an arrival slides (`arrival`), that a slide
goes on or ends at the equator (`ends`), that there is one way out (`departure_step`). Where they do not, the
motion is handed over where that phase began.
"""

from __future__ import annotations

import math

import numpy as np

from ...jit import double_of_bits, kernel
from ...stepping.field_parameters import PSI
from ...stepping.layout import PARAMETERS
from ..safe_steps import SAFE_DEGREE
from . import explicit
from .arrival import slides
from .departure_step import leave
from .ends import GAUGES, SAFE, UNSURE_END, determinant, step_end
from .motion import (
    AT_SIGMA,
    CHUNK_FULL,
    CONTROL,
    FINISHED,
    FIRST_STEP_SHARE,
    LEAST_STEP,
    NEXT,
    STEPS_PER_CALL,
    integrate_motion,
    longer,
    prepare_motion,
)
from .rate import MotionConstants, rate
from .slow import RATES, SET_PLACE, SLOPES, SLOW_EXTENT, SLOW_RATES, VALUE, found_set
from .stages import tableau_of, work_on

SLIP, SLIDE, LEAVE = range(3)  # what a phase is; one that begins with LEAVE is a slip
PHASE_NUMBERS = 5  # numbers of a phase: its motion, what it is, its first and last step, the angle it comes along
TOLD = 5  # numbers of a motion: its steps and phases, what is handed over (or WHOLE), the angle, evaluations
WHOLE = -1
MIN_STEP = 1e-14  # of the time in which z changes by its own size: shorter steps mean that a set ends
#: Of rtol, asked of the steps of a slip: explicit ones use up what is allowed, implicit ones leave most of it.
OF_SLIPS = 0.5


@kernel
def _in_place(S, z):
    """Put z, the end of a state, in place."""
    for i in range(2, len(z)):
        S[SET_PLACE + 2 + i] = z[i]


@kernel
def _first_step(S, y, floor):
    """First step tried of a slide: a small part of the time in which z changes by its own size."""
    speed = 0.0
    for i in range(2, len(y)):
        speed = max(speed, abs(S[RATES + i]) / (abs(y[i]) + floor))
    return FIRST_STEP_SHARE / speed if speed > 0.0 else math.inf


@kernel
def _truncate_polynomial(polynomial, u):
    """Make a step's polynomial that of its part up to u."""
    power = 1.0
    for k in range(polynomial.shape[1]):
        power *= u
        for i in range(len(polynomial)):
            polynomial[i, k] *= power


@kernel
def _on_sigma(S, sign, line1, line2, raw, values, lengths, ends, polynomials, sets):
    """Look along the steps of (e, z) of a slide: make them steps of a state on Sigma, and keep e at their ends.

    Parameters
    ----------
    raw : (n,)
        (e, z) where the first begins; moves on.
    lengths (k,), ends (k, n), polynomials (k, n, 7), sets (k, 2)

    Returns
    -------
    (int, int)
        SAFE, EQUATOR or UNSURE; and how many steps the slide has.
    """
    n = len(raw)
    for a in range(len(lengths)):
        what, u = step_end(S, raw, polynomials[a], sign, line1, line2, values)
        if what == UNSURE_END:
            return what, a
        for i in range(n):
            raw[i] = ends[a, i]
        if what != SAFE:
            _truncate_polynomial(polynomials[a], u)
            lengths[a] *= u
            for i in range(2, n):
                ends[a, i] = S[SET_PLACE + 2 + i]
        sets[a, 0], sets[a, 1] = S[SET_PLACE], S[SET_PLACE + 1]
        for i in range(2):
            ends[a, i] = 0.0
            for k in range(polynomials.shape[2]):
                polynomials[a, i, k] = 0.0
        if what != SAFE:
            return what, a + 1
    return SAFE, len(lengths)


@kernel
def _keep_step(y, linear, square, row, states, polynomials):
    """Move the state over a step whose polynomial is `linear` u + `square` u^2, and keep it."""
    n, each = len(y), explicit.DENSE_DEGREE * len(y)
    for j in range(n):
        y[j] += linear[j] + square[j]
        states[(row + 1) * n + j] = y[j]
        for a in range(explicit.DENSE_DEGREE):
            polynomials[row * each + j * explicit.DENSE_DEGREE + a] = 0.0
        polynomials[row * each + j * explicit.DENSE_DEGREE] = linear[j]
        polynomials[row * each + j * explicit.DENSE_DEGREE + 1] = square[j]


@kernel
def _straight_on(motion, S, y, rates, linear, square):
    """Write the rest of the way to Sigma, which is straight; return its time, or infinity where it leads away."""
    rate(motion, y, S, rates)
    rho = math.hypot(y[0], y[1])
    inward = -(y[0] * rates[0] + y[1] * rates[1]) / rho
    if not inward > 0.0:
        return math.inf
    for j in range(len(y)):
        linear[j] = -y[j] if j < 2 else rho / inward * rates[j]
        square[j] = 0.0
    return rho / inward


@kernel
def _begun_slide(S, y, floor, control, ahead):
    """Put the set that a slide begins on in place, and its first step; say whether it is there, and the sign of det."""
    _in_place(S, y)
    S[SET_PLACE], S[SET_PLACE + 1] = y[0], y[1]
    there = found_set(S, len(y) - 2)
    first = _first_step(S, y, floor)
    control[NEXT], control[LEAST_STEP] = first, MIN_STEP * min(first / FIRST_STEP_SHARE, ahead)
    return there, math.copysign(1.0, determinant(S, len(y)))


@kernel
def _roomier(n, times, lengths, states, polynomials, sets):
    """Return the arrays of all rows with room for more than twice as many."""
    room = 2 * len(times) + STEPS_PER_CALL
    each = explicit.DENSE_DEGREE * n
    times, lengths, sets = longer(times, room), longer(lengths, room), longer(sets, 2 * room)
    return times, lengths, longer(states, room * n), longer(polynomials, room * each), sets


@kernel
def follow_courses(addresses, numbers, coefficients, lines, first, most):
    """Follow one motion from each state outside Sigma, as far as it is decided.

    Parameters
    ----------
    addresses : int64 (6,)
        Of the field, its slopes and the gain of eps = 0; of the slow flow and its slopes; of the gain of Psi.
    numbers : (7,)
        rtol, floor, t_start, t_end, parameter of Psi, whether U is affine in e, whether Psi is known.
    coefficients
        As for `tableau_of`.
    lines : (k, 2)
        The invariant line of each, or 0.
    first : (k, n)
    most : float
        Steps and phases, each.

    Returns
    -------
    times, lengths (N,), states (N n,), polynomials (N 7 n,), sets (N 2,)
        As of `motion.follow_all`; and e there, where a motion slides.
    phases : (p ROW,)
    told : (k, TOLD)
    """
    # One loop over phases: they share some twenty numbers and arrays. What is a step by itself is a function above, at
    # the same speed (0.93 to 0.95 of one body, 30 pairs) and with the same bits.
    k, n = first.shape
    m, each = n - 2, explicit.DENSE_DEGREE * n
    rtol, floor, t_end, affine, known = numbers[0], numbers[1], numbers[3], numbers[5] != 0.0, numbers[6] != 0.0
    S, P = np.zeros(SLOW_EXTENT), np.zeros(PARAMETERS)
    S[VALUE], S[SLOPES], S[SLOW_RATES] = double_of_bits(addresses[0]), double_of_bits(addresses[1]), m
    P[PSI] = numbers[4]
    work, table = work_on(S, n), tableau_of(coefficients)
    clock, control, y, raw, rates = np.zeros(4), np.zeros(CONTROL), np.zeros(n), np.zeros(n), np.zeros(n)
    linear, square, values = np.zeros(n), np.zeros(n), np.zeros((GAUGES, SAFE_DEGREE + 1))
    room, row = STEPS_PER_CALL + 64 * k, 0
    times, lengths, states, polynomials = np.empty(room), np.empty(room), np.empty(room * n), np.empty(room * each)
    sets, phases, count = np.empty(2 * room), np.empty(PHASE_NUMBERS * (8 + 4 * k)), 0
    told = np.zeros((k, TOLD))
    for i in range(k):
        line1, line2 = lines[i, 0], lines[i, 1]
        slip = MotionConstants(addresses[0], addresses[1], addresses[2], n, 0.0, OF_SLIPS * rtol, floor, line1, line2)
        # eps is read as the size by which errors of e are measured: 1 and more
        slow = MotionConstants(addresses[3], addresses[4], addresses[2], n, 1.0, rtol, floor, line1, line2)
        begun, begun_phases, kind, theta, evaluations = row, count, SLIP, math.nan, 0.0
        for j in range(n):
            y[j] = first[i, j]
        while True:
            # A phase: from `start`, with y there.
            start, decided, onward, came = row, False, WHOLE, theta
            if row + 4 >= len(times):
                times, lengths, states, polynomials, sets = _roomier(n, times, lengths, states, polynomials, sets)
            if row == begun:
                times[row] = numbers[2]
            for j in range(n):
                states[row * n + j] = y[j]
            left, clock[3] = most - (row - begun) - (count - begun_phases), 0.0
            sliding, sign, going = kind == SLIDE, 1.0, left > 0.0
            if sliding:
                states[row * n], states[row * n + 1] = 0.0, 0.0
                sets[2 * row], sets[2 * row + 1] = y[0], y[1]
            if going and sliding and m == 0:
                lengths[row], times[row + 1] = t_end - times[row], t_end
                for j in range(each):
                    polynomials[row * each + j] = 0.0
                for j in range(2):
                    states[(row + 1) * n + j], sets[2 * (row + 1) + j] = 0.0, y[j]
                row, going, decided = row + 1, False, True
            if going and kind == LEAVE:
                _in_place(S, y)
                h = leave(S, m, line1, line2, theta, t_end - times[row], linear, square)
                going = h > 0.0
                lengths[row], times[row + 1] = h, times[row] + h
                _keep_step(y, linear, square, row, states, polynomials)
                row += 1
            motion = slow if sliding else slip
            if going:
                going = prepare_motion(motion, y, clock, control, times[row], t_end, left, work)
            if going and sliding:
                going, sign = _begun_slide(S, y, floor, control, t_end - times[row])
                for j in range(n):
                    raw[j] = y[j]
            while going:
                if row + STEPS_PER_CALL >= len(times):
                    times, lengths, states, polynomials, sets = _roomier(n, times, lengths, states, polynomials, sets)
                ends = states[(row + 1) * n : (row + STEPS_PER_CALL) * n].reshape((STEPS_PER_CALL - 1, n))
                ways = polynomials[row * each : (row + STEPS_PER_CALL - 1) * each].reshape(
                    (STEPS_PER_CALL - 1, n, explicit.DENSE_DEGREE)
                )
                code, filled = integrate_motion(
                    motion, table, work, y, clock, control,
                    times[row + 1 : row + STEPS_PER_CALL], lengths[row : row + STEPS_PER_CALL - 1], ends, ways,
                )  # fmt: skip
                if sliding:
                    what, filled = _on_sigma(
                        S, sign, line1, line2, raw, values, lengths[row : row + filled], ends, ways,
                        sets[2 * (row + 1) : 2 * (row + STEPS_PER_CALL)].reshape((STEPS_PER_CALL - 1, 2)),
                    )  # fmt: skip
                    if what == UNSURE_END:
                        break
                    if what != SAFE:
                        last = row + filled
                        onward, decided = LEAVE, True
                        theta = math.atan2(sets[2 * last + 1], sets[2 * last])
                        for j in range(n):
                            y[j] = states[last * n + j]
                for a in range(row, row + filled):  # from a step's start to its end, never decreasing
                    times[a + 1] = max(times[a], times[a + 1] + lengths[a])
                row += filled
                if decided:
                    break
                if code == FINISHED:
                    times[row], decided = t_end, True
                    break
                if code == AT_SIGMA:
                    h = _straight_on(motion, S, y, rates, linear, square)
                    if clock[0] + h < t_end:
                        theta, lengths[row] = math.atan2(y[1], y[0]), h
                        times[row + 1] = max(times[row], clock[0] + h)
                        _keep_step(y, linear, square, row, states, polynomials)
                        row += 1
                        _in_place(S, y)
                        decided, onward = slides(S, P, addresses[5], n, affine, known, line1, line2, theta), SLIDE
                        break
                elif code != CHUNK_FULL:
                    break
            evaluations += clock[3]
            if not decided:
                row, theta = start, came
                break
            if PHASE_NUMBERS * (count + 1) > len(phases):
                phases = longer(phases, 2 * len(phases))
            at = PHASE_NUMBERS * count
            phases[at], phases[at + 1], phases[at + 2], phases[at + 3] = i, kind, start - begun, row - begun
            phases[at + 4] = came
            count += 1
            kind = onward
            if kind == WHOLE or not times[row] < t_end:
                kind = WHOLE
                break
            if kind == SLIDE:
                y[0], y[1] = S[SET_PLACE], S[SET_PLACE + 1]
        told[i, 0], told[i, 1], told[i, 2], told[i, 3] = row - begun, count - begun_phases, kind, theta
        told[i, 4] = evaluations
        row += 1
    return (
        times[:row], lengths[:row], states[: row * n], polynomials[: row * each], sets[: 2 * row],
        phases[: PHASE_NUMBERS * count], told,
    )  # fmt: skip
