"""Check a certificate of limit cycles: ``python check.py < FILE``. Why it proves them stands in `__init__.py` here."""

import json
from contextlib import suppress
from decimal import Context, Decimal, localcontext
from itertools import combinations, count, pairwise
from math import atan2, dist, inf, nextafter, remainder, sqrt, tau


class Interval:
    """All numbers from lo to hi; the result of an operation contains every result."""

    def __init__(self, *ends):
        self.lo, self.hi = nextafter(min(ends), -inf), nextafter(max(ends), inf)
        self.known = 1 // (-1e150 < self.lo <= self.hi < 1e150)  # else ZeroDivisionError

    __add__ = lambda self, x: Interval(self.lo + x.lo, self.hi + x.hi)
    __sub__ = lambda self, x: Interval(self.lo - x.hi, self.hi - x.lo)
    __mul__ = lambda self, x: Interval(self.lo * x.lo, self.lo * x.hi, self.hi * x.lo, self.hi * x.hi)
    __truediv__ = lambda self, x: self * Interval(1 / max(x.lo, 0.0), 1 / x.hi)


def psi(family, n, s):
    """Psi(s) and Psi'(s), from 28 or 60 digits; "tanh", s/sinh(sqrt s)^2, is 1 - s/3 + ..., one double up to 1e-18."""
    with localcontext(Context(prec=60 if family == "tanh" else 28)):
        if s == inf or family == "constant":
            return float(family == "constant"), 0.0
        s, n = Decimal(max(s, 1e-18 * (family == "tanh"))), max(Decimal(n), Decimal(1))
        if family in ("tanh", "exponential"):
            value = (-s).exp() if family != "tanh" else 4 * s * (e := (-2 * s.sqrt()).exp()) / (1 - e) ** 2
            return float(value), float(value * (-1 if family != "tanh" else (1 - (s + value).sqrt()) / s))
        u, rate = {"rational": (3 * s, 3), "hill": (v := (4 * s) ** n, n * v / s if s else 4 * (n == 1))}[family]
        return float(3 / (3 + u)), float(-3 * rate / (3 + u) ** 2)


