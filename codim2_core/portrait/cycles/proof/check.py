"""Check a certificate of limit cycles: ``python check.py < FILE``. `__init__.py` says why it proves them."""

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
REACH = 2.0**-36  # that a critical set is at most off its place
SIZES = 2.0 ** -np.arange(-1, 30)  # of squares in which U may be one to one
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
    peak = (3 * (n - 1) / (n + 1)) ** (1 / n) / 4 if family == "hill" and n > 1 else 1.0  # Psi' is monotone next to it
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


@np.errstate(all="ignore")
def check(certificate):
    """Return what is proved of limit directions, critical sets, limit cycles, and that these are all; None: nothing."""
    (family, power), known = certificate["psi"], ("constant", "hill", "rational", "exponential", "tanh")
    if family not in known or (family == "hill" and not power >= 1):
        return {"limit directions": None, "critical sets": None, "limit cycles": None}
    field, lines = Field(certificate["U"]), chords(family, power)
    directions = limit_directions(field)
    kinds = kinds_of_critical_sets(field, certificate["critical"], lines)
    cycles = None
    if kinds is not None and {*kinds} <= {"saddle"}:  # a closed orbit surrounds another critical set, index theory
        cycles = 0
    elif kinds is not None and "function" in certificate:
        cycles = proved_count(certificate, field, lines)
    return {"limit directions": directions, "critical sets": kinds, "limit cycles": cycles}


class Field:
    """U = (U1, U2), polynomials in e = (c, s): exact, and as floats that are bounded."""

    def __init__(self, given):
        terms = [(k, i, j, v) for k, U in enumerate(given) for i, row in enumerate(U) for j, v in enumerate(row) if v]
        self.degree = n = max(i + j for _, i, j, _ in terms)
        self.exact = np.full((2, n + 1, n + 1), 0, object)
        for (*place, _), v in zip(terms, integers([Fraction(v) for *_, v in terms])):
            self.exact[tuple(place)] = v
        self.power = np.add.outer(np.arange(n + 1), np.arange(n + 1)).astype(object)
        self.floats = (self.exact / abs(self.exact).max()).astype(float)
        self.size = float((abs(self.floats) * (1 + self.power + self.power**2)).sum())  # bounds U and its derivatives

    def at(self, e):
        """Return U at places (2, ...)."""
        return np.polynomial.polynomial.polyval2d(e[0], e[1], np.moveaxis(self.floats, 0, -1))

    def slopes(self, e):
        """Return the derivatives of U at places (2, ...): first by c or s, then of U1 or U2."""
        along, F = np.arange(self.degree + 1), self.floats
        parts = (F * along[:, None])[:, 1:], (F * along)[:, :, 1:]
        parts = [p if p.size else F[:, :1, :1] * 0 for p in parts]
        return [np.polynomial.polynomial.polyval2d(e[0], e[1], np.moveaxis(p, 0, -1)) for p in parts]


def limit_directions(field):
    """Return the signs of lambda_rho and lambda_theta at all zeros of Theta = e x U; None if one may be 0 there."""
    done, t, half = [], (2 * np.arange(2**12) + 1) * 2.0**-12 * np.pi, 2.0**-12 * np.pi
    while 0 < len(t) < MAX_CELLS // 16 and half > 2.0**-36:  # arcs that are not decided yet, in more pieces
        c, s = e = np.array([np.cos(t), np.sin(t)])
        (u, v), ((uc, vc), (us, vs)) = field.at(e), field.slopes(e)
        Theta, along = c * v - s * u, c * u + s * v
        rate = -along + c * (c * vs - s * vc) - s * (c * us - s * uc)  # d Theta / d theta
        error = 6 * field.size * (half + ROUNDING_BOUND)
        regular, simple = abs(Theta) > error, (abs(rate) > error) & (abs(along) > error)
        known = regular | simple
        done.append(np.array([t, regular * np.sign(Theta), np.sign(along)])[:, known])
        t, half = (t[~known, None] + half * np.arange(-15, 16, 2) / 16).ravel(), half / 16
    found = np.concatenate(done, axis=1)
    _, Theta, along = found[:, np.argsort(found[0])]
    ends = np.flatnonzero(Theta)  # between two of these arcs Theta rises, or falls, or has no zero
    if len(t) or not len(ends):
        return None
    after = np.flatnonzero(Theta[ends] != np.roll(Theta[ends], -1))
    return [(int(along[(ends[i] + 1) % len(along)]), -int(Theta[ends[i]])) for i in after]


