"""Sliding on a limit cycle of the layer problem: z' is the mean of W over the cycle.

In the e-linear system that is the slow flow on the critical set inside (prop:LC), see `slide`. Here it is
read off the cycle itself, found anew at every z that the method asks for.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...arrays import Array
from ...cycles.limit_cycles import LimitCycle, limit_cycles
from ...initial_value.problem import growth_bound, own_time
from ...numerics.radau import STAGES, Problem, Step, TooManyStepsError, steps
from ...psi.function import Psi
from ...systems.kinds import AnySystem

RTOL, ATOL = 1e-6, 1e-8  # no better than the cycles themselves are known
DIFFERENCE_STEP = 1e-4
#: Of the time in which z changes by its own size: the first step; steps so short that the cycle ends.
FIRST_STEP_SHARE, MIN_STEP = 0.05, 1e-6
OTHER_CYCLE_DISTANCE = 0.2  # in the disc: a cycle whose middle has moved further is another


@dataclass(frozen=True)
class CycleSlide:
    """A slide on a limit cycle.

    Attributes
    ----------
    taken : list of Step
        Of the whole state, with x = y = 0.
    lives : bool
        Whether the cycle is there until the end of the time span.
    e, p : list of ndarray (2,)
        Their means over the cycle in time, at the beginning and at the end of each step.
    """

    taken: list[Step]
    lives: bool
    e: list[Array]
    p: list[Array]


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
    first = limit_cycles(system, psi, tuple(z.tolist()))[index]
    middle = _centroid(first)
    e, p = list[Array](), list[Array]()
    m = len(z)

    def rate(at: Array) -> Array:
        stable = [cycle for cycle in limit_cycles(system, psi, tuple(at.tolist())) if cycle.stable]
        cycle = min(stable, key=lambda cycle: math.dist(_centroid(cycle), middle), default=None)
        if cycle is None or math.dist(_centroid(cycle), middle) > OTHER_CYCLE_DISTANCE:
            return np.full(m, math.nan)
        return np.array(cycle.slow_flow)

    def jacobian(at: Array) -> Array:
        nonlocal middle
        stable = [cycle for cycle in limit_cycles(system, psi, tuple(at.tolist())) if cycle.stable]
        cycle = min(stable, key=lambda cycle: math.dist(_centroid(cycle), middle), default=None)
        if cycle is not None:  # asked once at the beginning, and at the end of each step
            middle = _centroid(cycle)
            means = _means(system, psi, at, cycle)
            e.append(means[0])
            p.append(means[1])
        here, columns = rate(at), []
        for i in range(m):
            aside = at.copy()
            aside[i] += DIFFERENCE_STEP * (1.0 + abs(at[i]))
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
        pace = min(t_end - t, own_time(problem, z, np.array(first.slow_flow)))
        for step in steps(problem, t, t_end, z, RTOL, FIRST_STEP_SHARE * pace, most, MIN_STEP * pace):
            polynomial = np.concatenate([np.zeros((2, STAGES)), step.polynomial])
            first, last = np.concatenate([still, step.first]), np.concatenate([still, step.last])
            taken.append(Step(step.start, step.h, first, last, polynomial))
    except TooManyStepsError:
        return CycleSlide(taken, False, e, p)
    return CycleSlide(taken, True, e, p)


def _centroid(cycle: LimitCycle) -> tuple[float, float]:
    x, y = cycle.points.mean(axis=0).tolist()
    return x, y


def _means(system: AnySystem, psi: Psi, z: Array, cycle: LimitCycle) -> tuple[Array, Array]:
    """Means of e and of p over a cycle in the time of kappa_2, by the trapezoidal rule over its points."""
    p = cycle.points
    r2 = (p * p).sum(axis=1)
    height = np.sqrt(np.maximum(1.0 - r2, 1e-300))
    x2 = p / height[:, None]
    zeta = np.hypot(*x2.T)
    e = x2 * (psi.modulus(zeta) / np.maximum(zeta, 1e-300))[:, None]
    speed = np.hypot(*system.at(tuple(z.tolist())).U(e).T)
    distance = np.hypot(*(np.roll(x2, -1, axis=0) - x2).T)
    time = distance / np.maximum(speed + np.roll(speed, -1), 1e-300)  # in a unit of its own, as weights are its parts
    weight = 0.5 * (time + np.roll(time, 1)) / time.sum()
    return weight @ e, weight @ p
