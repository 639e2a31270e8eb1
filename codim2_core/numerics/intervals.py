"""Interval arithmetic, compiled: bounds of U and its derivatives over a whole box of the e-disc.

A result holds for every point of the box, rounding included: each bound is moved outwards by more than the operation
and the library function behind it may be off. What is undefined somewhere in a box has the bounds -inf, inf.
"""

from __future__ import annotations

import math

from numba import njit

from ..expressions.opcodes import (
    ADD,
    ATAN,
    COS,
    COSH,
    DIV,
    EXP,
    HYPOT,
    LOG,
    MAX,
    MIN,
    MUL,
    NEG,
    NUM,
    POW,
    POWI,
    SIGN,
    SIN,
    SINH,
    SQRT,
    SUB,
    TAN,
    TANH,
    VAR,
)

WIDER = 2.0**-51  # four units of rounding: sums and products need half of one, library functions up to two
TINY = 1e-300
HALF_PI = 0.5 * math.pi
WHOLE_TURN = 2.0 * math.pi


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _out(lo, hi):
    if not (lo <= hi):
        return -math.inf, math.inf
    return lo - abs(lo) * WIDER - TINY, hi + abs(hi) * WIDER + TINY


@njit(cache=True, nogil=True, error_model="numpy")
def multiply(a, b, c, d):
    """Return [a, b] [c, d]."""
    if (a == 0.0 and b == 0.0) or (c == 0.0 and d == 0.0):
        return 0.0, 0.0
    p, q, r, s = a * c, a * d, b * c, b * d
    if not math.isfinite(p + q + r + s):
        return -math.inf, math.inf
    return _out(min(min(p, q), min(r, s)), max(max(p, q), max(r, s)))


@njit(cache=True, nogil=True, error_model="numpy")
def divide(a, b, c, d):
    """Return [a, b]/[c, d]; everything if the divisor may be zero."""
    if not (c > 0.0 or d < 0.0):
        return -math.inf, math.inf
    p, q, r, s = a / c, a / d, b / c, b / d
    if not math.isfinite(p + q + r + s):
        return -math.inf, math.inf
    return _out(min(min(p, q), min(r, s)), max(max(p, q), max(r, s)))


@njit(cache=True, nogil=True, error_model="numpy")
def power(a, b, n):
    """Return [a, b] ** n for a whole n."""
    if n == 0.0:
        return 1.0, 1.0
    if n < 0.0:
        lo, hi = power_positive(a, b, -n)
        return divide(1.0, 1.0, lo, hi)
    return power_positive(a, b, n)


@njit(cache=True, nogil=True, error_model="numpy")
def power_positive(a, b, n):
    """Return [a, b] ** n for a whole n > 0."""
    if n == 1.0:
        return a, b
    p, q = math.pow(a, n), math.pow(b, n)
    if n % 2.0 == 0.0:
        if a <= 0.0 <= b:
            return _out(0.0, max(p, q))
        return _out(min(p, q), max(p, q))
    return _out(p, q)


@njit(cache=True, nogil=True, error_model="numpy")
def _sine(a, b):
    if not (b - a < WHOLE_TURN):
        return -1.0, 1.0
    p, q = math.sin(a), math.sin(b)
    lo, hi = min(p, q), max(p, q)
    blur = 1e-15 * (1.0 + abs(a))
    if HALF_PI + WHOLE_TURN * math.ceil((a - blur - HALF_PI) / WHOLE_TURN) <= b + blur:
        hi = 1.0
    if -HALF_PI + WHOLE_TURN * math.ceil((a - blur + HALF_PI) / WHOLE_TURN) <= b + blur:
        lo = -1.0
    lo, hi = _out(lo, hi)
    return max(lo, -1.0), min(hi, 1.0)


@njit(cache=True, nogil=True, error_model="numpy")
def _cosine(a, b):
    lo, hi = _out(a + HALF_PI, b + HALF_PI)
    return _sine(lo, hi)


@njit(cache=True, nogil=True, error_model="numpy")
def _hyperbolic_cosine(a, b):
    p, q = math.cosh(a), math.cosh(b)
    return _out(1.0 if a <= 0.0 <= b else min(p, q), max(p, q))


@njit(cache=True, nogil=True, error_model="numpy")
def _tangent(a, b):
    if math.floor((a - HALF_PI) / math.pi) != math.floor((b - HALF_PI) / math.pi):
        return -math.inf, math.inf
    return _out(math.tan(a), math.tan(b))


