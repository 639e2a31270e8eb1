"""Separatrices as results: one branch of an invariant manifold, and all of a portrait as a graph."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from .. import drawing
from ..arrays import Array
from ..tables import Tabled, paragraphs, result_rows


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
class Separatrices:
    """All separatrices; iterates over them.

    Attributes
    ----------
    branches : tuple of Separatrix
    notes : tuple of str
        What has no separatrix because it is degenerate, saddle connections, branches left undecided.
    """

    branches: tuple[Separatrix, ...]
    notes: tuple[str, ...] = ()

    def _repr_svg_(self) -> str | None:
        return drawing.svg(self)

    def _repr_html_(self) -> str:
        return (self._repr_svg_() or "") + result_rows(self) + paragraphs(self.notes)

    def __iter__(self) -> Iterator[Separatrix]:
        return iter(self.branches)

    def __len__(self) -> int:
        return len(self.branches)

    def __getitem__(self, i: int) -> Separatrix:
        return self.branches[i]

    @property
    def graph(self) -> tuple[tuple[str, str], ...]:
        """(from, to) of each branch, in the direction of time."""
        return tuple((b.origin, b.end) if b.direction == "unstable" else (b.end, b.origin) for b in self.branches)
