"""Sliding on a limit cycle of the layer problem: z' is the mean of W over the cycle.

In the e-linear system that is the slow flow on the critical set inside (Proposition 4.2), see `slide`. Here it is
read off the cycle itself, found anew at every z that the method asks for.
"""

from __future__ import annotations

import math

import numpy as np

from ...numerics.radau import Step, TooManyStepsError
from ...portrait.cycles.limit_cycles import LimitCycle, limit_cycles
from ...results.arrays import Array
from ...systems.kinds import AnySystem
from ...systems.psi.function import Psi
from ..initial_value.slow_steps import steps_of_z
from .slide import Slide, own_time

RTOL, ATOL = 1e-6, 1e-8  # no better than the cycles themselves are known
DIFFERENCE_STEP = 1e-4
#: Of the time in which z changes by its own size: the first step; steps so short that the cycle ends.
FIRST_STEP_SHARE, MIN_STEP = 0.05, 1e-6
OTHER_CYCLE_DISTANCE = 0.2  # in the disc: a cycle whose middle has moved further is another


def slide_on_cycle(system: AnySystem, psi: Psi, index: int, t: float, z: Array, t_end: float, most: int) -> Slide:
    """Follow the averaged slow flow of a general system.

    Shapes: z (m,).
    """
    means: list[tuple[Array, Array]] = []
    m, first = len(z), limit_cycles(system, psi, tuple(z.tolist()))[index]
    middle = _centroid(first)

    def near(at: Array) -> LimitCycle | None:
        """Return the stable cycle at another z that is nearest to the last one, if it may be the same."""
        stable = [cycle for cycle in limit_cycles(system, psi, tuple(at.tolist())) if cycle.stable]
        cycle = min(stable, key=lambda cycle: math.dist(_centroid(cycle), middle), default=None)
        return None if cycle is None or math.dist(_centroid(cycle), middle) > OTHER_CYCLE_DISTANCE else cycle

    def rate(at: Array) -> Array:
        cycle = near(at) if np.isfinite(at).all() else None
        return np.full(m, math.nan) if cycle is None else np.array(cycle.slow_flow)

    def note(at: Array) -> None:
        nonlocal middle
        cycle = near(at)
        if cycle is not None:
            middle = _centroid(cycle)
            means.append(_means(system, psi, at, cycle))

    def slopes(at: Array) -> Array:
        note(at)  # once where a step begins
        here, columns = rate(at), []
        for i, h in enumerate(DIFFERENCE_STEP * (1.0 + np.abs(at))):
            columns.append((rate(at + h * (np.arange(m) == i)) - here) / h)
        return np.nan_to_num(np.stack(columns, axis=-1))

    floor = ATOL / RTOL
    pace = min(t_end - t, own_time(z, np.array(first.slow_flow), floor))
    motion = steps_of_z(
        rate, slopes, (t, t_end), z, RTOL, floor, most,
        h=FIRST_STEP_SHARE * pace, least=MIN_STEP * pace, implicit=True,
    )  # fmt: skip
    taken, end = list[Step](), "time"
    try:
        for part in motion.chunks(most):
            taken += part
        note(motion.y[2:])
    except TooManyStepsError:
        end = "cycle"
    e, p = ([own[k] for own in means] for k in range(2))
    return Slide(taken, end, e[-1] if e else np.array(middle), e, motion.evaluations, p=p)


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
