"""Kinds of special values that two numbers of an object decide: a row each, in this one place.

A row is a test function (Kuznetsov 2004, Section 10.2) of tr J and det J of a critical set (3.23), or of
lambda_rho and lambda_theta of a limit direction (Theorem 3.1), with its name, its sentence, and where the paper has it.
Diagrams solve for the zeros of all rows alike (`families.special_points`). Where a row parts what a critical set is
called, the value counts if the names on its two sides differ; of any other row every simple zero counts. Tables,
exports, the page and its marks take what they say of a kind from here.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

TestFunction = Callable[[Any, Any], Any]  # of two numbers of an object, or arrays of them


@dataclass(frozen=True, slots=True)
class SpecialKind:
    """A kind of special value."""

    kind: str  # its name
    function: TestFunction  # of tr J and det J, or of lambda_rho and lambda_theta: it goes through zero there
    holds: TestFunction  # of the same: whether a zero is of this kind
    says: str  # the sentence for people, and when it is said
    when: str
    label: str  # the paper's label
    parts: bool = False  # whether a critical set has another name on the other side
    of: Literal["critical set", "limit direction"] = "critical set"


NODE_FOCUS = SpecialKind(
    "node-focus",
    lambda trace, determinant: trace**2 - 4.0 * determinant,
    lambda _, determinant: determinant > 0.0,
    "tr(J)² = 4 det J: the critical set changes between node and focus.",
    "the discriminant of J is zero",
    "fig:bads",
    parts=True,
)
HOPF = SpecialKind(
    "Hopf",
    lambda trace, _: trace,
    lambda _, determinant: determinant > 0.0,
    "Hopf: tr J = 0 < det J.",
    "tr J = 0 < det J",
    "sec:case3",
    parts=True,
)
DETERMINANT = SpecialKind(
    "det J = 0",
    lambda _, determinant: determinant,
    lambda trace, _: trace == trace,
    "det J = 0: a critical set turns from a saddle into another kind.",
    "det J = 0",
    "eq:scjaco",
    parts=True,
)
SPECIAL_KINDS = [NODE_FOCUS, HOPF, DETERMINANT]


def change_between(one: str, other: str) -> SpecialKind:
    """Return what lies between two kinds of critical sets, such as "stable node" and "stable focus"."""
    if one.split()[0] == other.split()[0]:
        return NODE_FOCUS
    return DETERMINANT if "saddle" in (one, other) else HOPF
