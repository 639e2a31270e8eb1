"""Functions of Python at an address, as kernels call right-hand sides: for formulas that are not compiled."""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable, Iterable
from typing import Any

POINTER = ctypes.c_void_p


class Callback:
    """A Python function of numbers, called by its `address` while the interpreter is held; it must outlive that."""

    def __init__(self, function: Callable[..., Iterable[float]], takes: int, gives: int) -> None:
        self.error: BaseException | None = None
        undefined = (math.nan,) * gives

        def call(state: Any, out: Any, _: int) -> None:
            values = undefined
            if self.error is None:
                try:
                    values = function(*state.contents[:])
                except BaseException as error:  # nothing passes through machine code
                    self.error = error
            out.contents[:] = values

        places = (ctypes.POINTER(ctypes.c_double * count) for count in (takes, gives))
        self._entry = ctypes.CFUNCTYPE(POINTER, *places, POINTER)(call)
        self.address = ctypes.cast(self._entry, POINTER).value or 0

    def check(self) -> None:
        """Raise what it has raised."""
        error, self.error = self.error, None
        if error is not None:
            raise error
