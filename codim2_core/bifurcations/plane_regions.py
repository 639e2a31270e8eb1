"""The regions into which the saddle-node curve and the ellipse |A^-1 f| = 1 cut the plane (f1, f2).

The two curves are a planar graph: its vertices are known in closed form (`Geometry`), every arc between neighbours is
smooth, and walking along arcs with the face on the left gives each region once. Nothing is rastered.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from .. import drawing
from ..layer_problem.location import Existence, locate
from ..portrait.classify import Classification, classify
from ..psi.constructors import constant
from ..systems.coefficients import Coefficients
from ..tables import Results, Tabled, point
from .curve import Array, frozen, matrix
from .geometry import Geometry

_TAU = 2.0 * math.pi
_ARC = 33  # points drawn along an arc, and more where it turns by more than a degree from one to the next
_TURN = _TAU / 360
_SAME = 1e-9  # of the size: points of the two curves nearer than this are one vertex
_THIN = 1e-6  # of the size: regions with a smaller mean width are left out; nobody could see them
_NOTHING = np.zeros((0, 2)), np.zeros(0)


@dataclass(frozen=True, eq=False)
class Region(Tabled):
    """A region of the plane (f1, f2), open, with one portrait up to what Psi decides.

    Attributes
    ----------
    name : str
        "CM0", "CM2", "CM4", "NCM2" or "NCM4", as `classify` names it (fig:sketches, fig:3cases).
    inside : (f1, f2)
        A point of the region, far from its border.
    boundary : tuple of ndarray (m, 2)
        Closed polygons (the first point is not repeated): the outer one first, anticlockwise, then holes, clockwise.
        The unbounded region has holes only.
    bounded : bool
    classification : Classification
        At `inside`, with Psi = 1.
    """

    _head_ = ("region", "a point (f₁, f₂) of it", "bounded", "portrait there")

    name: str
    inside: tuple[float, float]
    boundary: tuple[Array, ...]
    bounded: bool
    classification: Classification

    def _row_(self) -> tuple[str, ...]:
        return self.name, point(self.inside), "yes" if self.bounded else "no", self.classification.sentence


class Regions(Results[Region]):
    """All regions of the plane (f1, f2): a tuple that a notebook shows as a picture and a table."""

    __slots__ = ()

    def _repr_svg_(self) -> str | None:
        return drawing.svg(self)

    def _repr_html_(self) -> str:
        return (self._repr_svg_() or "") + super()._repr_html_()


class _Stop(NamedTuple):
    """A parameter value on a curve at a vertex."""

    parameter: float
    vertex: int


@dataclass
class _Half:
    """An arc in one direction: from `start` to `end`, with the face on its left."""

    at: Callable[[float], tuple[float, float]]
    low: float  # parameter at its start, and at its end
    high: float
    start: int
    end: int
    twin: int
    points: Array
    used: bool = field(default=False)


def regions(a: float, b: float, d: float) -> Regions:
    """All regions of the plane (f1, f2) between the saddle-node curve and the ellipse, each classified inside.

    Regions that touch in a point only are separate. Slivers with a mean width below 1e-6 of the coefficients are
    left out.

    Parameters
    ----------
    a, b, d : float

    Returns
    -------
    Regions
        A tuple of Region, the unbounded one last. Lines and points, where the portrait is degenerate, are
        `saddle_node` and `critical_boundary`; when det A = 0 the ellipse is a segment and cuts nothing.

    Raises
    ------
    ValueError
        A coefficient is not a finite number.
    """
    a, b, d = matrix(a, b, d)
    plane = Geometry(a, b, d)
    if plane.size == 0.0:
        found = [_region(plane, [], np.zeros((1, 2)), (1.0, 0.0), bounded=False)]
        return Regions(region for region in found if region is not None)
    # a or d of next to nothing is taken for 0: the points of fourfold contact that it parts cannot be told apart
    halves = _arrangement(Geometry(*(0.0 if abs(v) <= _THIN * plane.size else v for v in (a, b, d))))
    loops = _loops(halves, plane)
    thin = _THIN * plane.size
    faces = [[loop] for loop, area in loops if area > thin * _length(loop)]
    outer = [(loop, area) for loop, area in loops if area < 0.0]
    free = [loop for loop, _ in outer]
    between: tuple[float, float] | None = None
    if len(outer) == 2:
        # Two curves that do not meet: that takes a d > 0, and the saddle-node curve lies inside the ellipse. The
        # curves were added in this order, so the first hole and the last face are theirs.
        hole, within = outer[0]
        free.pop(0)
        if abs(outer[1][1]) - abs(within) > thin * _length(hole):
            faces[-1].append(hole)
            between = _between(plane)
        else:
            faces.pop()
    border = np.concatenate([h.points for h in halves[::2]] or [np.zeros((1, 2))])
    found = [_region(plane, loops_, border, between if len(loops_) > 1 else None) for loops_ in faces]
    corner = 1.15 * abs(border).max(axis=0) + 0.1 * plane.size
    found.append(_region(plane, free, border, (float(corner[0]), float(corner[1])), bounded=False))
    return Regions(region for region in found if region is not None)


def _arrangement(plane: Geometry) -> list[_Half]:
    """Half-arcs of both curves; twins are neighbours in the list (2i, 2i + 1)."""
    vertices: list[tuple[float, float]] = []

    def vertex(point: tuple[float, float]) -> int:
        for i, other in enumerate(vertices):
            if math.dist(point, other) <= _SAME * plane.size:
                return i
        vertices.append(point)
        return len(vertices) - 1

    nodes: list[_Stop] = []  # on the saddle-node curve
    others: list[_Stop] = []  # on the ellipse
    point_only = plane.a == plane.d and plane.b == 0.0
    has_nodes = not point_only
    has_ellipse = plane.determinant_sign != 0 and not plane.inseparable
    if has_nodes:
        common = [*plane.touching, *plane.crossing] if has_ellipse else []
        own = [*plane.cusps, *(t for pair in plane.double for t in pair)]
        for theta in (*common, *own):
            nodes.append(_Stop(theta, vertex(plane.saddle_node_at(theta))))  # noqa: PERF401 (vertex grows a list)
        for theta in common:
            point = plane.saddle_node_at(theta)
            others.append(_Stop(plane.on_ellipse(point), vertex(point)))
    halves: list[_Half] = []
    if has_nodes:
        _add_arcs(halves, plane.saddle_node, plane.saddle_node_at, nodes, vertex, plane.size)
    if has_ellipse:
        _add_arcs(halves, plane.ellipse, plane.ellipse_at, others, vertex, plane.size)
    return halves


def _add_arcs(
    halves: list[_Half],
    curve: Callable[[Array], Array],
    at: Callable[[float], tuple[float, float]],
    stops: list[_Stop],
    vertex: Callable[[tuple[float, float]], int],
    size: float,
) -> None:
    if not stops:
        stops = [_Stop(0.0, vertex(at(0.0)))]
    stops = sorted(stops)
    merged = [stops[0]]
    for stop in stops[1:]:
        if stop.vertex != merged[-1].vertex or stop.parameter - merged[-1].parameter > 1e-3:
            merged.append(stop)
    if len(merged) > 1 and merged[-1].vertex == merged[0].vertex and merged[0].parameter + _TAU - merged[-1][0] < 1e-3:
        merged.pop()
    for i, (low, start) in enumerate(merged):
        high, end = merged[i + 1] if i + 1 < len(merged) else (merged[0].parameter + _TAU, merged[0].vertex)
        points = curve(np.linspace(low, high, max(_ARC, math.ceil((high - low) / _TURN) + 1)))
        if start == end and float(abs(points - points[0]).max()) <= _SAME * size:
            continue
        index = len(halves)
        halves.append(_Half(at, low, high, start, end, index + 1, points))
        halves.append(_Half(at, high, low, end, start, index, points[::-1]))


def _loops(halves: list[_Half], plane: Geometry) -> list[tuple[Array, float]]:
    """Borders of all faces, each with its signed area (negative: the outside of a connected piece)."""
    leaving: dict[int, list[int]] = {}
    for i, half in enumerate(halves):
        leaving.setdefault(half.start, []).append(i)
    follow: dict[int, int] = {}
    for around in leaving.values():
        ordered = _anticlockwise(around, halves)
        # arriving by the twin of ordered[i], the next arc with the face on the left is the one clockwise of it
        for i, index in enumerate(ordered):
            follow[halves[index].twin] = ordered[i - 1]
    out = []
    for first in range(len(halves)):
        if halves[first].used:
            continue
        pieces, index = [], first
        while not halves[index].used:
            halves[index].used = True
            pieces.append(halves[index].points[:-1])
            index = follow[index]
        loop = np.concatenate(pieces)
        x, y = (loop / plane.size).T
        x, y = x - x[0], y - y[0]
        area = 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) * plane.size**2
        out.append((loop, area))
    return out


def _anticlockwise(around: list[int], halves: list[_Half]) -> list[int]:
    """Half-arcs leaving a vertex, in anticlockwise order, told apart at one small distance from it.

    At a touching point the directions agree to second order and more: at this distance they still differ by far more
    than rounding.
    """
    if len(around) <= 2:
        return around
    rays = []
    # one origin for all: where nearly coincident points were merged, their small distances still tell the order
    origin = halves[around[0]].at(halves[around[0]].low)
    for i in around:
        half = halves[i]
        step = math.copysign(min(0.05, 0.25 * abs(half.high - half.low)), half.high - half.low)
        rays.append((half.at, half.low, step))
    radius = min(math.dist(at(low + step), origin) for at, low, step in rays)
    angles = []
    for at, low, step in rays:
        # regula falsi (Illinois) for the part of the step that leads as far as the shortest one
        u0, u1, v0, v1 = 0.0, 1.0, -radius, math.dist(at(low + step), origin) - radius
        u = 1.0
        while v1 > 1e-12 * radius:
            u = u1 - v1 * (u1 - u0) / (v1 - v0)
            v = math.dist(at(low + u * step), origin) - radius
            if abs(v) <= 1e-12 * radius or not u0 < u < u1:
                break
            if v > 0.0:
                u1, v1, v0 = u, v, 0.5 * v0
            else:
                u0, v0, v1 = u, v, 0.5 * v1
        x, y = at(low + u * step)
        angles.append(math.atan2(y - origin[1], x - origin[0]))
    return [around[j] for j in sorted(range(len(around)), key=lambda j: angles[j])]


def _length(loop: Array) -> float:
    """Half the perimeter of a closed polygon."""
    return 0.5 * float(np.hypot(*(np.roll(loop, -1, axis=0) - loop).T).sum())


def _between(plane: Geometry) -> tuple[float, float] | None:
    """Find a point between an oval saddle-node curve and the ellipse around it, where they are farthest apart."""
    if plane.cusps:
        return None
    theta = 0.0 if abs(plane.d) >= abs(plane.a) else 0.5 * math.pi  # |Lambda| is |d| and |a| there
    f = plane.saddle_node_at(theta)
    outer = plane.ellipse_at(plane.on_ellipse(f))
    return 0.5 * (f[0] + outer[0]), 0.5 * (f[1] + outer[1])


def _region(
    plane: Geometry,
    boundary: list[Array],
    border: Array,
    known: tuple[float, float] | None = None,
    bounded: bool = True,
) -> Region | None:
    if known is not None:
        inside = known
    else:
        found = _middle(boundary, border)
        if found is None:
            return None
        inside = found
    if locate(_at(plane, inside)).existence is Existence.SINGULAR_LINE:
        # det A = 0: on the line f = A e only, which passes through the region
        inside = _beside(plane, inside, border)
    classification = classify(_at(plane, inside), constant())
    return Region(classification.name, inside, frozen(boundary), bounded, classification)


def _at(plane: Geometry, f: tuple[float, float]) -> Coefficients:
    return Coefficients(plane.a, plane.b, plane.d, *f, *_NOTHING)


def _beside(plane: Geometry, f: tuple[float, float], border: Array) -> tuple[float, float]:
    """Return a point a tenth of the way from the line {A e} to the border."""
    u, v = max((plane.a, plane.b), (-plane.b, plane.d), key=lambda column: math.hypot(*column))
    step = 0.1 * float(np.hypot(border[:, 0] - f[0], border[:, 1] - f[1]).min()) / math.hypot(u, v)
    return f[0] - step * v, f[1] + step * u


def _middle(boundary: list[Array], border: Array) -> tuple[float, float] | None:
    """Find a point well inside closed polygons and far from all curves: the best of the middles of several cuts."""
    edges = np.concatenate([np.concatenate([loop, np.roll(loop, -1, axis=0)], axis=1) for loop in boundary])
    candidates: list[tuple[float, float]] = []
    halves: list[float] = []  # half the width of each cut: the border's points alone would miss how thin a sliver is
    for axis in (0, 1):
        u0, v0, u1, v1 = edges[:, axis], edges[:, 1 - axis], edges[:, 2 + axis], edges[:, 3 - axis]
        low, high = float(boundary[0][:, 1 - axis].min()), float(boundary[0][:, 1 - axis].max())
        levels = low + (high - low) * np.array([0.07, 0.21, 0.35, 0.4987, 0.65, 0.79, 0.93])[:, None]
        spans = (v0 > levels) != (v1 > levels)
        which, at = np.nonzero(spans)
        with np.errstate(invalid="ignore", over="ignore"):
            part = (levels[which, 0] - v0[at]) / (v1[at] - v0[at])
            crossing = (u0[at] + part * (u1[at] - u0[at])).tolist()
        ends = np.searchsorted(which, np.arange(len(levels) + 1)).tolist()
        for k, level in enumerate(levels[:, 0].tolist()):
            row = sorted(v for v in crossing[ends[k] : ends[k + 1]] if v < math.inf)
            pairs = list(zip(row[::2], row[1::2], strict=False))
            if pairs:
                left, right = max(pairs, key=lambda pair: pair[1] - pair[0])
                middle = 0.5 * (left + right)
                candidates.append((middle, level) if axis == 0 else (level, middle))
                halves.append(0.5 * (right - left))
    if not candidates:
        return None
    best, chosen = -1.0, 0
    for i in sorted(range(len(candidates)), key=lambda i: -halves[i]):
        if halves[i] < best:
            break
        u, v = candidates[i]
        width = min(float(np.hypot(u - border[:, 0], v - border[:, 1]).min()), halves[i])
        if width > best or (width == best and i < chosen):
            best, chosen = width, i
    return candidates[chosen]
