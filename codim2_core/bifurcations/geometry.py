"""The saddle-node curve and the ellipse |A^-1 f| = 1 in the plane (f1, f2), in closed form.

With k = a - d the curve (4.12) is ``f(theta) = (b sin - k cos^3, k sin^3 - b cos)``. Its derivative is
``(cos, sin) r`` with ``r = b + 3 k sin cos``: theta is the direction of its tangent and r its radius of curvature,
so cusps are the zeros of r. On it ``A e(theta) + f = Lambda e(theta)`` with ``Lambda = d cos^2 + a sin^2``, hence

    |A^-1 f|^2 - 1 = Lambda^2 (|adj(A) e|^2 - 2 det A) / det(A)^2 :

it touches the ellipse where Lambda = 0 (there the double zero of Theta is the critical set on the equator), and crosses
it where |adj(A) e|^2 = 2 det A, which is linear in (cos 2 theta, sin 2 theta).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..layer_problem.linearisation import determinant_sign
from .curve import Array, angles_of_cosine

# Two of these points nearer to each other than this (relative, in the squares compared) count as one.
SAME_POINT_SHARE = 1e-12


@dataclass(frozen=True)
class Geometry:
    """The saddle-node curve and the ellipse for one A = [[a, -b], [b, d]]."""

    a: float
    b: float
    d: float

    @cached_property
    def k(self) -> float:
        """``a - d``: half of it is the size of Theta's second harmonic."""
        return self.a - self.d

    @property
    def size(self) -> float:
        """The length that everything in the plane is compared with."""
        return max(abs(self.a), abs(self.b), abs(self.d))

    @cached_property
    def determinant_sign(self) -> int:
        """Sign of det A, 0 within the rounding of a, b, d."""
        return determinant_sign(self.a, self.b, self.d)

    @cached_property
    def coincide(self) -> bool:
        """Whether a = d = 0: the saddle-node circle and the ellipse are the same circle |f| = |b|."""
        return self.a == self.d == 0.0

    @cached_property
    def inseparable(self) -> bool:
        """Whether both curves are the circle |f| = |b| within 1e-6: they differ by Lambda^2/(2 b^2), relatively."""
        return max(abs(self.a), abs(self.d)) <= 1e-3 * abs(self.b)

    def saddle_node(self, theta: Array) -> Array:
        """Points (m, 2) of the saddle-node curve, (4.12)."""
        c, s = np.cos(theta), np.sin(theta)
        return np.stack([self.b * s - self.k * c**3, self.k * s**3 - self.b * c], axis=-1)

    def ellipse(self, phi: Array) -> Array:
        """Points (m, 2) ``-A e(phi)``: there the critical set lies on the equator at phi."""
        c, s = np.cos(phi), np.sin(phi)
        return np.stack([self.b * s - self.a * c, -self.b * c - self.d * s], axis=-1)

    def saddle_node_at(self, theta: float) -> tuple[float, float]:
        """`saddle_node` at one angle, in plain floats."""
        c, s = math.cos(theta), math.sin(theta)
        return self.b * s - self.k * c**3, self.k * s**3 - self.b * c

    def ellipse_at(self, phi: float) -> tuple[float, float]:
        """`ellipse` at one angle, in plain floats."""
        c, s = math.cos(phi), math.sin(phi)
        return self.b * s - self.a * c, -self.b * c - self.d * s

    def on_ellipse(self, f: tuple[float, float]) -> float:
        """Angle phi in [0, 2 pi) with ``-A e(phi)`` parallel to f."""
        sign = -self.determinant_sign
        e1, e2 = sign * (self.d * f[0] + self.b * f[1]), sign * (self.a * f[1] - self.b * f[0])
        return math.atan2(e2, e1) % (2 * math.pi)

    def meeting(self, theta: float) -> float:
        """Angle phi in [0, 2 pi) of the ellipse's point at which the saddle-node curve, at theta, meets it.

        ``f = Lambda e(theta) - A e(theta)``: of its two parts, and not of f, so that a thin ellipse loses no digits.
        """
        c, s = math.cos(theta), math.sin(theta)
        at = 0.0 if theta in self.touching else (self.d * c * c + self.a * s * s) / (self.a * self.d + self.b * self.b)
        e1, e2 = c - at * (self.d * c + self.b * s), s - at * (self.a * s - self.b * c)
        return math.atan2(e2, e1) % (2 * math.pi)

    def outside(self, theta: float) -> float:
        """1 where the saddle-node curve is outside the ellipse at theta, -1 inside; see above."""
        c, s = math.cos(theta), math.sin(theta)
        square = (self.d * c + self.b * s) ** 2 + (self.a * s - self.b * c) ** 2
        return math.copysign(1.0, square - 2.0 * (self.a * self.d + self.b * self.b))

    @cached_property
    def cusps(self) -> list[float]:
        """Angles of the cusps (triple zeros of Theta): sin 2 theta = -2 b/(3 k); two where all four zeros meet."""
        if self.k == 0.0:
            return []
        ratio = -2.0 * self.b / (3.0 * self.k)
        if abs(abs(ratio) - 1.0) <= SAME_POINT_SHARE:
            first = 0.25 * math.copysign(math.pi, ratio) % math.pi
            return [first, first + math.pi]
        return angles_of_cosine(ratio, 0.5 * math.pi)

    @cached_property
    def swallowtail(self) -> bool:
        """Whether |b| = 3|k|/2: the cusps have met in pairs, and Theta has a fourfold zero there."""
        return len(self.cusps) == 2

    @cached_property
    def double(self) -> list[tuple[float, float]]:
        """Pairs of angles at one point of the curve: Theta has two double zeros. For 1/2 <= |b/k| < 3/2."""
        if self.k == 0.0:
            return []
        ratio = self.b / self.k
        cosine = 2.0 * (abs(ratio) - 1.0)
        if abs(cosine + 1.0) <= SAME_POINT_SHARE:
            cosine = -1.0
        if not -1.0 <= cosine < 1.0 - SAME_POINT_SHARE:
            return []
        half, middle = 0.5 * math.acos(cosine), math.copysign(0.25 * math.pi, -ratio)
        # Theta = C (1 - cos(theta - alpha)) (1 - cos(theta - beta)) with alpha + beta = -+ pi/2, harmonic by harmonic
        turn = 2.0 * math.pi
        pairs = [((middle + half) % turn, (middle - half) % turn)]
        if cosine > -1.0:
            pairs.append(((middle + half + math.pi) % turn, (middle - half + math.pi) % turn))
        return pairs

    @cached_property
    def touching(self) -> list[float]:
        """Angles with Lambda = 0: the curve touches the ellipse there, without crossing it."""
        if self.coincide or self.a * self.d > 0.0 or self.determinant_sign == 0:
            return []
        # a s^2 = -d c^2
        first = math.atan2(math.sqrt(abs(self.d)), math.sqrt(abs(self.a)))
        return sorted({t % (2 * math.pi) for t in (first, math.pi - first, math.pi + first, 2 * math.pi - first)})

    @cached_property
    def crossing(self) -> list[float]:
        """Angles with |adj(A) e|^2 = 2 det A: none or four, or two where cusps lie on the ellipse."""
        k, p = abs(self.k), self.a + self.d
        q = math.hypot(p, 2.0 * self.b)
        # det A = (q^2 - k^2)/4, and the equation is cos(2 theta - middle) = (q^2 - 3 k^2)/(2 k q).
        if k == 0.0 or self.determinant_sign <= 0 or q > 3.0 * k * (1.0 + SAME_POINT_SHARE):
            return []
        middle = math.atan2(-2.0 * self.b * self.k, -self.k * p)
        if self.cusps_on_ellipse:
            return sorted((0.5 * middle + turn) % (2 * math.pi) for turn in (0.0, math.pi))
        return angles_of_cosine((q - 3.0 * k * (k / q)) / (2.0 * k), middle)

    @cached_property
    def cusps_on_ellipse(self) -> bool:
        """Whether (a + d)^2 + 4 b^2 = 9 (a - d)^2: two cusps lie on the ellipse (b = 0: a = 2d or d = 2a)."""
        k = 3.0 * abs(self.k)
        return k > 0.0 and abs(math.hypot(self.a + self.d, 2.0 * self.b) - k) <= SAME_POINT_SHARE * k
