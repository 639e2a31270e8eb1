"""The regions into which the saddle-node curve and the ellipse |A^-1 f| = 1 cut the plane (f1, f2).

The two curves are a planar graph: its vertices are known in closed form (`Geometry`), every arc between neighbours is
smooth, and walking along arcs with the face on the left gives each region once. Nothing is rastered.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..layer_problem.location import Existence, locate
from ..layer_problem.problem import LayerProblem
from ..portrait.classify import Classification, classify, portrait_name
from ..psi.constructors import constant
from ..results import Pictured, Results, Tabled
from ..systems.coefficients import Coefficients
from ..systems.elinear import ELinear
from ..tables import point
from .arrangement import arrangement, face_borders
from .curve import Array, matrix, read_only_lines
from .geometry import Geometry

_MIN_WIDTH = 1e-6  # of the size: regions with a smaller mean width are left out; nobody could see them
_NO_POINTS = np.zeros((0, 2)), np.zeros(0)
_CUT_LEVELS = np.array([0.07, 0.21, 0.35, 0.4987, 0.65, 0.79, 0.93])  # of the extent of a region: where it is cut


@dataclass(frozen=True, eq=False)
class Region(Tabled):
    """A region of the plane (f1, f2), open, with one portrait up to what Psi decides.

    Attributes
    ----------
    name : str
        "CM0", "CM2", "CM4", "NCM2" or "NCM4", as `classify` names it (Figure 15, Figure 16).
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
        """The portrait at `inside`, with Psi = 1; its limit cycles are searched for when it is asked for."""
        return classify(self._at, constant())

    def _row_(self) -> tuple[str, ...]:
        return self.name, point(self.inside), "yes" if self.bounded else "no", self.classification.sentence


class Regions(Results[Region], Pictured):
    """All regions of the plane (f1, f2): a tuple that a notebook shows as a picture and a table."""

    __slots__ = ()