def check(certificate):
    """Return how many rings have exactly one limit cycle, and whether there is no other; (0, False): nothing shown."""
    (family, n), ways, rings = certificate["psi"], [*certificate["walks"], ([], 0)], certificate["rings"]
    cross, work = lambda p, q: [p[i] * q[j] - p[j] * q[i] for i, j in ((1, 2), (2, 0), (0, 1))], count()
    steps = lambda way: {(*p[:3], *q[:3]) for p, q in pairwise(way) if p != q}
    (a, b), (c, d), (f, g) = ([*map(Interval, row)] for row in [*certificate["A"], certificate["f"]])
    peak = (3 * (n - 1) / (n + 1)) ** (1 / n) / 4 if family == "hill" and n > 1 else 0.0  # where Psi' is least

    def scaled(x, y, w):  # q = sqrt(r + v Psi(s)) and 1 + Psi'(s), for s = r/v
        r, v = x * x + y * y, w * w
        s, t = nextafter(max(r.lo, 0.0) / v.hi, 0.0), nextafter(r.hi / v.lo, inf) if v.lo > 0.0 else inf
        values, slopes = zip(*(psi(family, n, one) for one in [s, t] + [peak] * (s < peak < t)))
        q = Interval(max(r.lo, 0.0), r.hi) + Interval(max(v.lo, 0.0), v.hi) * Interval(*values)
        return Interval(sqrt(max(q.lo, 0.0)), sqrt(q.hi)), Interval(1.0) + Interval(*slopes)

    def hold(corners, normal, sign, k, j):  # a sign all over an edge or triangle, halved as often as needed
        sign /= {corner[2] for corner in corners} <= {0, 1}  # else ZeroDivisionError
        J, K, S, pieces = Interval(sign * j), Interval(sign * k), Interval(sign), [None, (corners, 0)]
        m, o, z = (S * (normal[0] * p + normal[1] * q) for p, q in ((a, c), (b, d), (f, g)))
        pads = [2.0**-48 * max(map(abs, column)) for column in zip(*corners)]
        for piece, depth in iter(pieces.pop, None):
            with suppress(ZeroDivisionError):  # a piece too large for bounds
                x, y, w, h = (Interval(min(one) - pad, max(one) + pad) for one, pad in zip(zip(*piece), pads))
                q, beta = scaled(x, y, w)
                s, t, across = x / q, y / q, m * x + o * y + z * q
                if {corner[2] for corner in piece} == {1}:  # by what it is at a place, and slopes to the corners
                    u, v = (Interval((i.lo + i.hi) / 2 - e, (i.lo + i.hi) / 2 + e) for i, e in zip((x, y), pads))
                    x, y = m + z * beta * s, o + z * beta * t
                    r = [x * (Interval(p[0]) - u) + y * (Interval(p[1]) - v) for p in piece]
                    across = m * u + o * v + z * scaled(u, v, w)[0] + Interval(*(i.lo for i in r), *(i.hi for i in r))
                more = J * (s * (a * s + b * t + f) + t * (c * s + d * t + g)) + K * (f * s + g * t)
                if (across / (w if k else h) + beta * more + K * (a + d)).lo > 0.0:
                    continue
            if depth == 16 or next(work) == 400_000:
                raise ArithmeticError(f"not decided at {corners}")
            ends = max(combinations(piece, 2), key=lambda pair: dist(*pair))
            pieces += [([[sum(i) / 2 for i in zip(*ends)] if p is q else p for p in piece], depth + 1) for q in ends]

    fine = [(a * d - b * c).lo > 0, family != "hill" or n >= 1]
    for way, sense in ways[:-1]:  # U crosses it to its left (1) or to its right (-1)
        fine += [way[0] == way[-1] or way[0][2] == way[-1][2] == 0]
        for p, q in pairwise(way):
            hold(([*p, 1], [*q, 1]), cross([*map(Interval, p)], [*map(Interval, q)]), sense, 0, 0)
    for rows, paths, (inner, outer), sign, (k, j), (X, Y) in rings:
        for (p, *near), (q, *far), path in zip(rows, rows[1:], paths):
            for step in path:  # a triangle to the next corner of the near row (0), or of the far one (1)
                three = p, q, (near, far)[step].pop(0)
                V = [[*map(Interval, one)] for one in three]
                lines = zip(*(cross(V[i - 2], V[i - 1]) for i in range(3)))
                u, v, size = (L * V[0][i] + M * V[1][i] + N * V[2][i] for (L, M, N), i in zip(lines, (3, 3, 2)))
                hold(three, (u / size, v / size), sign, k, j)  # no division by a size that may not be positive
                p, q = (p, three[2]) if step else (three[2], q)
            fine += [near == far == [], {*path} <= {0, 1}, k in (0, 1), -1 <= inner < outer < len(ways)]
        for loop in rows[inner < 0 :]:  # seen from (X, Y) it goes on and on to the left, once round
            turns = [remainder(q - p, tau) for p, q in pairwise(atan2(y - w * Y, x - w * X) for x, y, w, _ in loop)]
            fine += [loop[0] == loop[-1], round(sum(turns)) == 6, min(turns) > 1e-9, max(turns) < 3]
        fine += [k == 0 or ways[inner][1] == -ways[outer][1] if inner >= 0 else rows[0][0][:3] == [X, Y, 1]]
        fine += [len(paths) == len(rows) - 1 > 0, steps(rows[0]) <= steps(ways[inner][0])]
        fine += [steps(rows[-1]) <= steps(ways[outer][0]) or not any([ways[outer][0], *(p[2] for p in rows[-1])])]
    whole = [one[2] for one in rings] == [[i - 1, i] for i in range(len(ways) - (ways[-2][0][0][2] == 0))]
    return (sum(k == 1 and inner >= 0 for _, _, (inner, _), _, (k, _), _ in rings), whole) if all(fine) else (0, False)


if __name__ == "__main__":
    print("rings with exactly one limit cycle: {}; no other: {}".format(*check(json.loads(input()))))
