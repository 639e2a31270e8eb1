"""What `diagram` returns: branches of all that stands still along one parameter, and the points that are special."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import drawing
from ..tables import Tabled, number, rows

__all__ = ["ClosedEquator", "CriticalBranch", "Diagram", "EquatorBranch", "SpecialValue"]

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class SpecialValue(Tabled):
    """A value of the parameter where something changes.

    Attributes
    ----------
    kind : str
        "saddle-node", "pitchfork", "cusp", "exchange of limit directions", "all directions", "transcritical",
        "touching the equator", "Hopf", "tr J = 0", "node-focus", "det A = 0", "line of equilibria" or
        "neutral equator"; for general systems also "fold of critical sets", "det J = 0" and "change of critical sets"
        (one comes or goes alone).
    value : float
    place : (float, float)
        In the projected disc; on its border for what happens on the equator. (0, 0) where it is nowhere in particular.
    sentence : str
        For people.
    label : str
        The paper's label.
    number : float
        For "Hopf" the first Lyapunov coefficient (negative: a stable cycle is born), else 0.
    """

    _head_ = ("at", "value", "what happens")

    kind: str
    value: float
    place: tuple[float, float]
    sentence: str
    label: str
    number: float = 0.0

    def _row_(self) -> tuple[str, ...]:
        return self.kind, number(self.value), self.sentence


@dataclass(frozen=True, eq=False)
class EquatorBranch:
    """A limit direction along a piece on which its stability does not change (eq:equator_zeros).

    Attributes
    ----------
    value : ndarray (k,)
        Increasing.
    theta : ndarray (k,)
        Continuous along the branch, so it may leave [0, 2 pi).
    lambda_rho, lambda_theta : ndarray (k,)
    kind : str
        Such as "radially attracting, angularly repelling", as `EquatorEquilibria.kind`.
    """

    value: Array
    theta: Array
    lambda_rho: Array
    lambda_theta: Array
    kind: str


@dataclass(frozen=True, eq=False)
class ClosedEquator:
    """The equator as a closed orbit along a piece on which its stability does not change (thm:geneps0(c)).

    Attributes
    ----------
    value : ndarray (k,)
    exponent : ndarray (k,)
        ln rho changes by this much in a turn.
    kind : str
        "attracting from outside", "repelling from outside" or "neutral".
    """

    value: Array
    exponent: Array
    kind: str


@dataclass(frozen=True, eq=False)
class CriticalBranch:
    """A critical set along a piece on which its kind does not change (eq:critical_set).

    Attributes
    ----------
    value : ndarray (k,)
        Increasing.
    e, p : ndarray (k, 2)
        (c, s), and the place in the projected disc; |p| = 1 where it reaches the equator.
    trace, determinant : ndarray (k,)
        Of J.
    kind : str
        As `CriticalSet.kind`.
    """

    value: Array
    e: Array
    p: Array
    trace: Array
    determinant: Array
    kind: str

    @property
    def radius(self) -> Array:
        """|p|, (k,)."""
        return np.hypot(self.p[:, 0], self.p[:, 1])


@dataclass(frozen=True, eq=False)
class Diagram:
    """A one-parameter bifurcation diagram.

    Attributes
    ----------
    name : str
        The parameter.
    span : (float, float)
    equator : tuple of EquatorBranch
    closed : tuple of ClosedEquator
        Where there are no limit directions.
    critical : tuple of CriticalBranch
    special : tuple of SpecialValue
        By increasing value.
    cycles : tuple
        Branches of limit cycles, as `continuation.branches.continue_cycles` gives them.
    gaps : tuple of (float, float)
        Where the coefficients are not finite.
    """

    name: str
    span: tuple[float, float]
    equator: tuple[EquatorBranch, ...]
    closed: tuple[ClosedEquator, ...]
    critical: tuple[CriticalBranch, ...]
    special: tuple[SpecialValue, ...]
    cycles: tuple[Any, ...] = ()
    gaps: tuple[tuple[float, float], ...] = field(default=())

    def _repr_svg_(self) -> str | None:
        return drawing.svg(self)

    def _repr_html_(self) -> str:
        return (self._repr_svg_() or "") + rows(self.special)
