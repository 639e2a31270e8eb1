"""Kernels that were compiled beforehand, by module and name: where there is no compiler, as in a browser.

The folder `compiled` holds ``kernels.so``, a WebAssembly module that shares NumPy's memory, and ``kernels.json``, which
says what each kernel takes and returns; ``codim2 kernels`` makes both of what Numba compiles here. A function of 64-bit
pointers is unknown there: arrays are passed by 64-bit numbers all the same, and NumPy's own integers, which have 32
bits, are widened on the way in.
"""

from __future__ import annotations

import ctypes
import json
import math
from collections.abc import Callable
from functools import cache
from pathlib import Path
from struct import Struct
from typing import Any

import numpy as np

from .interpreted import SCRATCH_SIZE as SCRATCH_SIZE

FOLDER = Path(__file__).parent / "compiled"
MOST_SLOTS = 512  # numbers of eight bytes that a call passes, and gets back

_slots = (ctypes.c_int64 * MOST_SLOTS)()
_place = ctypes.addressof(_slots)


class Table:
    """The kernels and right-hand sides that `codim2 kernels` has written."""

    def __init__(self, folder: Path) -> None:
        self.library = ctypes.CDLL(str(folder / "kernels.so"))
        written = json.loads((folder / "kernels.json").read_text())
        self.kernels: dict[tuple[str, str], list[tuple[Any, list[Any], list[Any]]]] = {}
        for one in written["kernels"]:
            function = getattr(self.library, one["call"])
            function.argtypes, function.restype = [ctypes.c_void_p], ctypes.c_int32
            self.kernels.setdefault((one["module"], one["name"]), []).append((function, one["takes"], one["returns"]))
        self.addresses = {tuple(one["key"]): getattr(self.library, one["address"])() for one in written["addresses"]}
        self.library.let_go.argtypes, self.library.let_go.restype = [ctypes.c_void_p], None


@cache
def table() -> Table:
    """Return the table, loaded when it is first requested."""
    return Table(FOLDER)


class TabledKernel:
    """A kernel: called from Python it runs what was compiled beforehand."""

    def __init__(self, function: Callable[..., Any]) -> None:
        self.py_func = function
        self.__name__, self.__doc__, self.__module__ = function.__name__, function.__doc__, function.__module__
        self._signatures: dict[tuple[Any, ...], _Signature] = {}  # by the types of arguments that have come

    def __call__(self, *given: Any) -> Any:
        """Run it; NotImplementedError where it was not compiled for arguments such as these."""
        types = tuple(
            [
                (one.dtype.char, one.ndim, one.flags.c_contiguous) if type(one) is np.ndarray else type(one)
                for one in given
            ]
        )
        signature = self._signatures.get(types)
        if signature is None:
            signature = self._signatures[types] = self._find_signature(given)
        return signature.call(given)

    def _find_signature(self, given: tuple[Any, ...]) -> _Signature:
        for function, takes, returns in table().kernels.get((self.__module__, self.__name__), []):
            if len(takes) == len(given) and all(map(_fits, takes, given)):
                return _Signature(function, takes, returns)
        kinds = ", ".join(
            f"{one.dtype}[{one.ndim}]" if isinstance(one, np.ndarray) else type(one).__name__ for one in given
        )
        raise NotImplementedError(f"{self.__module__}.{self.__name__}({kinds}) was not compiled; run `codim2 kernels`.")


def _fits(takes: list[Any], one: Any) -> bool:
    kind = takes[0]
    if isinstance(one, np.ndarray) or len(takes) > 1:
        if not isinstance(one, np.ndarray) or [one.ndim] != takes[1:]:
            return False
        same = one.dtype.name == kind or (kind == "int64" and one.dtype.kind == "i")
        return same and one.flags.c_contiguous
    if kind == "float64":
        return isinstance(one, (float, np.floating))
    if kind == "bool":
        return isinstance(one, (bool, np.bool_))
    return isinstance(one, (int, np.integer)) and not isinstance(one, bool)


