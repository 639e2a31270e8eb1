"""Separatrices as results: one branch of an invariant manifold, and all of a portrait as a graph."""

from __future__ import annotations

from dataclasses import dataclass, field

from ..results.arrays import Array
from ..results.result import Pictured, Several, Tabled, result_rows
from ..results.tables import paragraphs


@dataclass(frozen=True, eq=False)
class Separatrix(Tabled):
    """One branch of an invariant manifold; arrays are read-only.

    Attributes
    ----------
    origin : str
        The saddle it belongs to: "C" ("C1", "C2", ... where there are several), "Q1", ...
    direction : str
        "unstable" (it leaves the origin) or "stable" (it enters it).
    end : str
        Where its other end lies: "C", "Q2", "equator" (the closed one), "cycle 1", "outside", or "undecided".
    points : ndarray (m, 2)
        The picture, in order of increasing time; includes origin and end where they are points.
    departure_angle : float
        Angle of its tangent at the origin, leaving it, radians; at the equator that of the direction Q.
    arrival_angle : float or None
        At the other end: theta on the equator, or the angle from C of the tangent at a node or saddle.
    inside : bool
        On the hemisphere; otherwise outside.
    connection : bool
        The other end is a saddle too: a saddle connection, within `gap`.
    gap : float or None
        Distance in the disc by which the two saddles' branches miss each other, where that was measured.
    status : str
        One sentence.
    """

    _head_ = ("of", "branch", "other end", "where")

    origin: str
    direction: str
    end: str
    points: Array = field(repr=False)
    departure_angle: float
    arrival_angle: float | None
    inside: bool
    connection: bool
    gap: float | None
    status: str

    def _row_(self) -> tuple[str, ...]:
        return self.origin, self.direction, self.end, "hemisphere" if self.inside else "outside"


@dataclass(frozen=True, eq=False)
class Separatrices(Several[Separatrix], Pictured):
    """All separatrices; iterates over them.

    Attributes
    ----------
    branches : tuple of Separatrix
    notes : tuple of str
        What has no separatrix because it is degenerate, saddle connections, branches left undecided.
    """

    _held_ = "branches"

    branches: tuple[Separatrix, ...]
    notes: tuple[str, ...] = ()

    def _tables_(self) -> str:
        return result_rows(self) + paragraphs(self.notes)

    @property
    def graph(self) -> tuple[tuple[str, str], ...]:
        """(from, to) of each branch, in the direction of time."""
        return tuple((b.origin, b.end) if b.direction == "unstable" else (b.end, b.origin) for b in self.branches)
