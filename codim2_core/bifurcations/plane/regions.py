"""The regions into which the saddle-node curve and the ellipse |A^-1 f| = 1 cut the plane (f1, f2)."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ...portrait.classify import Classification, classify, portrait_name
from ...portrait.layer_problem.linearisation import Existence, locate
from ...portrait.layer_problem.problem import LayerProblem
from ...results.arrays import Array, read_only
from ...results.result import Pictured, Results, Tabled
from ...results.tables import point
from ...systems.coefficients import Coefficients
from ...systems.elinear import ELinear
from ...systems.kinds import takes_a_b_d
from ...systems.psi.constructors import constant
from ..atlases.atlas import family_over
from ..atlases.regions import faces_between
from .curve import NAMES, PlaneMatrix, border_atlas, coefficients_of, matrix

PLANE_MARGIN = (
    0.15  # of the largest |f| on the borders, and of the largest entry: how far the plane goes on beyond them
)
SEGMENT_STEP = 0.1  # of its room: how far a place on a line of equilibria is moved off it
MIN_WIDTH = 1e-6  # of the largest entry: one with less counts as 0, so that no sliver is a region


@dataclass(frozen=True, eq=False)
class Region(Tabled):
    """A region of the plane (f1, f2), open, with one portrait up to what Psi decides.

    Attributes
    ----------
    name : str
        "CM0", "CM2", "CM4", "NCM2" or "NCM4", as `classify` names it (Figure 15, fig:3cases).
    inside : (f1, f2)
        A point of the region, far from its border.
    boundary : tuple of ndarray (m, 2)
        Closed polygons (the first point is not repeated): the outer one first, anticlockwise, then holes, clockwise.
        The unbounded region has holes only.
    bounded : bool
    """

    _head_ = ("region", "a point (f₁, f₂) of it", "bounded", "portrait there")

    name: str
    inside: tuple[float, float]
    boundary: tuple[Array, ...] = field(repr=False)
    bounded: bool
    _at: Coefficients = field(repr=False)

    @cached_property
    def classification(self) -> Classification:
        """The portrait at `inside`, with Psi = 1; its limit cycles are searched for when it is requested."""
        return classify(self._at, constant())

    def _row_(self) -> tuple[str, ...]:
        return self.name, point(self.inside), "yes" if self.bounded else "no", self.classification.sentence


class Regions(Results[Region], Pictured):
    """All regions of the plane (f1, f2): a tuple that a notebook shows as a picture and a table."""

    __slots__ = ()


@takes_a_b_d
def regions(system: ELinear | Coefficients, z: ArrayLike = ()) -> Regions:
    """All regions of the plane (f1, f2) between the saddle-node curve and the ellipse, each classified inside.

    Regions that touch in a point only are separate. Slivers narrower than 4e-4 of the plane are left out.

    Parameters
    ----------
    system : ELinear, or Coefficients
        Its f does not matter.
    z : (m,) floats

    Returns
    -------
    Regions
        A tuple of Region, the unbounded one last. Lines and points, where the portrait is degenerate, are
        `saddle_node` and `critical_boundary`; when det A = 0 the ellipse is a segment and cuts nothing.

    Raises
    ------
    ValueError
        z does not fit the system.

    Examples
    --------
    >>> from codim2_core import ELinear, bifurcations
    >>> sorted(one.name for one in bifurcations.regions(ELinear(-2, 0, -1)))
    ['CM2', 'CM2', 'CM4', 'NCM2']
    """
    entries = matrix(system, z)
    size = max(map(abs, entries))
    a, b, d = (0.0 if abs(v) <= MIN_WIDTH * size else v for v in entries)
    atlas = border_atlas((a, b, d))
    points = np.concatenate([np.zeros((1, 2)), *(one.points for one in atlas.curves)])
    reach = 1.15 * np.abs(points).max(axis=0) + PLANE_MARGIN * (size or 1.0)
    family = family_over(coefficients_of((a, b, d)), constant(), (), *NAMES, [(-v, v) for v in reach.tolist()])
    lines, marks = (
        [family.units(one.points) for one in atlas.curves],
        family.units(np.reshape([one.place for one in atlas.points], (-1, 2))),
    )
    found = []
    for face, at, room in faces_between(lines, marks):
        rings = [family.values(ring) for ring in face.rings]
        bounded = not (np.abs(rings[0]) >= 0.999 * reach).any()
        inside = tuple(_off_segment(entries, family.values(at), room * float(reach.min())).tolist())
        of = coefficients_of(entries, inside)
        name = portrait_name(LayerProblem(of, constant())).name
        boundary = tuple(read_only(ring) for ring in rings[0 if bounded else 1 :])
        found.append(Region(name, inside, boundary, bounded, of))
    return Regions(sorted(found, key=lambda one: not one.bounded))


def _off_segment(entries: PlaneMatrix, f: Array, room: float) -> Array:
    """Return a place, moved off the line {A e} where det A = 0 and it lies on that."""
    if locate(coefficients_of(entries, f)).existence is not Existence.SINGULAR_LINE:
        return f
    a, b, d = entries
    u, v = max((a, b), (-b, d), key=lambda column: abs(column[0]) + abs(column[1]))
    return np.asarray(f + SEGMENT_STEP * room * np.array([-v, u]) / np.hypot(u, v))
