"""Delayed loss of stability: how long a motion stays near a critical set that has become unstable (tr J = 0 < det J).

Near C the distance from the slow motion grows like ``exp(G(t)/eps)``, ``G' = Re lambda``, with lambda the leading
eigenvalue of J. It has fallen since the motion came to C; so, where the formulas are analytic, the motion leaves C when
G has come back to where it was: way in = way out (A. I. Neishtadt, Differential Equations 23, 1385, 1987).
The slow motion itself may end the delay before. It is singular in complex time, at t* with ``det J = 0`` and where the
formulas are, and what it leaves behind there, of size ``exp(-(G(Re t*) + V)/eps)`` where V is the real part of the
integral of lambda from Re t* to t*, shows when ``G(t) = G(Re t*) + V``: the buffer point. A critical set that does not
move leaves nothing behind. Functions are continued into the complex plane by AAA: Y. Nakatsukasa, O. Sete and
L. N. Trefethen, SIAM J. Sci. Comput. 40, A1494 (2018), barycentric, its support points chosen one after the other
where the error is largest.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from ...numerics.dense import Dense, dense, gather_steps
from ...numerics.radau import Step, truncate_step
from ...numerics.sign_changes import root_between
from ...results.arrays import Array, Complex
from ...results.words import say
from ...systems.psi.function import Psi
from ..initial_value.field import Field
from ..initial_value.slow_manifold import complement, solve_critical
from ..locations import in_disc, jacobian
from .sigma_decision import ORBITS_AROUND, START_DISTANCE
from .slide import Slide

MAX_SUPPORT_POINTS = 40  # support points
MAX_DOUBLET_RESIDUE = 1e3  # in tolerances of |f| times the interval: poles of less are made by rounding


@dataclass(frozen=True, eq=False)
class RationalApproximation:
    """``sum w_j f_j/(t - t_j) / sum w_j/(t - t_j)``."""

    points: Array  # (k,) t_j, f_j and w_j
    values: Array
    weights: Array
    size: float  # largest |f|
    tolerance: float  # of size: how far it is from f where f was given

    def __call__(self, t: complex) -> complex:
        """Return the value at one place, infinite at a pole."""
        away = t - self.points
        if (away == 0.0).any():
            return complex(self.values[away == 0.0][0])
        share = self.weights / away
        whole = complex(share.sum())
        return complex(share @ self.values) / whole if whole else complex(math.inf)

    def zeros(self) -> Complex:
        """Return where it vanishes."""
        return self._roots(self.weights * self.values)

    def poles(self) -> Complex:
        """Return its poles, without those that rounding makes: pairs of a pole and a zero, of no residue."""
        found = self._roots(self.weights)
        away = found[:, None] - self.points
        residues = (self.weights * self.values / away).sum(axis=1) / -(self.weights / away**2).sum(axis=1)
        least = MAX_DOUBLET_RESIDUE * self.tolerance * self.size * float(np.ptp(self.points))
        return found[np.abs(residues) > least]

    def _roots(self, weights: Array) -> Complex:
        """Zeros of ``sum weights_j/(t - t_j)``: finite eigenvalues of an arrowhead pencil."""
        from scipy.linalg import eigvals  # imported late: it takes longer than all of this package

        k = len(self.points)
        arrow = np.diag(np.concatenate([[0.0], self.points]))
        arrow[0, 1:], arrow[1:, 0] = weights, 1.0
        found = np.asarray(eigvals(arrow, np.diag(np.concatenate([[0.0], np.ones(k)]))), complex)
        return found[np.isfinite(found)]


def approximate_rationally(t: Array, f: Array, tolerance: float) -> RationalApproximation | None:
    """Approximate f, given at t (n,), to a tolerance of its size; None where that takes too many points."""
    size = float(np.abs(f).max())
    chosen: list[int] = []
    approximation = np.full(len(f), f.mean())
    for _ in range(min(MAX_SUPPORT_POINTS, len(t) // 2)):
        chosen.append(int(np.argmax(np.abs(f - approximation))))
        rest = np.ones(len(t), bool)
        rest[chosen] = False
        cauchy = 1.0 / (t[rest, None] - t[chosen])
        loewner = (f[rest, None] - f[chosen]) * cauchy
        weights = np.linalg.svd(loewner, full_matrices=False)[2][-1]
        approximation = f.copy()
        approximation[rest] = cauchy @ (weights * f[chosen]) / (cauchy @ weights)
        if np.abs(f - approximation).max() <= tolerance * size:
            return RationalApproximation(t[chosen], f[chosen], weights, size, tolerance)
    return None


#: Of the polynomials of tr J and det J along a part of a step; how often it is halved.
TRACE_DEGREE, MAX_HALVINGS = 9, 12
RESOLVED, CHECK_SHARE = 1e-11, 0.43  # error allowed, of their size; where in a part it is looked at
SIGN_PARTS = 8  # of such a part, at whose ends signs are looked at
CONTINUATION_SAMPLES = 400  # times from which tr J and det J are continued into the complex plane
FINER, COARSER = 1e-9, 3e-8  # errors of two rational functions: a singular time that only one has is none
CORNER = 3.0  # times between samples: a pole that near is a corner's
SAME_SINGULARITY = 1e-3  # of its distance from the real axis: how far apart the two may have it
VANISHES = 0.1  # of |lambda| at Re t*: more than that at a zero of det J, and it is the other eigenvalue that is 0
REST_CHANGE = 1e-11  # change of e of a critical set that does not move
QUADRATURE_PANELS = 40  # of the way from Re t* to t*
GAUSS_NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)
GAUSS_POINTS: Array = 0.5 * (1.0 + GAUSS_NODES)
SHARES: Array = 0.5 * WEIGHTS


class NotAnalyticError(Exception):
    """J is continued into complex time by no rational function: its formulas have a kink, or are not smooth."""


@dataclass(frozen=True)
class DelayedExitPoint:
    """The exit of a motion from an unstable critical set."""

    t: float
    buffer: complex | None  # the singular time that ends the delay; None where it is way in = way out


def cut_at_exit(
    field: Field, psi: Psi, taken: Sequence[Step], places: Sequence[Array], part: Slide
) -> tuple[Slide, DelayedExitPoint | None]:
    """Cut a slide on an unstable critical set where the motion leaves it; raises NotAnalyticError."""
    if not part.taken:
        return part, None
    growth = Growth(field, psi, [*taken, *part.taken], [*places, *part.places[1:]])
    way = growth.way_out(part.taken[0].start)
    if way is None:
        return part, None
    k = next(i for i, step in enumerate(part.taken) if step.end >= way.t)
    step, e = part.taken[k], growth.place(way.t)
    last = truncate_step(step, (way.t - step.start) / step.h)
    return replace(part, taken=[*part.taken[:k], last], end="left", e=e, places=[*part.places[: k + 1], e]), way


class Growth:
    """G along a motion on a critical set, from where it came to it."""

    def __init__(self, field: Field, psi: Psi, taken: Sequence[Step], places: Sequence[Array]) -> None:
        first = taken[0].first
        self.field, self.psi, self.e = field, psi, np.array(places)
        self.motion = dense(taken[0].start, first, [gather_steps(taken, len(first))])
        self.J = self._polynomials()
        times = self.J.times
        fine = np.unique(times[:-1, None] + np.diff(times)[:, None] * np.arange(SIGN_PARTS + 1) / SIGN_PARTS)
        # between these times G is smooth and monotone, as far as signs show it
        self.cuts = np.unique(np.concatenate([times, *(_sign_changes(of, fine) for of in (self.rate, self._focus))]))
        self.at = np.concatenate([[0.0], np.cumsum(self._integrals(self.cuts[:-1], self.cuts[1:]))])

    def way_out(self, unstable: float, rise: float = 0.0) -> DelayedExitPoint | None:
        """Return when the motion leaves the set, `rise` added to G at a buffer point, or None; NotAnalyticError."""
        end = self._reaches(0.0, unstable)
        found = [] if end is None else [DelayedExitPoint(end, None)]
        if np.ptp(self.e, axis=0).max() > REST_CHANGE:
            for time, height in self._singular(float(self.motion.times[-1]) if end is None else end):
                t = self._reaches(self._growth(time.real) + height + rise, max(unstable, time.real))
                found += [] if t is None else [DelayedExitPoint(t, time)]
        return min(found, key=lambda way: way.t, default=None)

    def place(self, t: float) -> Array:
        """E of the set at a time."""
        guess = np.array([np.interp(t, self.motion.times, column) for column in self.e.T])
        e = solve_critical(self.field, guess, self.motion(t)[2:])
        return guess if e is None else e

    def linear(self, t: float) -> tuple[float, float]:
        """Trace and determinant of J at a time."""
        e, z = self.place(t), self.motion(t)[2:]
        r, gap = math.hypot(e[0], e[1]), complement(e)
        if gap <= 0.0:  # on the equator J is 0: orbits take for ever there
            return 0.0, 0.0
        D = self.field.jacobian(float(e[0]), float(e[1]), 0.0, 0.0, z.tolist())[:2, :2]
        radial, tangential = self.psi.jacobian_factors(self.psi.radius(r, gap))
        n = e / r if r > 0.0 else np.array([1.0, 0.0])
        along = float(n @ D @ n)
        det = float(D[0, 0] * D[1, 1] - D[0, 1] * D[1, 0])
        return radial * along + tangential * (float(np.trace(D)) - along), radial * tangential * det

    def rate(self, t: ArrayLike) -> Array:
        """G' at times, the real part of the leading eigenvalue."""
        return 0.5 * self.J(t)[..., 0] + np.sqrt(np.maximum(-self._focus(t), 0.0))

    def _focus(self, t: ArrayLike) -> Array:
        """Return ``det J - (tr J)^2/4``: positive where both eigenvalues turn."""
        J = self.J(t)
        return J[..., 1] - 0.25 * J[..., 0] ** 2

    def _polynomials(self) -> Dense:
        """Trace and determinant of J, as polynomials along the steps, which are halved until these are resolved."""
        nodes = 0.5 - 0.5 * np.cos(math.pi * np.arange(TRACE_DEGREE + 1) / TRACE_DEGREE)
        powers = nodes[1:, None] ** np.arange(1, TRACE_DEGREE + 1)
        todo = [(a, b, MAX_HALVINGS) for a, b in reversed([*pairwise(self.motion.times.tolist())])]
        ends, states, polynomials, size = [todo[-1][0]], list[Array](), list[Array](), np.zeros(2)
        while todo:
            a, b, more = todo.pop()
            values = np.array([self.linear(a + (b - a) * u) for u in nodes.tolist()])
            size = np.maximum(size, np.abs(values).max(axis=0))
            polynomial = np.linalg.solve(powers, values[1:] - values[0]).T
            checked = values[0] + polynomial @ (CHECK_SHARE ** np.arange(1, TRACE_DEGREE + 1))
            off = np.abs(checked - self.linear(a + (b - a) * CHECK_SHARE))
            if more and (off > RESOLVED * size).any():
                todo += [(0.5 * (a + b), b, more - 1), (a, 0.5 * (a + b), more - 1)]
                continue
            ends.append(b)
            states += [values[0]] if todo else [values[0], values[-1]]
            polynomials.append(polynomial)
        return Dense(np.array(ends), np.array(states), np.diff(ends), np.array(polynomials))

    def _integrals(self, a: ArrayLike, b: ArrayLike) -> Array:
        """Integrals of G' (k,), by Gauss and Legendre in v, t = a + (b - a)(3 v^2 - 2 v^3): no root is left."""
        a, length = np.asarray(a, float), np.asarray(b, float) - a
        t = a[..., None] + length[..., None] * GAUSS_POINTS**2 * (3.0 - 2.0 * GAUSS_POINTS)
        return length * (self.rate(t) * (SHARES * 6.0 * GAUSS_POINTS * (1.0 - GAUSS_POINTS))).sum(axis=-1)

    def _growth(self, t: float) -> float:
        """G, from 0 at the start."""
        i = min(int(np.searchsorted(self.cuts, t, side="right")) - 1, len(self.cuts) - 2)
        return float(self.at[i] + self._integrals(self.cuts[i], t))

    def _reaches(self, level: float, after: float) -> float | None:
        """Return the first time from `after` on at which G has risen to a level."""
        for (a, _), (b, high) in pairwise(zip(self.cuts.tolist(), self.at.tolist(), strict=True)):
            low = max(a, after)
            if b > low and high >= level:
                gap = lambda t: self._growth(t) - level
                return low if gap(low) >= 0.0 else root_between(gap, low, b)
        return None

    def _singular(self, last: float) -> Iterator[tuple[complex, float]]:
        """Singular times before `last`, in the upper half plane, each with its V."""
        start = float(self.cuts[0])
        span = last - start
        s = np.linspace(0.0, 1.0, CONTINUATION_SAMPLES)
        J = self.J(start + span * s) * [span, span * span]  # in a unit of time of its own
        (trace, det), coarser = ([_rational_interpolant(s, f, error) for f in J.T] for error in (FINER, COARSER))
        other = _singularities(coarser[0], coarser[1])
        for time in _singularities(trace, det).tolist():
            alike = np.abs(other - time).min(initial=math.inf) < SAME_SINGULARITY * time.imag
            if alike and 0.0 < time.real < 1.0 and (height := _height(trace, det, time)) is not None:
                yield start + span * time, height


