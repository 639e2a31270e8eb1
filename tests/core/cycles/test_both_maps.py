"""What the return map and the first turn have in common: their steps, their end, and lanes that do not meet."""

import math

import numpy as np
import pytest

from codim2_core.cycles.return_map import RETURNED, UNDECIDED, reached
from codim2_core.stepping.layout import LANES

from .spirals import FIELD, SEVERAL, Spiral, plane, sphere

BOTH = pytest.mark.parametrize("follow", [Spiral.returns, Spiral.turns], ids=["return", "turn"])


@BOTH
def test_the_steps_of_the_first_state_are_those_of_its_orbit(follow):
    own = Spiral(-0.2, 1.0)
    x2 = np.linspace(0.7, 0.3, SEVERAL)[:, None] * own.ray
    ends, times, _, steps = follow(own, x2, record=200)
    np.testing.assert_array_equal(steps[0, :3], sphere(x2)[0])
    np.testing.assert_allclose(steps[:, 3].sum(), times[0], rtol=1e-14)
    after = reached(
        steps[:, :3].copy(), steps[:, 3].copy(), own.shared[None], np.zeros(len(steps), np.intp), FIELD.address
    )
    np.testing.assert_allclose(after, [*steps[1:, :3], ends[0]], rtol=0.0, atol=5e-16)
    clock = np.concatenate([[0.0], np.cumsum(steps[:, 3])])
    np.testing.assert_allclose(plane(steps[:, :3]), own.at(x2[0], clock[:-1]), rtol=0.0, atol=1e-11)
    np.testing.assert_array_equal(follow(own, x2, record=3)[3], steps[:3])


@BOTH
def test_steps_are_as_long_as_the_tolerance_lets_them_be(follow):
    """A method of order 8: errors and tolerance go together, and a hundredth of it costs 78 % more steps."""
    own = Spiral(-0.2, 1.0)
    x2, period = 0.7 * own.ray[None, :], 2.0 * math.pi
    errors = []
    for rtol in (1e-6, 1e-8, 1e-10):
        ends, _, _, steps = follow(own, x2, rtol=rtol, record=200)
        errors.append(float(np.abs(plane(ends) - math.exp(-0.2 * period) * x2).max()))
        np.testing.assert_allclose(np.linalg.norm([*steps[:, :3], *ends], axis=1), 1.0, rtol=0.0, atol=5e-16)
        assert errors[-1] < 3.0 * rtol
        assert len(steps) < 13 * (1e-6 / rtol) ** 0.125
    assert errors[0] > 1e-9
    first = [follow(own, x2, rtol=rtol, record=1)[3][0, 3] for rtol in (1e-4, 1e-12)]
    assert first[0] == pytest.approx(10.0 * first[1], rel=1e-12)
    assert 0.1 < first[0] < 0.2


@pytest.mark.parametrize("rtol", [1e-5, 1e-8, 1e-12])
def test_both_take_the_same_steps(rtol):
    own = Spiral(-0.2, 1.0)
    x2 = 0.7 * own.ray[None, :]
    one, other = (follow(own, x2, rtol=rtol, record=200)[3] for follow in (Spiral.returns, Spiral.turns))
    assert len(one) == len(other) > 5
    # All but what is left of the turn: an error that is held to rtol is known to the share eps/rtol.
    np.testing.assert_allclose(other[:-1], one[:-1], rtol=np.finfo(float).eps / rtol)


@BOTH
def test_what_does_not_end_in_time_is_undecided(follow):
    own = Spiral(0.0, 0.1)
    x2 = 0.5 * own.ray[None, :]
    ends, times, codes, steps = follow(own, x2, t_max=20.0, record=100)
    assert codes[0] == UNDECIDED
    assert times[0] >= 20.0 > times[0] - steps[-1, 3]
    np.testing.assert_allclose(plane(ends), own.at(x2, times), rtol=1e-10)
    assert follow(own, x2, t_max=63.0)[2][0] == RETURNED  # 2 pi/0.1
    _, _, codes, steps = follow(own, x2, limit=4, record=100)
    assert (codes[0], len(steps)) == (UNDECIDED, 4)
    _, _, _, steps = follow(own, x2, limit=500, record=500)
    assert follow(own, x2, limit=len(steps) + 40)[2][0] == RETURNED  # as many again as finding the end may take


@BOTH
def test_lanes_do_not_disturb_each_other(follow):
    own = Spiral(-0.2, 1.0)
    x2 = np.linspace(0.1, 3.0, SEVERAL)[:, None] * own.ray
    together = follow(own, x2, rtol=1e-8)
    for i in (0, 1, LANES, SEVERAL - 1):
        alone = follow(own, x2[i : i + 1], rtol=1e-8)
        np.testing.assert_array_equal(alone[0][0], together[0][i])
        assert alone[1][0] == together[1][i]
