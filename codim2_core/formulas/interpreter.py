"""The interpreters of `arrays`: formulas as arrays, evaluated with their exact derivatives; compiled."""

from __future__ import annotations

import math

import numpy as np

from .functions import kernels
from .jit import kernel
from .opcodes import (
    ADD,
    BESIDE,
    DIV,
    HYPOT,
    MAX,
    MIN,
    MUL,
    NEG,
    NUM,
    POW,
    POWI,
    SLOT,
    SUB,
    VAR,
)


@kernel
def _operate(k, a, b):
    """Value of operation k on a (and b)."""
    if k == ADD:
        return a + b
    if k == SUB:
        return a - b
    if k == MUL:
        return a * b
    if k == DIV:
        return a / b
    if k == NEG:
        return -a
    if k == POWI:
        return a * a if b == 2.0 else math.pow(a, b)
    if k == POW:
        return math.pow(a, b)
    if k == HYPOT:
        return math.hypot(a, b)
    if k == MIN:
        return b if b < a or b != b else a
    if k == MAX:
        return b if b > a or b != b else a
    if k == BESIDE:
        return 0.0 if (a == 0.0 and math.isinf(b)) or (b == 0.0 and math.isinf(a)) else a * b
    return kernels.value(k, a)


@kernel
def specialise(op, left, right, number, numbers):
    """Put the numbers in, fold constants, and mark integer powers."""
    for i in range(len(op)):
        k = op[i]
        if k == SLOT:
            op[i], number[i] = NUM, numbers[left[i]]
        elif k > VAR and op[left[i]] == NUM and op[right[i]] == NUM:
            op[i], number[i] = NUM, _operate(k, number[left[i]], number[right[i]])
        elif k == POW and op[right[i]] == NUM:
            exponent = number[right[i]]
            if exponent == math.floor(exponent) and abs(exponent) <= 1000.0:
                op[i], number[i], right[i] = POWI, exponent, left[i]


# In one piece: with the slopes of an operation as a function of their own, results were the same and took 4 to 7 %
# longer (paired runs, process time).
@kernel
def gradients(op, left, right, number, roots, seed, work, out):
    """Rows and their exact derivatives at one point, by the chain rule forwards.

    seed : (4, 3), value and two derivatives of each of c, s, x, y; work : (n, 3), scratch; out : (rows, 3).
    """
    for i in range(len(op)):
        k = op[i]
        if k == NUM:
            work[i, 0], work[i, 1], work[i, 2] = number[i], 0.0, 0.0
            continue
        if k == VAR:
            work[i, 0], work[i, 1], work[i, 2] = seed[left[i], 0], seed[left[i], 1], seed[left[i], 2]
            continue
        a, a1, a2 = work[left[i], 0], work[left[i], 1], work[left[i], 2]
        b, b1, b2 = work[right[i], 0], work[right[i], 1], work[right[i], 2]
        if k == POWI:
            b = number[i]
        v = _operate(k, a, b)
        p, q = 0.0, 0.0  # derivatives of v by a and by b
        if k == ADD:
            p, q = 1.0, 1.0
        elif k == SUB:
            p, q = 1.0, -1.0
        elif k == MUL:  # a factor 0 stays 0 next to an infinite slope of the other: (u v)' = u' v where u' is finite
            p, q = b, a
            if a == 0.0 and (math.isinf(b1) or math.isinf(b2)) and math.isfinite(a1) and math.isfinite(a2):
                b1, b2 = 0.0, 0.0
            elif b == 0.0 and (math.isinf(a1) or math.isinf(a2)) and math.isfinite(b1) and math.isfinite(b2):
                a1, a2 = 0.0, 0.0
        elif k == DIV:
            p, q = 1.0 / b, -v / b
        elif k == NEG:
            p = -1.0
        elif k == POWI:
            p = 2.0 * a if b == 2.0 else b * math.pow(a, b - 1.0) if b != 0.0 else 0.0
        elif k == POW:
            p = b * math.pow(a, b - 1.0) if b != 0.0 else 0.0
            q = v * math.log(a) if v != 0.0 and (b1 != 0.0 or b2 != 0.0) else 0.0
        elif k == HYPOT:  # at its tip the mean over all directions, 0
            p, q = (a / v, b / v) if v != 0.0 else (0.0, 0.0)
        elif k in (MIN, MAX):  # where both are equal the mean of the two slopes
            p = 0.5 if a == b else 1.0 if (a < b) == (k == MIN) else 0.0
            q = 1.0 - p
            if p == 0.0:
                a1, a2 = 0.0, 0.0
            if q == 0.0:
                b1, b2 = 0.0, 0.0
        else:
            p = kernels.slope(k, a, v)
        # an inner slope 0 stays 0 next to an infinite outer one: sqrt of a constant 0 has no slope
        work[i, 0] = v
        work[i, 1] = (p * a1 if a1 != 0.0 else 0.0) + (q * b1 if b1 != 0.0 else 0.0)
        work[i, 2] = (p * a2 if a2 != 0.0 else 0.0) + (q * b2 if b2 != 0.0 else 0.0)
    for r in range(len(roots)):
        for j in range(3):
            out[r, j] = work[roots[r], j]


@kernel
def batch(op, left, right, number, roots, points, out):
    """Rows and their derivatives by c and s at points (k, 2 to 4) of c, s, and x, y or 0; out : (k, rows, 3)."""
    work = np.empty((len(op), 3))
    seed = np.zeros((4, 3))
    seed[0, 1] = seed[1, 2] = 1.0
    for i in range(len(points)):
        for j in range(points.shape[1]):
            seed[j, 0] = points[i, j]
        gradients(op, left, right, number, roots, seed, work, out[i])


@kernel
def values(op, left, right, number, roots, states, out):
    """Rows at states (k, N) of x, y, z1, ...; out : (k, rows)."""
    work = np.empty(len(op))
    for j in range(len(states)):
        for i in range(len(op)):
            k = op[i]
            if k == NUM:
                work[i] = number[i]
            elif k == VAR:
                work[i] = states[j, left[i] - 2]
            else:
                work[i] = _operate(k, work[left[i]], number[i] if k == POWI else work[right[i]])
        for r in range(len(roots)):
            out[j, r] = work[roots[r]]
