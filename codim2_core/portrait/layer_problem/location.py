"""Solve A e + f = 0 in the disc: the critical set of the e-linear system, Theorem 4.1.

The solution is ``e = -A^-1 f = -n/det A`` with ``n = adj(A) f``, and a critical set exists iff ``|n| < |det A|``. That
form never divides by det A. Signs that rounding could blur are decided in exact rational arithmetic of the given
doubles; within the rounding of the inputs the border itself is the (named) answer.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from enum import Enum
from fractions import Fraction
from typing import Any

from ...numerics.double_double import add_pairs, negative, product, square
from ...numerics.trigonometric import INPUT_ROUNDING
from ...results.words import say
from ...systems.coefficients import Affine
from ...systems.frozen import FrozenSystem
from .linearisation import (
    CANCELLATION,
    determinant_sign,
    scale_by_power_of_two,
)

CANCELS = 0.05  # of the terms of a difference: below it, it is computed in twice the precision


def to_all_digits(m11: Any, m12: Any, m21: Any, m22: Any, f1: Any, f2: Any) -> tuple[Any, Any, Any, Any]:
    """Return the gap ``det(A)^2 - |n|^2``, det A and n = adj(A) f, in twice the precision before they are rounded.

    Shapes: m11, m12, m21, m22, f1, f2 (k,).
    """
    det = add_pairs(product(m11, m22), negative(product(m12, m21)))
    n1 = add_pairs(product(m22, f1), negative(product(m12, f2)))
    n2 = add_pairs(product(m11, f2), negative(product(m21, f1)))
    gap = add_pairs(square(det), negative(add_pairs(square(n1), square(n2))))
    return gap[0], det[0], n1[0], n2[0]


class Existence(Enum):
    """The number of critical sets and its reason; the value is the sentence shown."""

    INSIDE = say("exists once")
    NONE = say("exists not")
    EQUATOR = say("exists on the equator")
    SINGULAR_NONE = say("singular, none")
    SINGULAR_LINE = say("singular, a line")
    SINGULAR_OUTSIDE = say("singular, outside")
    EVERYTHING = say("everything, e-linear")


@dataclass(frozen=True, slots=True)
class Location:
    """The solution of ``A e = -f``."""

    existence: Existence
    e: tuple[float, float] | None = None  # the solution, when it lies in the open disc
    complement: float = 1.0  # ``1 - |e|^2`` to full relative accuracy
    direction: float | None = None  # the angle of the solution when it lies on |e| = 1 within rounding
    # ends on |e| = 1 of the line of solutions when det A = 0
    line: tuple[tuple[float, float], tuple[float, float]] | None = None

    @property
    def exact(self) -> bool:
        """Whether the number of critical sets is that of the doubles as they are given, not within their rounding."""
        return self.existence in (Existence.INSIDE, Existence.NONE)

    @property
    def singular(self) -> bool:
        """Whether det A = 0 within the rounding of a, b, d."""
        return self.existence not in (Existence.INSIDE, Existence.NONE, Existence.EQUATOR)


def locate(at: FrozenSystem) -> Location:
    """Decide whether, and where, ``A e + f = 0`` in the disc |e| < 1 (Theorem 4.1(a)), without dividing by det A.

    In the axes of `at`.
    """
    coefficients = at.as_given
    if coefficients is None or coefficients.given is not None:
        if at.affine is None:
            raise ValueError("U is not e-linear; give a system whose U is affine in (c, s).")
        return rotate_location(locate_affine(at.affine), at.turn)
    a, b, d, f1, f2 = scale_by_power_of_two(coefficients.plane)
    if determinant_sign(a, b, d) == 0:
        return _locate_singular(a, b, d, f1, f2)
    det = a * d + b * b
    n1, n2 = d * f1 + b * f2, a * f2 - b * f1
    w0 = abs(a * d) + b * b
    w1, w2 = abs(d * f1) + abs(b * f2), abs(a * f2) + abs(b * f1)
    gap, size = det * det - n1 * n1 - n2 * n2, det * det + n1 * n1 + n2 * n2
    blurred = (
        abs(gap) < CANCELLATION * size
        or abs(det) < CANCELLATION * w0
        or (0.0 < abs(n1) < CANCELLATION * w1)
        or (0.0 < abs(n2) < CANCELLATION * w2)
        or size < 1e-280
    )
    if blurred:
        return _locate_exactly(a, b, d, f1, f2)
    if gap < 0.0:
        return Location(Existence.NONE)
    if gap < CANCELS * size:
        gap, det, n1, n2 = to_all_digits(a, -b, b, d, f1, f2)
    return Location(Existence.INSIDE, (-n1 / det + 0.0, -n2 / det + 0.0), gap / (det * det))


def _locate_exactly(a: float, b: float, d: float, f1: float, f2: float) -> Location:
    A, B, D, F1, F2 = map(Fraction, (a, b, d, f1, f2))
    det, n1, n2 = A * D + B * B, D * F1 + B * F2, A * F2 - B * F1
    gap = det * det - n1 * n1 - n2 * n2
    # Half the first-order change of the gap when each coefficient is off by a relative 1.
    change = (
        abs(n2 * A * F2 - det * A * D)
        + abs(n1 * B * F2 - n2 * B * F1 - 2 * det * B * B)
        + abs(n1 * D * F1 - det * A * D)
        + abs(n1 * D * F1 - n2 * B * F1)
        + abs(n1 * B * F2 + n2 * A * F2)
    )
    off = 2 * Fraction(INPUT_ROUNDING)
    # Near det A = 0 first order is not enough: |adj(A) f| and |det A| must be able to meet.
    parts = ((n1, abs(D * F1) + abs(B * F2)), (n2, abs(A * F2) + abs(B * F1)))
    least = sum(max(abs(n) - off * size, 0) ** 2 for n, size in parts)
    if abs(gap) <= off * change and least <= (abs(det) + off * (abs(A * D) + B * B)) ** 2:
        return Location(Existence.EQUATOR, direction=math.atan2(-n2 / det, -n1 / det))
    if gap < 0:
        return Location(Existence.NONE)
    return Location(Existence.INSIDE, (float(-n1 / det), float(-n2 / det)), float(gap / det**2))


def _locate_singular(a: float, b: float, d: float, f1: float, f2: float) -> Location:
    if a == b == d == 0.0:
        return Location(Existence.EVERYTHING if f1 == f2 == 0.0 else Existence.SINGULAR_NONE)
    A, B, D, F1, F2 = map(Fraction, (a, b, d, f1, f2))
    n1, n2 = D * F1 + B * F2, A * F2 - B * F1
    rounding = 2 * Fraction(INPUT_ROUNDING)
    solvable = abs(n1) <= rounding * (abs(D * F1) + abs(B * F2)) and abs(n2) <= rounding * (abs(A * F2) + abs(B * F1))
    if not solvable:
        return Location(Existence.SINGULAR_NONE)
    return _solution_line((A, -B, B, D, F1, F2))


def locate_affine(affine: Affine) -> Location:
    """Decide as `locate` for any matrix, ``affine = (A11, A12, A21, A22, f1, f2)``, exactly."""
    M = tuple(map(Fraction, scale_by_power_of_two(affine)))
    m11, m12, m21, m22, f1, f2 = M
    det, n1, n2 = m11 * m22 - m12 * m21, m22 * f1 - m12 * f2, m11 * f2 - m21 * f1
    off = 2 * Fraction(INPUT_ROUNDING)
    w0 = abs(m11 * m22) + abs(m12 * m21)
    w1, w2 = abs(m22 * f1) + abs(m12 * f2), abs(m11 * f2) + abs(m21 * f1)
    if not any(M):
        return Location(Existence.EVERYTHING)
    if abs(det) <= off * w0:
        solvable = any(M[:4]) and abs(n1) <= off * w1 and abs(n2) <= off * w2
        return _solution_line(M) if solvable else Location(Existence.SINGULAR_NONE)
    gap = det * det - n1 * n1 - n2 * n2
    # Half the first-order change of the gap when each entry is off by a relative 1.
    change = (
        abs(det * m11 * m22 - n2 * m11 * f2)
        + abs(n1 * m12 * f2 - det * m12 * m21)
        + abs(n2 * m21 * f1 - det * m12 * m21)
        + abs(det * m11 * m22 - n1 * m22 * f1)
        + abs(n2 * m21 * f1 - n1 * m22 * f1)
        + abs(n1 * m12 * f2 - n2 * m11 * f2)
    )
    # Near det A = 0 first order is not enough: |adj(A) f| and |det A| must be able to meet.
    least = sum(max(abs(n) - off * w, 0) ** 2 for n, w in ((n1, w1), (n2, w2)))
    if abs(gap) <= off * change and least <= (abs(det) + off * w0) ** 2:
        return Location(Existence.EQUATOR, direction=math.atan2(-n2 / det, -n1 / det))
    if gap < 0:
        return Location(Existence.NONE)
    return Location(Existence.INSIDE, (float(-n1 / det), float(-n2 / det)), float(gap / det**2))


def _solution_line(M: tuple[Fraction, ...]) -> Location:
    """Line of solutions of a singular matrix: of its larger row."""
    m11, m12, m21, m22, f1, f2 = map(float, M)
    r1, r2, f = (m11, m12, f1) if math.hypot(m11, m12) >= math.hypot(m21, m22) else (m21, m22, f2)
    length = math.hypot(r1, r2)
    u1, u2, k = r1 / length, r2 / length, -f / length
    if abs(k) >= 1.0:
        return Location(Existence.SINGULAR_OUTSIDE)
    half = math.sqrt((1.0 - k) * (1.0 + k))
    return Location(
        Existence.SINGULAR_LINE,
        line=((k * u1 + half * u2, k * u2 - half * u1), (k * u1 - half * u2, k * u2 + half * u1)),
    )


def rotate_location(location: Location, angle: float) -> Location:
    """Rotate a location by an angle."""
    if angle == 0.0:
        return location
    c, s = math.cos(angle), math.sin(angle)

    def turn(e: tuple[float, float]) -> tuple[float, float]:
        return c * e[0] - s * e[1], s * e[0] + c * e[1]

    return replace(
        location,
        e=None if location.e is None else turn(location.e),
        direction=None if location.direction is None else location.direction + angle,
        line=None if location.line is None else (turn(location.line[0]), turn(location.line[1])),
    )
