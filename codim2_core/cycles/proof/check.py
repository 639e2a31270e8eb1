"""Check a certificate of limit cycles: ``python check.py < FILE``. Why it proves them stands in `__init__.py` here."""

import json
from contextlib import suppress
from decimal import Context, Decimal, localcontext
from fractions import Fraction
from itertools import combinations, count, pairwise
from math import atan2, dist, inf, nextafter, sqrt


class Interval:
    """All numbers from lo to hi; the result of an operation contains every result."""

    def __init__(self, *ends):
        self.lo, self.hi = nextafter(min(ends), -inf), nextafter(max(ends), inf)
        self.known = 1 // (-1e150 < self.lo <= self.hi < 1e150)  # else ZeroDivisionError

    __add__ = lambda self, x: Interval(self.lo + x.lo, self.hi + x.hi)
    __mul__ = lambda self, x: Interval(self.lo * x.lo, self.lo * x.hi, self.hi * x.lo, self.hi * x.hi)
    __truediv__ = lambda self, x: self * Interval(1 / max(x.lo, 0.0), 1 / x.hi)


def psi(family, n, s):
    """Psi(s) and Psi'(s), from 40 digits."""
    with localcontext(Context(prec=40)):
        if s == inf or family == "constant":
            return float(family == "constant"), 0.0
        s, n = Decimal(s), Decimal(n)
        if family == "hill":
            value = 3 / (3 + (4 * s) ** n)
            return float(value), float(-4 * n / 3 * ((4 * s) ** (n - 1) if n > 1 else 1) * value**2)
        value = {"rational": 1 / (1 + s), "exponential": (-s).exp()}[family]
        return float(value), float(-(value**2) if family == "rational" else -value)


def check(certificate):
    """Return how many rings have exactly one limit cycle, and whether there is no other; (0, False): nothing shown."""
    (family, n), walks, rings = (certificate[name] for name in ("psi", "walks", "rings"))
    exact = lambda rows: [[Fraction(one) for one in row] for row in rows]
    cross = lambda p, q: [p[i] * q[j] - p[j] * q[i] for i, j in ((1, 2), (2, 0), (0, 1))]
    rounded = lambda *values: [Interval(float(one)) for one in values]
    steps = lambda way: {(*p, *q) for p, q in pairwise(way) if p != q}
    (a, b), (c, d), (f, g), (X, Y, W) = exact([*certificate["A"], certificate["f"], certificate["centre"]])
    (T, F, G, P, Q, R), det, work = rounded(a + d, f, g, a, b + c, d), a * d - b * c, count()
    peak = (3 * (n - 1) / (n + 1)) ** (1 / n) / 4 if family == "hill" and n > 1 else 0.0  # where Psi' is least

    def hold(corners, normal, sign, k, j):  # a sign all over an edge or triangle, halved as often as needed
        m, o, z = rounded(*(sign * (normal[0] * u + normal[1] * v) for u, v in ((a, c), (b, d), (f, g))))
        J, K, pieces = Interval(sign * j), Interval(sign * k), [(corners, 0)]
        pads = [2.0**-48 * max(map(abs, column)) for column in zip(*corners)]
        while pieces:
            piece, depth = pieces.pop()
            with suppress(ZeroDivisionError):  # a piece too large for bounds of e, q = sqrt(s + Psi) and 1 + Psi'
                x, y, w, h = (Interval(min(one) - pad, max(one) + pad) for one, pad in zip(zip(*piece), pads))
                r, v = x * x + y * y, w * w
                s, t = nextafter(max(r.lo, 0.0) / v.hi, 0.0), nextafter(r.hi / v.lo, inf) if v.lo > 0.0 else inf
                values, slopes = zip(*(psi(family, n, one) for one in [s, t] + [peak] * (s < peak < t)))
                q = Interval(max(r.lo, 0.0), r.hi) + Interval(max(v.lo, 0.0), v.hi) * Interval(*values)
                q, beta = Interval(sqrt(max(q.lo, 0.0)), sqrt(q.hi)), Interval(1.0) + Interval(*slopes)
                x, y = x / q, y / q
                bound = q / (w if k else h) * (m * x + o * y + z) + (K + J) * beta * (F * x + G * y) + K * T
                if (bound + J * beta * (P * x * x + Q * x * y + R * y * y)).lo > 0.0:
                    continue
            if depth == 16 or next(work) == 400_000:
                raise ValueError(f"not decided at {corners}")
            ends = max(combinations(piece, 2), key=lambda pair: dist(*pair))
            new = [0.5 * sum(pair) for pair in zip(*ends)]
            pieces += [([new if one is end else one for one in piece], depth + 1) for end in ends]

    fine = [det > 0, (d * f - b * g) ** 2 + (a * g - c * f) ** 2 < det**2, family != "hill" or n >= 1]
    for way, sense in walks:  # U crosses it to its left (1) or to its right (-1)
        fine += [way[0] == way[-1] or way[0][2] == way[-1][2] == 0, min(p[2] for p in way) >= 0]
        for p, q in pairwise(way):
            hold(([*p, 1], [*q, 1]), cross(*exact((p, q))), sense, 0, 0)
    edges = [*(steps(way) for way, _ in walks), set()]
    for layers, weights, (inner, outer), sign, (k, j) in rings:
        corners = [[(*p, h) for p, h in zip(*both, strict=True)] for both in zip(layers, weights, strict=True)]
        for (p, q), (r, s) in (i for pair in pairwise(corners) for i in zip(*map(pairwise, pair), strict=True)):
            for three in [(p, r, s)] * (r != s) + [(p, s, q)] * (p != q):
                V = exact(three)
                lines = [cross(V[i - 2], V[i - 1]) for i in range(3)]
                size = sum(v * w for v, w in zip(V[0], lines[0]))  # zero is refused by the division
                fine += [size > 0, min(v[2] for v in V) >= 0]
                hold(three, [sum(v[3] * u[i] for v, u in zip(V, lines)) / size for i in (0, 1)], sign, k, j)
        for loop in corners[inner < 0 :]:
            seen = [(float(x * W - w * X), float(y * W - w * Y)) for x, y, w, _ in exact(loop)]
            turns = [atan2(u * y - v * x, u * x + v * y) for (u, v), (x, y) in pairwise(seen)]
            fine += [loop[0] == loop[-1], round(sum(turns)) == 6, max(map(abs, turns)) < 3, (0.0, 0.0) not in seen]
        fine += [-1 <= inner < outer <= len(walks), k in (0, 1), steps(layers[0]) <= edges[inner], len(layers) > 1]
        fine += [steps(layers[-1]) <= edges[outer] or (outer == len(walks) and not any(p[2] for p in layers[-1]))]
        opposite = inner >= 0 and walks[inner][1] == -[*walks, (0, 0)][outer][1]  # U goes in on both sides, or out
        fine += [k == 0 or opposite if inner >= 0 else layers[0][0] == certificate["centre"]]
    whole = [ends for _, _, ends, *_ in rings] == [[i - 1, i] for i in range(len(rings))]
    whole = whole and len(rings) == len(walks) + (walks[-1][0][0][2] != 0)
    found = sum(k == 1 and inner >= 0 for _, _, (inner, _), _, (k, _) in rings)
    return (found, whole) if all(fine) else (0, False)


if __name__ == "__main__":
    print("rings with exactly one limit cycle: {}; no other: {}".format(*check(json.loads(input()))))
