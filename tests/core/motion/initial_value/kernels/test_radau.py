"""One step of Radau IIA: its stages are those of the collocation, and its error estimate is that of order 5."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from codim2_core.motion.initial_value.field import field
from codim2_core.motion.initial_value.kernels import radau
from codim2_core.motion.initial_value.kernels.radau import tableau_of, work_on
from codim2_core.motion.initial_value.motion_steps import numbers_of_tableau, rate_at

from .placing import CURVED, TANH, motion_of, placed

TABLE = tableau_of(numbers_of_tableau())
STATES = [(0.4, 0.3, 0.7, -0.2), (-0.02, 0.01, 1.3, 0.5)]


@pytest.mark.parametrize("y", STATES)
@pytest.mark.parametrize("eps", [0.3, 1e-3])
def test_its_stages_solve_the_collocation_and_its_end_is_as_near_as_it_says(y, eps):
    rate = lambda state: rate_at(field(CURVED), TANH, eps, None, state)
    told = []
    for rtol in (1e-3, 1e-6):
        for h in math.hypot(y[0], y[1], eps) * np.array([0.03, 0.3, 1.0, 4.0, 30.0]):
            state, work, clock = np.array(y), work_on(placed(CURVED, ()), 4), np.zeros(4)
            motion = motion_of(CURVED, TANH, eps, rtol)
            radau.linearise(motion, state, h, clock, work)
            accepted, _ = radau.attempt(motion, TABLE, state, h, 0.0, False, clock, work)
            told.append(bool(accepted))
            if not accepted:
                continue
            Z, end, polynomial = work.Z.copy(), np.empty(4), np.empty((4, 7))
            increments = h * TABLE.A @ np.array([rate(np.array(y) + stage) for stage in Z])
            np.testing.assert_allclose(Z / work.size, increments / work.size, atol=3e-2 * rtol)
            radau.keep(TABLE, state, work, polynomial, end)
            np.testing.assert_array_equal(state, end)
            for node, stage in zip(TABLE.nodes, Z, strict=True):
                np.testing.assert_allclose(polynomial @ node ** np.arange(1, 8), stage, atol=1e-12)
            exact = solve_ivp(lambda _, state: rate(state), (0.0, h), y, "LSODA", rtol=1e-9, atol=1e-12).y[:, -1]
            np.testing.assert_allclose(end / work.size, exact / work.size, atol=3.0 * rtol)
    assert set(told) == {False, True}
