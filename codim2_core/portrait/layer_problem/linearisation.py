"""The Jacobian of a critical set, (3.23), and the determinants behind it, without cancellation."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

from ...numerics.trigonometric import INPUT_ROUNDING
from ...systems.psi.function import Psi

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
