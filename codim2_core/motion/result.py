"""What a simulation returns: states, times, dense output, and its phases with their reasons."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..numerics.radau import STAGES, Step

Array = NDArray[np.float64]


class SimulationStatus(Enum):
    """Why a simulation ended; the value is the sentence shown."""

    T_END = "Reached the end of the time span."
    EVENT = "Stopped at a terminal event."
    NOT_UNIQUE = "Stopped: in the limit ε → 0 what follows is not unique, or not known."
    STEP_LIMIT = (
        "Stopped at the step limit: the motion varies too fast for the time span (around a limit cycle once in a time "
        "of order ε), grows beyond bounds, or comes to where its formulas are undefined; shorten the span, raise "
        "max_steps, or use simulate_nonsmooth."
    )


@dataclass(frozen=True)
class Phase:
    """One phase of a motion.

    Attributes
    ----------
    kind : str
        "slip" (outside Sigma), "slide" (on Sigma, or within some eps of it), or "cross" (through it at once).
    t_start, t_end : float
    reason : str
        Why it began: a sentence.
    onto : str or None
        What it slides on: "C" (or "C1", ...), "cycle 1"; None elsewhere.
    """

    kind: str
    t_start: float
    t_end: float
    reason: str
    onto: str | None = None


@dataclass(frozen=True, eq=False)
class Simulation:
    """A motion; arrays are read-only.

    Attributes
    ----------
    times : ndarray (k,)
        Ends of the steps, from t_start on, never decreasing. Near Sigma two may be equal: steps of length eps can be
        shorter than the spacing of doubles.
    states : ndarray (k, 2 + m)
        (x, y, z1, ..., zm).
    phases : tuple of Phase
    status : SimulationStatus
    reason : str
        The status, and what there is to say about it here.
    eps : float
        0 for the nonsmooth limit.
    evaluations : int
        Evaluations of the field.
    events : tuple of ndarray
        Times of each event.
    """

    times: Array
    states: Array
    phases: tuple[Phase, ...]
    status: SimulationStatus
    reason: str
    eps: float
    evaluations: int
    events: tuple[Array, ...]
    _lengths: Array
    _polynomials: Array

    @cached_property
    def invariant(self) -> float:
        """Largest relative drift of rho ebar = eps over the states; 0 in the nonsmooth limit.

        x and y themselves are integrated, so that this is rounding alone.
        """
        if self.eps == 0.0:
            return 0.0
        rho = np.hypot(np.hypot(self.states[:, 0], self.states[:, 1]), self.eps)
        ebar = np.sqrt(np.maximum(0.0, 1.0 - ((self.states[:, :2] / rho[:, None]) ** 2).sum(axis=1)))
        near = ebar > 0.1  # further out 1 - |p|^2 only cancels
        drift = np.abs(rho[near] * ebar[near] / self.eps - 1.0)
        return float(drift.max()) if near.any() else 0.0

    def dense(self, t: ArrayLike) -> Array:
        """State at any time, from the polynomials of the steps.

        Parameters
        ----------
        t : float or (...,)
            Between ``times[0]`` and ``times[-1]``.

        Returns
        -------
        ndarray (..., 2 + m)

        Raises
        ------
        ValueError
            t is outside the times covered, or not finite.
        """
        when = np.asarray(t, float)
        low, high = float(self.times[0]), float(self.times[-1])
        if when.size and not (when.min() >= low and when.max() <= high):
            wrong = when[~((when >= low) & (when <= high))].ravel()[0]
            raise ValueError(f"t is {wrong}; this motion is known for {low} <= t <= {high} ({self.status.value})")
        if not len(self._lengths):
            return np.broadcast_to(self.states[0], (*when.shape, self.states.shape[1])).copy()
        flat = when.ravel()
        at = np.searchsorted(self.times, flat, side="right") - 1  # of several equal times the last
        i = np.minimum(at, len(self._lengths) - 1)
        u = np.clip((flat - self.times[i]) / self._lengths[i], 0.0, 1.0)
        powers = u[:, None] ** np.arange(1, STAGES + 1)
        found = self.states[i] + np.einsum("ijk,ik->ij", self._polynomials[i], powers)
        found = np.where((flat == self.times[at])[:, None], self.states[at], found)
        return found.reshape(*when.shape, self.states.shape[1])

    def phase_at(self, t: float) -> Phase | None:
        """Return the phase at time t, at a change of phases the later one; None if the motion stopped at once."""
        self.dense(t)  # raises where t is outside
        return next((phase for phase in reversed(self.phases) if phase.t_start <= t), None)


def simulation(
    t_start: float,
    first: Array,
    taken: Sequence[Step],
    phases: Sequence[Phase],
    status: SimulationStatus,
    *,
    detail: str = "",
    eps: float = 0.0,
    evaluations: int = 0,
    events: Sequence[Sequence[float]] = (),
) -> Simulation:
    """Gather steps into a result.

    Parameters
    ----------
    t_start : float
    first : ndarray (n,)
        The state there; each step begins where the one before it ended.
    taken : sequence of Step
    phases, status, eps, evaluations, events
        As in `Simulation`.
    detail : str
        Added to the status as its reason.
    """
    n = len(first)
    times = np.maximum.accumulate(np.array([t_start, *(step.end for step in taken)]))
    states = np.concatenate([first[None], *(step.last[None] for step in taken)])
    lengths = np.array([step.h for step in taken])
    polynomials = np.array([step.polynomial for step in taken]).reshape(len(taken), n, STAGES)
    found = tuple(np.array(times_) for times_ in events)
    for array in (times, states, lengths, polynomials, *found):
        array.flags.writeable = False
    return Simulation(
        times,
        states,
        tuple(phases),
        status,
        f"{status.value} {detail}".strip(),
        eps,
        evaluations,
        found,
        lengths,
        polynomials,
    )
