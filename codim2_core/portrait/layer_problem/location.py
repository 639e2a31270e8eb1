"""Solve A e + f = 0 in the disc: the critical set of the e-linear system, Theorem 4.1.

The solution is ``e = -A^-1 f = -n/det A`` with ``n = adj(A) f``, and a critical set exists iff ``|n| < |det A|``. All
is decided in integers, as which the given doubles are taken; within their rounding the border itself is the (named)
answer.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from enum import Enum
from fractions import Fraction

from ...numerics.trigonometric_exact import INPUT_ROUNDING, to_integers
from ...results.words import say
from ...systems.coefficients import Affine
from ...systems.frozen import FrozenSystem
from .linearisation import scale_by_power_of_two

#: How far, relatively, a product of two entries may be off, as a quotient of integers.
_OFF, _PER = (2 * Fraction(INPUT_ROUNDING)).as_integer_ratio()


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
    """Decide whether, and where, ``A e + f = 0`` in the disc |e| < 1 (Theorem 4.1(a)), in the axes of `at`."""
    if at.affine is None:
        raise ValueError("U is not e-linear; give a system whose U is affine in (c, s).")
    return rotate_location(_locate(at.affine), at.turn)


def _locate(affine: Affine) -> Location:
    """Decide as `locate`, in the axes of ``affine = (A11, A12, A21, A22, f1, f2)``, by integers: exactly."""
    (m11, m12, m21, m22, f1, f2), _ = to_integers(affine)
    det, n1, n2 = m11 * m22 - m12 * m21, m22 * f1 - m12 * f2, m11 * f2 - m21 * f1
    w0 = abs(m11 * m22) + abs(m12 * m21)
    w1, w2 = abs(m22 * f1) + abs(m12 * f2), abs(m11 * f2) + abs(m21 * f1)
    if not any(affine):
        return Location(Existence.EVERYTHING)
    if abs(det) * _PER <= _OFF * w0:
        solvable = any(affine[:4]) and abs(n1) * _PER <= _OFF * w1 and abs(n2) * _PER <= _OFF * w2
        return _solution_line(affine) if solvable else Location(Existence.SINGULAR_NONE)
    gap = det * det - n1 * n1 - n2 * n2
    # Half the first-order change of the gap when each entry is off by a relative 1; -b and b are off together.
    by_12, by_21 = n1 * m12 * f2 - det * m12 * m21, n2 * m21 * f1 - det * m12 * m21
    change = (
        abs(det * m11 * m22 - n2 * m11 * f2)
        + (abs(by_12 + by_21) if m12 == -m21 else abs(by_12) + abs(by_21))
        + abs(det * m11 * m22 - n1 * m22 * f1)
        + abs(n2 * m21 * f1 - n1 * m22 * f1)
        + abs(n1 * m12 * f2 - n2 * m11 * f2)
    )
    # Near det A = 0 first order is not enough: |adj(A) f| and |det A| must be able to meet.
    least = sum(max(abs(n) * _PER - _OFF * w, 0) ** 2 for n, w in ((n1, w1), (n2, w2)))
    if abs(gap) * _PER <= _OFF * change and least <= (abs(det) * _PER + _OFF * w0) ** 2:
        return Location(Existence.EQUATOR, direction=math.atan2(-n2 / det, -n1 / det))
    if gap < 0:
        return Location(Existence.NONE)
    return Location(Existence.INSIDE, (-n1 / det + 0.0, -n2 / det + 0.0), gap / det**2)


def _solution_line(affine: Affine) -> Location:
    """Line of solutions of a singular matrix: of its larger row."""
    m11, m12, m21, m22, f1, f2 = scale_by_power_of_two(affine)
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
