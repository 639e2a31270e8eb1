"""Kernels run as Python: the same text, where to compile it would take longer than to run it."""

from __future__ import annotations

import ctypes
import struct
from functools import cache
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..rebind import rebind

Array = NDArray[np.float64]
PACKAGE = __name__.partition(".")[0]
THREE_POINTERS = ctypes.CFUNCTYPE(ctypes.c_void_p, *[ctypes.c_void_p] * 3)


def is_at_hand(kernel: Any) -> bool:
    """Whether a kernel needs no compiler: it is compiled in this process, or kept on disk, or in a table."""
    kept = getattr(kernel, "_cache", None)
    return kept is None or bool(kernel.signatures) or bool(kept._cache_file._load_index())  # noqa: SLF001


def call_kernel(kernel: Any, *given: Any, compiles: bool = False) -> Any:
    """Call a kernel; as Python where it is not at hand, unless it may be compiled now."""
    with np.errstate(all="ignore"):  # as in machine code
        return (kernel if compiles or is_at_hand(kernel) else interpreted(kernel))(*given)


@cache
def interpreted(kernel: Any) -> Any:
    """Return a kernel, or a right-hand side, as a function of Python, and so all that it calls."""
    function = getattr(kernel, "py_func", kernel)
    names = function.__globals__.keys() & set(function.__code__.co_names)
    return rebind(function, **{name: _as_python(name, function.__globals__[name]) for name in names})


class InterpretedAddress:
    """A right-hand side as Python, called by its `address`."""

    def __init__(self, function: Any) -> None:
        self._entry = THREE_POINTERS(interpreted(function))
        self.address = ctypes.cast(self._entry, ctypes.c_void_p).value


def _as_python(name: str, value: Any) -> Any:
    if hasattr(value, "py_func"):
        return interpreted(value)
    if isinstance(value, ModuleType) and value.__name__.startswith(PACKAGE):
        return _PythonModule(value)
    return STAND_INS.get(name, value)


class _PythonModule:
    """A module of kernels, as Python."""

    def __init__(self, module: ModuleType) -> None:
        self._module = module

    def __getattr__(self, name: str) -> Any:
        return _as_python(name, getattr(self._module, name))


def _call_field(address: int, S: Array, source: int, target: int, P: Array) -> None:
    start = S.ctypes.data
    THREE_POINTERS(int(address))(start + 8 * source, start + 8 * target, P.ctypes.data)


def _carray(pointer: Any, shape: tuple[int, ...]) -> Array:
    return np.ctypeslib.as_array(ctypes.cast(pointer, ctypes.POINTER(ctypes.c_double)), shape)


def _double_of_bits(bits: int) -> float:
    return struct.unpack("<d", struct.pack("<q", bits))[0]


def _bits_of_double(value: float) -> int:
    return struct.unpack("<q", struct.pack("<d", value))[0]


#: Operations of kernels that are none of Python (`intrinsics`), by name.
STAND_INS = {
    "call_field": _call_field,
    "carray": _carray,
    "double_of_bits": _double_of_bits,
    "bits_of_double": _bits_of_double,
}
