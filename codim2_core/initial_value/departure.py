"""The way out of Sigma along a limit direction: the expansion at Sigma that a first, short step is made of."""

from __future__ import annotations

import math

import numpy as np

from ..arrays import Array
from ..numerics.radau import STAGES, Step
from ..words import say
from .field import Field
from .line import InvariantLine

FAST_START, SLOW_START = (
    1e-9,
    1e-5,
)  # first part, of the time ahead or of the rates' own, covered by an expansion at Sigma
TILT = 1e-6  # largest angle that this expansion may cover
MAX_NEWTON, MAX_CORRECTION = 6, 0.05  # steps to polish theta, and how far one may go
NEUTRAL_RATE = 1e-7  # of the size of U's slopes: lambda_rho counts as zero


def polynomial_of(*terms: Array) -> Array:
    """Return a step's polynomial from its terms, from the linear one on."""
    polynomial = np.zeros((len(terms[0]), STAGES))
    for k, term in enumerate(terms):
        polynomial[:, k] = term
    return polynomial


def pace(rate: float, change: float) -> float:
    """Time in which a rate that changes at this rate becomes another; infinite where it stands, or does not change."""
    return abs(rate / change) if rate != 0.0 and change != 0.0 else math.inf


def norm(vector: Array) -> float:
    """Largest size of an entry; 0 of none."""
    return float(np.abs(vector).max(initial=0.0))


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
    theta = _polish_zero(field, theta, slow) if line is None else theta
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
    if lambda_rho > NEUTRAL_RATE * size:
        outward = drift + lambda_rho * (D[:2, 2:4] @ radial)
        forced = 0.0 if line is not None else float(angular @ outward)
        turning = forced / (lambda_rho - lambda_theta) if forced else 0.0
        bend = D[2:, 4:] @ W + D[2:, :2] @ angular * turning + D[2:, 2:4] @ radial * lambda_rho
        h = FAST_START * min(ahead, pace(lambda_rho, float(radial @ outward)), pace(norm(W), norm(bend)))
        h = min(h, TILT / abs(turning)) if turning else h
        end = theta + turning * h
        n = radial if line is not None else np.array([math.cos(end), math.sin(end)])
        change = np.array([*(lambda_rho * h * n), *(W * h)])
        first = np.array([0.0, 0.0, *slow])
        return Step(t, h, first, first + change, polynomial_of(change))
    # On the equator and on the critical set U = 0: lambda_rho and Theta both vanish.
    turning = 0.0 if line is not None else -float(angular @ drift) / lambda_theta
    beta = float(radial @ drift) + float(radial @ across) * turning
    if lambda_rho < -NEUTRAL_RATE * size or not beta > 0.0:
        return say("nothing leaves", theta=theta)
    h = SLOW_START * min(ahead, abs(lambda_theta or size) / beta)
    h = min(h, 1e-2 * math.sqrt(TILT) / abs(turning)) if turning else h
    end, rho = theta + turning * h, 0.5 * beta * h * h
    n = radial if line is not None else np.array([math.cos(end), math.sin(end)])
    bend = 0.5 * h * h * (D[2:, :2] @ angular * turning + D[2:, 4:] @ W)
    linear = np.array([0.0, 0.0, *(W * h)])
    square = np.array([*(rho * n), *bend])
    first = np.array([0.0, 0.0, *slow])
    return Step(t, h, first, first + linear + square, polynomial_of(linear, square))


def _polish_zero(field: Field, theta: float, slow: list[float]) -> float:
    """Return the zero of Theta near theta, by Newton's method."""
    angle = theta
    for _ in range(MAX_NEWTON):
        c, s = math.cos(angle), math.sin(angle)
        u, v = field.value(c, s, 0.0, 0.0, *slow)[:2]
        D = field.jacobian(c, s, 0.0, 0.0, slow)[:2, :2]
        rate = float(np.array([-s, c]) @ D @ np.array([-s, c])) - (c * u + s * v)
        change = (c * v - s * u) / rate if rate != 0.0 else math.nan
        if not abs(change) < MAX_CORRECTION:
            return theta
        angle -= change
    return angle
