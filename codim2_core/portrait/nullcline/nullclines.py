"""Nullclines on the hemisphere and outside it, as separate branches (Figure 24)."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...results.arrays import Array
from ...results.result import Pictured, Results, Tabled
from ...results.tables import point
from ...systems.frozen import FrozenSystem
from ...systems.kinds import AnySystem, takes_names
from ...systems.psi.constructors import constant
from ...systems.psi.function import Psi
from ..layer_problem.problem import LayerProblem, found_once
from .conics import Affine, Arc, ConicCurve, Straight, affine_field, chord_ends, conic, lines
from .general_nullclines import Kind, Traced, inside_curves, outside_curves

PIXEL_TOLERANCE = 0.25  # of a pixel: a polyline stays within it of its curve
WINDOW_MARGIN = 0.5  # of the window, next to it: what a small pan shows
MAX_BRANCH_POINTS = 4000  # points of a branch
CUT_PASSES = 12  # each cuts a step in three
DIFFERENCE_STEP = 1e-6  # of differences of a component
NEWTON_STEPS = 3  # steps: a traced curve is known to 1e-5, and the last step squares what the gradient is off by


@dataclass(frozen=True, slots=True)
class Seen:
    """A part of the picture that is looked at closely: (left, right, bottom, top), and the size of a pixel there."""

    window: tuple[float, float, float, float]
    pixel: float

    def steps_in_view(self, points: Array) -> NDArray[np.bool_]:
        """Tell which steps between neighbouring points (n, 2) may be seen; (n - 1,)."""
        left, right, bottom, top = self.window
        x, y = WINDOW_MARGIN * (right - left), WINDOW_MARGIN * (top - bottom)
        low, high = np.minimum(points[:-1], points[1:]), np.maximum(points[:-1], points[1:])
        bulge = 0.3 * np.hypot(*(points[1:] - points[:-1]).T)[:, None]  # a step may bend out of its box
        inside = (high + bulge >= (left - x, bottom - y)) & (low - bulge <= (right + x, top + y))
        return inside.all(axis=1)


def to_picture(psi: Psi, e: Array) -> Array:
    """Return the points of the picture at points of the closed e-disc, to rounding."""
    if psi.record.identity:
        return e
    m = np.hypot(e[:, 0], e[:, 1])
    moves = (m > 0.0) & (m < 1.0 - 1e-15)
    zeta = np.asarray(psi.radius(np.where(moves, m, 0.5)), float)
    r = np.where(m < 1.0 - 1e-15, zeta / np.hypot(1.0, zeta), 1.0)
    return e * np.where(moves | (m >= 0.5), r / np.where(m > 0.0, m, 1.0), 1.0)[:, None]


def on_component(at: FrozenSystem, kind: Kind, inside: bool) -> Callable[[Array], Array]:
    """Return what brings points close to a traced curve onto it: Newton's method along the gradient."""

    def component(points: Array) -> Array:
        if inside:
            e, xy = points, None
        else:
            r = np.hypot(*points.T)[:, None]
            e, xy = points / r, points * (r - 1.0) / r
        U = at.U(e, xy)
        if kind in ("U1", "U2"):
            return U[:, int(kind[1]) - 1]
        c, s = e.T
        return c * U[:, 0] + s * U[:, 1] if kind == "rho" else c * U[:, 1] - s * U[:, 0]

    def correct_points(points: Array) -> Array:
        first = points
        for _ in range(NEWTON_STEPS):
            value = component(points)
            slopes = [
                (component(points + DIFFERENCE_STEP * v) - component(points - DIFFERENCE_STEP * v))
                / (2.0 * DIFFERENCE_STEP)
                for v in np.eye(2)
            ]
            gradient = np.stack(slopes, axis=-1)
            square = (gradient**2).sum(axis=1)
            step = gradient * np.divide(value, square, out=np.zeros_like(value), where=square > 0.0)[:, None]
            points = points - np.where(np.isfinite(step) & (np.abs(step) < 1e-3), step, 0.0)
        return np.where((np.hypot(*(points - first).T) < 1e-3)[:, None], points, first)

    return correct_points


