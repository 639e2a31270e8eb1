"""The ray from a critical set to the equator, and the first turn of orbits from it.

Arcs of the equator along which a heteroclinic cycle through the equator may go.

Such a loop goes along the equator from a half-saddle P to the next one, Q (Theorem 3.1(b)), and back to P over the
hemisphere:

    P:  lambda_rho > 0, lambda_theta > 0 (orbits come down to it);    Q:  lambda_rho < 0, lambda_theta < 0.

The arc is always there; the orbit from Q to P is a connection of codimension one, see `heteroclinic_cycle`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...results.arrays import Array
from ...systems.frozen import FrozenSystem
from ..layer_problem.critical import CriticalSet
from ..layer_problem.equator import equilibria_at
from ..layer_problem.linearisation import Location
from ..layer_problem.problem import LayerProblem


@dataclass(frozen=True)
class HeteroclinicArc:
    """The arc of the equator of a possible loop."""

    source: float  # angles of P and Q
    sink: float
    sense: int  # +1 if Q follows P anticlockwise, else -1: the sense in which the loop turns
    # product of both saddles' ratios of the eigenvalue entered by to that left by: above 1 the loop attracts
    ratio: float

    def distance(self, other: HeteroclinicArc) -> float:
        """Return how far the ends of two arcs are apart."""
        gaps = (self.sink - other.sink, self.source - other.source)
        return sum(abs(math.remainder(gap, math.tau)) for gap in gaps)

    def spans(self, theta: Array) -> NDArray[np.bool_]:
        """Whether angles (k,) lie on it."""
        width = (self.sense * (self.sink - self.source)) % math.tau
        return (self.sense * (theta - self.source)) % math.tau < width


def heteroclinic_arcs(problem: LayerProblem) -> tuple[HeteroclinicArc, ...]:
    """Return the arcs from a half-saddle that orbits enter to the next one that they leave."""
    equator = problem.equator
    if (equator.multiplicity > 1).any():
        return ()
    angles, rho, theta = equator.theta.tolist(), equator.lambda_rho.tolist(), equator.lambda_theta.tolist()
    found = []
    for j in range(len(angles)):
        for sense in (1, -1):
            i = (j + sense) % len(angles)
            if rho[j] > 0.0 < theta[j] and rho[i] < 0.0 > theta[i]:
                ratio = rho[j] / theta[j] * theta[i] / rho[i]
                found.append(HeteroclinicArc(angles[j], angles[i], sense, ratio))
    return tuple(found)


#: Fractions of the first ebar. Below the first an orbit is so close that the equator decides what becomes of it: it is
#: gone, or it comes back however near it passes (cycles of ordinary systems do at ebar = exp(-33)), down to the second.
EQUATOR_CAPTURE_HEIGHT, UNDERFLOW_HEIGHT = 1e-9, 1e-250
MIN_HEIGHT = 1e-290  # ebar: its reciprocal, |x2|, is finite


ON_THE_WAY = np.linspace(0.0, 1.0, 17)  # where lambda_rho is looked at between a direction and the next equilibrium


@dataclass(frozen=True)
class EquatorPull:
    """The first-order return map just above the equator.

    There theta turns as on the equator, and ``ebar' = -lambda_rho ebar`` (3.26): an orbit comes to the next
    equilibrium on its way, which draws it in where lambda_rho > 0; but first ebar grows where lambda_rho < 0. A closed
    equator draws none in within a turn, however strong.
    """

    theta: Array  # (k,) Equilibria on the equator, increasing
    # (ndarray, ndarray) Which of them attract from the hemisphere, or may: forward, and backward in time
    draws: tuple[NDArray[np.bool_], NDArray[np.bool_]]
    everywhere: bool  # each direction is an equilibrium, or an arc of them

    def may_return(self, states: Array, field: Callable[[Array], Array], backward: bool) -> NDArray[np.bool_]:
        """Say which orbits of states (n, 3) do not, or may not, come down to the equator for good."""
        draws, sign = self.draws[backward], -1.0 if backward else 1.0
        if self.everywhere or not draws.any():
            return np.full(len(states), not self.everywhere)
        theta = np.arctan2(states[:, 1], states[:, 0]) % math.tau
        U = sign * field(states[:, :2])
        onward = states[:, 0] * U[:, 1] > states[:, 1] * U[:, 0]
        ahead = np.searchsorted(self.theta, theta)
        end = np.where(onward, ahead, ahead - 1) % len(draws)
        way = np.where(onward, (self.theta[end] - theta) % math.tau, -((theta - self.theta[end]) % math.tau))
        passed = theta[:, None] + way[:, None] * ON_THE_WAY
        e = np.stack([np.cos(passed), np.sin(passed)], axis=-1)
        radial = sign * (e * field(e.reshape(-1, 2)).reshape(e.shape)).sum(axis=-1)
        return ~draws[end] | (radial < 0.0).any(axis=1)


def equator_pull(at: FrozenSystem, location: Location | None) -> EquatorPull:
    """Return the pull of the equator of a frozen system; `location` as in `equilibria_at`."""
    equator = equilibria_at(at, location)
    radial, turning = equator.lambda_rho, equator.lambda_theta
    draws = (radial >= 0.0) & (turning <= 0.0), (radial <= 0.0) & (turning >= 0.0)
    return EquatorPull(equator.theta, draws, equator.all_directions or len(equator.arcs) > 0)


#: Ebar, and distance from the foot, below which a crossing is the worse the nearer it is to an end of the ray.
FREE_HEIGHT, FREE_DISTANCE = 0.05, 1e-4
CROSSING_SLACK = 0.05  # of a turn: what lies so shortly before a crossing is judged by its angle alone


def best_crossing(points: Array, foot: HemispherePoint) -> tuple[float, int]:
    """Find where a cycle crosses a ray from a point best: how well, and at which of its points.

    An orbit from there turns by 2 pi about the point just when it is back, and not sooner, if no earlier point of the
    cycle is as far round. It crosses well if that is so by far, if it crosses at a large angle, far from both ends.

    quality: Negative if the cycle does not go round the point once. Shapes: points (m, 2).
    """
    quality = crossing_qualities(points, foot)
    best = int(quality.argmax())
    return float(quality[best]), best


def crossing_qualities(points: Array, foot: HemispherePoint) -> Array:
    """Return how well (m - 1,) a cycle (m, 2) crosses the ray from a point through each of its points."""
    away = points - foot.p
    angle = np.unwrap(np.arctan2(away[:, 1], away[:, 0]))
    turned = angle[-1] - angle[0]
    if abs(abs(turned) - 2.0 * math.pi) > 0.1:
        return np.full(len(points) - 1, -1.0)
    sense, count = math.copysign(1.0, turned), len(points) - 1
    angle = sense * angle[:-1]
    along = np.roll(points[:-1], -1, axis=0) - np.roll(points[:-1], 1, axis=0)
    sine = sense * (away[:-1, 0] * along[:, 1] - away[:-1, 1] * along[:, 0])
    sine = sine / np.maximum(np.hypot(*away[:-1].T) * np.hypot(*along.T), 1e-300)
    twice = np.concatenate([angle - 2.0 * math.pi, angle])  # the turn before, and this one
    highest = np.maximum.accumulate(twice)
    recent = max(1, int(CROSSING_SLACK * count))
    lead = angle - highest[count - recent : 2 * count - recent]
    height = np.sqrt(np.maximum(1.0 - (points[:-1] ** 2).sum(axis=1), 0.0))
    free = np.minimum(np.minimum(height / FREE_HEIGHT, np.hypot(*away[:-1].T) / FREE_DISTANCE), 1.0)
    return np.where(angle >= highest[count:], np.minimum(sine, lead) * free, -1.0)


COARSE_RTOL, FINE_RTOL = 1e-9, 1e-13  # tolerances
#: Of the reach; ebar of the last sample; of samples in ln(r/(reach - r)).
INNER_RADIUS, OUTER_HEIGHT, SAMPLE_SPACING = 1e-4, 1e-5, 0.2
MAX_STEPS, MAX_TURN_TIME = 2000, 1e6  # steps tried, and T in units of 1/max |U|
INNER_CAPTURE_RATIO = 1e-3  # of the innermost sample: gone
AT_REST = 1e-4  # distance from a critical set, or ebar, at which an orbit that never turned has settled
NOISE = 10.0  # times the tolerance: error in p of a turn
RAY_DIRECTIONS = 16


@dataclass(frozen=True)
class FixedPoint:
    """A fixed point of the map of first turns: its parameter, and how the displacement meets zero there.

    `born`: just born in a Hopf bifurcation, too small for the sampled map and placed by its expansion at C.
    """

    xi: float
    repelling: bool = False
    touching: bool = False
    born: bool = False


def room(foot: HemispherePoint | CriticalSet, u: Array) -> tuple[float, float]:
    """Return reach and other of a ray: ``|p + r u|^2 - 1 = (r - reach)(r + other)``."""
    along, gap = float(u @ foot.p), 1.0 / (1.0 + float(foot.x2 @ foot.x2))  # 1 - |p|^2, to all digits
    root = math.sqrt(along * along + gap)
    reach = gap / (root + along) if along > 0.0 else root - along
    return reach, gap / reach


@dataclass(frozen=True)
class HemispherePoint:
    """A point of the hemisphere: in the projected disc, and x2."""

    p: Array
    x2: Array


class TurnSection:
    """A ray from a critical set to the equator, and the map of first turns on it."""

    def __init__(self, problem: LayerProblem, critical: CriticalSet) -> None:
        self.problem, self.at, self.psi, self.critical = problem, problem.at, problem.psi, critical
        self.rate = problem.at.speed
        self._rests = np.array([C.p for C in problem.critical])
        self.u = self._direction([C.p - critical.p for C in problem.critical if C is not critical])
        self.reach, self.other = room(critical, self.u)

    def _direction(self, away: list[Array]) -> Array:
        """Choose the ray that keeps farthest from other critical sets; of equal ones the longest."""
        angle = 2.0 * math.pi * (np.arange(RAY_DIRECTIONS) + 0.25) / RAY_DIRECTIONS
        u = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        free = np.full(RAY_DIRECTIONS, 2.0)
        for d in away:
            part = np.maximum(u @ d, 0.0)
            free = np.minimum(free, np.hypot(*(d - part[:, None] * u).T))
        reach = np.array([room(self.critical, way)[0] for way in u])
        end = self.critical.p + reach[:, None] * u
        # cycles next to a loop through the equator lie so low there that samples on a ray would not show them
        theta = np.arctan2(end[:, 1], end[:, 0])
        hidden = np.any([arc.spans(theta) for arc in heteroclinic_arcs(self.problem)], axis=0)
        return u[np.lexsort((reach, free, ~hidden & np.ones(len(u), bool)))[-1]]

    @cached_property
    def kernel(self) -> Any:
        """The compiled first turn: its module, and what its compiled field keeps alive."""
        from ..stepping import right_hand_side
        from . import ray_section_kernel

        return ray_section_kernel, right_hand_side.problem(self.at, self.psi)

    @cached_property
    def pull(self) -> EquatorPull:
        """Return the first-order return map of orbits close to the equator."""
        return equator_pull(self.at, self.problem.location)

    def field_parameters(self, backward: bool) -> Array:
        """Parameters of the compiled field that `kernel` keeps alive."""
        _, kept = self.kernel
        return np.array(kept.reversed.shared if backward else kept.shared)

    def field(self, e: Array) -> Array:
        """U (n, 2) in units of `rate`."""
        return self.at.U(e) / self.rate

    def derivative(self, e: Array) -> Array:
        """D_e U (n, 2, 2) in units of `rate`."""
        return self.at.DU(e) / self.rate

    def states(self, xi: Array) -> tuple[Array, Array]:
        """States (n, 3) = (p_x, p_y, ebar) and q = xi (n,), at ``r = reach/(1 + exp(-xi))``."""
        inner, rest = self.reach / (1.0 + np.exp(-xi)), self.reach / (1.0 + np.exp(xi))
        height = np.sqrt(rest * (inner + self.other))
        return np.column_stack([self.critical.p + inner[:, None] * self.u, height]), np.array(xi, float)

    def coordinate(self, states: Array) -> Array:
        """``q = ln(r/(reach - r))``, (n,)."""
        r = np.maximum((states[:, :2] - self.critical.p) @ self.u, 1e-300)
        return np.log(r) - np.log(np.maximum(states[:, 2] ** 2 / (r + self.other), 1e-300))

    def turn(
        self,
        states: Array,
        rtol: float,
        backward: bool = False,
        record: int = 0,
        limit: int = MAX_STEPS,
        goal: Array | None = None,
        sense: int = 0,
    ) -> tuple[Array, Array, Any, Any]:
        """Follow one turn: ends (n, 3), times, codes and recorded steps of `ray_section_kernel.first_turns`.

        Or less than a turn: by the angles `goal` (n,), in one sense.
        """
        module, function = self.kernel
        states = np.ascontiguousarray(states)
        away = float(np.hypot(*(states[:, :2] - self.critical.p).T).min(initial=math.inf))
        floor = INNER_CAPTURE_RATIO * min(INNER_RADIUS * self.reach, away)

        def follow(rows: Any, sunk: float) -> tuple[Array, Array, Any, Any]:
            return module.first_turns(
                states[rows],
                self.field_parameters(backward),
                function.address,
                np.array(self.critical.p),
                np.full(len(states), math.tau)[rows] if goal is None else goal[rows],
                sense,
                floor,
                sunk,
                MAX_TURN_TIME,
                rtol,
                limit,
                record,
            )

        lost = min(
            EQUATOR_CAPTURE_HEIGHT,
            max(UNDERFLOW_HEIGHT, MIN_HEIGHT / max(MIN_HEIGHT, float(states[:, 2].min(initial=1.0)))),
        )
        if record:
            return follow(slice(None), lost)
        ends, times, codes, steps = follow(slice(None), EQUATOR_CAPTURE_HEIGHT)
        close = np.flatnonzero(codes == module.OUTWARD)
        if len(close):  # those that the equator may not draw in are followed on, however close they come to it
            again = close[self.pull.may_return(ends[close], self.field, backward)]
            if len(again):
                ends[again], times[again], codes[again], _ = follow(again, lost)
        return ends, times, codes, steps

    def displacement(self, xi: Array, rtol: float = COARSE_RTOL, backward: bool = False, noise: float = NOISE) -> Array:
        """Displacement of q over a turn (n,): -inf to the critical set, +inf elsewhere, NaN undecided.

        It is 0 where it is within `noise` times what the tolerance leaves open.
        """
        module, _ = self.kernel
        states, q = self.states(xi)
        ends, _, codes, _ = self.turn(states, rtol, backward)
        shift = self.coordinate(ends) - q
        gaps = np.hypot(*(ends[:, None, :2] - self._rests[None]).T).T
        inward = (codes == module.TO_CRITICAL_SET) | (np.hypot(*(ends[:, :2] - self.critical.p).T) < AT_REST)
        settled = (gaps.min(axis=1) < AT_REST) | (ends[:, 2] < AT_REST) | (codes == module.OUTWARD)
        # What the tolerance cannot tell from zero is zero: in a band of closed orbits noise has both signs.
        shift[np.abs(shift) < noise * rtol * (1.0 + (1.0 + np.exp(-q)) / self.reach)] = 0.0
        open_ = codes != module.RETURNED
        shift[open_ & settled] = np.inf
        shift[open_ & inward] = -np.inf
        shift[open_ & ~settled & ~inward] = np.nan
        return shift

    def grid(self) -> Array:
        """Choose samples: even in ln(r/(reach - r))."""
        last = math.log(self.reach * (self.reach + self.other)) - 2.0 * math.log(OUTER_HEIGHT)
        first = math.log(INNER_RADIUS)
        return np.linspace(first, last, int((last - first) / SAMPLE_SPACING))


class Ray(TurnSection):
    """The ray from a point in a given direction, with the map of first turns on it."""

    def __init__(self, problem: LayerProblem, foot: HemispherePoint, u: Array) -> None:
        self.problem, self.at, self.psi, self.critical, self.u = problem, problem.at, problem.psi, foot, u
        self.rate = problem.at.speed
        self.reach, self.other = room(foot, u)