@njit(cache=True, nogil=True, error_model="numpy")
def _unary(k, a, b, v, w):
    """Range [v, w] of the function k over [a, b] is known; return the range of its derivative."""
    if k == SIN:
        return _cosine(a, b)
    if k == COS:
        lo, hi = _sine(a, b)
        return -hi, -lo
    if k == TAN:
        lo, hi = power_positive(v, w, 2.0)
        return _out(1.0 + lo, 1.0 + hi)
    if k == EXP:
        return v, w
    if k == LOG:
        return divide(1.0, 1.0, a, b)
    if k == SQRT:
        return divide(0.5, 0.5, v, w)
    if k == TANH:
        lo, hi = _hyperbolic_cosine(a, b)
        lo, hi = power_positive(lo, hi, 2.0)
        return divide(1.0, 1.0, lo, hi)
    if k == SINH:
        return _hyperbolic_cosine(a, b)
    if k == COSH:
        return _out(math.sinh(a), math.sinh(b))
    if k == ATAN:
        lo, hi = power_positive(a, b, 2.0)
        return divide(1.0, 1.0, 1.0 + lo, 1.0 + hi)
    if k == SIGN:
        return (0.0, 0.0) if a > 0.0 or b < 0.0 or a == b else (-math.inf, math.inf)
    return (1.0 if a > 0.0 else -1.0), (-1.0 if b < 0.0 else 1.0)  # abs


@njit(cache=True, nogil=True, error_model="numpy")
def _range(k, a, b):
    """Range of the function k over [a, b]."""
    if k == SIN:
        return _sine(a, b)
    if k == COS:
        return _cosine(a, b)
    if k == TAN:
        return _tangent(a, b)
    if k == EXP:
        lo, hi = _out(math.exp(a), math.exp(b))
        return max(lo, 0.0), hi
    if k == LOG:
        return _out(math.log(a), math.log(b)) if a > 0.0 else (-math.inf, math.inf)
    if k == SQRT:
        if a < 0.0:
            return -math.inf, math.inf
        lo, hi = _out(math.sqrt(a), math.sqrt(b))
        return max(lo, 0.0), hi
    if k == TANH:
        return _out(math.tanh(a), math.tanh(b))
    if k == SINH:
        return _out(math.sinh(a), math.sinh(b))
    if k == COSH:
        return _hyperbolic_cosine(a, b)
    if k == ATAN:
        return _out(math.atan(a), math.atan(b))
    if k == SIGN:
        if a == b == 0.0:
            return 0.0, 0.0
        return (1.0 if a > 0.0 else -1.0), (-1.0 if b < 0.0 else 1.0)
    return _modulus(a, b)


@njit(cache=True, nogil=True, error_model="numpy")
def _modulus(a, b):
    """Return |[a, b]|."""
    if a <= 0.0 <= b:
        return 0.0, max(-a, b)
    return min(abs(a), abs(b)), max(abs(a), abs(b))


@njit(cache=True, nogil=True, error_model="numpy")
def _slope_of_hypot(a, b, lo, hi):
    """Bounds of u/h for u in [a, b] and h = hypot(u, v) in [lo, hi]: within [-1, 1], at the tip too."""
    p, q = divide(a, b, lo, hi)
    return max(p, -1.0), min(q, 1.0)


@njit(cache=True, nogil=True, error_model="numpy")
def _power_general(a, b, c, d):
    """Return [a, b] ** [c, d] where the base is positive; everything elsewhere."""
    if not a > 0.0:
        if a == 0.0 and c == d and c > 0.0:
            return _out(0.0, math.pow(b, c))
        return -math.inf, math.inf
    if c == d:
        p, q = math.pow(a, c), math.pow(b, c)
        return _out(min(p, q), max(p, q))
    lo, hi = _out(math.log(a), math.log(b))
    lo, hi = multiply(lo, hi, c, d)
    return _out(math.exp(lo), math.exp(hi))


