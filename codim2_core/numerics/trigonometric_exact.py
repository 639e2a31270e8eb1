"""The slow, exact half of `trigonometric`: integer arithmetic for polynomials near a multiple zero.

The doubles are taken as the exact rationals they are. In w = tan((theta - theta0)/2), with theta0 a rational
direction opposite to one where t is large, t becomes a quartic with integer coefficients and no zero near
infinity. Its zeros are bracketed between those of its derivative, and so on down to a linear polynomial;
every sign is the sign of an integer.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache
from itertools import combinations
from typing import NamedTuple

#: How far, relatively, an input may be off: 1.4 half-units in the last place (0.7 * 2**-52). Points of a
#: stratum computed in doubles lie within 1.0 of it in 99.5 % and within 1.4 in 99.9 % of random trials, while one
#: coefficient changed by 1e-15 at the pitchfork a = -1, b = 0, d = -1.5, f = (-0.5, 0) lies at 1.5.
INPUT_ROUNDING = 0.7 * 2.0**-52
_PER_ROUNDING = int(1.0 / INPUT_ROUNDING)

_AXES = ((1, 0, 1), (0, 1, 1), (-1, 0, 1), (0, -1, 1))
_SLANTED = tuple((i * x, j * y, 5) for x, y in ((3, 4), (4, 3)) for i in (1, -1) for j in (1, -1))
_BASES = (*_AXES, *_SLANTED)


class ExactZero(NamedTuple):
    """A zero as integers: cos = x/n, sin = y/n; its multiplicity and slope dt/dtheta (0.0 if multiple)."""

    x: int
    y: int
    n: int
    multiplicity: int
    slope: float

    @property
    def theta(self) -> float:
        """The direction in (-pi, pi], to the last bits."""
        return math.atan2(self.y / self.n, self.x / self.n)


class ExactZeros(NamedTuple):
    """All zeros, the number of distinct zeros of the unperturbed polynomial, and the nearest degeneracy."""

    zeros: tuple[ExactZero, ...]
    identically_zero: bool
    exact_count: int
    distance: float


def to_integers(values: Sequence[float]) -> tuple[list[int], int]:
    """Write finite doubles as integers times one power of two: values[i] == integers[i] * 2**exponent."""
    parts = [math.frexp(v) for v in values]
    exponents = [e - 53 for m, e in parts if m]
    low = min(exponents, default=0)
    return [int(m * 2.0**53) << (e - 53 - low) if m else 0 for m, e in parts], low


def quotient(top: int, bottom: int, exponent: int) -> float:
    """Divide: top / bottom * 2**exponent for integers of any length, rounded once unless subnormal."""
    shift = top.bit_length() - bottom.bit_length()
    ratio = top / (bottom << shift) if shift >= 0 else (top << -shift) / bottom
    return math.ldexp(ratio, exponent + shift)


def solve_exactly(inputs: Sequence[float], patterns: Sequence[Sequence[int]]) -> ExactZeros:
    """Zeros of sum inputs[i] patterns[i] . (1, cos, sin, cos 2, sin 2)/2, with degeneracies named."""
    integers, exponent = to_integers(inputs)
    rows = [[q * k for k in row] for q, row in zip(integers, patterns, strict=True)]
    total = [sum(column) for column in zip(*rows, strict=True)]
    slack = [sum(abs(v) for v in column) for column in zip(*rows, strict=True)]
    if all(abs(v) * _PER_ROUNDING <= s for v, s in zip(total, slack, strict=True)):
        return ExactZeros((), True, -1 if not any(total) else 4, 0.0)
    base = _pole_free_base(total)
    quartic = _quartic(total, base)
    doubtful = [_quartic(row, base) for row in rows if any(row)]
    # Integers of L bits have critical values down to 2**(-6 L); they are computed to 2**(-2 bits).
    bits = max(192, 32 + 3 * max(abs(v) for v in total).bit_length())
    chain = [quartic]
    while len(chain[-1]) > 2:
        chain.append(_derivative(chain[-1]))
    levels = _real_zeros_of_chain(chain, bits)
    found, distance = _degenerate_zeros(chain, levels, doubtful, bits)
    count = len(levels[0]) if _discriminant(total) else _count_degenerate(quartic, levels, bits)
    zeros = tuple(_exact_direction(p, m, chain[1], base, bits, exponent) for p, m in found)
    return ExactZeros(zeros, False, count, distance)


@cache
def _basis(base: tuple[int, int, int]) -> tuple[tuple[int, ...], ...]:
    """Quartics (constant first) of 1, cos, sin, cos 2, sin 2 over the common denominator h^2 (1 + w^2)^2."""
    c, s, h = base
    x, y, n = (c, -2 * s, -c), (s, 2 * c, -s), (h, 0, h)

    def product(p: Sequence[int], q: Sequence[int]) -> list[int]:
        out = [0] * 5
        for i, a in enumerate(p):
            for j, b in enumerate(q):
                out[i + j] += a * b
        return out

    cos2 = [a - b for a, b in zip(product(x, x), product(y, y), strict=True)]
    sin2 = [2 * a for a in product(x, y)]
    return tuple(tuple(p) for p in (product(n, n), product(x, n), product(y, n), cos2, sin2))


def _quartic(coefficients: Sequence[int], base: tuple[int, int, int]) -> list[int]:
    return [sum(a * b for a, b in zip(coefficients, column, strict=True)) for column in zip(*_basis(base), strict=True)]


def _pole_free_base(total: Sequence[int]) -> tuple[int, int, int]:
    """Choose theta0 so that |t(theta0 + pi)|, the leading coefficient, is the largest of twelve."""

    def size(base: tuple[int, int, int]) -> int:
        lead = sum(a * row[4] for a, row in zip(total, _basis(base), strict=True))
        return abs(lead) * (25 if base[2] == 1 else 1)

    return max(_BASES, key=size)


def _discriminant(total: Sequence[int]) -> int:
    """Return the discriminant up to a positive factor: I^3 - J^2 of the self-inversive quartic in exp(i theta)."""
    m, c1, s1, c2, s2 = total
    r2, r1, q = c2 * c2 + s2 * s2, c1 * c1 + s1 * s1, c2 * (c1 * c1 - s1 * s1) + 2 * s2 * c1 * s1
    i, j = 12 * r2 - 3 * r1 + 4 * m * m, m * (72 * r2 + 9 * r1 - 8 * m * m) - 27 * q
    return i**3 - j * j


def _count_degenerate(quartic: Sequence[int], levels: Sequence[Sequence[int]], bits: int) -> int:
    """Distinct real zeros when some zero is exactly multiple: critical values below 2**-bits are zero."""
    size = max(abs(a) for a in quartic)
    multiple = [p for level in levels[1:] for p in level if abs(_scaled_value(quartic, p, bits)) <= size << (3 * bits)]
    near = 1 << (bits // 2)
    distinct: list[int] = []
    for p in (*multiple, *levels[0]):
        if all(abs(p - q) > near for q in distinct):
            distinct.append(p)
    return len(distinct)


def _scaled_value(polynomial: Sequence[int], p: int, bits: int) -> int:
    """polynomial(p / 2**bits) * 2**(bits * degree), exactly."""
    value, shift = polynomial[-1], 0
    for a in polynomial[-2::-1]:
        shift += bits
        value = value * p + (a << shift)
    return value


def _real_zeros_of_chain(chain: Sequence[Sequence[int]], bits: int) -> list[list[int]]:
    """Real zeros (integers over 2**bits, increasing) of a polynomial and of each of its derivatives."""
    levels: list[list[int]] = [[] for _ in chain]
    levels[-1] = [-(chain[-1][0] << bits) // chain[-1][1]]
    for k in range(len(chain) - 2, -1, -1):
        polynomial, slope = chain[k], chain[k + 1]
        bound = 2 + max(abs(a) for a in polynomial) // abs(polynomial[-1])
        knots = [-(bound << bits), *levels[k + 1], bound << bits]
        values = [_scaled_value(polynomial, p, bits) for p in knots]
        for i in range(len(knots) - 1):
            if values[i] == 0:
                levels[k].append(knots[i])
            elif values[i + 1] and (values[i] > 0) != (values[i + 1] > 0):
                levels[k].append(_bracketed_newton(polynomial, slope, knots[i], knots[i + 1], values[i] > 0, bits))
    return levels


def _bracketed_newton(
    polynomial: Sequence[int], slope: Sequence[int], low: int, high: int, falls: bool, bits: int
) -> int:
    """Newton's method kept inside a bracket, to the last of `bits` binary places."""
    p, last = (low + high) >> 1, high - low
    while high - low > 1:
        v = _scaled_value(polynomial, p, bits)
        if v == 0:
            return p
        if (v > 0) == falls:
            low = p
        else:
            high = p
        dv = _scaled_value(slope, p, bits)
        step = v // dv if dv else last
        if -2 <= step <= 1:
            return p - step
        if 2 * abs(step) < last and low < p - step < high:
            p, last = p - step, abs(step)
        else:
            p, last = (low + high) >> 1, (high - low) >> 1
    return p


