"""The layer problem and the nonsmooth outside as one compiled field: e-linear systems, for each family of Psi.

``p' = U - p (p.U)`` and ``w' = -w (p.U)`` (w = ebar) or ``w' = +w (p.U)`` (w = rho), with U at ``e = gain p``. For
Psi = 1 the gain is 1 on the sphere, and leaving it out extends the field off the sphere smoothly.

Loops are free of branches and of library calls, so that they run in vector registers.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

from numba import (
    carray,  # pyright: ignore[reportPrivateImportUsage] (documented as numba.carray)
    njit,
)

from ..psi.function import Psi
from .compiling import ARITHMETIC, Kept, compiled
from .gains import (
    MOST_EXPRESSIONS,
    arguments,
    family_name,
    gain_custom,
    gain_exponential,
    gain_hill,
    gain_hill_integer,
    gain_rational,
    gain_tanh,
    source_of,
)
from .layout import LANES, PARAMETERS, SIGN, WIDTH
from .numbers import PSI


@njit(cache=True, fastmath=ARITHMETIC, error_model="numpy", forceinline=True)
def put(S, out, P, lane, gain):
    """Write one lane of the field, given its gain."""
    x, y, w = S[lane], S[lane + LANES], S[lane + 2 * LANES]
    c, s = gain * x, gain * y
    u = P[0] * c - P[1] * s + P[3]
    v = P[1] * c + P[2] * s + P[4]
    q = x * u + y * v
    out[lane] = u - x * q
    out[lane + LANES] = v - y * q
    out[lane + 2 * LANES] = P[lane + SIGN] * w * q


def _constant(state, out, parameters):
    S, D, P = carray(state, (WIDTH,)), carray(out, (WIDTH,)), carray(parameters, (PARAMETERS,))
    for lane in range(LANES):
        put(S, D, P, lane, 1.0)


def _rational(state, out, parameters):
    S, D, P = carray(state, (WIDTH,)), carray(out, (WIDTH,)), carray(parameters, (PARAMETERS,))
    for lane in range(LANES):
        r2, w = arguments(S, P, lane)
        put(S, D, P, lane, gain_rational(r2, w))


def _exponential(state, out, parameters):
    S, D, P = carray(state, (WIDTH,)), carray(out, (WIDTH,)), carray(parameters, (PARAMETERS,))
    for lane in range(LANES):
        r2, w = arguments(S, P, lane)
        put(S, D, P, lane, gain_exponential(r2, w))


def _tanh(state, out, parameters):
    S, D, P = carray(state, (WIDTH,)), carray(out, (WIDTH,)), carray(parameters, (PARAMETERS,))
    for lane in range(LANES):
        r2, w = arguments(S, P, lane)
        put(S, D, P, lane, gain_tanh(r2, w))


def _hill(state, out, parameters):
    S, D, P = carray(state, (WIDTH,)), carray(out, (WIDTH,)), carray(parameters, (PARAMETERS,))
    for lane in range(LANES):
        r2, w = arguments(S, P, lane)
        put(S, D, P, lane, gain_hill(r2, w, P[PSI]))


def _hill_integer(state, out, parameters):
    S, D, P = carray(state, (WIDTH,)), carray(out, (WIDTH,)), carray(parameters, (PARAMETERS,))
    n = int(P[PSI])
    for lane in range(LANES):
        r2, w = arguments(S, P, lane)
        put(S, D, P, lane, gain_hill_integer(r2, w, n))


def _custom(gain):
    """Make a field for a Psi whose gain is given."""

    def field(state, out, parameters):
        S, D, P = carray(state, (WIDTH,)), carray(out, (WIDTH,)), carray(parameters, (PARAMETERS,))
        for lane in range(LANES):
            r2, w = arguments(S, P, lane)
            put(S, D, P, lane, gain(r2, w))

    return field


_FAMILIES = {
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


_custom_fields = Kept(MOST_EXPRESSIONS)


def is_compiled(psi: Psi) -> bool:
    """Whether a custom Psi has its field already."""
    return source_of(psi) in _custom_fields


def field(psi: Psi) -> Any:
    """Return the compiled field for Psi, eq:LP and eq:polar_gen_odes_desing in one chart.

    Parameters
    ----------
    psi : Psi

    Returns
    -------
    CFunc
        Its `address` enters the integrator; keep the object alive while that address is in use. Built-in families
        come from the disk cache, custom text costs one compilation of a few lines (about 0.3 s), once a text.
    """
    if psi.family == "custom":
        source = source_of(psi)
        return _custom_fields.get(source, lambda: compiled(_custom(gain_custom(source)), cache=False))
    return _family(family_name(psi))
