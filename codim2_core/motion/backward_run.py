"""The past of a state: a motion followed backwards, told forwards, as far as the state tells where it came from.

Backwards what attracts repels. Beside a set that a motion follows, differences grow by the rate of its attraction,
which is of order 1/eps while the state itself hardly moves; once they have grown from the tolerance to a hundredth,
what lies before is no past of the state but of its rounding.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..initial_value.problem import own_time
from ..numerics.dense import Dense
from ..numerics.radau import Problem
from ..words import say
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
    def from_run(cls, run: Simulation, problem: Problem, rtol: float) -> Past:
        """Return what a motion that was followed backwards, in the time -t, tells of the past.

        Parameters
        ----------
        run : Simulation
        problem : Problem
            What was followed.
        rtol : float
            Its tolerance: differences that it cannot tell.
        """
        return cls.upto(run, _reliable_steps(run.motion, problem, math.log(AGREE / rtol)), "past forgotten")

    @classmethod
    def upto(cls, run: Simulation, k: int, why: str) -> Past:
        """Return what the first k steps of a motion that was followed backwards tell.

        Parameters
        ----------
        run : Simulation
        k : int
        why : str
            The sentence, by its key, that says why no more are told, if there are more.
        """
        motion = run.motion.upto(k).backwards()
        first = float(motion.times[0])
        events = tuple(tuple(t for t in (-times[::-1]).tolist() if t >= first) for times in run.events)
        if k == len(run.motion.lengths):
            detail = run.reason.removeprefix(run.status.value).strip()
            return cls(motion, run.status, detail, run.evaluations, events)
        return cls(motion, SimulationStatus.FORGOTTEN, say(why, t=first), run.evaluations, events)


def _reliable_steps(motion: Dense, problem: Problem, most: float) -> int:
    """Return the steps along which differences grow by at most exp(most) beyond what the motion itself does."""
    grown = np.cumsum([_growth(motion, i, problem) for i in range(len(motion.lengths))])
    return int(np.searchsorted(grown, most, side="right"))


def _growth(motion: Dense, i: int, problem: Problem) -> float:
    """Return the integral of the growth over one step, by Simpson's rule."""
    rates = []
    for u in (0.0, 0.5, 1.0):
        state = motion.in_step(i, u)
        jacobian = problem.J(state)
        rate = float(np.linalg.eigvals(jacobian).real.max()) if np.isfinite(jacobian).all() else 0.0
        rates.append(max(0.0, rate - FASTER / own_time(problem, state, problem.F(state))))
    return float(motion.lengths[i]) * (rates[0] + 4.0 * rates[1] + rates[2]) / 6.0
