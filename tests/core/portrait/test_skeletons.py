"""A random search for skeletons that contradict the index or the theorems (the long one is a benchmark)."""

import numpy as np
import pytest

from tests.core.skeletons import contradictions, random_psi, random_system


@pytest.mark.parametrize("case", ["I", "II", "III"])
def test_random_skeletons_contradict_nothing(case):
    rng = np.random.default_rng(20 + len(case))
    for _ in range(40):
        at, psi = random_system(rng, case), random_psi(rng)
        assert contradictions(at, psi) == [], (at, psi)
