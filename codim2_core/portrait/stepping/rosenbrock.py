"""Compiled implicit stepping of the trajectories that creep along a slow direction, in the lanes of `lanes`.

Next to a strongly attracting direction an explicit step is bound to the fast rate, however slow the motion has become.
A Rosenbrock method takes steps of the slow one: stiffly accurate, L-stable, of order 4 with an estimate of order 3 and
dense output, whose coefficients go where DOP853's do, so that lines are drawn in the same way.

What is stepped is ``y' = F(P(y))`` with a projection P to the sphere (outside: of p to the circle), the same flow on it
for any F, so that no formula is evaluated off it: up the hemisphere along w, so that what is straight in the
disc stays straight, and near the equator towards the centre.

E. Hairer, G. Wanner, "Solving Ordinary Differential Equations II", 2nd ed., sec. IV.7: the method RODAS.
"""

from __future__ import annotations

import math

import numpy as np

from ...formulas.jit import call_field, fast_kernel
from .dop853 import dense
from .lanes import MAX_GROWTH, MAX_SHRINKAGE, STEP_SAFETY
from .layout import (
    DENSE_ROWS,
    K0,
    K1,
    K2,
    K3,
    K4,
    K5,
    K6,
    K7,
    K12,
    LANES,
    NEW,
    PARAMETERS,
    ROW_WIDTH,
    SIDE_SIGN,
    STATE,
    TRIAL,
    WORKSPACE,
)
from .polyline import (
    CURSOR,
    INTERIOR,
    MIRROR,
    ON_EQUATOR_ATTRACTOR,
    X,
    Y,
    append_step,
    end_line,
    is_captured,
    keep_line,
    left_view,
    length_of,
    longer,
    start,
)

# As in `lanes`
T_MAX, EQUILIBRIUM, LEFT_VIEW, AT_LIMIT_DIRECTION, STEP_LIMIT, LENGTH, RUNNING = 0, 1, 2, 3, 6, 7, -1
GAMMA = 0.25
DIFFERENCE_STEP = 1e-5  # of the central differences of the Jacobian; of w: of w itself

FIRST_STEP = 0.02
HIGH = 0.1  # ebar above which the projection is along w
MIN_W = 1e-7  # below this w its error counts as if it were this large: the rest is far below a pixel
CALLS = 13  # evaluations a step: 6 stages, 6 for the Jacobian, one to see whether it has arrived


@fast_kernel
def _project(S, P, high, at):
    """Bring a row to the sphere (outside: p to the circle)."""
    for k in range(LANES):
        x, y, w = S[at + k], S[at + LANES + k], S[at + 2 * LANES + k]
        inside = 0.5 - 0.5 * P[SIDE_SIGN + k]
        r2 = x * x + y * y
        up = high[k] > 0.5 and r2 < 0.9999
        length = 1.0 if up else 1.0 / math.sqrt(r2 + inside * w * w)
        S[at + k] = x * length
        S[at + LANES + k] = y * length
        S[at + 2 * LANES + k] = math.sqrt(1.0 - r2) if up else abs(w) * (length if inside > 0.5 else 1.0)


@fast_kernel
def _inverse(S, P, high, field, h, J, M):
    """Write ``(I/(GAMMA h) - J)^-1`` of every lane, J of the projected field by central differences; M : (9, LANES)."""
    for c in range(3):
        for side in range(2):
            for m in range(ROW_WIDTH):
                S[TRIAL + m] = S[STATE + m]
            for k in range(LANES):
                d = DIFFERENCE_STEP * (1.0 if c < 2 else S[STATE + 2 * LANES + k])
                S[TRIAL + c * LANES + k] += d if side == 0 else -d
            _project(S, P, high, TRIAL)
            call_field(field, S, TRIAL, K6 if side == 0 else K7, P)
        for k in range(LANES):
            d = DIFFERENCE_STEP * (1.0 if c < 2 else S[STATE + 2 * LANES + k])
            inverse = 0.5 / d if d > 1e-300 else 0.0
            for r in range(3):
                J[3 * r + c, k] = (S[K6 + r * LANES + k] - S[K7 + r * LANES + k]) * inverse
    for k in range(LANES):
        g = 1.0 / (GAMMA * h[k])
        a, b, c = g - J[0, k], -J[1, k], -J[2, k]
        d, e, f = -J[3, k], g - J[4, k], -J[5, k]
        p, q, r = -J[6, k], -J[7, k], g - J[8, k]
        A, B, C = e * r - f * q, f * p - d * r, d * q - e * p
        inverse = 1.0 / (a * A + b * B + c * C)
        M[0, k], M[1, k], M[2, k] = A * inverse, (c * q - b * r) * inverse, (b * f - c * e) * inverse
        M[3, k], M[4, k], M[5, k] = B * inverse, (a * r - c * p) * inverse, (c * d - a * f) * inverse
        M[6, k], M[7, k], M[8, k] = C * inverse, (b * p - a * q) * inverse, (a * e - b * d) * inverse


