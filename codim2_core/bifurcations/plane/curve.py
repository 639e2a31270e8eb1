"""Results of the bifurcation functions: curves in the plane (f1, f2), and their special points.

`plane_atlas` and `border_atlas` are the atlas of the plane of one matrix: of Psi, or of the borders without it.
The borders are the saddle-nodes of limit directions and the ellipse |A^-1 f| = 1.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...portrait.layer_problem.linearisation import determinant_sign
from ...results.arrays import Array, read_only
from ...results.paper import cite
from ...results.result import Pictured, Tabled, result_rows
from ...results.tables import paragraphs, point
from ...systems.coefficients import Coefficients
from ...systems.elinear import ELinear
from ...systems.psi.constructors import constant
from ...systems.psi.function import Psi
from ..atlases.atlas import borders_over, curves_over, family_over, with_connections, with_folds_of_cycles
from ..atlases.result import Atlas
from ..families.disc import cusps, saddle_node_force

MAX_TURN = math.tau / 360  # the tangent turns by at most this from point to point

PlaneMatrix = tuple[float, float, float]


def coefficients_of(matrix: PlaneMatrix, f: tuple[float, float] | Array = (0.0, 0.0)) -> Coefficients:
    """Return the system of a matrix and f, with numbers only."""
    return Coefficients(*matrix, float(f[0]), float(f[1]), read_only(np.zeros((0, 2))), read_only(np.zeros(0)))


def border_places(entries: PlaneMatrix, angles: Callable[[Array], list[float]]) -> list[tuple[float, float]]:
    """Return the places on the curve of saddle-nodes at its cusps, or its corners."""
    a, b, d = entries
    A = np.array([[a, -b], [b, d]])
    return [(float(f1) + 0.0, float(f2) + 0.0) for f1, f2 in saddle_node_force(A, np.array(angles(A)))]


def saddle_node_lines(entries: PlaneMatrix) -> list[Array]:
    """Return the curve of saddle-nodes in pieces (m, 2) between its cusps; a point where nothing turns at f = 0."""
    a, b, d = entries
    if a == d and b == 0.0:
        return [np.zeros((1, 2))]
    A = np.array([[a, -b], [b, d]])
    tips = cusps(A) or [0.0]
    found = []
    for start, end in pairwise([*tips, tips[0] + math.tau]):
        theta = np.linspace(start, end, max(2, math.ceil((end - start) / MAX_TURN) + 1))
        found.append(saddle_node_force(A, theta))
    found[-1][-1] = found[0][0]
    return found


def critical_lines(entries: PlaneMatrix) -> list[Array]:
    """Return the ellipse |A^-1 f| = 1; a segment, or a point, where det A = 0. Shapes: (m, 2)."""
    a, b, d = entries
    A = np.array([[a, -b], [b, d]])
    if determinant_sign(a, b, d) == 0:
        left, sizes, _ = np.linalg.svd(A)
        end = sizes[0] * left[:, 0]
        return [np.stack([-end, end]) if sizes[0] else np.zeros((1, 2))]
    theta = np.linspace(0.0, math.tau, round(math.tau / MAX_TURN) + 1)
    line = -np.stack([np.cos(theta), np.sin(theta)], axis=-1) @ A.T
    line[-1] = line[0]
    return [line]


def border_reach(entries: PlaneMatrix) -> float:
    """Return the largest coordinate on both borders, or 1 where they are the point f = 0."""
    a, b, d = entries
    step = abs(a - d)
    # |f1| <= |b| sin(t) + |a - d| cos(t)^3 on the saddle-nodes, largest at t = 0, or where the slope first vanishes
    t = 0.5 * math.asin(min(2.0 * abs(b) / (3.0 * step), 1.0)) if step else 0.5 * math.pi
    on_fold = max(abs(b), abs(b) * math.sin(t) + step * math.cos(t) ** 3)
    return max(math.hypot(a, b), math.hypot(b, d), on_fold) or 1.0


RANGE_MARGIN = 1.05  # of the largest |f| that the borders may have: how far the plane is looked at
KEPT_PLANES = 32
NAMES = ("f1", "f2")


def whole_ranges(matrix: PlaneMatrix) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return ranges of f1 and f2 that hold both borders."""
    reach = RANGE_MARGIN * sum(abs(v) for v in matrix) or 1.0
    return (-reach, reach), (-reach, reach)