def regions(system: ELinear | Coefficients, z: ArrayLike = ()) -> Regions:
    """All regions of the plane (f1, f2) between the saddle-node curve and the ellipse, each classified inside.

    Regions that touch in a point only are separate. Slivers with a mean width below 1e-6 of the coefficients are
    left out.

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
    a, b, d = matrix(system, z)
    plane = Geometry(a, b, d)
    if plane.size == 0.0:
        found = [_region(plane, [], np.zeros((1, 2)), (1.0, 0.0), bounded=False)]
        return Regions(region for region in found if region is not None)
    # a or d of next to nothing is taken for 0: the points of fourfold contact that it parts cannot be told apart
    halves = arrangement(Geometry(*(0.0 if abs(v) <= _MIN_WIDTH * plane.size else v for v in (a, b, d))))
    loops = face_borders(halves, plane)
    thin = _MIN_WIDTH * plane.size
    faces = [[loop] for loop, area in loops if area > thin * _length(loop)]
    outer = [(loop, area) for loop, area in loops if area < 0.0]
    free = [loop for loop, _ in outer]
    between: tuple[float, float] | None = None
    if len(outer) == 2:
        # Two curves that do not meet: that takes a d > 0, and the saddle-node curve lies inside the ellipse. The
        # curves were added in this order, so the first hole and the last face are theirs.
        hole, within = outer[0]
        free.pop(0)
        if abs(outer[1][1]) - abs(within) > thin * _length(hole):
            faces[-1].append(hole)
            between = _point_between(plane)
        else:
            faces.pop()
    border = np.concatenate([h.points for h in halves[::2]] or [np.zeros((1, 2))])
    found = [_region(plane, loops_, border, between if len(loops_) > 1 else None) for loops_ in faces]
    corner = 1.15 * abs(border).max(axis=0) + 0.1 * plane.size
    found.append(_region(plane, free, border, (float(corner[0]), float(corner[1])), bounded=False))
    return Regions(region for region in found if region is not None)


def _length(loop: Array) -> float:
    """Half the perimeter of a closed polygon."""
    return 0.5 * float(np.hypot(*(np.roll(loop, -1, axis=0) - loop).T).sum())


def _point_between(plane: Geometry) -> tuple[float, float] | None:
    """Find a point between an oval saddle-node curve and the ellipse around it, where they are farthest apart."""
    if plane.cusps:
        return None
    theta = 0.0 if abs(plane.d) >= abs(plane.a) else 0.5 * math.pi  # |Lambda| is |d| and |a| there
    f = plane.saddle_node_at(theta)
    outer = plane.ellipse_at(plane.on_ellipse(f))
    return 0.5 * (f[0] + outer[0]), 0.5 * (f[1] + outer[1])


def _region(
    plane: Geometry,
    boundary: list[Array],
    border: Array,
    known: tuple[float, float] | None = None,
    bounded: bool = True,
) -> Region | None:
    if known is not None:
        inside = known
    else:
        found = _interior_point(boundary, border)
        if found is None:
            return None
        inside = found
    if locate(_coefficients_at(plane, inside)).existence is Existence.SINGULAR_LINE:
        # det A = 0: on the line f = A e only, which passes through the region
        inside = _point_beside(plane, inside, border)
    at = _coefficients_at(plane, inside)
    return Region(portrait_name(LayerProblem(at, constant())).name, inside, read_only_lines(boundary), bounded, at)


def _coefficients_at(plane: Geometry, f: tuple[float, float]) -> Coefficients:
    return Coefficients(plane.a, plane.b, plane.d, *f, *_NO_POINTS)


def _point_beside(plane: Geometry, f: tuple[float, float], border: Array) -> tuple[float, float]:
    """Return a point a tenth of the way from the line {A e} to the border."""
    u, v = max((plane.a, plane.b), (-plane.b, plane.d), key=lambda column: math.hypot(*column))
    step = 0.1 * float(np.hypot(border[:, 0] - f[0], border[:, 1] - f[1]).min()) / math.hypot(u, v)
    return f[0] - step * v, f[1] + step * u


def _interior_point(boundary: list[Array], border: Array) -> tuple[float, float] | None:
    """Find a point well inside closed polygons and far from all curves: the best of the middles of several cuts."""
    loops = [np.concatenate([loop, loop[:1]]) for loop in boundary]
    first, second = (np.concatenate([loop[part] for loop in loops]).T for part in (slice(-1), slice(1, None)))
    low, high = boundary[0].min(axis=0), boundary[0].max(axis=0)
    # along each axis, cuts at some levels of the other one
    levels = low[::-1, None] + (high - low)[::-1, None] * _CUT_LEVELS
    axis, level, at = np.nonzero((first[::-1, None] > levels[..., None]) != (second[::-1, None] > levels[..., None]))
    with np.errstate(invalid="ignore", over="ignore"):
        part = (levels[axis, level] - first[1 - axis, at]) / (second[1 - axis, at] - first[1 - axis, at])
        crossing = first[axis, at] + part * (second[axis, at] - first[axis, at])
    ends = np.searchsorted(axis * len(_CUT_LEVELS) + level, np.arange(2 * len(_CUT_LEVELS) + 1)).tolist()
    candidates: list[tuple[float, float]] = []
    halves: list[float] = []  # half the width of each cut: the border's points alone would miss how thin a sliver is
    places = crossing.tolist()
    for k, where in enumerate(levels.ravel().tolist()):
        row = sorted(v for v in places[ends[k] : ends[k + 1]] if v < math.inf)
        pairs = list(zip(row[::2], row[1::2], strict=False))
        if pairs:
            left, right = max(pairs, key=lambda pair: pair[1] - pair[0])
            middle = 0.5 * (left + right)
            candidates.append((middle, where) if k < len(_CUT_LEVELS) else (where, middle))
            halves.append(0.5 * (right - left))
    if not candidates:
        return None
    best, chosen = -1.0, 0
    scale = float(np.abs(border).max())
    x, y = np.ascontiguousarray(border.T) / scale
    for i in sorted(range(len(candidates)), key=lambda i: -halves[i]):
        if halves[i] < best:
            break
        u, v = candidates[i]
        du, dv = u / scale - x, v / scale - y
        nearest = border[int((du * du + dv * dv).argmin())]
        width = min(float(np.hypot(u - nearest[0], v - nearest[1])), halves[i])
        if width > best or (width == best and i < chosen):
            best, chosen = width, i
    return candidates[chosen]