def _rational_interpolant(t: Array, f: Array, error: float) -> RationalApproximation:
    found = approximate_rationally(t, f, error)
    if found is None:
        raise NotAnalyticError
    poles = found.poles()
    at_corner = (np.abs(poles.imag) < CORNER * (t[1] - t[0])) & (t[0] < poles.real) & (poles.real < t[-1])
    if at_corner.any():
        raise NotAnalyticError
    return found


def _singularities(trace: RationalApproximation, det: RationalApproximation) -> Complex:
    """Zeros of det J, and poles of both, in the upper half plane."""
    found = np.concatenate([det.zeros(), det.poles(), trace.poles()])
    return found[found.imag > 0.0]


def _height(trace: RationalApproximation, det: RationalApproximation, time: complex) -> float | None:
    """V up to a singular time, along the eigenvalue that falls on the way, or leads; None if it is no end for that."""
    parts = ((np.arange(QUADRATURE_PANELS)[:, None] + GAUSS_POINTS) / QUADRATURE_PANELS).ravel()
    values, half = [], 0j
    for t in (time.real + 1j * time.imag * parts).tolist():
        root = np.sqrt(0.25 * trace(t) ** 2 - det(t))
        if not values and abs(root.imag) > abs(root.real):
            root *= -math.copysign(1.0, root.imag)
        elif values and abs(root - half) > abs(root + half):
            root = -root
        half = root
        values.append(0.5 * trace(t) + half)
    height = (
        -time.imag / QUADRATURE_PANELS * float(np.tile(SHARES, QUADRATURE_PANELS) @ np.imag(values))
    )  # the real part of lambda i dy
    vanishing = abs(det(time)) < VANISHES**2 * abs(values[0]) ** 2
    return None if height <= 0.0 or (vanishing and abs(values[-1]) > VANISHES * abs(values[0])) else height


