"""The Jacobian of a critical set, (3.23), and the determinants behind it, without cancellation.

The critical set of the e-linear system (Theorem 4.1) solves A e + f = 0. The solution is ``e = -A^-1 f = -n/det A``
with ``n = adj(A) f``, and a critical set exists iff ``|n| < |det A|``. All is decided in integers, as which the given
doubles are taken; within their rounding the border itself is the (named) answer.
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
from ...systems.psi.function import Psi

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


# Below this fraction of its terms a sum of products is recomputed exactly (rounding then stays below 1e-12 of it).
CANCELLATION = 1e-3
NEUTRAL_TRACE = 16 * 2.0**-53  # of the terms of tr J: zero within rounding


def scale_by_power_of_two(values: tuple[float, ...]) -> tuple[float, ...]:
    """Values times one power of two that brings the largest near 1: exact, and no product over- or underflows."""
    size = max(map(abs, values))
    if size == 0.0:
        return values
    shift = -math.frexp(size)[1]
    return tuple([math.ldexp(v, shift) for v in values])


def determinant_sign(a: float, b: float, d: float) -> int:
    """Sign of ``det A = a d + b^2``, 0 when it vanishes within the rounding of a, b, d."""
    a, b, d = scale_by_power_of_two((a, b, d))
    size = abs(a * d) + b * b
    det = a * d + b * b
    if size == 0.0:
        return 0
    if abs(det) < CANCELLATION * size or size < 1e-280:
        exact = Fraction(a) * Fraction(d) + Fraction(b) ** 2
        weight = abs(Fraction(a) * Fraction(d)) + Fraction(b) ** 2
        if abs(exact) <= 2 * Fraction(INPUT_ROUNDING) * weight:
            return 0
        return 1 if exact > 0 else -1
    return 1 if det > 0 else -1


def matrix_determinant(m11: float, m12: float, m21: float, m22: float) -> tuple[float, int]:
    """``det M`` of the doubles as given, to full relative accuracy, and its sign: 0 within their rounding."""
    shift = -math.frexp(max(abs(m11), abs(m12), abs(m21), abs(m22)) or 1.0)[1]
    m11, m12, m21, m22 = [math.ldexp(v, shift) for v in (m11, m12, m21, m22)]
    det, size = m11 * m22 - m12 * m21, abs(m11 * m22) + abs(m12 * m21)
    if size == 0.0:
        return 0.0, 0
    if abs(det) >= CANCELLATION * size and size >= 1e-280:
        return math.ldexp(det, -2 * shift), 1 if det > 0.0 else -1
    first, second = Fraction(m11) * Fraction(m22), Fraction(m12) * Fraction(m21)
    exact = first - second
    within = abs(exact) <= 2 * Fraction(INPUT_ROUNDING) * (abs(first) + abs(second))
    return math.ldexp(float(exact), -2 * shift), 0 if within else 1 if exact > 0 else -1


@dataclass(frozen=True, slots=True)
class Frame:
    """The Jacobian (3.23) in the axes along e and across it, where D e_Psi is diagonal.

    ``J = [[along, *], [*, across]]``; written so, trace and determinant have no cancellation that the coefficients
    do not have: b, however large, stays out of the trace.
    """

    along: float  # diagonal entries
    across: float
    turning: float  # product of the other two
    determinant: float
    sign: int  # of the determinant; 0 within the rounding of a, b, d
    size: float  # sum of the sizes of the terms of the trace


LinearisationParts = tuple[tuple[float, float], tuple[float, float], tuple[float, float, float, float], Frame]


def linearisation(
    M: tuple[float, float, float, float], psi: Psi, e: tuple[float, float], complement: float, sign: int
) -> LinearisationParts:
    """Place and Jacobian of the critical set with ``e_Psi = e``, where M = D_e U (rows first) has that sign of det M.

    J: (3.23), ``M . D e_Psi``; D e_Psi has eigenvalue `radial` along e and `tangential` across it.
    """
    m11, m12, m21, m22 = M
    modulus = math.hypot(*e)
    zeta = float(psi.radius(modulus, complement)) if modulus > 0.0 else 0.0
    radial, tangential = map(float, psi.jacobian_factors(zeta))
    c, s = (e[0] / modulus, e[1] / modulus) if modulus > 0.0 else (1.0, 0.0)
    # M in the axes along e and across it, where D e_Psi is diag(radial, tangential)
    n11, n12 = c * c * m11 + c * s * (m12 + m21) + s * s * m22, c * c * m12 + c * s * (m22 - m11) - s * s * m21
    n21, n22 = c * c * m21 + c * s * (m22 - m11) - s * s * m12, c * c * m22 - c * s * (m12 + m21) + s * s * m11
    cc, ss = c * c, s * s
    mixed = 0.0 if m12 == -m21 else abs(c * s) * (abs(m12) + abs(m21))  # b, however large, stays out of the trace
    frame = Frame(
        radial * n11,
        tangential * n22,
        radial * tangential * n12 * n21,
        radial * tangential * matrix_determinant(*M)[0],
        sign,
        radial * (cc * abs(m11) + mixed + ss * abs(m22)) + tangential * (cc * abs(m22) + mixed + ss * abs(m11)),
    )
    # radial - tangential, without the cancellation near the centre
    spread = tangential * (complement * psi.steepness(zeta) - modulus * modulus)
    D11, D12, D22 = tangential + spread * c * c, spread * c * s, tangential + spread * s * s
    jacobian = (m11 * D11 + m12 * D12, m11 * D12 + m12 * D22, m21 * D11 + m22 * D12, m21 * D12 + m22 * D22)
    return (zeta * c, zeta * s), (zeta * c / math.hypot(1.0, zeta), zeta * s / math.hypot(1.0, zeta)), jacobian, frame


def spectrum(frame: Frame, blur: float = 0.0) -> tuple[float, float, float, str, tuple[complex, complex]]:
    """Trace, determinant, discriminant, kind and eigenvalues of a Jacobian; a trace within rounding or `blur` is 0."""
    trace = frame.along + frame.across
    half, difference = 0.5 * trace, 0.5 * (frame.along - frame.across)
    quarter = difference * difference + frame.turning  # discriminant / 4, without the cancellation in tr^2 - 4 det
    neutral = abs(trace) <= max(NEUTRAL_TRACE * frame.size, blur)
    if quarter >= 0.0:
        root = math.sqrt(quarter)
        large = half + math.copysign(root, half)
        small = frame.determinant / large if large != 0.0 else 0.0
        pair = (complex(max(large, small)), complex(min(large, small)))
    else:
        root = math.sqrt(-quarter)
        pair = (complex(half, root), complex(half, -root))
    if frame.sign < 0:
        kind = "saddle"
    elif neutral:
        kind = "centre (linear)"
    else:
        kind = ("stable " if trace < 0.0 else "unstable ") + ("node" if quarter >= 0.0 else "focus")
    return trace, frame.determinant, 4.0 * quarter, kind, pair