@fast_kernel
def _solve(S, M, source, c1, c2, c3, c4, c5, h, target):
    """``M (S[source] + (c1 K1 + ... + c5 K5)/h)`` to a row; the increments of the stages are in K1 to K5."""
    for k in range(LANES):
        x, y, w = 0.0, 0.0, 0.0
        i = 1.0 / h[k]
        x = S[source + k] + i * (c1 * S[K1 + k] + c2 * S[K2 + k] + c3 * S[K3 + k] + c4 * S[K4 + k] + c5 * S[K5 + k])
        n = LANES + k
        y = S[source + n] + i * (c1 * S[K1 + n] + c2 * S[K2 + n] + c3 * S[K3 + n] + c4 * S[K4 + n] + c5 * S[K5 + n])
        n = 2 * LANES + k
        w = S[source + n] + i * (c1 * S[K1 + n] + c2 * S[K2 + n] + c3 * S[K3 + n] + c4 * S[K4 + n] + c5 * S[K5 + n])
        S[target + k] = M[0, k] * x + M[1, k] * y + M[2, k] * w
        S[target + LANES + k] = M[3, k] * x + M[4, k] * y + M[5, k] * w
        S[target + 2 * LANES + k] = M[6, k] * x + M[7, k] * y + M[8, k] * w


@fast_kernel
def _stage(S, P, high, field, a1, a2, a3, a4, a5):
    """Put the field at ``STATE + a1 K1 + ... + a5 K5`` into K6."""
    for m in range(ROW_WIDTH):
        S[TRIAL + m] = S[STATE + m] + (
            a1 * S[K1 + m] + a2 * S[K2 + m] + a3 * S[K3 + m] + a4 * S[K4 + m] + a5 * S[K5 + m]
        )
    _project(S, P, high, TRIAL)
    call_field(field, S, TRIAL, K6, P)


@fast_kernel
def advance(S, P, high, field, h, J, M):
    """One trial step of every lane: from STATE and K0 to NEW, the error in K7, and the dense output in DENSE."""
    _inverse(S, P, high, field, h, J, M)
    for m in range(5 * ROW_WIDTH):
        S[K1 + m] = 0.0
    _solve(S, M, K0, 0.0, 0.0, 0.0, 0.0, 0.0, h, K1)
    _stage(S, P, high, field, 1.544, 0.0, 0.0, 0.0, 0.0)
    _solve(S, M, K6, -5.6688, 0.0, 0.0, 0.0, 0.0, h, K2)
    _stage(S, P, high, field, 0.9466785280815826, 0.2557011698983284, 0.0, 0.0, 0.0)
    _solve(S, M, K6, -2.430093356833875, -0.2063599157091915, 0.0, 0.0, 0.0, h, K3)
    _stage(S, P, high, field, 3.314825187068521, 2.896124015972201, 0.9986419139977817, 0.0, 0.0)
    _solve(S, M, K6, -0.1073529058151375, -9.594562251023355, -20.47028614809616, 0.0, 0.0, h, K4)
    _stage(S, P, high, field, 1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950, 0.0)
    _solve(S, M, K6, 7.496443313967647, -10.24680431464352, -33.99990352819905, 11.70890893206160, 0.0, h, K5)
    _stage(S, P, high, field, 1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950, 1.0)
    _solve(
        S,
        M,
        K6,
        8.083246795921522,
        -7.981132988064893,
        -31.52159432874371,
        16.31930543123136,
        -6.058818238834054,
        h,
        K7,
    )
    for m in range(ROW_WIDTH):
        increment = (
            1.221224509226641 * S[K1 + m]
            + 6.019134481288629 * S[K2 + m]
            + 12.53708332932087 * S[K3 + m]
            - 0.6878860361058950 * S[K4 + m]
            + S[K5 + m]
            + S[K7 + m]
        )
        S[NEW + m] = S[STATE + m] + increment
        S[DENSE_ROWS + m] = increment
        S[DENSE_ROWS + ROW_WIDTH + m] = (
            10.12623508344586 * S[K1 + m]
            - 7.487995877610167 * S[K2 + m]
            - 34.80091861555747 * S[K3 + m]
            - 7.992771707568823 * S[K4 + m]
            + 1.025137723295662 * S[K5 + m]
        )
        S[DENSE_ROWS + 2 * ROW_WIDTH + m] = (
            -0.6762803392801253 * S[K1 + m]
            + 6.087714651680015 * S[K2 + m]
            + 16.43084320892478 * S[K3 + m]
            + 24.76722511418386 * S[K4 + m]
            - 6.594389125716872 * S[K5 + m]
        )