def _backward_distance(vector: Sequence[float], generators: Sequence[Sequence[float]]) -> float:
    """Smallest r with vector in r * zonotope(generators); the facets' normals decide (dimension 1 to 3)."""
    if len(vector) == 1:
        normals: list[tuple[float, ...]] = [(1.0,)]
    elif len(vector) == 2:
        normals = [(-g[1], g[0]) for g in generators]
    else:
        normals = [
            (g[1] * h[2] - g[2] * h[1], g[2] * h[0] - g[0] * h[2], g[0] * h[1] - g[1] * h[0])
            for g, h in combinations(generators, 2)
        ]
    axes = [tuple(float(i == j) for j in range(len(vector))) for i in range(len(vector))]
    worst = 0.0
    for normal in (*normals, *axes):
        length = math.sqrt(sum(a * a for a in normal))
        if length < 1e-12:
            continue
        reach = sum(abs(sum(a * b for a, b in zip(normal, g, strict=True))) for g in generators)
        miss = abs(sum(a * b for a, b in zip(normal, vector, strict=True)))
        # 1e-9: the generators are rounded to doubles, so "parallel" is parallel to within that.
        worst = max(worst, miss / (reach + 1e-9 * length))
    return worst


def _derivative(polynomial: Sequence[int]) -> list[int]:
    return [k * a for k, a in enumerate(polynomial)][1:]


