"""How a ball turns: held against rolling without slip, spin on the spot, and the plane that turns under it."""

import numpy as np
import pytest

from codim2_core.motion.rolling import rolling
from codim2_core.systems.examples import Ball

ROLLS, PLACED = Ball(), Ball(placed=True)


def turn(axis, angle):
    axis = np.asarray(axis, float) / np.linalg.norm(axis)
    return np.array([np.cos(angle / 2), *(np.sin(angle / 2) * axis)])


def test_without_slip_it_turns_by_its_way_over_its_radius_about_the_axis_across():
    t = np.array([0.0, 0.3, 1.1, 2.0])
    states = np.tile([0.0, 0.0, 3.0, 4.0], (4, 1))
    found = rolling(ROLLS, t, states)
    np.testing.assert_allclose(found.centre, np.outer(t, [3, 4]), rtol=0.0, atol=1e-14)
    assert found.radius == pytest.approx(0.07 * 8)
    for when, quaternion in zip(t, found.turns, strict=True):
        np.testing.assert_allclose(quaternion, turn([-4, 3, 0], 5 * when / found.radius), rtol=0.0, atol=1e-12)


def test_slip_on_the_spot_spins_backwards():
    states = np.tile([0.5, 0.0, 0.0, 0.0], (2, 1))
    found = rolling(ROLLS, [0.0, 1.0], states, radius=0.25)
    # the lowest point moves along +x: the top along -x, a turn about -y
    np.testing.assert_allclose(found.turns[1], turn([0, -1, 0], 2.0), rtol=0.0, atol=1e-15)
    assert found.radius == 0.25


def test_a_ball_at_rest_on_a_turning_plane_spins_with_the_plane_under_it():
    """It does not slip: its lowest point goes with the plane, Omega k x r = (0, Omega r)."""
    states = np.tile([0.0, 0.0, 0.0, 0.0, 0.5, 0.0], (2, 1))
    found = rolling(PLACED, [0.0, 1.0], states, rate=3.0, radius=0.5)
    np.testing.assert_allclose(found.centre, [[0.5, 0.0]] * 2)
    # omega x (-R k) = (0, 1.5): omega = (1.5 / 0.5, 0, 0)
    np.testing.assert_allclose(found.turns[1], turn([1, 0, 0], 3.0), rtol=0.0, atol=1e-14)


def test_turns_follow_one_another_about_changing_axes():
    """Two quarter turns, first about y then about -x, are one of a third about (-1, 1, 1)/sqrt(3)... by hand."""
    quarter = np.pi / 2
    states = [[0, 0, quarter, 0], [0, 0, quarter, 0], [0, 0, 0, quarter], [0, 0, 0, quarter]]
    found = rolling(ROLLS, [0, 1, 1, 2], states, radius=1.0)
    h = 0.5  # (cos 45° - i sin 45°)(cos 45° + j sin 45°) = (1 - i + j - k)/2
    np.testing.assert_allclose(found.turns[-1], [h, -h, h, -h], rtol=0.0, atol=1e-14)
    np.testing.assert_allclose(np.linalg.norm(found.turns, axis=1), 1.0, rtol=0.0, atol=1e-14)
    assert not found.turns.flags.writeable
    assert not found.centre.flags.writeable
