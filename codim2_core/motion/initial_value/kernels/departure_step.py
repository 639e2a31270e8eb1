"""The way out of Sigma along a limit direction: the expansion at Sigma that a first, short step is made of.

Where lambda_rho > 0 it is the unstable manifold of Q in (rho, theta, z): rho = lambda_rho t + O(t^2), with
theta - theta_Q linear in t. Where a critical set has just reached the equator at Q (Figure 19), lambda_rho grows
from 0 as beta t, rho = beta t^2/2 + O(t^3), and theta follows Q(z).
"""

from __future__ import annotations

import math

from ....formulas.jit import held_kernel, kernel
from .rate import ROUNDING
from .slow import RATES, TABLE, write_at

FAST_START, SLOW_START = 1e-9, 1e-5  # first part, of the time ahead or of the rates' own, covered by an expansion
TILT = 1e-6  # largest angle that this expansion may cover
MAX_NEWTON, MAX_CORRECTION = 6, 0.05  # steps to polish theta, and how far one may go
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
    for _ in range(MAX_NEWTON):
        c, s = math.cos(angle), math.sin(angle)
        write_at(S, m, c, s)
        u, v = S[RATES], S[RATES + 1]
        D11, D12, D21, D22 = S[TABLE], S[TABLE + 1], S[TABLE + width], S[TABLE + width + 1]
        rate = s * (s * D11 - c * D12) + c * (c * D22 - s * D21) - (c * u + s * v)
        change = (c * v - s * u) / rate
        if not abs(change) < MAX_CORRECTION:
            return theta
        angle -= change
    return angle


@held_kernel
def leave(S, m, n1, n2, theta, ahead, linear, square):
    """Write the first, short step away from Sigma; return its length, or why there is none.

    Shapes: linear, square (2 + m,).
    """
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
