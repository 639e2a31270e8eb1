"""The table of a census: for each portrait a count, a share, and examples."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...results.result import Result, Tabled, result_rows
from ...results.tables import paragraphs, point, table_number
from .tally import CensusPlan, SampleLocation, Tally

NORMAL_95 = 1.959963984540054  # two-sided 95 % of the normal distribution


@dataclass(frozen=True, eq=False)
class CensusRow(Tabled):
    """One portrait.

    Attributes
    ----------
    name : str
        The case, if there is one, and the portrait's name: "I CM4".
    count : int
    share : float
    low, high : float
        The share's interval of 95 % confidence (Wilson).
    example : tuple of float, or System
        The system of this name that lies farthest from a border: a, b, d, f1, f2, or a general system.
    marginal : tuple of float, or System
        The one that lies nearest to a border.
    """

    _head_ = ("portrait", "count", "share", "95 % interval", "example")

    name: str
    count: int
    share: float
    low: float
    high: float
    example: Any
    marginal: Any

    def _row_(self) -> tuple[str, ...]:
        example = point(self.example) if isinstance(self.example, tuple) else repr(self.example)
        return (
            self.name,
            f"{self.count:,}",
            table_number(self.share),
            f"{table_number(self.low)} to {table_number(self.high)}",
            example,
        )


@dataclass(frozen=True, eq=False)
class Census(Result):
    """The portraits of many systems.

    Attributes
    ----------
    table : tuple of CensusRow
        The most frequent first.
    count : int
    seed : int
    contradictions : int
        Systems that are not degenerate and whose critical sets do not have the indices that U turns along the equator
        (Section 3.1): each would be an error of this software.
    """

    table: tuple[CensusRow, ...]
    count: int
    seed: int
    contradictions: int = 0

    def _tables_(self) -> str:
        return result_rows(self.table) + paragraphs([f"{self.count:,} systems, seed {self.seed}"])

    def _records(self) -> Iterator[dict[str, Any]]:
        return map(dict, map(vars, self.table))


def make_census(tally: Tally, plan: CensusPlan, chunk: int) -> Census:
    """Return the census of what is counted; its examples are drawn again, `chunk` systems at a time."""
    total = tally.systems
    places = {place for entry in tally.found.values() for place in (entry.typical, entry.marginal)}
    systems = _drawn_again(plan, places, chunk, total)
    rows = [
        CensusRow(name, entry.systems, entry.systems / total, *interval(entry.systems, total),
            systems[entry.typical], systems[entry.marginal])
        for name, entry in tally.found.items()
    ]  # fmt: skip
    ordered = sorted(rows, key=lambda row: (-row.count, row.name))
    return Census(tuple(ordered), total, plan.seed, tally.contradictions)


def _drawn_again(plan: CensusPlan, places: set[SampleLocation], chunk: int, total: int) -> dict[SampleLocation, Any]:
    found: dict[SampleLocation, Any] = {}
    for i in sorted({i for i, _ in places}):
        drawn = plan.drawn(i, min(chunk, total - i * chunk))
        for place in places:
            if place[0] == i:
                system = drawn[place[1]]
                found[place] = tuple(system.tolist()) if isinstance(system, np.ndarray) else system
    return found


def interval(count: int, total: int) -> tuple[float, float]:
    """Return Wilson's interval of 95 % confidence of a share."""
    share, z2 = count / total, NORMAL_95**2
    centre = share + z2 / (2 * total)
    half = NORMAL_95 * math.sqrt(share * (1 - share) / total + z2 / (4 * total * total))
    scale = 1 + z2 / total
    return max(0.0, (centre - half) / scale), min(1.0, (centre + half) / scale)
