"""What is asked of a family of systems: the class at many points, and what happens from one to another."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

__all__ = ["Named"]

Array = NDArray[np.float64]
Codes = NDArray[np.int64]


class Named(Protocol):
    """The classes of portraits over one or two parameters; a class is a number, `sweep.UNDEFINED` where U is not.

    Attributes
    ----------
    unproved : int
        Points, of those at which the class was computed, at which it is not proved that nothing is missed.
    """

    @property
    def unproved(self) -> int:
        """Points without a proof."""
        ...

    def decided(self, at: Array) -> Codes:
        """Return classes at points (k, n)."""
        ...

    def happening(self, before: int, after: int) -> tuple[str, ...]:
        """Name what happens between two classes."""
        ...

    def name(self, code: int) -> str:
        """Name a class."""
        ...
