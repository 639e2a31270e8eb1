"""What a census returns: for each portrait how many, which share, and examples."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..tables import Tabled, frame, number, paragraphs, point, rows, write

NORMAL_95 = 1.959963984540054  # two-sided 95 % of the normal distribution


@dataclass(frozen=True)
class Row(Tabled):
    """One portrait.

    Attributes
    ----------
    name : str
        The case, if there is one, and the portrait's name: "I CM4".
    count : int
    share : float
    low, high : float
        The share's interval of 95 % confidence (Wilson).
    example : tuple of float, or str
        The system of this name that lies farthest from a border: a, b, d, f1, f2, or text of a general system.
    marginal : tuple of float, or str
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
        example = self.example if isinstance(self.example, str) else point(self.example)
        return self.name, f"{self.count:,}", number(self.share), f"{number(self.low)} to {number(self.high)}", example


@dataclass(frozen=True)
class Tally:
    """Portraits of one chunk: by name (count, margin and system of the most typical, of the most marginal)."""

    found: dict[str, tuple[int, float, Any, float, Any]]

    def joined(self, other: Tally) -> Tally:
        """Return both together; of equal margins this one's example is kept."""
        found = dict(self.found)
        for name, (count, wide, typical, narrow, marginal) in other.found.items():
            if name not in found:
                found[name] = (count, wide, typical, narrow, marginal)
                continue
            n, best, example, least, edge = found[name]
            if wide > best:
                best, example = wide, typical
            if narrow < least:
                least, edge = narrow, marginal
            found[name] = (n + count, best, example, least, edge)
        return Tally(found)


@dataclass(frozen=True)
class Census:
    """The portraits of many systems.

    Attributes
    ----------
    table : tuple of Row
        The most frequent first.
    count : int
    seed : int
    """

    table: tuple[Row, ...]
    count: int
    seed: int

    def _repr_html_(self) -> str:
        return rows(self.table) + paragraphs([f"{self.count:,} systems, seed {self.seed}"])

    def to_csv(self, path: str | Path) -> None:
        """Write the table as CSV, a row a portrait."""
        write(path, map(vars, self.table))

    def to_frame(self) -> Any:
        """Return the table as a pandas DataFrame (pandas must be installed)."""
        return frame(map(vars, self.table))


def tabulated(tallies: Iterable[Tally], seed: int) -> Census:
    """Return the census of some chunks, in their order."""
    whole = Tally({})
    for tally in tallies:
        whole = whole.joined(tally)
    total = sum(entry[0] for entry in whole.found.values())
    rows = [
        Row(name, count, count / total, *interval(count, total), example, marginal)
        for name, (count, _, example, _, marginal) in whole.found.items()
    ]
    return Census(tuple(sorted(rows, key=lambda row: (-row.count, row.name))), total, seed)


def interval(count: int, total: int) -> tuple[float, float]:
    """Return Wilson's interval of 95 % confidence of a share.

    Parameters
    ----------
    count, total : int
        0 <= count <= total, total > 0.
    """
    share, z2 = count / total, NORMAL_95**2
    centre = share + z2 / (2 * total)
    half = NORMAL_95 * math.sqrt(share * (1 - share) / total + z2 / (4 * total * total))
    scale = 1 + z2 / total
    return max(0.0, (centre - half) / scale), min(1.0, (centre + half) / scale)
