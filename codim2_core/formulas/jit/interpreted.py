"""Kernels run as Python: the same text, where to compile it would take longer than to run it.

Digits differ in the last places: nothing is fused, and no sum reordered.
"""

from __future__ import annotations

import ctypes
import math
import struct
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from types import BuiltinFunctionType, FunctionType, ModuleType
from typing import Any
from weakref import WeakKeyDictionary, WeakValueDictionary

import numpy as np
from numpy.typing import NDArray

from ...results.rebind import rebind

Array = NDArray[np.float64]
PACKAGES = ("codim2_core", "codim2_app")
THREE_POINTERS = ctypes.CFUNCTYPE(ctypes.c_void_p, *[ctypes.c_void_p] * 3)
SCRATCH_SIZE = 4096  # numbers that a function may keep on its stack
MOST_AT_ADDRESS = 10**7  # numbers that a pointer may lead to
LONG_LOOP = 500  # turns of a loop beyond which it asks for the time in each
NUMPY_NAMES = {"pow": "power", "atan2": "arctan2", "atan": "arctan", "asin": "arcsin", "acos": "arccos"}

#: Right-hand sides that are not compiled, by their addresses.
waiting: WeakValueDictionary[int, Any] = WeakValueDictionary()
_made: WeakKeyDictionary[Any, FunctionType] = WeakKeyDictionary()


class _Clock(threading.local):
    """The time at which the kernel that this thread runs as Python is looked at."""

    due = math.inf

    def look(self) -> float:
        """Say that nothing is due where no kernel runs."""
        return math.inf


clock = _Clock()


def check_clock() -> None:
    """Have the kernel that runs looked at when that is due: asked in its loops, and where it calls others."""
    if time.perf_counter() > clock.due:
        clock.due = clock.look()


def run(kernel: Any, given: Iterable[Any], due: float, look: Callable[[], float]) -> Any:
    """Call a kernel as Python."""
    before = clock.due, clock.look
    clock.due, clock.look = due, look
    try:
        with np.errstate(all="ignore"):  # as in machine code
            return _plain(interpreted(kernel)(*given))
    finally:
        clock.due, clock.look = before


def _plain(value: Any) -> Any:
    if isinstance(value, tuple):
        make = getattr(value, "_make", tuple)  # a named one stays so
        return make(map(_plain, value))
    return value.item() if isinstance(value, np.generic) else value


def interpreted(kernel: Any) -> FunctionType:
    """Return a kernel as a function of Python, and so all that it calls; made once."""
    found = _made.get(kernel)
    if found is None:
        found = _made[kernel] = interpret(kernel.py_func)
    return found


def interpret(function: Any) -> FunctionType:
    """Return a function of kernels in which all of these are Python."""
    code, own = function.__code__, function.__globals__
    names = {name: _as_python(name, own[name]) for name in own.keys() & set(code.co_names)}
    return rebind(function, **({"range": _range} if "range" in code.co_names else {}), **names)


def called_functions(function: Any) -> set[Any]:
    """Return the functions that a function of kernels is compiled with, itself too."""
    found: set[Any] = set()
    left = [function]
    while left:
        one = left.pop()
        if one not in found:
            found.add(one)
            names, own = one.__code__.co_names, one.__globals__
            values = [own[name] for name in names if name in own]
            for module in [value for value in values if _is_ours(value)]:
                values += [getattr(module, name) for name in names if hasattr(module, name)]
            left += [value.py_func for value in values if hasattr(value, "py_func")]
    return found


def _is_ours(value: Any) -> bool:
    return isinstance(value, ModuleType) and value.__name__.startswith(PACKAGES)


def _as_python(name: str, value: Any) -> Any:
    if hasattr(value, "py_func"):
        return _ask_before(interpreted(value))
    if value is math or _is_ours(value):
        return _PythonModule(value)
    if isinstance(value, BuiltinFunctionType) and value.__module__ == "math":
        return _total(value)
    return STAND_INS.get(name, value)


def _ask_before(function: FunctionType) -> Callable[..., Any]:
    """Return a function that asks for the time; one with loops does so by itself."""
    if "range" in function.__code__.co_names:
        return function

    def ask(*given: Any) -> Any:
        if time.perf_counter() > clock.due:
            clock.due = clock.look()
        return function(*given)

    return ask


def _range(*given: Any) -> Iterable[int]:
    check_clock()
    numbers = range(*given)
    return numbers if len(numbers) < LONG_LOOP else _long_range(numbers)


def _long_range(numbers: range) -> Iterator[int]:
    for i in numbers:
        check_clock()
        yield i


class _PythonModule:
    """A module of kernels, or `math`, as Python."""

    def __init__(self, module: ModuleType) -> None:
        self._module = module

    def __getattr__(self, name: str) -> Any:
        value = _as_python(name, getattr(self._module, name))
        setattr(self, name, value)
        return value


def _total(function: Any) -> Callable[..., float]:
    """Return a function of `math` that is NaN or infinite where that of Python raises."""
    name: str = function.__name__
    elsewhere = getattr(np, NUMPY_NAMES.get(name, name), None)
    if elsewhere is None:
        return function

    def value(*given: float) -> float:
        try:
            return function(*given)
        except (ValueError, OverflowError):
            return float(elsewhere(*given))

    return value


def _call_field(address: int, S: Array, source: int, target: int, P: Array) -> None:
    _call_at(address, S[source:], S[target:], P)


def _call_at(address: int, state: Array, out: Array, parameters: Array) -> None:
    check_clock()
    function = waiting.get(int(address))
    if function is None:
        THREE_POINTERS(int(address))(state.ctypes.data, out.ctypes.data, parameters.ctypes.data)
    else:
        function.python(state, out, parameters)


#: Operations of kernels that are none of Python (`intrinsics`), by name.
STAND_INS: dict[str, Callable[..., Any]] = {
    "call_field": _call_field,
    "call_at": _call_at,
    "carray": lambda pointer, shape: pointer[: shape[0]],
    "ahead": lambda pointer, places: pointer[places:],
    "pointer_to": lambda at: np.ctypeslib.as_array((ctypes.c_double * MOST_AT_ADDRESS).from_address(int(at))),
    "scratch": lambda: np.empty(SCRATCH_SIZE),
    "double_of_bits": lambda bits: struct.unpack("<d", struct.pack("<q", bits))[0],
    "bits_of_double": lambda value: struct.unpack("<q", struct.pack("<d", value))[0],
}
