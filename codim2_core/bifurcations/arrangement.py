"""The saddle-node curve and the ellipse |A^-1 f| = 1 as a planar graph of (f1, f2): its arcs, and the borders of faces.

Its vertices are known in closed form (`Geometry`), and every arc between neighbours is smooth. Where arcs of the two
curves touch, angles do not tell them apart: at a fourfold contact (a or d is 0) they differ by the third power of the
distance, and a cusp all but there leaves next to no distance. On the saddle-node curve

    |A^-1 f|^2 - 1 = Lambda^2 (|adj(A) e|^2 - 2 det A) / det(A)^2

and the bracket changes its sign at crossings only, which are vertices: so an arc of it is inside or outside the ellipse
as a whole, and that is known without a comparison of what is nearly equal.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .curve import Array
from .geometry import Geometry

TAU = 2.0 * math.pi
ARC_POINTS = 33  # points drawn along an arc, and more where it turns by more than a degree from one to the next
ARC_STEP = TAU / 360
SAME_VERTEX_DISTANCE = 1e-9  # of the size: points of the two curves nearer than this are one vertex
MAX_ROUNDS = 60  # of Newton's method between bounds
MIN_ARC_ANGLE = 0.01  # angle between arcs of the two curves below which it is inside or outside that tells their order


class _Vertex(NamedTuple):
    """A parameter value on a curve at a vertex, and its point: for both curves the same one."""

    parameter: float
    vertex: int
    point: tuple[float, float]


@dataclass
class HalfEdge:
    """An arc in one direction: from `start` to `end`, with the face on its left."""

    on_ellipse: bool  # or on the saddle-node curve
    low: float  # parameter at its start, and at its end
    high: float
    start: int
    end: int
    twin: int
    origin: tuple[float, float]  # its point at `low`
    points: Array
    used: bool = field(default=False)

    @property
    def middle(self) -> float:
        """The parameter half way."""
        return 0.5 * (self.low + self.high)


def arrangement(plane: Geometry) -> list[HalfEdge]:
    """Return the half-arcs of both curves; twins are neighbours in the list (2i, 2i + 1)."""
    vertices: list[tuple[float, float]] = []

    def vertex(point: tuple[float, float]) -> int:
        for i, other in enumerate(vertices):
            if math.dist(point, other) <= SAME_VERTEX_DISTANCE * plane.size:
                return i
        vertices.append(point)
        return len(vertices) - 1

    nodes: list[_Vertex] = []  # on the saddle-node curve
    others: list[_Vertex] = []  # on the ellipse
    point_only = plane.a == plane.d and plane.b == 0.0
    has_nodes = not point_only
    has_ellipse = plane.determinant_sign != 0 and not plane.inseparable
    if has_nodes:
        common = [*plane.touching, *plane.crossing] if has_ellipse else []
        own = [*plane.cusps, *(t for pair in plane.double for t in pair)]
        for theta in (*common, *own):
            point = plane.saddle_node_at(theta)
            nodes.append(_Vertex(theta, vertex(point), point))
        for theta in common:
            point = plane.saddle_node_at(theta)
            others.append(_Vertex(plane.meeting(theta), vertex(point), point))
    halves: list[HalfEdge] = []
    if has_nodes:
        _add_arcs(halves, plane, False, nodes, vertex)
    if has_ellipse:
        _add_arcs(halves, plane, True, others, vertex)
    return halves


def _add_arcs(
    halves: list[HalfEdge],
    plane: Geometry,
    on_ellipse: bool,
    stops: list[_Vertex],
    vertex: Callable[[tuple[float, float]], int],
) -> None:
    curve = plane.ellipse if on_ellipse else plane.saddle_node
    if not stops:
        point = (plane.ellipse_at if on_ellipse else plane.saddle_node_at)(0.0)
        stops = [_Vertex(0.0, vertex(point), point)]
    stops = sorted(stops)
    merged = [stops[0]]
    for stop in stops[1:]:
        if stop.vertex != merged[-1].vertex or stop.parameter - merged[-1].parameter > 1e-3:
            merged.append(stop)
    if len(merged) > 1 and merged[-1].vertex == merged[0].vertex and merged[0].parameter + TAU - merged[-1][0] < 1e-3:
        merged.pop()
    for i, (low, start, origin) in enumerate(merged):
        turned = merged[0]._replace(parameter=merged[0].parameter + TAU)
        high, end, there = merged[i + 1] if i + 1 < len(merged) else turned
        points = curve(np.linspace(low, high, max(ARC_POINTS, math.ceil((high - low) / ARC_STEP) + 1)))
        if start == end and float(abs(points - points[0]).max()) <= SAME_VERTEX_DISTANCE * plane.size:
            continue
        index = len(halves)
        halves.append(HalfEdge(on_ellipse, low, high, start, end, index + 1, origin, points))
        halves.append(HalfEdge(on_ellipse, high, low, end, start, index, there, points[::-1]))


def face_borders(halves: list[HalfEdge], plane: Geometry) -> list[tuple[Array, float]]:
    """Return the borders of all faces, each with its signed area (negative: the outside of a connected piece)."""
    follow: dict[int, int] = {}
    for ordered in _anticlockwise(halves, plane):
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


def _anticlockwise(halves: list[HalfEdge], plane: Geometry) -> list[list[int]]:
    """Half-arcs leaving each vertex, in anticlockwise order: as they are seen at one small distance from it.

    Of two arcs in nearly one direction, that of the saddle-node curve is on the left of the ellipse's, or on its right,
    as it is inside or outside.
    """
    leaving: dict[int, list[int]] = {}
    for i, half in enumerate(halves):
        leaving.setdefault(half.start, []).append(i)
    groups = list(leaving.values())
    crowded = [around for around in groups if len(around) > 2]
    if not crowded:
        return groups
    rays = [halves[i] for around in crowded for i in around]
    counts = [len(around) for around in crowded]
    starts = np.cumsum([0, *counts[:-1]])
    angles = dict(
        zip((i for around in crowded for i in around), _leaving_angles(rays, counts, starts, plane), strict=True)
    )

    def order_around(around: list[int]) -> list[int]:
        if len(around) <= 2:
            return around
        round_ = [i for i in around if halves[i].on_ellipse]

        def key(i: int) -> tuple[float, float, float]:
            aside = [(math.remainder(angles[i] - angles[j], TAU), j) for j in round_ if not halves[i].on_ellipse]
            off, beside = min(aside, key=lambda pair: abs(pair[0]), default=(math.inf, i))
            if abs(off) > MIN_ARC_ANGLE:
                return angles[i], 0.0, 0.0
            return angles[beside], plane.outside(halves[i].middle) * _turning_right(halves[beside], plane), off

        return sorted(around, key=key)

    return [order_around(around) for around in groups]


def _turning_right(half: HalfEdge, plane: Geometry) -> float:
    """1 where the outside of the ellipse is on the left of a half-arc of it, else -1."""
    return -math.copysign(1.0, (half.high - half.low) * plane.determinant_sign)


def _leaving_angles(rays: list[HalfEdge], counts: list[int], starts: NDArray[np.intp], plane: Geometry) -> list[float]:
    """Angles at which arcs are seen from the vertices that they leave, so many from each, at one distance from it."""
    group = np.repeat(np.arange(len(counts)), counts)
    round_, low = np.array([ray.on_ellipse for ray in rays]), np.array([ray.low for ray in rays])
    way = np.array([ray.high for ray in rays]) - low
    step = np.copysign(np.minimum(0.05, 0.25 * np.abs(way)), way)
    # one origin for all: where nearly coincident points were merged, their small distances still tell the order
    origins = np.array([ray.origin for ray in rays]).T
    offset = origins - origins[:, starts[group]]
    x, y = offset + _along_curves(plane, round_, low, step)[0]
    reach = np.hypot(x, y)
    radius = np.minimum.reduceat(reach, starts)[group]
    # Newton's method, kept between bounds, for the part of the step that leads as far as the shortest one
    u, below, above = np.ones(len(rays)), np.zeros(len(rays)), np.ones(len(rays))
    for _ in range(MAX_ROUNDS):
        way, tangents = _along_curves(plane, round_, low, u * step)
        x, y = offset + way
        distance = np.hypot(x, y)
        beyond = distance - radius
        open_ = np.abs(beyond) > 1e-12 * radius
        if not open_.any():
            break
        below, above = np.where(beyond < 0.0, u, below), np.where(beyond > 0.0, u, above)
        with np.errstate(invalid="ignore", divide="ignore"):
            new = u - beyond * distance / ((x * tangents[0] + y * tangents[1]) * step)
        new = np.where((below < new) & (new < above), new, 0.5 * (below + above))
        u = np.where(open_, new, u)
    return np.arctan2(y, x).tolist()


def _along_curves(plane: Geometry, on_ellipse: NDArray[np.bool_], start: Array, change: Array) -> tuple[Array, Array]:
    """Differences (2, n) of points of both curves, by their parameters' change, and their derivatives by it.

    As products, which keep their digits where the change is small.
    """
    a, b, d, k = plane.a, plane.b, plane.d, plane.k
    chord, m = 2.0 * np.sin(0.5 * change), start + 0.5 * change
    c, s = np.cos(m), np.sin(m)
    third = 0.25 * (1.0 + 2.0 * np.cos(change))
    across = b * c + k * (0.75 * s + third * np.sin(3.0 * m)), b * s + k * (0.75 * c - third * np.cos(3.0 * m))
    ways = chord * np.where(on_ellipse, (b * c + a * s, b * s - d * c), across)
    c, s = np.cos(start + change), np.sin(start + change)
    turn = b + 3.0 * k * s * c
    return ways, np.where(on_ellipse, (b * c + a * s, b * s - d * c), (turn * c, turn * s))
