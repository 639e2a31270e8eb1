"""One function in several versions: the same code with other values for the names that it reads from its module."""

from __future__ import annotations

from types import FunctionType
from typing import Any


def rebind(function: Any, version: object = "", **names: Any) -> Any:
    """Return a function with other values for some global names; Numba finds no closure on disk again."""
    made = FunctionType(
        function.__code__, {**function.__globals__, **names}, function.__name__, None, function.__closure__
    )
    made.__module__ = function.__module__
    made.__qualname__ = f"{function.__qualname__}_{version}" if version != "" else function.__qualname__
    return made