def refine_curve(curve: ConicCurve, place: Callable[[Array], Array], t: Array, points: Array, seen: Seen) -> Array:
    """Return picture points along a curve of t (n,) and points (n, 2), closer where they are seen; both ends stay."""
    ends = points[0], points[-1]
    points = place(curve(t))
    points[0], points[-1] = ends
    open_ = np.ones(len(t) - 1, bool)  # steps that have not been looked at
    for _ in range(CUT_PASSES):
        cut = np.flatnonzero(open_ & seen.steps_in_view(points) & (np.diff(t) > 1e-15))
        if not len(cut) or len(t) + 2 * len(cut) > MAX_BRANCH_POINTS:
            break
        thirds = t[cut, None] + (t[cut + 1] - t[cut])[:, None] * (1.0 / 3.0, 2.0 / 3.0)
        between = place(curve(thirds.ravel())).reshape(-1, 2, 2)
        bent = _away(points[cut], points[cut + 1], between) > PIXEL_TOLERANCE * seen.pixel
        open_[cut] = bent
        steps = np.ones(len(t) - 1, np.intp)
        steps[cut[bent]] = 3
        at = np.concatenate([np.zeros(1, np.intp), np.cumsum(steps)])
        new = at[cut[bent], None] + (1, 2)
        old_t, old_points = t, points
        t, points = np.empty(at[-1] + 1), np.empty((at[-1] + 1, 2))
        t[at], points[at] = old_t, old_points
        t[new], points[new] = thirds[bent], between[bent]
        open_ = np.repeat(open_, steps)
    return points


def _away(start: Array, end: Array, between: Array) -> Array:
    """Return how far points (k, n, 2) lie from the chords of their steps, at most; (k,)."""
    along, off = end - start, between - start[:, None]
    length = np.hypot(along[:, 0], along[:, 1])
    across = np.abs(off[:, :, 0] * along[:, None, 1] - off[:, :, 1] * along[:, None, 0]).max(axis=1)
    whole = np.hypot(off[:, :, 0], off[:, :, 1]).max(axis=1)
    return np.where(length > 0.0, across / np.where(length > 0.0, length, 1.0), whole)


Exactly = Callable[[Array], Array]

MAX_COARSE_POINTS = 65  # most points of a branch
PASSES = 8  # of redistribution; each resolves tighter bends, smooth branches need none or one
SAG = 0.2 / 180.0  # in picture units: a polyline stays within 0.25 px of its curve at 180 px a unit
# Clustered at both ends, where a nullcline leaves the origin and where Psi bends it into the equator.
_CHEBYSHEV_GRID = 0.5 - 0.5 * np.cos(np.linspace(0.0, math.pi, MAX_COARSE_POINTS))


@lru_cache(maxsize=16)
def _radial_table(psi: Psi) -> tuple[Array, Array]:
    """|e_Psi| over an even grid of |p|, whose inverse places a curve of the e-disc in the picture.

    Between neighbours |p| moves by 1/2000, so reading the table backwards is off by less than a tenth of a pixel.
    """
    r = np.linspace(0.0, 1.0, 2001)
    inner = r[:-1]
    modulus = np.append(psi.modulus(inner / np.sqrt((1.0 - inner) * (1.0 + inner))), 1.0)
    return modulus, r


def _onto_disc(psi: Psi, e: Array) -> Array:
    """Picture points of points of the closed e-disc: Psi moves them along their radius."""
    if psi.record.identity:
        return e  # |p| = |e| for Psi = 1
    m = np.hypot(e[:, 0], e[:, 1])
    # Rounded to |e| = 1 means on the equator: exp(-s) gets there in doubles already at |p| = 0.984.
    r = np.where(m < 1.0 - 1e-15, np.interp(m, *_radial_table(psi)), 1.0)
    factor = np.divide(r, m, out=np.ones_like(m), where=m > 0.0)
    return e * factor[:, None]


