"""One orbit over time: fast time tau = t/eps in the layer problem on the hemisphere, t outside."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...results.arrays import Array
from ...results.result import ByValue
from ...systems.kinds import AnySystem, FrozenSystem
from ...systems.psi.function import Psi
from ..layer_problem.hemisphere import disc_from_scaling, e_psi, outside_flow, scaling_from_disc
from .seeds import checked_seeds

LEAST_RADIUS = 1e-6  # of the picture: nearer to its middle a motion followed to 1e-7 is its own error


def angle_along(points: Array, least: float) -> Array:
    """Return the angle of each point (k, 2) of a curve, which changes by less than pi from one to the next."""
    known = np.flatnonzero(np.hypot(points[:, 0], points[:, 1]) >= least)
    if not len(known):
        return np.zeros(len(points))
    angle = np.unwrap(np.arctan2(points[known, 1], points[known, 0]))
    return angle[np.maximum(np.searchsorted(known, np.arange(len(points)), side="right") - 1, 0)]


RTOL, ATOL = 1e-7, 1e-9
MAX_RADIUS = (
    10.0  # eps: how far from Sigma an orbit on the hemisphere is followed; it comes from or goes to infinity there …
)
MAX_SEED_FACTOR = 3.0  # … or so many times as far as its seed, where that is farther
STEP_PARTS = np.array([1.0, 2.0, 3.0]) / 3.0  # of each step, so that a curve drawn through them is smooth
MAX_HALF_STEPS = 400  # of each half
MAX_HALF_POINTS = 300  # points of each half


@dataclass(frozen=True, eq=False)
class InTime(ByValue):
    """An orbit over time; arrays are read-only and run with increasing time."""

    # the orbit lies on the hemisphere: times are tau = t/eps and lengths are in eps, (3.26). Outside they are as
    # they are, (2.7) with z frozen
    fast: bool
    time: Array  # (k,) 0 at the seed
    xy: Array  # (k, 2) (x, y)/eps on the hemisphere, (x, y) outside
    theta: Array  # (k,) Angle of (x, y), without jumps by 2 pi
    radius: Array  # (k,) |p| on the hemisphere, rho = |(x, y)| outside
    points: Array  # (k, 2) Of the picture

    def __post_init__(self) -> None:
        for array in (self.time, self.xy, self.theta, self.radius, self.points):
            array.flags.writeable = False

    def __len__(self) -> int:
        return len(self.time)


def in_time(system: AnySystem, psi: Psi, seed: ArrayLike, span: tuple[float, float], z: ArrayLike = ()) -> InTime:
    """Follow one orbit both ways from a seed (2,) over its own time, z (m,) frozen; ValueError on the equator."""
    start = checked_seeds(np.reshape(np.asarray(seed, float), (-1, 2)))[0]
    first, last = map(float, span)
    if not (math.isfinite(first) and math.isfinite(last) and first <= 0.0 <= last):
        raise ValueError(f"span is ({first}, {last}); give finite times T with first <= 0 <= last.")
    radius = math.hypot(*start)
    if radius == 1.0:
        raise ValueError("The seed lies on the equator, where no time t passes; give one on the hemisphere or outside.")
    at = system.at(z)
    half = _on_hemisphere if radius < 1.0 else _outside
    back, ahead = (half(at, psi, start, end) for end in (first, last))
    columns = [np.concatenate([b[:0:-1], a]) for b, a in zip(back, ahead, strict=True)]
    time, points, xy, r = columns
    return InTime(radius < 1.0, time, xy, angle_along(points, LEAST_RADIUS), r, points)


def _on_hemisphere(at: FrozenSystem, psi: Psi, start: Array, end: float) -> tuple[Array, Array, Array, Array]:
    """Follow (x2, tau) over T: dx2 = U dtau, dtau = dT/ebar, ebar = 1/sqrt(1 + |x2|^2), (3.26) in kappa_2.

    Not p, of which x2 = p/ebar is taken: an error of p in its own direction is 1/ebar^3 times as large in x2, a
    thousand times at 10 eps.
    """
    x2 = scaling_from_disc(start)
    far = max(MAX_RADIUS, MAX_SEED_FACTOR * math.hypot(*x2))

    def rate(_: float, y: Array) -> Array:
        faster = math.hypot(1.0, y[0], y[1])
        return np.append(faster * at.U(e_psi(psi, disc_from_scaling(y[:2]))), faster)

    y = _integrate_over_time(rate, np.append(x2, 0.0), end, lambda y: math.hypot(y[0], y[1]) > far)
    left = np.flatnonzero(np.hypot(y[:, 0], y[:, 1]) > far)
    y = y[: left[0] if len(left) else None]
    p = disc_from_scaling(y[:, :2])
    return y[:, 2], p, y[:, :2], np.hypot(p[:, 0], p[:, 1])


def _outside(at: FrozenSystem, _: Psi, start: Array, end: float) -> tuple[Array, Array, Array, Array]:
    """Follow (log rho, theta, t) over T: dt = rho dT."""

    def rate(_: float, y: Array) -> Array:
        radial, turning = outside_flow(at, y[1])
        return np.array([radial, turning, math.exp(min(y[0], 700.0))])

    r = math.hypot(*start)
    y = _integrate_over_time(rate, np.array([math.log(r - 1.0), math.atan2(start[1], start[0]), 0.0]), end)
    rho, e = np.exp(y[:, 0]), np.stack([np.cos(y[:, 1]), np.sin(y[:, 1])], axis=-1)
    return y[:, 2], (1.0 + rho)[:, None] * e, rho[:, None] * e, rho


def _nowhere(_: Array) -> bool:
    return False


def _integrate_over_time(
    rate: Callable[[float, Array], Array], start: Array, end: float, left: Callable[[Array], bool] = _nowhere
) -> Array:
    """Return the states from T = 0 to `end`, in `MAX_HALF_STEPS` steps at most, or until one has `left`: (k, n)."""
    from scipy.integrate import LSODA  # imported late: it takes longer than all of this package

    found = [start[None]]
    solver = LSODA(rate, 0.0, start, end, rtol=RTOL, atol=ATOL)
    while end and solver.status == "running" and len(found) <= MAX_HALF_STEPS and not left(solver.y):
        before = solver.t
        solver.step()
        found.append(solver.dense_output()(before + (solver.t - before) * STEP_PARTS).T)
    states = np.concatenate(found)
    return states[np.unique(np.rint(np.linspace(0, len(states) - 1, MAX_HALF_POINTS)).astype(int))]
