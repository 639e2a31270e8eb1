"""Motions of the full system at every stratum, for eps from 1e-14 to 1e3: finite, bounded, and with an invariant."""

import numpy as np
import pytest

from codim2_core import psi
from codim2_core.motion.result import SimulationStatus
from codim2_core.motion.simulate import simulate

from .strata import STRATA, system

FAMILIES = (psi.constant(), psi.rational(), psi.hill(3))
MOST_STEPS = 1500
EPS = (1e-14, 1e-9, 1e-4, 1.0, 1e3)


@pytest.mark.parametrize("stratum", STRATA, ids=lambda s: s.name)
@pytest.mark.parametrize("change", [0.0, 1e-12, -1e-2])
def test_motion(stratum, change):
    k = STRATA.index(stratum) + round(-np.log10(abs(change) or 1.0))
    plane = stratum.moved(stratum.paths.split()[0], change)
    largest = max(map(abs, plane)) or 1.0
    for state in ((0.4, -0.2, 0.0, 0.1), (0.0, 0.0, 1.0, 0.0)):
        found = simulate(
            system(plane), stratum.psi or FAMILIES[k % 3], state, (0.0, 2.0 / largest), eps=EPS[k % 5],
            rtol=1e-6, atol=1e-8, max_steps=MOST_STEPS,
        )  # fmt: skip
        assert np.isfinite(found.states).all()
        assert (np.diff(found.times) >= 0.0).all()
        assert found.states[0].tolist() == list(state)
        assert found.invariant < 1e-12
        # exactly on an unstable equilibrium the steps stay as short as the way out needs: the limit says so
        assert len(found.times) < MOST_STEPS or found.status is SimulationStatus.STEP_LIMIT
        assert found.evaluations < 100 * MOST_STEPS
        # speed is bounded: |U| <= |A| + |f|
        step = np.hypot(*(np.diff(found.states[:, :2], axis=0)).T)
        assert (step <= (4.0 * largest * np.diff(found.times)) * (1 + 1e-9) + 1e-9).all()