def picture_points(curve: ConicCurve, psi: Psi, seen: Seen | None = None, exactly: Exactly | None = None) -> Array:
    """Picture points along a curve of the e-disc, spread so that no segment sags by more than SAG."""
    if isinstance(curve, Straight) and (psi.record.identity or curve.is_diameter):
        return _onto_disc(psi, np.array([curve.start, curve.end]))  # Psi moves points along their radius
    if isinstance(curve, Traced) and curve.straight:
        return picture_points(Straight(tuple(curve.points[0]), tuple(curve.points[-1])), psi, seen)
    t, points = _sample_curve(curve, psi)
    if seen is None or not seen.steps_in_view(points).any():
        return points
    onto = exactly or (lambda e: e)
    return refine_curve(curve, lambda e: to_picture(psi, onto(e)), t, points, seen)


def _sample_curve(curve: ConicCurve, psi: Psi) -> tuple[Array, Array]:
    """Parameters along a curve, and its picture points there."""
    if isinstance(curve, Arc) and not psi.record.identity:
        knots = [0.0, *curve.tips(), 1.0]
        parts = [_spread(curve, psi, low + (high - low) * _CHEBYSHEV_GRID) for low, high in pairwise(knots)]
        first, *others = parts
        return (
            np.concatenate([first[0], *(t[1:] for t, _ in others)]),
            np.concatenate([first[1], *(points[1:] for _, points in others)]),
        )
    count = (
        MAX_COARSE_POINTS * max(1, math.ceil(curve.total_turning / math.pi))
        if isinstance(curve, Traced)
        else MAX_COARSE_POINTS
    )
    return _spread(curve, psi, _CHEBYSHEV_GRID if count == MAX_COARSE_POINTS else np.linspace(0.0, 1.0, count))


def _spread(curve: ConicCurve, psi: Psi, t: Array) -> tuple[Array, Array]:
    """Parameters and picture points along a curve from t[0] to t[-1], as many as of t, moved to where it bends."""
    count = len(t)
    points = _onto_disc(psi, curve(t))
    for _ in range(PASSES):
        step = points[1:] - points[:-1]
        length = np.hypot(step[:, 0], step[:, 1])
        cross = step[1:, 0] * step[:-1, 1] - step[1:, 1] * step[:-1, 0]
        bend = np.abs(np.arctan2(cross, step[1:, 0] * step[:-1, 0] + step[1:, 1] * step[:-1, 1]))
        sag = np.zeros_like(length)  # of each segment: an eighth of its length times the turn at its ends
        sag[1:] = bend
        sag[:-1] = np.maximum(sag[:-1], bend)
        sag *= 0.125 * length
        if sag.max() < 0.5 * SAG:
            break
        share = np.sqrt(sag / sag.max()) + 0.1 * length / length.max() + 1e-3
        measure = np.concatenate([[0.0], np.cumsum(share)])
        t = np.interp(np.linspace(0.0, measure[-1], count), measure, t)
        points = _onto_disc(psi, curve(t))
    return t, points


@dataclass(frozen=True, eq=False, slots=True)
class NullclineBranch(Tabled):
    """One connected piece of a nullcline in the picture.

    Attributes
    ----------
    kind : "rho", "theta", "U1" or "U2"
        rho' = 0, theta' = 0, or the lines U1 = 0, U2 = 0 of Figure 24.
    inside : bool
        On the hemisphere (|p| <= 1), or outside it. Outside, U1 and U2 continue as the straight lines
        ``a x - b y = -f1`` and ``b x + d y = -f2`` (construction lines: the paper prints +f1 and +f2). In a general
        system they are where U1 and U2 vanish outside.
    points : ndarray (n, 2)
        Picture points, in order along the branch.
    """

    _head_ = ("nullcline", "where", "from", "to")

    kind: Kind
    inside: bool
    points: Array = field(repr=False)

    def _row_(self) -> tuple[str, ...]:
        ends = (point(self.points[i]) for i in (0, -1)) if len(self.points) else ("–", "–")
        return _NULLCLINE_NAMES[self.kind], "hemisphere" if self.inside else "outside", *ends


class Nullclines(Results[NullclineBranch], Pictured):
    """All nullclines of a picture: a tuple that a notebook shows as a picture and a table."""

    __slots__ = ()

    def _records(self) -> Iterator[dict[str, Any]]:
        for i, one in enumerate(self):
            for x, y in one.points.tolist():
                yield {"branch": i, "kind": one.kind, "inside": one.inside, "x": x, "y": y}


