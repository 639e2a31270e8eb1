"""The variational equation of the regularised system, eps > 0."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from ...numerics.dense import Dense
from ...results.arrays import Array
from ...systems.kinds import AnySystem
from ...systems.psi.direction import smoothed_direction
from ...systems.psi.function import Psi
from ..initial_value.slopes import slopes_of
from .chain import chain_propagators, past_jumps
from .propagators import pad_jacobians, propagators, states_along
from .result import Variation

RTOL = 1e-10  # how far a part of a step and its halves may differ


def of_regularised(
    system: AnySystem, psi: Psi, eps: float, motion: Dense, jumps: Mapping[float, bool], names: Sequence[str]
) -> Variation:
    """Differentiate a motion by its start, and by numbers of its system."""
    slopes, states = slopes_of(system, names), motion.states

    def jacobian(steps: NDArray[np.intp], u: Array) -> Array:
        at = states_along(motion, steps, u)
        return pad_jacobians(slopes.of_state(*smoothed_direction(psi, eps, at[:, :2]), at), u.shape)

    rho = np.hypot(np.hypot(*states[:, :2].T), eps)
    sizes = np.ones((len(states), states.shape[1] + len(names)))
    sizes[:, :2] = rho[:, None]
    found = propagators(jacobian, motion.lengths, sizes, RTOL, np.diag(sizes[0]))
    rate = slopes.rates(smoothed_direction(psi, eps, states[-1:, :2])[0], states[-1:])[0]
    fine, coarse, reason = past_jumps(found.fine, found.coarse, motion.times, jumps, slopes)
    return chain_propagators(tuple(names), motion.times[: len(fine) + 1], fine, coarse, rate, reason)