def _distance(
    chain: Sequence[Sequence[int]], doubtful: Sequence[Sequence[int]], places: Sequence[tuple[int, int]], bits: int
) -> float:
    """Relative change of every doubtful input that makes derivatives of t vanish: of these orders, at these places."""
    vector: list[float] = []
    rows: list[list[float]] = []
    for order, p in places:
        parts = doubtful
        for _ in range(order):
            parts = [_derivative(g) for g in parts]
        values = [_scaled_value(g, p, bits) for g in parts]
        scale = sum(abs(v) for v in values)
        residual = _scaled_value(chain[order], p, bits)
        vector.append(residual / scale if scale else float(residual != 0) * 1e9)
        rows.append([v / scale if scale else 0.0 for v in values])
    return _backward_distance(vector, list(zip(*rows, strict=True)))


def _multiple_distance(
    chain: Sequence[Sequence[int]], doubtful: Sequence[Sequence[int]], p: int, orders: int, bits: int
) -> float:
    return _distance(chain, doubtful, [(order, p) for order in range(orders)], bits)


def _double_distance(chain: Sequence[Sequence[int]], doubtful: Sequence[Sequence[int]], p: int, bits: int) -> float:
    """Do the same for a double zero near the critical point p, which may move unless nearly degenerate."""
    bend = _scaled_value(chain[2], p, bits)
    # push * |t'''| against t''^2 (push: how much t' can change), both at the scale 2**(4 bits).
    push = sum(abs(_scaled_value(_derivative(g), p, bits)) for g in doubtful) * abs(_scaled_value(chain[3], p, bits))
    orders = 1 if 100 * push < bend * bend * _PER_ROUNDING else 2
    return _multiple_distance(chain, doubtful, p, orders, bits)