_NULLCLINE_NAMES: dict[Kind, str] = {"rho": "ρ′ = 0", "theta": "θ′ = 0", "U1": "U₁ = 0", "U2": "U₂ = 0"}


@found_once(of_psi=False)
def find_affine_field(problem: LayerProblem) -> tuple[Affine, list[float]] | None:
    """Return U where it is affine, and where lambda_rho vanishes: what is drawn inside and outside begins with it."""
    return affine_field(problem.at)


def inside_nullclines(problem: LayerProblem, seen: Seen | None = None) -> tuple[NullclineBranch, ...]:
    """Nullclines on the hemisphere; theta-nullclines end at the limit directions."""
    coefficients, psi, affine = problem.at, problem.psi, find_affine_field(problem)
    if affine is None:
        return tuple(
            _make_branch(kind, True, picture_points(curve, psi, seen, on_component(coefficients, kind, inside=True)))
            for kind, curve in inside_curves(coefficients)
        )
    U, radial = affine
    ends: tuple[tuple[Kind, list[float]], ...] = (
        ("rho", radial),
        ("theta", problem.equator.theta.tolist()),
    )
    shapes: list[tuple[Kind, ConicCurve]] = []
    for kind, angles in ends:
        for curve in conic(kind, U, angles):
            shapes.append((kind, curve))  # noqa: PERF401 (a comprehension loses the type of kind)
    for kind, line in lines(U):
        chord = chord_ends(*line)
        if chord is not None:
            shapes.append((kind, Straight(*chord)))
    return tuple(_make_branch(kind, True, picture_points(curve, psi, seen)) for kind, curve in shapes)


def _make_branch(kind: Kind, inside: bool, points: Array) -> NullclineBranch:
    points.flags.writeable = False
    return NullclineBranch(kind, inside, points)


def outside_nullclines(problem: LayerProblem, view: float, seen: Seen | None = None) -> tuple[NullclineBranch, ...]:
    """Nullclines outside, to the corners of a view of that half-width: rays, and the straight lines continued."""
    reach = math.sqrt(2.0) * view
    coefficients, affine = problem.at, find_affine_field(problem)
    if affine is None:
        one = constant()
        return tuple(
            _make_branch(kind, False, picture_points(curve, one, seen, on_component(coefficients, kind, inside=False)))
            for kind, curve in outside_curves(coefficients, reach)
        )
    U, radial = affine
    branches = []
    rays: tuple[tuple[Kind, list[float]], ...] = (
        ("rho", radial),
        ("theta", problem.equator.theta.tolist()),
    )
    for kind, angles in rays:
        for t in angles:
            c, s = math.cos(t), math.sin(t)
            branches.append(_make_branch(kind, False, np.array([(c, s), (reach * c, reach * s)])))
    for kind, (n1, n2, k) in lines(U):
        outer, inner = chord_ends(n1, n2, k / reach), chord_ends(n1, n2, k)
        if outer is None:
            continue
        start, end = [(reach * x, reach * y) for x, y in outer]
        pieces = [(start, end)] if inner is None else [(start, inner[0]), (inner[1], end)]
        branches += [_make_branch(kind, False, np.array(piece)) for piece in pieces]
    return tuple(branches)


@takes_names
def nullclines(system: AnySystem, psi: Psi, z: ArrayLike = (), *, view: float = 2.0) -> Nullclines:
    """All nullclines in the picture, as separate branches.

    Parameters
    ----------
    system : ELinear or System, or either frozen at a z
    psi : Psi
    z : (m,) floats
    view : float
        Half-width > 1 of the view to whose corners the outside is followed.

    Returns
    -------
    Nullclines
        A tuple of NullclineBranch.

    Examples
    --------
    >>> from codim2_core import nullclines
    >>> sorted(set(nullclines("case1-cm4").kinds))
    ['U1', 'U2', 'rho', 'theta']
    """
    if not view > 1.0:
        raise ValueError(f"view is {view}; give a half-width greater than 1 (the equator).")
    problem = LayerProblem(system.at(z), psi)
    return Nullclines(inside_nullclines(problem) + outside_nullclines(problem, view))
