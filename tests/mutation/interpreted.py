"""Numba's kernels as plain Python, entered by their addresses as ever: a changed kernel costs no compilation then.

The lanes that step side by side are fewer, as nothing is gained by many: that is a constant of one module.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import Any

import numpy as np

FEWER = ("codim2_core/stepping/layout.py", "LANES = 32", "LANES = 4")  # file, what stands there, what is read


class Entry:
    """What `numba.core.ccallback.CFunc` makes of a function: something with an address."""

    known: dict[int, Callable[..., None]] = {}  # noqa: RUF012
    _cache = _sig = None

    def __init__(self, function: Callable[..., None], *_: Any) -> None:
        self.__name__, self.address = function.__name__, id(function)
        self.known[self.address] = function

    def enable_caching(self) -> None:
        """Keep nothing."""

    def compile(self) -> None:
        """Leave it as it is."""


def _call_field(address: int, S: Any, source: int, target: int, P: Any) -> None:
    if address in Entry.known:
        Entry.known[address](S[source:], S[target:], P)
    else:  # of a callback
        from codim2_core.jit import interpreted

        interpreted.STAND_INS["call_field"](address, S, source, target, P)


def _call_at(address: int, state: Any, out: Any, parameters: Any) -> None:
    Entry.known[address](state, out, parameters)


def _advance_pointer(pointer: Any, places: int) -> Any:
    return pointer[places:]


def _double_of_bits(bits: int) -> float:
    return struct.unpack("<d", struct.pack("<q", bits))[0]


def _bits_of_double(value: float) -> int:
    return struct.unpack("<q", struct.pack("<d", value))[0]


STAND_INS = {one.__name__: one for one in (_call_field, _call_at, _advance_pointer, _double_of_bits, _bits_of_double)}


def _njit(function: Any = None, **_options: Any) -> Any:
    """Return the function itself, which knows itself as Python."""
    if function is None:
        return _njit
    function.py_func, function.get_call_template = function, None
    return function


def interpret() -> None:
    """See to it that modules imported from now on compile nothing."""
    import numba
    import numba.core.ccallback
    import numba.extending
    from numba.np import numpy_support

    np.seterr(all="ignore")  # as in machine code
    numba.config.DISABLE_JIT = True
    numba.njit = _njit
    numba.core.ccallback.CFunc = Entry
    numpy_support.carray = lambda pointer, shape: pointer[: shape[0]]
    numba.extending.intrinsic = lambda function: STAND_INS[function.__name__]
    from codim2_core.jit import policy

    policy.choose_way(policy.COMPILE)
