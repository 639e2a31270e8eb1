"""The rate of a regularised motion and its Jacobian, compiled.

The right-hand side enters by address, as in `stepping.layout`: a function of (c, s, x, y, z1, ...) that writes U and W,
one that writes their derivatives by all of these, and the gain of Psi at one place.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from numba import njit

from ..stepping.layout import call_field

DIFFERENCE = 1e-5

# Where the right-hand side reads and writes: the gain's arguments, the field's, its value, its slopes.
RADIUS, GAIN, ARGUMENTS, VALUE, SLOPES = 0, 4, 8, 8 + 32, 8 + 64
PLACES = SLOPES + 8 * 12


class Motion(NamedTuple):
    """What does not change along a motion.

    Attributes
    ----------
    fields : int64 (3,)
        Addresses: value, slopes, gain.
    P : float64
        Parameters of all three.
    n : int
        Components of the state (x, y, z).
    eps, rtol, floor : float
        As in `numerics.radau`, floor = atol/rtol.
    line : (3,)
        The invariant line that is kept to, and 1; or 0 in the last place.
    """

    fields: Any
    P: Any
    n: int
    eps: float
    rtol: float
    floor: float
    line: Any


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def rate(motion, y, S, out):
    """Write the rate (U, W) at a state; in an invariant line, kept in it."""
    n, fields, P, line = motion.n, motion.fields, motion.P, motion.line
    x1, x2 = y[0], y[1]
    if line[2] > 0.0:
        along = line[0] * x1 + line[1] * x2
        x1, x2 = along * line[0], along * line[1]
    S[RADIUS], S[RADIUS + 1] = x1 * x1 + x2 * x2, motion.eps
    call_field(fields[2], S, RADIUS, GAIN, P)
    gain = S[GAIN]
    S[ARGUMENTS], S[ARGUMENTS + 1], S[ARGUMENTS + 2], S[ARGUMENTS + 3] = gain * x1, gain * x2, x1, x2
    for i in range(2, n):
        S[ARGUMENTS + 2 + i] = y[i]
    call_field(fields[0], S, ARGUMENTS, VALUE, P)
    for i in range(n):
        out[i] = S[VALUE + i]
    if line[2] > 0.0:
        along = line[0] * out[0] + line[1] * out[1]
        out[0], out[1] = along * line[0], along * line[1]


@njit(cache=True, nogil=True, error_model="numpy")
def _modulus(motion, r, S):
    """|e_Psi| at distance r, odd in r."""
    S[RADIUS], S[RADIUS + 1] = r * r, motion.eps
    call_field(motion.fields[2], S, RADIUS, GAIN, motion.P)
    return r * S[GAIN]


@njit(cache=True, nogil=True, error_model="numpy")
def jacobian(motion, y, S, J):
    """Write the Jacobian of the rate at a state, right after its rate: S holds the arguments.

    The derivative of |e_Psi| by r is a central difference: Newton's method is a simplified one, and asks no more.
    """
    n, r = motion.n, math.hypot(y[0], y[1])
    S[RADIUS], S[RADIUS + 1] = r * r, motion.eps
    call_field(motion.fields[2], S, RADIUS, GAIN, motion.P)
    tangential = S[GAIN]
    h = DIFFERENCE * math.hypot(r, motion.eps)
    radial = (_modulus(motion, r + h, S) - _modulus(motion, r - h, S)) / (2.0 * h)
    n1, n2 = (y[0] / r, y[1] / r) if r > 0.0 else (1.0, 0.0)
    spread = radial - tangential
    d11, d12, d22 = tangential + spread * n1 * n1, spread * n1 * n2, tangential + spread * n2 * n2
    call_field(motion.fields[1], S, ARGUMENTS, SLOPES, motion.P)
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
