"""The equator as a closed orbit, where Theta has no zero (Theorem 3.1(c)): period and stability, closed forms."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...numerics.trigonometric import line_pair, tangential_zeros
from ...numerics.trigonometric_exact import to_integers
from ...results.result import Result
from ...results.tables import html_table, paragraphs, table_number
from ...results.words import say
from ...systems.kinds import AnySystem, takes_names
from .equator_zeros import equator_as_orbit

SADDLE_NODE_DISTANCE = 1e-4  # distance from a saddle-node below which the zeros need more than doubles
NEUTRAL_EQUATOR = 2.0**-49  # of the terms of the exponent: zero within rounding


@dataclass(frozen=True, eq=False)
class EquatorCycle(Result):
    """The equator as a closed orbit (Theorem 3.1(c)).

    Attributes
    ----------
    direction : int
        +1 if theta increases, -1 if it decreases.
    period : float
        In T (dT = dt/rho): the integral of 1/|Theta|.
    exponent : float
        The integral of lambda_rho/|Theta|: ln rho changes by this much in one turn. Exactly 0.0 if `neutral`.
    neutral : bool
        The exponent is zero within rounding.
    """

    direction: int
    period: float
    exponent: float
    neutral: bool

    def _tables_(self) -> str:
        numbers = html_table(("period in T", "exponent"), [(table_number(self.period), table_number(self.exponent))])
        return paragraphs([self.sentence]) + numbers

    @property
    def stable_outside(self) -> bool:
        """Orbits outside (rho > 0) spiral in, and those on the hemisphere leave the equator."""
        return self.exponent < 0.0

    @property
    def sentence(self) -> str:
        """One sentence for people."""
        turn = "anticlockwise" if self.direction > 0 else "clockwise"
        if self.neutral:
            return say("closed orbit, neutral", turn=turn)
        outside, inside = ("attracting", "repelling") if self.stable_outside else ("repelling", "attracting")
        return say("closed orbit", turn=turn, outside=outside, inside=inside)


@takes_names
def equator_cycle(system: AnySystem, z: ArrayLike = ()) -> EquatorCycle | None:
    """Find the closed orbit on the equator, or None if the equator has equilibria (Theorem 3.1(c)).

    lambda_rho = (d cos^2 + a sin^2) - Theta', and Theta'/|Theta| integrates to 0 over a turn: the exponent is
    d times the integral of cos^2/|Theta| plus a times that of sin^2/|Theta|. With 1/|Theta| written as
    1/(K |1 - conj(z1) e|^2 |1 - conj(z2) e|^2), e = exp(i theta), its Fourier coefficients are closed forms in
    z1 and z2, the zeros inside the unit circle. For a general system both integrals are means over equally spaced
    angles, refined until they stand.

    Parameters
    ----------
    system : ELinear or System, or either frozen at a z
    z : (m,) floats
        Slow variables.

    Returns
    -------
    EquatorCycle or None

    Raises
    ------
    ValueError
        If z does not fit the system or a coefficient is not finite.

    Examples
    --------
    Where A turns all directions alike, a closed orbit is the equator itself; its exponent is 2 pi a/b:

    >>> import math
    >>> from codim2_core import ELinear, equator_cycle
    >>> found = equator_cycle(ELinear(-1, 2, -1))
    >>> round(found.exponent/math.pi, 12)
    -1.0
    """
    at = system.at(z)
    q = at.normal_form
    if q is None:
        found = equator_as_orbit(at.key)
        return None if found is None else EquatorCycle(*found)
    a, b, d, f1, f2 = q.a, q.b, q.d, q.f1, q.f2
    zeros = tangential_zeros(a, b, d, f1, f2)
    if zeros.theta or zeros.identically_zero:
        return None
    exponent = math.frexp(max(abs(a), abs(b), abs(d), abs(f1), abs(f2)))[1]
    a, b, d, f1, f2 = (math.ldexp(v, -exponent) for v in (a, b, d, f1, f2))
    if b == 0.0:  # below 1e-308 of a and d, which then differ by less: one turn takes for ever
        return EquatorCycle(1 if q.b > 0.0 else -1, math.inf, math.copysign(math.inf, a + d), False)
    if math.hypot(f1, f2) + 0.5 * abs(d - a) <= 0.5 * abs(b):
        unit = abs(b)  # of time: its inverse may be beyond all doubles
        g0, g2 = _mean_rule(f2 / b, f1 / b, (d - a) / b)
    else:
        unit = 1.0
        g0, g2 = _fourier_of_reciprocal(b, f2, f1, a, d, zeros.distance)
    cos2, sin2 = 0.5 * (g0 + g2), 0.5 * (g0 - g2)
    value = d * cos2 + a * sin2
    neutral = abs(value) <= NEUTRAL_EQUATOR * (abs(a) + abs(d)) * g0
    period = g0 / unit / math.ldexp(1.0, exponent)
    return EquatorCycle(1 if b > 0.0 else -1, period, 0.0 if neutral else value / unit, neutral)


_ANGLES = np.arange(72) * (2.0 * math.pi / 72.0)
_COS, _SIN = np.cos(_ANGLES), np.sin(_ANGLES)
_SIN2, _COS2 = np.sin(2.0 * _ANGLES), np.cos(2.0 * _ANGLES)


def _mean_rule(f2: float, f1: float, difference: float) -> tuple[float, float]:
    """Integrate as `_fourier_of_reciprocal`, by the mean over 72 directions, where Theta is within half of b = 1.

    The zeros of Theta then have |e| < 0.52 or more than its inverse: the rule is off by 0.52^72 = 4e-21. The closed
    form would lose digits there, its zeros being far apart in size.
    """
    reciprocal = 1.0 / (1.0 + f2 * _COS - f1 * _SIN + 0.5 * difference * _SIN2)
    step = 2.0 * math.pi / 72.0
    return step * float(reciprocal.sum()), step * float(reciprocal @ _COS2)


def _fourier_of_reciprocal(b: float, f2: float, f1: float, a: float, d: float, distance: float) -> tuple[float, float]:
    """Integrals over a turn of 1/|Theta| and cos 2 theta/|Theta|, where Theta has no zero."""
    h, s2 = math.hypot(f1, f2), 0.5 * (d - a)
    if abs(s2) < 1e-17 * (abs(b) + h):
        lines = [(b, h, math.atan2(-f1, f2))]
    else:
        h, g1, nu1, g2, nu2, _ = line_pair(b, f2, -f1, 0.0, s2)
        lines = [(g1, h, nu1), (g2, h, nu2)]
    roots, gaps, close = [0j, 0j], [1.0, 1.0], False
    for i, (g, h, nu) in enumerate(lines):
        # |g + h cos(theta - nu)| is proportional to |1 - r exp(i (theta - nu))|^2.
        steep = math.sqrt(max(abs(g) - h, 1e-16 * h) * (abs(g) + h))
        r = math.copysign(h / (abs(g) + steep), -g)
        roots[i] = complex(r * math.cos(nu), r * math.sin(nu))
        gaps[i] = 2.0 * steep / (abs(g) + steep)  # 1 - r^2, without cancellation
        if distance < SADDLE_NODE_DISTANCE and gaps[i] < 0.1:
            roots[i], gaps[i] = _polish_circle_zero((b, f2, -f1, 0.5 * a, 0.5 * d), roots[i])
            close = True
    z1, z2 = roots
    total, product = z1 + z2, z1 * z2
    # The mean of Theta is b: it fixes the amplitude K.
    amplitude = abs(b) / ((2.0 - gaps[0]) * (2.0 - gaps[1]) + 2.0 * (z1 * z2.conjugate()).real)
    if not close:
        return _integrals(*_factor(b, f2, f1, s2, amplitude))
    outer = gaps[0] + gaps[1] - gaps[0] * gaps[1]  # 1 - |z1 z2|^2
    g0 = 2.0 * math.pi * outer / (amplitude * gaps[0] * gaps[1] * abs(1.0 - z1 * z2.conjugate()) ** 2)
    g1 = g0 * (total - product * total.conjugate()) / outer
    return g0, (total * g1).real  # and -product g0, which is imaginary


def _factor(b: float, f2: float, f1: float, s2: float, amplitude: float) -> tuple[float, complex, complex]:
    """Refine K, z1 + z2 and z1 z2, harmonic by harmonic: they keep the digits that nearly equal z1 and z2 lose."""
    sign = math.copysign(1.0, b)
    first, second = sign * complex(f2, -f1), sign * complex(0.0, s2)

    def parts(K: float) -> tuple[float, complex, complex]:
        product = second / (2.0 * K)
        # 2 K (total + product conj(total)) = -first
        w = -first / (2.0 * K)
        total = (w - product * w.conjugate()) / (1.0 - abs(product) ** 2)
        return K * (1.0 + abs(total) ** 2 + abs(product) ** 2) - abs(b), total, product

    K = amplitude
    for _ in range(3):
        value, h = parts(K)[0], 1e-6 * K
        slope = (parts(K + h)[0] - parts(K - h)[0]) / (2.0 * h)
        K -= value / slope
    return K, *parts(K)[1:]


def _integrals(K: float, total: complex, product: complex) -> tuple[float, float]:
    """Fourier coefficients 0 and 2 of 1/|Theta| from K, z1 + z2 and z1 z2, times 2 pi."""
    outer = 1.0 - abs(product) ** 2
    skew = total - product * total.conjugate()
    g0 = 2.0 * math.pi * outer / (K * (outer * outer - abs(skew) ** 2))
    g1 = g0 * skew / outer
    return g0, (total * g1).real  # and -product g0, which is imaginary


def _polish_circle_zero(
    coefficients: tuple[float, float, float, float, float], start: complex
) -> tuple[complex, float]:
    """Newton's method in 256-bit fixed point for a zero inside the circle; also 1 - |z|^2, to all digits."""
    bits = 256
    (m, c1, s1, half_a, half_d), _ = to_integers(coefficients)
    s2 = half_d - half_a
    # 2 z^2 Theta = (-i s2) z^4 + (c1 - i s1) z^3 + 2 m z^2 + (c1 + i s1) z + i s2, highest power first
    rows = ((0, -s2), (c1, -s1), (2 * m, 0), (c1, s1), (0, s2))
    x, y = int(start.real * 2.0**60) << (bits - 60), int(start.imag * 2.0**60) << (bits - 60)
    for _ in range(100):
        vr = vi = dr = di = 0
        for re, im in rows:
            dr, di = ((dr * x - di * y) >> bits) + vr, ((dr * y + di * x) >> bits) + vi
            vr, vi = ((vr * x - vi * y) >> bits) + (re << bits), ((vr * y + vi * x) >> bits) + (im << bits)
        size = dr * dr + di * di
        if not size:
            break
        step_x, step_y = ((vr * dr + vi * di) << bits) // size, ((vi * dr - vr * di) << bits) // size
        x, y = x - step_x, y - step_y
        if abs(step_x) + abs(step_y) < 1 << (bits - 180):
            break
    one = 1 << (2 * bits)
    square = x * x + y * y
    z = complex(x / (1 << bits), y / (1 << bits))
    if square > one:  # the mirror image outside
        return z * (one / square), (square - one) / square
    return z, (one - square) / one
