"""The slow flow on a critical set, compiled: a right-hand side in the place of that of a motion.

The state is (e, z): ``U(e, 0, 0, z) = 0`` and ``z' = W(e, 0, 0, z)``, (4.17), with
``e' = -(D_e U)^-1 D_z U W``. The e of the state is where Newton's method starts; what it finds is the e that W is taken
at, so that an error of e does not add up. A set that is lost, or another that is found, makes the step's error large,
and the step shorter.

The way out of Sigma along a limit direction: the expansion at Sigma that a first, short step is made of.

Where lambda_rho > 0 it is the unstable manifold of Q in (rho, theta, z): rho = lambda_rho t + O(t^2), with
theta - theta_Q linear in t. Where a critical set has just reached the equator at Q (Figure 19), lambda_rho grows
from 0 as beta t, rho = beta t^2/2 + O(t^3), and theta follows Q(z).
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any

import numpy as np

from ....formulas.jit import bits_of_double, call_field, carray, compile_address, held_kernel, kernel
from ....formulas.names import MOST_SLOW_VARIABLES
from .explicit import ROOM
from .rate import ROUNDING

MAX_NEWTON, MAX_CORRECTION = 20, 1.0  # iterations, and the longest step of one
NEWTON_TOLERANCE = 1e-10  # a step so short that the next would be rounding
ONE_SIDED_DISTANCE = 1e-9  # as in `field`: where a slope is undefined

# Behind the workspace of a motion: the addresses of U, W and of their slopes, as bits; m; and the arguments, values and
# slopes of both at one place.
VALUE, SLOPES, SLOW_RATES = ROOM, ROOM + 1, ROOM + 2
SET_PLACE = ROOM + 4
RATES = SET_PLACE + 4 + MOST_SLOW_VARIABLES
TABLE = RATES + 4 + MOST_SLOW_VARIABLES
SLOW_EXTENT = TABLE + (2 + MOST_SLOW_VARIABLES) * (4 + MOST_SLOW_VARIABLES)


@kernel
def write_slopes(S, m):
    """Write the slopes at a place; where they are undefined those a rounding away, or 0."""
    slopes, count, whole = bits_of_double(S[SLOPES]), (2 + m) * (4 + m), True
    call_field(slopes, S, SET_PLACE, TABLE, S)
    for i in range(count):
        whole = whole and math.isfinite(S[TABLE + i])
    if whole:
        return
    for i in range(4 + m):
        S[RATES + i] = S[SET_PLACE + i]  # kept there: the rates are requested after the slopes
        S[SET_PLACE + i] += ONE_SIDED_DISTANCE * (1.0 + abs(S[SET_PLACE + i]))
    call_field(slopes, S, SET_PLACE, TABLE, S)
    for i in range(4 + m):
        S[SET_PLACE + i] = S[RATES + i]
    for i in range(count):
        S[TABLE + i] = S[TABLE + i] if math.isfinite(S[TABLE + i]) else 0.0


@kernel
def write_at(S, m, c, s):
    """Write U, W and their slopes at e = (c, s) on Sigma, at the z in place."""
    S[SET_PLACE], S[SET_PLACE + 1], S[SET_PLACE + 2], S[SET_PLACE + 3] = c, s, 0.0, 0.0
    write_slopes(S, m)
    call_field(bits_of_double(S[VALUE]), S, SET_PLACE, RATES, S)


@kernel
def found_set(S, m):
    """Find the critical set near the e in place, by Newton's method, and its rates; say whether there is one."""
    value, width = bits_of_double(S[VALUE]), 4 + m
    S[SET_PLACE + 2] = S[SET_PLACE + 3] = 0.0
    for _ in range(MAX_NEWTON):
        write_slopes(S, m)
        call_field(value, S, SET_PLACE, RATES, S)
        u, v = S[RATES], S[RATES + 1]
        j11, j12, j21, j22 = S[TABLE], S[TABLE + 1], S[TABLE + width], S[TABLE + width + 1]
        inverse = 1.0 / (j11 * j22 - j12 * j21)
        du, dv = (j22 * u - j12 * v) * inverse, (j11 * v - j21 * u) * inverse
        if not (abs(du) < MAX_CORRECTION and abs(dv) < MAX_CORRECTION):  # also where it is undefined
            return False
        S[SET_PLACE] -= du
        S[SET_PLACE + 1] -= dv
        if max(abs(du), abs(dv)) <= NEWTON_TOLERANCE:
            call_field(value, S, SET_PLACE, RATES, S)
            return True
    return False


