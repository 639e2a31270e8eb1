"""The rate of a regularised motion and its Jacobian, compiled.

The right-hand side enters by address, as in `stepping.layout`: a function of (c, s, x, y, z1, ...) that writes U and W,
one that writes their derivatives by all of these, and the gain of Psi at one place.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from ....formulas.jit import call_field, inlined_kernel, kernel, spliced_kernel
from ....formulas.names import MOST_SLOW_VARIABLES

DIFFERENCE_STEP = 1e-5
ROUNDING = 2.0**-52
BLUR_MARGIN = 8.0  # times the blur of the rate: a smaller error is rounding
MAX_INWARD_SHARE = 0.9  # of rho: how far towards Sigma one step may go

# Where the right-hand side reads and writes: the gain's arguments, the field's, its value, its slopes. The same array
# holds the parameter of Psi, at PSI, where the gain looks for it, and the addresses of packed formulas.
VALUE_FORMULAS, SLOPE_FORMULAS = 6, 7
RADIUS, GAIN, ARGUMENTS, VALUE, SLOPES = 0, 4, 8, 8 + 32, 8 + 64
RATE_PLACES = SLOPES + (2 + MOST_SLOW_VARIABLES) * (4 + MOST_SLOW_VARIABLES)


class MotionConstants(NamedTuple):
    """Constants of a motion."""

    value: int  # addresses
    slopes: int
    gain: int
    n: int  # components of the state (x, y, z)
    eps: float  # the error allowed in a step is rtol rho for x and y, rtol (|z| + floor) for z: floor = atol/rtol
    rtol: float
    floor: float
    line1: float  # the invariant line that is kept to, or 0
    line2: float
    blur: float  # what the rounding of z, the time among them, and of e makes of the rate of x and y


@spliced_kernel
def rate(motion, y, S, out):
    """Write the rate (U, W) at a state; in an invariant line, kept in it."""
    rate_between(motion, y, 0, S, out, 0)


@inlined_kernel
def rate_between(motion, y, source, S, out, target):
    """Write the rate at the state y[source:] to out[target:]."""
    n, line1, line2 = motion.n, motion.line1, motion.line2
    in_line = line1 != 0.0 or line2 != 0.0
    x1, x2 = y[source], y[source + 1]
    if in_line:
        along = line1 * x1 + line2 * x2
        x1, x2 = along * line1, along * line2
    S[RADIUS], S[RADIUS + 1] = x1 * x1 + x2 * x2, motion.eps
    call_field(motion.gain, S, RADIUS, GAIN, S)
    gain = S[GAIN]
    S[ARGUMENTS], S[ARGUMENTS + 1], S[ARGUMENTS + 2], S[ARGUMENTS + 3] = gain * x1, gain * x2, x1, x2
    for i in range(2, n):
        S[ARGUMENTS + 2 + i] = y[source + i]
    call_field(motion.value, S, ARGUMENTS, VALUE, S)
    for i in range(n):
        out[target + i] = S[VALUE + i]
    if in_line:
        along = line1 * S[VALUE] + line2 * S[VALUE + 1]
        out[target], out[target + 1] = along * line1, along * line2


@spliced_kernel
def sizes(motion, y, size):
    """Write the size (n,) by which errors are measured at a state."""
    for i in range(2, motion.n):
        size[i] = abs(y[i]) + motion.floor
    size[0] = size[1] = math.sqrt(y[0] * y[0] + y[1] * y[1] + motion.eps * motion.eps)


@spliced_kernel
def inward_bound(motion, y, rates):
    """Longest step: 0.9 of the way to Sigma."""
    inward = -(y[0] * rates[0] + y[1] * rates[1])
    square = y[0] * y[0] + y[1] * y[1] + motion.eps * motion.eps
    return MAX_INWARD_SHARE * square / inward if inward > 0.0 else math.inf


@kernel
def _modulus(motion, r, S):
    """|e_Psi| at distance r, odd in r."""
    S[RADIUS], S[RADIUS + 1] = r * r, motion.eps
    call_field(motion.gain, S, RADIUS, GAIN, S)
    return r * S[GAIN]


@kernel
def jacobian(motion, y, S, J):
    """Write the Jacobian of the rate at a state, right after its rate: S holds the arguments."""
    n, r = motion.n, math.hypot(y[0], y[1])
    S[RADIUS], S[RADIUS + 1] = r * r, motion.eps
    call_field(motion.gain, S, RADIUS, GAIN, S)
    tangential = S[GAIN]
    h = DIFFERENCE_STEP * math.hypot(r, motion.eps)
    radial = (_modulus(motion, r + h, S) - _modulus(motion, r - h, S)) / (2.0 * h)
    n1, n2 = (y[0] / r, y[1] / r) if r > 0.0 else (1.0, 0.0)
    spread = radial - tangential
    d11, d12, d22 = tangential + spread * n1 * n1, spread * n1 * n2, tangential + spread * n2 * n2
    call_field(motion.slopes, S, ARGUMENTS, SLOPES, S)
    width = n + 2
    for i in range(n):
        row = SLOPES + i * width
        J[i, 0] = S[row + 2] + S[row] * d11 + S[row + 1] * d12
        J[i, 1] = S[row + 3] + S[row] * d12 + S[row + 1] * d22
        for j in range(2, n):
            J[i, j] = S[row + 2 + j]
        for j in range(n):
            if not math.isfinite(J[i, j]):
                J[i, j] = 0.0
    if motion.line1 != 0.0 or motion.line2 != 0.0:  # it stays in its line
        for j in range(n):
            along = motion.line1 * J[0, j] + motion.line2 * J[1, j]
            J[0, j], J[1, j] = along * motion.line1, along * motion.line2


@inlined_kernel
def without_blur(motion, y, h, v1, v2, size):
    """Return a change (v1, v2) of (x, y), in units of size, less what the blur makes of a step along the way out."""
    if motion.eps > 0.0 or not motion.blur > 0.0:
        return v1, v2
    n1, n2 = y[0] / size, y[1] / size
    along, allowed = n1 * v1 + n2 * v2, BLUR_MARGIN * h * motion.blur / size
    less = min(max(along, -allowed), allowed)
    return v1 - less * n1, v2 - less * n2


@kernel
def blur_of_rate(motion, y, work):
    """Return what rounding makes of the rate of x and y at a state: it counts where both are small."""
    rate(motion, y, work.S, work.rate)
    jacobian(motion, y, work.S, work.J)
    found, S = 0.0, work.S
    for i in range(2):
        row, total = SLOPES + i * (motion.n + 2), 0.0
        if motion.eps == 0.0:
            total = abs(S[row] * S[ARGUMENTS]) + abs(S[row + 1] * S[ARGUMENTS + 1])
        for j in range(2, motion.n):
            total += abs(work.J[i, j] * y[j])
        found = max(found, total * ROUNDING)
    return found
