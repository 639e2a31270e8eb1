"""Regions of one class between the curves: faces that they cut out of the plane, each named at a place within it."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ...numerics.curves.arclength import distance, feet
from ...results.arrays import Array, read_only
from ..diagrams.classes import Classes, classes_over
from ..families.family import SystemFamily
from .faces import Face, inside_polygons, middle, net_of
from .result import AtlasRegion, SamplingReport

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
    """All regions, by falling area, and what the portrait is where they were looked at.

    Shapes: curves (m, 2).
    """
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
    """Return the faces between lines of the unit square that can be seen, a place in each, and how far its border is.

    Shapes: lines (m, 2), marks (k, 2), that lie on some of them.
    """
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
