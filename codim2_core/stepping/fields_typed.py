"""The field of `fields` for a system of any form: one small compilation for its formulas, whatever Psi.

Slow variables and parameters are arguments, and the gain of Psi is called by its address, so that neither a slider
nor another Psi compiles anything. Subformulas that only they enter are computed once for all lanes.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ..expressions.functions import kernels
from ..expressions.names import FAST_NAMES
from ..expressions.source import program
from ..jit import call_at, carray, compile_source
from ..systems.typed import System
from .compiling import CompiledCache
from .field_parameters import FACTOR, GAIN, OWN_NUMBERS
from .layout import LANES, PARAMETERS, ROW_WIDTH, SIDE_SIGN

MOST_SYSTEMS = 64  # compiled systems kept
_fields = CompiledCache(MOST_SYSTEMS)


@dataclass(frozen=True)
class GeneralField:
    """A compiled field, and whether U is smooth beyond |e| = 1 too."""

    function: Any
    smooth: bool


def _source(system: System) -> tuple[str, bool]:
    """Python source of the field, and whether U is smooth beyond |e| = 1."""
    numbers = {name: f"n{i}" for i, name in enumerate(system.numbers)}
    written = program(system.U, {**{name: name for name in FAST_NAMES}, **numbers}, FAST_NAMES)
    far = system.reads_position
    # x = rho p outside, 0 on the hemisphere.
    position = ["rho = w*(0.5 + 0.5*P[lane + SIGN])", "x, y = rho*px, rho*py"] if far else []
    u, v = written.results
    before = [
        "S, D, P = carray(state, (WIDTH,)), carray(out, (WIDTH,)), carray(parameters, (PARAMETERS,))",
        "call_at(int(P[GAIN]), state, out, parameters)",
        "factor = P[FACTOR]",
        *(f"{name} = P[OWN + {i}]" for i, name in enumerate(numbers.values())),
        *written.before,
    ]
    inside = [
        "px, py, w = S[lane], S[lane + LANES], S[lane + 2*LANES]",
        "c, s = D[lane]*px, D[lane]*py",
        *position,
        *written.inside,
        f"u, v = factor*{u}, factor*{v}",
        "q = px*u + py*v",
        "D[lane] = u - px*q",
        "D[lane + LANES] = v - py*q",
        "D[lane + 2*LANES] = P[lane + SIGN]*w*q",
    ]
    lines = [
        "def right_hand_side(state, out, parameters):",
        *(f"    {line}" for line in before),
        "    for lane in range(LANES):",
    ]
    return "\n".join([*lines, *(f"        {line}" for line in inside)]) + "\n", written.entire


def _make_field(system: System) -> GeneralField:
    source, smooth = _source(system)
    names = {
        **kernels.called,
        "carray": carray,
        "call_at": call_at,
        "LANES": LANES,
        "PARAMETERS": PARAMETERS,
        "SIGN": SIDE_SIGN,
        "WIDTH": ROW_WIDTH,
        "FACTOR": FACTOR,
        "GAIN": GAIN,
        "OWN": OWN_NUMBERS,
    }
    return GeneralField(compile_source(source, names), smooth)  # written by `program` from whitelisted formulas


def is_compiled(system: System) -> bool:
    """Whether a system has its field already."""
    return system.U in _fields


def general_field(system: System) -> GeneralField:
    """Return the compiled field of a system, eq:vf: on the hemisphere U(e_Psi, 0, 0, z), outside U(p, rho p, z).

    Parameters
    ----------
    system : System

    Returns
    -------
    GeneralField
        The `address` of its `function` enters the integrator. Compiled once for the formulas of U and the names of
        its parameters (below a second for formulas of usual length), whatever their values and Psi.
    """
    return _fields.get(system.U, lambda: _make_field(system))
