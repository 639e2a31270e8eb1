"""The duration of drawn trajectories: until they have ended at the slowest attractor, in T (dT = dt/rho)."""

from __future__ import annotations

import math

import numpy as np

from ...systems.frozen import FrozenSystem
from ..layer_problem.critical import CriticalSet
from ..layer_problem.equator import EquatorEquilibria

MIN_DURATION = 40.0  # over the size of U: what is drawn in any case
MAX_DURATION = 1e9  # and at most: rates 1e-8 of the largest are 0 to differences (`stepping.events`)
ARRIVAL = 10.0  # over the slowest rate: e^-10 of the way is left, a hundredth of a pixel
STIFF = 60.0  # ratio of the rates at one equilibrium from which an explicit method is bound to the fast one for long


def is_stiff(equator: EquatorEquilibria, critical: tuple[CriticalSet, ...] = ()) -> bool:
    """Whether trajectories creep along a slow direction, at any equilibrium: another is `STIFF` times as fast."""
    rho, theta = abs(equator.lambda_rho), abs(equator.lambda_theta)
    if (np.maximum(rho, theta) > STIFF * np.minimum(rho, theta)).any():
        return True
    rates = [abs(C.eigenvalues.real) for C in critical if C.discriminant >= 0.0]
    return any(one.max() > STIFF * one.min() for one in rates)


def drawn_duration(at: FrozenSystem, equator: EquatorEquilibria, critical: tuple[CriticalSet, ...] = ()) -> float:
    """Longest time T of each half of a drawn trajectory.

    A trajectory ends at a node or focus in about ten times the reciprocal of its slowest rate, which may be any
    number of times the unit 1/max |U|: in Case III (Section 4.3.3) 60 times. Time in which there is nothing to see
    costs nothing: halves end when they arrive.

    Between `MIN_DURATION` and `MAX_DURATION` over the size of U; rates that would take longer are not waited for.
    """
    size = at.size or 1.0
    rates = np.minimum(abs(equator.lambda_rho), abs(equator.lambda_theta)).tolist()
    for C in critical:
        if C.kind != "saddle":
            # J is in the time of kappa_2, and dT = ebar dtau
            height = 1.0 / math.hypot(1.0, float(C.x2[0]), float(C.x2[1]))
            rates.append(float(abs(C.eigenvalues.real).min()) / height)
    needed = ARRIVAL / min([rate for rate in rates if rate > 0.0], default=math.inf)
    return min(max(MIN_DURATION / size, needed), MAX_DURATION / size)