@njit(cache=True, nogil=True, error_model="numpy")
def enclose(op, left, right, number, roots, c_lo, c_hi, s_lo, s_hi, work, out):
    """Enclose the rows and their derivatives by c and s over a box, on Sigma.

    work : (n, 6), scratch; out : (rows, 6), lower and upper bound of the value, of d/dc and of d/ds.
    """
    for i in range(len(op)):
        k = op[i]
        w = work[i]
        for j in range(6):
            w[j] = 0.0
        if k == NUM:
            w[0] = w[1] = number[i]
            continue
        if k == VAR:
            if left[i] == 0:
                w[0], w[1], w[2], w[3] = c_lo, c_hi, 1.0, 1.0
            elif left[i] == 1:
                w[0], w[1], w[4], w[5] = s_lo, s_hi, 1.0, 1.0
            continue
        u, v = work[left[i]], work[right[i]]
        if k == NEG:
            for j in (0, 2, 4):
                w[j], w[j + 1] = -u[j + 1], -u[j]
        elif k == ADD:
            for j in (0, 2, 4):
                w[j], w[j + 1] = _out(u[j] + v[j], u[j + 1] + v[j + 1])
        elif k == SUB:
            for j in (0, 2, 4):
                w[j], w[j + 1] = _out(u[j] - v[j + 1], u[j + 1] - v[j])
        elif k == MUL:
            w[0], w[1] = multiply(u[0], u[1], v[0], v[1])
            for j in (2, 4):
                a, b = multiply(u[j], u[j + 1], v[0], v[1])
                c, d = multiply(u[0], u[1], v[j], v[j + 1])
                w[j], w[j + 1] = _out(a + c, b + d)
        elif k == DIV:
            w[0], w[1] = divide(u[0], u[1], v[0], v[1])
            for j in (2, 4):
                a, b = multiply(w[0], w[1], v[j], v[j + 1])
                a, b = _out(u[j] - b, u[j + 1] - a)
                w[j], w[j + 1] = divide(a, b, v[0], v[1])
        elif k == HYPOT:
            a, b = _modulus(u[0], u[1])
            c, d = _modulus(v[0], v[1])
            w[0], w[1] = _out(math.hypot(a, c), math.hypot(b, d))
            w[0] = max(w[0], 0.0)
            p, q = _slope_of_hypot(u[0], u[1], w[0], w[1])
            lo, hi = _slope_of_hypot(v[0], v[1], w[0], w[1])
            for j in (2, 4):
                a, b = multiply(p, q, u[j], u[j + 1])
                c, d = multiply(lo, hi, v[j], v[j + 1])
                w[j], w[j + 1] = _out(a + c, b + d)
        elif k in (MIN, MAX):
            first, second = (u[1] < v[0], v[1] < u[0]) if k == MIN else (u[0] > v[1], v[0] > u[1])
            w[0], w[1] = (min(u[0], v[0]), min(u[1], v[1])) if k == MIN else (max(u[0], v[0]), max(u[1], v[1]))
            for j in (2, 4):
                w[j], w[j + 1] = min(u[j], v[j]), max(u[j + 1], v[j + 1])
                if first:
                    w[j], w[j + 1] = u[j], u[j + 1]
                elif second:
                    w[j], w[j + 1] = v[j], v[j + 1]
        elif k == POW:
            w[0], w[1] = _power_general(u[0], u[1], v[0], v[1])
            if v[2] == v[3] == v[4] == v[5] == 0.0:
                a, b = _power_general(u[0], u[1], v[0] - 1.0, v[1] - 1.0)
                a, b = multiply(a, b, v[0], v[1])
                for j in (2, 4):
                    w[j], w[j + 1] = multiply(a, b, u[j], u[j + 1])
            else:
                lo, hi = _range(LOG, u[0], u[1])
                for j in (2, 4):
                    a, b = multiply(v[j], v[j + 1], lo, hi)
                    c, d = multiply(v[0], v[1], u[j], u[j + 1])
                    c, d = divide(c, d, u[0], u[1])
                    a, b = _out(a + c, b + d)
                    w[j], w[j + 1] = multiply(w[0], w[1], a, b)
        else:
            if k == POWI:
                w[0], w[1] = power(u[0], u[1], number[i])
                a, b = 0.0, 0.0
                if number[i] != 0.0:
                    a, b = power(u[0], u[1], number[i] - 1.0)
                    a, b = multiply(a, b, number[i], number[i])
            else:
                w[0], w[1] = _range(k, u[0], u[1])
                a, b = _unary(k, u[0], u[1], w[0], w[1])
            for j in (2, 4):
                w[j], w[j + 1] = multiply(a, b, u[j], u[j + 1])
    for r in range(len(roots)):
        for j in range(6):
            out[r, j] = work[roots[r], j]
