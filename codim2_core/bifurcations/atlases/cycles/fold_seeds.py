"""Seeds of folds of cycles: at generalised Hopf points, and on branches of cycles along a few lines."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np

from ....portrait.cycles.ray_section import TurnSection
from ....portrait.layer_problem.problem import LayerProblem
from ....results.arrays import Array
from ...continuation.branches import BranchSearch
from ...continuation.continuation_points import ReturnMapPoint
from ...continuation.section_base import e_at
from ...continuation.turns import VariedRay
from ...families.family import SystemFamily
from ..result import AtlasCurve
from .encircling_turns import LOG_SIZE_SCALE, EncirclingTurns
from .fold_tracing import CycleStart

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
