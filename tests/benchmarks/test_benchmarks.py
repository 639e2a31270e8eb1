"""The benchmarks' references and arithmetic; nothing timed is asserted."""

import numpy as np
import pytest

from .methods import ours
from .problems import condition, problems


@pytest.mark.parametrize("problem", problems(), ids=lambda problem: problem.name)
def test_trajectories_end_where_the_references_do(problem):
    error = np.abs(ours(problem)(1e-13) - problem.end).max()
    assert error < 2e-14 * (1.0 + condition(problem))
