"""Compiled events that end a trajectory: at an attractor, at the equator, at the edge of the view."""

from __future__ import annotations

import math

from ...formulas.jit import call_field, fast_kernel
from .dop853 import dense
from .layout import BLOCK, GAINS, LANES, NEW, PARAMETERS, PSIS, ROW_WIDTH, SIDE_SIGN

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
    for i in range(PSIS):  # the Psi of this lane in all of them
        P2[i] = P[i] if i < SIDE_SIGN else sign if i < GAINS else P[GAINS + lane // BLOCK]
    for i in range(PSIS, PARAMETERS):
        P2[i] = P[PSIS + lane]
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
        P2[m] = 1.0 if SIDE_SIGN <= m < GAINS else P[m]  # outside, at w = rho = FAINT, where w' = w lambda_rho
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
