"""Trajectories for the eye, while the kernels are compiled: SciPy's, all side by side, thinned and cut to the view."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..arrays import Array
from ..layer_problem.hemisphere import flow, outside_flow
from ..psi.function import Psi
from ..systems.kinds import FrozenSystem

RTOL, ATOL = 1e-5, 1e-5  # where orbits part, errors of 1e-3 on the way become some pixels
MAX_SKETCH_TIME = 16.0  # in units of 1/max |U|: what is slower is seen when the kernels are there
HALF_SAMPLES = 640  # of each half
POINT_SPACING = 0.015  # of the drawn points, in picture units


@dataclass(frozen=True)
class Sketch:
    """Polylines of the picture, running with time.

    Attributes
    ----------
    buffer : ndarray (N, 2), read-only
    offsets : ndarray (k + 1,) of int, read-only
        Line i is ``buffer[offsets[i]:offsets[i + 1]]``.
    """

    buffer: Array
    offsets: NDArray[np.int64]

    def __post_init__(self) -> None:
        self.buffer.flags.writeable = self.offsets.flags.writeable = False

    def __len__(self) -> int:
        return len(self.offsets) - 1


def sketch(at: FrozenSystem, psi: Psi, seeds: Array, t_max: float, length: float, view: float) -> Sketch:
    """Sketch the trajectories through seeds, of eq:LP on the hemisphere or of eq:polar_gen_odes_desing outside.

    Parameters
    ----------
    at : FrozenSystem
    psi : Psi
    seeds : (k, 2)
        Points of the picture, all on the hemisphere (|p| < 1) or all outside.
    t_max : float
        Longest time T of each half.
    length : float
        Of each half, in picture units.
    view : float
        A line ends where |p_x| or |p_y| of its picture point reaches this.

    Returns
    -------
    Sketch
        Within some pixels of the trajectories; `trajectories` are exact to the eye, and say how they end.
    """
    if len(seeds) == 0:
        return Sketch(np.empty((0, 2)), np.zeros(1, np.int64))
    longest = min(t_max, MAX_SKETCH_TIME / (at.size or 1.0))
    halves = [_half(at, psi, seeds, sign * longest, length, view) for sign in (-1.0, 1.0)]
    lines = [np.concatenate([back[:0:-1], ahead]) for back, ahead in zip(*halves, strict=True)]
    return Sketch(np.concatenate(lines), np.cumsum([0] + [len(line) for line in lines]))


def _half(at: FrozenSystem, psi: Psi, seeds: Array, end: float, length: float, view: float) -> list[Array]:
    """Follow all seeds from time 0 to `end`, which may be negative."""
    shape = seeds.shape
    radius = np.hypot(seeds[:, 0], seeds[:, 1])
    outside = bool(radius.min() >= 1.0)
    if outside:  # log(rho) and theta: nothing overflows, and the equator is never passed
        start = np.stack([np.log(np.maximum(radius - 1.0, 1e-300)), np.arctan2(seeds[:, 1], seeds[:, 0])], axis=-1)
    else:
        start = seeds

    def rate(_: float, y: Array) -> Array:
        y = y.reshape(shape)
        if outside:
            return np.stack(outside_flow(at, y[:, 1]), axis=-1).ravel()
        r = np.maximum(np.hypot(y[:, 0], y[:, 1]), 1.0)[:, None]
        return flow(at, psi, y / r).ravel()

    from scipy.integrate import solve_ivp  # imported late: it takes longer than all of this package

    found = solve_ivp(
        rate, (0.0, end), start.ravel(), "RK45", t_eval=np.linspace(0.0, end, HALF_SAMPLES), rtol=RTOL, atol=ATOL
    )
    points = found.y.T.reshape(-1, *shape)
    if outside:
        r = 1.0 + np.exp(np.minimum(points[..., 0], math.log(10.0 * view)))
        points = np.stack([r * np.cos(points[..., 1]), r * np.sin(points[..., 1])], axis=-1)
    return _thin_out(points, length, view)


def _thin_out(points: Array, length: float, view: float) -> list[Array]:
    """Leave out points that are near the one before, and what is beyond the view or the length; (n, k, 2) to lines."""
    steps = np.hypot(*np.moveaxis(np.diff(points, axis=0), -1, 0))
    way = np.concatenate([np.zeros((1, points.shape[1])), np.cumsum(steps, axis=0)])
    seen = np.logical_and.accumulate((np.abs(points).max(axis=-1) <= view) & (way <= length), axis=0)
    seen[0] = True
    places = np.floor(way / POINT_SPACING)
    kept = seen & np.concatenate([np.ones((1, points.shape[1]), bool), np.diff(places, axis=0) > 0.0])
    return [points[kept[:, i], i] for i in range(points.shape[1])]
