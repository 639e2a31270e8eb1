"""Whole orbits through seeds: a half followed back in time and a half followed forward, as one polyline."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ...results.arrays import Array
from ...results.result import ByValue
from ...systems.frozen import FrozenSystem
from ..layer_problem.critical import CriticalSet
from ..layer_problem.equator import EquatorEquilibria
from .result import Status, Trajectories

MIN_DURATION = 40.0  # over the size of U: what is drawn in any case
MAX_DURATION = 1e9  # and at most: rates 1e-8 of the largest are 0 to differences (`stepping.events`)
ARRIVAL = 10.0  # over the slowest rate: e^-10 of the way is left, a hundredth of a pixel
STIFF = 60.0  # ratio of the rates at one equilibrium from which an explicit method is bound to the fast one for long


def is_stiff(equator: EquatorEquilibria, critical: tuple[CriticalSet, ...] = ()) -> bool:
    """Whether trajectories creep along a slow direction, at any equilibrium: another is `STIFF` times as fast."""
    rho, theta = abs(equator.lambda_rho), abs(equator.lambda_theta)
    if (np.maximum(rho, theta) > STIFF * np.minimum(rho, theta)).any():
        return True
    rates = [abs(C.eigenvalues.real) for C in critical if C.discriminant >= 0.0]
    return any(one.max() > STIFF * one.min() for one in rates)


def drawn_duration(at: FrozenSystem, equator: EquatorEquilibria, critical: tuple[CriticalSet, ...] = ()) -> float:
    """Longest time T of each half of a drawn trajectory."""
    size = at.size or 1.0
    rates = np.minimum(abs(equator.lambda_rho), abs(equator.lambda_theta)).tolist()
    for C in critical:
        if C.kind != "saddle":
            # J is in the time of kappa_2, and dT = ebar dtau
            height = 1.0 / math.hypot(1.0, float(C.x2[0]), float(C.x2[1]))
            rates.append(float(abs(C.eigenvalues.real).min()) / height)
    needed = ARRIVAL / min([rate for rate in rates if rate > 0.0], default=math.inf)
    return min(max(MIN_DURATION / size, needed), MAX_DURATION / size)


@dataclass(frozen=True, eq=False)
class Orbits(ByValue):
    """Orbits through seeds; all arrays are read-only and points run with increasing time."""

    backward: Trajectories  # the two halves; each starts at the seed, time T = 0
    forward: Trajectories

    def __len__(self) -> int:
        return len(self.forward)

    @cached_property
    def _order(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Places of all points in (backward.buffer, forward.buffer) laid end to end, and offsets (k + 1,)."""
        back, ahead = self.backward.offsets, self.forward.offsets
        before, after = back[1:] - back[:-1] - 1, ahead[1:] - ahead[:-1]  # the seed is drawn once
        counts = before + after
        offsets = np.zeros(len(counts) + 1, np.int64)
        counts.cumsum(out=offsets[1:])
        within = np.arange(offsets[-1]) - offsets[:-1].repeat(counts)
        past = within < before.repeat(counts)
        from_back = (back[1:] - 1).repeat(counts) - within
        from_ahead = (back[-1] + ahead[:-1] - before).repeat(counts) + within
        return np.where(past, from_back, from_ahead), offsets

    @property
    def offsets(self) -> NDArray[np.int64]:
        """Orbit i is ``buffer[offsets[i]:offsets[i + 1]]``; (k + 1,)."""
        return self._order[1]

    @cached_property
    def buffer(self) -> Array:
        """Picture points of all orbits, one after the other; (N, 2)."""
        points = np.concatenate([self.backward.buffer, self.forward.buffer])[self._order[0]]
        points.flags.writeable = False
        return points

    @cached_property
    def clock(self) -> Array:
        """The time T at each point, 0 at the seed; (N,)."""
        times = np.concatenate([self.backward.clock, self.forward.clock])[self._order[0]]
        times.flags.writeable = False
        return times

    @cached_property
    def points(self) -> list[Array]:
        """One (m, 2) array an orbit."""
        at = self.offsets.tolist()
        return [self.buffer[i:j] for i, j in pairwise(at)]

    @cached_property
    def times(self) -> list[Array]:
        """One (m,) array an orbit."""
        at = self.offsets.tolist()
        return [self.clock[i:j] for i, j in pairwise(at)]

    @property
    def status(self) -> tuple[Status, ...]:
        """Return the reason why each orbit ends, forward in time."""
        return self.forward.status

    @property
    def origin(self) -> tuple[Status, ...]:
        """Return the reason why each orbit ends, backward in time: its alpha limit set."""
        return self.backward.status