def taylor(U, place):
    """Return the coefficients of polynomials about a place, exactly: of (c - c0)^i (s - s0)^j."""
    n, powers = U.shape[1], [[Fraction(v) ** i for i in range(U.shape[1])] for v in place]
    shift = [[[comb(j, i) * p[j - i] if j >= i else 0 for j in range(n)] for i in range(n)] for p in powers]
    C, S = (np.array(m, object) for m in shift)
    return np.array([C @ u @ S.T for u in U], object)


def kinds_of_critical_sets(field, places, lines):
    """Return the kinds of all zeros of U in |e| <= 1, which are next to these places; None if it is not shown."""
    kinds, near, n = [], [], field.degree
    for place in places:
        T = (taylor(field.exact, place) / abs(field.exact).max()).astype(float)
        D = np.array([[T[i, 1, 0], T[i, 0, 1]] for i in (0, 1)]) if n else np.zeros((2, 2))
        det = D[0, 0] * D[1, 1] - D[0, 1] * D[1, 0]
        if not abs(det) > 1e-9 * abs(D).max() ** 2:
            return None
        M, k = np.linalg.inv(D), np.add.outer(np.arange(n + 1), np.arange(n + 1))
        R, first = abs(np.einsum("ij,jkl->ikl", M, T)), abs(np.eye(2) - M @ D).sum()
        bends = [first + (R * k * v ** np.maximum(k - 1, 0) * (k > 1)).sum(axis=(1, 2)).max() for v in SIZES]
        r = max((v for v, bend in zip(SIZES, bends) if bend < 0.9), default=0.0)
        reach, modulus = 10.0 * R[:, 0, 0].max() + ROUNDING_BOUND, float(np.hypot(*place))
        if not (reach < REACH < 0.01 * r and modulus + 2.0**-29 < 1):
            return None
        (alpha, sigma, error), e = lookup(lines, modulus**2 * (1 - 1e-9), modulus**2 * (1 + 1e-9)), np.array(place)
        beta, blur = alpha + sigma * modulus**2, 2.0**-30 * (1 + abs(sigma)) * (1 + field.size) ** 2
        trace = D[0, 0] + D[1, 1] - beta * (e @ D @ e)  # of J, and its discriminant, by q and q^2
        folded = trace**2 - 4 * det * (1 - beta * modulus**2)
        off = blur + error * abs(e @ D @ e)
        if det > 0 and not (abs(trace) > off and abs(folded) > 3 * (abs(trace) + off) * off + 4 * det * error + blur):
            return None
        kind = f"{'stable' if trace < 0 else 'unstable'} {'node' if folded > 0 else 'focus'}"
        kinds.append(kind if det > 0 else "saddle")
        near.append((e, r * (1 - 1e-9)))
    for i, (e, _) in enumerate(near):
        if any(abs(e - p).max() <= 2.0**-20 for p, _ in near[:i]):
            return None
    S, tensors = halves(n), np.array([bernstein(U, n) for U in field.exact])
    cells, middles, half, tried = (tensors / abs(tensors).max()).astype(float)[None], np.zeros((1, 2)), 1.0, 0
    while len(cells):  # no other: a square is beyond the disc, or next to a place, or U1 or U2 has one sign there
        open_ = (np.maximum(abs(middles) - half, 0) ** 2).sum(axis=1) <= 1 + ROUNDING_BOUND
        for e, r in near:
            open_ &= abs(middles - e).max(axis=1) + half > r
        low, high = cells.min(axis=(2, 3)), cells.max(axis=(2, 3))
        open_ &= ~((low > ROUNDING_BOUND) | (high < -ROUNDING_BOUND)).any(axis=1)
        cells, middles, half, tried = cells[open_], middles[open_], half / 2, tried + len(cells)
        if len(cells) and (tried > MAX_CELLS or half < 2.0**-DEEPEST):
            return None
        middles = np.concatenate([middles + np.array([p, q]) * half for p in (-1, 1) for q in (-1, 1)])
        cells = np.concatenate([p @ cells @ q.T for p in S for q in S])
    return kinds


