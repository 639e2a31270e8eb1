"""Dense output of a motion: the polynomials of its steps, at any time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .radau import STAGES, Step

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Dense:
    """The states of a motion at any time it covers; arrays are read-only.

    Attributes
    ----------
    times : ndarray (k,)
        Ends of the steps, from t_start on, never decreasing.
    states : ndarray (k, 2 + m)
    lengths : ndarray (k - 1,)
        Of the steps; close to Sigma shorter than the spacing of doubles at their times.
    polynomials : ndarray (k - 1, 2 + m, 5)
        ``states[i] + polynomials[i] . (u, ..., u^5)``, u from 0 to 1 along step i.
    """

    times: Array
    states: Array
    lengths: Array
    polynomials: Array

    def __call__(self, t: ArrayLike) -> Array:
        """State (..., 2 + m) at times (...,) between the first and the last; ValueError for any other."""
        when = np.asarray(t, float)
        low, high = float(self.times[0]), float(self.times[-1])
        if when.size and not (when.min() >= low and when.max() <= high):
            wrong = when[~((when >= low) & (when <= high))].ravel()[0]
            raise ValueError(f"t is {wrong}; this motion is known for {low} <= t <= {high}.")
        if not len(self.lengths):
            return np.broadcast_to(self.states[0], (*when.shape, self.states.shape[1])).copy()
        flat = when.ravel()
        at = np.searchsorted(self.times, flat, side="right") - 1  # of several equal times the last
        i = np.minimum(at, len(self.lengths) - 1)
        u = np.clip((flat - self.times[i]) / self.lengths[i], 0.0, 1.0)
        powers = u[:, None] ** np.arange(1, STAGES + 1)
        found = self.states[i] + np.einsum("ijk,ik->ij", self.polynomials[i], powers)
        found = np.where((flat == self.times[at])[:, None], self.states[at], found)
        return found.reshape(*when.shape, self.states.shape[1])

    def within(self, i: int, u: float) -> Array:
        """State (2 + m,) at the fraction u of step i."""
        return self.states[i] + self.polynomials[i] @ (u ** np.arange(1, STAGES + 1))


def dense(t_start: float, first: Array, taken: Sequence[Step]) -> Dense:
    """Gather steps, each of which begins where the one before it ended."""
    times = np.maximum.accumulate(np.array([t_start, *(step.end for step in taken)]))
    states = np.concatenate([first[None], *(step.last[None] for step in taken)])
    lengths = np.array([step.h for step in taken])
    polynomials = np.array([step.polynomial for step in taken]).reshape(len(taken), len(first), STAGES)
    for array in (times, states, lengths, polynomials):
        array.flags.writeable = False
    return Dense(times, states, lengths, polynomials)
