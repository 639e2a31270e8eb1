"""The atlas of an e-linear system over any two parameters: regions of one class, and what happens between them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ... import drawing
from ...psi.function import Psi
from ...systems.affine import as_elinear
from ...tables import Tabled, number, point, rows, table
from ..family import family
from .grid import THIN, Spans, Tree, tree
from .plane_classes import PlaneClasses
from .trace import Boundaries, chains, rings, traced

__all__ = ["ClassMap", "MapBoundary", "MapRegion", "class_map"]

Array = NDArray[np.float64]

_PLAIN = 2  # levels of halving at every change of class
_CANDIDATES = 48  # points of a region among which the one farthest from as many points of its border is chosen


@dataclass(frozen=True, eq=False)
class MapRegion(Tabled):
    """A region in which the portrait has one class.

    Attributes
    ----------
    name : str
        Such as "CM4, saddle", "CM0, stable focus" or "NCM2": name of the portrait (`Classification.name`) and kind of
        the critical set; "undefined" where a coefficient is not finite.
    inside : (x, y)
        A point of the region, far from its border.
    area : float
    width : float
        Diameter of a circle about `inside` that fits into the region, where both spans are counted as 1.
    boundary : tuple of ndarray (m, 2)
        Closed polygons (the first point is not repeated): outer ones anticlockwise, holes clockwise.
    """

    _head_ = ("portrait", "a point of the region", "area")

    name: str
    inside: tuple[float, float]
    area: float
    width: float
    boundary: tuple[Array, ...] = field(repr=False)

    def _row_(self) -> tuple[str, ...]:
        return self.name, point(self.inside), number(self.area)


@dataclass(frozen=True, eq=False)
class MapBoundary:
    """A curve between two classes.

    Attributes
    ----------
    happening : tuple of str
        What happens across it: "saddle-node", "pitchfork", "transcritical", "det A = 0", "Hopf", "node-focus",
        "undefined"; several where curves coincide.
    between : (str, str)
        Names of the regions.
    lines : tuple of ndarray (m, 2)
        Polylines; a closed one repeats its first point.
    """

    happening: tuple[str, ...]
    between: tuple[str, str]
    lines: tuple[Array, ...] = field(repr=False)


@dataclass(frozen=True, eq=False)
class ClassMap:
    """The atlas of an e-linear system over two parameters.

    Attributes
    ----------
    names : (str, str)
    spans : ((low, high), (low, high))
    regions : tuple of MapRegion
        By falling area.
    boundaries : tuple of MapBoundary
    accuracy : float
        Points of boundaries are as near as this to the change of class, where both spans are counted as 1; at
        junctions of three regions, and between points, they are as near as a part of a cell.
    step : float
        Side of the smallest cell, where both spans are counted as 1. Boundaries that hold no whole cell are not drawn.
    thin : tuple of (str, (x, y))
        Classes that were seen, but only in places too thin to be drawn, and one such place.
    evaluated : int
        At how many points the class was computed, before the bisections.
    """

    names: tuple[str, str]
    spans: tuple[tuple[float, float], tuple[float, float]]
    regions: tuple[MapRegion, ...]
    boundaries: tuple[MapBoundary, ...]
    accuracy: float
    step: float
    thin: tuple[tuple[str, tuple[float, float]], ...]
    evaluated: int

    def _repr_svg_(self) -> str | None:
        return drawing.svg(self)

    def _repr_html_(self) -> str:
        found = [("; ".join(one.happening), *one.between) for one in self.boundaries]
        return (self._repr_svg_() or "") + rows(self.regions) + table(("what happens", "between", "and"), found)

    @property
    def smallest_width(self) -> float:
        """Width of the thinnest region found."""
        return min(region.width for region in self.regions)


def class_map(
    system: Any,
    psi: Psi,
    names: Sequence[str],
    spans: Sequence[Sequence[float]],
    z: ArrayLike = (),
    *,
    steps: int = 128,
    thin: int = THIN,
    accuracy: float = 1e-5,
) -> ClassMap:
    """Regions of equal class over two parameters, and the curves between them (sec:bifurcations).

    The class is computed at the vertices of a quadtree: coarse cells are halved where it changes or may change
    unseen, and once or twice more where something thinner than a cell shows. Points of the boundaries are then
    found by bisection along the edges of the triangles into which the cells are cut.

    Parameters
    ----------
    system : ELinear, System, Coefficients or Frozen
        Where U of a System is affine in (c, s) it is mapped as the e-linear system that it is (lem:normalform); any
        other has its `atlas`.
    psi : Psi
    names : (str, str)
        Two of `layer_problem.vary.names`.
    spans : ((low, high), (low, high))
    z : (m,) floats
    steps : int
        1/steps of the spans is the cell at boundaries, 8 to 512; rounded up to a multiple of 4.
    thin : int
        How often cells are halved again at thin places, 0 to 2: 0 while a picture moves.
    accuracy : float
        Of the points of boundaries, where both spans are counted as 1; 1e-12 to 1e-2.

    Returns
    -------
    ClassMap

    Raises
    ------
    ValueError
        The system is not e-linear, a name cannot be varied, a span is empty or beyond what is allowed, or z does not
        fit.
    """
    linear = as_elinear(system)
    if linear is None:
        raise ValueError("U is not affine in (c, s), and class_map is of e-linear systems; use atlas.")
    if len(names) != 2 or len(spans) != 2:
        raise ValueError(f"names are {names!r} and spans {spans!r}; give two of each.")
    if not 8 <= steps <= 512:
        raise ValueError(f"steps is {steps}; allowed is 8 to 512.")
    if thin not in range(THIN + 1):
        raise ValueError(f"thin is {thin}; allowed is 0 to {THIN}.")
    if not 1e-12 <= accuracy <= 1e-2:
        raise ValueError(f"accuracy is {accuracy}; allowed is 1e-12 to 1e-2.")
    (x0, x1), (y0, y1) = ((float(low), float(high)) for low, high in spans)
    if not (np.isfinite([x0, x1, y0, y1]).all() and x0 < x1 and y0 < y1):
        raise ValueError(f"spans are {spans!r}; give (low, high) with low < high for each.")
    both = (x0, x1), (y0, y1)
    classes = PlaneClasses.over(family(linear, psi, z, *names, spans=both), both)
    coarse = -(-steps // 4)
    leaves = tree(classes, both, coarse, _PLAIN, thin)
    halvings = max(1, int(np.ceil(np.log2(1.0 / ((coarse << _PLAIN) * accuracy)))))
    found = traced(classes, leaves, both, halvings)
    unresolved = tuple((classes.name(code), at) for code, at in found.seen.items())
    first, second = classes.names
    return ClassMap(
        (first, second), both, _regions(classes, leaves, found, both), _boundaries(classes, found),
        accuracy, float(leaves.size.min()), unresolved, len(leaves.codes),
    )  # fmt: skip


def _codes(found: Boundaries) -> NDArray[np.int64]:
    """Class of each region."""
    out = np.zeros(int(found.region.max()) + 1, np.int64)
    out[found.region] = found.codes
    return out


def _regions(classes: PlaneClasses, leaves: Tree, found: Boundaries, spans: Spans) -> tuple[MapRegion, ...]:
    codes = _codes(found)
    bounds = np.arange(len(codes) + 1)
    inner = found.pieces[found.pieces[:, 3] >= 0]
    directed = np.concatenate([found.pieces[:, :3], inner[:, [1, 0, 3]]])
    directed = directed[np.argsort(directed[:, 2], kind="stable")]
    edges = np.searchsorted(directed[:, 2], bounds)
    # vertices to choose a point inside from: centres of large leaves first
    room = np.zeros(len(leaves.codes))
    room[leaves.centres] = leaves.size
    order = np.lexsort((-room, found.region))
    firsts = np.searchsorted(found.region[order], bounds)
    out = []
    for k in range(len(codes)):
        polygons = [found.points[ring] for ring in rings(directed[edges[k] : edges[k + 1], :2])]
        areas = [_area(ring) for ring in polygons]
        own = order[firsts[k] : firsts[k + 1]]
        # some of the centres of all leaves, and some of the largest ones
        last = [max(1, int(count.sum())) - 1 for count in (room[own] > 0.0, room[own] == room[own[0]])]
        several = leaves.place[own[np.concatenate([np.linspace(0, i, _CANDIDATES).astype(int) for i in last])]]
        inside, width = _inside(several, polygons, spans)
        for ring in polygons:
            ring.flags.writeable = False
        boundary = tuple(ring for _, ring in sorted(zip(areas, polygons, strict=True), key=lambda pair: -pair[0]))
        out.append(MapRegion(classes.name(int(codes[k])), inside, sum(areas), width, boundary))
    return tuple(sorted(out, key=lambda region: -region.area))


def _area(ring: Array) -> float:
    x, y = (ring - ring[0]).T
    return 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1))


def _inside(points: Array, polygons: list[Array], spans: Spans) -> tuple[tuple[float, float], float]:
    """Choose the point farthest from closed polygons; and twice its distance, where both spans are counted as 1."""
    unit = np.array([span[1] - span[0] for span in spans])
    start = np.concatenate(polygons) / unit
    away = start[:: max(1, len(start) // (2 * _CANDIDATES))] - (points / unit)[:, None]
    edges = np.array(spans).T / unit  # they have few points, and no region reaches beyond them
    frame = np.minimum(points / unit - edges[0], edges[1] - points / unit).min(axis=1)
    best = points[int(np.minimum(np.sqrt((away**2).sum(axis=2).min(axis=1)), frame).argmax())]
    along = np.concatenate([np.roll(ring, -1, axis=0) for ring in polygons]) / unit - start
    start = start - best / unit
    square = (along**2).sum(axis=1)
    t = np.clip(-(start * along).sum(axis=1) / np.where(square > 0.0, square, 1.0), 0.0, 1.0)
    least = float(np.hypot(*(start + t[:, None] * along).T).min())
    return (float(best[0]), float(best[1])), 2.0 * least


def _boundaries(classes: PlaneClasses, found: Boundaries) -> tuple[MapBoundary, ...]:
    codes = _codes(found)
    inner = found.pieces[found.pieces[:, 3] >= 0]
    low, high = np.sort(codes[inner[:, 2:]], axis=1).T
    key = low * (int(codes.max()) + 2) + high
    out = []
    for value in np.unique(key):
        here = np.flatnonzero(key == value)
        lines = [found.points[line] for line in chains(inner[here, :2])]
        for line in lines:
            line.flags.writeable = False
        u, v = int(low[here[0]]), int(high[here[0]])
        out.append(MapBoundary(classes.happening(u, v), (classes.name(u), classes.name(v)), tuple(lines)))
    return tuple(out)
