"""Starts of orbits: the seeds of drawn trajectories, and limit directions.

Seeds are fixed places, so that a seed keeps its identity while a slider moves. They show the structure of any portrait:
a ring outside, from which every limit direction that attracts is reached, and rings over the disc, evenly spaced. They
are symmetric about both axes, as the normal form is for b = 0 with f on an axis, and no seed lies on an axis, where
such systems have their equilibria.

An orbit leaves a limit direction up the hemisphere (Theorem 3.1(b)) along a local expansion. Write ``p = sqrt(1 -
w^2) (cos theta, sin theta)``, w = ebar. At a limit direction theta_0, Theta = 0, and ``theta' = Theta - w^2 Psi
Theta_e/2 + ...`` with ``Theta_e = (-sin, cos).D_e U (cos, sin)`` (A for D_e U in the e-linear system), ``w' =
-lambda_rho w``. Psi falls like s^-mu as s = 1/w^2 grows (mu = 0 for Psi = 1), so ``theta = theta_0 + k w^2`` with

    k = (Psi/2) Theta_e/(lambda_theta + (2 + 2 mu) lambda_rho),

up to terms of order w^4. At the resonance, where that denominator vanishes, k has a logarithm instead:
``k = (Psi/2) Theta_e ln(w)/lambda_rho``. Where lambda_theta > 0 many orbits leave; this is the smooth one.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...results.arrays import join_columns
from ...systems.frozen import FrozenSystem
from ...systems.psi.function import Psi

HIGHEST = 1e-3  # start no further up than this: 1 - |p| is then 5e-7, well below a pixel
LIMIT = 1e-6  # |Theta| allowed of a limit direction, in units of |U|
RESONANCE = 1e-6


def _tilt(
    lambda_theta: NDArray[np.float64],
    lambda_rho: NDArray[np.float64],
    forcing: NDArray[np.float64],
    mu: float,
    w: float,
) -> NDArray[np.float64]:
    """(theta - theta_0)/w^2, solving ``theta' = lambda_theta theta - forcing w^2`` along ``w' = -lambda_rho w``."""
    gap = lambda_theta + (2.0 + 2.0 * mu) * lambda_rho
    resonant = np.abs(gap) <= RESONANCE * np.abs(lambda_rho)
    return np.where(resonant, forcing * np.log(w) / lambda_rho, forcing / np.where(resonant, 1.0, gap))


def departures(at: FrozenSystem, psi: Psi, theta: ArrayLike, rtol: float, backward: bool) -> NDArray[np.float64]:
    """First states (k, 3), (p_x, p_y, ebar), of the orbits that leave limit directions (k,)."""
    try:
        angle = np.array(theta, float).reshape(-1)
    except (TypeError, ValueError) as error:
        raise ValueError(f"theta is {theta!r}; give limit directions in radians, shape (k,).") from error
    if not np.isfinite(angle).all():
        raise ValueError(f"theta is {theta!r}; every limit direction must be a finite angle in radians.")
    size = at.speed
    e = join_columns(np.cos(angle), np.sin(angle))
    across = join_columns(-e[:, 1], e[:, 0])
    U, DU = at.U(e) / size, at.DU(e) / size
    Theta, lambda_rho = (across * U).sum(axis=-1), (e * U).sum(axis=-1)
    tilting = np.einsum("ki,kij,kj->k", across, DU, e)
    lambda_theta = np.einsum("ki,kij,kj->k", across, DU, across) - lambda_rho
    for i in (np.abs(Theta) > LIMIT).nonzero()[0]:
        raise ValueError(
            f"theta[{i}] = {angle[i]} is no limit direction: Theta is {Theta[i] * size:.3g} there, not 0; "
            "take theta from equator_equilibria."
        )
    wrong = lambda_rho <= 0.0 if backward else lambda_rho >= 0.0
    for i in wrong.nonzero()[0]:
        raise ValueError(
            f"theta[{i}] = {angle[i]} has lambda_rho = {lambda_rho[i] * size:.3g}; a trajectory continues up the "
            f"hemisphere {'backward where lambda_rho > 0' if backward else 'where lambda_rho < 0'} only."
        )
    w = min(HIGHEST, (0.1 * rtol) ** 0.25)
    far, r = 1.0 / (w * w), math.sqrt((1.0 - w) * (1.0 + w))
    value = psi(far)
    mu = max(-far * psi.derivative(far) / value, 0.0) if value > 0.0 else 0.0
    turned = angle + w * w * _tilt(lambda_theta, lambda_rho, 0.5 * value * tilting, mu, w)
    return join_columns(r * np.cos(turned), r * np.sin(turned), np.full_like(turned, w))


PIXEL = 1.0 / 180.0
LEAST_PIXEL = 1e-10  # a line within a quarter of it has some 1e5 points
DEFAULT_MAX_STEPS = 10_000


@dataclass(frozen=True)
class Stepping:
    """Options of `trajectories` and `continuation`, which say what each means."""

    t_max: float = 8.0
    rtol: float = 1e-6
    atol: float = 1e-8
    backward: bool = False
    view: float = 2.0
    pixel: float = PIXEL
    capture: float | None = None
    samples: Literal["ends"] | None = None
    length: float = math.inf
    step_limit: int = DEFAULT_MAX_STEPS
    stiff: bool = False

    def __post_init__(self) -> None:
        _check_positive(self.t_max, "t_max", "give a finite positive time; backward=True follows trajectories backward")
        _check_positive(self.rtol, "rtol", "give a relative tolerance from 1e-14 to 0.1", 1e-14, 0.1)
        _check_positive(self.atol, "atol", "give an absolute tolerance from 1e-15 to 0.1", 1e-15, 0.1)
        _check_positive(self.view, "view", "give the finite half-width of the view, greater than 1 (the equator)", 1.0)
        _check_positive(
            self.pixel, "pixel", "give the size of a pixel in picture units, from 1e-10 to 1", LEAST_PIXEL, 1.0
        )
        if self.capture is not None:
            _check_positive(self.capture, "capture", "give a distance from an attractor, up to 0.1; or None", high=0.1)
        if not self.length > 0.0:
            raise ValueError(f"length is {self.length!r}; give a positive length in picture units, or leave it out.")
        if self.samples not in (None, "ends"):
            raise ValueError(f'samples is {self.samples!r}; give None for drawn lines or "ends" for the two ends.')
        if not 1 <= int(self.step_limit) <= 10**9:
            raise ValueError(f"step_limit is {self.step_limit!r}; give a number of steps from 1 to 1e9.")

    @property
    def reach(self) -> float:
        """Distance from an attracting equilibrium at which a trajectory ends."""
        return min(self.rtol + self.atol, 0.1) if self.capture is None else float(self.capture)


#: The same, made once: those of a picture are the same from frame to frame.
stepping = lru_cache(maxsize=64)(Stepping)


def _check_positive(value: float, what: str, remedy: str, low: float = 0.0, high: float = math.inf) -> None:
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = math.nan
    if not (math.isfinite(number) and low <= number <= high and number > 0.0):
        raise ValueError(f"{what} is {value!r}; {remedy}.")


OUTSIDE_SHARE = 0.375  # of all seeds; outside, orbits are simpler
OUTSIDE_RADIUS = 0.62  # of the way from the equator to the edge of the view
INSIDE_RADIUS = 0.93  # of the outermost ring on the hemisphere


def ring(radius: float, count: int) -> NDArray[np.float64]:
    """`count` points at even angles on a circle about the origin, none on the first axis; (count, 2)."""
    angle = 2.0 * math.pi * (np.arange(count) + 0.5) / max(count, 1)
    return radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def _ring_sizes(count: int) -> list[int]:
    """Points on each ring, outermost first: in proportion to the radii 1, 1 - 1/R, ..., multiples of 4 but one."""
    rings = max(1, round(math.sqrt(count / 4.0)))
    weights = [rings - j for j in range(rings)]
    sizes = [4 * round(count * w / sum(weights) / 4.0) for w in weights]
    sizes[0] += count - sum(sizes)
    return sizes


@lru_cache(maxsize=32)
def structured_seeds(count: int, view: float = 2.0) -> NDArray[np.float64]:
    """`count` starting points of the picture, (count, 2), outside first; the same ones on each call."""
    if not 0 <= count <= 2000:
        raise ValueError(f"the number of trajectories is {count}; give 0 to 2000.")
    outside = round(OUTSIDE_SHARE * count)
    parts = [ring(1.0 + OUTSIDE_RADIUS * (view - 1.0), outside)]
    sizes = _ring_sizes(count - outside)
    parts += [ring(INSIDE_RADIUS * (1.0 - j / len(sizes)), size) for j, size in enumerate(sizes)]
    seeds = np.concatenate(parts)
    seeds.flags.writeable = False
    return seeds


@lru_cache(maxsize=32)
def window_seeds(count: int, window: tuple[float, float, float, float]) -> NDArray[np.float64]:
    """Return about `count` starting points (k, 2) spread evenly over a rectangle, the same ones on each call."""
    left, right, bottom, top = window
    side = math.sqrt((right - left) * (top - bottom) / max(count, 1))
    columns, rows = max(1, round((right - left) / side)), max(1, round((top - bottom) / side))
    i, j = np.divmod(np.arange(columns * rows if count else 0), rows)
    # every other column is shifted by half a cell, so that no line of seeds lies along an orbit for long
    x = left + (right - left) * (i + 0.5) / columns
    y = bottom + (top - bottom) * ((j + 0.25 + 0.5 * (i % 2)) / rows)
    seeds = np.column_stack([x, y])
    seeds.flags.writeable = False
    return seeds


def checked_seeds(seeds: ArrayLike) -> NDArray[np.float64]:
    """Check seeds, a (k, 2) array of finite picture points, and return a read-only copy."""
    try:
        points = np.array(seeds, float)
    except (TypeError, ValueError) as error:
        raise ValueError(f"seeds are {seeds!r}; give points of the picture, an array of shape (k, 2).") from error
    if points.size == 0:
        points = points.reshape(0, 2)
    if points.ndim != 2 or points.shape[1] != 2:
        raise ValueError(
            f"seeds have shape {points.shape}; give points of the picture, shape (k, 2): |p| < 1 on the hemisphere, "
            "|p| = 1 + rho outside."
        )
    if not np.isfinite(points).all():
        bad = np.flatnonzero(~np.isfinite(points).all(axis=1))[0]
        raise ValueError(f"seed {bad} is {tuple(points[bad])}; every seed needs two finite numbers.")
    points.flags.writeable = False
    return points
