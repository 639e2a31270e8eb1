"""Shooting: a motion over a period, how far its end is from its start, and the step of Newton's method.

A motion X(t) is periodic if ``X(T) = X(0) + a``, where a is how far the slow variables are on after a period: 0, or a
period of the formulas, as 2 pi of an angle. Where a period multiplies a change by more than 1e4, the motion is cut into
segments, each from a start X_1, ..., X_k of its own (Keller 1968; Ascher, Mattheij and Russell 1995). With S_i the
derivative of the end E_i of a segment by its start, and p_i its part of the period, Newton's step is

    S_i dX_i + p_i E_i' dT - dX_(i+1) = -(E_i - X_(i+1)),   X_(k+1) = X_1 + a,

in all but the clocks, whose start is kept, and where there is one, without dT; else with ``X_1' . dX_1 = 0`` besides,
because every point of a periodic motion is a start of it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property, reduce
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ...results.arrays import Array
from ...results.words import say
from ...systems.kinds import AnySystem
from ...systems.psi.function import Psi
from ..initial_value.field import Field
from ..regularised import simulate_segments
from ..result import Simulation, SimulationStatus
from ..simulate import simulate
from ..variation.result import Variation
from .multipliers import rate_at
from .result import PeriodicStatus

MAX_SEGMENT_GROWTH = (
    1e4  # of a change along a segment, in units of the motion's size; where it is more there are more segments
)
NULL_SINGULAR_VALUE = (
    1e-8  # singular values of M - 1, or of M if that is larger, that count as 0: nothing moves, as in a family
)


class LostError(Exception):
    """A motion cannot be followed, or not be differentiated, over a period."""

    def __init__(self, status: PeriodicStatus, reason: str, run: Simulation) -> None:
        super().__init__(reason)
        self.status, self.run = status, run


@dataclass(frozen=True, eq=False)
class Shooting:
    """A boundary value problem: the unknowns and conditions of a periodic motion."""

    system: AnySystem
    psi: Psi | None
    eps: float  # 0 for the limit
    formulas: Field
    clocks: NDArray[np.bool_]  # (m,) Slow variables that move at a constant rate
    advance: Array  # (m,)
    period: float  # where its search begins
    floor: float  # what small z are measured by
    max_steps: int
    stiction: float = 1.0  # static over kinetic friction
    max_step: float = np.inf
    names: tuple[str, ...] = ()  # numbers of the system by which motions are differentiated too
    parts: tuple[float, ...] = (0.0,)  # where segments begin, as parts of the period; several for eps > 0 only

    @property
    def is_forced(self) -> bool:
        """Whether the period is known."""
        return bool(self.clocks.any())

    @cached_property
    def free(self) -> NDArray[np.bool_]:
        """Return which of (x, y, z) are unknown."""
        return np.concatenate([[True, True], ~self.clocks])

    def follow(self, starts: Array, period: float, rtol: float) -> tuple[Simulation, tuple[int, ...], Array]:
        """Follow a motion over a period from the starts of its segments (k, 2 + m): its run, cuts and ends."""
        options = {"rtol": rtol, "atol": rtol * self.floor, "max_steps": self.max_steps, "max_step": self.max_step}
        if self.eps == 0.0 or len(starts) == 1:
            span = (0.0, period)
            run = simulate(self.system, self.psi, starts[0], span, eps=self.eps, stiction=self.stiction, **options)
            return run, (0, len(run.times) - 1), run.states[-1:]
        assert self.psi is not None
        starts, times = starts.copy(), period * np.array([*self.parts, 1.0])
        starts[1:, 2:][:, self.clocks] = (starts[0, 2:] + np.outer(self.parts, self.advance))[1:, self.clocks]
        return simulate_segments(self.system, self.psi, starts, times, eps=self.eps, **options)

    def shot(self, starts: Array, period: float, rtol: float) -> Shot:
        """Follow a motion over a period, and differentiate it; LostError where it ends before or has no derivative."""
        run, cuts, ends = self.follow(np.atleast_2d(starts), period, rtol)
        if run.status is not SimulationStatus.T_END:
            raise LostError(PeriodicStatus.MOTION_ENDS, f"{say('motion ends early')} {run.reason}", run)
        variation = run.variation(*self.names)
        if variation.reason or not (np.isfinite(variation.rate).all() and np.isfinite(variation.last).all()):
            raise LostError(PeriodicStatus.NO_DERIVATIVE, f"{say('no derivative')} {variation.reason}".strip(), run)
        return Shot(self, run, period, variation, cuts, ends)

    def divide(self, run: Simulation, first: int, period: float, variation: Variation) -> tuple[Shooting, Array]:
        """Divide a motion, begun at a step end, where changes have grown: the problem, and starts (k, 2 + m)."""
        n, sizes, count = run.states.shape[1], _sizes(run, self), len(variation.propagators)
        scale = sizes / sizes[:, None]
        growth, cuts = np.eye(n), [first]
        for k in range(first, first + count) if self.eps > 0.0 else ():
            step = (variation.propagators[k % count, :n, :n] * scale)[np.ix_(self.free, self.free)]
            growth = step if k == cuts[-1] else step @ growth
            if k > cuts[-1] and np.linalg.norm(growth, 2) > MAX_SEGMENT_GROWTH:
                growth, cuts = step, [*cuts, k]
        starts = np.array([run.states[k % count] for k in cuts])
        times = np.array([run.times[k % count] + period * (k // count) for k in cuts])
        starts[:, 2:] += np.outer([k // count for k in cuts], self.advance)
        parts = (times - times[0]) / period
        return replace(self, parts=tuple(parts.tolist())), starts


@dataclass(frozen=True, eq=False)
class Shot:
    """A motion over what may be its period, with its derivatives; `cuts` and `ends` are those of its segments."""

    of: Shooting
    run: Simulation
    period: float
    variation: Variation
    cuts: tuple[int, ...]
    ends: Array

    @property
    def state(self) -> Array:
        """Its start."""
        return self.run.states[0]

    @property
    def starts(self) -> Array:
        """Those of its segments (k, 2 + m)."""
        return self.run.states[list(self.cuts[:-1])]

    @cached_property
    def sizes(self) -> Array:
        """Return the scales (2 + m,) by which a difference counts as small."""
        return _sizes(self.run, self.of)

    @cached_property
    def miss(self) -> Array:
        """Return the differences (k, 2 + m) of ends and the starts that follow."""
        starts = self.starts
        found = self.ends - np.roll(starts, -1, axis=0)
        found[-1, 2:] -= self.of.advance
        found[:, ~self.of.free] = 0.0
        return found

    @property
    def residual(self) -> float:
        """Its size."""
        return self.norm(self.sizes)

    def norm(self, sizes: Array) -> float:
        """Size of it, small being measured by `sizes`."""
        return float(np.abs(self.miss / sizes).max())

    def slopes(self, free: NDArray[np.bool_], sizes: Array) -> tuple[Array, Array, Array]:
        """Return the derivatives of what is missed of `free`: by the starts, by the period, and of segments by all."""
        k, n, q = len(self.ends), len(self.state), int(free.sum())
        steps, count = self.variation.propagators, self.variation.propagators.shape[1]
        segments = np.array([
            reduce(lambda product, step: step @ product, steps[low:high], np.eye(count))[:n]
            for low, high in pairwise(self.cuts)
        ])[:, free] / sizes[:, None]  # fmt: skip
        by_starts = np.zeros((k, q, k, q))
        for i in range(k):
            by_starts[i, :, i] += segments[i][:, :n][:, free] * sizes
            by_starts[i, :, (i + 1) % k] -= np.eye(q)
        rates = [rate_at(self.of.formulas, self.of.psi, self.run, cut) for cut in self.cuts[1:-1]]
        parts = np.diff([*self.of.parts, 1.0])
        by_period = np.array([*rates, self.variation.rate])[:, free] / sizes * parts[:, None]
        return by_starts.reshape(k * q, k * q), by_period, segments

    @cached_property
    def step(self) -> tuple[Array, float]:
        """Newton's step of the starts (k, 2 + m) and of the period."""
        free, sizes = self.of.free, self.sizes[self.of.free]
        matrix, ahead, _ = self.slopes(free, sizes)
        right = -(self.miss[:, free] / sizes).ravel()
        if not self.of.is_forced:
            behind = np.zeros(len(right))
            behind[: len(sizes)] = rate_at(self.of.formulas, self.of.psi, self.run, 0) * self.period / sizes
            matrix = np.block([[matrix, ahead.reshape(-1, 1) * self.period], [behind[None], np.zeros((1, 1))]])
            right = np.append(right, 0.0)
        found = _least_solution(matrix, right)
        change = np.zeros(self.ends.shape)
        change[:, free] = found[: self.ends[:, free].size].reshape(len(change), -1) * sizes
        return change, 0.0 if self.of.is_forced else float(found[-1]) * self.period

    @property
    def step_size(self) -> float:
        """Size of the step, in units of the motion's."""
        change, later = self.step
        return max(float(np.abs(change / self.sizes).max()), abs(later) / self.period)


def _sizes(run: Simulation, of: Shooting) -> Array:
    found = np.abs(run.states).max(axis=0) + of.floor
    found[:2] = np.hypot(*run.states[:, :2].T).max() + of.eps
    found[:2] = found[:2] if found[0] > 0.0 else 1.0
    return found


def _least_solution(matrix: Array, right: Array) -> Array:
    """Least solution of linear equations, exactly 0 in what couples to none whose right side is not 0."""
    linked = (matrix != 0.0) | (matrix != 0.0).T
    moved = right != 0.0
    for _ in right:
        moved = moved | linked[:, moved].any(axis=1)
    found = np.zeros(len(right))
    left, values, along = np.linalg.svd(matrix[np.ix_(moved, moved)])
    large = values > NULL_SINGULAR_VALUE * max(1.0, values.max(initial=0.0))
    found[moved] = along.T[:, large] @ ((left.T @ right[moved])[large] / values[large])
    return found
