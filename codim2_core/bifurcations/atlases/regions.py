"""Regions of one class between the curves: faces that they cut out of the plane, each named at a place within it.

The lines are split where they cross, and loose ends are left out.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ...numerics.arclength import distance, feet
from ...results.arrays import Array, read_only
from ..diagrams.classes import Classes, classes_over
from ..families.family import SystemFamily
from .result import AtlasRegion, SamplingReport

Edge = tuple[int, int]

FRAME = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]])
END_EXTENSION = 1e-6  # that lines go on beyond their ends, so that they cross what they end on
LINE_END_DISTANCE = 6e-3  # a line that ends so near to another ends on it
PLACE_DIGITS = 9  # of places: nearer ones are one
ON_PIECE_DISTANCE = 2e-9  # a place so near to a piece lies on it
CHUNK_SIZE = 256
OFF_CENTRE = 0.479  # of a stretch across a face: its middle is a round number where the face has a symmetry
INTERIOR_LINES = 24  # across a face, along which a place far from its border is looked for


@dataclass(frozen=True, eq=False)
class Face:
    """A face."""

    rings: tuple[Array, ...]  # (m, 2) The outer one anticlockwise, holes clockwise; the first point is not repeated
    edges: tuple[Edge, ...]  # directed edges of all rings, with the face on their left

    @property
    def area(self) -> float:
        """Area without the holes."""
        return sum(area(ring) for ring in self.rings)


@dataclass(frozen=True, eq=False)
class EdgeNet:
    """Places (k, 2), and the edges between them, each once."""

    places: Array
    edges: frozenset[Edge]

    def without(self, edges: set[Edge]) -> EdgeNet:
        """Leave out some edges, given in either direction."""
        both = edges | {(v, u) for u, v in edges}
        return EdgeNet(self.places, frozenset(edge for edge in self.edges if edge not in both))

    def faces(self) -> list[Face]:
        """All bounded faces."""
        near: dict[int, set[int]] = {}
        for u, v in self.edges:
            near.setdefault(u, set()).add(v)
            near.setdefault(v, set()).add(u)
        loose = [u for u, others in near.items() if len(others) == 1]
        while loose:
            u = loose.pop()
            for v in near.pop(u, set()):
                near[v].discard(u)
                if len(near[v]) == 1:
                    loose.append(v)
        return _bounded_faces(self.places, _rings(self.places, near))


def area(ring: Array) -> float:
    """Signed area of a polygon."""
    x, y = (ring - ring[0]).T
    return 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1))


def net_of(lines: Sequence[Array]) -> EdgeNet:
    """Cut lines (m, 2) of the unit square, and its frame, where they cross."""
    every = [FRAME, *(_extend_to_lines(i, lines) for i in range(len(lines)))]
    start = np.concatenate([line[:-1] for line in every])
    end = np.concatenate([line[1:] for line in every])
    of = np.concatenate([np.full(len(line) - 1, i) for i, line in enumerate(every)])
    numbers: dict[tuple[float, float], int] = {}
    places: list[tuple[float, float]] = []

    def number(x: float, y: float) -> int:
        x, y = min(max(x, 0.0), 1.0), min(max(y, 0.0), 1.0)
        key = round(x, PLACE_DIGITS) + 0.0, round(y, PLACE_DIGITS) + 0.0
        if key not in numbers:
            numbers[key] = len(places)
            places.append((x, y))
        return numbers[key]

    on: list[list[tuple[float, int]]] = [
        [(0.0, number(*one)), (1.0, number(*other))] for one, other in zip(start.tolist(), end.tolist(), strict=True)
    ]
    for i, j, t, w in _piece_crossings(start, end, of):
        at = number(*(start[i] + t * (end[i] - start[i])).tolist())
        on[i].append((t, at))
        on[j].append((w, at))
    for i, j, t in _touches(np.array(places), start, end):
        on[i].append((t, j))
    edges = set()
    for points in on:
        chain = [at for _, at in sorted(points)]
        edges |= {(min(u, v), max(u, v)) for u, v in pairwise(chain) if u != v}
    return EdgeNet(np.array(places), frozenset(edges))


def _extend_to_lines(i: int, lines: Sequence[Array]) -> Array:
    """Return a line, drawn on to what its ends all but reach."""
    line = lines[i]
    if np.abs(line[0] - line[-1]).max() < END_EXTENSION:
        return line
    ahead, behind = _onward(line[-1], line[-2], i, lines), _onward(line[0], line[1], i, lines)
    return np.concatenate([behind[None], line, ahead[None]])


def _onward(end: Array, before: Array, i: int, lines: Sequence[Array]) -> Array:
    way = (end - before) / max(math.dist(end, before), 1e-300)
    if min(end.min(), 1.0 - end.max()) < END_EXTENSION:  # on the frame: straight out of it
        return np.where(
            end < END_EXTENSION, -END_EXTENSION, np.where(end > 1.0 - END_EXTENSION, 1.0 + END_EXTENSION, end)
        )
    best, least = end + END_EXTENSION * way, LINE_END_DISTANCE
    for k, other in enumerate(lines):
        if k == i:
            continue
        _, foot, gap = feet(end, other)
        j = int(gap.argmin())
        if gap[j] < least:
            least = float(gap[j])
            best = foot[j] + END_EXTENSION * ((foot[j] - end) / least if least > END_EXTENSION else way)
    return best


def _piece_crossings(start: Array, end: Array, of: NDArray[np.intp]) -> list[tuple[int, int, float, float]]:
    """Pieces i < j that cross, and at which parts of both."""
    along = end - start
    found: list[tuple[int, int, float, float]] = []
    rows = np.arange(len(start))
    for i in range(0, len(start), CHUNK_SIZE):
        own = rows[i : i + CHUNK_SIZE, None]
        away = start[None] - start[own[:, 0], None]
        r, s = along[own[:, 0], None], along[None]
        across = r[..., 0] * s[..., 1] - r[..., 1] * s[..., 0]
        with np.errstate(divide="ignore", invalid="ignore"):
            t = (away[..., 0] * s[..., 1] - away[..., 1] * s[..., 0]) / across
            w = (away[..., 0] * r[..., 1] - away[..., 1] * r[..., 0]) / across
        met = (rows > own) & (t >= 0.0) & (t <= 1.0) & (w >= 0.0) & (w <= 1.0)
        met &= ~((of[own] == of[None]) & (rows == own + 1))
        for k, j in np.argwhere(met).tolist():
            found.append((i + k, j, float(t[k, j]), float(w[k, j])))
    return found


def _touches(places: Array, start: Array, end: Array) -> list[tuple[int, int, float]]:
    """Pieces, the places that lie within them, and at which part: lines may run along each other or along the frame."""
    along = end - start
    size = np.maximum(np.sqrt((along**2).sum(axis=1)), 1e-100)
    found: list[tuple[int, int, float]] = []
    for i in range(0, len(start), CHUNK_SIZE):
        r, own = along[i : i + CHUNK_SIZE, None], size[i : i + CHUNK_SIZE, None]
        away = places[None] - start[i : i + CHUNK_SIZE, None]
        part = (away * r).sum(axis=2) / own**2
        gap = np.abs(away[..., 0] * r[..., 1] - away[..., 1] * r[..., 0]) / own
        met = (gap < ON_PIECE_DISTANCE) & (part * own > ON_PIECE_DISTANCE) & ((1.0 - part) * own > ON_PIECE_DISTANCE)
        found += [(i + k, j, float(part[k, j])) for k, j in np.argwhere(met).tolist()]
    return found


def _rings(places: Array, near: dict[int, set[int]]) -> list[list[int]]:
    """All closed ways along edges that keep to what is on their left."""
    after: dict[Edge, int] = {}
    for v, others in near.items():
        x, y = places[v]
        turn = sorted(others, key=lambda u, x=x, y=y: math.atan2(places[u][1] - y, places[u][0] - x))
        for k, u in enumerate(turn):
            after[u, v] = turn[k - 1]  # coming from u, the next one clockwise
    rings = []
    while after:
        (u, v), then = after.popitem()
        ring, here = [u, v], then
        while (ring[-1], here) in after:
            ring.append(here)
            here = after.pop((ring[-2], ring[-1]))
        rings.append(ring[:-1] if ring[-1] == ring[0] else ring)
    return rings


def _bounded_faces(places: Array, rings: list[list[int]]) -> list[Face]:
    shapes = [places[ring] for ring in rings]
    sizes = [area(shape) for shape in shapes]
    outer = sorted((i for i, size in enumerate(sizes) if size > 0.0), key=lambda i: sizes[i])
    holes: dict[int, list[int]] = {i: [] for i in outer}
    for i, size in enumerate(sizes):
        if size > 0.0:
            continue
        corners = set(rings[i])
        for k in outer:  # the smallest one around it that is no part of the same lines
            if sizes[k] > -size and not corners & set(rings[k]) and inside_polygons(shapes[i][:1], [shapes[k]])[0]:
                holes[k].append(i)
                break
    out = []
    for k in outer:
        own = [k, *holes[k]]
        edges = tuple((u, v) for i in own for u, v in zip(rings[i], rings[i][1:] + rings[i][:1], strict=True))
        out.append(Face(tuple(shapes[i] for i in own), edges))
    return out


def inside_polygons(points: Array, rings: Sequence[Array]) -> NDArray[np.bool_]:
    """Whether points (k, 2) lie within polygons, holes being polygons too."""
    inside = np.zeros(len(points), bool)
    x, y = points[:, 0, None], points[:, 1, None]
    for ring in rings:
        (x0, y0), (x1, y1) = ring.T, np.roll(ring, -1, axis=0).T
        with np.errstate(divide="ignore", invalid="ignore"):
            crossed = ((y0 > y) != (y1 > y)) & (x < x0 + (y - y0) / (y1 - y0) * (x1 - x0))
        inside ^= crossed.sum(axis=1) % 2 == 1
    return inside


def middle(face: Face) -> tuple[Array, float]:
    """Find a place well inside a face, and how far its border is."""
    candidates = np.concatenate([_chords(face.rings, axis) for axis in (0, 1)])
    if not len(candidates):
        return face.rings[0].mean(axis=0), 0.0
    least = np.full(len(candidates), math.inf)
    for ring in face.rings:
        least = np.minimum(least, distance(candidates, np.concatenate([ring, ring[:1]])))
    best = int(least.argmax())
    return candidates[best], float(least[best])


def _chords(rings: Sequence[Array], axis: int) -> Array:
    """Places (k, 2) near the middles of stretches within polygons on lines along one axis."""
    low, high = rings[0][:, 1 - axis].min(), rings[0][:, 1 - axis].max()
    level = low + (high - low) * (np.arange(INTERIOR_LINES)[:, None] + 0.5137) / INTERIOR_LINES
    start, end = np.concatenate(rings), np.concatenate([np.roll(ring, -1, axis=0) for ring in rings])
    (p0, q0), (p1, q1) = start[:, [axis, 1 - axis]].T, end[:, [axis, 1 - axis]].T
    line, piece = np.nonzero((q0 > level) != (q1 > level))
    share = (level[line, 0] - q0[piece]) / (q1[piece] - q0[piece])
    crossed = p0[piece] + share * (p1[piece] - p0[piece])
    order = np.lexsort((crossed, line))  # an even number on each line
    one, other = crossed[order][::2], crossed[order][1::2]
    found = np.stack([one + OFF_CENTRE * (other - one), level[line[order][::2], 0]], axis=-1)
    return found if axis == 0 else found[:, ::-1]


CHORD_DISTANCE = 1e-3  # of the ranges: a point that is as near as this to a curve's chord lies on the curve
MIN_CURVE_DISTANCE = 0.01  # of the ranges: nearer to a curve than this nothing is compared
NET_OFFSETS = (np.arange(5) + 0.5) / 5.0 + 0.013 * np.sin(np.arange(1.0, 6.0))  # along the edges, off round numbers
SCATTER = np.array(
    [0.7548776662466927, 0.5698402909980532]
)  # steps of a sequence that leaves no strip of the square empty
SCATTERED_PLACES = 40
EDGE_INSET = 5e-4  # of the ranges: how far from their borders these are looked along
EDGE_OFFSETS = np.array([EDGE_INSET, 1.0 - EDGE_INSET])
NET: Array = np.concatenate([
    np.asarray((0.7 + np.arange(1, SCATTERED_PLACES + 1)[:, None] * SCATTER) % 1.0, float),
    *(np.stack(np.meshgrid(one, other, indexing="ij"), axis=-1).reshape(-1, 2)
      for one, other in ((EDGE_OFFSETS, NET_OFFSETS), (NET_OFFSETS, EDGE_OFFSETS), (EDGE_OFFSETS, EDGE_OFFSETS))),
])  # fmt: skip
MIN_HALF_WIDTH = 2e-4  # of the ranges: what is nowhere wider than twice this is given to a neighbour


def regions_of(
    family: SystemFamily, curves: Sequence[Array], points: Sequence[tuple[float, float]]
) -> tuple[tuple[AtlasRegion, ...], SamplingReport]:
    """All regions, by falling area, and what the portrait is where they were looked at; curves (m, 2)."""
    lines = [family.units(line) for line in curves]
    marks = family.units(np.reshape(points, (-1, 2)))
    net = net_of([_insert_marks(line, marks) for line in lines])
    faces = net.faces()
    found = [middle(face) for face in faces]
    classes = classes_over(family.system, family.psi, family.z, family.names, family.ranges)
    wide = [i for i, (_, room) in enumerate(found) if room > MIN_HALF_WIDTH]
    codes = classes.decided(family.values(np.array([found[i][0] for i in wide]).reshape(-1, 2)))
    code = dict(zip(wide, codes.tolist(), strict=True))
    owner = {edge: i for i, face in enumerate(faces) for edge in face.edges}
    _give(faces, owner, code)
    left = [i for i in range(len(faces)) if i not in code]
    codes = classes.decided(family.values(np.array([found[i][0] for i in left]).reshape(-1, 2)))
    code.update(zip(left, codes.tolist(), strict=True))
    same = {(u, v) for (u, v), i in owner.items() if (v, u) in owner and code[owner[v, u]] == code[i]}
    out, kinds = [], []
    joined = net.without(same).faces()
    for face in joined:
        at, _ = middle(face)
        kind = code[next(owner[edge] for edge in face.edges if edge in owner)]
        boundary = tuple(read_only(family.values(ring)) for ring in face.rings)
        place = family.values(at)
        area = face.area * float(np.prod(family.widths))
        out.append(AtlasRegion(classes.name(kind), (float(place[0]), float(place[1])), area, boundary))
        kinds.append(kind)
    unlike = _unlike(family, classes, joined, kinds, lines)
    looked = SamplingReport(len(wide) + len(NET), unlike, classes.unproved)
    return tuple(sorted(out, key=lambda region: -region.area)), looked


def faces_between(lines: Sequence[Array], marks: Array) -> list[tuple[Face, Array, float]]:
    """Return the faces between lines (m, 2) with marks (k, 2), a place in each, and how far its border is."""
    found = [(face, *middle(face)) for face in net_of([_insert_marks(line, marks) for line in lines]).faces()]
    return [one for one in found if one[2] > MIN_HALF_WIDTH]


def _unlike(
    family: SystemFamily, classes: Classes, faces: Sequence[Face], kinds: Sequence[int], lines: Sequence[Array]
) -> tuple[tuple[float, float], ...]:
    """Places all over the square and along its edges, away from curves, whose class is not that of their region."""
    codes = classes.decided(family.values(NET)).tolist()
    near = np.zeros(len(NET), bool)
    for line in lines:
        near |= distance(NET, line) < MIN_CURVE_DISTANCE
    owner = np.full(len(NET), -1)
    for i, face in enumerate(faces):
        owner[inside_polygons(NET, face.rings)] = i
    return tuple(
        (float(x), float(y))
        for (x, y), code, is_near, i in zip(family.values(NET), codes, near, owner.tolist(), strict=True)
        if not is_near and i >= 0 and code != kinds[i]
    )


def _insert_marks(line: Array, marks: Array) -> Array:
    """Put those of some points into a line on which they lie, but for its bends: also at a tip, between two of its."""
    added: list[tuple[float, Array]] = []
    for mark in marks:
        part, _, gap = feet(mark, line)
        i = int(gap.argmin())
        if not gap[i] < CHORD_DISTANCE:
            continue
        where = i + float(part[i])
        if where == round(where) and 0 < (k := round(where)) < len(line) - 1 and gap[i] > 0.0:
            where += 0.5 if _detour(line[k], mark, line[k + 1]) < _detour(line[k - 1], mark, line[k]) else -0.5  # a tip
        if where != round(where):
            added.append((where, mark))
    for where, mark in sorted(added, key=lambda pair: -pair[0]):
        line = np.insert(line, int(where) + 1, mark, axis=0)
    return line


def _detour(before: Array, point: Array, after: Array) -> float:
    """Return how much longer the way between two points is by way of another."""
    return math.dist(before, point) + math.dist(point, after) - math.dist(before, after)


def _give(faces: Sequence[Face], owner: dict[tuple[int, int], int], code: dict[int, int]) -> None:
    """Give what is too thin to be named the class of the neighbour with which it shares most edges, if one is wide."""
    wide = set(code)
    for i in set(range(len(faces))) - wide:
        votes: dict[int, int] = {}
        for u, v in faces[i].edges:
            other = owner.get((v, u))
            if other is not None and other in wide:
                votes[code[other]] = votes.get(code[other], 0) + 1
        if votes:
            code[i] = max(votes, key=lambda kind: votes[kind])
