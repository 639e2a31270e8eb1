"""A condition of Definition 2.3, and the five together."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ...results.result import Result, Tabled, result_rows
from ...results.tables import table_number


@dataclass(frozen=True, eq=False, slots=True)
class Condition(Tabled):
    """One condition of Definition 2.3.

    Attributes
    ----------
    name : str
        "R1" to "R5".
    holds : bool
    where : float or None
        The value of s where it fails (inf for R5), None if it holds.
    sentence : str
    """

    _head_ = ("condition", "holds", "fails at s", "why")

    name: str
    holds: bool
    where: float | None
    sentence: str

    def _row_(self) -> tuple[str, ...]:
        where = "–" if self.where is None else table_number(self.where)
        return self.name, "yes" if self.holds else "no", where, self.sentence

    def __bool__(self) -> bool:
        return self.holds


@dataclass(frozen=True, eq=False, slots=True)
class PsiCheck(Result):
    """R1 to R5 of Definition 2.3 for one Psi; iterates over the five."""

    R1: Condition
    R2: Condition
    R3: Condition
    R4: Condition
    R5: Condition

    def _tables_(self) -> str:
        return result_rows(self)

    def __iter__(self) -> Iterator[Condition]:
        return iter((self.R1, self.R2, self.R3, self.R4, self.R5))

    @property
    def holds(self) -> bool:
        """Whether all five hold."""
        return all(self)
