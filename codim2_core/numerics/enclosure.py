"""Bounds of formulas and two derivatives over a whole box, by interval arithmetic along their tape; compiled.

Each bound is moved outwards by more than the operation and the library function behind it may be off: it holds for
every point of the box, rounding included. What is undefined somewhere in it has the bounds -inf, inf.
"""

from __future__ import annotations

import math

import numpy as np

from ..formulas.functions import FIRST_CODE, FUNCTIONS, code, kernels
from ..formulas.jit import inlined_kernel, kernel, spliced_kernel
from ..formulas.opcodes import ADD, DIV, HYPOT, MAX, MIN, MUL, NEG, NUM, POW, POWI, SUB, VAR

ABS, SIGN_CODE, FLOOR_CODE, ATAN, COS, COSH = (code[name] for name in ("abs", "sign", "floor", "atan", "cos", "cosh"))
EXP, LOG, SIN, SINH = (code[name] for name in ("exp", "log", "sin", "sinh"))
SQRT, TAN, TANH = (code[name] for name in ("sqrt", "tan", "tanh"))
BLUR = np.array([one.blur for one in FUNCTIONS])
UNTIL = np.array([one.until for one in FUNCTIONS])

WIDER = 2.0**-51  # four units of rounding: sums and products need half of one, library functions up to two
UNDERFLOW_BOUND = 1e-300
HALF_PI = 0.5 * math.pi
WHOLE_TURN = 2.0 * math.pi


@spliced_kernel
def outwards(lo, hi):
    """Return bounds moved outwards, and -inf, inf where there are none."""
    if not (lo <= hi):
        return -math.inf, math.inf
    return lo - abs(lo) * WIDER - UNDERFLOW_BOUND, hi + abs(hi) * WIDER + UNDERFLOW_BOUND


@kernel
def add(a, b, c, d):
    """Return [a, b] + [c, d]; a zero changes nothing, and is not rounded."""
    if c == d == 0.0:
        return a, b
    return (c, d) if a == b == 0.0 else outwards(a + c, b + d)


@kernel
def multiply(a, b, c, d):
    """Return [a, b] [c, d]."""
    if (a == 0.0 and b == 0.0) or (c == 0.0 and d == 0.0):
        return 0.0, 0.0
    p, q, r, s = a * c, a * d, b * c, b * d
    if not math.isfinite(p + q + r + s):
        return -math.inf, math.inf
    return outwards(min(min(p, q), min(r, s)), max(max(p, q), max(r, s)))


@kernel
def divide(a, b, c, d):
    """Return [a, b]/[c, d]; everything if the divisor may be zero."""
    if not (c > 0.0 or d < 0.0):
        return -math.inf, math.inf
    if a == b == 0.0:
        return 0.0, 0.0
    p, q, r, s = a / c, a / d, b / c, b / d
    if not math.isfinite(p + q + r + s):
        return -math.inf, math.inf
    return outwards(min(min(p, q), min(r, s)), max(max(p, q), max(r, s)))


@kernel
def power(a, b, n):
    """Return [a, b] ** n for a whole n."""
    if n == 0.0:
        return 1.0, 1.0
    if n < 0.0:
        lo, hi = power_positive(a, b, -n)
        return divide(1.0, 1.0, lo, hi)
    return power_positive(a, b, n)


@kernel
def power_positive(a, b, n):
    """Return [a, b] ** n for a whole n > 0."""
    if n == 1.0 or a == b == 0.0:
        return a, b
    p, q = math.pow(a, n), math.pow(b, n)
    if n % 2.0 == 0.0:
        if a <= 0.0 <= b:
            return 0.0, outwards(0.0, max(p, q))[1]
        return outwards(min(p, q), max(p, q))
    return outwards(p, q)


@kernel
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
    lo, hi = outwards(lo, hi)
    return max(lo, -1.0), min(hi, 1.0)


@kernel
def _cosine(a, b):
    lo, hi = outwards(a + HALF_PI, b + HALF_PI)
    return _sine(lo, hi)


@kernel
def _hyperbolic_cosine(a, b):
    p, q = math.cosh(a), math.cosh(b)
    return outwards(1.0 if a <= 0.0 <= b else min(p, q), max(p, q))


