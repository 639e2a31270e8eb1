"""All real zeros of a trigonometric polynomial of degree 2, with multiplicity, for every input.

The equilibria on the equator (4.9) and the directions of zero radial speed are zeros of

    t(theta) = m0 + c1 cos(theta) + s1 sin(theta) + c2 cos(2 theta) + s2 sin(2 theta).

Plain floats only: this runs on every slider frame, before anything is compiled. The unit circle meets the
conic t = 0; a degenerate member of their pencil is a pair of lines, which gives the zeros; Newton's method
polishes them. The number of zeros is decided by the discriminant with a bound on its rounding error. Where the
bound does not decide, or a zero is ill-conditioned, `trigonometric_exact` starts again with integers.

What "multiple" means for typed numbers: a zero is reported as double, triple or fourfold if coefficients exist
that have it and differ from every given one by at most `INPUT_ROUNDING` (1.4 half-units in the last place); the
highest such multiplicity wins. `exact_count` is the number of distinct zeros of the doubles as given.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from .trigonometric_exact import INPUT_ROUNDING, solve_exactly

__all__ = [
    "GENERAL_PATTERNS", "INPUT_ROUNDING", "THETA_PATTERNS", "TrigonometricZeros", "line_pair", "radial_zeros",
    "real_zeros", "starts_of", "tangential_zeros",
]  # fmt: skip


def starts_of(
    m: float, c1: float, s1: float, c2: float, s2: float, r1: float, r2: float, clear: float
) -> list[float] | None:
    """Approximate zeros: where a pair of lines of the pencil meets the circle. None where not clear."""
    if r2 < 1e-16 * (r1 + m * m):
        # A first harmonic and almost nothing else.
        h = math.sqrt(r1)
        if abs(abs(m) - h) <= math.sqrt(r2) + clear:
            return None
        return _chord(h, m, math.atan2(s1, c1)) if abs(m) < h else []
    h, g1, nu1, g2, nu2, miss = line_pair(m, c1, s1, c2, s2)
    first, second = abs(g1) < h, abs(g2) < h
    if not first and not second:
        product = (abs(g1) - h) * (abs(g2) - h)
        return [] if product > miss + clear + 1e-12 * abs(g1 * g2) else None
    starts = _chord(h, g1, nu1) if first else []
    return starts + _chord(h, g2, nu2) if second else starts


def line_pair(m: float, c1: float, s1: float, c2: float, s2: float) -> tuple[float, float, float, float, float, float]:
    """Write t as (h cos(theta - nu1) + g1) (h cos(theta - nu2) + g2); `miss` bounds what that leaves over."""
    r = math.hypot(c2, s2)
    psi = 0.5 * math.atan2(s2, c2)
    cp, sp = math.cos(psi), math.sin(psi)
    alpha, beta = c1 * cp + s1 * sp, s1 * cp - c1 * sp
    # In phi = theta - psi: 2r X^2 + alpha X + beta Y + m - r, plus lambda (X^2 + Y^2 - 1), lambda = -2 r y.
    mu = 0.5 * (m - r) / r
    p, q = (0.25 * alpha / r) ** 2, (0.25 * beta / r) ** 2
    y = _pencil_root(mu - 1.0, p + q - mu, -q)
    big_a, big_b = 2.0 * r * (1.0 - y), 2.0 * r * y
    k = m - r + big_b
    ra, rb = math.sqrt(big_a), math.sqrt(big_b)
    if y < 0.5:
        ga = 0.5 * alpha / ra
        gb = math.copysign(math.sqrt(max(0.0, ga * ga - k)), beta)
        miss = abs(2.0 * rb * gb - beta)
    else:
        gb = 0.5 * beta / rb
        ga = math.copysign(math.sqrt(max(0.0, gb * gb + k)), alpha)
        miss = abs(2.0 * ra * ga - alpha)
    # (ra X + ga)^2 - (rb Y - gb)^2 = (ra X + rb Y + ga - gb) (ra X - rb Y + ga + gb)
    g1, g2 = ga - gb, ga + gb
    if abs(g1) < 0.1 * abs(g2):
        g1 = k / g2
    elif abs(g2) < 0.1 * abs(g1):
        g2 = k / g1
    nu = math.atan2(rb, ra)
    return math.sqrt(2.0 * r), g1, psi + nu, g2, psi - nu, miss


def _chord(h: float, g: float, nu: float) -> list[float]:
    """Return the two zeros of h cos(theta - nu) + g, brought near [-pi, pi]."""
    half = math.acos(-g / h)
    return [math.remainder(nu + half, math.tau), math.remainder(nu - half, math.tau)]


def _pencil_root(b: float, c: float, d: float) -> float:
    """Return the steepest root in [0, 1] of y^3 + b y^2 + c y + d; one exists, as d <= 0 <= 1 + b + c + d."""
    third = b / 3.0
    p, q = third * third - c / 3.0, third * (third * third - 0.5 * c) + 0.5 * d
    if q * q < p * p * p:
        root = math.sqrt(p)
        angle = math.acos(max(-1.0, min(1.0, -q / (root * p)))) / 3.0
        # Increasing order; the outer two are at least as steep as the middle one, but may lie outside [0, 1].
        guesses = [2.0 * root * math.cos(angle + k * math.tau / 3.0) - third for k in (1, 2, 0)]
        inside = [y for y in guesses if -1e-9 <= y <= 1.0 + 1e-9] or [0.5]
        y = max(inside, key=lambda y: abs((3.0 * y + 2.0 * b) * y + c))
    else:
        u = -math.copysign((abs(q) + math.sqrt(q * q - p * p * p)) ** (1.0 / 3.0), q)
        y = u + (p / u if u else 0.0) - third
    for _ in range(2):
        slope = (3.0 * y + 2.0 * b) * y + c
        if slope:
            y -= (((y + b) * y + c) * y + d) / slope
    return max(0.0, min(1.0, y))


_FILTER = 2.0**-49  # 16 half-ulps: covers the rounding of the discriminant and the inputs' own ROUNDING
GENERAL_PATTERNS = ((2, 0, 0, 0, 0), (0, 2, 0, 0, 0), (0, 0, 2, 0, 0), (0, 0, 0, 2, 0), (0, 0, 0, 0, 2))
# Rows for b, f2, f1, a, d.
THETA_PATTERNS = ((2, 0, 0, 0, 0), (0, 2, 0, 0, 0), (0, 0, -2, 0, 0), (0, 0, 0, 0, -1), (0, 0, 0, 0, 1))
_RADIAL = ((0, 2, 0, 0, 0), (0, 0, 2, 0, 0), (1, 0, 0, 1, 0), (1, 0, 0, -1, 0))


class TrigonometricZeros(NamedTuple):
    """Zeros of a trigonometric polynomial, in increasing order from direction 0."""

    # directions in [0, 2 pi). A zero below 0 by less than half the spacing of doubles at 2 pi is 0.0
    theta: tuple[float, ...]
    # dt/dtheta there; exactly 0.0 at a multiple zero, never 0.0 at a simple one, alternating in sign
    slope: tuple[float, ...]
    multiplicity: tuple[int, ...]  # 1, 2, 3 or 4 within the rounding of the inputs
    identically_zero: bool  # true if t vanishes for every theta; the tuples are then empty
    exact_count: int  # distinct real zeros of the doubles exactly as given (-1: all directions)
    # first-order estimate of the smallest relative change of all inputs that makes a zero multiple (0.0 if one is
    # named multiple). Usually an estimate from below; inf if no change of this kind exists
    distance: float


def real_zeros(m0: float, c1: float, s1: float, c2: float, s2: float) -> TrigonometricZeros:
    """Real zeros of m0 + c1 cos + s1 sin + c2 cos 2 theta + s2 sin 2 theta, with multiplicity, in radians."""
    inputs = _check_finite((m0, c1, s1, c2, s2), ("m0", "c1", "s1", "c2", "s2"))
    scale, (m0, c1, s1, c2, s2) = _scale_by_power_of_two(inputs)
    fast = _fast(m0, c1, s1, c2, s2, abs(m0), abs(c2), abs(s2))
    return _finish(fast, scale, inputs, GENERAL_PATTERNS)


def tangential_zeros(a: float, b: float, d: float, f1: float, f2: float) -> TrigonometricZeros:
    """Zeros of Theta = (d - a) sin cos + f2 cos - f1 sin + b, equilibria (4.9); `slope` is lambda_theta."""
    inputs = _check_finite((b, f2, f1, a, d), ("b", "f2", "f1", "a", "d"))
    if a == d:
        scale, (b, f2, f1) = _scale_by_power_of_two(inputs[:3])
        fast = _fast(b, f2, -f1, 0.0, 0.0, abs(b), 0.0, 0.0)
        return _finish(fast, scale, inputs[:3], THETA_PATTERNS[:3])
    scale, (b, f2, f1, a, d) = _scale_by_power_of_two(inputs)
    fast = _fast(b, f2, -f1, 0.0, 0.5 * (d - a), abs(b), 0.0, 0.5 * (abs(a) + abs(d)))
    return _finish(fast, scale, inputs, THETA_PATTERNS)


def radial_zeros(a: float, d: float, f1: float, f2: float) -> TrigonometricZeros:
    """Zeros of lambda_rho = a cos^2 + d sin^2 + f1 cos + f2 sin, where the radial speed changes sign, in radians."""
    inputs = _check_finite((f1, f2, a, d), ("f1", "f2", "a", "d"))
    if a == d:
        scale, (f1, f2, a) = _scale_by_power_of_two(inputs[:3])
        fast = _fast(a, f1, f2, 0.0, 0.0, abs(a), 0.0, 0.0)
        return _finish(fast, scale, inputs[:3], (*_RADIAL[:2], (2, 0, 0, 0, 0)))
    scale, (f1, f2, a, d) = _scale_by_power_of_two(inputs)
    size = 0.5 * (abs(a) + abs(d))
    fast = _fast(0.5 * (a + d), f1, f2, 0.5 * (a - d), 0.0, size, size, 0.0)
    return _finish(fast, scale, inputs, _RADIAL)


def _check_finite(values: tuple[float, ...], names: tuple[str, ...]) -> tuple[float, ...]:
    for name, value in zip(names, values, strict=True):
        if not math.isfinite(value):
            raise ValueError(f"{name} = {value!r}: every coefficient must be a finite number; change {name}.")
    return tuple(map(float, values))


def _scale_by_power_of_two(values: tuple[float, ...]) -> tuple[int, list[float]]:
    """Divide by a power of two so that the largest is in [1/2, 1); what underflows is beyond any rounding."""
    exponent = math.frexp(max(map(abs, values)))[1]
    return exponent, [math.ldexp(v, -exponent) for v in values]


def _finish(
    fast: tuple[list[tuple[float, float]], float] | None,
    exponent: int,
    inputs: Sequence[float],
    patterns: Sequence[Sequence[int]],
) -> TrigonometricZeros:
    if fast is not None:
        zeros, distance = fast
        theta = tuple([z[0] for z in zeros])
        slope = tuple([math.ldexp(z[1], exponent) for z in zeros])
        return TrigonometricZeros(theta, slope, (1,) * len(theta), False, len(theta), distance)
    exact = solve_exactly(inputs, patterns)
    # In cyclic order already: zeros closer than the spacing of doubles keep it.
    ordered = [(_wrap_angle(z.theta), z) for z in exact.zeros]
    first = next((i for i in range(1, len(ordered)) if ordered[i][0] < ordered[i - 1][0]), 0)
    ordered = ordered[first:] + ordered[:first]
    return TrigonometricZeros(
        tuple(theta for theta, _ in ordered),
        tuple(z.slope for _, z in ordered),
        tuple(z.multiplicity for _, z in ordered),
        exact.identically_zero,
        exact.exact_count,
        exact.distance,
    )


def _wrap_angle(theta: float) -> float:
    """Bring an angle of (-2 pi, 2 pi) to [0, 2 pi); -1e-17 becomes 0.0."""
    if theta < 0.0:
        theta += math.tau
    return theta if 0.0 < theta < math.tau else 0.0


def _fast(
    m: float, c1: float, s1: float, c2: float, s2: float, em: float, ec2: float, es2: float
) -> tuple[list[tuple[float, float]], float] | None:
    """Certified simple zeros (theta, slope) and the distance, or None where floats do not decide.

    em, ec2, es2 (at least |m|, |c2|, |s2|) are the magnitudes of the inputs they were formed from.
    """
    r2, r1, cs = c2 * c2 + s2 * s2, c1 * c1 + s1 * s1, c1 * s1
    q = c2 * (c1 - s1) * (c1 + s1) + 2.0 * s2 * cs
    invariant_i = 12.0 * r2 - 3.0 * r1 + 4.0 * m * m
    invariant_j = m * (72.0 * r2 + 9.0 * r1 - 8.0 * m * m) - 27.0 * q
    discriminant = invariant_i**3 - invariant_j * invariant_j
    # How much I, J and the discriminant change to first order per relative change of the inputs.
    am, d_r2 = abs(m), 2.0 * (abs(c2) * ec2 + abs(s2) * es2) + _FILTER * (ec2 * ec2 + es2 * es2)
    d_q = (ec2 + 2.0 * abs(c2)) * r1 + (es2 + 2.0 * abs(s2)) * 2.0 * abs(cs)
    d_i = 12.0 * d_r2 + 6.0 * r1 + 8.0 * am * em
    d_j = 72.0 * (d_r2 * am + r2 * em) + 9.0 * r1 * (2.0 * am + em) + 27.0 * d_q + 24.0 * am * am * em
    change = 3.0 * invariant_i * invariant_i * d_i + 2.0 * abs(invariant_j) * d_j
    e_i, e_j = _FILTER * d_i, _FILTER * d_j
    error = _FILTER * change + (3.0 * abs(invariant_i) + e_i) * e_i * e_i + e_j * e_j
    if abs(discriminant) <= error:
        return None
    distance = abs(discriminant) / change
    size = am + math.sqrt(r1) + math.sqrt(r2)
    starts = starts_of(m, c1, s1, c2, s2, r1, r2, 1e-12 * size)
    # Negative: two real zeros. Positive: four or none, and `starts_of` says none only when it is certain.
    if starts is None or len(starts) not in ((2,) if discriminant < 0.0 else (0, 4)):
        return None
    zeros = []
    steep = 1e-6 * size
    for theta in starts:
        slope = 0.0
        for _ in range(5):
            c, s = math.cos(theta), math.sin(theta)
            cc, ss = (c - s) * (c + s), 2.0 * s * c
            slope = s1 * c - c1 * s + 2.0 * (s2 * cc - c2 * ss)
            if -steep < slope < steep:
                return None
            step = (m + c1 * c + s1 * s + c2 * cc + s2 * ss) / slope
            theta -= step
            # |t''| <= 4 size and |slope| >= 1e-6 size: the next step is below 2e6 step^2 < 2e-17.
            if -3e-12 < step < 3e-12:
                slope += step * (c1 * c + s1 * s + 4.0 * (c2 * cc + s2 * ss))
                break
        else:
            return None
        zeros.append((_wrap_angle(_on_axis(theta, m, c1, s1, c2)), slope))
    zeros.sort()
    for i in range(len(zeros)):
        if zeros[i][1] * zeros[i - 1][1] > 0.0:
            return None
    return zeros, distance


def _on_axis(theta: float, m: float, c1: float, s1: float, c2: float) -> float:
    """Return an axis direction exactly when t vanishes on it exactly (b = 0, f2 = 0: 0 and pi)."""
    quarter = round(theta / (0.5 * math.pi))
    axis = quarter * 0.5 * math.pi
    if abs(theta - axis) > 1e-12:
        return theta
    turn = quarter % 4
    first = (c1, s1, -c1, -s1)[turn]
    if math.fsum((m, first, c2 if turn % 2 == 0 else -c2)) != 0.0:
        return theta
    return (0.0, 0.5 * math.pi, math.pi, -0.5 * math.pi)[turn]
