"""Slip of the nonsmooth system: from any state outside Sigma to Sigma or the end, and away from Sigma.

With e = (x, y)/|(x, y)| the field is as stiff near Sigma as the regularised one, and scaled in the same way: errors are
measured by rho, and a step goes 0.9 of the way to Sigma at most. Twelve or thirteen decades of rho later the rest of
the way is straight to within rounding, and the time of arrival is known to that.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...arrays import Array
from ...initial_value.compiled_phases import CompiledPhases
from ...initial_value.departure import polynomial_of
from ...initial_value.problem import arrival_radius
from ...numerics.growth import until_blow_up
from ...numerics.radau import Problem, Step, TooManyStepsError, steps

FIRST_STEP_SHARE = 1e-2


@dataclass(frozen=True)
class Slip:
    """A slip.

    Attributes
    ----------
    taken : list of Step
    theta : float or None
        Angle at which it arrives at Sigma; None if it ends outside, at the end of the time span.
    stopped : TooManyStepsError or None
        Why it was given up before.
    """

    taken: list[Step]
    theta: float | None
    stopped: TooManyStepsError | None = None


def slip(
    problem: Problem,
    t: float,
    state: Array,
    t_end: float,
    rtol: float,
    most: int,
    largest: float,
    compiled: CompiledPhases | None = None,
) -> Slip:
    """Follow the nonsmooth system until it arrives at Sigma, or to the end of the time span.

    Parameters
    ----------
    problem : Problem
        `plane_problem` with eps = 0.
    t, t_end : float
    state : ndarray (2 + m,)
        With (x, y) != 0.
    rtol : float
    most : int
        Steps.
    largest : float
        The scale of rho: it has arrived where rho is `arrival_radius` of that (or of a larger rho met on the way).
    compiled : CompiledPhases, optional
        Takes the steps instead.
    """
    taken: list[Step] = []
    rate = problem.F(state)
    largest = max(largest, math.hypot(state[0], state[1]))
    h = FIRST_STEP_SHARE / float(np.max(np.abs(rate) / problem.scale(state))) if rate.any() else math.inf
    if compiled is None:
        ahead = until_blow_up(problem, steps(problem, t, t_end, state, rtol, h, most))
    else:
        ahead = compiled.slip(t, t_end, state, h, most, largest)
    try:
        for step in ahead:
            taken.append(step)
            x, y = float(step.last[0]), float(step.last[1])
            rho = math.hypot(x, y)
            largest = max(largest, rho)
            if rho <= arrival_radius(rtol) * largest:
                u, v = problem.F(step.last)[:2].tolist()
                inward = -(x * u + y * v) / rho
                if inward > 0.0 and step.end + rho / inward < t_end:
                    taken.append(_straight(problem, step, rho / inward))
                    return Slip(taken, math.atan2(y, x))
    except TooManyStepsError as error:
        return Slip(taken, None, error)
    return Slip(taken, None)


def _straight(problem: Problem, before: Step, h: float) -> Step:
    """Make the step that covers the rest of the way to Sigma."""
    change = h * problem.F(before.last)
    change[:2] = -before.last[:2]
    last = before.last + change
    last[:2] = 0.0
    return Step(before.end, h, before.last, last, polynomial_of(change))
