"""Bounds of formulas and two derivatives over a whole box, by interval arithmetic along their tape; compiled.

It holds for every point of the box, rounding included; what is undefined somewhere in it has the bounds -inf, inf.
"""

from __future__ import annotations

import math

import numpy as np

from ..formulas.jit import inlined_kernel, kernel
from ..formulas.opcodes import (
    ADD,
    DIV,
    HYPOT,
    MAX,
    MIN,
    MUL,
    NEG,
    NUM,
    POW,
    POWI,
    SUB,
    VAR,
)
from .intervals import LOG, add, divide, modulus, multiply, outwards, power, range_of, slope_of


@kernel
def _slope_of_hypot(a, b, lo, hi):
    """Bounds of u/h for u in [a, b] and h = hypot(u, v) in [lo, hi]: within [-1, 1], at the tip too."""
    p, q = divide(a, b, lo, hi)
    return max(p, -1.0), min(q, 1.0)


@kernel
def _power_general(a, b, c, d):
    """Return [a, b] ** [c, d] where the base is positive; everything elsewhere."""
    if not a > 0.0:
        if a == 0.0 and c == d and c > 0.0:
            return 0.0, outwards(0.0, math.pow(b, c))[1] if b > 0.0 else 0.0
        return -math.inf, math.inf
    if c == d:
        p, q = math.pow(a, c), math.pow(b, c)
        return outwards(min(p, q), max(p, q))
    lo, hi = outwards(math.log(a), math.log(b))
    lo, hi = multiply(lo, hi, c, d)
    return outwards(math.exp(lo), math.exp(hi))


@inlined_kernel
def _write_linear(k, u, v, w):
    """Write -u, u + v or u - v."""
    for j in (0, 2, 4):
        if k == NEG:
            w[j], w[j + 1] = -u[j + 1], -u[j]
        elif k == ADD:
            w[j], w[j + 1] = add(u[j], u[j + 1], v[j], v[j + 1])
        else:
            w[j], w[j + 1] = add(u[j], u[j + 1], -v[j + 1], -v[j])


@inlined_kernel
def _product(u, v, w):
    """Write u v."""
    w[0], w[1] = multiply(u[0], u[1], v[0], v[1])
    for j in (2, 4):
        a, b = multiply(u[j], u[j + 1], v[0], v[1])
        c, d = multiply(u[0], u[1], v[j], v[j + 1])
        w[j], w[j + 1] = add(a, b, c, d)


@inlined_kernel
def _quotient(u, v, w):
    """Write u/v, whose derivative is (u' - (u/v) v')/v."""
    w[0], w[1] = divide(u[0], u[1], v[0], v[1])
    for j in (2, 4):
        a, b = multiply(w[0], w[1], v[j], v[j + 1])
        a, b = add(u[j], u[j + 1], -b, -a)
        w[j], w[j + 1] = divide(a, b, v[0], v[1])


@inlined_kernel
def _norm(u, v, w):
    """Write hypot(u, v)."""
    a, b = modulus(u[0], u[1])
    c, d = modulus(v[0], v[1])
    w[0], w[1] = outwards(math.hypot(a, c), math.hypot(b, d))
    w[0] = max(w[0], 0.0)
    p, q = _slope_of_hypot(u[0], u[1], w[0], w[1])
    lo, hi = _slope_of_hypot(v[0], v[1], w[0], w[1])
    for j in (2, 4):
        a, b = multiply(p, q, u[j], u[j + 1])
        c, d = multiply(lo, hi, v[j], v[j + 1])
        w[j], w[j + 1] = add(a, b, c, d)


@inlined_kernel
def _extreme(k, u, v, w):
    """Write min(u, v) or max(u, v); where either may be the one, its derivative is in the hull of both."""
    first, second = (u[1] < v[0], v[1] < u[0]) if k == MIN else (u[0] > v[1], v[0] > u[1])
    w[0], w[1] = (min(u[0], v[0]), min(u[1], v[1])) if k == MIN else (max(u[0], v[0]), max(u[1], v[1]))
    for j in (2, 4):
        w[j], w[j + 1] = min(u[j], v[j]), max(u[j + 1], v[j + 1])
        if first:
            w[j], w[j + 1] = u[j], u[j + 1]
        elif second:
            w[j], w[j + 1] = v[j], v[j + 1]


@inlined_kernel
def _any_power(u, v, w):
    """Write u**v, whose derivative is u**v (v' log u + v u'/u); without v' it is v u**(v - 1) u'."""
    w[0], w[1] = _power_general(u[0], u[1], v[0], v[1])
    if v[2] == v[3] == v[4] == v[5] == 0.0:
        a, b = _power_general(u[0], u[1], v[0] - 1.0, v[1] - 1.0)
        a, b = multiply(a, b, v[0], v[1])
        for j in (2, 4):
            w[j], w[j + 1] = multiply(a, b, u[j], u[j + 1])
    else:
        lo, hi = range_of(LOG, u[0], u[1])
        for j in (2, 4):
            a, b = multiply(v[j], v[j + 1], lo, hi)
            c, d = multiply(v[0], v[1], u[j], u[j + 1])
            c, d = divide(c, d, u[0], u[1])
            a, b = outwards(a + c, b + d)
            w[j], w[j + 1] = multiply(w[0], w[1], a, b)


@inlined_kernel
def _write_function(k, exponent, u, w):
    """Write a function of u, or u**exponent with a whole exponent, by the chain rule."""
    if k == POWI:
        w[0], w[1] = power(u[0], u[1], exponent)
        a, b = 0.0, 0.0
        if exponent != 0.0:
            a, b = power(u[0], u[1], exponent - 1.0)
            a, b = multiply(a, b, exponent, exponent)
    else:
        w[0], w[1] = range_of(k, u[0], u[1])
        a, b = slope_of(k, u[0], u[1], w[0], w[1])
    for j in (2, 4):
        w[j], w[j + 1] = multiply(a, b, u[j], u[j + 1])


@kernel
def enclose(op, left, right, number, roots, c_lo, c_hi, s_lo, s_hi, work, out):
    """Enclose the rows and their derivatives by c and s over a box, on Sigma.

    work : (n, 6), scratch; out : (rows, 6), lower and upper bound of the value, of d/dc and of d/ds.
    """
    box = np.zeros((4, 6))
    box[0, 0], box[0, 1], box[0, 2], box[0, 3] = c_lo, c_hi, 1.0, 1.0
    box[1, 0], box[1, 1], box[1, 4], box[1, 5] = s_lo, s_hi, 1.0, 1.0
    enclose_over(op, left, right, number, roots, box, work, out)


@kernel
def enclose_over(op, left, right, number, roots, box, work, out):
    """Enclose the rows and two derivatives, where each variable has its bounds and those of its own: box (V, 6)."""
    for i in range(len(op)):
        k = op[i]
        w = work[i]
        if k == VAR:
            for j in range(6):
                w[j] = box[left[i], j]
            continue
        for j in range(6):
            w[j] = 0.0
        if k == NUM:
            w[0] = w[1] = number[i]
            continue
        u, v = work[left[i]], work[right[i]]
        if k in (NEG, ADD, SUB):
            _write_linear(k, u, v, w)
        elif k == MUL:
            _product(u, v, w)
        elif k == DIV:
            _quotient(u, v, w)
        elif k == HYPOT:
            _norm(u, v, w)
        elif k in (MIN, MAX):
            _extreme(k, u, v, w)
        elif k == POW:
            _any_power(u, v, w)
        else:
            _write_function(k, number[i], u, w)
    for r in range(len(roots)):
        for j in range(6):
            out[r, j] = work[roots[r], j]
