"""The result of `atlas`: curves on which the portrait changes, points where they meet, and the regions between."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from ...results.arrays import Array
from ...results.paper import cite, label_of
from ...results.result import Pictured, Tabled, result_rows
from ...results.tables import paragraphs, point, table_number


@dataclass(frozen=True, eq=False)
class AtlasCurve(Tabled):
    """A curve in the plane of two parameters, on which one thing happens.

    Attributes
    ----------
    kind : str
        "saddle-node" (two limit directions meet), "pitchfork" (one splits into three, by a symmetry), "transcritical"
        (a critical set comes to the equator), "fold of critical sets", "pitchfork of critical sets", "Hopf",
        "node-focus", "det A = 0" or "neutral equator"; where they were requested, "fold of cycles", "homoclinic loop"
        (a branch that leaves a saddle comes back to it), "heteroclinic cycle" (one from a half-saddle of the equator
        to its neighbour, and the equator back) and "saddle connection" (any other from saddle to saddle); "degenerate"
        is a line on which every direction is a limit direction, "undefined" one beyond which U has no value, and
        "change of critical sets" a border that was followed by bisection, to 1e-4 of the ranges: at a corner of U, or
        where a fold is no regular zero.
    points : ndarray (m, 2)
        In order along it; a closed one repeats its first point.
    places : ndarray (m, 2)
        Where on the projected hemisphere it happens, of connections the saddle they leave; NaNs where that is nowhere
        in particular.
    numbers : ndarray (m,)
        A number: of "Hopf" the first Lyapunov coefficient (negative: a stable cycle is born), of
        "saddle-node" and "pitchfork" lambda_rho, of "transcritical" lambda_theta, in units of the largest |U|; of
        folds and pitchforks of critical sets and of "node-focus" the sign of tr J, of "fold of cycles" the cycle's
        largest distance from the point it goes round, in the projected disc; of loops and heteroclinic cycles the
        product of the saddles' ratios of eigenvalues, that by which orbits enter over that by which they leave: above
        1 it attracts, and the cycle born of it is stable. Empty where there is none.
    """

    _head_ = ("curve", "from", "to", "points")

    kind: str
    points: Array = field(repr=False)
    places: Array = field(repr=False)
    numbers: Array = field(repr=False)

    @property
    def label(self) -> str:
        """The paper's label."""
        return label_of(self.kind)

    def _row_(self) -> tuple[str, ...]:
        return self.kind, point(self.points[0]), point(self.points[-1]), str(len(self.points))

    @property
    def closed(self) -> bool:
        """Whether it ends where it began."""
        return bool((self.points[0] == self.points[-1]).all())


@dataclass(frozen=True, eq=False, slots=True)
class AtlasPoint(Tabled):
    """A point of codimension two.

    Attributes
    ----------
    kind : str
        Such as "cusp", "Bogdanov–Takens", "generalised Hopf", "saddle-node on the equator", "crossing"; "neutral
        loop": a loop or heteroclinic cycle whose ratio passes through 1; "undecided": a fold of cycles or a connection
        was followed to here and no further.
    place : (float, float)
    sentence : str
        What happens there.
    """

    _head_ = ("point", "place", "what happens")

    kind: str
    place: tuple[float, float]
    sentence: str

    def _row_(self) -> tuple[str, ...]:
        return self.kind, point(self.place), self.sentence


@dataclass(frozen=True, eq=False)
class AtlasRegion(Tabled):
    """A region in which the portrait has one class.

    Attributes
    ----------
    name : str
        Of the portrait, as in a map of classes: "CM4, saddle", "2CM6, saddle, stable node; 4 arrive, 2 leave".
    sample : (float, float)
        A point of it, far from its border.
    area : float
    boundary : tuple of ndarray (m, 2)
        Closed polygons (the first point is not repeated): the outer one anticlockwise, holes clockwise.
    """

    _head_ = ("portrait", "a point of the region", "area")

    name: str
    sample: tuple[float, float]
    area: float
    boundary: tuple[Array, ...] = field(repr=False)

    def _row_(self) -> tuple[str, ...]:
        return self.name, point(self.sample), table_number(self.area)


@dataclass(frozen=True, slots=True)
class SamplingReport:
    """A report on the places at which an atlas was compared with the portrait."""

    places: int = 0  # so many, in all regions and on a net between the curves
    # those whose portrait is not that of their region: a curve nearby is missing
    unlike: tuple[tuple[float, float], ...] = ()
    unproved: int = 0  # at so many it is not proved that no limit direction and no critical set is missed


@dataclass(frozen=True, eq=False)
class Atlas(Pictured):
    """All that changes over two parameters.

    Attributes
    ----------
    names : (str, str)
        Across, and up.
    ranges : ((low, high), (low, high))
    curves : tuple of AtlasCurve
    points : tuple of AtlasPoint
    regions : tuple of AtlasRegion
        By falling area.
    unfinished : tuple of str
        Kinds of curves of which some may be missing: the search was given up after 100 places from which it found none,
        or connections were seen that could not be followed, or not looked for where there are too many saddles.
    degenerate : tuple of (str, float)
        Parameters, and values of them at which every direction is a limit direction: no curve and no point is reported
        there.
    looked : SamplingReport
        Where the portrait was computed.
    """

    names: tuple[str, str]
    ranges: tuple[tuple[float, float], tuple[float, float]]
    curves: tuple[AtlasCurve, ...]
    points: tuple[AtlasPoint, ...] = ()
    regions: tuple[AtlasRegion, ...] = ()
    unfinished: tuple[str, ...] = ()
    degenerate: tuple[tuple[str, float], ...] = ()
    looked: SamplingReport = SamplingReport()

    def _records(self) -> Iterator[dict[str, Any]]:
        for i, curve in enumerate(self.curves):
            for across, up in curve.points.tolist():
                yield {"curve": i, "kind": curve.kind, self.names[0]: across, self.names[1]: up}

    def _tables_(self) -> str:
        labels = dict.fromkeys(f"{one.kind}: {cite(one.label)}" for one in self.curves if cite(one.label))
        tables = result_rows(self.regions) + result_rows(self.points) + result_rows(self.curves)
        return tables + paragraphs(["; ".join(labels)])
