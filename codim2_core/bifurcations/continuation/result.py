"""The result of `continue_cycles` and `continue_typed`: branches of limit cycles, and their special points."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ...results.arrays import Array
from ...results.result import Pictured, Result, Several, Tabled, result_rows
from ...results.tables import paragraphs, table_number


@dataclass(frozen=True, eq=False)
class CyclePoint(Tabled):
    """A special point of a branch of cycles.

    Attributes
    ----------
    kind : str
        "Hopf", "fold of cycles", "heteroclinic cycle through the equator", "equator" (the closed equator takes over the
        cycle), "saddle-node on the equator", "det A = 0" (a line of equilibria cuts
        the cycle), "span" (an end of the span), "closed" (the branch has no ends) or
        "undecided"; of a general system also "homoclinic cycle", "heteroclinic cycle" (through one saddle, or several)
        and "saddle-node on the cycle" (two critical sets appear on it).
    value : float
        Of the parameter.
    period, amplitude : float
        There, as along the branch; the period is infinite on the equator.
    sentence : str
    """

    _head_ = ("point", "at", "period", "amplitude", "what happens")

    kind: str
    value: float
    period: float
    amplitude: float
    sentence: str

    def _row_(self) -> tuple[str, ...]:
        return self.kind, *map(table_number, (self.value, self.period, self.amplitude)), self.sentence


@dataclass(frozen=True, eq=False)
class CycleBranch(Result):
    """One branch of limit cycles, in order along it; arrays are read-only and of the same length m.

    Attributes
    ----------
    value : ndarray (m,)
        Of the parameter.
    period : ndarray (m,)
        In tau, the fast time of kappa_2; infinite at an end on the equator.
    amplitude : ndarray (m,)
        Largest distance from C on the cycle, in the projected disc; of a general system from the critical set of which
        it is born, or from one inside it, and from where that was last where it ceases to be.
    exponent, multiplier : ndarray (m,)
        ln of the Floquet multiplier, from the integral of the divergence, and the multiplier itself.
    stable : ndarray of bool (m,)
        exponent < 0.
    section : ndarray (m, 2)
        Where the cycle crosses its section, in the projected disc: a seed on it.
    start, end : CyclePoint
    folds : tuple of CyclePoint
        In order.
    """

    value: Array = field(repr=False)
    period: Array = field(repr=False)
    amplitude: Array = field(repr=False)
    exponent: Array = field(repr=False)
    multiplier: Array = field(repr=False)
    stable: NDArray[np.bool_] = field(repr=False)
    section: Array = field(repr=False)
    start: CyclePoint
    end: CyclePoint
    folds: tuple[CyclePoint, ...]

    def __len__(self) -> int:
        return len(self.value)

    @property
    def special(self) -> tuple[CyclePoint, ...]:
        """Start, folds and end."""
        return (self.start, *self.folds, self.end)


@dataclass(frozen=True, eq=False)
class CycleBranches(Several[CycleBranch], Pictured):
    """All branches found over the span; iterates over them.

    Attributes
    ----------
    name : str
    span : (float, float)
    branches : tuple of CycleBranch
    reason : str
        Why there is none, or how those there are were found.
    notes : tuple of str
        What was not decided.
    """

    _held_ = "branches"

    name: str
    span: tuple[float, float]
    branches: tuple[CycleBranch, ...]
    reason: str
    notes: tuple[str, ...] = ()

    def _repr_svg_(self) -> str | None:
        return super()._repr_svg_() if self.branches else None

    def _tables_(self) -> str:
        special = result_rows(one for branch in self.branches for one in branch.special)
        return special + paragraphs([self.reason, *self.notes])

    def count(self, value: float) -> int:
        """Count the cycles at a value of the parameter (one between the ends of the branches and their folds)."""
        total = 0
        for branch in self.branches:
            total += sum((one < value) != (two < value) for one, two in pairwise(branch.value.tolist()))
        return total
