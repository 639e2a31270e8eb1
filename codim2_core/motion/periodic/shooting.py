"""Shooting: a motion over a period, how far its end is from its start, and the step of Newton's method.

A motion X(t) is periodic if ``X(T) = X(0) + a``, where a is how far the slow variables are on after a period: 0, or a
period of the formulas, as 2 pi of an angle. With M the derivative of X(T) by X(0), Newton's step is

    forced:  (M - 1) dX = -(X(T) - X(0) - a)                in all but the clocks, whose start is kept, T too,
    else:    (M - 1) dX + X'(T) dT = -(X(T) - X(0) - a),    X'(0) . dX = 0,

the last row because every point of a periodic motion is a start of it.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ...arrays import Array
from ...initial_value.field import Field
from ...psi.function import Psi
from ...systems.kinds import AnySystem
from ...words import say
from ..nonsmooth import simulate_nonsmooth
from ..regularised import simulate
from ..result import Simulation, SimulationStatus
from ..variation.result import Variation
from .multipliers import rate_at
from .result import PeriodicStatus

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
    """A boundary value problem: the unknowns and conditions of a periodic motion.

    Attributes
    ----------
    system : ELinear, System, Coefficients or Frozen
    psi : Psi or None
    eps : float
        0 for the limit.
    formulas : Field
    clocks : ndarray (m,) of bool
        Slow variables that move at a constant rate.
    advance : ndarray (m,)
    period : float
        Where its search begins.
    floor : float
        What small z are measured by.
    max_steps : int
    stiction : float
        Static over kinetic friction.
    names : tuple of str
        Numbers of the system by which motions are differentiated too.
    """

    system: AnySystem
    psi: Psi | None
    eps: float
    formulas: Field
    clocks: NDArray[np.bool_]
    advance: Array
    period: float
    floor: float
    max_steps: int
    stiction: float = 1.0
    names: tuple[str, ...] = ()

    @property
    def is_forced(self) -> bool:
        """Whether the period is known."""
        return bool(self.clocks.any())

    @cached_property
    def free(self) -> NDArray[np.bool_]:
        """Return which of (x, y, z) are unknown."""
        return np.concatenate([[True, True], ~self.clocks])

    def follow(self, state: Array, period: float, rtol: float) -> Simulation:
        """Follow a motion over a period."""
        options = {"rtol": rtol, "atol": rtol * self.floor, "max_steps": self.max_steps}
        if self.eps == 0.0:
            return simulate_nonsmooth(self.system, state, (0.0, period), self.psi, stiction=self.stiction, **options)
        assert self.psi is not None
        return simulate(self.system, self.psi, state, (0.0, period), eps=self.eps, **options)

    def shot(self, state: Array, period: float, rtol: float) -> Shot:
        """Follow a motion over a period, and differentiate it.

        Raises
        ------
        LostError
            It ends before, or has no derivative.
        """
        run = self.follow(state, period, rtol)
        if run.status is not SimulationStatus.T_END:
            raise LostError(PeriodicStatus.MOTION_ENDS, f"{say('motion ends early')} {run.reason}", run)
        variation = run.variation(*self.names)
        if variation.reason or not (np.isfinite(variation.rate).all() and np.isfinite(variation.last).all()):
            raise LostError(PeriodicStatus.NO_DERIVATIVE, f"{say('no derivative')} {variation.reason}".strip(), run)
        return Shot(self, run, period, variation)


@dataclass(frozen=True, eq=False)
class Shot:
    """A motion over what may be its period, with its derivatives."""

    of: Shooting
    run: Simulation
    period: float
    variation: Variation

    @property
    def state(self) -> Array:
        """Its start."""
        return self.run.states[0]

    @cached_property
    def sizes(self) -> Array:
        """Return the scales (2 + m,) by which a difference counts as small."""
        found = np.abs(self.run.states).max(axis=0) + self.of.floor
        found[:2] = np.hypot(*self.run.states[:, :2].T).max() + self.of.eps
        found[:2] = found[:2] if found[0] > 0.0 else 1.0
        return found

    @cached_property
    def miss(self) -> Array:
        """Return the difference (2 + m,) of end and start."""
        found = self.run.states[-1] - self.run.states[0]
        found[2:] -= self.of.advance
        found[~self.of.free] = 0.0
        return found

    @property
    def residual(self) -> float:
        """Its size."""
        return self.norm(self.sizes)

    def norm(self, sizes: Array) -> float:
        """Size of it, small being measured by `sizes`."""
        return float(np.abs(self.miss / sizes).max())

    @cached_property
    def step(self) -> tuple[Array, float]:
        """Newton's step of the start and of the period."""
        free, sizes, n = self.of.free, self.sizes[self.of.free], len(self.state)
        matrix = (self.variation.last[:, :n] - np.eye(n))[np.ix_(free, free)] * sizes / sizes[:, None]
        right = -self.miss[free] / sizes
        if not self.of.is_forced:
            behind = rate_at(self.of.formulas, self.of.psi, self.run, 0) * self.period / sizes
            ahead = self.variation.rate * self.period / sizes
            matrix = np.block([[matrix, ahead[:, None]], [behind[None], np.zeros((1, 1))]])
            right = np.append(right, 0.0)
        found = _least_solution(matrix, right)
        change = np.zeros(n)
        change[free] = found[: len(sizes)] * sizes
        return change, 0.0 if self.of.is_forced else float(found[-1]) * self.period

    @property
    def step_size(self) -> float:
        """Size of the step, in units of the motion's."""
        change, later = self.step
        return max(float(np.abs(change / self.sizes).max()), abs(later) / self.period)


def _least_solution(matrix: Array, right: Array) -> Array:
    """Least solution of linear equations; exactly 0 in what is not coupled to any equation whose right side is not 0.

    So a start in an invariant line stays in it.
    """
    linked = (matrix != 0.0) | (matrix != 0.0).T
    moved = right != 0.0
    for _ in right:
        moved = moved | linked[:, moved].any(axis=1)
    found = np.zeros(len(right))
    left, values, along = np.linalg.svd(matrix[np.ix_(moved, moved)])
    large = values > NULL_SINGULAR_VALUE * max(1.0, values.max(initial=0.0))
    found[moved] = along.T[:, large] @ ((left.T @ right[moved])[large] / values[large])
    return found
