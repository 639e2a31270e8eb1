"""The layer problem and the nonsmooth outside as one compiled field: e-linear systems, for any Psi.

``p' = U - p (p.U)`` and ``w' = -w (p.U)`` (w = ebar) or ``w' = +w (p.U)`` (w = rho), with U at ``e = gain p``. For
Psi = 1 the gain is 1 on the sphere, and leaving it out extends the field off the sphere smoothly.

Loops are free of branches and of library calls, so that they run in vector registers.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

from ...formulas.jit import call_at, carray, compile_address, inlined_fast_kernel
from ...systems.psi.function import Psi
from .field_parameters import GAIN, PSI
from .layout import LANES, PARAMETERS, ROW_WIDTH, SIDE_SIGN
from .psi_gain import GainVariants, arguments, gain, kind, variant, write_typed_gains


@inlined_fast_kernel
def write_lane(S, out, P, lane, gain, a, b, d, f1, f2):
    """Write one lane of the field, given its gain and coefficients."""
    x, y, w = S[lane], S[lane + LANES], S[lane + 2 * LANES]
    c, s = gain * x, gain * y
    u = a * c - b * s + f1
    v = b * c + d * s + f2
    q = x * u + y * v
    out[lane] = u - x * q
    out[lane + LANES] = v - y * q
    out[lane + 2 * LANES] = P[lane + SIDE_SIGN] * w * q


def _psi_field(state, out, parameters):
    S, D, P = carray(state, (ROW_WIDTH,)), carray(out, (ROW_WIDTH,)), carray(parameters, (PARAMETERS,))
    parameter = kind(P[PSI])
    for lane in range(LANES):
        r2, w = arguments(S, P, lane)
        write_lane(S, D, P, lane, gain(r2, w, parameter), P[0], P[1], P[2], P[3], P[4])


def _field_of_gain(state, out, parameters):
    call_at(int(carray(parameters, (PARAMETERS,))[GAIN]), state, out, parameters)
    S, D, P = carray(state, (ROW_WIDTH,)), carray(out, (ROW_WIDTH,)), carray(parameters, (PARAMETERS,))
    for lane in range(LANES):
        write_lane(S, D, P, lane, D[lane], P[0], P[1], P[2], P[3], P[4])


def _typed_psi_field(state, out, parameters):
    S, D, P = carray(state, (ROW_WIDTH,)), carray(out, (ROW_WIDTH,)), carray(parameters, (PARAMETERS,))
    write_typed_gains(state, out, parameters, P[PSI], LANES)
    for lane in range(LANES):
        write_lane(S, D, P, lane, D[lane], P[0], P[1], P[2], P[3], P[4])


_compiled = GainVariants(_psi_field, _typed_psi_field)


def is_compiled(psi: Psi) -> bool:
    """Whether `field` answers without compiling (a built-in family may still be loaded from the disk cache)."""
    return variant(psi, True) in _compiled


def field(psi: Psi) -> Any:
    """Return the compiled field for Psi, (3.26) and (2.12) in one chart.

    Its `address` enters the integrator; keep the object alive while that address is in use.
    """
    return _compiled.get(variant(psi, True))


@lru_cache(maxsize=1)
def field_of_gain() -> Any:
    """Return the same for a gain that is called at its address, in place GAIN of the parameters."""
    return compile_address(_field_of_gain)
