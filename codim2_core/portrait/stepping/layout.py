"""The memory layout of the compiled stepping, and the call of a right-hand side.

`LANES` trajectories step side by side. The workspace S is one array of rows of `ROW_WIDTH` numbers: px of every lane,
then py, then w: one state (px, py, w) for both sides of the equator, w = ebar on the hemisphere and rho outside.
P holds the parameters.

A right-hand side is a C function ``void(state, out, P)`` on such rows, entered by its address: the integrator is
compiled once, whatever the system. The gain of Psi, where a right-hand side asks for it, is entered in the same way.

The numbers that a compiled right-hand side reads, and the unit of time in which it runs.

An e-linear field reads ``[a, b, d, f1, f2, parameter of Psi]``. A general one reads a factor (one over the unit of
speed, negative backward in time), at FORMULAS the address of its packed formulas, and at GAIN that of the gain of Psi.
A typed Psi has the address of its own packed formula in the place of a parameter.
"""

from __future__ import annotations

import math

import numpy as np

from ...formulas.jit import kernel
from ...results.arrays import Array
from ...systems.frozen import FrozenSystem

FACTOR, PSI, GAIN, FORMULAS, SHARED_SIZE = 0, 5, 6, 7, 8


def field_numbers(at: FrozenSystem, parameter: float, backward: bool, gain: int = 0, formulas: int = 0) -> Array:
    """Return the parameters (SHARED_SIZE,) of a compiled field, scaled so that |U| is about 1."""
    sign, unit = -1.0 if backward else 1.0, at.speed
    shared = np.zeros(SHARED_SIZE)
    shared[PSI:] = parameter, gain, formulas  # exact: addresses have fewer than 53 bits
    if at.as_given is None:
        shared[FACTOR] = sign / unit
    else:
        shared[:PSI] = [sign * (value / unit) for value in at.as_given.plane]
    return shared


# 32 doubles are four AVX-512 registers a component: stages then hide the latency of one another (measured:
# 65 ns a step and lane with 8 lanes, 30 with 16, 20 with 32).
LANES = 32
ROW_WIDTH = 3 * LANES

K0, K1, K2, K3, K4, K5, K6, K7 = (k * ROW_WIDTH for k in range(8))
K8, K9, K10, K11, K12, K13, K14, K15 = (k * ROW_WIDTH for k in range(8, 16))
STATE, TRIAL, STEP_ROW, NEW, ERROR_5, ERROR_3 = (k * ROW_WIDTH for k in range(16, 22))
DENSE_ROWS = 22 * ROW_WIDTH  # seven rows
WORKSPACE = 29 * ROW_WIDTH

SIDE_SIGN = SHARED_SIZE  # P[SIGN + lane] = -1 on the hemisphere, +1 outside
PARAMETERS = SIDE_SIGN + LANES

EQUATOR_ROUNDING = 8.9e-16  # | |p| - 1 | of a seed that was meant to lie on the equator: four roundings


@kernel
def _double_square(x):
    """x^2 and what its rounding lost (Dekker)."""
    big = 134217729.0 * x
    high = big - (big - x)
    low = x - high
    square = x * x
    return square, ((high * high - square) + 2.0 * high * low) + low * low


@kernel
def _defect(x, y):
    """1 - x^2 - y^2 to a few roundings of itself: near the equator |p| alone, rounded, would lose its digits."""
    x2, x_lost = _double_square(max(abs(x), abs(y)))
    y2, y_lost = _double_square(min(abs(x), abs(y)))
    one = 1.0 - x2
    lost = (1.0 - one) - x2
    return (one - y2) + (((one - (one - y2)) - y2) + lost - x_lost - y_lost)


@kernel
def states_of(points):
    """States (k, 3), signs (k,) of picture points (k, 2), and the largest coordinate, nan if one is not finite."""
    n = points.shape[0]
    largest = 0.0
    states, signs = np.empty((n, 3)), np.empty(n)
    for i in range(n):
        x, y = points[i, 0], points[i, 1]
        r = math.hypot(x, y)
        largest = max(largest, abs(x), abs(y)) if math.isfinite(r) and not math.isnan(largest) else math.nan
        inside = r - 1.0 < -EQUATOR_ROUNDING
        scale = 1.0 if inside else r
        states[i, 0], states[i, 1] = x / scale, y / scale
        states[i, 2] = math.sqrt(_defect(x, y)) if inside else r - 1.0 if r - 1.0 > EQUATOR_ROUNDING else 0.0
        signs[i] = -1.0 if inside else 1.0
    return states, signs, largest
