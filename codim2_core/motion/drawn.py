"""A motion as a curve of the picture."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..numerics.dense import Dense

Array = NDArray[np.float64]

SAMPLES, MOST = 240, 500  # even times of a drawn motion besides the ends of its steps, and its most points
ASCENT = 3  # every so many points of an orbit up the hemisphere are drawn


@dataclass(frozen=True, eq=False)
class Drawn:
    """A motion as a curve of the picture; arrays are read-only.

    Attributes
    ----------
    times : ndarray (k,)
        Not decreasing: what takes no time in the limit has several points at one time.
    states : ndarray (k, 2 + m)
    points : ndarray (k, 2)
        (1 + r) e outside in the limit, (1 + rho) p for eps > 0; p on the hemisphere.
    """

    times: Array
    states: Array
    points: Array


def drawn(motion: Dense, phases: Sequence[Any], eps: float) -> Drawn:
    """Return a motion as a curve, as `Simulation.drawn` does.

    Parameters
    ----------
    motion : Dense
    phases : sequence of Phase
        All of them, in order.
    eps : float
    """
    times = motion.times
    if len(times) > 1 and times[-1] > times[0]:
        times = np.union1d(np.linspace(times[0], times[-1], SAMPLES), times)
        if len(times) > MOST:
            times = times[np.unique(np.rint(np.linspace(0, len(times) - 1, MOST)).astype(int))]
    states = motion(times)
    points = states[:, :2].copy()
    pieces: list[tuple[Array, Array, Array]] = []
    done = 0
    for k, phase in enumerate(phases):
        last = k + 1 == len(phases)
        end = len(times) if last else int(np.searchsorted(times, phases[k + 1].t_start, side="left"))
        up = phase.ascent[::ASCENT]
        state = motion(np.full(len(up), phase.t_start))
        pieces.append((np.full(len(up), phase.t_start), state, up))
        if end > done:
            p = phase.p(np.clip(times[done:end], phase.t_start, phase.t_end))
            rho = np.hypot(np.hypot(states[done:end, 0], states[done:end, 1]), eps)
            points[done:end] = p * (1.0 + rho)[:, None]
            pieces.append((times[done:end], states[done:end], points[done:end]))
            done = end
    if not pieces:
        pieces.append((times, states, points))
    return Drawn(*(np.concatenate(column) for column in zip(*pieces, strict=True)))
