"""The field of `fields` for a system of any form: compiled once, it interprets the formulas of U (`packed`).

Slow variables and parameters are numbers of the packed formulas, and the gain of Psi is called by its address.
"""

from __future__ import annotations

from collections.abc import Hashable
from functools import lru_cache
from typing import Any

from ...formulas import arrays
from ...formulas.jit import SCRATCH_SIZE, ahead, call_at, carray, compile_address, scratch
from ...formulas.names import FAST_NAMES
from ...formulas.packed import ROWS, at_address, pack, result, row, run_packed
from ...results.arrays import Array
from .field_parameters import FACTOR, FORMULAS, GAIN
from .layout import LANES, PARAMETERS, ROW_WIDTH, SIDE_SIGN


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
    """Return the formulas of `Frozen.key` packed, and whether U is smooth beyond |e| = 1 too.

    The address of the array enters the parameters; it must outlive that.
    """
    program = arrays.program(key)
    return pack(program, len(FAST_NAMES)), program.is_entire
