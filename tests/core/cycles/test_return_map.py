"""The compiled return map, on orbits whose returns are known."""

import math

import numpy as np
import pytest

from codim2_core.cycles.return_map import INWARD, OUTWARD, RETURNED, UNDECIDED, reached
from codim2_core.stepping.layout import LANES

from .spirals import FIELD, SEVERAL, SPIRALS, Spiral, plane, sphere


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
    for growth, expected in ((-5.0, INWARD), (5.0, OUTWARD)):
        own = Spiral(growth, 1.0)
        x2 = np.array([0.3, 0.8, 0.5])[:, None] * own.ray
        ends, times, codes, steps = own.returns(x2, floor=1e-3, sunk=1e-3, record=100)
        assert (codes == expected).all()
        np.testing.assert_allclose(plane(ends), own.at(x2, times), rtol=1e-9)
        if expected == INWARD:
            gone = np.hypot(*plane(ends).T) < 1e-3
            still = np.hypot(*plane(steps).T) >= 1e-3
        else:
            gone = ends[:, 2] < 1e-3 * sphere(x2)[:, 2]
            still = steps[:, 2] >= 1e-3 * steps[0, 2]
        assert gone.all()
        assert still.all()
        assert steps[:, 3].sum() == pytest.approx(times[0], rel=1e-14)


def test_it_is_the_distance_from_the_centre_that_counts():
    e = np.array([0.3, -0.2])
    A = np.array([[-3.0, -1.0], [1.0, -3.0]])
    own = Spiral(-3.0, 1.0, f=tuple(-A @ e))
    centre = e / math.sqrt(1.0 - e @ e)  # Psi = 1: e = p
    near = centre + 0.03 * own.ray
    ends, _, codes, steps = own.returns(near[None, :], floor=1e-4, record=100, centre=centre)
    assert codes[0] == INWARD
    assert np.hypot(*(plane(ends)[0] - centre)) < 1e-4
    assert (np.hypot(*(plane(steps) - centre).T) >= 1e-4).all()


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


def test_a_single_step_of_any_length_stays_on_the_sphere():
    own = Spiral(-0.2, 1.0)
    begin = np.repeat(sphere(0.7 * own.ray[None, :]), SEVERAL, axis=0)
    for lengths, right in ((np.linspace(0.0, 0.2, SEVERAL), True), (np.linspace(1.0, 2.0, SEVERAL), False)):
        ends = reached(begin, lengths, own.shared[None], np.zeros(SEVERAL, np.intp), FIELD.address)
        away = np.abs(plane(ends) - own.at(0.7 * own.ray, lengths)).max()
        assert away < 1e-12 if right else away > 1e-9
        np.testing.assert_allclose(np.linalg.norm(ends, axis=1), 1.0, rtol=0.0, atol=5e-16)  # whatever its error


def test_each_turn_is_the_same_among_many_as_alone():
    """More than there are lanes, of which some return late, some never, and some are given up."""
    own = Spiral(0.3, 1.0)
    x2 = np.geomspace(1e-3, 50.0, 2 * LANES + 5)[:, None] * own.ray
    for limit in (2000, 14):
        ends, times, codes, steps = own.returns(x2, record=4000, limit=limit, sunk=0.3)
        for i in range(len(x2)):
            end, time, code, alone = own.returns(x2[i : i + 1], record=4000, limit=limit, sunk=0.3)
            np.testing.assert_array_equal(ends[i], end[0])
            assert (times[i], codes[i]) == (time[0], code[0])
            if i == 0:
                np.testing.assert_array_equal(steps, alone)
        assert set(codes.tolist()) == ({RETURNED, OUTWARD} if limit > 14 else {UNDECIDED})


def test_each_orbit_has_its_own_tolerance():
    own = Spiral(0.15, 1.3)
    x2 = np.geomspace(0.1, 5.0, SEVERAL)[:, None] * own.ray
    rtol = np.where(np.arange(SEVERAL) % 3 == 0, 1e-5, 1e-12)
    ends, times, codes, _ = own.returns(x2, rtol=rtol)
    assert (codes == RETURNED).all()
    for value in (1e-5, 1e-12):
        alone, time, _, _ = own.returns(x2, rtol=value)
        np.testing.assert_array_equal(ends[rtol == value], alone[rtol == value])
        np.testing.assert_array_equal(times[rtol == value], time[rtol == value])
    period = 2.0 * math.pi / 1.3
    off = np.abs(times / period - 1.0)
    assert off[rtol == 1e-12].max() < 1e-11 < 1e-9 < np.median(off[rtol == 1e-5])
