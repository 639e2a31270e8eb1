"""Locate a phase of a motion: its e, and its p in the projected disc, at any time; and its origin.

Regularised, both are those of the state. In the limit eps -> 0 they are those of the set that is followed, and what
happens in no time, the orbit of the layer problem up the hemisphere (Figure 7), is kept as a path.

A regularised motion follows a critical set (Section 3.2, Theorem 3.3): it slides where it lies on a slow manifold, and
that is O(eps) away from the critical set: in the chart kappa_2, where ``eps x2' = U(e_Psi(x2), eps x2, z)`` up to the
time, it is ``x2 = X(z) + eps X1(z) + O(eps^2)`` with ``J X1 = D_z X W - U_x X``. A state within twice that of a
critical set, in p, follows it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ..numerics.dense import Dense
from ..portrait.cycles.limit_cycles import limit_cycles
from ..portrait.layer_problem.equator import equator_equilibria
from ..portrait.orbits.trajectories import continuation, trajectories
from ..results.arrays import Array
from ..systems.kinds import AnySystem
from ..systems.psi.function import Psi
from .initial_value.field import Field, field
from .initial_value.slow_manifold import solve_critical

MANIFOLD_MARGIN = 2.0  # times the first-order distance of the slow manifold
FLOOR = 1e-3  # in p: added for an orbit that runs into the set
MAX_DISTANCE = 0.25  # in p: near a fold, and near the equator, the expansion promises nothing


@dataclass(frozen=True)
class TrackedSet:
    """The critical set that a state follows."""

    e: Array  # (2,)
    p: Array  # (2,) Its place in the projected disc
    attracts: bool  # whether it attracts in the layer problem
    rate: float  # largest modulus of its eigenvalues, in the fast time of kappa_2
    growth: float  # largest real part of them


def in_disc(psi: Psi, e: Array) -> Array:
    """Point (2,) of the projected disc at which e_Psi = e, |e| <= 1."""
    modulus = math.hypot(e[0], e[1])
    if modulus == 0.0:
        return np.zeros(2)
    if modulus >= 1.0:
        return e / modulus
    zeta = float(psi.radius(modulus))
    return e / modulus * (zeta / math.hypot(1.0, zeta))


def place_on_hemisphere(psi: Psi, eps: float, x: float, y: float) -> tuple[Array, Array]:
    """Return (e, p) of a state of the regularised system, each of shape (2,): ``p = (x, y)/rho``."""
    r, rho = math.hypot(x, y), math.hypot(x, y, eps)
    p = np.array([x, y]) / rho
    return (p * (float(psi.modulus(r / eps)) * rho / r) if r > 0.0 else np.zeros(2)), p


def inverse_gain(psi: Psi, e: Array) -> tuple[float, Array, Array]:
    """Return |x2| where e_Psi(x2) = e, its direction, and D e_Psi there."""
    modulus = math.hypot(e[0], e[1])
    zeta = float(psi.radius(modulus))
    n = e / modulus if modulus > 0.0 else np.array([1.0, 0.0])
    radial, tangential = psi.jacobian_factors(zeta)
    return zeta, n, tangential * np.eye(2) + (radial - tangential) * np.outer(n, n)


def jacobian(field: Field, psi: Psi, e: Array, z: Array) -> Array:
    """Return J (2, 2) of the layer problem in kappa_2 at the critical set e."""
    D = field.jacobian(float(e[0]), float(e[1]), 0.0, 0.0, z.tolist())
    return D[:2, :2] @ inverse_gain(psi, e)[2]


def followed_critical_set(field: Field, psi: Psi, eps: float, state: Array) -> TrackedSet | None:
    """Return the critical set within O(eps) of which a state (2 + m,) lies, in p; None if there is none."""
    z = state[2:]
    own_e, own_p = place_on_hemisphere(psi, eps, float(state[0]), float(state[1]))
    e = solve_critical(field, own_e, z)
    if e is None or not math.hypot(e[0], e[1]) < 1.0:
        return None
    p = in_disc(psi, e)
    distance = float(np.hypot(*(own_p - p)))
    if not distance <= MAX_DISTANCE:
        return None
    zeta, n, De = inverse_gain(psi, e)
    along = np.outer(n, n)
    D = field.jacobian(float(e[0]), float(e[1]), 0.0, 0.0, z.tolist())
    J = D[:2, :2] @ De
    trace, determinant = float(np.trace(J)), float(np.linalg.det(J))
    split = 0.25 * trace * trace - determinant  # eigenvalues: trace/2 +- sqrt(split)
    rate = 0.5 * abs(trace) + math.sqrt(split) if split >= 0.0 else math.sqrt(determinant)
    if distance > FLOOR:
        with np.errstate(all="ignore"):
            try:
                W = np.array(field.value(float(e[0]), float(e[1]), 0.0, 0.0, *z.tolist())[2:])
                moved = np.linalg.solve(D[:2, :2] @ De, -(D[:2, 4:] @ W))  # D_z X W
                X1 = np.linalg.solve(J, moved - D[:2, 2:4] @ (zeta * n))
            except np.linalg.LinAlgError:
                return None
        height = 1.0 / math.hypot(1.0, zeta)
        change = height * X1 + (height**3 - height) * (along @ X1)
        if not distance <= FLOOR + MANIFOLD_MARGIN * eps * math.hypot(change[0], change[1]):
            return None
    return TrackedSet(e, p, determinant > 0.0 and trace < 0.0, rate, 0.5 * trace + math.sqrt(max(split, 0.0)))


FASTEST, MAX_ASCENT_LENGTH = 60.0, 4.0  # time T and length for which an orbit up the hemisphere is followed
ASCENT_START = 0.9995  # |p| from which an orbit is followed that leaves the closed equator
NO_POINTS = np.zeros((0, 2))
NO_POINTS.flags.writeable = False


class Location(Protocol):
    """The location of a phase."""

    def at(self, t: Array) -> tuple[Array, Array]:
        """Return e and p, each (k, 2), at times (k,)."""
        ...


@dataclass(frozen=True, eq=False)
class OfState:
    """The place that the state itself says."""

    motion: Dense
    psi: Psi | None  # none for the limit eps = 0
    eps: float  # not read in the limit
    t_start: float  # of the phase
    t_end: float

    def at(self, t: Array) -> tuple[Array, Array]:
        """Return e and p."""
        xy = self.motion(t)[:, :2]
        if self.psi is not None:
            r = np.hypot(*xy.T)
            p = xy / np.hypot(r, self.eps)[:, None]
            zeta = r / self.eps
            modulus = self.psi.modulus(zeta)
            gain = np.divide(modulus, r, out=np.zeros_like(r), where=r > 0.0)
            return xy * gain[:, None], p
        for i in np.flatnonzero(~xy.any(axis=1)):  # at the moment of arrival, or of leaving
            xy[i] = self.position_near(float(t[i]))
        size = np.hypot(*xy.T)
        e = np.divide(xy, size[:, None], out=np.zeros_like(xy), where=size[:, None] > 0.0)
        return e, e

    def position_near(self, t: float) -> Array:
        """Return (x, y) within the phase, a moment after or before a time at which it is 0."""
        times, states = self.motion.times, self.motion.states
        off = np.flatnonzero(states[:, :2].any(axis=1) & (self.t_start <= times) & (times <= self.t_end))
        if len(off):
            return states[off[np.argmin(np.abs(times[off] - t))], :2].copy()
        return self.motion(0.5 * (self.t_start + self.t_end))[:2]


@dataclass(frozen=True, eq=False)
class OnSet:
    """On a critical set that was followed in z."""

    system: AnySystem
    psi: Psi
    motion: Dense
    times: Array  # (k,) Increasing; where e is known
    e: Array  # (k, 2)

    def at(self, t: Array) -> tuple[Array, Array]:
        """Return e and p."""
        formulas, z = field(self.system), self.motion(t)[:, 2:]
        reach = max(1.0, float(np.hypot(*self.e.T).max(initial=0.0)))  # above 1 at rest by static friction
        found = np.stack([np.interp(t, self.times, column) for column in self.e.T], axis=-1)
        for i, guess in enumerate(found):
            e = solve_critical(formulas, guess, z[i])
            if e is not None and math.hypot(e[0], e[1]) <= reach:
                found[i] = e
        return found, np.array([in_disc(self.psi, e) for e in found]).reshape(-1, 2)


@dataclass(frozen=True, eq=False)
class OnCycle:
    """On a limit cycle of the layer problem: the means of e and of p over it."""

    times: Array  # (k,)
    e: Array  # (k, 2)
    p: Array

    def at(self, t: Array) -> tuple[Array, Array]:
        """Return e and p."""
        means = [np.stack([np.interp(t, self.times, column) for column in of.T], axis=-1) for of in (self.e, self.p)]
        return means[0], means[1]


@dataclass(frozen=True)
class Leaving:
    """A crossing, which takes no time: where it leaves Sigma."""

    theta: float

    def at(self, t: Array) -> tuple[Array, Array]:
        """Return e and p."""
        e = np.tile([math.cos(self.theta), math.sin(self.theta)], (len(t), 1))
        return e, e.copy()


@dataclass(frozen=True, eq=False)
class Ascent:
    """The orbit of the layer problem that a phase begins with, in no time."""

    system: AnySystem
    psi: Psi
    z: Array  # (m,)
    theta: float | None = None  # angle of arrival; None where it begins at `start`
    start: Array | None = None  # (2,) In the projected disc
    # (2,) The ends of a way along an invariant line, which needs no integration
    along: tuple[Array, Array] | None = None

    def path(self, onto: str | None = None) -> Array:
        """Points (k, 2) in the projected disc, with one turn of a cycle onto which it leads; none if none leave."""
        up = self._orbit()
        if not len(up) or onto is None or not onto.startswith("cycle"):
            return up
        k = int(onto.split()[1]) - 1
        cycles = limit_cycles(self.system, self.psi, tuple(self.z.tolist()))
        if not k < len(cycles):
            return up
        turn = cycles[k].points[:-1]
        nearest = int(np.argmin(np.hypot(*(turn - up[-1]).T)))
        return np.concatenate([up, np.roll(turn, -nearest, axis=0), turn[nearest : nearest + 1]])

    def _orbit(self) -> Array:
        if self.along is not None:
            return np.stack(self.along)
        try:
            if self.start is None:
                assert self.theta is not None
                limits = equator_equilibria(self.system, self.z).theta
                if len(limits):
                    theta = min(limits, key=lambda limit: abs(math.remainder(limit - self.theta, math.tau)))
                    up = continuation(self.system, self.psi, [theta], self.z, t_max=FASTEST, length=MAX_ASCENT_LENGTH)
                    return up.points[0]
                start = ASCENT_START * np.array([math.cos(self.theta), math.sin(self.theta)])
            else:
                start = self.start
            seeds = start[None]
            return trajectories(self.system, self.psi, seeds, self.z, t_max=FASTEST, length=MAX_ASCENT_LENGTH).points[0]
        except ValueError:  # a start that nothing leaves
            return NO_POINTS
