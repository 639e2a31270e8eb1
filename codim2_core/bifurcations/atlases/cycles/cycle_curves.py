"""Folds of limit cycles over two parameters of any system.

Seeds of folds of cycles: at generalised Hopf points, and on branches of cycles along a few lines.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np

from ....portrait.cycles.ray_section import TurnSection
from ....portrait.layer_problem.problem import LayerProblem
from ....results.arrays import Array, read_only
from ....results.words import say
from ...continuation.branches import BranchSearch
from ...continuation.turns import ReturnMapPoint, VariedRay, e_at
from ...families.family import SystemFamily
from ..disc_atlas import is_covered, length_of
from ..result import AtlasCurve, AtlasPoint
from .fold_tracing import CENTRE, CORNER, LOG_SIZE_SCALE, CycleStart, EncirclingTurns, FoldCurve, trace_fold

LINE_OFFSETS, HALF_OFFSETS = (0.2871, 0.7137), (0.5871, 0.7713)  # of the square, across and up; of a symmetric one
RAY_STARTS = 0.02, 0.006, 0.06, 2e-3  # of the reach: places on the ray next to a generalised Hopf point that are tried


@dataclass(frozen=True)
class EquilibriumMark:
    """A special value of the equilibria along a line, see `continuation.branch_ends.MarkedValue`."""

    kind: str
    value: float
    place: tuple[float, float]


@dataclass(frozen=True, eq=False)
class FoldSeed:
    """A start, and the size of the cycle there."""

    start: CycleStart
    size: float


def seeds_near_bautin(family: SystemFamily, place: Array) -> list[FoldSeed]:
    """Places where the fold may be caught that begins at a generalised Hopf point."""
    problem = LayerProblem(family.frozen(place), family.psi_at(place))
    neutral = [C for C in problem.critical if C.determinant > 0.0]
    C = min(neutral, key=lambda C: abs(C.trace) / math.sqrt(C.determinant), default=None)
    if C is None:
        return []
    around = EncirclingTurns(family, place, np.asarray(C.e), TurnSection(problem, C).u)
    return [
        FoldSeed(CycleStart(around, np.array([math.log(chi) / LOG_SIZE_SCALE, *place]), fixed=True), chi)
        for chi in RAY_STARTS
    ]


def along_lines(family: SystemFamily, curves: Sequence[AtlasCurve]) -> list[FoldSeed]:
    """Folds on branches of cycles along some lines across the square, among its curves."""
    offsets = HALF_OFFSETS if family.symmetric else LINE_OFFSETS
    return [seed for axis in (0, 1) for at in offsets for seed in _seeds_along(family, curves, axis, at)]


def _seeds_along(family: SystemFamily, curves: Sequence[AtlasCurve], axis: int, at: float) -> list[FoldSeed]:
    def place(value: float) -> Array:
        return np.array([value, at] if axis == 0 else [at, value])

    @cache
    def problem(value: float) -> LayerProblem:
        return LayerProblem(family.frozen(place(value)), family.psi_at(place(value)))

    search = BranchSearch(problem, family.names[axis], (0.0, 1.0), (0.0, 1.0), marks(family, curves, axis, at))
    search.run()
    every = [piece for pieces, *_ in search.found for piece in pieces]
    folds = [(piece.tracer.family, piece.trace.points[k].turn) for piece in every for k in piece.trace.folds]
    return [_seed(family, ray, turn, place(turn.value)) for ray, turn in folds]


def _seed(family: SystemFamily, ray: VariedRay, turn: ReturnMapPoint, where: Array) -> FoldSeed:
    middle, e = (e_at(family.psi_at(where), one.place(turn.value).x2) for one in (ray.centre, ray.foot))
    centre = EncirclingTurns(family, where, middle, ray.u, ray.centre.critical)
    around = EncirclingTurns(family, where, e, ray.u, ray.foot.critical, centre)
    return FoldSeed(CycleStart(around, np.array([turn.xi / LOG_SIZE_SCALE, *where])), turn.amplitude)


def marks(family: SystemFamily, curves: Sequence[AtlasCurve], axis: int, at: float) -> list[EquilibriumMark]:
    """Return where curves of equilibria cross a line."""
    found = []
    for curve in curves:
        plane = family.units(curve.points)
        level = plane[:, 1 - axis] - at
        for i in np.flatnonzero(level[1:] * level[:-1] < 0.0).tolist():
            part = level[i] / (level[i] - level[i + 1])
            value = plane[i, axis] + part * (plane[i + 1, axis] - plane[i, axis])
            p, q = curve.places[i] + part * (curve.places[i + 1] - curve.places[i])
            found.append(EquilibriumMark(curve.kind, float(value), (float(p), float(q))))
    return sorted(found, key=lambda one: one.value)


KIND = "fold of cycles"
GENERALISED_HOPF, SADDLE_NODE_CORNER, NEUTRAL_LOOP = "generalised Hopf", "saddle-node on the equator", "neutral loop"
ON_CURVE_DISTANCE = 0.03  # of the square: a curve passes a start, or ends at a point of codimension two, so near to it
MAX_END_SIZE = 0.05  # of cycles that break off next to a critical set
SAME_SIZE_RATIO = 0.15  # of the size of cycles
CORNER_RADIUS = 0.015  # of the square: a curve that breaks off so near to a corner ends there
BIRTH_DISTANCE = 1e-5  # of the square, from the point at which a curve ends
LOOP_HEIGHT, LOOP_DISTANCE = 0.1, 0.08  # ebar of cycles that are all but a loop; of the square, from a neutral one


def cycle_curves(
    family: SystemFamily, curves: Sequence[AtlasCurve], points: Sequence[AtlasPoint]
) -> tuple[list[AtlasCurve], list[AtlasPoint]]:
    """Find folds of cycles, and the points of codimension two on them.

    They are begun at generalised Hopf points, and at the folds on branches of cycles along some lines each way: one
    that meets none of these is missed. Over a family that is symmetric one of each pair is found.
    """
    known = {
        kind: [family.units(np.array(point.place)) for point in points if point.kind == kind]
        for kind in (GENERALISED_HOPF, SADDLE_NODE_CORNER, NEUTRAL_LOOP)
    }
    if family.symmetric:
        known[NEUTRAL_LOOP] += [1.0 - place for place in known[NEUTRAL_LOOP]]
    corners = known[SADDLE_NODE_CORNER]
    found: list[FoldCurve] = []
    missed = []
    for place in known[GENERALISED_HOPF]:
        if not (family.symmetric and place[1] < 0.5) and not any(_comes_to(one, place) for one in found):
            caught = (trace_fold(family, seed.start, corners) for seed in seeds_near_bautin(family, place))
            first = next((one for one in caught if one is not None), None)
            if first is None:
                missed.append(place)
            else:
                found.append(first)
    for seed in along_lines(family, curves):
        if not any(_passes_seed(one, seed) for one in found):
            one = trace_fold(family, seed.start, corners)
            found += [one] if one is not None else []
    out, special = [], []
    for one in _without_parts(family, found):
        plane, sizes, ends = _extend_to_ends(one, known)
        places = np.full((len(plane), 2), math.nan)
        out.append(AtlasCurve(KIND, read_only(family.values(plane)), read_only(places), read_only(sizes)))
        special += [*ends, *(("cusp of cycles", at, say("cusp of cycles")) for at in one.cusps)]
    special += [
        ("undecided", place, say("fold not caught"))
        for place in missed
        if not any(_comes_to(one, place) for one in found)
    ]
    return out, [AtlasPoint(kind, (float(at[0]), float(at[1])), text)
                 for kind, place, text in special for at in [family.values(place)]]  # fmt: skip


def _without_parts(family: SystemFamily, found: Sequence[FoldCurve]) -> list[FoldCurve]:
    """Leave out what covers a part of a longer curve, or of its image, alone: it was followed from there less far."""
    kept: list[FoldCurve] = []
    for one in sorted(found, key=lambda one: -length_of(one.plane)):
        lines = [line for other in kept for line in (other.plane, 1.0 - other.plane)[: 1 + family.symmetric]]
        if not any(is_covered(one.plane, line) for line in lines):
            kept.append(one)
    return kept


def _passes_seed(curve: FoldCurve, seed: FoldSeed) -> bool:
    near = _away(curve.plane, seed.start.v[1:]) < ON_CURVE_DISTANCE
    return bool((near & (np.abs(curve.sizes - seed.size) < SAME_SIZE_RATIO)).any())


def _comes_to(curve: FoldCurve, place: Array) -> bool:
    ends = [math.dist(curve.plane[i], place) for i in (0, -1) if curve.sizes[i] < MAX_END_SIZE]
    return min(ends, default=math.inf) < ON_CURVE_DISTANCE


def _away(plane: Array, place: Array) -> Array:
    return np.hypot(*(plane - place).T)


def _extend_to_ends(
    one: FoldCurve, known: Mapping[str, Sequence[Array]]
) -> tuple[Array, Array, list[tuple[str, Array, str]]]:
    """Return a curve drawn on to the points of codimension two at its ends, and what is to be said of these."""
    plane, sizes, ends = one.plane, one.sizes, []
    for end, i in zip(one.ends, (0, -1), strict=True):
        last, size = one.plane[i], float(one.sizes[i])
        at, kind, text = _end(end, last, size, float(one.heights[i]), known)
        if at is not None:
            size = 0.0 if kind == GENERALISED_HOPF else size
            away = np.hypot(*(plane - at).T) > BIRTH_DISTANCE  # next to a birth rounding decides
            plane, sizes = plane[away], sizes[away]
            plane = np.concatenate([at[None], plane] if i == 0 else [plane, at[None]])
            sizes = np.concatenate([[size], sizes] if i == 0 else [sizes, [size]])
        if text:
            ends.append((kind, last if at is None else at, text))
    return plane, sizes, ends


def _end(
    end: str, last: Array, size: float, height: float, known: Mapping[str, Sequence[Array]]
) -> tuple[Array | None, str, str]:
    """Return the point at which a curve ends, its kind, and what is said there."""

    def nearest(kind: str, reach: float) -> Array | None:
        near = min(known[kind], key=lambda at: math.dist(at, last), default=None)
        return near if near is not None and math.dist(near, last) < reach else None

    if end not in (CENTRE, CORNER, "equator", "lost", "many"):
        return None, "", ""
    if end == CENTRE or size < MAX_END_SIZE:
        born = nearest(GENERALISED_HOPF, ON_CURVE_DISTANCE)
        if born is not None:
            return born, GENERALISED_HOPF, ""
    corner = nearest(SADDLE_NODE_CORNER, CORNER_RADIUS)
    if corner is not None:
        return corner, "touching", say("fold ends, saddle-node")
    # towards a neutral loop the fold runs along the curve of loops, closer than any power
    loop = nearest(NEUTRAL_LOOP, LOOP_DISTANCE) if height < LOOP_HEIGHT else None
    if loop is not None:
        return loop, "resonant loop", say("fold ends, neutral loop")
    if end == "equator":
        return None, "equator", say("fold reaches the equator")
    return None, "undecided", say("fold followed no further")