@kernel
def _critical_velocity(S, m, u, v):
    """Return how e moves where U moves by (u, v)."""
    width = 4 + m
    j11, j12, j21, j22 = S[TABLE], S[TABLE + 1], S[TABLE + width], S[TABLE + width + 1]
    inverse = -1.0 / (j11 * j22 - j12 * j21)
    return (j22 * u - j12 * v) * inverse, (j11 * v - j21 * u) * inverse


def _slow_velocity(state, out, parameters):
    """Write (e', z') at a state."""
    A, D = carray(state, (4 + MOST_SLOW_VARIABLES,)), carray(out, (2 + MOST_SLOW_VARIABLES,))
    S = carray(parameters, (SLOW_EXTENT,))
    m = int(S[SLOW_RATES])
    S[SET_PLACE], S[SET_PLACE + 1] = A[2], A[3]  # the motion's own (x, y)
    for i in range(m):
        S[SET_PLACE + 4 + i] = A[4 + i]
    if not found_set(S, m):
        for i in range(2 + m):
            D[i] = math.nan
        return
    u, v = 0.0, 0.0
    for i in range(m):
        D[2 + i] = S[RATES + 2 + i]
        u += S[TABLE + 4 + i] * D[2 + i]
        v += S[TABLE + 8 + m + i] * D[2 + i]
    D[0], D[1] = _critical_velocity(S, m, u, v)


def _slow_slopes(state, out, parameters):
    """Write the derivatives of (e', z') by z at a state; of e' but for those of D_z e, which are never stiff."""
    A, S = carray(state, (4 + MOST_SLOW_VARIABLES,)), carray(parameters, (SLOW_EXTENT,))
    m = int(S[SLOW_RATES])
    width = 4 + m
    D = carray(out, ((2 + m) * width,))
    S[SET_PLACE], S[SET_PLACE + 1] = A[2], A[3]
    for i in range(m):
        S[SET_PLACE + 4 + i] = A[4 + i]
    there = found_set(S, m)
    for i in range((2 + m) * width):
        D[i] = 0.0
    if not there:
        return
    for j in range(m):
        c, s = _critical_velocity(S, m, S[TABLE + 4 + j], S[TABLE + width + 4 + j])
        u, v = 0.0, 0.0
        for i in range(2, 2 + m):
            row = TABLE + i * width
            D[i * width + 4 + j] = S[row + 4 + j] + S[row] * c + S[row + 1] * s
            u += S[TABLE + 2 + i] * D[i * width + 4 + j]
            v += S[TABLE + width + 2 + i] * D[i * width + 4 + j]
        D[4 + j], D[width + 4 + j] = _critical_velocity(S, m, u, v)


@held_kernel
def sets(S, points):
    """Find the critical sets near points (k, 2 + m), (e, z): e (k, 2), NaN where there is none, and D_e U (k, 2, 2)."""
    k, n = points.shape
    e, D = np.empty((k, 2)), np.empty((k, 2, 2))
    for i in range(k):
        S[SET_PLACE], S[SET_PLACE + 1] = points[i, 0], points[i, 1]
        for j in range(2, n):
            S[SET_PLACE + 2 + j] = points[i, j]
        there = found_set(S, n - 2)
        for a in range(2):
            e[i, a] = S[SET_PLACE + a] if there else math.nan
            for b in range(2):
                D[i, a, b] = S[TABLE + a * (n + 2) + b]
    return e, D


@lru_cache(maxsize=1)
def flow() -> tuple[Any, Any]:
    """Return the slow flow and its slopes, the same for all systems, at addresses."""
    return compile_address(_slow_velocity), compile_address(_slow_slopes)


FAST_START, SLOW_START = 1e-9, 1e-5  # first part, of the time ahead or of the rates' own, covered by an expansion
TILT = 1e-6  # largest angle that this expansion may cover
MAX_POLISHING, MAX_POLISH = 6, 0.05  # steps to polish theta, and how far one may go
NEUTRAL_RATE = 1e-7  # of the size of U's slopes: lambda_rho counts as zero, where it grows
LEAST_EXCESS = 8.0 * ROUNDING  # of the friction along the way out: what a force exceeds it by is rounding
NOTHING_LEAVES, REPELS_ANGULARLY = 0.0, -1.0


@kernel
def _pace(rate, change):
    """Time in which a rate that changes at this rate becomes another; infinite where it stands, or does not change."""
    return abs(rate / change) if rate != 0.0 and change != 0.0 else math.inf