def proved_count(certificate, field, lines):
    """Return how many limit cycles there are; None: nothing is shown."""
    (k, mu), given = map(Fraction, certificate["weight"]), integers(certificate["function"])
    N, degree, n = integers(certificate["chart"]), len(certificate["function"]) - 1, field.degree
    cross = lambda p, q: np.array([p[i] * q[j] - p[j] * q[i] for i, j in ((1, 2), (2, 0), (0, 1))], object)
    L = np.array([cross(N[:, 1], N[:, 2]), cross(N[:, 2], N[:, 0]), cross(N[:, 0], N[:, 1])])  # N^-1 det N
    det, inside = L[0] @ N[:, 0], [L[2], *(L[2] + v * L[i] for i in (0, 1) for v in (1, -1))]
    if not (det > 0 > k and mu < 2 and all(r > 0 and r**2 > p**2 + q**2 for p, q, r in inside)):
        return None
    # the polynomials Phi w^(n + 1) of degree 0 and 1 in beta, and P: __init__, 2
    T = [np.array([1], object), np.array([0, 1], object)]
    while len(T) <= degree:
        T.append(np.append([0], 2 * T[-1]) - np.append(T[-2], [0, 0]))
    T = np.array([np.append(t, [0] * (degree + 1 - len(t))) for t in T[: degree + 1]], object)
    P = T.T @ given @ T
    x, y, w, X, Y = (np.array([[r, q], [p, 0]], object) for p, q, r in (*N, (1, 0, 0), (0, 1, 0)))
    along = np.arange(1, degree + 1).astype(object)
    Px, Py = np.full((2, degree + 1, degree + 1), 0, object)
    Px[:-1], Py[:, :-1] = P[1:] * along[:, None], P[:, 1:] * along
    U, along = field.exact, np.arange(n + 1).astype(object)
    whole = lambda terms, degree: homogeneous(terms, degree, (x, y, w))
    (u, v), (uw, vw) = [whole(p, n) for p in U], [whole(p * (n - field.power), n - 1) for p in U]
    ux, vy = whole((U[0] * along[:, None])[1:], n - 1), whole((U[1] * along)[:, 1:], n - 1)
    flows = (w, u, v, times(w, plus(ux, vy))), (None, x, y, plus(times(x, uw), times(y, vw)))
    Phi = []
    for factor, first, second, trace in flows:
        one = [times(factor, first), times(factor, second)] if factor is not None else plus(times(x, u), times(y, v))
        V = [plus(p * one[0], q * one[1]) if factor is not None else r * one for p, q, r in L]
        H = [plus(V[0], -times(V[2], X)), plus(V[1], -times(V[2], Y))]
        rest = plus(trace * det * mu.denominator, -mu.numerator * V[2])
        scale = k.denominator * mu.denominator
        Phi.append(plus(*(scale * times(D, h) for D, h in zip((Px, Py), H)), times(P, k.numerator * rest)))
    ww, rr = times(w, w), plus(times(x, x), times(y, y))
    tensors = [times(p, q) for p, q in ((Phi[0], ww), (Phi[1], ww), (Phi[1], rr))]
    n = max(max(map(max, np.nonzero(p)), default=0) for p in map(np.array, tensors))
    tensors = [bernstein(p[: n + 1, : n + 1], n) for p in tensors]
    top = max(abs(t).max() for t in tensors)
    chart, lift = ((m / abs(m).max()).astype(float) for m in (N, L))
    if not positive(np.array([(t / top).astype(float) for t in tensors]), chart, lines):
        return None
    return cycle_count(P, certificate, (L, chart, lift), field, lines)


def homogeneous(terms, n, lines):
    """Return w^n times a polynomial of degree n, whose coefficient of (x/w)^i (y/w)^j is terms[i, j]."""
    powers, zero = [[np.array([[1]], object)] for _ in lines], np.full((1, 1), 0, object)
    for row, line in zip(powers, lines):
        while len(row) <= n:
            row.append(times(row[-1], line))
    x, y, w = powers
    return plus(zero, *(v * times(times(x[i], y[j]), w[n - i - j]) for (i, j), v in np.ndenumerate(terms) if v))


