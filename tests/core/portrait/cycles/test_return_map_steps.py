"""What both compiled maps do in one lane, each held against what it is by definition."""

import math

import numpy as np
import pytest

from codim2_core.portrait.cycles import return_map_steps
from codim2_core.portrait.stepping.field_parameters import SHARED_SIZE
from codim2_core.portrait.stepping.layout import ERROR_3, ERROR_5, LANES, NEW

LANE = 2


def filled():
    """A workspace in which no two numbers are alike, and its parameters."""
    S, P = return_map_steps.workspace(np.arange(1.0, SHARED_SIZE + 1.0))
    S[:] = np.random.default_rng(1).uniform(0.5, 1.5, len(S))
    return S, P


def at(row, lane=LANE):
    """Where a lane's three components lie."""
    return row + lane + LANES * np.arange(3)


@pytest.mark.parametrize("height", [1.0, -0.7, 1e-6])
def test_an_error_is_that_of_the_method_in_units_of_what_is_allowed(height):
    """Hairer, Norsett and Wanner's: |e5|^2/sqrt(n (|e5|^2 + 0.01 |e3|^2)); of w it is relative."""
    S, _ = filled()
    S[at(NEW)[2]] = height
    for rtol in (1e-3, 1e-9):
        T = S.copy()
        unit = rtol * np.array([1.0, 1.0, abs(height)])
        five, three = (float(np.sum((S[at(row)] / unit) ** 2)) for row in (ERROR_5, ERROR_3))
        assert return_map_steps.step_error(T, LANE, rtol) == pytest.approx(
            five / math.sqrt(3 * (five + 0.01 * three)), rel=1e-12
        )
        np.testing.assert_allclose(T[at(NEW)], S[at(NEW)] / np.linalg.norm(S[at(NEW)]), rtol=1e-15)
    S[at(ERROR_5)] = S[at(ERROR_3)] = 0.0
    assert return_map_steps.step_error(S, LANE, 1e-9) == 0.0  # and not 0/0


def test_the_next_step_would_have_the_error_that_is_allowed_but_for_a_margin():
    """An error grows like the eighth power of the length; nothing grows beyond five times or falls below a fifth."""
    for error in (2e-6, 1e-4, 0.1, 1.0, 100.0, 1e4, 8e4, 1.5e5):  # the last ones: by a factor of 0.22, of 0.203
        factor = return_map_steps.growth(error)
        assert error * factor**8 == pytest.approx(0.43, rel=1e-2)  # 0.9^8
    assert return_map_steps.growth(1.0) < 1.0
    assert return_map_steps.growth(0.0) == 5.0
    for refused in (1e30, math.inf, math.nan):
        assert return_map_steps.growth(refused) == 0.2
