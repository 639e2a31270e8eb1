"""How well trajectories are drawn: within a quarter of a pixel, with few points."""

from functools import cache

import numpy as np
import pytest

from codim2_core import psi
from codim2_core.portrait.orbits.trajectories import Status, trajectories
from codim2_core.systems.elinear import ELinear
from tests.core.polylines import away

from .seeds import CASE_I, PIXEL, ring, sunflower

SEEDS = np.concatenate([sunflower(8), ring(4, 1.6)])


def fewest(fine, tolerance):
    """Points that greedy simplification keeps of a fine curve."""
    kept, i = 1, 0
    while i < len(fine) - 1:
        low, high = i + 1, len(fine) - 1
        while low < high:
            j = (low + high + 1) // 2
            low, high = (j, high) if away(fine[i : j + 1], fine[[i, j]]).max() <= tolerance else (low, j - 1)
        i, kept = low, kept + 1
    return kept


@pytest.fixture(scope="module")
def exact():
    """Exact curves from the same seeds, and how few points draw them: the same at each tolerance."""

    @cache
    def found(system, p):
        curves = trajectories(system, p, SEEDS, rtol=1e-12, atol=1e-12, capture=1e-6, t_max=5.0, pixel=PIXEL / 100)
        return curves.points, sum(fewest(curve, 0.25 * PIXEL) for curve in curves.points)

    return found


@pytest.mark.parametrize("p", [psi.constant(), psi.tanh(), psi.hill(20.0)], ids=str)
@pytest.mark.parametrize("system", [CASE_I, ELinear(0.3, 2.0, -0.1, (0.3, 0.4)), ELinear(-2.0, 4.0, 1.0, (1.0, 0.0))])
@pytest.mark.parametrize("rtol", [1e-6, 1e-9])
def test_lines_are_within_a_quarter_pixel_with_few_points(system, p, rtol, exact):
    drawn = trajectories(system, p, SEEDS, rtol=rtol, atol=rtol, capture=1e-6, t_max=5.0)
    curves, needed = exact(system, p)
    for line, curve in zip(drawn.points, curves, strict=True):
        assert away(curve, line).max() <= 0.25 * PIXEL
    assert len(drawn.buffer) <= 1.5 * needed


def test_a_straight_leg_has_few_points():
    result = trajectories(ELinear(-1.0, 0.0, -1.0, (0.3, 0.0)), psi.constant(), [(0.9, 0.0), (1.9, 0.0)], rtol=1e-12)
    assert max(map(len, result.points)) <= 12


def test_a_cycle_is_drawn_to_its_length_and_not_for_ever():
    around = ELinear(0.0, 1.0, 0.0)  # the equator's neighbours turn for ever
    (line,) = trajectories(around, psi.constant(), [(0.5, 0.0)], t_max=1e3, length=10.0).points
    drawn = np.hypot(*np.diff(line, axis=0).T).sum()
    result = trajectories(around, psi.constant(), [(0.5, 0.0)], t_max=1e3, length=10.0)
    assert result.status == (Status.LENGTH,)
    assert 10.0 <= drawn < 12.0
    with pytest.raises(ValueError, match="positive length"):
        trajectories(around, psi.constant(), [(0.5, 0.0)], length=0.0)
