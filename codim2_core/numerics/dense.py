"""Dense output of a motion: the polynomials of its steps, at any time."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ..results.arrays import Array, read_only
from ..results.result import ByValue, Pictured, column_rows
from ..results.tables import frame
from .radau import STAGES, Step


@dataclass(frozen=True, eq=False)
class Dense(ByValue):
    """The states of a motion at any time it covers; arrays are read-only."""

    times: Array  # (k,) Ends of the steps, from t_start on, never decreasing
    states: Array  # (k, 2 + m)
    lengths: Array  # (k - 1,) Of the steps; close to Sigma shorter than the spacing of doubles at their times
    polynomials: Array  # (k - 1, 2 + m, d) ``states[i] + polynomials[i] . (u, ..., u^d)``, u from 0 to 1 along step i

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
        with np.errstate(divide="ignore", invalid="ignore"):  # a step may have no length, at a switch
            u = np.nan_to_num(np.clip((flat - self.times[i]) / self.lengths[i], 0.0, 1.0))
        powers = u[:, None] ** np.arange(1, self.polynomials.shape[2] + 1)
        found = self.states[i] + np.einsum("ijk,ik->ij", self.polynomials[i], powers)
        found = np.where((flat == self.times[at])[:, None], self.states[at], found)
        return found.reshape(*when.shape, self.states.shape[1])

    def upto(self, k: int, u: float = 1.0) -> Dense:
        """Return the first k steps, of the last one the part up to its fraction u."""
        times, states = self.times[: k + 1].copy(), self.states[: k + 1].copy()
        lengths, polynomials = self.lengths[:k].copy(), self.polynomials[:k].copy()
        if u < 1.0:
            states[k], lengths[-1] = self.in_step(k - 1, u), u * lengths[-1]
            times[k] = times[k - 1] + lengths[-1]
            polynomials[-1] *= u ** np.arange(1, polynomials.shape[2] + 1)
        return Dense(times, states, lengths, polynomials)

    def backwards(self) -> Dense:
        """Return the same states in the order of the time -t."""
        d = self.polynomials.shape[2]
        # in v = 1 - u: the sum of a_k (1 - v)^k less its value at v = 0
        turned = np.array([[(-1.0) ** j * math.comb(k, j) for k in range(1, d + 1)] for j in range(1, d + 1)])
        polynomials = np.einsum("jk,ink->inj", turned, self.polynomials[::-1])
        arrays = -self.times[::-1], self.states[::-1].copy(), self.lengths[::-1].copy(), polynomials
        for array in arrays:
            array.flags.writeable = False
        return Dense(*arrays)

    def in_step(self, i: int, u: float) -> Array:
        """State (2 + m,) at the fraction u of step i."""
        return self.states[i] + self.polynomials[i] @ (u ** np.arange(1, self.polynomials.shape[2] + 1))


@dataclass(frozen=True, eq=False)
class DenseMotion(Pictured):
    """A motion as a result: its states at the times that were requested, at any other time, and as a table."""

    _internal_: ClassVar[frozenset[str]] = frozenset({"motion", "sample"})

    motion: Dense = field(repr=False)
    _asked: Array | None = field(default=None, repr=False, kw_only=True)

    @property
    def times(self) -> Array:
        """Times that were requested, or the ends of the steps."""
        return self.motion.times if self._asked is None else self._asked

    @property
    def states(self) -> Array:
        """States there."""
        return self.motion.states if self._asked is None else self._sampled

    @cached_property
    def _sampled(self) -> Array:
        return read_only(self.motion(self.times))

    def sample(self, times: Array | None) -> Self:
        """Return the motion with these of its times; None is the ends of its steps."""
        if times is None:
            return self
        covered = (times >= self.motion.times[0]) & (times <= self.motion.times[-1])
        return replace(self, _asked=read_only(times[covered]))

    def dense(self, t: ArrayLike) -> Array:
        """State at any time, from the polynomials of the steps; ValueError outside the times covered."""
        return self.motion(t)

    def _columns(self, when: Array, states: Array) -> dict[str, Any]:
        """Return the columns of a table of these times."""
        raise NotImplementedError

    def _records(self) -> Iterator[dict[str, Any]]:
        return column_rows(self._columns(self.times, self.states))

    def to_frame(self, t: ArrayLike | None = None) -> Any:
        """Return the motion as a pandas DataFrame: a row a time, with the state and the phase."""
        when = self.times if t is None else np.asarray(t, float)
        if when.ndim != 1:
            raise ValueError(f"t has shape {when.shape}; give a list of times.")
        return frame(self._columns(when, self.states if t is None else self.dense(when)))


@dataclass(frozen=True, eq=False)
class StepArray:
    """Consecutive steps as arrays: from the state `first` (n,), each with its start, length, end and polynomial."""

    first: Array
    starts: Array
    lengths: Array
    ends: Array
    polynomials: Array

    def __iter__(self) -> Iterator[Step]:
        """One `Step` each."""
        before = self.first
        for start, h, end, polynomial in zip(
            self.starts.tolist(), self.lengths.tolist(), self.ends, self.polynomials, strict=True
        ):
            yield Step(start, h, before, end, polynomial)
            before = end

    def upto(self, k: int, u: float) -> StepArray:
        """Return the first k steps, and of the next one the part up to its fraction u; nothing of it for u = 0."""
        starts, lengths, ends = self.starts[:k], self.lengths[:k], self.ends[:k]
        if not u > 0.0:
            return StepArray(self.first, starts, lengths, ends, self.polynomials[:k])
        powers = u ** np.arange(1, self.polynomials.shape[2] + 1)
        polynomials = np.concatenate([self.polynomials[:k], self.polynomials[k : k + 1] * powers])
        first = self.ends[k - 1] if k else self.first
        ends = np.concatenate([ends, (first + polynomials[k].sum(axis=1))[None]])
        return StepArray(self.first, self.starts[: k + 1], np.append(lengths, u * self.lengths[k]), ends, polynomials)


def gather_steps(taken: Sequence[Step], n: int) -> StepArray:
    """Gather steps of n numbers."""
    degree = max((step.polynomial.shape[1] for step in taken), default=STAGES)
    polynomials = np.zeros((len(taken), n, degree))
    for step, polynomial in zip(taken, polynomials, strict=True):
        polynomial[:, : step.polynomial.shape[1]] = step.polynomial
    return StepArray(
        taken[0].first if taken else np.zeros(n),
        np.array([step.start for step in taken]),
        np.array([step.h for step in taken]),
        np.array([step.last for step in taken]).reshape(len(taken), n),
        polynomials,
    )


def dense(t_start: float, first: Array, parts: Sequence[StepArray]) -> Dense:
    """Join steps, each of which begins where the one before it ended."""
    times = np.maximum.accumulate(np.concatenate([[t_start], *(part.starts + part.lengths for part in parts)]))
    states = np.concatenate([first[None], *(part.ends for part in parts)])
    lengths = np.concatenate([np.zeros(0), *(part.lengths for part in parts)])
    degree = max([STAGES, *(part.polynomials.shape[2] for part in parts)])
    polynomials = np.zeros((len(lengths), len(first), degree))
    at = 0
    for part in parts:
        rows, _, own = part.polynomials.shape
        polynomials[at : at + rows, :, :own] = part.polynomials
        at += rows
    for array in (times, states, lengths, polynomials):
        array.flags.writeable = False
    return Dense(times, states, lengths, polynomials)
