"""The compiled first turn, on orbits whose turns are known."""

import math

import numpy as np
import pytest

from codim2_core.portrait.cycles.ray_section_kernel import NO_RETURN_YET, RETURNED

from .spirals import SEVERAL, SPIRALS, Spiral, followed, parameters, plane, sphere, turned


def swept(points, centre=(0.0, 0.0)):
    """Angles about a point from each of a row of points to the next."""
    angle = np.arctan2(*(points - np.array(centre)).T[::-1])
    return np.remainder(np.diff(angle) + math.pi, 2.0 * math.pi) - math.pi


@SPIRALS
def test_a_turn_about_the_critical_set_takes_its_time(growth, b):
    own = Spiral(growth, b)
    x2 = turned(np.geomspace(0.02, 20.0, SEVERAL)[:, None] * np.array([0.8, 0.6]), np.linspace(0.0, 6.0, SEVERAL))
    ends, times, codes, steps = followed(sphere(x2), own.shared)
    period = 2.0 * math.pi / abs(b)
    assert (codes == RETURNED).all()
    assert len(steps) == 0
    np.testing.assert_allclose(times, period, rtol=1e-11)
    np.testing.assert_allclose(plane(ends), math.exp(growth * period) * x2, rtol=1e-10, atol=1e-12)
    away = swept(np.stack([ends[:, :2], sphere(x2)[:, :2]], axis=1).reshape(-1, 2))[::2]
    np.testing.assert_allclose(away, 0.0, atol=4e-15)  # on its ray to a few roundings


@pytest.mark.parametrize("b", [1.0, -0.7])
def test_a_turn_about_any_point_that_a_closed_orbit_surrounds(b):
    """Circles of radius r in the disc, at the rate b: a turn about a point inside is one period."""
    r = 0.6
    centres = np.array([(0.3, 0.2), (-0.5, 0.1), (0.55, -0.2), (0.0, 0.59)])
    begin = np.array([[r * math.cos(2.0), r * math.sin(2.0), 0.8]])
    for centre in centres:
        ends, times, codes, _ = followed(begin, parameters(0.0, b, 0.0), centre, floor=1e-3)
        assert codes[0] == RETURNED
        assert times[0] == pytest.approx(2.0 * math.pi / abs(b), rel=1e-10)
        np.testing.assert_allclose(ends, begin, rtol=0.0, atol=1e-10)
    for centre in ((0.7, 0.0), (0.0, -0.62)):
        ends, times, codes, steps = followed(begin, parameters(0.0, b, 0.0), centre, t_max=30.0, record=200)
        assert codes[0] == NO_RETURN_YET
        assert 30.0 <= times[0] < 30.0 + steps[-1, 3] + 1e-12
        np.testing.assert_allclose(ends[0, :2], turned(begin[0, :2], b * times[0]), rtol=0.0, atol=1e-9)


@SPIRALS
@pytest.mark.parametrize("goal", [0.3, 2.0, 5.5])
def test_a_part_of_a_turn_takes_its_part_of_the_time_in_the_one_sense_only(growth, b, goal):
    own = Spiral(growth, b)
    x2 = np.array([[0.4, 0.1], [-0.7, 0.9]])
    sense = 1 if b > 0.0 else -1
    ends, times, codes, _ = followed(sphere(x2), own.shared, goal=goal, sense=sense)
    assert (codes == RETURNED).all()
    np.testing.assert_allclose(times, goal / abs(b), rtol=1e-10)
    np.testing.assert_allclose(plane(ends), own.at(x2, times), rtol=1e-9, atol=1e-12)
    _, _, codes, _ = followed(sphere(x2), own.shared, goal=goal, sense=-sense, t_max=20.0)
    assert (codes != RETURNED).all()
