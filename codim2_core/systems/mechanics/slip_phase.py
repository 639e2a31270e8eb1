"""One slip from a start until it stops, in log r and theta, in which nothing is stiff."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...results.arrays import Array
from ..elinear import ELinear
from ..typed import System

STOPPED = 30.0  # log of how much slower than at the start it is when it stops
MAX_TURNS = 1e4  # in turns of the time dt/r


class TooLongError(Exception):
    """A slip takes more evaluations than are allowed."""


@dataclass(frozen=True, eq=False)
class Slipping:
    """A slip: log r, theta and time over tau, dt = r dtau."""

    stop: float | None  # when it stops
    direction: float  # its angle then, or at the last time
    evaluations: int  # of U that it took
    _tau: Array
    _states: Array
    _dense: Any

    def at(self, times: Array) -> Array:
        """Return (x, y) (..., 2); 0 once it has stopped."""
        tau = np.interp(times, self._states[2], self._tau)
        for _ in range(8):  # Newton: dt/dtau = r
            log_r, _, t = self._dense(tau.ravel())[:3].reshape(3, *tau.shape)
            tau = np.clip(tau - (t - times) * np.exp(-log_r), self._tau[0], self._tau[-1])
        log_r, theta = self._dense(tau.ravel())[:2].reshape(2, *tau.shape)
        r = np.exp(log_r) if self.stop is None else np.where(times < self.stop, np.exp(log_r), 0.0)
        return np.stack([r * np.cos(theta), r * np.sin(theta)], axis=-1)


def integrate_slip(system: ELinear | System, start: ArrayLike, z: ArrayLike, times: Array, most: int) -> Slipping:
    """Follow the slip from a start at the first time until it stops, or until the last time.

    Raises TooLongError: It takes more than `most` evaluations.
    """
    from scipy.integrate import solve_ivp

    x, y = (float(v) for v in np.asarray(start, float))
    slow = np.atleast_1d(np.asarray(z, float))
    still = system.at(tuple(slow)) if not len(slow) else None

    count = 0

    def rates(_tau: float, state: Array) -> Array:
        nonlocal count
        count += 1
        if count > most:
            raise TooLongError
        log_r, theta = state[:2]
        e = np.array([math.cos(theta), math.sin(theta)])
        at = system.at(tuple(state[3:])) if still is None else still
        U, r = at.U(e), math.exp(log_r)
        found = np.empty_like(state)
        found[0], found[1], found[2] = U @ e, e[0] * U[1] - e[1] * U[0], r
        if len(slow):
            found[3:] = r * np.asarray(at.W(e), float)
        return found

    first = math.log(math.hypot(x, y))
    over: Any = lambda _tau, state: state[2] - times[-1]
    slow_now: Any = lambda _tau, state: state[0] - first + STOPPED
    over.terminal = slow_now.terminal = True
    begin = np.array([first, math.atan2(y, x), times[0], *slow])
    run = solve_ivp(rates, (0.0, MAX_TURNS), begin, "DOP853", events=(over, slow_now), rtol=1e-10, atol=1e-12,
                    dense_output=True)  # fmt: skip
    stopped = bool(len(run.t_events[1]))
    return Slipping(float(run.y[2, -1]) if stopped else None, float(run.y[1, -1]), count, run.t, run.y, run.sol)
