"""Beginnings of response curves: the period of a forcing, read off the formulas, and what a motion settles to."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np

from ...formulas.expression import Expression
from ...formulas.names import SLOW_NAMES
from ...formulas.tape import compact
from ...results.arrays import Array
from ...systems.kinds import AnySystem
from ...systems.psi.function import Psi
from ..initial_value.field import field
from ..result import Simulation
from ..simulate import simulate

MAX_DENOMINATOR, RATIO_TOLERANCE = 12, 1e-9  # of ratios of frequencies that have a common period
SETTLING_PERIODS = 40  # of a forcing, for which a motion is followed until it has settled
SAMPLES = 4000  # of a free motion, among which it is seen to return
RETURN_DISTANCE = 0.05  # of its size: how near to its end a settled motion comes again


def forcing_period(system: AnySystem) -> float | None:
    """Return the common period of all sines and cosines of a slow variable of constant rate; None without one."""
    rows = field(system).rows
    rates = {name: row.constant for name, row in zip(SLOW_NAMES, rows[2:], strict=False) if row.constant}
    frequencies: set[float] = set()
    for row in rows:
        for op, *arguments in row.tape:
            if op in ("sin", "cos"):
                inner = Expression(compact(list(row.tape), arguments[0]))
                slopes = [(inner.derivative(name), rate) for name, rate in rates.items() if name in inner.names]
                if any(slope.names for slope, _ in slopes):
                    return None
                frequencies.add(abs(sum(slope.evaluate({}) * rate for slope, rate in slopes)))
    frequencies.discard(0.0)
    if not frequencies:
        return None
    base = min(frequencies)
    ratios = {one / base: Fraction(one / base).limit_denominator(MAX_DENOMINATOR) for one in frequencies}
    if any(abs(float(near) - ratio) > RATIO_TOLERANCE * ratio for ratio, near in ratios.items()):
        return None
    return 2.0 * math.pi / base * math.lcm(*(near.denominator for near in ratios.values()))


def settled_motion(
    system: AnySystem, start: tuple[float, ...], psi: Psi, eps: float, t_end: float, rtol: float = 1e-8
) -> tuple[Array, float] | None:
    """Follow a motion until it nearly repeats itself: a state (2 + m,) and a period; None where it does not."""

    def follow(span: float) -> Simulation:
        return simulate(system, psi, start, (0.0, span), eps=eps, rtol=rtol)

    period = forcing_period(system)
    if period is not None:
        span = period * max(SETTLING_PERIODS, round(t_end / period))
        run = follow(span)
        clocks = [False, False, *(bool(row.constant) for row in field(system).rows[2:])]
        state = np.where(clocks, start, run.states[-1])
        return (state, period) if run.times[-1] == span else None
    if any(row.constant for row in field(system).rows[2:]):
        return None
    run = follow(t_end)
    if run.times[-1] < t_end:
        return None
    times = np.linspace(0.5 * t_end, t_end, SAMPLES)
    states = run.dense(times)
    away = np.linalg.norm((states - states[-1]) / (np.ptp(states, axis=0) + 1e-300), axis=1)
    left = np.flatnonzero(away > 10.0 * RETURN_DISTANCE)  # where it was last far away, and before that near again
    near = np.flatnonzero(away[: left[-1]] < RETURN_DISTANCE) if len(left) else left
    if not len(near):
        return None
    back = near[-1]
    while back and away[back - 1] < away[back]:
        back -= 1
    return states[-1], float(times[-1] - times[back])
