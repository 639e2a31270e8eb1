"""Complete elliptic integrals of the parameter m <= 1, as SciPy's.

Integrals over 0 <= t <= pi/2 with D^2 = 1 - m sin^2 t:

    ellipk    1/D
    ellipe    D                   = B_0
    ellipb    cos^2 t/D           = B_1 = (E - (1 - m) K)/m
    ellipb2   cos^4 t/D^3         = B_2 = (2 B_1 - E)/m
    ellipc2   cos^4 t sin^2 t/D^5 = (2/3) B_2'

The last three are what a formula in K and E needs where it would divide by m: they have no 0/0 at m = 0. All are sums
along the means of Gauss, of which none cancels there: with c_1 = m/(4 a_1), c_(n+1) = c_n^2/(4 a_(n+1)) and
S = sum of 2^(n-1) (c_n/m)^2, E = K (1 - m/2 - m^2 S), B_1 = K (1/2 - m S), B_2 = K (1/2 + m S - 2 S).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from ...results.rebind import rebind
from .function import Function, Kernels

MEANS = 60  # more than any m needs
SERIES = 0.05  # |m| below which the slope of C_2 is summed
BLUR = 100.0


def integrals(m):
    """Return K, E, B_1, B_2 and C_2 at m; inf where they are, NaN beyond 1."""
    if not m < 1.0:
        if m == 1.0:
            return math.inf, 1.0, 1.0, 1.0, math.inf
        return math.nan, math.nan, math.nan, math.nan, math.nan
    b0 = math.sqrt(1.0 - m)
    a1 = 0.5 * (1.0 + b0)
    a, b = a1, math.sqrt(b0)
    r = 0.25 / a1  # c_1/m
    q = 0.0  # c_n/m^2, from n = 2 on
    weight, S, rest = 1.0, r * r, 0.0
    for n in range(MEANS):
        a, b = 0.5 * (a + b), math.sqrt(a * b)
        q = 0.25 * (r * r if n == 0 else m * m * q * q) / a
        r = m * q
        weight *= 2.0
        S += weight * r * r
        rest += weight * q * q
        if abs(m * r) < 1e-9 * a:
            break
    K = 0.5 * math.pi / (0.5 * (a + b))
    E, B = K * (1.0 - 0.5 * m - m * m * S), K * (0.5 - m * S)
    C2 = K * (-0.5 * S + (1.0 + a1) / (8.0 * a1 * a1 * (1.0 + b0)) + 4.0 * m * rest) / 1.5
    return K, E, B, K * (0.5 + m * S - 2.0 * S), C2


def _slopes(m, K, E, B, B2, C2):
    """Slopes of all five."""
    if m == 1.0:
        return math.inf, -math.inf, math.inf, math.inf, math.inf
    if abs(m) < SERIES:
        term, last = 7.5 * math.pi / 512.0 * 2.0, 0.0  # (5/2) times the integral of cos^4 sin^4
        for j in range(16):
            last += term
            # next: (7/2 + j)/(j + 1) times the ratio of integrals of cos^4 sin^(2 j + 4)
            term *= m * (3.5 + j) / (j + 1.0) * (2.0 * j + 5.0) / (2.0 * j + 10.0)
    else:
        last = (0.5 * B2 / (1.0 - m) - 3.0 * C2) / m
    return 0.5 * B / (1.0 - m), 0.5 * (B - K), 0.5 * (K - B - B2), 1.5 * C2, last


# What the two functions below read; `_kernels` puts the compiled ones in their place.
column: int = 0
slopes: Any = None


def _one_integral(m):
    return integrals(m)[column]


def _slope_of_one(m, v):
    K, E, B, B2, C2 = integrals(m)
    return slopes(m, K, E, B, B2, C2)[column]


@cache
def _all_five(jit: Any) -> tuple[Any, Any]:
    return jit(integrals), jit(_slopes)


def _kernels(i: int) -> Callable[[Any], Kernels]:
    def make_kernels(jit: Any) -> Kernels:
        values, slopes = _all_five(jit)
        of_these = {"column": i, "integrals": values}
        return jit(rebind(_one_integral, i, **of_these)), jit(rebind(_slope_of_one, i, slopes=slopes, **of_these))

    return make_kernels


def _half_over(build: Any, i: int, u: int) -> int:
    """Entry of i/(2 (1 - u))."""
    rest = build.apply("-", build.number(1.0), u)
    return build.apply("/", build.apply("*", build.number(0.5), i), rest)


def _rate_k(build: Any, k: int, u: int) -> int:
    return _half_over(build, build.apply("ellipb", u), u)


def _rate_e(build: Any, k: int, u: int) -> int:
    return build.apply("*", build.number(0.5), build.apply("-", build.apply("ellipb", u), build.apply("ellipk", u)))


def _rate_b(build: Any, k: int, u: int) -> int:
    rest = build.apply("-", build.apply("-", build.apply("ellipk", u), k), build.apply("ellipb2", u))
    return build.apply("*", build.number(0.5), rest)


def _rate_b2(build: Any, k: int, u: int) -> int:
    return build.apply("*", build.number(1.5), build.apply("ellipc2", u))


def _rate_c2(build: Any, k: int, u: int) -> int:
    rest = _half_over(build, build.apply("ellipb2", u), u)
    return build.apply("/", build.apply("-", rest, build.apply("*", build.number(3.0), k)), u)


def _elliptic_function(i: int, name: str, rate: Callable[[Any, int, int], int]) -> Function:
    scalar = rebind(_one_integral, i, column=i)
    return Function(
        name, scalar, np.vectorize(scalar, otypes=[float]), _kernels(i), rate, sign="positive", blur=BLUR, until=1.0
    )


ELLIPTIC = tuple(
    _elliptic_function(i, name, rate)
    for i, (name, rate) in enumerate(
        (("ellipk", _rate_k), ("ellipe", _rate_e), ("ellipb", _rate_b), ("ellipb2", _rate_b2), ("ellipc2", _rate_c2))
    )
)
