"""A fold of limit cycles, or a cusp: what is known of one, and where one is looked for."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..continuation.turns import Turn
from .curve import Array


@dataclass(frozen=True)
class FoldGuess:
    """Where a fold is looked for, on the plane through (xi, e) across `row` (3,), in (chi, e)."""

    xi: float
    e: Array
    row: Array


@dataclass(frozen=True)
class Fold:
    """A fold, or a cusp: place on the section, e = -A^-1 f, its turn, and the Jacobian (2, 3) by (chi, e).

    `drift` (2,) is d chi/d e at fixed xi.
    """

    xi: float
    e: Array
    turn: Turn
    jacobian: Array
    drift: Array
    cusp: bool = False

    @property
    def bend(self) -> float:
        """Second derivative of the return map, up to a factor: zero at a cusp, where three cycles are one."""
        return float(self.jacobian[1, 0])

    @property
    def place(self) -> Array:
        """(chi, e), (3,)."""
        return np.array([self.turn.chi, *self.e])

    def xi_by(self, change: Array) -> float:
        """Change of xi with that of (chi, e)."""
        return float(change[0] - self.drift @ change[1:]) / self.turn.rate


def carried(one: Fold, first: Array, two: Fold, change: Array, xi: float) -> Fold:
    """Carry what is known of two places, `first` apart in (chi, e), linearly on to the end of a last small change."""
    part = float(first @ change) / float(first @ first)

    def on(here: Any, there: Any) -> Any:
        return there + part * (there - here)

    names = ("exponent", "period", "amplitude", "height", "rate", "by_xi")
    numbers = {name: on(getattr(one.turn, name), getattr(two.turn, name)) for name in names}
    turn = replace(two.turn, xi=xi, shift=0.0, chi=two.turn.chi + float(change[0]), **numbers)
    return Fold(xi, two.e + change[1:], turn, on(one.jacobian, two.jacobian), on(one.drift, two.drift))


def null_vector(jacobian: Array, towards: Array) -> Array:
    """Find the unit vector (3,) that a Jacobian (2, 3) takes to zero, at an acute angle to `towards`."""
    v = np.cross(jacobian[0], jacobian[1])
    v = v / np.linalg.norm(v)
    return v if float(v @ towards) > 0.0 else -v
