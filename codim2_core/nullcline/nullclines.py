"""Nullclines on the hemisphere and outside it, as separate branches (fig:sim_5cases).

Along the direction (cos θ, sin θ) at e = m (cos θ, sin θ) the e-linear field has the components

    radial    m (a cos² + d sin²) + f1 cos + f2 sin          = m Q(θ) + L(θ),
    angular   m ((d − a) sin cos + b) + f2 cos − f1 sin      = m Q(θ) + L(θ),

so each nullcline is a conic through the origin of the e-disc, which every line through the origin meets once more,
at m = −L/Q: a closed form. Psi then only moves points along their radius. Where Q and L share a zero the conic falls
apart into a diameter and a chord. Outside, e is the direction itself (m = 1) and the nullclines are rays.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..layer_problem.equator import equator_equilibria
from ..numerics.trigonometric import radial_zeros
from ..psi.constructors import constant
from ..psi.function import Psi
from ..systems.coefficients import Coefficients
from ..systems.frozen import AtZ
from ..systems.kinds import AnySystem
from .typed import Kind, Traced, inside_curves, outside_curves

Array = NDArray[np.floating[Any]]

Curve = Callable[[Array], Array]  # a parameter in [0, 1] -> points of the closed e-disc

POINTS = 65  # most points of a branch
PASSES = 8  # of redistribution; each resolves tighter bends, smooth branches need none or one
SPIKE = 0.9  # |e| beyond which a nullcline that turns back is drawn from there on both sides
SAG = 0.2 / 180.0  # in picture units: a polyline stays within 0.25 px of its curve at 180 px a unit
# Clustered at both ends, where a nullcline leaves the origin and where Psi bends it into the equator.
_GRID = 0.5 - 0.5 * np.cos(np.linspace(0.0, math.pi, POINTS))


@dataclass(frozen=True, slots=True)
class NullclineBranch:
    """One connected piece of a nullcline in the picture.

    Attributes
    ----------
    kind : "rho", "theta", "U1" or "U2"
        rho' = 0, theta' = 0, or the lines U1 = 0, U2 = 0 of fig:sim_5cases.
    inside : bool
        On the hemisphere (|p| <= 1), or outside it. Outside, U1 and U2 continue as the straight lines
        ``a x - b y = -f1`` and ``b x + d y = -f2`` (construction lines: the paper prints +f1 and +f2). In a general
        system they are where U1 and U2 vanish outside.
    points : ndarray (n, 2)
        Picture points, in order along the branch.
    """

    kind: Kind
    inside: bool
    points: Array


def _radial_angles(coefficients: Coefficients) -> list[float]:
    """Angles in [0, 2 pi) at which lambda_rho = a cos² + d sin² + f1 cos + f2 sin vanishes."""
    return list(radial_zeros(coefficients.a, coefficients.d, coefficients.f1, coefficients.f2).theta)


Affine = tuple[float, float, float, float, float, float]  # U = (A11 c + A12 s + f1, A21 c + A22 s + f2), row by row


def _affine(at: AtZ) -> tuple[Affine, list[float]] | None:
    """U where it is affine in (c, s), and the angles at which lambda_rho vanishes; None where it is not."""
    normal = at.normal_form
    if normal is None:
        return None
    if at.as_given is not None:
        a, b, d, f1, f2 = at.as_given.plane
        return (a, -b, f1, b, d, f2), _radial_angles(at.as_given)
    (a11, a12), (a21, a22) = at.DU((0.0, 0.0)).tolist()
    f1, f2 = at.U((0.0, 0.0)).tolist()
    radial = [(theta - normal.rotation) % (2.0 * math.pi) for theta in _radial_angles(normal)]
    return (a11, a12, f1, a21, a22, f2), radial


def _quadratic(kind: Kind, U: Affine) -> tuple[float, float, float]:
    """Q as (q11, q12, q22): q11 cos² + q12 sin cos + q22 sin²."""
    a11, a12, _, a21, a22, _ = U
    return (a11, a12 + a21, a22) if kind == "rho" else (a21, a22 - a11, -a12)


def _linear(kind: Kind, U: Affine) -> tuple[float, float]:
    """L as (l1, l2): l1 cos + l2 sin."""
    return (U[2], U[5]) if kind == "rho" else (U[5], -U[2])


def _chord(n1: float, n2: float, k: float) -> tuple[Array, Array] | None:
    """Return the ends on the unit circle of the line n.e + k = 0, or None if it misses the open disc."""
    length = math.hypot(n1, n2)
    if length <= abs(k):
        return None
    foot = -k / length
    half = math.sqrt((1.0 - foot) * (1.0 + foot))
    u = np.array([n1, n2]) / length
    across = np.array([-u[1], u[0]])
    return foot * u - half * across, foot * u + half * across


def _null_directions(q11: float, q12: float, q22: float) -> list[float]:
    """Angles in [0, pi) at which q11 cos² + q12 sin cos + q22 sin² = 0 (none if it vanishes identically)."""
    mean, stretch, shear = 0.5 * (q11 + q22), 0.5 * (q11 - q22), 0.5 * q12
    length = math.hypot(stretch, shear)  # mean + length cos(2θ − φ) = 0
    if length == 0.0 or abs(mean) > length:
        return []
    middle, half = math.atan2(shear, stretch), math.acos(-mean / length)
    return sorted({(0.5 * (middle + sign * half)) % math.pi for sign in (1.0, -1.0)})


@dataclass(frozen=True, slots=True)
class _Straight:
    """A straight curve of the e-disc between two points."""

    start: Array
    end: Array

    def __call__(self, t: Array) -> Array:
        return self.start + t[:, None] * (self.end - self.start)

    @property
    def is_diameter(self) -> bool:
        return bool(self.start[0] * self.end[1] == self.start[1] * self.end[0])


def _conic(kind: Kind, U: Affine, ends: list[float]) -> list[Curve]:
    """Branches of one conic in the e-disc; `ends` are the angles in [0, 2 pi) where it meets the unit circle."""
    q11, q12, q22 = _quadratic(kind, U)
    l1, l2 = _linear(kind, U)
    size_q, size_l = max(abs(q11), abs(q12), abs(q22)), math.hypot(l1, l2)
    if size_l == 0.0:
        diameters = [np.array([math.cos(t), math.sin(t)]) for t in _null_directions(q11, q12, q22)]
        return [_Straight(-u, u) for u in diameters]
    c0, s0 = l2 / size_l, -l1 / size_l  # the direction with L = 0: the tangent of the conic at the origin
    at_tangent = q11 * c0 * c0 + q12 * s0 * c0 + q22 * s0 * s0
    if abs(at_tangent) <= 1e-9 * size_l:  # within an angle of 1e-9, far below a pixel, the tangent is the curve
        branches = [_Straight(np.array([-c0, -s0]), np.array([c0, s0]))]
        if size_q > 0.0:
            # Q = (l.e)(k.e) with k found along l and across it; the rest of the conic is the line k.e + 1 = 0.
            u1, u2 = l1 / size_l, l2 / size_l
            along = q11 * u1 * u1 + q12 * u1 * u2 + q22 * u2 * u2
            across = 2.0 * (q11 * u1 * c0 + q22 * u2 * s0) + q12 * (u1 * s0 + u2 * c0)
            chord = _chord(along * u1 + across * c0, along * u2 + across * s0, size_l)
            if chord is not None:
                branches.append(_Straight(*chord))
        return branches
    # A line through the origin, θ mod π, meets the conic once more, at the signed distance m.
    cuts = sorted(t % math.pi for t in ends) or [math.atan2(s0, c0)]
    spans: list[tuple[float, float]] = []
    for left, right in zip(cuts, [*cuts[1:], cuts[0] + math.pi], strict=True):
        c, s = math.cos(0.5 * (left + right)), math.sin(0.5 * (left + right))
        if right - left < 1e-14 or abs(l1 * c + l2 * s) > abs(q11 * c * c + q12 * s * c + q22 * s * s):
            continue
        spans.append((left, right))  # where the conic touches the unit circle, two spans meet: both end there
    return [_Arc(span, (q11, q12, q22), (l1, l2), bool(ends)) for span in spans]


@dataclass(frozen=True, slots=True)
class _Arc:
    """The conic m = -L/Q over a span of directions; `cut`: it ends on the unit circle, exactly.

    A rounding of |e| from 1 to 1 - 1e-15 is 3 pixels of |p| where Psi falls off fast.
    """

    span: tuple[float, float]
    Q: tuple[float, float, float]
    L: tuple[float, float]
    cut: bool

    def _polar(self, t: Array) -> tuple[Array, Array, Array]:
        theta = self.span[0] + t * (self.span[1] - self.span[0])
        c, s = np.cos(theta), np.sin(theta)
        q = self.Q[0] * c * c + self.Q[1] * s * c + self.Q[2] * s * s
        m = np.divide(-self.L[0] * c - self.L[1] * s, q, out=np.zeros_like(q), where=q != 0.0)
        m = np.minimum(np.maximum(m, -1.0), 1.0)
        if self.cut:
            m = np.where((t == 0.0) | (t == 1.0), np.copysign(1.0, m), m)
        return m, c, s

    def __call__(self, t: Array) -> Array:
        m, c, s = self._polar(t)
        return np.stack([m * c, m * s], axis=-1)

    def tips(self) -> list[float]:
        """Parameters inside at which it comes nearest to the unit circle: Psi draws these out to spikes."""
        t = np.linspace(0.0, 1.0, 129)
        m = np.abs(self._polar(t)[0])
        top = 1 + np.flatnonzero((m[1:-1] > SPIKE) & (m[1:-1] >= m[:-2]) & (m[1:-1] > m[2:]))
        found = []
        for i in top.tolist():
            low, high = float(t[i - 1]), float(t[i + 1])
            for _ in range(9):  # to a part of 8^-9 of a step: the square of that is lost in |e|
                fine = np.linspace(low, high, 17)
                k = min(max(int(np.argmax(np.abs(self._polar(fine)[0]))), 1), 15)
                low, high = float(fine[k - 1]), float(fine[k + 1])
            found.append(0.5 * (low + high))
        return found


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


def _drawn(curve: Curve, psi: Psi) -> Array:
    """Picture points along a curve of the e-disc, spread so that no segment sags by more than SAG.

    At most POINTS, or for a traced curve so many for each half turn, and for a conic between its tips.
    """
    if isinstance(curve, _Straight) and (psi.record.identity or curve.is_diameter):
        return _onto_disc(psi, np.stack([curve.start, curve.end]))  # Psi moves points along their radius
    if isinstance(curve, _Arc) and not psi.record.identity:
        knots = [0.0, *curve.tips(), 1.0]
        parts = [_spread(curve, psi, low + (high - low) * _GRID) for low, high in pairwise(knots)]
        return np.concatenate([parts[0], *(part[1:] for part in parts[1:])])
    count = POINTS
    if isinstance(curve, Traced):
        if curve.straight:
            return _drawn(_Straight(curve.points[0], curve.points[-1]), psi)
        count *= max(1, math.ceil(curve.turning / math.pi))
    return _spread(curve, psi, _GRID if count == POINTS else np.linspace(0.0, 1.0, count))


def _spread(curve: Curve, psi: Psi, t: Array) -> Array:
    """Picture points along a curve from t[0] to t[-1], as many as of t, moved to where it bends."""
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
    return points


def inside_nullclines(coefficients: AtZ, psi: Psi, limit_directions: list[float]) -> tuple[NullclineBranch, ...]:
    """Nullclines on the hemisphere; `limit_directions` are the zeros of Theta (where theta-nullclines end)."""
    affine = _affine(coefficients)
    if affine is None:
        return tuple(_branch(kind, True, _drawn(curve, psi)) for kind, curve in inside_curves(coefficients))
    U, radial = affine
    ends: tuple[tuple[Kind, list[float]], ...] = (
        ("rho", radial),
        ("theta", limit_directions),
    )
    shapes: list[tuple[Kind, Curve]] = []
    for kind, angles in ends:
        for curve in _conic(kind, U, angles):
            shapes.append((kind, curve))  # noqa: PERF401 (a comprehension loses the type of kind)
    for kind, line in _lines(U):
        chord = _chord(*line)
        if chord is not None:
            shapes.append((kind, _Straight(*chord)))
    return tuple(_branch(kind, True, _drawn(curve, psi)) for kind, curve in shapes)


def _branch(kind: Kind, inside: bool, points: Array) -> NullclineBranch:
    points.flags.writeable = False
    return NullclineBranch(kind, inside, points)


def _lines(U: Affine) -> tuple[tuple[Kind, tuple[float, float, float]], ...]:
    """U1 = 0 and U2 = 0 as lines n.e + k = 0, given as (n1, n2, k)."""
    return ("U1", U[:3]), ("U2", U[3:])


def outside_nullclines(coefficients: AtZ, limit_directions: list[float], view: float) -> tuple[NullclineBranch, ...]:
    """Nullclines outside, to the corners of a view of that half-width: rays, and the straight lines continued.

    Where U is not affine in (c, s), U1 = 0 and U2 = 0 are rays too, and none is straight if U reads x or y.
    """
    reach = math.sqrt(2.0) * view
    affine = _affine(coefficients)
    if affine is None:
        one = constant()
        return tuple(_branch(kind, False, _drawn(curve, one)) for kind, curve in outside_curves(coefficients, reach))
    U, radial = affine
    branches = []
    rays: tuple[tuple[Kind, list[float]], ...] = (
        ("rho", radial),
        ("theta", limit_directions),
    )
    for kind, angles in rays:
        for t in angles:
            u = np.array([math.cos(t), math.sin(t)])
            branches.append(NullclineBranch(kind, False, np.stack([u, reach * u])))
    for kind, (n1, n2, k) in _lines(U):
        outer, inner = _chord(n1, n2, k / reach), _chord(n1, n2, k)
        if outer is None:
            continue
        start, end = reach * outer[0], reach * outer[1]
        pieces = [(start, end)] if inner is None else [(start, inner[0]), (inner[1], end)]
        branches += [NullclineBranch(kind, False, np.stack(piece)) for piece in pieces]
    for branch in branches:
        branch.points.flags.writeable = False
    return tuple(branches)


def nullclines(system: AnySystem, psi: Psi, z: ArrayLike = (), *, view: float = 2.0) -> tuple[NullclineBranch, ...]:
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
    tuple of NullclineBranch
    """
    if not view > 1.0:
        raise ValueError(f"view is {view}; give a half-width greater than 1 (the equator).")
    coefficients = system.at(z)
    directions = [float(t) for t in equator_equilibria(coefficients).theta]
    return inside_nullclines(coefficients, psi, directions) + outside_nullclines(coefficients, directions, view)