def loop_is_crossed(loop, center, field, lines, sign):
    """Return places about which a closed polygon goes, and whether it goes round C and all orbits cross it inwards (1).

    Or outwards (-1): that is, each from its right to its left, or each from its left to its right, if it meets itself.
    """
    p, size = np.array(loop, float).reshape(-1, 2), field.size
    d = np.roll(p, -1, axis=0) - p
    length, inside = np.hypot(*d.T), center + 0.97 * (p[:: len(p) // 16 or 1] - center)
    if len(p) < 3 or np.hypot(*p.T).max() >= 1 - ROUNDING_BOUND or winding(p, d, center) != 1:
        return inside, False
    inside = np.array([q for q in inside if winding(p, d, q) >= 1]).reshape(-1, 2)
    for pieces in (16, 128, 1024, 8192):  # the edges that are not decided yet, in more pieces
        e = p[:, None] + d[:, None] * ((np.arange(pieces) + 0.5) / pieces)[None, :, None]
        U, r, modulus = (
            np.moveaxis(field.at(np.moveaxis(e, 2, 0)), 0, 2),
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


def zero_bound(P, start, end):
    """Return a bound of the zeros of P on the way from one place to another (Descartes); None if a corner is one."""
    n, powers = 2 * len(P) - 2, [[np.array([1], object)], [np.array([1], object)]]
    for row, a, b in zip(powers, start, end):
        while len(row) < len(P):
            row.append(np.append(row[-1] * a, 0) + np.append(0, row[-1] * (b - a)))
    line = np.full(n + 1, 0, object)
    for (i, j), v in np.ndenumerate(P):
        line[: i + j + 1] += v * np.convolve(powers[0][i], powers[1][j])
    left = np.array([[comb(j, i) * 2 ** (n - j) for i in range(n + 1)] for j in range(n + 1)], object)
    whole = lcm(*(comb(n, i) for i in range(n + 1)))
    M = np.array([[comb(j, i) * whole // comb(n, i) for i in range(n + 1)] for j in range(n + 1)], object)
    parts = [M @ integers(line)]
    for _ in range(5):
        parts = [half for part in parts for half in (left @ part, (left @ part[::-1])[::-1])]
    if not all(part[0] and part[-1] for part in parts):
        return None
    signs = [[v > 0 for v in part if v] for part in parts]
    return sum(v != w for part in signs for v, w in pairwise(part))


def cycle_count(P, certificate, charts, field, lines):
    """Return how many closed curves P = 0 has, if that is the number of cycles."""
    (L, chart, lift), n, changes = charts, len(P) - 1, []
    places, starts = certificate["critical"], [[Fraction(v) for v in start] for start in certificate["starts"]]
    slope = sum(abs(v) * (i + j + 1) for (i, j), v in np.ndenumerate(P))
    for (c, s), start, end in zip(places, starts, certificate["ways"], strict=True):
        X, Y, W = L @ [Fraction(c), Fraction(s), 1]
        near = Fraction(9 * float(abs(L).sum() / W)) * REACH + Fraction(1, 2**40)
        value = sum(v * start[0] ** i * start[1] ** j for (i, j), v in np.ndenumerate(P) if v)
        if not (max(abs(X / W - start[0]), abs(Y / W - start[1])) * 2**40 < 1 and abs(value) > slope * near):
            return None  # P has one sign on the way from C to its start
        joined = isinstance(end, int)  # to a critical set before this one
        if not (0 <= end < len(changes) if joined else {*map(type, end)} == {int} and max(map(abs, end)) == 8):
            return None
        changes.append(zero_bound(P, start, starts[end] if joined else [Fraction(v, 8) for v in end]))
    if None in changes or sum(map(bool, changes)) > 1:
        return None
    most, core = sum(changes), []
    if most == 0:
        return 0
    for i, (end, change) in enumerate(zip(certificate["ways"], changes)):
        core += [i] if change or (isinstance(end, int) and end in core) else []
    others = [place for i, place in enumerate(places) if i not in core]
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
    middle, reached, (X, Y) = 2 ** (GRID - 1), np.zeros(signs.shape, bool), starts[core[0]]
    count, sign = 0, 1 if sum(v * X**i * Y**j for (i, j), v in np.ndenumerate(P)) > 0 else -1
    i, j = (int((v + 1) * middle) for v in (X, Y))
    reached[max(i - 1, 0) : i + 2, max(j - 1, 0) : j + 2] = True
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
    U, error = field.at(e), 3 * step * field.size
    rest = (abs(e[0] * U[1] - e[1] * U[0]) <= error) & ~other
    kept = not others and bool((sign * (e * U).sum(axis=0) < -error)[rest].all())
    if count == most and not kept:  # or may not come there for a polygon, not all of it within the last closed curve
        inside, kept = loop_is_crossed(certificate["loop"], np.array(places[core[0]]), field, lines, sign)
        p = np.array(certificate["loop"], float).reshape(-1, 2)
        kept = kept and not any(winding(p, np.roll(p, -1, axis=0) - p, np.array(place)) for place in others)
        kept = kept and is_covered(~inner, lift, inside.T, ROUNDING_BOUND).any()
    return count if count == most and kept else None


def is_covered(squares, lift, e, step):
    """Whether all that is as near as this to places e is in some of the squares."""
    lifted, spread, middle = lift @ np.vstack([e, np.ones(e.shape[1])]), abs(lift).sum() * step, len(squares) // 2
    eta, away = lifted[:2] / lifted[2], 3 * spread / np.maximum(lifted[2] - spread, 1e-99)
    near = [np.floor((eta + i * away + 1) * middle).astype(int).clip(0, 2 * middle - 1) for i in (-1, 1)]
    return np.all([squares[near[i][0], near[j][1]] for i in (0, 1) for j in (0, 1)], axis=0) & (away < 1 / middle)


if __name__ == "__main__":
    proved = check(json.loads(sys.stdin.read()))
    for name, value in proved.items():
        print(f"{name}: not proved" if value is None else f"{name}, and no other: {value}")
    sys.exit(0 if any(value is not None for value in proved.values()) else 1)
