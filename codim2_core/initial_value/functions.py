"""The functions of a field that kernels call by their addresses: called back in Python at first, and then compiled.

An evaluation costs two microseconds where it is called back, and a hundredth of that compiled; to compile the formulas
of a system takes as long as some ten thousand evaluations.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from ..expressions.functions import kernels
from ..expressions.names import FAST_NAMES, SLOW_NAMES
from ..expressions.source import program
from ..jit import carray, compile_source
from ..jit.callbacks import Callback
from ..psi.constructors import constant
from ..psi.function import Psi
from ..stepping.compiling import CompiledCache
from ..stepping.psi_gain import has_one_gain, one_gain, variant
from .field import Field

MOST_SYSTEMS = 64
#: Evaluations in Python that take as long as compiling the formulas; in a browser that takes some milliseconds.
CALLS_WORTH_COMPILING = 0 if sys.platform == "emscripten" else 50_000


class FieldFunctions:
    """The functions of a field and a Psi: objects with addresses, which must outlive the use of these.

    Attributes
    ----------
    functions : tuple
        Of the value, the slopes and the gain.
    addresses : ndarray of int64 (3,)
    parameter : float
        Of Psi, as the gain reads it.
    is_compiled : bool
        No formula is called back.
    """

    def __init__(self, functions: tuple[Any, Any, Any], parameter: float) -> None:
        self.functions, self.parameter = functions, parameter
        self.addresses = np.array([function.address for function in functions], np.int64)
        self._callbacks = [function for function in functions if isinstance(function, Callback)]
        self.is_compiled = not self._callbacks
        self.calls = 0

    def count(self, calls: int) -> None:
        """Count evaluations; raise what Python has raised in one of them."""
        self.calls += calls
        for callback in self._callbacks:
            callback.check()


_whole, _called = CompiledCache(MOST_SYSTEMS), CompiledCache(MOST_SYSTEMS)
_fields = CompiledCache(MOST_SYSTEMS)


def functions_of(field: Field, psi: Psi, many: bool = False) -> FieldFunctions:
    """Return the functions of a field and a Psi: compiled once they have been called often, or where that is due.

    Parameters
    ----------
    field : Field
    psi : Psi
    many : bool
    """
    key = field.rows, psi
    called = _called.get(key, lambda: called_back(field.m, field.value, field.slope, psi))
    if not (many or field.rows in _fields or called.calls >= CALLS_WORTH_COMPILING):
        return called

    def compile_all() -> FieldFunctions:
        return FieldFunctions((*_fields.get(field.rows, lambda: _compile_field(field)), one_gain(psi)), psi.parameter)

    return _whole.get(key, compile_all)


def called_back(
    m: int, value: Callable[..., Iterable[float]], slopes: Callable[..., Iterable[float]], psi: Psi | None = None
) -> FieldFunctions:
    """Return functions that Python evaluates: `value` and `slopes` as of a `Field` with m slow variables."""
    own, count = constant() if psi is None else psi, 4 + m
    known = has_one_gain(own)
    gain = one_gain(own) if known else Callback(variant(own, False).in_python(own.parameter), 2, 1)
    functions = Callback(value, count, 2 + m), Callback(slopes, count, (2 + m) * count), gain
    return FieldFunctions(functions, own.parameter)


def _compile_field(field: Field) -> tuple[Any, Any]:
    names = (*FAST_NAMES, *SLOW_NAMES[: field.m])
    slopes = [row.derivative(name) for row in field.rows for name in names]
    return tuple(_compile_rows(rows, names) for rows in (field.rows, slopes))  # pyright: ignore[reportReturnType]


def _compile_rows(rows: Any, names: tuple[str, ...]) -> Any:
    written = program(rows, {name: name for name in names}, names)
    lines = [
        f"A, D = carray(state, ({len(names)},)), carray(out, ({len(rows)},))",
        *(f"{name} = A[{k}]" for k, name in enumerate(names)),
        *written.before,
        *written.inside,
        *(f"D[{k}] = {result}" for k, result in enumerate(written.results)),
    ]
    source = "def right_hand_side(state, out, parameters):\n" + "\n".join(f"    {line}" for line in lines)
    # Written by `program`: its own names, numbers and math.* only.
    return compile_source(source, {"carray": carray, **kernels.called}, strict=True)
