"""The functions of a field that kernels call by their addresses: they interpret its formulas (`expressions.packed`).

The workspace of a motion holds the addresses of the packed formulas, of (U, W) and of their derivatives.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import lru_cache
from typing import Any

import numpy as np

from ...formulas.arrays import path_program
from ...formulas.jit import SCRATCH_SIZE, carray, compile_address, inlined_fast_kernel, scratch
from ...formulas.jit.callbacks import Callback
from ...formulas.names import FAST_NAMES, SLOW_NAMES
from ...formulas.packed import BOUND, RESULTS, SIZE, at_address, pack, run_packed
from ...portrait.stepping.layout import PSI
from ...portrait.stepping.psi_gain import gain_parameter, one_gain
from ...results.arrays import Array
from ...systems.psi.constructors import constant
from ...systems.psi.function import Psi
from .field import Field
from .kernels.rate import SLOPE_FORMULAS, VALUE_FORMULAS


class FieldFunctions:
    """The functions of a field and a Psi: what has the addresses must outlive their use."""

    def __init__(self, value: Any, slopes: Any, psi: Psi, formulas: tuple[Array, ...] = ()) -> None:
        self.functions, self.psi, self.formulas = (value, slopes, one_gain(psi)), psi, formulas
        self.addresses = np.array([function.address for function in self.functions], np.int64)

    def enter(self, S: Array) -> None:
        """Write into a workspace what the functions read there."""
        S[PSI] = gain_parameter(self.psi)
        S[[VALUE_FORMULAS, SLOPE_FORMULAS][: len(self.formulas)]] = [one.ctypes.data for one in self.formulas]

    def check(self) -> None:
        """Raise what Python has raised where it was called back."""
        for function in self.functions:
            if isinstance(function, Callback):
                function.check()


def functions_of(field: Field, psi: Psi) -> FieldFunctions:
    """Return the functions of a field and a Psi."""
    names = (*FAST_NAMES, *SLOW_NAMES[: field.m])
    slopes = tuple(row.derivative(name) for row in field.rows for name in names)
    formulas = tuple(_pack_formulas(rows, len(names)) for rows in (field.rows, slopes))
    return FieldFunctions(*_interpreters(), psi, formulas)


@lru_cache(maxsize=64)
def _pack_formulas(rows: Any, inputs: int) -> Array:
    return pack(path_program(rows), inputs, bound=inputs)


def called_back(
    m: int, value: Callable[..., Iterable[float]], slopes: Callable[..., Iterable[float]]
) -> FieldFunctions:
    """Return functions that Python evaluates: `value` and `slopes` as of a `Field` with m slow variables."""
    count = 4 + m
    return FieldFunctions(Callback(value, count, 2 + m), Callback(slopes, count, (2 + m) * count), constant())


@inlined_fast_kernel
def _interpret(state, out, T):
    """Write the formulas at one state."""
    inputs, results = int(T[BOUND]), int(T[RESULTS])
    count = int(T[SIZE]) - results
    A, D, R = carray(state, (inputs,)), carray(out, (count,)), scratch()
    rows = carray(R, (SCRATCH_SIZE,))
    for i in range(inputs):
        rows[i] = A[i]
    run_packed(T, R, 1, 1)
    for i in range(count):
        D[i] = rows[int(T[results + i])]


def _interpreted_values(state, out, parameters):
    _interpret(state, out, at_address(int(carray(parameters, (VALUE_FORMULAS + 1,))[VALUE_FORMULAS])))


def _interpreted_slopes(state, out, parameters):
    _interpret(state, out, at_address(int(carray(parameters, (SLOPE_FORMULAS + 1,))[SLOPE_FORMULAS])))


@lru_cache(maxsize=1)
def _interpreters() -> tuple[Any, Any]:
    return compile_address(_interpreted_values), compile_address(_interpreted_slopes)