@fast_kernel
def _error(S, high, k, rtol, atol):
    """Error of a lane's step, in units of the tolerance; NaN stays."""
    x, y, w = S[NEW + k], S[NEW + LANES + k], S[NEW + 2 * LANES + k]
    plane = math.hypot(S[K7 + k], S[K7 + LANES + k]) / (atol + rtol * math.hypot(x, y))
    height = abs(S[K7 + 2 * LANES + k]) / (rtol * max(abs(w), MIN_W))
    return plane + (0.0 if high[k] > 0.5 else height)


@fast_kernel
def _event(S, P, field, k, capture, view, scratch):
    """Return what ends a lane's trajectory within its step, if anything: a code, and the fraction of the step."""
    x, y, w = S[NEW + k], S[NEW + LANES + k], S[NEW + 2 * LANES + k]
    ux, uy, uw = S[K12 + k], S[K12 + LANES + k], S[K12 + 2 * LANES + k]
    if P[SIDE_SIGN + k] > 0.0 and (1.0 + w) * max(abs(x), abs(y)) > view:
        return LEFT_VIEW, left_view(S, k, view)
    if ux * ux + uy * uy + uw * uw <= (4.0 * capture) ** 2:
        kind = is_captured(S, P, field, k, capture, scratch)
        return EQUILIBRIUM if kind == INTERIOR else AT_LIMIT_DIRECTION if kind == ON_EQUATOR_ATTRACTOR else RUNNING, 1.0
    return RUNNING, 1.0


@fast_kernel
def _move_lane(S, k, fraction):
    """Move a lane's state to that fraction of its step; where it is less than 1 it has left the view on the circle."""
    x, y, w = S[NEW + k], S[NEW + LANES + k], S[NEW + 2 * LANES + k]
    if fraction < 1.0:
        x, _u = dense(S, k, fraction)
        y, _u = dense(S, LANES + k, fraction)
        w, _u = dense(S, 2 * LANES + k, fraction)
        r = math.hypot(x, y)
        x, y = x / r, y / r
    S[STATE + k], S[STATE + LANES + k], S[STATE + 2 * LANES + k] = x, y, w
    for c in range(3):
        S[K0 + c * LANES + k] = S[K12 + c * LANES + k]


@fast_kernel
def _begin_lanes(S, P, states, signs, t_max, field, base, many, cursor, lines, times, travelled, counts, h):
    """Give the lanes the trajectories from `base` on, at their starts; those too many repeat the last."""
    for k in range(LANES):
        i = base + min(k, many - 1)
        for c in range(3):
            S[STATE + c * LANES + k] = states[i, c]
        P[SIDE_SIGN + k] = signs[i]
        times[k], travelled[k], counts[k], h[k] = 0.0, 0.0, 1, min(FIRST_STEP, t_max[i])
    call_field(field, S, STATE, K0, P)
    for k in range(many):
        start(S, P, k, cursor)
        lines[k, 0, 0], lines[k, 0, 1], lines[k, 0, 2] = cursor[X, k], cursor[Y, k], 0.0


