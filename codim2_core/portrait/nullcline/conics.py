"""Nullclines of an e-linear system as curves of the e-disc, in closed form.

Along the direction (cos θ, sin θ) at e = m (cos θ, sin θ) the e-linear field has the components

    radial    m (a cos² + d sin²) + f1 cos + f2 sin          = m Q(θ) + L(θ),
    angular   m ((d − a) sin cos + b) + f2 cos − f1 sin      = m Q(θ) + L(θ),

so each nullcline is a conic through the origin of the e-disc, which every line through the origin meets once more,
at m = −L/Q: a closed form. Where Q and L share a zero the conic falls apart into a diameter and a chord. Outside, e is
the direction itself (m = 1) and the nullclines are rays.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...numerics.trigonometric import radial_zeros
from ...results.arrays import Array, join_columns
from ...systems.coefficients import Coefficients
from ...systems.frozen import FrozenSystem
from .general_nullclines import Kind

Point = tuple[float, float]
ConicCurve = Callable[[Array], Array]  # a parameter in [0, 1] -> points of the closed e-disc

SPIKE = 0.9  # |e| beyond which a nullcline that turns back is drawn from there on both sides


def _radial_angles(coefficients: Coefficients) -> list[float]:
    """Angles in [0, 2 pi) at which lambda_rho = a cos² + d sin² + f1 cos + f2 sin vanishes."""
    return list(radial_zeros(coefficients.a, coefficients.d, coefficients.f1, coefficients.f2).theta)


Affine = tuple[float, float, float, float, float, float]  # U = (A11 c + A12 s + f1, A21 c + A22 s + f2), row by row


def affine_field(at: FrozenSystem) -> tuple[Affine, list[float]] | None:
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


def _linear_part(kind: Kind, U: Affine) -> tuple[float, float]:
    """L as (l1, l2): l1 cos + l2 sin."""
    return (U[2], U[5]) if kind == "rho" else (U[5], -U[2])


def chord_ends(n1: float, n2: float, k: float) -> tuple[Point, Point] | None:
    """Return the ends on the unit circle of the line n.e + k = 0, or None if it misses the open disc."""
    length = math.hypot(n1, n2)
    if length <= abs(k):
        return None
    foot = -k / length
    half = math.sqrt((1.0 - foot) * (1.0 + foot))
    c, s = n1 / length, n2 / length
    return (foot * c + half * s, foot * s - half * c), (foot * c - half * s, foot * s + half * c)


def _null_directions(q11: float, q12: float, q22: float) -> list[float]:
    """Angles in [0, pi) at which q11 cos² + q12 sin cos + q22 sin² = 0 (none if it vanishes identically)."""
    mean, stretch, shear = 0.5 * (q11 + q22), 0.5 * (q11 - q22), 0.5 * q12
    length = math.hypot(stretch, shear)  # mean + length cos(2θ − φ) = 0
    if length == 0.0 or abs(mean) > length:
        return []
    middle, half = math.atan2(shear, stretch), math.acos(-mean / length)
    return sorted({(0.5 * (middle + sign * half)) % math.pi for sign in (1.0, -1.0)})


@dataclass(frozen=True, slots=True)
class Straight:
    """A straight curve of the e-disc between two points."""

    start: Point
    end: Point

    def __call__(self, t: Array) -> Array:
        """Points at the parameters t in [0, 1]."""
        start, end = np.array([self.start, self.end])
        return start + t[:, None] * (end - start)

    @property
    def is_diameter(self) -> bool:
        """Whether it passes through the origin."""
        return bool(self.start[0] * self.end[1] == self.start[1] * self.end[0])


def conic(kind: Kind, U: Affine, ends: list[float]) -> list[ConicCurve]:
    """Branches of one conic in the e-disc; `ends` are the angles in [0, 2 pi) where it meets the unit circle."""
    q11, q12, q22 = _quadratic(kind, U)
    l1, l2 = _linear_part(kind, U)
    size_q, size_l = max(abs(q11), abs(q12), abs(q22)), math.hypot(l1, l2)
    if size_l == 0.0:
        diameters = [(math.cos(t), math.sin(t)) for t in _null_directions(q11, q12, q22)]
        return [Straight((-c, -s), (c, s)) for c, s in diameters]
    c0, s0 = l2 / size_l, -l1 / size_l  # the direction with L = 0: the tangent of the conic at the origin
    at_tangent = q11 * c0 * c0 + q12 * s0 * c0 + q22 * s0 * s0
    if abs(at_tangent) <= 1e-9 * size_l:  # within an angle of 1e-9, far below a pixel, the tangent is the curve
        branches = [Straight((-c0, -s0), (c0, s0))]
        if size_q > 0.0:
            # Q = (l.e)(k.e) with k found along l and across it; the rest of the conic is the line k.e + 1 = 0.
            u1, u2 = l1 / size_l, l2 / size_l
            along = q11 * u1 * u1 + q12 * u1 * u2 + q22 * u2 * u2
            across = 2.0 * (q11 * u1 * c0 + q22 * u2 * s0) + q12 * (u1 * s0 + u2 * c0)
            chord = chord_ends(along * u1 + across * c0, along * u2 + across * s0, size_l)
            if chord is not None:
                branches.append(Straight(*chord))
        return branches
    # A line through the origin, θ mod π, meets the conic once more, at the signed distance m.
    cuts = sorted(t % math.pi for t in ends) or [math.atan2(s0, c0)]
    spans: list[tuple[float, float]] = []
    for left, right in zip(cuts, [*cuts[1:], cuts[0] + math.pi], strict=True):
        c, s = math.cos(0.5 * (left + right)), math.sin(0.5 * (left + right))
        if right - left < 1e-14 or abs(l1 * c + l2 * s) > abs(q11 * c * c + q12 * s * c + q22 * s * s):
            continue
        spans.append((left, right))  # where the conic touches the unit circle, two spans meet: both end there
    return [Arc(span, (q11, q12, q22), (l1, l2), bool(ends)) for span in spans]


@dataclass(frozen=True, slots=True)
class Arc:
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
        """Points at the parameters t in [0, 1]."""
        m, c, s = self._polar(t)
        return join_columns(m * c, m * s)

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


def lines(U: Affine) -> tuple[tuple[Kind, tuple[float, float, float]], ...]:
    """U1 = 0 and U2 = 0 as lines n.e + k = 0, given as (n1, n2, k)."""
    return ("U1", U[:3]), ("U2", U[3:])
