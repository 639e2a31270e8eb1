"""Compiling a right-hand side, and keeping the last ones compiled."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from numba import cfunc

from ..jit import ARITHMETIC
from .layout import FIELD


def compile_address(function: Callable[..., None], cache: bool) -> Any:
    """Compile a right-hand side, or a gain, to be called by its `address`."""
    return cfunc(FIELD, cache=cache, nogil=True, fastmath=ARITHMETIC, error_model="numpy")(function)


class CompiledCache:
    """Compiled things by key, the last `most` of them; what to compile is said when it is asked for."""

    def __init__(self, most: int) -> None:
        self._most = most
        self._things: dict[Any, Any] = {}

    def __contains__(self, key: object) -> bool:
        return key in self._things

    def get(self, key: Any, make: Callable[[], Any]) -> Any:
        """Return what is kept under a key, or make it."""
        thing = self._things.get(key)
        if thing is None:
            thing = make()
            while len(self._things) >= self._most:
                self._things.pop(next(iter(self._things)), None)
            self._things[key] = thing
        return thing
