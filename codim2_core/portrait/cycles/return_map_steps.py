"""Steps in a lane of the compiled map: begin, judge a step, find the length that ends on a section."""

from __future__ import annotations

import math

import numpy as np

from ...formulas.jit import fast_kernel
from ..stepping.layout import (
    ERROR_3,
    ERROR_5,
    GAINS,
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
    for m in range(SIDE_SIGN, GAINS):
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
