"""Search for a function of Dulac and Cherkas by linear programming: a polynomial in a chart with C at its middle."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray
from scipy.linalg import LinAlgError, cho_factor, cho_solve

from ...arrays import Array
from ...layer_problem.problem import LayerProblem
from ...psi.kernel import VECTOR

CHART_SHRINKAGE = 1.0001  # the disc lies in the square of the chart
MAX_ROUNDS = 40
MAX_CORNERS = 4000
MAX_CUTS, RINGS, RAY_COUNT = 12, 96, 320
LEAST_MARGIN = 1e-5  # of a function with coefficients up to 1: below it none is sought


def chart_at(e_C: Array) -> Array:
    """Return the projective map (3, 3) of the disc onto itself, from eta to e, that leads 0 to C."""
    square = float(e_C @ e_C)
    gamma = 1.0 / math.sqrt(1.0 - square)
    found = np.eye(3)
    if square > 0.0:
        found[:2, :2] += (gamma - 1.0) * np.outer(e_C, e_C) / square
    found[:2, 2] = found[2, :2] = gamma * e_C
    found[2, 2] = gamma
    return found * (CHART_SHRINKAGE, CHART_SHRINKAGE, 1.0)


def exponents(degree: int) -> NDArray[np.intp]:
    """Return the degrees in x and in y of the products of Chebyshev polynomials (2, m)."""
    return np.array([(i, j) for i in range(degree + 1) for j in range(degree + 1 - i)]).T


def factors(place: Array, degree: int) -> tuple[Array, ...]:
    """Return Chebyshev polynomials of x and of y at places (2, n), and their derivatives, each (n, degree + 1)."""
    derive = np.array([np.append(chebyshev.chebder(row), 0.0) for row in np.eye(degree + 1)]).T
    T = [chebyshev.chebvander(one, degree) for one in place]
    return T[0], T[1], T[0] @ derive, T[1] @ derive


@lru_cache(maxsize=1)
def net() -> Array:
    """Return places (2, rings, rays) of the disc."""
    r, t = np.sin(0.5 * math.pi * np.arange(1, RINGS + 1) / RINGS), math.tau * np.arange(RAY_COUNT) / RAY_COUNT
    return np.array([np.outer(r, wave(t)) for wave in (np.cos, np.sin)]) / CHART_SHRINKAGE


class ProbePoints:
    """Phi at places (2, n) of the disc, as a linear function of the coefficients of P: `__init__`, 2."""

    def __init__(self, system: ScaledLayerProblem, place: Array, k: float, mu: float) -> None:
        self.place = place
        x, y, w = lifted = system.chart @ np.vstack([place, np.ones(place.shape[1])])
        beta = np.interp((x**2 + y**2) / w**2, system.m, system.beta)
        u, v = system.A @ lifted[:2] + system.f[:, None] * w
        V = np.linalg.solve(system.chart, np.array([w * u, w * v, beta * (x * u + y * v)]))
        self.H = V[:2] - place * V[2]
        self.rest = k * (w * np.trace(system.A) + beta * (system.f @ lifted[:2]) - mu * V[2])
        self.share = np.minimum(1.0, abs(k * system.trace) + (place**2).sum(axis=0))  # of the margin that is asked for

    def rows(self, degree: int) -> Array:
        """Return Phi, by its share of the margin, for each product of Chebyshev polynomials (n, m)."""
        (X, Y, dX, dY), (i, j) = factors(self.place, degree), exponents(degree)
        found = self.H[0][:, None] * dX[:, i] * Y[:, j] + self.H[1][:, None] * X[:, i] * dY[:, j]
        return (found + self.rest[:, None] * X[:, i] * Y[:, j]) / self.share[:, None]

    def values(self, function: Array) -> Array:
        """Return Phi, by its share of the margin (n,)."""
        X, Y, dX, dY = factors(self.place, len(function) - 1)
        inner = X @ function
        found = self.H[0] * ((dX @ function) * Y).sum(axis=1) + self.H[1] * (inner * dY).sum(axis=1)
        return (found + self.rest * (inner * Y).sum(axis=1)) / self.share


class ScaledLayerProblem:
    """An e-linear layer problem, in units of its largest coefficient, in the chart with C at its middle."""

    def __init__(self, problem: LayerProblem) -> None:
        assert problem.at.affine is not None
        a, b, c, d, f, g = np.array(problem.at.affine, float) / max(map(abs, problem.at.affine))
        self.A, self.f, self.kernel = np.array([[a, b], [c, d]]), np.array([f, g]), problem.psi.kernel
        self.chart = chart_at(-np.linalg.solve(self.A, self.f))
        s = np.append(0.0, np.geomspace(1e-6, 1e9, 4000))
        with np.errstate(all="ignore"):
            value, slope = self.kernel.value(VECTOR, s), self.kernel.slope(VECTOR, s)
        self.m, self.beta, self.trace = s / (s + value), 1.0 + slope, 0.0
        self.trace = float(ProbePoints(self, np.zeros((2, 1)), 1.0, 0.0).rest[0])


def best_function(system: ScaledLayerProblem, degree: int, k: float, mu: float) -> tuple[float, Array]:
    """Find P, coefficients up to 1, with about the largest margin: by some places, and those where it falls short."""
    every = ProbePoints(system, net().reshape(2, -1), k, mu)
    step = max(1, every.place.shape[1] // (5 * math.comb(degree + 2, 2)))
    first = ProbePoints(
        system, np.hstack([np.zeros((2, 1)), every.place[:, ::step], net()[:, -1, :: RAY_COUNT // (8 * degree)]]), k, mu
    )
    M, function = first.rows(degree), np.zeros((degree + 1, degree + 1))
    patch = np.stack(np.meshgrid(*[np.linspace(-1.0, 1.0, 5)] * 2)).reshape(2, 1, 25) * (3.0 / RAY_COUNT)
    for _ in range(MAX_CUTS):
        margin, function[tuple(exponents(degree))] = largest_margin(M)
        if margin < LEAST_MARGIN:
            break
        reached = every.values(function).reshape(RINGS, RAY_COUNT)
        around = [
            np.roll(reached, 1, axis=1),
            np.roll(reached, -1, axis=1),
            np.pad(reached[1:], ((0, 1), (0, 0)), mode="edge"),
            np.pad(reached[:-1], ((1, 0), (0, 0)), mode="edge"),
        ]
        dips = np.flatnonzero((reached <= np.min(around, axis=0)) & (reached < 2.0 * margin))
        dips = dips[np.argsort(reached.ravel()[dips])[:300]]
        beside = (every.place[:, dips, None] + patch).reshape(2, -1)
        near = ProbePoints(system, beside / np.maximum(1.0, CHART_SHRINKAGE * np.hypot(*beside)), k, mu)
        lower = near.values(function).reshape(-1, 25)
        least = float(lower.min(initial=margin))
        if least > 0.3 * margin:
            return least, function
        cuts = (np.arange(len(lower)) * 25 + lower.argmin(axis=1))[lower.min(axis=1) < 0.7 * margin]
        M = np.vstack([M, ProbePoints(system, near.place[:, cuts], k, mu).rows(degree)])
    return 0.0, function


def largest_margin(M: Array) -> tuple[float, Array]:
    """Find c, |c| <= 1, with ``M c >= t`` for about the largest t, by a predictor-corrector method (Mehrotra 1992)."""
    m, n = M.shape
    rows, last = np.hstack([-M, np.ones((m, 1))]), np.arange(n + 1)

    def map_coordinates(y: Array) -> Array:
        return np.concatenate([rows @ y, y[:n], -y[:n]])

    def gather_columns(x: Array) -> Array:
        found = x[:m] @ rows
        found[:n] += x[m : m + n] - x[m + n :]
        return found

    def furthest(values: Array, by: Array) -> float:
        down = by < 0.0
        return min(1.0, 0.99 * float((-values[down] / by[down]).min(initial=2.0)))

    def direction(to: Array, x: Array, s: Array, short: Array, off: Array, factor: Any) -> tuple[Array, Array, Array]:
        dy = cho_solve(factor, short - gather_columns((to - x * off) / s), check_finite=False)
        ds = off - map_coordinates(dy)
        return (to - x * ds) / s, dy, ds

    bounds, wanted = np.concatenate([np.zeros(m), np.ones(2 * n)]), np.append(np.zeros(n), 1.0)
    y = -wanted
    x, s = np.full(m + 2 * n, 1.0 / m), np.maximum(bounds - map_coordinates(y), 1e-6)
    best, at_best = -math.inf, y[:n]
    for _ in range(MAX_ROUNDS):
        short, off, gap = wanted - gather_columns(x), bounds - map_coordinates(y) - s, float(x @ s) / len(x)
        scale = x / s
        normal = (rows * scale[:m, None]).T @ rows
        normal[last[:n], last[:n]] += scale[m : m + n] + scale[m + n :]
        normal[last, last] *= 1.0 + 1e-13
        try:
            factor = cho_factor(normal, check_finite=False)
        except LinAlgError:
            break

        dx, dy, ds = direction(-x * s, x, s, short, off, factor)
        ahead = float((x + furthest(x, dx) * dx) @ (s + furthest(s, ds) * ds)) / len(x)
        dx, dy, ds = direction((ahead / gap) ** 3 * gap - x * s - dx * ds, x, s, short, off, factor)
        on, off_by = furthest(x, dx), furthest(s, ds)
        x, y, s = x + on * dx, y + off_by * dy, s + off_by * ds
        margin, bound = float((M @ y[:n]).min()), float(np.abs(x[:m] @ M).sum() / x[:m].sum())
        if margin > best:
            best, at_best = margin, y[:n]
        if bound < LEAST_MARGIN or best > 0.7 * bound:
            break
    return best, at_best


def loops(system: ScaledLayerProblem, cycle: Array, stable: bool) -> Iterator[Array]:
    """Look for polygons (m, 2) in e, beyond a cycle, that all orbits cross towards it, or all away from it.

    An orbit of the field that is turned by an angle goes once round C, and back along the section of `limit_cycles`.

    Parameters
    ----------
    system : ScaledLayerProblem
    cycle : ndarray (m, 2)
        In e.
    stable : bool
    """
    (a, b), (c, d) = system.A
    weights, axes = np.linalg.eigh([[a, 0.5 * (b + c)], [0.5 * (b + c), d]])
    first, second = math.sqrt(weights[1]), math.sqrt(-weights[0])
    lift, center = np.linalg.inv(system.chart), system.chart[:2, 2] / system.chart[2, 2]
    x, y, w = lift @ np.vstack([cycle.T, np.ones(len(cycle))])
    line, forward = (x + 1j * y) / w, 1.0 if stable else -1.0  # the sense of time in which the cycle attracts
    sense = forward if c > b else -forward
    for u in (axes @ (s * first, r * second) for s in (1.0, -1.0) for r in (1.0, -1.0)):
        ahead = lift @ [*(center + 1e-3 * u / math.hypot(*u)), 1.0]
        way = complex(ahead[0], ahead[1]) / math.hypot(ahead[0], ahead[1])
        turned = line / way
        crosses = (turned.imag[1:] * turned.imag[:-1] <= 0.0) & (turned.real[1:] > 0.0)
        if not crosses.any():
            continue
        inner = float(turned.real[1:][crosses].max())
        for share, angle in ((0.3, 0.03), (0.1, 0.03), (0.6, 0.03), (0.03, 0.01), (0.3, 0.1)):
            start = (inner + share * (1.0 / CHART_SHRINKAGE - inner)) * way
            found = follow_rotated_field(system, start, way, forward, sense, -sense * angle)
            if found and abs(found[-1]) < abs(start):
                found = found if sense > 0.0 else found[::-1]
                X, Y, W = system.chart @ [[z.real for z in found], [z.imag for z in found], np.ones(len(found))]
                yield np.array([X / W, Y / W]).T


def follow_rotated_field(
    system: ScaledLayerProblem, start: complex, way: complex, forward: float, sense: float, angle: float
) -> list[complex]:
    """Follow the turned field once round C, in the chart, in steps that turn less than the angle."""
    lift, turn = np.linalg.inv(system.chart).tolist(), complex(math.cos(angle), math.sin(angle))
    N, (a, b, c, d), (f, g) = system.chart.tolist(), system.A.ravel().tolist(), system.f.tolist()

    def toward(z: complex) -> complex:
        x, y, w = (p * z.real + q * z.imag + r for p, q, r in N)
        u, v = a * x + b * y + f * w, c * x + d * y + g * w
        beta = float(np.interp((x * x + y * y) / (w * w), system.m, system.beta))
        last = beta * (x * u + y * v)
        V = [p * w * u + q * w * v + r * last for p, q, r in lift]
        found = forward * turn * (complex(V[0], V[1]) - z * V[2])
        return found / (abs(found) or 1e-300)

    places, here, h, left = [start], toward(start), 0.1 * abs(angle), False
    while len(places) < MAX_CORNERS:
        z, step = places[-1], h * abs(places[-1])
        middle = toward(z + 0.5 * step * here)
        there = z + step * toward(z + 0.5 * step * middle)
        after = toward(there)
        turned = abs(after - here)
        if turned > 0.5 * abs(angle) and h > 1e-6:
            h *= 0.5
            continue
        if abs(there) > 1.0 / CHART_SHRINKAGE:
            return []
        before, side = sense * (z / way).imag, sense * (there / way).imag
        if left and before < 0.0 <= side and (there / way).real > 0.0:
            return [*places, z + (there - z) * before / (before - side)]
        left = left or (there / way).real < 0.0
        places.append(there)
        here, h = after, min(1.5 * h, 0.2)
    return []


def write_certificate(
    problem: LayerProblem, system: ScaledLayerProblem, function: Array, k: float, mu: float, loop: Array
) -> dict[str, Any]:
    """Write a certificate: numbers as they were given, not rounded."""
    a, b, d, e, f, g = problem.at.affine or (0.0,) * 6
    edge = np.arange(-8, 9)
    ways = np.array([(p, q) for p in edge for q in edge if max(abs(p), abs(q)) == 8])
    x, y = np.multiply.outer(ways.T / 8.0, np.linspace(0.0, 1.0, 201))
    signs = chebyshev.chebval2d(x, y, function) > 0.0
    way = ways[np.argmin((signs[:, 1:] != signs[:, :-1]).sum(axis=1))]
    return {
        "A": [[a, b], [d, e]],
        "f": [f, g],
        "psi": [problem.psi.family, problem.psi.parameter],
        "weight": [k, mu],
        "chart": system.chart.tolist(),
        "function": function.tolist(),
        "way": way.tolist(),
        "loop": loop.tolist(),
    }
