"""The gain of each family of Psi: ``e_Psi = gain p``, ``gain = 1/sqrt(|p|^2 + w^2 Psi(|p|^2/w^2))``, eq:ePsi.

Outside, where w is rho, ``gain = 1/|p|``. Scalar functions, inlined into the fields of e-linear systems, and the same
for all lanes at an address, which the fields of general systems call: so a system is compiled once for all Psi.

Everything is free of branches and of library calls, so that it runs in vector registers.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any

from numba import (
    carray,  # pyright: ignore[reportPrivateImportUsage] (documented as numba.carray)
    njit,
)

from ..psi.function import Psi
from .compiling import ARITHMETIC, Kept, compiled
from .layout import LANES, PARAMETERS, SIGN, WIDTH, bits_of_double, double_of_bits
from .numbers import PSI

TINY = 1e-300
LOG2_E, LN2_HIGH, LN2_LOW = 1.4426950408889634, 0.6931471803691238, 1.9082149292705877e-10
# Beyond s = LARGE, w^2 Psi(s) <= Psi(s) |p|^2/LARGE is lost beside |p|^2.
LARGE = 1e20
MOST_INTEGER = 255  # of n of the Hill family, for powers by squaring: eight bits


@njit(cache=True, fastmath={"contract"}, error_model="numpy", forceinline=True)
def expm1(x):
    """exp(x) - 1 to an ulp or two, |x| <= 700: Cody and Waite's reduction, a Taylor polynomial on |r| <= ln(2)/2."""
    k = math.floor(x * LOG2_E + 0.5)
    r = (x - k * LN2_HIGH) - k * LN2_LOW
    q = 1.0 / 6227020800.0
    q = q * r + 1.0 / 479001600.0
    q = q * r + 1.0 / 39916800.0
    q = q * r + 1.0 / 3628800.0
    q = q * r + 1.0 / 362880.0
    q = q * r + 1.0 / 40320.0
    q = q * r + 1.0 / 5040.0
    q = q * r + 1.0 / 720.0
    q = q * r + 1.0 / 120.0
    q = q * r + 1.0 / 24.0
    q = q * r + 1.0 / 6.0
    q = q * r + 0.5
    scale = double_of_bits((int(k) + 1023) << 52)
    return scale * (q * r * r + r) + (scale - 1.0)


@njit(cache=True, fastmath={"contract"}, error_model="numpy", forceinline=True)
def log(x):
    """Natural logarithm of a normal positive double, to an ulp or two: 2 artanh((m - 1)/(m + 1)) and the exponent."""
    # Shifting by the bits of 1/sqrt(2) makes the mantissa m fall in [1/sqrt(2), sqrt(2)).
    bits = bits_of_double(x)
    exponent = (bits - 0x3FE6A09E667F3BCD) >> 52
    m = double_of_bits(bits - (exponent << 52))
    k = float(exponent)
    f = (m - 1.0) / (m + 1.0)
    g = f * f
    q = 1.0 / 23.0
    q = q * g + 1.0 / 21.0
    q = q * g + 1.0 / 19.0
    q = q * g + 1.0 / 17.0
    q = q * g + 1.0 / 15.0
    q = q * g + 1.0 / 13.0
    q = q * g + 1.0 / 11.0
    q = q * g + 1.0 / 9.0
    q = q * g + 1.0 / 7.0
    q = q * g + 1.0 / 5.0
    q = q * g + 1.0 / 3.0
    return k * LN2_HIGH + (2.0 * f + (2.0 * f * g * q + k * LN2_LOW))


@njit(cache=True, fastmath=ARITHMETIC, error_model="numpy", forceinline=True)
def gain_rational(r2, w):
    """Psi = 1/(1 + s)."""
    w2 = w * w
    return 1.0 / math.sqrt(max(r2 + w2 * w2 / max(r2 + w2, TINY), TINY))


@njit(cache=True, fastmath=ARITHMETIC, error_model="numpy", forceinline=True)
def gain_exponential(r2, w):
    """Psi = exp(-s)."""
    w2 = w * w
    s = min(r2 / max(w2, TINY), 700.0)
    return 1.0 / math.sqrt(max(r2 + w2 * (1.0 + expm1(-s)), TINY))


@njit(cache=True, fastmath=ARITHMETIC, error_model="numpy", forceinline=True)
def gain_tanh(r2, w):
    """Psi = s/sinh^2 sqrt(s), that is e = tanh(zeta) p/|p|, with zeta = |p|/w."""
    r = max(math.sqrt(r2), 1e-150)
    m = expm1(-2.0 * min(r / max(abs(w), TINY), 350.0))
    return -m / ((2.0 + m) * r)


@njit(cache=True, fastmath=ARITHMETIC, error_model="numpy", forceinline=True)
def gain_hill(r2, w, n):
    """Psi = 3/(3 + (4 s)^n)."""
    w2 = w * w
    power = n * log(max(min(4.0 * r2 / max(w2, TINY), 1e300), TINY))
    return 1.0 / math.sqrt(max(r2 + 3.0 * w2 / (4.0 + expm1(max(min(power, 700.0), -700.0))), TINY))


@njit(cache=True, fastmath=ARITHMETIC, error_model="numpy", forceinline=True)
def gain_hill_integer(r2, w, n):
    """Psi = 3/(3 + (4 s)^n) for an integer n in 1..MOST_INTEGER, the power by squaring; infinity is a good power."""
    w2 = w * w
    base = 4.0 * r2 / max(w2, TINY)
    power = 1.0
    for bit in range(8):
        power = power * base if (n >> bit) & 1 else power
        base = base * base
    return 1.0 / math.sqrt(max(r2 + 3.0 * w2 / (3.0 + power), TINY))


