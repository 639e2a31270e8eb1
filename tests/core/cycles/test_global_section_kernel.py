"""The compiled return map, on orbits whose returns are known."""

import math

import numpy as np
import pytest

from codim2_core.cycles.global_section_kernel import OUTWARD, RETURNED, TO_CRITICAL_SET

from .spirals import SEVERAL, SPIRALS, Spiral, plane, sphere


@SPIRALS
@pytest.mark.parametrize("u", [(0.8, 0.6), (1.0, 0.0), (0.0, -1.0)])
def test_a_turn_takes_its_time_and_grows_as_it_must(growth, b, u):
    own = Spiral(growth, b, u)
    x2 = np.geomspace(0.02, 20.0, SEVERAL)[:, None] * own.ray
    ends, times, codes, steps = own.returns(x2)
    period = 2.0 * math.pi / abs(b)
    assert (codes == RETURNED).all()
    np.testing.assert_allclose(times, period, rtol=1e-11)
    np.testing.assert_allclose(plane(ends), math.exp(growth * period) * x2, rtol=1e-10, atol=1e-12)
    assert len(steps) == 0
    # on the section to a few roundings
    U = ends[:, :2] @ np.array([[growth, -b], [b, growth]]).T
    np.testing.assert_allclose(U @ own.u / np.hypot(*U.T), 0.0, atol=2e-15)


@SPIRALS
def test_from_elsewhere_it_is_the_first_crossing(growth, b):
    own = Spiral(growth, b)
    before = np.linspace(0.05, 0.99, SEVERAL)  # of a turn, until the section comes
    T = before * 2.0 * math.pi / abs(b)
    x2 = own.at(np.geomspace(0.1, 5.0, SEVERAL)[:, None] * own.ray, -T)
    ends, times, codes, _ = own.returns(x2, elsewhere=True)
    assert (codes == RETURNED).all()
    np.testing.assert_allclose(times, T, rtol=1e-10)
    np.testing.assert_allclose(plane(ends), own.at(x2, T), rtol=1e-10, atol=1e-12)


def test_onto_the_centre_and_onto_the_equator_it_does_not_return():
    for growth, expected in ((-5.0, TO_CRITICAL_SET), (5.0, OUTWARD)):
        own = Spiral(growth, 1.0)
        x2 = np.array([0.3, 0.8, 0.5])[:, None] * own.ray
        ends, times, codes, steps = own.returns(x2, floor=1e-3, sunk=1e-3, record=100)
        assert (codes == expected).all()
        np.testing.assert_allclose(plane(ends), own.at(x2, times), rtol=1e-9)
        if expected == TO_CRITICAL_SET:
            gone = np.hypot(*plane(ends).T) < 1e-3
            still = np.hypot(*plane(steps).T) >= 1e-3
        else:
            gone = ends[:, 2] < 1e-3 * sphere(x2)[:, 2]
            still = steps[:, 2] >= 1e-3 * steps[0, 2]
        assert gone.all()
        assert still.all()
        assert steps[:, 3].sum() == pytest.approx(times[0], rel=1e-14)


@pytest.mark.parametrize("u", [(0.8, 0.6), (1.0, 0.0), (0.0, -1.0), (-0.6, 0.8)])
@pytest.mark.parametrize("b", [1.0, -1.3])
@pytest.mark.parametrize("before", [0.3, 0.7, 1.05, 1.4])
def test_a_state_short_of_the_section_is_followed_for_the_whole_turn_after_it(u, b, before):
    """A crossing counts once U has pointed the other way: rounding may leave a state short of the section."""
    own = Spiral(-0.05, b, u)
    x2 = own.at(0.8 * own.ray[None, :], np.array([-before / abs(b)]))
    ends, times, codes, _ = own.returns(x2)
    assert codes[0] == RETURNED
    assert times[0] == pytest.approx((before + 2.0 * math.pi) / abs(b), rel=1e-10)
    np.testing.assert_allclose(plane(ends), own.at(x2, times), rtol=1e-10, atol=1e-12)


@pytest.mark.parametrize("follow", [Spiral.returns, Spiral.turns], ids=["return", "turn"])
def test_steps_are_as_long_as_the_tolerance_lets_them_be(follow):
    """A method of order 8: errors and tolerance go together, and a hundredth of it costs 78 % more steps."""
    own = Spiral(-0.2, 1.0)
    x2, errors = 0.7 * own.ray[None, :], []
    for rtol in (1e-6, 1e-8, 1e-10):
        ends, _, _, steps = follow(own, x2, rtol=rtol, record=200)
        errors.append(float(np.abs(plane(ends) - math.exp(-0.4 * math.pi) * x2).max()))
        assert errors[-1] < 3.0 * rtol
        assert len(steps) < 13 * (1e-6 / rtol) ** 0.125
    assert errors[0] > 1e-9
