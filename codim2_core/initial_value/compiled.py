"""The regularised motion compiled: for motions that are long, and for systems that are asked for again.

A step costs 0.3 ms as Python calls NumPy, and some microseconds compiled; compiling the formulas of a system takes
about a second. So a motion is followed in Python until it has cost about that much, and from then on, and whenever
the same system comes again, compiled: the same method to the same coefficients.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from numba import (
    carray,  # pyright: ignore[reportPrivateImportUsage] (documented as numba.carray)
    cfunc,
)
from numpy.typing import NDArray

from ..expressions.names import PLANE, SLOW
from ..expressions.source import program
from ..numerics.dense import Steps
from ..numerics.growth import BlowUpError, too_short
from ..numerics.radau import STAGES, Problem, TooManyStepsError, tableau
from ..psi.function import Psi
from ..stepping.compiling import Kept
from ..stepping.gains import one_gain
from ..stepping.layout import FIELD, PARAMETERS
from ..stepping.numbers import PSI
from ..words import say
from .compiled_radau import BLOWN_UP, FULL, LIMIT, SHORT, follow
from .compiled_rate import Motion
from .field import Field
from .line import Line

Array = NDArray[np.float64]

MOST_SYSTEMS = 64
CHUNK = 256  # steps that one call fills in
_fields = Kept(MOST_SYSTEMS)


def is_compiled(field: Field) -> bool:
    """Whether the formulas of a field are compiled already."""
    return field.rows in _fields


def _made(field: Field) -> tuple[Any, Any]:
    names = (*PLANE, *SLOW[: field.m])
    slopes = [row.derivative(name) for row in field.rows for name in names]
    return tuple(_function(rows, names) for rows in (field.rows, slopes))  # pyright: ignore[reportReturnType]


def _function(rows: Any, names: tuple[str, ...]) -> Any:
    written = program(rows, {name: name for name in names}, names)
    lines = [
        f"A, D = carray(state, ({len(names)},)), carray(out, ({len(rows)},))",
        *(f"{name} = A[{k}]" for k, name in enumerate(names)),
        *written.before,
        *written.inside,
        *(f"D[{k}] = {result}" for k, result in enumerate(written.results)),
    ]
    scope: dict[str, Any] = {"math": math, "carray": carray}
    exec("def function(state, out, parameters):\n" + "\n".join(f"    {line}" for line in lines), scope)
    # Written by `program`: its own names, numbers and math.* only. Strict arithmetic: a formula ends where it ends.
    return cfunc(FIELD, nogil=True, error_model="numpy")(scope["function"])


class Compiled:
    """One motion under way, compiled.

    Parameters
    ----------
    problem : Problem
        The same in Python.
    field : Field
    psi : Psi
    eps : float
    line : Line or None
        The invariant line it stays in.
    t_start, t_end, first, rtol, h, most
        As in `numerics.radau.steps`.
    floor : float
        atol/rtol.
    """

    def __init__(
        self,
        problem: Problem,
        field: Field,
        psi: Psi,
        eps: float,
        line: Line | None,
        t_start: float,
        t_end: float,
        first: Array,
        rtol: float,
        floor: float,
        h: float,
        most: int,
    ) -> None:
        self.problem = problem
        functions = _fields.get(field.rows, lambda: _made(field))
        self.functions = (*functions, one_gain(psi))  # they must outlive their use
        addresses = np.array([function.address for function in self.functions], np.int64)
        parameters = np.zeros(PARAMETERS)
        parameters[PSI] = psi.parameter
        along = np.zeros(3) if line is None else np.array([*line.n, 1.0])
        self.motion = Motion(addresses, parameters, len(first), eps, rtol, floor, along)
        self.y, self.clock = np.array(first), np.array([t_start, 0.0, t_end, 0.0])
        self.control = np.array([h, 1.0, 0.0, float(most), 0.0, max(1.0, float(np.abs(first).max()))])

    @property
    def evaluations(self) -> int:
        """Evaluations of the field so far."""
        return int(self.clock[3])

    def chunks(self) -> Iterator[Steps]:
        """Step to the end.

        Raises
        ------
        BlowUpError, StepsTooShortError, TooManyStepsError
            As `bounded` does of `steps`.
        """
        table, n = tableau(), len(self.y)
        code = FULL
        while code == FULL:
            starts, lengths = np.empty(CHUNK), np.empty(CHUNK)
            ends, polynomials = np.empty((CHUNK, n)), np.empty((CHUNK, n, STAGES))
            begin = self.y.copy()
            code, filled = follow(
                self.motion, table, self.y, self.clock, self.control, starts, lengths, ends, polynomials
            )
            yield Steps(begin, starts[:filled], lengths[:filled], ends[:filled], polynomials[:filled])
        t = float(self.clock[0])
        if code == LIMIT:
            raise TooManyStepsError
        if code == BLOWN_UP:
            raise BlowUpError(say("blow-up time", t=t))
        if code == SHORT:
            raise too_short(self.problem, t, self.y)
