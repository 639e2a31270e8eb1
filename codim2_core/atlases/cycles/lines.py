"""Seeds of folds of cycles: at generalised Hopf points, and on branches of cycles along a few lines."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from ...continuation.turns import Turn
from ...continuation.typed.family import VariedRay
from ...continuation.typed.foot import e_at
from ...continuation.typed.search import Search
from ...cycles.turn_section import TurnSection
from ...layer_problem.critical import critical_sets
from ...psi.function import Psi
from ...systems.frozen import AtZ
from ..family import Family
from ..result import AtlasCurve
from .around import SCALE, Around
from .following import Start

Array = NDArray[np.float64]

LINES = (0.2871, 0.7137)  # of the square, across and up
CHI = 0.03, 0.01, 0.08  # of the reach: places on the ray beside a generalised Hopf point that are tried


@dataclass(frozen=True)
class Mark:
    """A special value of what stands still along a line, see `continuation.typed.ends.Marked`."""

    kind: str
    value: float
    place: tuple[float, float]


@dataclass(frozen=True, eq=False)
class Seed:
    """A start, and the size of the cycle there."""

    start: Start
    size: float


def seeds_beside_bautin(family: Family, place: Array) -> list[Seed]:
    """Places where the fold may be caught that begins at a generalised Hopf point."""
    at, psi = family.frozen(place), family.psi_at(place)
    critical = critical_sets(at, psi)
    neutral = [C for C in critical if C.determinant > 0.0]
    C = min(neutral, key=lambda C: abs(C.trace) / math.sqrt(C.determinant), default=None)
    if C is None:
        return []
    around = Around(family, place, np.asarray(C.e), TurnSection(at, psi, C, critical).u)
    return [Seed(Start(around, np.array([math.log(chi) / SCALE, *place])), chi) for chi in CHI]


def along_lines(family: Family, curves: Sequence[AtlasCurve]) -> list[Seed]:
    """Folds on branches of cycles along some lines across the square, among its curves."""
    return [seed for axis in (0, 1) for at in LINES for seed in _seeds_along(family, curves, axis, at)]


def _seeds_along(family: Family, curves: Sequence[AtlasCurve], axis: int, at: float) -> list[Seed]:
    def place(value: float) -> Array:
        return np.array([value, at] if axis == 0 else [at, value])

    @cache
    def system_at(value: float) -> tuple[AtZ, Psi]:
        return family.frozen(place(value)), family.psi_at(place(value))

    search = Search(system_at, family.names[axis], (0.0, 1.0), (0.0, 1.0), marks(family, curves, axis, at))
    search.run()
    every = [piece for pieces, *_ in search.found for piece in pieces]
    folds = [(piece.tracer.family, piece.trace.points[k].turn) for piece in every for k in piece.trace.folds]
    return [_seed(family, ray, turn, place(turn.value)) for ray, turn in folds]


def _seed(family: Family, ray: VariedRay, turn: Turn, where: Array) -> Seed:
    e = e_at(family.psi_at(where), ray.foot.place(turn.value).x2)
    around = Around(family, where, e, ray.u, ray.foot.critical)
    return Seed(Start(around, np.array([turn.xi / SCALE, *where])), turn.amplitude)


def marks(family: Family, curves: Sequence[AtlasCurve], axis: int, at: float) -> list[Mark]:
    """Return where curves of equilibria cross a line."""
    found = []
    for curve in curves:
        plane = family.units(curve.points)
        level = plane[:, 1 - axis] - at
        for i in np.flatnonzero(level[1:] * level[:-1] < 0.0).tolist():
            part = level[i] / (level[i] - level[i + 1])
            value = plane[i, axis] + part * (plane[i + 1, axis] - plane[i, axis])
            p, q = curve.places[i] + part * (curve.places[i + 1] - curve.places[i])
            found.append(Mark(curve.kind, float(value), (float(p), float(q))))
    return sorted(found, key=lambda one: one.value)
