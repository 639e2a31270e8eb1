"""The compiled first turn, on orbits whose turns are known."""

import math

import numpy as np
import pytest

from codim2_core.cycles.return_map import INWARD, OUTWARD, RETURNED, UNDECIDED

from .spirals import SEVERAL, SPIRALS, Spiral, followed, parameters, plane, sphere, turned


def swept(points, centre=(0.0, 0.0)):
    """Angles about a point from each of a row of points to the next."""
    angle = np.arctan2(*(points - np.array(centre)).T[::-1])
    return np.remainder(np.diff(angle) + math.pi, 2.0 * math.pi) - math.pi


@SPIRALS
def test_a_turn_about_the_critical_set_takes_its_time(growth, b):
    own = Spiral(growth, b)
    x2 = turned(np.geomspace(0.02, 20.0, SEVERAL)[:, None] * own.ray, np.linspace(0.0, 6.0, SEVERAL))
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
        assert codes[0] == UNDECIDED
        assert 30.0 <= times[0] < 30.0 + steps[-1, 3] + 1e-12
        np.testing.assert_allclose(ends[0, :2], turned(begin[0, :2], b * times[0]), rtol=0.0, atol=1e-9)


def test_onto_the_point_and_onto_the_equator_there_is_no_turn():
    for growth, expected in ((-5.0, INWARD), (5.0, OUTWARD)):
        own = Spiral(growth, 1.0)
        x2 = np.array([0.3, 0.8, 0.5])[:, None] * own.ray
        ends, times, codes, steps = followed(sphere(x2), own.shared, floor=1e-3, sunk=1e-3, record=100)
        assert (codes == expected).all()
        np.testing.assert_allclose(plane(ends), own.at(x2, times), rtol=1e-9)
        if expected == INWARD:
            gone, still = np.hypot(*ends[:, :2].T) < 1e-3, np.hypot(*steps[:, :2].T) >= 1e-3
        else:
            gone, still = ends[:, 2] < 1e-3 * sphere(x2)[:, 2], steps[:, 2] >= 1e-3 * steps[0, 2]
        assert gone.all()
        assert still.all()
        assert steps[:, 3].sum() == pytest.approx(times[0], rel=1e-14)


def test_it_is_the_distance_from_the_point_that_counts():
    """Onto the node at the origin, past a point that is no critical set; and about the node's own place."""
    shared = parameters(-1.0, 0.0, -2.0)
    begin = sphere(np.array([(0.8, 0.3)]))
    for centre, floor, expected in (((0.3, 0.05), 0.05, INWARD), ((0.3, 0.2), 0.01, UNDECIDED)):
        ends, _, codes, steps = followed(begin, shared, centre, floor=floor, record=200)
        away = np.hypot(*(np.concatenate([steps[:, :2], ends[:, :2]]) - np.array(centre)).T)
        assert codes[0] == expected
        assert (away[:-1] >= floor).all()
        assert (away[-1] < floor) == (expected == INWARD)


@pytest.mark.parametrize("rtol", [1e-8, 1e-10])
@pytest.mark.parametrize("growth", [-1.0, 1.0])
def test_an_orbit_that_has_come_to_rest_is_not_followed_on(growth, rtol):
    """At a node beside the point, or on the equator: the speed has fallen to the noise of the tolerance."""
    shared, begin = parameters(growth, 0.0, growth), sphere(np.array([(0.8, 0.3)]))
    ends, times, codes, steps = followed(begin, shared, (0.3, 0.2), sunk=1e-30, rtol=rtol, record=300)
    states = np.concatenate([steps[:, :3], ends])
    speed = np.hypot(*states[:, :2].T) * states[:, 2]  # of r' = r w^2 and w' = -r^2 w together, against time as well
    assert codes[0] == UNDECIDED
    assert speed[-1] < 3.0 * rtol
    assert (speed[:-1] >= 3.0 * rtol).all()
    assert times[0] < 2.0 * math.log(1.0 / rtol)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_past_a_point_very_near_no_step_sweeps_most_of_a_turn(side):
    """An orbit that grazes the point sweeps all of a half turn there, on the side on which it passes."""
    x2, gap = np.array([(0.8, 0.3)]), -side * 1e-5  # to the right of it, it sees the orbit go round clockwise
    shared = parameters(-1.0, 0.0, -1.0)  # straight to the origin
    begin = sphere(x2)
    p = 0.5 * begin[0, :2]
    centre = p + gap * turned(p, 0.5 * math.pi) / np.hypot(*p)
    ends, times, codes, steps = followed(begin, shared, centre, rtol=1e-6, record=300)
    angles = swept(np.concatenate([steps[:, :2], ends[:, :2]]), centre)
    assert codes[0] == UNDECIDED
    assert np.abs(angles).max() <= 2.0
    assert angles.sum() == pytest.approx(math.pi * side, abs=1e-3)
    np.testing.assert_allclose(plane(ends), x2 * math.exp(-times[0]), rtol=0.0, atol=1e-5)


def test_at_the_limit_of_steps_it_is_told_how_far_it_came():
    own = Spiral(0.0, 0.1)
    x2 = 0.5 * own.ray[None, :]
    ends, times, _, steps = own.turns(x2, limit=4, record=100)
    assert times[0] == pytest.approx(steps[:, 3].sum(), rel=1e-14)
    np.testing.assert_allclose(plane(ends), own.at(x2, times), rtol=1e-10)