def border_atlas(matrix: PlaneMatrix) -> Atlas:
    """Return both borders, saddle-nodes and the ellipse |A^-1 f| = 1, with the special points on them."""
    return borders_over(family_over(coefficients_of(matrix), constant(), (), *NAMES, whole_ranges(matrix)))


@lru_cache(maxsize=KEPT_PLANES)
def plane_atlas(matrix: PlaneMatrix, psi: Psi) -> Atlas:
    """Return all curves of the plane but those of cycles."""
    return curves_over(coefficients_of(matrix), psi, *NAMES, whole_ranges(matrix))


@lru_cache(maxsize=KEPT_PLANES)
def connection_atlas(matrix: PlaneMatrix, psi: Psi) -> Atlas:
    """Return all curves of the plane with the connections of half-saddles."""
    return with_connections(coefficients_of(matrix), psi, plane_atlas(matrix, psi))


@lru_cache(maxsize=KEPT_PLANES)
def cycle_atlas(matrix: PlaneMatrix, psi: Psi) -> Atlas:
    """Return all curves of the plane with connections and folds of cycles."""
    return with_folds_of_cycles(coefficients_of(matrix), psi, connection_atlas(matrix, psi))


def lines_of(atlas: Atlas, kind: str) -> tuple[list[Array], list[Array]]:
    """Return the points of all curves of a kind, and their numbers."""
    ours = [one for one in atlas.curves if one.kind == kind]
    return [one.points for one in ours], [one.numbers for one in ours]


@dataclass(frozen=True, eq=False, slots=True)
class SpecialPoint(Tabled):
    """A point of codimension two on a bifurcation curve.

    Attributes
    ----------
    type : str
        Such as "cusp", "pitchfork", "double saddle-node", "generalised Hopf".
    place : (f1, f2)
    sentence : str
    """

    _head_ = ("point", "(f₁, f₂)", "what happens")

    type: str
    place: tuple[float, float]
    sentence: str

    def _row_(self) -> tuple[str, ...]:
        return self.type, point(self.place), self.sentence


@dataclass(frozen=True, eq=False)
class BifurcationCurve(Pictured):
    """One bifurcation in the plane (f1, f2) at fixed a, b, d (and Psi).

    Attributes
    ----------
    kind : str
        "saddle-node", "transcritical", "hopf", "node-focus", "fold of cycles", "equator" or "heteroclinic".
    name : str
        A short title for people, which says so where the curve degenerates.
    label : str
        The paper's label.
    branches : tuple of ndarray (m, 2)
        Smooth pieces, in order along each; a closed one repeats its first point. A piece ends at a cusp, at the
        equator, or on the next piece, and pieces are never joined across a gap. One row: an isolated point.
    special : tuple of SpecialPoint
    values : tuple of ndarray (m,)
        For "hopf", the first Lyapunov coefficient at the points of each branch (negative: supercritical, a stable
        cycle is born; positive: subcritical); for cycles what `cycle_folds` and `heteroclinic` say. Else empty.
    sentence : str
        What happens on the curve, or why there is none.
    """

    kind: str
    name: str
    label: str
    branches: tuple[Array, ...] = field(repr=False)
    special: tuple[SpecialPoint, ...] = ()
    values: tuple[Array, ...] = field(default=(), repr=False)
    sentence: str = ""

    def _repr_svg_(self) -> str | None:
        return super()._repr_svg_() if self.branches else None

    def _records(self) -> Iterator[dict[str, Any]]:
        for i, branch in enumerate(self.branches):
            for f1, f2 in branch.tolist():
                yield {"branch": i, "f1": f1, "f2": f2}

    def _tables_(self) -> str:
        said = paragraphs([f"{self.name} ({cite(self.label)})" if self.label else self.name, self.sentence])
        return said + result_rows(self.special)

    def __len__(self) -> int:
        return len(self.branches)


def matrix(system: ELinear | Coefficients, z: ArrayLike) -> tuple[float, float, float]:
    """Return a, b, d of a system at z."""
    found = system.at(z)
    return found.a, found.b, found.d


def read_only_lines(arrays: Iterable[Array]) -> tuple[Array, ...]:
    """Make arrays read-only."""
    out = []
    for array in arrays:
        array = np.ascontiguousarray(array, float)
        array.flags.writeable = False
        out.append(array)
    return tuple(out)
