"""Search for a function of Dulac and Cherkas by linear programming: a polynomial in a chart with C at its middle."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev
from numpy.polynomial.polynomial import polyval2d
from numpy.typing import NDArray
from scipy.linalg import LinAlgError, cho_factor, cho_solve

from ....formulas.arrays import Terms
from ....results.arrays import Array
from ....systems.psi.families.record import VECTOR
from ...layer_problem.problem import LayerProblem
from .result import FoundCycle

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
        x, y, w = system.chart @ np.vstack([place, np.ones(place.shape[1])])
        e = np.array([x, y]) / w
        beta = np.interp((e**2).sum(axis=0), system.m, system.beta)
        U, slopes = system.field(e), system.slopes(e)
        along = (e * U).sum(axis=0)
        V = np.linalg.solve(system.chart, w**2 * np.array([*U, beta * along]))
        self.H = V[:2] - place * V[2]
        rest = system.degree * along - np.einsum("ip,jip,jp->p", e, slopes, e)
        self.rest = k * (w * (slopes[0, 0] + slopes[1, 1] + beta * rest) - mu * V[2])
        far = [abs(k * trace) + ((place - start[:, None]) ** 2).sum(axis=0) for start, trace in system.nearby]
        self.share = np.minimum(1.0, np.min(far, axis=0))  # of the margin that is requested

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
    """A layer problem with polynomials for U, in units of their largest coefficient, in a chart."""

    def __init__(self, problem: LayerProblem, given: tuple[Terms, ...], cycles: Sequence[FoundCycle]) -> None:
        self.given, self.kernel = given, problem.psi.kernel
        c, s = math.cos(problem.at.turn), math.sin(problem.at.turn)
        self.back = np.array([[c, s], [-s, c]])  # to the axes of a matrix as it was given
        self.critical = [self.back @ C.e for C in problem.critical]
        n = self.degree = max(sum(place) for U in given for place in U)
        self.F = np.zeros((n + 1, n + 1, 2))
        for k, U in enumerate(given):
            for (i, j), v in U.items():
                self.F[i, j, k] = v
        self.F /= abs(self.F).max()
        rising = np.arange(1.0, n + 1.0)[:, None]
        self.DF = np.zeros((2, *self.F.shape))
        self.DF[0, :-1], self.DF[1, :, :-1] = self.F[1:] * rising[:, None], self.F[:, 1:] * rising
        around = [
            e
            for e, C in zip(self.critical, problem.critical, strict=True)
            if C.index > 0 and (not cycles or _surrounds(cycles[0].points, C.p))
        ]
        self.chart = chart_at(around[0] if len(around) == 1 or (cycles and around) else np.zeros(2))
        lifted = np.linalg.inv(self.chart) @ np.array([[*e, 1.0] for e in self.critical]).reshape(-1, 3).T
        self.starts = list((lifted[:2] / lifted[2]).T)
        s = np.append(0.0, np.geomspace(1e-6, 1e9, 4000))
        with np.errstate(all="ignore"):
            value, slope = self.kernel.value(VECTOR, s), self.kernel.slope(VECTOR, s)
        self.m, self.beta = s / (s + value), 1.0 + slope
        self.nearby = [(np.zeros(2), 1.0)]
        self.nearby = [(at, float(ProbePoints(self, at[:, None], 1.0, 0.0).rest[0])) for at in self.starts]

    def field(self, e: Array) -> Array:
        """Return U at places (2, ...)."""
        return polyval2d(e[0], e[1], self.F)

    def slopes(self, e: Array) -> Array:
        """Return D_e U at places (2, ...), first by c or s."""
        return np.array([polyval2d(e[0], e[1], one) for one in self.DF])


def _surrounds(loop: Array, place: Array) -> bool:
    angle = np.unwrap(np.arctan2(*(np.vstack([loop, loop[:1]]) - place).T[::-1]))
    return bool(abs(angle[-1] - angle[0]) > 1.0)


def best_function(system: ScaledLayerProblem, degree: int, k: float, mu: float) -> tuple[float, Array]:
    """Find P, coefficients up to 1, with about the largest margin: by some places, and those where it falls short."""
    every = ProbePoints(system, net().reshape(2, -1), k, mu)
    step = max(1, every.place.shape[1] // (5 * math.comb(degree + 2, 2)))
    first = ProbePoints(
        system,
        np.hstack([np.array(system.starts).T, every.place[:, ::step], net()[:, -1, :: RAY_COUNT // (8 * degree)]]),
        k,
        mu,
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
        patches = (every.place[:, dips, None] + patch).reshape(2, -1)
        near = ProbePoints(system, patches / np.maximum(1.0, CHART_SHRINKAGE * np.hypot(*patches)), k, mu)
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

    Shapes: cycle (m, 2).
    """
    lift = np.linalg.inv(system.chart)
    x, y, w = lift @ np.vstack([cycle.T, np.ones(len(cycle))])
    line, forward = (x + 1j * y) / w, 1.0 if stable else -1.0  # the sense of time in which the cycle attracts
    sense = forward * np.sign(_turning(system, line).sum())
    ways = np.exp(2j * math.pi * np.arange(64) / 64)
    rays = ways[:, None] * np.linspace(abs(line).min(), 0.99, 24)
    least = (forward * sense * _turning(system, rays.ravel())).reshape(rays.shape).min(axis=1)
    best = least.reshape(8, 8).argmax(axis=1) + 8 * np.arange(8)  # of each eighth of a turn
    for way in ways[best[np.argsort(-least[best])[:4]]].tolist():
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


def _turning(system: ScaledLayerProblem, z: NDArray[np.complex128]) -> Array:
    """Return how the field goes round the middle of the chart, as the sine of its angle to the ray."""
    H = ProbePoints(system, np.array([z.real, z.imag]), 1.0, 0.0).H
    return (z.real * H[1] - z.imag * H[0]) / (abs(z) * np.hypot(*H))


def follow_rotated_field(
    system: ScaledLayerProblem, start: complex, way: complex, forward: float, sense: float, angle: float
) -> list[complex]:
    """Follow the turned field once round C, in the chart, in steps that turn less than the angle."""
    lift, turn = np.linalg.inv(system.chart).tolist(), complex(math.cos(angle), math.sin(angle))
    N, rows = system.chart.tolist(), np.moveaxis(system.F, 2, 0)[:, ::-1, ::-1].tolist()  # for Horner's rule

    def value(U: list[list[float]], c: float, s: float) -> float:
        total = 0.0
        for row in U:
            inner = 0.0
            for v in row:
                inner = inner * s + v
            total = total * c + inner
        return total

    def toward(z: complex) -> complex:
        x, y, w = (p * z.real + q * z.imag + r for p, q, r in N)
        u, v = (w * value(U, x / w, y / w) for U in rows)
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
