"""Compiled test of each step of a slide: whether it surely goes on, and where it ends at the equator (`safe_steps`).

What turns negative at an end is taken at the nodes of `safe_steps`, and bounded between them in the same way. Where
only 1 - |e|^2 may turn negative, and that once, its zero is the end.
"""

from __future__ import annotations

import math

import numpy as np

from ...jit import kernel
from ..safe_steps import COEFFICIENTS, FOLD_MARGIN, LEFT_OUT, SAFE_DEGREE, SAFE_NODES
from .slow import SET_PLACE, TABLE, found_set

SAFE, AT_EQUATOR_END, UNSURE_END = range(3)
GAUGES = 4  # 1 - |e|^2; det D_e U with its sign; and the two parts of -tr J, across C and along it
ROOT = 100  # evaluations at most
EXACT = 1e-15  # of a step
MIN_PART = 1.0 / 64.0  # of a step: parts that are not sure are halved down to this


@kernel
def set_on_step(S, first, polynomial, u):
    """Put the critical set at a fraction of a step in place; say whether there is one.

    Parameters
    ----------
    S : (EXTENT,)
    first : (n,)
        (e, z) where the step begins.
    polynomial : (n, d)
    u : float
    """
    n, degree = polynomial.shape
    for i in range(n):
        total = 0.0
        for k in range(degree - 1, -1, -1):
            total = (total + polynomial[i, k]) * u
        S[SET_PLACE + i + (2 if i >= 2 else 0)] = first[i] + total
    return found_set(S, n - 2)


@kernel
def _gap(S):
    r = math.hypot(S[SET_PLACE], S[SET_PLACE + 1])
    return (1.0 - r) * (1.0 + r)


@kernel
def determinant(S, n):
    """Det D_e U at the set that was found last."""
    return S[TABLE] * S[TABLE + n + 3] - S[TABLE + 1] * S[TABLE + n + 2]


@kernel
def _write_gauges(S, n, sign, n1, n2, values, node):
    D11, D12, D21, D22 = S[TABLE], S[TABLE + 1], S[TABLE + n + 2], S[TABLE + n + 3]
    values[0, node] = _gap(S)
    size = max(max(abs(D11), abs(D12)), max(abs(D21), abs(D22)))
    if n1 != 0.0 or n2 != 0.0:
        values[1, node] = -(n1 * (n1 * D11 + n2 * D12) + n2 * (n1 * D21 + n2 * D22)) - FOLD_MARGIN * size
        values[2, node] = values[3, node] = 1.0
        return
    values[1, node] = sign * (D11 * D22 - D12 * D21) - FOLD_MARGIN * size * size
    c, s = S[SET_PLACE], S[SET_PLACE + 1]
    r = math.hypot(c, s)
    c, s = (c / r, s / r) if r > 0.0 else (1.0, 0.0)
    radial = c * (c * D11 + s * D12) + s * (c * D21 + s * D22)
    values[2, node], values[3, node] = -radial, radial - D11 - D22


@kernel
def _bounds(values, found):
    """Write the coefficients of the polynomial through values at the nodes; return what it leaves out."""
    for j in range(SAFE_DEGREE + 1):
        total = 0.0
        for i in range(SAFE_DEGREE + 1):
            total += values[i] * COEFFICIENTS[i, j]
        found[j] = total
    return LEFT_OUT * (abs(found[SAFE_DEGREE]) + abs(found[SAFE_DEGREE - 1]))


@kernel
def _zero(S, first, polynomial, low, high, before, after):
    """Fraction of a step at which 1 - |e|^2 is zero, between two where it has opposite signs; NaN where e is lost."""
    kept = 0
    for _ in range(ROOT):  # Illinois
        u = low + (high - low) * before / (before - after)
        if not low < u < high:
            u = 0.5 * (low + high)
        if not set_on_step(S, first, polynomial, u):
            return math.nan
        value = _gap(S)
        if value > 0.0:
            low, before = u, value
            after = 0.5 * after if kept == 1 else after
            kept = 1
        else:
            high, after = u, value
            before = 0.5 * before if kept == -1 else before
            kept = -1
        if value == 0.0 or high - low < EXACT:
            break
    return high if kept == -1 else low


@kernel
def _part_end(S, first, polynomial, low, high, sign, n1, n2, values, found):
    """Tell of the part of a step between two of its fractions what `step_end` tells of all of it."""
    n = len(first)
    for node in range(SAFE_DEGREE + 1):
        if not set_on_step(S, first, polynomial, low + (high - low) * SAFE_NODES[node]):
            return UNSURE_END, 0.0
        _write_gauges(S, n, sign, n1, n2, values, node)
    for which in range(1, GAUGES):
        spread = _bounds(values[which], found)
        for j in range(1, SAFE_DEGREE + 1):
            spread += abs(found[j])
        if not found[0] > spread:
            return UNSURE_END, 0.0
    spread = _bounds(values[0], found)
    bend = 2.0 * SAFE_DEGREE * spread  # of the derivative
    for j in range(1, SAFE_DEGREE + 1):
        spread += abs(found[j])
        bend += j * j * abs(found[j]) if j > 1 else 0.0
    if found[0] > spread:
        return SAFE, high
    before, after = values[0, 0], values[0, SAFE_DEGREE]
    if not (abs(found[1]) > bend and before > 0.0):
        return UNSURE_END, 0.0
    if after > 0.0:  # it is monotone
        return SAFE, high
    return AT_EQUATOR_END, _zero(S, first, polynomial, low, high, before, after)


@kernel
def step_end(S, first, polynomial, sign, n1, n2, values):
    """Tell of a step of (e, z) whether a slide goes on along it, or ends at the equator, at which fraction.

    The critical set at the end of the step, or where it ends the slide, is then in place.

    Parameters
    ----------
    S, first, polynomial
        As in `set_on_step`.
    sign : float
        Of det D_e U where the slide began.
    n1, n2 : float
        Along the invariant line of the motion, or 0.
    values : (GAUGES, DEGREE + 1)
        Is written.

    Returns
    -------
    (int, float)
        SAFE, EQUATOR, or UNSURE, and the fraction.
    """
    found, low, part = np.empty(SAFE_DEGREE + 1), 0.0, 1.0
    while low < 1.0:
        what, u = _part_end(S, first, polynomial, low, low + part, sign, n1, n2, values, found)
        if what == UNSURE_END:
            part *= 0.5
            if part < MIN_PART:
                return UNSURE_END, 0.0
        elif what == AT_EQUATOR_END:
            return (AT_EQUATOR_END, u) if u == u and set_on_step(S, first, polynomial, u) else (UNSURE_END, 0.0)
        else:
            low += part
    return SAFE, 1.0
