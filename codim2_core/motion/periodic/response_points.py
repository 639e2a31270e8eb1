"""Special points of a periodic motion along a parameter, by test functions of its multipliers (Kuznetsov 2004, 5.2)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from ...results.arrays import Array, Complex
from ...results.result import Tabled
from ...results.tables import table_number
from ...results.words import say

REAL = 1e-6  # imaginary part of a multiplier on the unit circle, up to which a pair is a pair of real ones


@dataclass(frozen=True, eq=False)
class ResponseRow:
    """One motion of a curve."""

    value: float
    period: float
    state: Array  # (2 + m,) Its start
    swings: Array  # (2 + m,) Half of what lies between the extremes
    multipliers: Complex  # (q,)
    phases: tuple[str, ...]  # kinds of its phases, in order
    onward: float  # by how much the parameter goes on from the motion before it


@dataclass(frozen=True, eq=False)
class ResponsePoint(Tabled):
    """A special point of a response curve.

    Attributes
    ----------
    kind : str
        "fold", "branch point", "period doubling", "Neimark-Sacker", or "phases change": a stick or a passage of Sigma
        begins or ends.
    value, period : float
    sentence : str
    """

    _head_ = ("at", "value", "period", "what happens")

    kind: str
    value: float
    period: float
    sentence: str

    def _row_(self) -> tuple[str, ...]:
        return self.kind, table_number(self.value), table_number(self.period), self.sentence


def _product_of_pairs(values: Complex) -> float:
    return float(np.prod([1.0 - one * other for one, other in combinations(values.tolist(), 2)]).real)


#: What goes through zero there, of the multipliers without the trivial one.
KINDS_OF_CHANGE: Mapping[str, Callable[[Complex], float]] = {
    "fold": lambda values: float(np.prod(values - 1.0).real),
    "period doubling": lambda values: float(np.prod(values + 1.0).real),
    "Neimark-Sacker": _product_of_pairs,
}


def change_point(
    along: str, kind: str, row: ResponseRow, before: ResponseRow, after: ResponseRow, turns: bool = False
) -> ResponsePoint | None:
    """Return the point at a zero of a test function between two motions; None where it is none of that kind.

    The parameter `turns` between the two or it does not.
    """
    told = {"name": along, "value": row.value}
    if kind == "fold":
        kind, sentence = (
            ("fold", say("response folds", **told)) if turns else ("branch point", say("branches off", **told))
        )
    elif kind == "period doubling":
        sentence = say("doubles", **told)
    elif kind == "Neimark-Sacker":
        nearest = min(row.multipliers.tolist(), key=lambda one: abs(abs(one) - 1.0))
        if abs(nearest.imag) < REAL:  # a pair of real ones whose product is 1
            return None
        sentence = say("becomes a torus", **told)
    else:
        of = "slide" if after.phases.count("slide") != before.phases.count("slide") else "cross"
        below, above = sorted((before, after), key=lambda row: row.value)
        counts = {"below": below.phases.count(of), "above": above.phases.count(of)}
        sentence = say("sticks change" if of == "slide" else "passages change", **told, **counts)
    return ResponsePoint(kind, row.value, row.period, sentence)
