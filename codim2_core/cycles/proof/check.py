"""Check a certificate of limit cycles: ``python check.py < FILE``. Why it proves them stands in `__init__.py` here."""

import json
import sys
from fractions import Fraction
from functools import lru_cache
from itertools import pairwise
from math import comb, lcm

import numpy as np

ROUNDING_BOUND = (
    1e-12  # more than all rounding below, of the largest coefficient: 16 levels of products with rows that sum to 1
)
DEEPEST, MAX_CELLS, GRID = 16, 400_000, 7


def psi(family, n, s):
    """Return Psi(s) and Psi'(s) at 0 and from 1e-4 on, to 1e-10 of 1."""
    value, slope = np.ones_like(s), np.zeros_like(s)
    with np.errstate(all="ignore"):
        if family == "rational":
            value, slope = 1 / (1 + s), -1 / (1 + s) ** 2
        elif family == "exponential":
            value, slope = np.exp(-s), -np.exp(-s)
        elif family == "tanh":
            value = np.where(s > 0, 4 * s * np.exp(-2 * np.sqrt(s)) / np.expm1(-2 * np.sqrt(s)) ** 2, 1.0)
            slope = np.where(s > 0, value * (1 - np.sqrt(s + value)) / s, -1 / 3)
        elif family == "hill":
            value = 3 / (3 + (4 * s) ** n)
            slope = np.where(s > 0, -n / s * value * (1 - value), -4 / 3 * (n == 1))
    return value, slope


@lru_cache(maxsize=4)
def chords(family, n):
    """For m = |e|^2 from j/2^i to (j+2)/2^i, return (intercept, slope, error) by [i][j] of lines along 1 + Psi'."""
    if family == "constant":
        return [np.array([[1.0, 0.0, 0.0]] * (2**i + 1)) for i in range(13)]
    peak = (3 * (n - 1) / (n + 1)) ** (1 / n) / 4 if family == "hill" and n > 1 else 1.0  # Psi' is monotone beside it
    s = np.concatenate([[0.0, max(peak, 1e-4)], np.geomspace(1e-4, 1e8, 2**14), np.geomspace(0.01, 30, 2**19)])
    s.sort()
    value, slope = psi(family, n, s)
    m, beta, found = np.append(s / (s + value), 1.0), np.append(1 + slope, 1.0), []
    first, last, low, high = m[:-1], m[1:], np.minimum(beta[:-1], beta[1:]), np.maximum(beta[:-1], beta[1:])
    for i in range(13):
        left = np.arange(2**i + 1) / 2**i
        a, b = np.searchsorted(m, left, "right") - 1, np.searchsorted(m, np.minimum(left + 2 / 2**i, 1.0))
        a, b = np.minimum(a, len(m) - 2), np.maximum(b, 1)
        rise = (beta[b] - beta[a]) / np.maximum(m[b] - m[a], 1e-9)
        lines = []
        for j, k, g in zip(a, np.maximum(b, a + 1), rise):  # boxes (m, beta) hold the curve, which is monotone in them
            x, y = (first, last) if g > 0 else (last, first)
            top, base = (high[j:k] - g * x[j:k]).max(), (low[j:k] - g * y[j:k]).min()
            lines.append(((top + base) / 2, g, (top - base) / 2 + 1e-9 * (1 + abs(g))))
        found.append(np.array(lines))
    return found


def times(p, q):
    """Multiply polynomials whose coefficient of x^i y^j is p[i, j]."""
    found = np.full((len(p) + len(q) - 1,) * 2, 0, object)
    for (i, j), value in np.ndenumerate(q):
        if value:
            found[i : i + len(p), j : j + len(p)] += value * p
    return found


def plus(*terms):
    """Add polynomials."""
    found = np.full((max(map(len, terms)),) * 2, 0, object)
    for p in terms:
        found[: len(p), : len(p)] += p
    return found