@kernel
def _polish_theta(S, m, theta):
    """Return the zero of Theta near theta, by Newton's method; theta itself where there is none."""
    angle, width = theta, 4 + m
    for _ in range(MAX_POLISHING):
        c, s = math.cos(angle), math.sin(angle)
        write_at(S, m, c, s)
        u, v = S[RATES], S[RATES + 1]
        D11, D12, D21, D22 = S[TABLE], S[TABLE + 1], S[TABLE + width], S[TABLE + width + 1]
        rate = s * (s * D11 - c * D12) + c * (c * D22 - s * D21) - (c * u + s * v)
        change = (c * v - s * u) / rate
        if not abs(change) < MAX_POLISH:
            return theta
        angle -= change
    return angle


@held_kernel
def leave(S, m, n1, n2, theta, ahead, linear, square):
    """Write the first step away from Sigma, linear and square (2 + m,); return its length, or why there is none."""
    width, in_line = 4 + m, n1 != 0.0 or n2 != 0.0
    if not in_line:
        theta = _polish_theta(S, m, theta)
    c, s = math.cos(theta), math.sin(theta)
    if in_line:  # exactly
        side = math.copysign(1.0, n1 * c + n2 * s)
        c, s = side * n1, side * n2
    write_at(S, m, c, s)
    u, v = S[RATES], S[RATES + 1]
    D11, D12, D21, D22 = S[TABLE], S[TABLE + 1], S[TABLE + width], S[TABLE + width + 1]
    across1, across2 = c * D12 - s * D11, c * D22 - s * D21
    radial = c * u + s * v
    angular = c * across2 - s * across1 - radial
    size = max(max(abs(D11), abs(D12)), max(abs(D21), abs(D22))) + math.hypot(u, v)
    if not in_line and not angular < 0.0:
        return REPELS_ANGULARLY
    drift1, drift2 = 0.0, 0.0
    for j in range(m):
        drift1 += S[TABLE + 4 + j] * S[RATES + 2 + j]
        drift2 += S[TABLE + width + 4 + j] * S[RATES + 2 + j]
    for i in range(2 + m):
        linear[i] = square[i] = 0.0
    # On the equator and on the critical set U = 0: lambda_rho and Theta both vanish.
    neutral_turning = 0.0 if in_line else -(c * drift2 - s * drift1) / angular
    beta = c * drift1 + s * drift2 + (c * across1 + s * across2) * neutral_turning
    excess = LEAST_EXCESS * (abs(c) * (abs(D11 * c) + abs(D12 * s)) + abs(s) * (abs(D21 * c) + abs(D22 * s)))
    if radial > NEUTRAL_RATE * size or (radial > excess and not beta > 0.0):
        outward1 = drift1 + radial * (S[TABLE + 2] * c + S[TABLE + 3] * s)
        outward2 = drift2 + radial * (S[TABLE + width + 2] * c + S[TABLE + width + 3] * s)
        forced = 0.0 if in_line else c * outward2 - s * outward1
        turning = forced / (radial - angular) if forced != 0.0 else 0.0
        speed, bend = 0.0, 0.0
        for i in range(m):
            row = TABLE + (2 + i) * width
            change = (c * S[row + 1] - s * S[row]) * turning + (c * S[row + 2] + s * S[row + 3]) * radial
            for j in range(m):
                change += S[row + 4 + j] * S[RATES + 2 + j]
            speed, bend = max(speed, abs(S[RATES + 2 + i])), max(bend, abs(change))
        h = FAST_START * min(ahead, _pace(radial, c * outward1 + s * outward2), _pace(speed, bend))
        h = min(h, TILT / abs(turning)) if turning != 0.0 else h
        if not in_line:
            c, s = math.cos(theta + turning * h), math.sin(theta + turning * h)
        linear[0], linear[1] = radial * h * c, radial * h * s
        for j in range(m):
            linear[2 + j] = S[RATES + 2 + j] * h
        return h
    if radial < -NEUTRAL_RATE * size or not beta > 0.0:
        return NOTHING_LEAVES
    turning = neutral_turning
    h = SLOW_START * min(ahead, abs(angular if angular != 0.0 else size) / beta)
    if radial + beta * h < excess:  # it can be held for longer
        return NOTHING_LEAVES
    h = min(h, 1e-2 * math.sqrt(TILT) / abs(turning)) if turning != 0.0 else h
    for i in range(m):
        row, bend = TABLE + (2 + i) * width, 0.0
        bend = (c * S[row + 1] - s * S[row]) * turning
        for j in range(m):
            bend += S[row + 4 + j] * S[RATES + 2 + j]
        linear[2 + i], square[2 + i] = S[RATES + 2 + i] * h, 0.5 * h * h * bend
    if not in_line:
        c, s = math.cos(theta + turning * h), math.sin(theta + turning * h)
    linear[0], linear[1] = max(radial, 0.0) * h * c, max(radial, 0.0) * h * s
    square[0], square[1] = 0.5 * beta * h * h * c, 0.5 * beta * h * h * s
    return h
