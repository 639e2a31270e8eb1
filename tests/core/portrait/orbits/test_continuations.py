"""Trajectories from limit directions: along the invariant manifold, to the critical set."""

import math

import numpy as np
import pytest

from codim2_core import psi
from codim2_core.portrait.orbits.trajectories import Status, continuation

from .seeds import CASE_I, only


def test_continuation_ends_on_the_critical_set():
    from codim2_core.portrait.layer_problem.equator import equator_equilibria

    equator = equator_equilibria(CASE_I)
    theta = equator.theta[equator.lambda_rho < 0.0]
    result = continuation(CASE_I, psi.rational(), theta, t_max=60.0)
    assert len(result) == len(theta)
    assert only(result) is Status.EQUILIBRIUM
    first = np.array([line[0] for line in result.points])
    assert np.abs(first - np.stack([np.cos(theta), np.sin(theta)], axis=-1)).max() < 1e-5
    with pytest.raises(ValueError, match="no limit direction"):
        continuation(CASE_I, psi.constant(), [theta[0] + 0.1])
    with pytest.raises(ValueError, match="lambda_rho"):
        continuation(CASE_I, psi.constant(), theta, backward=True)
    with pytest.raises(ValueError, match="finite"):
        continuation(CASE_I, psi.constant(), [math.nan])