class _Signature:
    """One signature of a kernel: how its arguments are written, and what it returns is read."""

    def __init__(self, function: Any, takes: list[list[Any]], returns: list[Any]) -> None:
        self.function, self.several = function, returns[0] == "tuple"
        # of an array its type and its number of dimensions, of a number the type of which it is made
        self.takes = [np.dtype(kind[0]) if len(kind) > 1 else None if kind[0] == "float64" else int for kind in takes]
        self.returns = [(np.dtype(kind[0]), kind[1]) if len(kind) > 1 else kind[0] for kind in returns[1]]
        self.given = Struct("<" + "".join(_format_of(kind, 1, 2) for kind in takes))
        self.found = Struct("<" + "".join(_format_of(kind, 2, 1) for kind in returns[1]))

    def call(self, given: tuple[Any, ...]) -> Any:
        """Write the arguments, call, and read what is returned."""
        numbers, back = [], []
        for kind, one in zip(self.takes, given, strict=True):
            if kind is None:
                numbers.append(one)
            elif kind is int:
                numbers.append(int(one))
            else:
                array = one
                if array.dtype != kind:
                    array = one.astype(kind)
                    back.append((one, array))
                numbers += (array.__array_interface__["data"][0] if array.size else 8, *array.shape, *array.strides)
        self.given.pack_into(_slots, 0, *numbers)
        status = self.function(_place)
        if status:
            raise RuntimeError(f"a kernel has ended with {status}")
        for one, array in back:
            if one.flags.writeable:
                one[...] = array
        values, found, k = self.found.unpack_from(_slots), [], 0
        for kind in self.returns:
            if type(kind) is tuple:
                dtype, dimensions = kind
                shape = values[k + 2 : k + 2 + dimensions]
                found.append(_read_array(values[k], values[k + 1], dtype, shape))
                k += 2 + dimensions
            else:
                found.append(bool(values[k]) if kind == "bool" else values[k])
                k += 1
        return tuple(found) if self.several else found[0] if found else None


def _format_of(kind: list[Any], first: int, each: int) -> str:
    """Return the format of a number, or of an array: so many numbers, and so many for each dimension."""
    return f"{first + each * kind[1]}q" if len(kind) > 1 else "d" if kind[0] == "float64" else "q"


def _read_array(owner: int, data: int, dtype: np.dtype[Any], shape: tuple[int, ...]) -> Any:
    """Copy an array that a kernel has made, and let it go."""
    content = bytearray(ctypes.string_at(data, dtype.itemsize * math.prod(shape)))
    table().library.let_go(owner)
    array = np.frombuffer(content, dtype).reshape(shape)
    return array.astype(np.intp) if dtype == np.int64 else array


kernel = held_kernel = fast_kernel = inlined_kernel = inlined_fast_kernel = contracted_kernel = TabledKernel
spliced_kernel = TabledKernel


class Address:
    """A right-hand side, by its place in the table of functions."""

    def __init__(self, address: int) -> None:
        self.address = address


def compile_address(function: Callable[..., None], cache: bool = True) -> Address:  # noqa: ARG001 (Numba's other half)
    """Return what was compiled of a right-hand side of this package."""
    return _find_address(function.__module__, function.__name__)


def compile_with_gain(lanes: Callable[..., None], own: Any, whole: bool, cache: bool, **names: Any) -> Address:  # noqa: ARG001
    """Return what was compiled of a function of lanes with the gain of a family."""
    return _find_address(lanes.__module__, lanes.__name__, own.__module__, own.__name__, "int" if whole else "float")


def _find_address(*key: str) -> Address:
    if key not in table().addresses:
        raise NotImplementedError(f"{' of '.join(key)} was not compiled; run `codim2 kernels`.")
    return Address(table().addresses[key])


def _elsewhere(*_: Any) -> Any:
    raise NotImplementedError("only what is compiled does that")


ahead = bits_of_double = call_at = call_field = carray = double_of_bits = pointer_to = scratch = _elsewhere
