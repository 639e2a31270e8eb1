"""Near-zeros of a trigonometric polynomial of degree 2: a pair of lines meets the unit circle.

With (X, Y) = (cos theta, sin theta) the polynomial is a conic. Some member of its pencil with the unit circle is a pair
of real lines; they meet the circle where the polynomial vanishes.
"""

from __future__ import annotations

import math

__all__ = ["line_pair", "starts_of"]


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
    """Write t as (h cos(theta - nu1) + g1) (h cos(theta - nu2) + g2), always possible with real numbers.

    `miss` bounds what of the first harmonic the product leaves over.
    """
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