# The rest in one piece: with the drawing of a step as a function of its own, results were the same and took 6 % longer
# (median of paired runs, process time).
@fast_kernel
def creep(states, signs, t_max, longest, shared, field, rtol, atol, limit, capture, view, distance):
    """Follow every row of `states` implicitly, as `lanes.integrate`; t_max and longest (n,): what is left."""
    n = states.shape[0]
    S, P, scratch = np.zeros(WORKSPACE), np.zeros(PARAMETERS), np.empty(MIRROR)
    for m in range(SIDE_SIGN):
        P[m] = shared[m]
    J, M, h, high = np.zeros((9, LANES)), np.zeros((9, LANES)), np.ones(LANES), np.zeros(LANES)
    cursor = np.zeros((CURSOR, LANES))
    ends, codes, evaluations = np.empty((n, 3)), np.full(n, RUNNING), 0
    times, travelled, counts = np.zeros(LANES), np.zeros(LANES), np.zeros(LANES, np.int64)
    store, stored, offsets = np.empty((1, 64 * n + 64, 3)), 0, np.zeros(n + 1, np.int64)
    for base in range(0, n, LANES):
        lines = np.empty((LANES, 64, 3))
        many = min(LANES, n - base)
        _begin_lanes(S, P, states, signs, t_max, field, base, many, cursor, lines, times, travelled, counts, h)
        left = many
        for _ in range(limit):
            if left == 0:
                break
            for k in range(LANES):
                high[k] = 1.0 if P[SIDE_SIGN + k] < 0.0 and S[STATE + 2 * LANES + k] > HIGH else 0.0
            advance(S, P, high, field, h, J, M)
            _project(S, P, high, NEW)
            call_field(field, S, NEW, K12, P)
            evaluations += left * CALLS
            for k in range(LANES):
                i = base + k
                if k >= many or codes[i] != RUNNING:
                    continue
                error = _error(S, high, k, rtol, atol)
                factor = (
                    min(max(STEP_SAFETY * (error + 1e-12) ** -0.25, MAX_SHRINKAGE), MAX_GROWTH)
                    if error < math.inf
                    else MAX_SHRINKAGE
                )
                taken = h[k]
                h[k] = taken * factor
                if not error <= 1.0:
                    continue
                code, fraction = _event(S, P, field, k, capture, view, scratch)
                stop = times[k] + fraction * taken
                if code == RUNNING and stop >= t_max[i] * (1.0 - 1e-12):
                    code = T_MAX
                if distance > 0.0:
                    count = append_step(S, P, k, cursor, lines, counts[k], times[k], taken, stop, distance)
                    while count < 0:
                        lines = longer(lines)
                        count = append_step(S, P, k, cursor, lines, -1 - count, times[k], taken, stop, distance)
                    travelled[k] += length_of(lines, k, counts[k] - 1, count - 1)
                    counts[k] = count
                    if code == RUNNING and travelled[k] >= longest[i]:
                        code = LENGTH
                times[k] = stop
                _move_lane(S, k, fraction)
                h[k] = min(h[k], max(t_max[i] - stop, 1e-300))
                if code != RUNNING:
                    codes[i] = code
                    left -= 1
        for k in range(many):
            i = base + k
            codes[i] = STEP_LIMIT if codes[i] == RUNNING else codes[i]
            for c in range(3):
                ends[i, c] = S[STATE + c * LANES + k]
            if counts[k] == lines.shape[1]:
                lines = longer(lines)
            end_line(lines, counts, k, P[SIDE_SIGN + k], ends, i, times[k])
            while stored + counts[k] > store.shape[1]:
                store = longer(store)
            stored = keep_line(store, stored, lines, counts, k)
            offsets[i + 1] = stored
    points, clock = np.empty((stored, 2)), np.empty(stored)
    for j in range(stored):
        points[j, 0], points[j, 1], clock[j] = store[0, j, 0], store[0, j, 1], store[0, j, 2]
    return points, clock, offsets, ends, codes, evaluations