@kernel
def _tangent(a, b):
    if math.floor((a - HALF_PI) / math.pi) != math.floor((b - HALF_PI) / math.pi):
        return -math.inf, math.inf
    return outwards(math.tan(a), math.tan(b))


@kernel
def _monotone_bounds(k, a, b, p, q):
    """Bounds between p and q, what is monotone at a and b, with the blur of the function k."""
    blur = BLUR[k - FIRST_CODE] * WIDER * (1.0 + max(abs(a), abs(b)))
    p, q = min(p, q), max(p, q)
    return outwards(p - abs(p) * blur, q + abs(q) * blur)


@kernel
def slope_of(k, a, b, v, w):
    """Range [v, w] of the function k over [a, b] is known; return the range of its derivative."""
    if k == SIN:
        return _cosine(a, b)
    if k == COS:
        lo, hi = _sine(a, b)
        return -hi, -lo
    if k == TAN:
        lo, hi = power_positive(v, w, 2.0)
        return outwards(1.0 + lo, 1.0 + hi)
    if k == EXP:
        return v, w
    if k == LOG:
        return divide(1.0, 1.0, a, b)
    if k == SQRT:
        return divide(0.5, 0.5, v, w)
    if k == TANH:
        lo, hi = _hyperbolic_cosine(a, b)
        if not hi < 1e150:  # it overflows, and 1 - tanh^2 does not
            lo, hi = modulus(v, w)
            return max(1.0 - hi * hi - WIDER, 0.0), 1.0 - lo * lo + WIDER
        lo, hi = power_positive(lo, hi, 2.0)
        return divide(1.0, 1.0, lo, hi)
    if k == SINH:
        return _hyperbolic_cosine(a, b)
    if k == COSH:
        return outwards(math.sinh(a), math.sinh(b))
    if k == ATAN:
        lo, hi = power_positive(a, b, 2.0)
        return divide(1.0, 1.0, 1.0 + lo, 1.0 + hi)
    if k == SIGN_CODE:
        return (0.0, 0.0) if a > 0.0 or b < 0.0 or a == b else (-math.inf, math.inf)
    if k == FLOOR_CODE:
        return (0.0, 0.0) if v == w else (-math.inf, math.inf)
    if k == ABS:
        return (1.0 if a > 0.0 else -1.0), (-1.0 if b < 0.0 else 1.0)
    if not b <= UNTIL[k - FIRST_CODE]:
        return -math.inf, math.inf
    return _monotone_bounds(k, a, b, kernels.slope(k, a, kernels.value(k, a)), kernels.slope(k, b, kernels.value(k, b)))


@kernel
def modulus(a, b):
    """Return |[a, b]|."""
    if a <= 0.0 <= b:
        return 0.0, max(-a, b)
    return min(abs(a), abs(b)), max(abs(a), abs(b))


@kernel
def range_of(k, a, b):
    """Range of the function k over [a, b]."""
    if k == SIN:
        return _sine(a, b)
    if k == COS:
        return _cosine(a, b)
    if k == TAN:
        return _tangent(a, b)
    if k == COSH:
        return _hyperbolic_cosine(a, b)
    if k in (EXP, LOG, SQRT, TANH, SINH, ATAN):  # they rise
        if (k == LOG and not a > 0.0) or (k == SQRT and a < 0.0):
            return -math.inf, math.inf
        lo, hi = outwards(kernels.value(k, a), kernels.value(k, b))
        return (max(lo, 0.0), hi) if k in (EXP, SQRT) else (lo, hi)
    if k == SIGN_CODE:
        if a == b == 0.0:
            return 0.0, 0.0
        return (1.0 if a > 0.0 else -1.0), (-1.0 if b < 0.0 else 1.0)
    if k == FLOOR_CODE:
        return kernels.value(k, a), kernels.value(k, b)
    if k == ABS:
        return modulus(a, b)
    if not b <= UNTIL[k - FIRST_CODE]:
        return -math.inf, math.inf
    return _monotone_bounds(k, a, b, kernels.value(k, a), kernels.value(k, b))


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
    """Write bounds of the rows and their derivatives by c and s over a box, out (rows, 6); work is (n, 6)."""
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
