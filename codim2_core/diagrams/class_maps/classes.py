"""What a class map asks of a family of systems: the class at many points, and what happens from one to another."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

__all__ = ["UNKNOWN", "Classes"]

Array = NDArray[np.float64]
Codes = NDArray[np.int64]

UNKNOWN = -2  # not the class that was asked about


class Classes(Protocol):
    """The classes of portraits over one or two parameters; a class is a number, `sweep.UNDEFINED` where U is not.

    Attributes
    ----------
    names : tuple of str
        The parameters.
    most_cells : int
        So many cells of a map are halved at most.
    """

    @property
    def names(self) -> tuple[str, ...]:
        """The parameters."""
        ...

    @property
    def most_cells(self) -> int:
        """Cells of a map, at most."""
        ...

    def decided(self, at: Array) -> tuple[Codes, Array]:
        """Return classes at points (k, n), and the functions (j, k) whose signs decide them (nan: without meaning)."""
        ...

    def beside(self, at: Array, before: Codes, after: Codes) -> Codes:
        """Return classes at points between others or, where they are not `before` and dear to find, `UNKNOWN`."""
        ...

    def happening(self, before: int, after: int) -> tuple[str, ...]:
        """Name what happens between two classes."""
        ...

    def name(self, code: int) -> str:
        """Name a class."""
        ...
