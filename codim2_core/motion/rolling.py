"""The path and the turns of a ball along its motion, from the slip at its contact.

At the lowest point of a ball of radius R, which is at r, with the velocity v of its centre and the plane's own velocity
Omega k x r there, the slip is u = v + omega x (-R k) - Omega k x r. It gives omega but for its vertical part, which
friction at a point leaves as it is: omega x k = (v - u - Omega k x r)/R.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..results.arrays import Array
from ..systems.examples.example import Ball

#: Radius of a ball as a part of the way that it goes, where none is given: its rolling is then seen.
ROLLING_SHARE, MIN_ROLLING = 0.07, 1e-6


@dataclass(frozen=True, eq=False)
class Rolling:
    """A ball at the times of its motion; arrays are read-only."""

    centre: Array  # (k, 2) Where it is, m
    turns: Array  # (k, 4) How it is turned since the start: unit quaternions (w, x, y, z)
    radius: float  # m


def rolling(ball: Ball, times: ArrayLike, states: ArrayLike, rate: float = 0.0, radius: float | None = None) -> Rolling:
    """Follow a ball along its motion: times (k,), states (k, 2 + m)."""
    t, state = np.asarray(times, float), np.asarray(states, float)
    slip, velocity = state[:, :2], state[:, 2:4]
    dt = np.diff(t)[:, None]
    if ball.placed:
        centre = state[:, 4:6].copy()
    else:
        centre = np.concatenate([np.zeros((1, 2)), np.cumsum(0.5 * dt * (velocity[1:] + velocity[:-1]), axis=0)])
    if radius is None:
        radius = ROLLING_SHARE * max(float(np.ptp(centre, axis=0).max()), MIN_ROLLING)
    plane = rate * np.column_stack([-centre[:, 1], centre[:, 0]])
    across = (velocity - slip - plane) / radius  # omega x k = (omega_y, -omega_x)
    middle = 0.5 * dt * (across[1:] + across[:-1])
    turns = np.zeros((len(t), 4))
    turns[0, 0] = 1.0
    for i, (y, minus_x) in enumerate(middle.tolist()):
        turns[i + 1] = _compose(_turn(-minus_x, y), turns[i])
    for array in (centre, turns):
        array.flags.writeable = False
    return Rolling(centre, turns, radius)


def _turn(x: float, y: float) -> tuple[float, float, float, float]:
    """Return the turn about (x, y, 0) by its length."""
    angle = float(np.hypot(x, y))
    share = 0.5 * float(np.sinc(angle / (2.0 * np.pi)))  # sin(angle/2)/angle
    return float(np.cos(0.5 * angle)), share * x, share * y, 0.0


def _compose(second: tuple[float, float, float, float], first: Array) -> tuple[float, float, float, float]:
    """Return the turn that does the first, then the second."""
    a, b, c, d = second
    e, f, g, h = first.tolist()
    return (
        a * e - b * f - c * g - d * h,
        a * f + b * e + c * h - d * g,
        a * g - b * h + c * e + d * f,
        a * h + b * g - c * f + d * e,
    )
