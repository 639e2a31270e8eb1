"""Sliding on a limit cycle of the layer problem: z' is the mean of W over the cycle.

In the e-linear system that is the slow flow on the critical set inside (prop:LC), see `slide`. Here it is
read off the cycle itself, found anew at every z that the method asks for.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..cycles.limit_cycles import LimitCycle, limit_cycles
from ..numerics.radau import STAGES, Problem, Step, TooManyStepsError, steps
from ..psi.function import Psi
from ..systems.kinds import AnySystem
from .problem import growth_bound

Array = NDArray[np.float64]

RTOL, ATOL = 1e-6, 1e-8  # no better than the cycles themselves are known
DIFFERENCE = 1e-4
SHORTEST = 1e-6  # of the time span: steps that short mean that the cycle ends
APART = 0.2  # in the disc: a cycle whose middle has moved further is another


@dataclass(frozen=True)
class CycleSlide:
    """A slide on a limit cycle.

    Attributes
    ----------
    taken : list of Step
        Of the whole state, with x = y = 0.
    lives : bool
        Whether the cycle is there until the end of the time span.
    """

    taken: list[Step]
    lives: bool


def slide_on_cycle(system: AnySystem, psi: Psi, index: int, t: float, z: Array, t_end: float, most: int) -> CycleSlide:
    """Follow the averaged slow flow of a general system.

    Parameters
    ----------
    system : System or Frozen
    psi : Psi
    index : int
        Of the cycle, among `limit_cycles` at z.
    t, t_end : float
    z : ndarray (m,)
    most : int
        Steps.
    """
    middle = _middle(limit_cycles(system, psi, tuple(z.tolist()))[index])
    m = len(z)

    def rate(at: Array) -> Array:
        stable = [cycle for cycle in limit_cycles(system, psi, tuple(at.tolist())) if cycle.stable]
        cycle = min(stable, key=lambda cycle: math.dist(_middle(cycle), middle), default=None)
        if cycle is None or math.dist(_middle(cycle), middle) > APART:
            return np.full(m, math.nan)
        return np.array(cycle.slow_flow)

    def jacobian(at: Array) -> Array:
        nonlocal middle
        stable = [cycle for cycle in limit_cycles(system, psi, tuple(at.tolist())) if cycle.stable]
        middle = min((_middle(cycle) for cycle in stable), key=lambda p: math.dist(p, middle), default=middle)
        here, columns = rate(at), []
        for i in range(m):
            aside = at.copy()
            aside[i] += DIFFERENCE * (1.0 + abs(at[i]))
            columns.append((rate(aside) - here) / (aside[i] - at[i]))
        return np.nan_to_num(np.stack(columns, axis=-1))

    problem = Problem(
        rate,
        jacobian,
        lambda at: np.abs(at) + ATOL / RTOL,
        lambda at, rate, slope: growth_bound(slope),  # noqa: ARG005
    )
    still = np.zeros(2)
    taken: list[Step] = []
    try:
        span = t_end - t
        for step in steps(problem, t, t_end, z, RTOL, 0.05 * span, most, SHORTEST * span):
            polynomial = np.concatenate([np.zeros((2, STAGES)), step.polynomial])
            first, last = np.concatenate([still, step.first]), np.concatenate([still, step.last])
            taken.append(Step(step.start, step.h, first, last, polynomial))
    except TooManyStepsError:
        return CycleSlide(taken, False)
    return CycleSlide(taken, True)


def _middle(cycle: LimitCycle) -> tuple[float, float]:
    x, y = cycle.points.mean(axis=0).tolist()
    return x, y
