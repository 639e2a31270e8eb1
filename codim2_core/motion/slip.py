"""Slip of the nonsmooth system: from any state outside Sigma to Sigma or the end, and away from Sigma.

With e = (x, y)/|(x, y)| the field is as stiff near Sigma as the regularised one, and scaled in the same way: errors are
measured by rho, and a step goes 0.9 of the way to Sigma at most. Twelve or thirteen decades of rho later the rest of
the way is straight to within rounding, and the time of arrival is known to that.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..initial_value.compiled_phases import CompiledPhases
from ..initial_value.field import Field
from ..initial_value.line import InvariantLine
from ..numerics.growth import bounded
from ..numerics.radau import STAGES, Problem, Step, TooManyStepsError, steps
from ..words import say

Array = NDArray[np.float64]

ARRIVED = 1e-13  # of the largest rho of the phase
FIRST = 1e-2
START, SLOW_START = 1e-9, 1e-5  # first part of the time ahead, covered by an expansion at Sigma
TILT = 1e-6  # largest angle that this expansion may cover
NEWTON, FURTHEST = 6, 0.05  # steps to polish theta, and how far one may go
NEUTRAL = 1e-7  # of the size of U's slopes: lambda_rho counts as zero


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
        The scale of rho: it has arrived where rho is 1e-13 of that (or of a larger rho met on the way).
    compiled : CompiledPhases, optional
        Takes the steps instead.
    """
    taken: list[Step] = []
    rate = problem.F(state)
    largest = max(largest, math.hypot(state[0], state[1]))
    h = FIRST / float(np.max(np.abs(rate) / problem.scale(state))) if rate.any() else math.inf
    if compiled is None:
        ahead = bounded(problem, steps(problem, t, t_end, state, rtol, h, most))
    else:
        ahead = compiled.slip(t, t_end, state, h, most, largest)
    try:
        for step in ahead:
            taken.append(step)
            x, y = float(step.last[0]), float(step.last[1])
            rho = math.hypot(x, y)
            largest = max(largest, rho)
            if rho <= ARRIVED * largest:
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
    return Step(before.end, h, before.last, last, _polynomial(change))


def _polynomial(*terms: Array) -> Array:
    polynomial = np.zeros((len(terms[0]), STAGES))
    for k, term in enumerate(terms):
        polynomial[:, k] = term
    return polynomial


def leave(
    field: Field, theta: float, t: float, z: Array, t_end: float, line: InvariantLine | None = None
) -> Step | str:
    """Leave Sigma along a limit direction with lambda_rho > 0, or one whose lambda_rho just turns positive.

    Where lambda_rho > 0 the way out is the unstable manifold of Q in (rho, theta, z): rho = lambda_rho t + O(t^2), with
    theta - theta_Q linear in t. Where a critical set has just reached the equator at Q (fig:transcrit), lambda_rho
    grows from 0 as beta t, rho = beta t^2/2 + O(t^3), and theta follows Q(z).

    Parameters
    ----------
    field : Field
    theta : float
        Near a zero of Theta at z.
    t, t_end : float
    z : ndarray (m,)
    line : InvariantLine, optional
        The invariant line that the motion stays in.

    Returns
    -------
    Step, or str
        The first, short step; or why there is none, as a sentence.
    """
    slow = z.tolist()
    theta = _polished(field, theta, slow) if line is None else theta
    c, s = math.cos(theta), math.sin(theta)
    if line is not None:  # exactly
        c, s = (math.copysign(1.0, line.n[0] * c + line.n[1] * s) * line.n).tolist()
    u, v, *w = field.value(c, s, 0.0, 0.0, *slow)
    D = field.jacobian(c, s, 0.0, 0.0, slow)
    radial, angular, across = np.array([c, s]), np.array([-s, c]), D[:2, :2] @ np.array([-s, c])
    W = np.array(w)
    lambda_rho = c * u + s * v
    lambda_theta = float(angular @ across) - lambda_rho
    size = float(np.abs(D[:2, :2]).max()) + math.hypot(u, v)
    if lambda_theta >= 0.0 and line is None:
        return say("repels angularly", theta=theta)
    drift = D[:2, 4:] @ W
    ahead = t_end - t
    if lambda_rho > NEUTRAL * size:
        forced = 0.0 if line is not None else float(angular @ (drift + lambda_rho * (D[:2, 2:4] @ radial)))
        turning = forced / (lambda_rho - lambda_theta) if forced else 0.0
        h = START * ahead
        h = min(h, TILT / abs(turning)) if turning else h
        end = theta + turning * h
        n = radial if line is not None else np.array([math.cos(end), math.sin(end)])
        change = np.array([*(lambda_rho * h * n), *(W * h)])
        first = np.array([0.0, 0.0, *slow])
        return Step(t, h, first, first + change, _polynomial(change))
    # On the equator and on the critical set U = 0: lambda_rho and Theta both vanish.
    turning = 0.0 if line is not None else -float(angular @ drift) / lambda_theta
    beta = float(radial @ drift) + float(radial @ across) * turning
    if lambda_rho < -NEUTRAL * size or not beta > 0.0:
        return say("nothing leaves", theta=theta)
    h = SLOW_START * min(ahead, abs(lambda_theta or size) / beta)
    h = min(h, 1e-2 * math.sqrt(TILT) / abs(turning)) if turning else h
    end, rho = theta + turning * h, 0.5 * beta * h * h
    n = radial if line is not None else np.array([math.cos(end), math.sin(end)])
    bend = 0.5 * h * h * (D[2:, :2] @ angular * turning + D[2:, 4:] @ W)
    linear = np.array([0.0, 0.0, *(W * h)])
    square = np.array([*(rho * n), *bend])
    first = np.array([0.0, 0.0, *slow])
    return Step(t, h, first, first + linear + square, _polynomial(linear, square))


def _polished(field: Field, theta: float, slow: list[float]) -> float:
    """Return the zero of Theta near theta, by Newton's method."""
    angle = theta
    for _ in range(NEWTON):
        c, s = math.cos(angle), math.sin(angle)
        u, v = field.value(c, s, 0.0, 0.0, *slow)[:2]
        D = field.jacobian(c, s, 0.0, 0.0, slow)[:2, :2]
        rate = float(np.array([-s, c]) @ D @ np.array([-s, c])) - (c * u + s * v)
        change = (c * v - s * u) / rate if rate != 0.0 else math.nan
        if not abs(change) < FURTHEST:
            return theta
        angle -= change
    return angle
