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

from ...numerics.trigonometric import INPUT_ROUNDING, radial_zeros
from ...results.arrays import Array, join_columns
from ...systems.coefficients import Coefficients
from ...systems.frozen import FrozenSystem
from ..layer_problem.problem import LayerProblem
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
    """The conic m = -L/Q over a span of directions; `cut` where it ends exactly on the unit circle."""

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


STRAIGHT_DISTANCE = (
    1e6  # of the view: a hyperbola whose centre is farther away is a straight line in it, to 1e-5 of the view
)
CHORD_TOLERANCE = 5e-4  # of the view: farther than this from the hyperbola no chord may be
MAX_PIECE_POINTS = 4000  # points of a piece
MAX_PARAMETER_STEP = 0.5  # step of t on the hyperbola (e^t, e^-t)


@dataclass(frozen=True, eq=False)
class Conics:
    """The conic Theta = 0, (4.10), and where it meets the unit circle, (4.11)."""

    # "hyperbola", "two lines" (it falls apart), "line" (a = d, degenerate case D1), "none" (a = d, f = 0), "plane"
    # (b = 0 as well: every direction is a limit direction), or "" for a system that is not e-linear
    kind: str
    # (k, 2) The conic within the square |x|, |y| <= view, in the axes of the system; branches are never joined
    pieces: tuple[Array, ...]
    meeting: Array  # (j, 2) The limit directions as points of the circle


def conics_of(problem: LayerProblem, view: float = 2.0, pixel: float | None = None) -> Conics:
    """Return the conic (d - a) x y + f2 x - f1 y + b = 0 of the normal form, and the limit directions on it."""
    form, theta = problem.at.normal_form, problem.equator.theta
    meeting = _read_only(np.stack([np.cos(theta), np.sin(theta)], axis=-1))
    if form is None:
        return Conics("", (), meeting)
    turned = problem.at.as_given is None
    reach = view * math.sqrt(2.0) if turned else view
    within = CHORD_TOLERANCE * reach if pixel is None else 0.25 * pixel
    kind, pieces = _conic(form.d - form.a, form.f2, -form.f1, form.b, reach, within)
    if turned:
        c, s = math.cos(form.rotation), math.sin(form.rotation)
        pieces = [piece @ np.array([[c, -s], [s, c]]) for piece in pieces]
    return Conics(kind, tuple(_read_only(piece) for piece in pieces), meeting)


def _read_only(points: Array) -> Array:
    """Return the points, read-only."""
    points.setflags(write=False)
    return points


def _conic(q: float, p1: float, p2: float, b: float, reach: float, within: float) -> tuple[str, list[Array]]:
    """Return the kind of q x y + p1 x + p2 y + b = 0, and its pieces with |x|, |y| <= reach."""
    if q == p1 == p2 == 0.0:
        return ("plane" if b == 0.0 else "none"), []
    if q == 0.0:
        return "line", _line_pieces(p1, p2, b, reach)
    h, k = -p2 / q, -p1 / q  # the centre: (x - h)(y - k) = product
    if not max(abs(h), abs(k)) <= STRAIGHT_DISTANCE * reach:
        return "hyperbola", _line_pieces(p1, p2, b, reach)
    product = h * k - b / q
    if abs(product) <= INPUT_ROUNDING * (abs(h * k) + abs(b / q)):
        return "two lines", [*_line_pieces(1.0, 0.0, -h, reach), *_line_pieces(0.0, 1.0, -k, reach)]
    return "hyperbola", _hyperbola_pieces(h, k, product, reach, within)


def _line_pieces(p1: float, p2: float, b: float, reach: float) -> list[Array]:
    """Return p1 x + p2 y + b = 0 within the square, from border to border; [] where it misses it."""
    size = max(abs(p1), abs(p2))
    p1, p2, b = p1 / size, p2 / size, b / size
    if abs(p1) > abs(p2):
        return [line[:, ::-1] for line in _line_pieces(p2, p1, b, reach)]
    slope, offset = -p1 / p2, -b / p2  # |slope| <= 1
    x = np.array([-reach, reach])
    if slope:
        at = sorted(((-reach - offset) / slope, (reach - offset) / slope))
        x = np.array([max(-reach, at[0]), min(reach, at[1])])
    elif abs(offset) > reach:
        return []
    return [np.stack([x, slope * x + offset], axis=-1)] if x[0] < x[1] else []


def _hyperbola_pieces(h: float, k: float, product: float, reach: float, within: float) -> list[Array]:
    """Return the pieces of (x - h)(y - k) = product, x - h = ±size e^t and y - k = ±size e^-t on each branch."""
    size = math.sqrt(abs(product))
    # a chord over a step s of t is within size s^2/(4 sqrt 2) of its arc
    step = min(MAX_PARAMETER_STEP, math.sqrt(4.0 * math.sqrt(2.0) * within / size))
    pieces = []
    for sign in (1.0, -1.0):
        up = math.copysign(sign, sign * product)
        low_x, high_x = _exponents(h, sign, size, reach)
        low_y, high_y = _exponents(k, up, size, reach)
        low, high = max(low_x, -high_y), min(high_x, -low_y)
        if not low < high:
            continue
        t = np.linspace(low, high, min(MAX_PIECE_POINTS, 2 + math.ceil((high - low) / step)))
        points = np.stack([h + sign * size * np.exp(t), k + up * size * np.exp(-t)], axis=-1)
        pieces.append(np.clip(points, -reach, reach))  # a centre far away costs digits
    return pieces


def _exponents(middle: float, sign: float, size: float, reach: float) -> tuple[float, float]:
    """Return between which t the coordinate middle + sign size e^t is within the reach; low > high if nowhere."""
    near, far = sorted((sign * (-reach - middle), sign * (reach - middle)))
    if far <= 0.0:
        return 1.0, -1.0
    return (math.log(near / size) if near > 0.0 else -math.inf), math.log(far / size)
