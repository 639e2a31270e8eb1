"""Slip of the nonsmooth system: from any state outside Sigma to Sigma or the end, and away from Sigma.

With e = (x, y)/|(x, y)| the field is as stiff near Sigma as the regularised one, and scaled in the same way: errors are
measured by rho, and a step goes 0.9 of the way to Sigma at most. Twelve or thirteen decades of rho later the rest of
the way is straight to within rounding, and the time of arrival is known to that.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial

import numpy as np

from ...numerics.radau import STAGES, Step, TooManyStepsError
from ...results.arrays import Array
from ...results.words import say
from ...systems.psi.constructors import constant
from ..initial_value.field import Field
from ..initial_value.functions import functions_of
from ..initial_value.kernels import slow
from ..initial_value.kernels.motion import AT_SIGMA
from ..initial_value.kernels.slow import SET_PLACE, SLOPES, SLOW_EXTENT, VALUE
from ..initial_value.line import InvariantLine
from ..initial_value.motion_steps import Inspection, MotionSteps, rate_at


def polynomial_of(*terms: Array) -> Array:
    """Return a step's polynomial from its terms, from the linear one on."""
    polynomial = np.zeros((len(terms[0]), STAGES))
    for k, term in enumerate(terms):
        polynomial[:, k] = term
    return polynomial


def leave(
    field: Field, theta: float, t: float, z: Array, t_end: float, line: InvariantLine | None = None
) -> Step | str:
    """Return the first, short step away from Sigma along a limit direction, or why there is none, as a sentence."""
    functions, m = functions_of(field, constant()), len(z)
    S, linear, square = np.zeros(SLOW_EXTENT), np.zeros(2 + m), np.zeros(2 + m)
    functions.enter(S)
    S[VALUE : SLOPES + 1], S[SET_PLACE + 4 : SET_PLACE + 4 + m] = functions.addresses[:2].view(float), z
    n1, n2 = (0.0, 0.0) if line is None else line.vector
    h = float(slow.leave(S, m, n1, n2, theta, t_end - t, linear, square))
    if not h > 0.0:
        key = "repels angularly" if h == slow.REPELS_ANGULARLY else "nothing leaves"
        return say(key, theta=theta)
    first = np.concatenate([np.zeros(2), z])
    return Step(t, h, first, first + linear + square, polynomial_of(linear, square))


#: Of rtol, for the steps of a slip: explicit ones use up what is allowed, implicit ones leave most of it.
OF_SLIPS = 0.5


@dataclass(frozen=True)
class Slip:
    """A slip."""

    taken: list[Step]
    theta: float | None  # angle at which it arrives at Sigma; None if it ends outside, at the end of the time span
    evaluations: int
    stopped: TooManyStepsError | None = None  # why it was given up before
    switch: int | None = None  # the switch of the formulas at which it ends
    undecided: int = 0  # steps that could not be bounded
    leaves_line: bool = False  # it ends where a load pushes it out of its invariant line


def slip(
    field: Field,
    line: InvariantLine | None,
    span: tuple[float, float],
    state: Array,
    *,
    rtol: float,
    atol: float,
    most: int,
    largest: float,
    max_step: float,
) -> Slip:
    """Follow the nonsmooth system from a state (2 + m,) until it arrives at Sigma, or to the end of the time span."""
    rate, functions = partial(rate_at, field, None, 0.0, line), functions_of(field, constant())
    farthest = max(largest, math.hypot(state[0], state[1]))
    rtol, floor = OF_SLIPS * rtol, atol / rtol
    inspection = Inspection(field, None, 0.0, line, rtol, floor)
    options = {"farthest": farthest, "longest": max_step, "inspection": inspection}
    motion = MotionSteps(functions, rate, 0.0, line, span, state, rtol, floor, most, **options)
    taken: list[Step] = []
    try:
        for part in motion.chunks():
            taken += part
            if motion.code == AT_SIGMA:
                last = _straight(taken[-1], rate(taken[-1].last))
                if last is not None and last.end < span[1]:
                    x, y = last.first[:2].tolist()
                    return Slip([*taken, last], math.atan2(y, x), motion.evaluations, undecided=inspection.undecided)
    except TooManyStepsError as error:
        return Slip(taken, None, motion.evaluations, error)
    return Slip(taken, None, motion.evaluations, None, motion.switch, inspection.undecided, motion.leaves_line)


def _straight(before: Step, rate: Array) -> Step | None:
    """Make the step that covers the rest of the way to Sigma, None where it leads away from it."""
    at = before.last[:2]
    inward = -float(at @ rate[:2])
    if not inward > 0.0:
        return None
    h = float(at @ at) / inward
    change = np.concatenate([-at, h * rate[2:]])
    last = before.last + change
    last[:2] = 0.0
    return Step(before.end, h, before.last, last, polynomial_of(change))
