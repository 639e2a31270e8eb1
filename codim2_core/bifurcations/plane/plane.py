"""The plane (f1, f2) of one matrix as an atlas: of Psi, or of the two borders that do not depend on it."""

from __future__ import annotations

from functools import lru_cache

from ...results.arrays import Array
from ...systems.psi.constructors import constant
from ...systems.psi.function import Psi
from ..atlases.atlas import Atlas, borders_over, curves_over, family_over, with_connections, with_folds_of_cycles
from .borders import PlaneMatrix, coefficients_of

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
