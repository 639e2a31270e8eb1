"""The saddle-node curve and the ellipse |A^-1 f| = 1 as a planar graph of (f1, f2): its arcs, and the borders of faces.

Its vertices are known in closed form (`Geometry`), and every arc between neighbours is smooth.
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
ARC = 33  # points drawn along an arc, and more where it turns by more than a degree from one to the next
TURN = TAU / 360
SAME = 1e-9  # of the size: points of the two curves nearer than this are one vertex
ROUNDS = 60  # of Newton's method between bounds


class _Stop(NamedTuple):
    """A parameter value on a curve at a vertex."""

    parameter: float
    vertex: int


@dataclass
class Half:
    """An arc in one direction: from `start` to `end`, with the face on its left."""

    on_ellipse: bool  # or on the saddle-node curve
    low: float  # parameter at its start, and at its end
    high: float
    start: int
    end: int
    twin: int
    points: Array
    used: bool = field(default=False)


def arrangement(plane: Geometry) -> list[Half]:
    """Return the half-arcs of both curves; twins are neighbours in the list (2i, 2i + 1).

    Parameters
    ----------
    plane : Geometry
    """
    vertices: list[tuple[float, float]] = []

    def vertex(point: tuple[float, float]) -> int:
        for i, other in enumerate(vertices):
            if math.dist(point, other) <= SAME * plane.size:
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
    halves: list[Half] = []
    if has_nodes:
        _add_arcs(halves, plane, False, nodes, vertex)
    if has_ellipse:
        _add_arcs(halves, plane, True, others, vertex)
    return halves


def _add_arcs(
    halves: list[Half],
    plane: Geometry,
    on_ellipse: bool,
    stops: list[_Stop],
    vertex: Callable[[tuple[float, float]], int],
) -> None:
    curve = plane.ellipse if on_ellipse else plane.saddle_node
    if not stops:
        stops = [_Stop(0.0, vertex((plane.ellipse_at if on_ellipse else plane.saddle_node_at)(0.0)))]
    stops = sorted(stops)
    merged = [stops[0]]
    for stop in stops[1:]:
        if stop.vertex != merged[-1].vertex or stop.parameter - merged[-1].parameter > 1e-3:
            merged.append(stop)
    if len(merged) > 1 and merged[-1].vertex == merged[0].vertex and merged[0].parameter + TAU - merged[-1][0] < 1e-3:
        merged.pop()
    for i, (low, start) in enumerate(merged):
        high, end = merged[i + 1] if i + 1 < len(merged) else (merged[0].parameter + TAU, merged[0].vertex)
        points = curve(np.linspace(low, high, max(ARC, math.ceil((high - low) / TURN) + 1)))
        if start == end and float(abs(points - points[0]).max()) <= SAME * plane.size:
            continue
        index = len(halves)
        halves.append(Half(on_ellipse, low, high, start, end, index + 1, points))
        halves.append(Half(on_ellipse, high, low, end, start, index, points[::-1]))


def borders(halves: list[Half], plane: Geometry) -> list[tuple[Array, float]]:
    """Return the borders of all faces, each with its signed area (negative: the outside of a connected piece).

    Parameters
    ----------
    halves : list of Half
        As `arrangement` gives them.
    plane : Geometry
    """
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


def _anticlockwise(halves: list[Half], plane: Geometry) -> list[list[int]]:
    """Half-arcs leaving each vertex, in anticlockwise order, told apart at one small distance from it.

    At a touching point the directions agree to second order and more: at this distance they still differ by far more
    than rounding.
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
    angles = dict(zip((i for around in crowded for i in around), _leaving(rays, counts, starts, plane), strict=True))
    return [sorted(around, key=angles.__getitem__) if len(around) > 2 else around for around in groups]


def _leaving(rays: list[Half], counts: list[int], starts: NDArray[np.intp], plane: Geometry) -> list[float]:
    """Angles at which arcs are seen from the vertices that they leave, so many from each, at one distance from it."""
    group = np.repeat(np.arange(len(counts)), counts)
    round_, low = np.array([ray.on_ellipse for ray in rays]), np.array([ray.low for ray in rays])
    way = np.array([ray.high for ray in rays]) - low
    step = np.copysign(np.minimum(0.05, 0.25 * np.abs(way)), way)
    # one origin for all: where nearly coincident points were merged, their small distances still tell the order
    origin = _on_curves(plane, round_, low)[0][:, starts[group]]
    x, y = _on_curves(plane, round_, low + step)[0] - origin
    reach = np.hypot(x, y)
    radius = np.minimum.reduceat(reach, starts)[group]
    # Newton's method, kept between bounds, for the part of the step that leads as far as the shortest one
    u, below, above = np.ones(len(rays)), np.zeros(len(rays)), np.ones(len(rays))
    for _ in range(ROUNDS):
        places, tangents = _on_curves(plane, round_, low + u * step)
        x, y = places - origin
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


def _on_curves(plane: Geometry, on_ellipse: NDArray[np.bool_], parameter: Array) -> tuple[Array, Array]:
    """Points (2, n) of both curves, and their derivatives by the parameter."""
    c, s = np.cos(parameter), np.sin(parameter)
    a, b, d, k = plane.a, plane.b, plane.d, plane.k
    places = np.where(on_ellipse, (b * s - a * c, -b * c - d * s), (b * s - k * c**3, k * s**3 - b * c))
    turn = b + 3.0 * k * s * c
    return places, np.where(on_ellipse, (b * c + a * s, b * s - d * c), (turn * c, turn * s))