def _sign_changes(of: Callable[[float], Array], times: Array) -> Array:
    value = lambda t: float(of(t))
    signs = np.sign([value(t) for t in times.tolist()])
    return np.array([root_between(value, times[i], times[i + 1]) for i in np.flatnonzero(signs[1:] * signs[:-1] < 0)])


ARRIVAL_DISTANCE = 1e-3  # from a set, in p, at which it is asked on which side a motion comes


@dataclass(frozen=True)
class DelayedExit:
    """The slide past the bifurcation, cut where the motion leaves; why it goes on; and the way out."""

    part: Slide
    reason: str
    way: DelayedExitPoint | None


def cut_at_delayed_exit(
    field: Field, psi: Psi, before: tuple[Sequence[Step], Sequence[Array]], part: Slide, C: str | None, how: str
) -> DelayedExit:
    """Cut a slide past the bifurcation where the motion leaves the set; raises NotAnalyticError."""
    taken, places = before
    part, way = cut_at_exit(field, psi, taken, places, part)
    key = "Hopf, delayed"
    if way is not None:
        key = "Hopf, delayed until" if way.buffer is None else "Hopf, delayed until the buffer"
    return DelayedExit(part, say(key, C=C, how=how), way)


def exit_circle(psi: Psi, e: Array) -> Array:
    """Points (k, 2) of the projected disc around a critical set, from which orbits show where a motion leaves it to."""
    angle = math.tau * np.arange(ORBITS_AROUND) / ORBITS_AROUND
    return in_disc(psi, e) + START_DISTANCE * np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def departure_point(field: Field, psi: Psi, e: Array, z: Sequence[Array], arrival: Array) -> Array | None:
    """Return the point (1, 2) to which a motion leaves a set at rest, on the side on which it came; None if unknown."""
    C, first, left = in_disc(psi, e), None, np.zeros(2)
    for at in z:
        values, vectors = np.linalg.eig(jacobian(field, psi, e, at).T)
        if np.iscomplexobj(values):
            return None
        n = vectors[:, int(np.argmax(values))]
        left = -n if n @ left < 0.0 else n
        first = left if first is None else first
    away = arrival - C
    far = np.flatnonzero(np.hypot(*away.T) > ARRIVAL_DISTANCE)
    if first is None or not len(far):
        return None
    values, vectors = np.linalg.eig(jacobian(field, psi, e, z[-1]))
    right = vectors[:, int(np.argmax(values))]
    side = math.copysign(1.0, float(first @ away[far[-1]]) * float(left @ right))
    return (C + side * START_DISTANCE * right)[None]