def _degenerate_zeros(
    chain: Sequence[Sequence[int]],
    levels: Sequence[Sequence[int]],
    doubtful: Sequence[Sequence[int]],
    bits: int,
) -> tuple[list[tuple[int, int]], float]:
    """Zeros with multiplicities of the most degenerate polynomial within the rounding of the inputs."""
    critical, zeros = levels[1], levels[0]
    fourfold = _multiple_distance(chain, doubtful, levels[3][0], 3, bits)
    if fourfold <= INPUT_ROUNDING:
        return [(levels[3][0], 4)], 0.0
    triple, p = min(((_multiple_distance(chain, doubtful, p, 2, bits), p) for p in levels[2]), default=(math.inf, 0))
    if triple <= INPUT_ROUNDING:
        others = [q for q in zeros if _scaled_value(chain[1], q, bits)]
        # One simple zero remains: the one farthest from the cluster.
        far = max(others or [p], key=lambda q: abs(q - p))
        return sorted([(p, 3), (far, 1)]), 0.0
    scores = [_double_distance(chain, doubtful, p, bits) for p in critical]
    knots = [-math.inf, *critical, math.inf]
    gaps = [next(g for g in range(len(knots) - 1) if knots[g] <= q <= knots[g + 1]) for q in zeros]
    # A minimum below 0 (maximum above) is named for the zeros on its two sides, which it replaces; a minimum just
    # above 0 has none of its own. Next to an inflection one of the two sides may have none: that is not a pair.
    pairs: dict[int, set[int]] = {}
    for i, p in enumerate(critical):
        value = _scaled_value(chain[0], p, bits)
        up = (chain[0][-1] > 0) == (i % 2 == 0)
        crossed = value < 0 if up else value > 0
        if scores[i] <= INPUT_ROUNDING and (not crossed or {i, i + 1} <= set(gaps)):
            pairs[i] = {i, i + 1} if crossed else set()
    if not pairs:
        return [(q, 1) for q in zeros], min([triple, fourfold, *scores])
    chosen = {min(pairs, key=lambda i: scores[i])}
    if {0, 2} <= set(pairs) and (
        _distance(chain, doubtful, [(0, critical[0]), (0, critical[2])], bits) <= INPUT_ROUNDING
    ):
        chosen = {0, 2}
    merged = set().union(*(pairs[i] for i in chosen))
    found = [(critical[i], 2) for i in chosen]
    found += [
        (q, 1)
        for q, gap in zip(zeros, gaps, strict=True)
        if gap not in merged and all(q != critical[i] for i in chosen)
    ]
    return sorted(found), 0.0


def _exact_direction(
    p: int, multiplicity: int, slope: Sequence[int], base: tuple[int, int, int], bits: int, exponent: int
) -> ExactZero:
    c, s, h = base
    one = 1 << (2 * bits)
    minus, double, plus = one - p * p, p << (bits + 1), one + p * p
    x, y, n = c * minus - s * double, s * minus + c * double, h * plus
    if multiplicity > 1:
        return ExactZero(x, y, n, multiplicity, 0.0)
    # t = F/(2 n^2), dw/dtheta = (1 + w^2)/2.
    top, bottom = _scaled_value(slope, p, bits), (4 * h * n) << bits
    return ExactZero(x, y, n, 1, quotient(top, bottom, exponent))
