"""One function in several versions: the same code with other values for the names that it reads from its module."""

from __future__ import annotations

from types import FunctionType
from typing import Any


def rebind(function: Any, version: object = "", **names: Any) -> Any:
    """Return a function with other values for some of the global names that it reads.

    No closure does that for what is compiled and kept on disk: Numba finds a kernel again by its file, its qualified
    name and what it closes over, and another kernel there is a new one in each process.
    """
    made = FunctionType(
        function.__code__, {**function.__globals__, **names}, function.__name__, None, function.__closure__
    )
    made.__module__ = function.__module__
    made.__qualname__ = f"{function.__qualname__}_{version}" if version != "" else function.__qualname__
    return made
