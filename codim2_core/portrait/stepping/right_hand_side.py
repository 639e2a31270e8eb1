"""A system and Psi as the compiled stepping reads them: the address of the field and its numbers.

The layer problem and the nonsmooth outside as one compiled field: e-linear systems, for any Psi.

``p' = U - p (p.U)`` and ``w' = -w (p.U)`` (w = ebar) or ``w' = +w (p.U)`` (w = rho), with U at ``e = gain p``. For
Psi = 1 the gain is 1 on the sphere, and leaving it out extends the field off the sphere smoothly.

Loops are free of branches and of library calls, so that they run in vector registers.
"""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

from ...formulas import arrays
from ...formulas.jit import SCRATCH_SIZE, ahead, call_at, carray, compile_address, inlined_fast_kernel, scratch
from ...formulas.names import FAST_NAMES
from ...formulas.packed import ROWS, at_address, pack, result, row, run_packed
from ...results.arrays import Array
from ...systems.frozen import FrozenSystem
from ...systems.psi.function import Psi
from .layout import FACTOR, FORMULAS, GAIN, LANES, PARAMETERS, PSI, ROW_WIDTH, SIDE_SIGN, field_numbers
from .psi_gain import (
    GainVariants,
    arguments,
    gain,
    gain_parameter,
    gains,
    kind,
    variant,
    write_typed_gains,
)


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


def _typed_psi_field(state, out, parameters):
    S, D, P = carray(state, (ROW_WIDTH,)), carray(out, (ROW_WIDTH,)), carray(parameters, (PARAMETERS,))
    write_typed_gains(state, out, parameters, P[PSI])
    for lane in range(LANES):
        write_lane(S, D, P, lane, D[lane], P[0], P[1], P[2], P[3], P[4])


_compiled = GainVariants(_psi_field, _typed_psi_field)


def is_compiled(psi: Psi) -> bool:
    """Whether `field` answers without compiling (a built-in family may still be loaded from the disk cache)."""
    return variant(psi, True) in _compiled


def field_of_psi(psi: Psi) -> Any:
    """Return the compiled field for Psi, (3.26) and (2.12) in one chart; keep it while its `address` is in use."""
    return _compiled.get(variant(psi, True))


def _interpreted_field(state, out, parameters):
    P = carray(parameters, (PARAMETERS,))
    call_at(int(P[GAIN]), state, out, parameters)
    T, R, factor = at_address(int(P[FORMULAS])), scratch(), P[FACTOR]
    width = min(LANES, SCRATCH_SIZE // int(T[ROWS]))
    for block in range((LANES + width - 1) // width):
        first = block * width
        count = min(width, LANES - first)
        S, D = carray(ahead(state, first), (ROW_WIDTH,)), carray(ahead(out, first), (ROW_WIDTH,))
        sides = carray(ahead(parameters, SIDE_SIGN + first), (count,))
        c, s, x, y = row(R, 0, width, count), row(R, 1, width, count), row(R, 2, width, count), row(R, 3, width, count)
        for j in range(count):
            px, py, gain = S[j], S[j + LANES], D[j]
            rho = S[j + 2 * LANES] * (0.5 + 0.5 * sides[j])  # 0 on the hemisphere
            c[j], s[j], x[j], y[j] = gain * px, gain * py, rho * px, rho * py
        run_packed(T, R, width, count)
        u, v = result(T, R, 0, width, count), result(T, R, 1, width, count)
        for j in range(count):
            px, py, w, du, dv = S[j], S[j + LANES], S[j + 2 * LANES], factor * u[j], factor * v[j]
            q = px * du + py * dv
            D[j], D[j + LANES], D[j + 2 * LANES] = du - px * q, dv - py * q, sides[j] * w * q


@lru_cache(maxsize=1)
def general_field() -> Any:
    """Return the field of general systems, (2.7): on the hemisphere U(e_Psi, 0, 0, z), outside U(p, rho p, z)."""
    return compile_address(_interpreted_field)


@lru_cache(maxsize=64)
def packed_formulas(key: Hashable) -> tuple[Array, bool]:
    """Return the formulas of `Frozen.key` packed, to be kept while in use, and whether U is smooth beyond |e| = 1."""
    program = arrays.program(key)
    return pack(program, len(FAST_NAMES)), program.is_entire


@dataclass(frozen=True)
class CompiledProblem:
    """A right-hand side, scaled so that |U| is about 1."""

    address: int  # of the field
    shared: Array  # (SHARED_SIZE,) Its parameters
    functions: tuple[Any, ...]  # what is behind the addresses: it must outlive their use
    factors: slice  # the parameters to which the right-hand side is proportional

    @property
    def reversed(self) -> CompiledProblem:
        """The same right-hand side against time."""
        shared = self.shared.copy()
        shared[self.factors] *= -1.0
        return replace(self, shared=shared)


def problem(at: FrozenSystem, psi: Psi, backward: bool = False) -> CompiledProblem:
    """Prepare a right-hand side."""
    parameter = gain_parameter(psi)
    if at.as_given is not None:
        field = field_of_psi(psi)
        return CompiledProblem(field.address, field_numbers(at, parameter, backward), (field, psi), slice(0, 5))
    formulas, smooth = packed_formulas(at.key)
    field, gain = general_field(), gains(psi, smooth)
    shared = field_numbers(at, parameter, backward, gain.address, formulas.ctypes.data)
    return CompiledProblem(field.address, shared, (field, gain, formulas, psi), slice(FACTOR, FACTOR + 1))
