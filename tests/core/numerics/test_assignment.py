"""Partners are those of SciPy's optimiser."""

import numpy as np
import pytest
from scipy.optimize import linear_sum_assignment

from codim2_core.numerics.assignment import assign


@pytest.mark.parametrize("n", range(8))
def test_the_sum_is_the_least(n):
    rng = np.random.default_rng(n)
    for k in range(40):
        size = (n, n + k % 3)
        cost = rng.uniform(size=size) if k % 2 else rng.integers(0, 5, size).astype(float)  # many are equal
        columns = assign(cost)
        assert len(set(columns)) == n
        assert cost[range(n), columns].sum() == pytest.approx(cost[linear_sum_assignment(cost)].sum(), abs=1e-14)
