"""Kernels that were compiled beforehand, by module and name: where there is no compiler, as in a browser.

The folder `compiled` holds ``kernels.so``, a WebAssembly module that shares NumPy's memory, and ``kernels.json``, which
says what each kernel takes and returns; ``codim2 kernels`` makes both of what Numba compiles here. A function of 64-bit
pointers is unknown there: arrays are passed by 64-bit numbers all the same, and NumPy's own integers, which have 32
bits, are widened on the way in.
"""

from __future__ import annotations

import ctypes
import json
import struct
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import Any

import numpy as np

from .formulas import module_of_lanes, module_of_text

FOLDER = Path(__file__).parent / "compiled"
MOST_SLOTS = 512  # numbers of eight bytes that a call passes, and gets back

_slots = (ctypes.c_int64 * MOST_SLOTS)()
_place = ctypes.addressof(_slots)


class Table:
    """The kernels and right-hand sides that `codim2 kernels` has written.

    Attributes
    ----------
    library : ctypes.CDLL
    kernels : dict
        The signatures of a kernel by module and name: the function that calls it, what it takes, what it returns.
    addresses : dict
        Right-hand sides by what they were compiled from.
    """

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
    """Return the table, loaded when it is first asked for."""
    return Table(FOLDER)


class TabledKernel:
    """A kernel: called from Python it runs what was compiled beforehand.

    Attributes
    ----------
    py_func : function
        The same in Python.
    """

    def __init__(self, function: Callable[..., Any]) -> None:
        self.py_func = function
        self.__name__, self.__doc__, self.__module__ = function.__name__, function.__doc__, function.__module__
        self._signatures: list[tuple[Any, list[Any], list[Any]]] | None = None

    def __call__(self, *given: Any) -> Any:
        """Run it.

        Raises
        ------
        NotImplementedError
            It was not compiled for arguments such as these.
        """
        if self._signatures is None:
            self._signatures = table().kernels.get((self.__module__, self.__name__), [])
        for function, takes, returns in self._signatures:
            if len(takes) == len(given) and all(map(_fits, takes, given)):
                return _call(function, takes, returns, given)
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


def _call(function: Any, takes: list[Any], returns: list[Any], given: tuple[Any, ...]) -> Any:
    """Write the arguments, call, and read what is returned."""
    code, numbers, back, held = ["<"], [], [], []
    for kind, one in zip(takes, given, strict=True):
        if len(kind) > 1:  # an array
            array = one
            if array.dtype.name != kind[0]:
                array = one.astype(kind[0])
                held.append(array)
                if one.flags.writeable:
                    back.append((one, array))
            code.append(f"{1 + 2 * array.ndim}q")
            numbers += [array.__array_interface__["data"][0] if array.size else 8, *array.shape, *array.strides]
        elif kind[0] == "float64":
            code.append("d")
            numbers.append(one)
        else:
            code.append("q")
            numbers.append(int(one))
    struct.pack_into("".join(code), _slots, 0, *numbers)
    status = function(_place)
    if status:
        raise RuntimeError(f"a kernel has ended with {status}")
    for one, array in back:
        one[...] = array
    found, k = [], 0
    for kind in returns[1]:
        if len(kind) > 1:
            found.append(_read_array(kind, k))
            k += 2 + kind[1]
        elif kind[0] == "float64":
            found.append(struct.unpack_from("<d", _slots, 8 * k)[0])
            k += 1
        else:
            found.append(bool(_slots[k]) if kind[0] == "bool" else _slots[k])
            k += 1
    return tuple(found) if returns[0] == "tuple" else found[0] if found else None


def _read_array(kind: list[Any], k: int) -> Any:
    """Copy an array that a kernel has made, and let it go."""
    owner, data, dtype = _slots[k], _slots[k + 1], np.dtype(kind[0])
    shape = tuple(_slots[k + 2 : k + 2 + kind[1]])
    size = dtype.itemsize
    for n in shape:
        size *= n
    array = np.frombuffer(bytearray(ctypes.string_at(data, size)), dtype).reshape(shape)
    table().library.let_go(owner)
    return array.astype(np.intp) if kind[0] == "int64" else array


kernel = held_kernel = fast_kernel = inlined_kernel = inlined_fast_kernel = contracted_kernel = TabledKernel
spliced_kernel = TabledKernel


class Address:
    """A right-hand side, by its place in the table of functions; `library` holds it there."""

    def __init__(self, address: int, library: Any = None) -> None:
        self.address, self.library = address, library


def compile_address(function: Callable[..., None], cache: bool = True) -> Address:  # noqa: ARG001 (Numba's other half)
    """Return what was compiled of a right-hand side of this package."""
    return _find_address(function.__module__, function.__name__)


def compile_with_gain(lanes: Callable[..., None], own: Any, whole: bool, cache: bool, **names: Any) -> Address:  # noqa: ARG001
    """Return what was compiled of a function of lanes with the gain of a family, or compile it with a typed one."""
    if isinstance(own, str):
        return _load_module(module_of_lanes(lanes, own, names, _address_of))
    return _find_address(lanes.__module__, lanes.__name__, own.__module__, own.__name__, "int" if whole else "float")


def compile_source(source: str, names: Mapping[str, Any], strict: bool = False) -> Address:  # noqa: ARG001
    """Compile a right-hand side whose text was written from typed formulas."""
    return _load_module(module_of_text(source, names, _address_of))


def _find_address(*key: str) -> Address:
    return Address(_address_of(*key))


def _address_of(*key: str) -> int:
    if key not in table().addresses:
        raise NotImplementedError(f"{' of '.join(key)} was not compiled; run `codim2 kernels`.")
    return table().addresses[key]


def _load_module(module: bytes) -> Address:
    """Load a module beside the kernels: its function then has a place in their table."""
    with NamedTemporaryFile(suffix=".so", delete=False) as file:
        file.write(module)
    library = ctypes.CDLL(file.name)
    Path(file.name).unlink()
    address = ctypes.cast(library.f, ctypes.c_void_p).value
    assert address is not None
    return Address(address, library)


def _elsewhere(*_: Any) -> Any:
    raise NotImplementedError("only what is compiled does that")


ahead = bits_of_double = call_at = call_field = carray = double_of_bits = _elsewhere