@njit(cache=True, fastmath=ARITHMETIC, error_model="numpy", forceinline=True)
def arguments(S, P, lane):
    """``|p|^2`` and ebar (0 outside) in one lane: what a gain depends on."""
    x, y = S[lane], S[lane + LANES]
    return x * x + y * y, S[lane + 2 * LANES] * (0.5 - 0.5 * P[lane + SIGN])


def gain_custom(source: str) -> Any:
    """Compile the gain for Psi given as Python source in s, as `Expression.python_source` writes it."""
    scope: dict[str, Any] = {"math": math}
    exec(f"def psi(s):\n    return {source}\n", scope)  # written by Expression: names and math.* only
    psi = njit(error_model="numpy")(scope["psi"])

    @njit(fastmath=ARITHMETIC, error_model="numpy")
    def gain(r2, w):
        w2 = w * w
        shape = 0.0
        if r2 < LARGE * w2:
            shape = w2 * psi(r2 / w2)
            if not 0.0 <= shape < math.inf:  # a formula that leaves R1 here: the nonsmooth field instead
                shape = 0.0
        return 1.0 / math.sqrt(max(r2 + shape, TINY))

    return gain


def _ones(state, out, parameters):  # noqa: ARG001 (a gain is called with all three)
    D = carray(out, (WIDTH,))
    for lane in range(LANES):
        D[lane] = 1.0


def _constant(state, out, parameters):
    S, D, P = carray(state, (WIDTH,)), carray(out, (WIDTH,)), carray(parameters, (PARAMETERS,))
    for lane in range(LANES):
        r2, w = arguments(S, P, lane)
        D[lane] = 1.0 / math.sqrt(max(r2 + w * w, TINY))


def _rational(state, out, parameters):
    S, D, P = carray(state, (WIDTH,)), carray(out, (WIDTH,)), carray(parameters, (PARAMETERS,))
    for lane in range(LANES):
        r2, w = arguments(S, P, lane)
        D[lane] = gain_rational(r2, w)


def _exponential(state, out, parameters):
    S, D, P = carray(state, (WIDTH,)), carray(out, (WIDTH,)), carray(parameters, (PARAMETERS,))
    for lane in range(LANES):
        r2, w = arguments(S, P, lane)
        D[lane] = gain_exponential(r2, w)


def _tanh(state, out, parameters):
    S, D, P = carray(state, (WIDTH,)), carray(out, (WIDTH,)), carray(parameters, (PARAMETERS,))
    for lane in range(LANES):
        r2, w = arguments(S, P, lane)
        D[lane] = gain_tanh(r2, w)


def _hill(state, out, parameters):
    S, D, P = carray(state, (WIDTH,)), carray(out, (WIDTH,)), carray(parameters, (PARAMETERS,))
    for lane in range(LANES):
        r2, w = arguments(S, P, lane)
        D[lane] = gain_hill(r2, w, P[PSI])


def _hill_integer(state, out, parameters):
    S, D, P = carray(state, (WIDTH,)), carray(out, (WIDTH,)), carray(parameters, (PARAMETERS,))
    n = int(P[PSI])
    for lane in range(LANES):
        r2, w = arguments(S, P, lane)
        D[lane] = gain_hill_integer(r2, w, n)


def _custom(gain):
    def gains(state, out, parameters):
        S, D, P = carray(state, (WIDTH,)), carray(out, (WIDTH,)), carray(parameters, (PARAMETERS,))
        for lane in range(LANES):
            r2, w = arguments(S, P, lane)
            D[lane] = gain(r2, w)

    return gains


_FAMILIES = {
    "ones": _ones,
    "constant": _constant,
    "rational": _rational,
    "exponential": _exponential,
    "tanh": _tanh,
    "hill": _hill,
    "hill, integer n": _hill_integer,
}


@lru_cache(maxsize=len(_FAMILIES))
def _family(name: str) -> Any:
    return compiled(_FAMILIES[name], cache=True)


MOST_EXPRESSIONS = 64  # compiled custom formulas kept
_custom_gains = Kept(MOST_EXPRESSIONS)


def family_name(psi: Psi) -> str:
    """Name the compiled variant of a built-in family: for integer n the Hill family has powers by squaring."""
    if psi.family == "hill" and psi.parameter in range(1, MOST_INTEGER + 1):
        return "hill, integer n"
    return psi.family


def source_of(psi: Psi) -> str:
    """Python source of a custom Psi.

    Raises
    ------
    ValueError
        It has none.
    """
    if psi.expression is None:
        raise ValueError(f"{psi!r} has no expression; make it with psi.custom.")
    return psi.expression.python_source()


def gains(psi: Psi, smooth: bool) -> Any:
    """Return the compiled gain of all lanes, whose `address` a general system's field calls.

    Parameters
    ----------
    psi : Psi
    smooth : bool
        U is smooth beyond |e| = 1 too. For Psi = 1 the gain, 1 on the sphere, is then left out; otherwise it holds
        |e| <= 1 where a step strays off the sphere.
    """
    if psi.family == "custom":
        source = source_of(psi)
        return _custom_gains.get(source, lambda: compiled(_custom(gain_custom(source)), cache=False))
    return _family("ones" if smooth and psi.family == "constant" else family_name(psi))


def has_gains(psi: Psi) -> bool:
    """Whether `gains` answers without compiling (a built-in family may still be loaded from the disk cache)."""
    return psi.family != "custom" or source_of(psi) in _custom_gains