def bernstein(p, n):
    """Return the Bernstein coefficients of degree n on the square |x|, |y| <= 1, times a positive number of n."""
    power = lambda i, j: sum((-1) ** (i - a) * comb(j, a) * comb(n - j, i - a) for a in range(min(i, j) + 1))
    whole = lcm(*(comb(n, i) for i in range(n + 1)))
    M = np.array([[power(i, j) * whole // comb(n, i) for i in range(n + 1)] for j in range(n + 1)], object)
    return M @ plus(p, np.full((n + 1, n + 1), 0, object)) @ M.T


def integers(values):
    """Return floats, times a positive number, as integers."""
    exact = [Fraction(v) for v in np.ravel(values).tolist()]
    common = lcm(*(v.denominator for v in exact))
    return np.array([int(v * common) for v in exact], object).reshape(np.shape(values))


def halves(n):
    """Return the matrices that lead from Bernstein coefficients to those of the left and of the right half."""
    left = np.array([[comb(j, i) / 2**j for i in range(n + 1)] for j in range(n + 1)])
    return np.stack([left, left[::-1, ::-1]])


def check(certificate):
    """Return how many limit cycles there are, all hyperbolic, and that there is no other; (0, False): nothing shown."""
    with np.errstate(all="ignore"):
        found = proved_count(certificate)
    return (0, False) if found is None else (found, True)


def proved_count(certificate):
    """Return how many limit cycles there are; None: nothing is shown."""
    (family, power), (k, mu), known = certificate["psi"], map(Fraction, certificate["weight"]), ("constant", "hill")
    if family not in (*known, "rational", "exponential", "tanh") or (family == "hill" and not power >= 1):
        return None
    (a, b, f), (c, d, g) = integers([[*row, v] for row, v in zip(certificate["A"], certificate["f"])])
    N, given = integers(certificate["chart"]), integers(certificate["function"])
    cross = lambda p, q: np.array([p[i] * q[j] - p[j] * q[i] for i, j in ((1, 2), (2, 0), (0, 1))], object)
    L = np.array([cross(N[:, 1], N[:, 2]), cross(N[:, 2], N[:, 0]), cross(N[:, 0], N[:, 1])])  # N^-1 det N
    det, area, inside = L[0] @ N[:, 0], a * d - b * c, [L[2], *(L[2] + v * L[i] for i in (0, 1) for v in (1, -1))]
    C = L @ [b * g - d * f, c * f - a * g, area]
    if not (det > 0 < area and k < 0 and mu < 2 and all(r > 0 and r**2 > p**2 + q**2 for p, q, r in inside)):
        return None
    if {*map(type, certificate["way"])} != {int} or max(map(abs, certificate["way"])) != 8:
        return None
    if not (C[2] > 0 and max(abs(C[0]), abs(C[1])) * 2**44 < C[2]):
        return None
    # the polynomials Phi w^2 of degree 0 and 1 in beta, and P: __init__, 2
    degree = len(given) - 1
    T = [np.array([1], object), np.array([0, 1], object)]
    while len(T) <= degree:
        T.append(np.append([0], 2 * T[-1]) - np.append(T[-2], [0, 0]))
    T = np.array([np.append(t, [0] * (degree + 1 - len(t))) for t in T[: degree + 1]], object)
    P = T.T @ given @ T
    x, y, w, X, Y = (np.array([[r, q], [p, 0]], object) for p, q, r in (*N, (1, 0, 0), (0, 1, 0)))
    u, v, along = a * x + b * y + f * w, c * x + d * y + g * w, np.arange(1, degree + 1).astype(object)
    Px, Py = np.full((2, degree + 1, degree + 1), 0, object)
    Px[:-1], Py[:, :-1] = P[1:] * along[:, None], P[:, 1:] * along
    flows = (w, u, v, w * (a + d)), (None, x, y, f * x + g * y)
    Phi = []
    for factor, first, second, trace in flows:
        one = [times(factor, first), times(factor, second)] if factor is not None else plus(times(x, u), times(y, v))
        V = [p * one[0] + q * one[1] if factor is not None else r * one for p, q, r in L]
        H = [plus(V[0], -times(V[2], X)), plus(V[1], -times(V[2], Y))]
        rest = plus(trace * det * mu.denominator, -mu.numerator * V[2])
        scale = k.denominator * mu.denominator
        Phi.append(plus(*(scale * times(D, h) for D, h in zip((Px, Py), H)), times(P, k.numerator * rest)))
    ww, rr = times(w, w), plus(times(x, x), times(y, y))
    tensors = [times(p, q) for p, q in ((Phi[0], ww), (Phi[1], ww), (Phi[1], rr))]
    n = max(max(map(max, np.nonzero(p))) for p in tensors)
    tensors = [bernstein(p[: n + 1, : n + 1], n) for p in tensors]
    top = max(abs(t).max() for t in tensors)
    chart = N.astype(float) / float(abs(N).max())
    lines = chords(family, power)
    if not positive(np.array([(t / top).astype(float) for t in tensors]), chart, lines):
        return None
    if not abs(P[0, 0]) > abs(P).sum() / 2**42:  # P has one sign on the way from C to 0
        return None
    lift, numbers = ((m / abs(m).max()).astype(float) for m in (L, np.array([[a, b, f], [c, d, g]], object)))
    center = np.array([float(Fraction(b * g - d * f, area)), float(Fraction(c * f - a * g, area))])
    beyond = lambda sign: loop_is_crossed(certificate["loop"], center, numbers, lines, sign)
    return ovals(P, certificate["way"], chart, lift, numbers, beyond)


def loop_is_crossed(loop, center, numbers, lines, sign):
    """Return places about which a closed polygon goes, and whether it goes round C and all orbits cross it inwards (1).

    Or outwards (-1): that is, each from its right to its left, or each from its left to its right, if it meets itself.
    """
    p, (A, f), size = np.array(loop, float).reshape(-1, 2), np.split(numbers, [2], axis=1), abs(numbers).sum()
    d = np.roll(p, -1, axis=0) - p
    length, inside = np.hypot(*d.T), center + 0.97 * (p[:: len(p) // 16 or 1] - center)
    if len(p) < 3 or np.hypot(*p.T).max() >= 1 - ROUNDING_BOUND or winding(p, d, center) != 1:
        return inside, False
    inside = np.array([q for q in inside if winding(p, d, q) >= 1]).reshape(-1, 2)
    for pieces in (16, 128, 1024, 8192):  # the edges that are not decided yet, in more pieces
        e = p[:, None] + d[:, None] * ((np.arange(pieces) + 0.5) / pieces)[None, :, None]
        U, r, modulus = (
            e @ A.T + f[:, 0],
            length[:, None] / (2 * pieces) + ROUNDING_BOUND,
            np.hypot(*np.moveaxis(e, 2, 0)),
        )
        along, about = (e * U).sum(axis=2), (d[:, 1] * p[:, 0] - d[:, 0] * p[:, 1])[:, None]  # d x e, all along an edge
        low, high = np.maximum(modulus - r, 0) ** 2, np.minimum(modulus + r, 1) ** 2
        alpha, sigma, error = lookup(lines, low, high)
        beta, spread = alpha + sigma * (low + high) / 2, abs(sigma) * (high - low) / 2 + error
        across = d[:, :1] * U[..., 1] - d[:, 1:] * U[..., 0] + beta * about * along
        near = spread * abs(along) + (abs(beta) + spread) * r * 3 * size
        left = ~(sign * across > length[:, None] * size * (r + ROUNDING_BOUND) + abs(about) * near).all(axis=1)
        p, d, length = p[left], d[left], length[left]
    return inside, not left.any()


def winding(p, d, place):
    """Return how often a closed polygon, corners p and edges d, goes round a place; 0 on an edge."""
    x, y = (p - place).T
    side, along = x * d[:, 1] - y * d[:, 0], x * (x + d[:, 0]) + y * (y + d[:, 1])
    near = (abs(side) <= 1e-9 * np.hypot(*d.T)) & (along <= 1e-9)
    return 0 if near.any() else round(np.arctan2(side, along).sum() / (2 * np.pi))


def lookup(lines, low, high):
    """Return intercept, slope and error of the lines along 1 + Psi' for |e|^2 from low to high."""
    level = np.minimum(-np.ceil(np.log2(np.maximum(high - low, 1e-9))), len(lines) - 1).astype(int)
    first = np.cumsum([0, *map(len, lines)])
    return np.moveaxis(np.concatenate(lines)[first[level] + np.floor(low * 2.0**level).astype(int)], -1, 0)


def positive(tensors, chart, lines):
    """Whether a function, T0 + beta T1 by w^2, is positive where |e| <= 1: squares are quartered as long as needed."""
    S, stack, tried = halves(tensors.shape[-1] - 1), [(tensors[None], np.zeros((1, 2)), 1.0)], 0
    while stack:
        T, centers, half = stack.pop()
        low, high = squares(chart, centers, half)
        meets = low <= 1
        T, centers, low, high = T[meets], centers[meets], np.maximum(low[meets], 0), np.minimum(high[meets], 1)
        alpha, sigma, error = lookup(lines, low, high)[:, :, None, None]
        slack = error[:, 0, 0] * abs(T[:, 1]).max((1, 2)) + ROUNDING_BOUND * (1 + abs(alpha) + abs(sigma))[:, 0, 0]
        left = ~((T[:, 0] + alpha * T[:, 1] + sigma * T[:, 2]).min(axis=(1, 2)) > slack)
        tried += len(left)
        if left.any() and (tried > MAX_CELLS or half < 2.0**-DEEPEST):
            return False
        T, centers = T[left], centers[left]
        for i in range(0, len(T), 64):
            parts = [p @ T[i : i + 64] @ q.T for p in S for q in S]
            places = [centers[i : i + 64] + np.array([p, q]) * half / 2 for p in (-1, 1) for q in (-1, 1)]
            stack.append((np.concatenate(parts), np.concatenate(places), half / 2))
    return True


def squares(chart, centers, half):
    """Return the least and the greatest |e|^2 on squares: of (x^2 + y^2) / w^2, or of 1 + (x^2 + y^2 - w^2) / w^2."""
    places, form = np.column_stack([centers, np.ones(len(centers))]), chart.T @ np.diag([1.0, 1.0, -1.0]) @ chart
    (x, y, w), rates = chart @ places.T, 2 * form[:2] @ places.T
    p, q, r = abs(chart[:, :2]).sum(axis=1) * half + ROUNDING_BOUND
    middle = (places @ form * places).sum(axis=1)
    spread = (abs(rates).sum(axis=0) + abs(form[:2, :2]).sum() * half) * half + ROUNDING_BOUND
    far, near = np.maximum(w + r, 1e-99) ** 2, np.maximum(w - r, 1e-99) ** 2
    low, high = middle - spread, middle + spread
    least = (np.maximum(abs(x) - p, 0) ** 2 + np.maximum(abs(y) - q, 0) ** 2) / far
    low = np.maximum(least, 1 + low / np.where(low > 0, far, near))
    high = np.minimum(((abs(x) + p) ** 2 + (abs(y) + q) ** 2) / near, 1 + high / np.where(high > 0, near, far))
    return np.where(w + r > 0, low - ROUNDING_BOUND, np.inf), high + ROUNDING_BOUND


def ovals(P, way, chart, lift, numbers, crossed):
    """Return how many closed curves P = 0 has, if that is the number of cycles."""
    n = len(P) - 1
    left = np.array([[comb(j, i) * 2 ** (n - j) for i in range(n + 1)] for j in range(n + 1)], object)
    whole = lcm(*(comb(n, i) for i in range(n + 1)))
    M = np.array([[comb(j, i) * whole // comb(n, i) for i in range(n + 1)] for j in range(n + 1)], object)
    p, q = way  # to the edge of the square, 8 times
    line = [sum(P[i, j - i] * p**i * q ** (j - i) for i in range(j + 1)) * 8 ** (n - j) for j in range(n + 1)]
    parts = [M @ np.array(line, object)]
    for _ in range(5):
        parts = [half for part in parts for half in (left @ part, (left @ part[::-1])[::-1])]
    if not all(part[0] for part in parts):
        return None
    signs = [[v > 0 for v in part if v] for part in parts]
    most = sum(v != w for part in signs for v, w in pairwise(part))
    if most == 0:
        return 0
    S, mats = halves(n), np.eye(n + 1)[None]
    for _ in range(GRID):
        mats = np.stack([S[0] @ mats, S[1] @ mats], axis=1).reshape(-1, n + 1, n + 1)
    B = bernstein(P, n)
    B = (B / abs(B).max()).astype(float)
    cells = [m @ B @ mats.transpose(0, 2, 1) for m in mats]
    signs = np.array([(c.min((1, 2)) > ROUNDING_BOUND) * 1 - (c.max((1, 2)) < -ROUNDING_BOUND) for c in cells])
    sides = (np.arange(2**GRID) + 0.5) / 2 ** (GRID - 1) - 1
    centers = np.stack(np.meshgrid(sides, sides, indexing="ij"), axis=-1).reshape(-1, 2)
    high = squares(chart, centers, 2.0**-GRID)[1].reshape(signs.shape)
    middle, reached, sign, count = 2 ** (GRID - 1), np.zeros(signs.shape, bool), 1 if P[0, 0] > 0 else -1, 0
    reached[middle - 1 : middle + 1, middle - 1 : middle + 1] = True
    inner = reached
    while count <= most:  # all places where P may have the sign that it has within the last closed curve
        before, free, inner = -1, (signs != -sign) | reached, reached.copy()
        while before != (before := reached.sum()):
            rows = reached | np.pad(reached[1:], ((0, 1), (0, 0))) | np.pad(reached[:-1], ((1, 0), (0, 0)))
            rows = rows | np.pad(rows[:, 1:], ((0, 0), (0, 1))) | np.pad(rows[:, :-1], ((0, 0), (1, 0)))
            reached |= rows & free
        if (reached & (high >= 1)).any():
            break
        count, sign = count + 1, -sign
    # where orbits may tend to the equator, in the sense of time in which they stay beyond the last closed curve
    turn, step = np.arange(2**15) * 2.0**-14 * np.pi, 2.0**-14 * np.pi
    e = np.array([np.cos(turn), np.sin(turn)])
    other = is_covered(signs == -sign, lift, e, step)
    U, error = numbers @ np.vstack([e, np.ones(len(turn))]), 3 * step * abs(numbers).sum()
    rest = (abs(e[0] * U[1] - e[1] * U[0]) <= error) & ~other
    kept = bool((sign * (e * U).sum(axis=0) < -error)[rest].all())
    if count == most and not kept:  # or may not come there for a polygon, not all of it within the last closed curve
        inside, kept = crossed(sign)
        kept = kept and is_covered(~inner, lift, inside.T, ROUNDING_BOUND).any()
    return count if count == most and kept else None


def is_covered(squares, lift, e, step):
    """Whether all that is as near as this to places e is in some of the squares."""
    lifted, spread, middle = lift @ np.vstack([e, np.ones(e.shape[1])]), abs(lift).sum() * step, len(squares) // 2
    eta, away = lifted[:2] / lifted[2], 3 * spread / np.maximum(lifted[2] - spread, 1e-99)
    near = [np.floor((eta + i * away + 1) * middle).astype(int).clip(0, 2 * middle - 1) for i in (-1, 1)]
    return np.all([squares[near[i][0], near[j][1]] for i in (0, 1) for j in (0, 1)], axis=0) & (away < 1 / middle)


if __name__ == "__main__":
    print("limit cycles: {}; no other: {}".format(*check(json.loads(sys.stdin.read()))))
