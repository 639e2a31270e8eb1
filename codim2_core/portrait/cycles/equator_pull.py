"""Whether the equator draws orbits of the hemisphere that pass close to it onto itself, or lets them go."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...results.arrays import Array
from ...systems.frozen import FrozenSystem
from ..layer_problem.equator import equilibria_at
from ..layer_problem.location import Location

#: Fractions of the first ebar. Below the first an orbit is so close that the equator decides what becomes of it: it is
#: gone, or it comes back however near it passes (cycles of ordinary systems do at ebar = exp(-33)), down to the second.
EQUATOR_CAPTURE_HEIGHT, UNDERFLOW_HEIGHT = 1e-9, 1e-250
MIN_HEIGHT = 1e-290  # ebar: its reciprocal, |x2|, is finite


ON_THE_WAY = np.linspace(0.0, 1.0, 17)  # where lambda_rho is looked at between a direction and the next equilibrium


@dataclass(frozen=True)
class EquatorPull:
    """The first-order return map just above the equator.

    There theta turns as on the equator, and ``ebar' = -lambda_rho ebar`` (3.26): an orbit comes to the next
    equilibrium on its way, which draws it in where lambda_rho > 0; but first ebar grows where lambda_rho < 0. A closed
    equator draws none in within a turn, however strong.
    """

    theta: Array  # (k,) Equilibria on the equator, increasing
    # (ndarray, ndarray) Which of them attract from the hemisphere, or may: forward, and backward in time
    draws: tuple[NDArray[np.bool_], NDArray[np.bool_]]
    everywhere: bool  # each direction is an equilibrium, or an arc of them

    def may_return(self, states: Array, field: Callable[[Array], Array], backward: bool) -> NDArray[np.bool_]:
        """Say which orbits do not, or may not, come down to the equator for good.

        Shapes: states (n, 3).
        """
        draws, sign = self.draws[backward], -1.0 if backward else 1.0
        if self.everywhere or not draws.any():
            return np.full(len(states), not self.everywhere)
        theta = np.arctan2(states[:, 1], states[:, 0]) % math.tau
        U = sign * field(states[:, :2])
        onward = states[:, 0] * U[:, 1] > states[:, 1] * U[:, 0]
        ahead = np.searchsorted(self.theta, theta)
        end = np.where(onward, ahead, ahead - 1) % len(draws)
        way = np.where(onward, (self.theta[end] - theta) % math.tau, -((theta - self.theta[end]) % math.tau))
        passed = theta[:, None] + way[:, None] * ON_THE_WAY
        e = np.stack([np.cos(passed), np.sin(passed)], axis=-1)
        radial = sign * (e * field(e.reshape(-1, 2)).reshape(e.shape)).sum(axis=-1)
        return ~draws[end] | (radial < 0.0).any(axis=1)


def equator_pull(at: FrozenSystem, location: Location | None) -> EquatorPull:
    """Return the pull of the equator of a frozen system; `location` as in `equilibria_at`."""
    equator = equilibria_at(at, location)
    radial, turning = equator.lambda_rho, equator.lambda_theta
    draws = (radial >= 0.0) & (turning <= 0.0), (radial <= 0.0) & (turning >= 0.0)
    return EquatorPull(equator.theta, draws, equator.all_directions or len(equator.arcs) > 0)
