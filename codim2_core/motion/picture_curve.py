"""A motion as a curve of the picture."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..numerics.dense import Dense
from ..results.arrays import Array

MIN_TIMES = 240  # even times of a drawn motion, at least
CHORD_TOLERANCE = (
    0.002  # radii of the equator, outside of the distance from Sigma: how far a chord may be from the curve
)
MAX_POINTS = 8000  # points, beyond which chords may be further from it
MAX_HALVINGS, THINNINGS = 8, 5


@dataclass(frozen=True, eq=False)
class Drawn:
    """A motion as a curve of the picture; arrays are read-only."""

    times: Array  # (k,) Not decreasing: what takes no time in the limit has several points at one time
    states: Array  # (k, 2 + m)
    points: Array  # (k, 2) (1 + r) e outside in the limit, (1 + rho) p for eps > 0; p on the hemisphere


def drawn_curve(motion: Dense, phases: Sequence[Any], eps: float) -> Drawn:
    """Return a motion as a curve, as `Simulation.drawn` does."""
    times = _drawing_times(motion, eps)
    states = motion(times)
    points = states[:, :2].copy()
    pieces: list[tuple[Array, Array, Array]] = []
    done = 0
    for k, phase in enumerate(phases):
        last = k + 1 == len(phases)
        end = len(times) if last else int(np.searchsorted(times, phases[k + 1].t_start, side="left"))
        up = phase.ascent
        up = up[_needed_points(up, CHORD_TOLERANCE)]
        state = motion(np.full(len(up), phase.t_start))
        pieces.append((np.full(len(up), phase.t_start), state, up))
        if end > done:
            p = phase.p(np.clip(times[done:end], phase.t_start, phase.t_end))
            rho = np.hypot(np.hypot(states[done:end, 0], states[done:end, 1]), eps)
            points[done:end] = p * (1.0 + rho)[:, None]
            if eps == 0.0 and len(up) and str(phase.onto).startswith("cycle"):
                points[done:end] = up[-1]  # it stays on the cycle onto which the orbit winds
            pieces.append((times[done:end], states[done:end], points[done:end]))
            done = end
    if not pieces:
        pieces.append((times, states, points))
    return Drawn(*(np.concatenate(column) for column in zip(*pieces, strict=True)))


def _drawing_times(motion: Dense, eps: float) -> Array:
    """Return the times at which a motion is drawn: even ones, and those that chords need to look like the curve."""
    first, last = float(motion.times[0]), float(motion.times[-1])
    if not last > first:
        return motion.times

    def state_at(t: Array) -> Array:
        xy = motion(t)[:, :2]
        rho = np.hypot(np.hypot(xy[:, 0], xy[:, 1]), eps)[:, None]
        return xy * np.divide(1.0 + rho, rho, out=np.zeros_like(rho), where=rho > 0.0)

    even = np.linspace(first, last, MIN_TIMES)
    times = np.union1d(even, motion.times)
    for _ in range(MAX_HALVINGS):
        middle = 0.5 * (times[:-1] + times[1:])
        points = state_at(times)
        bent = _off(state_at(middle), points[:-1], points[1:]) > CHORD_TOLERANCE
        times = np.union1d(times, middle[bent])
        if not bent.any() or len(times) > 4 * MAX_POINTS:
            break
    points, eye = state_at(times), CHORD_TOLERANCE
    while True:
        kept = _needed_points(points, eye) | np.isin(times, even)
        if kept.sum() <= MAX_POINTS or eye > 1.0:
            return times[kept]
        eye *= 2.0


def _needed_points(points: Array, eye: float) -> NDArray[np.bool_]:
    """Mark the points of a curve without which chords would be further from it than the eye may see."""
    kept = np.arange(len(points))
    for _ in range(THINNINGS):
        here = kept[1:-1:2]
        if not len(here):
            break
        off = _off(points[here], points[kept[:-2:2]], points[kept[2::2]])
        kept = np.setdiff1d(kept, here[off <= eye / THINNINGS], assume_unique=True)
    mask = np.zeros(len(points), bool)
    mask[kept] = True
    return mask


def _off(points: Array, start: Array, end: Array) -> Array:
    """Distance of points from chords, in units of what is seen as a radius there."""
    chord = end - start
    share = ((points - start) * chord).sum(axis=1) / np.maximum((chord**2).sum(axis=1), 1e-300)
    away = points - start - np.clip(share, 0.0, 1.0)[:, None] * chord
    return np.hypot(away[:, 0], away[:, 1]) / np.maximum(1.0, np.hypot(points[:, 0], points[:, 1]))
