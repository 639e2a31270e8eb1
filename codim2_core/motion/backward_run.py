"""The past of a state: a motion followed backwards, told forwards, as far as the state tells where it came from.

Backwards what attracts repels. Next to a set that a motion follows, differences grow by the rate of its attraction,
which is of order 1/eps while the state itself hardly moves; once they have grown from the tolerance to a hundredth,
what lies before is no past of the state but of its rounding.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..numerics.dense import Dense
from ..results.arrays import Array
from ..results.words import say
from ..systems.kinds import AnySystem
from ..systems.psi.direction import smoothed_direction
from ..systems.psi.function import Psi
from .initial_value.slopes import slopes_of
from .result import Simulation, SimulationStatus

AGREE = 1e-2  # of its size: as far as two states may differ that are still the same
FASTER = 4.0  # growth that is no faster than so many times the motion itself turns its state, as in a slip, is no loss


class Past(NamedTuple):
    """A motion that comes to a state, and why it is known no further back."""

    motion: Dense
    status: SimulationStatus
    detail: str
    evaluations: int
    events: tuple[tuple[float, ...], ...]

    @classmethod
    def from_run(cls, run: Simulation, system: AnySystem, psi: Psi, rtol: float, atol: float) -> Past:
        """Return what a motion that was followed backwards, in the time -t, tells of the past."""
        growth, most = _growth(run, system, psi, atol / rtol), math.log(AGREE / rtol)
        k = int(np.searchsorted(np.cumsum(growth), most, side="right"))
        if k == len(growth):
            return cls.upto(run, run.motion, "")
        return cls.upto(
            run, run.motion.upto(k + 1, (most - float(growth[:k].sum())) / float(growth[k])), "past forgotten"
        )

    @classmethod
    def upto(cls, run: Simulation, told: Dense, why: str) -> Past:
        """Return what the first part of a motion that was followed backwards tells."""
        motion = told.backwards()
        first = float(motion.times[0])
        events = tuple(tuple(t for t in (-times[::-1]).tolist() if t >= first) for times in run.events)
        if told.times[-1] == run.times[-1]:
            detail = run.reason.removeprefix(run.status.value).strip()
            return cls(motion, run.status, detail, run.evaluations, events)
        return cls(motion, SimulationStatus.FORGOTTEN, say(why, t=first), run.evaluations, events)


def _growth(run: Simulation, system: AnySystem, psi: Psi, floor: float) -> Array:
    """Return by what differences grow along each step beyond what the motion itself does, by Simpson's rule."""
    motion, slopes = run.motion, slopes_of(system)
    n, steps = motion.states.shape[1], range(len(motion.lengths))
    states = np.array([motion.in_step(i, u) for i in steps for u in (0.0, 0.5, 1.0)]).reshape(-1, n)
    e, De = smoothed_direction(psi, run.eps, states[:, :2])
    jacobians, sizes = -slopes.of_state(e, De, states), np.abs(states) + floor
    sizes[:, :2] = np.hypot(np.hypot(*states[:, :2].T), run.eps)[:, None]
    known = np.isfinite(jacobians).all(axis=(1, 2), keepdims=True)
    rates = np.linalg.eigvals(np.where(known, jacobians, 0.0)).real.max(axis=1, initial=0.0)
    own = FASTER * np.max(np.abs(slopes.rates(e, states)) / sizes, axis=1)
    return motion.lengths * (np.maximum(rates - own, 0.0).reshape(-1, 3) @ (1.0, 4.0, 1.0)) / 6.0
