"""Kinds of special values that tr J and det J of a critical set (3.23) decide: a row each, in this one place.

A row is a level: tr J = level sqrt(det J), or its negative (Kuznetsov 2004, Section 10.2), with its name, its sentence,
and where the paper has it. Diagrams solve for it along one parameter (`families.special_points`), atlases follow it
over two (`families.conditions`), `point_accuracy` gives its error. Where a row parts what a critical set is called, a
value counts if the names on its two sides differ; of any other row every simple zero counts. Tables, exports, the page
and its marks take what they say of a kind from here.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, slots=True)
class SpecialKind:
    """A kind of special value."""

    kind: str  # its name
    level: float  # |tr J|/sqrt(det J) there: infinite where det J = 0
    says: str  # the sentence for people, and when it is said
    when: str
    label: str  # the paper's label
    sign: int = 1  # of det J there, or 0: any
    parts: bool = False  # whether a critical set has another name on the other side

    def function(self, trace: Any, determinant: Any) -> Any:
        """Return its test function of tr J and det J, or of k tr J and k^2 det J with any k > 0."""
        if self.level == math.inf:
            return determinant
        return trace**2 - self.level**2 * determinant if self.level else trace

    def holds(self, determinant: Any) -> Any:
        """Whether a zero with this det J is of this kind."""
        return self.sign * determinant > 0.0 if self.sign else determinant == determinant


HOPF = SpecialKind("Hopf", 0.0, "Hopf: tr J = 0 < det J.", "tr J = 0 < det J", "sec:case3", parts=True)
NODE_FOCUS = SpecialKind(
    "node-focus",
    2.0,
    "tr(J)² = 4 det J: the critical set changes between node and focus.",
    "the discriminant of J is zero",
    "fig:bads",
    parts=True,
)
DETERMINANT = SpecialKind(
    "det J = 0",
    math.inf,
    "det J = 0: a critical set turns from a saddle into another kind.",
    "det J = 0",
    "eq:scjaco",
    sign=0,
    parts=True,
)
SPECIAL_KINDS = [HOPF, NODE_FOCUS, DETERMINANT]


def change_between(one: str, other: str) -> SpecialKind:
    """Return what lies between two kinds of critical sets, such as "stable node" and "stable focus"."""
    if one.split()[0] == other.split()[0]:
        return NODE_FOCUS
    return DETERMINANT if "saddle" in (one, other) else HOPF
