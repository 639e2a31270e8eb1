"""The slow flow over a plane of z, and limit directions along z, against closed forms."""

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.sliding.over import directions_along, slow_plane

CRIT = 3.5 * 0.2 * c2.examples.GRAVITY  # of the ball with K = m = 1


def test_the_ball_slides_within_a_circle_of_its_plane():
    found = slow_plane(c2.examples.ball_in_pool(), c2.psi.constant(), ((-10.0, 10.0), (-6.0, 9.0)), count=9)
    net = [(z1, z2) for z2 in np.linspace(-6.0, 9.0, 9) for z1 in np.linspace(-10.0, 10.0, 9)]
    inside = [z for z in net if np.hypot(*z) < CRIT]
    np.testing.assert_allclose(found.z, inside)
    np.testing.assert_allclose(found.flow, -5.0 / 7.0 * found.z, atol=1e-12)
    assert found.stable.all()
    with pytest.raises(ValueError, match="m = 1"):
        slow_plane(c2.examples.nonunique_sliding(), c2.psi.constant(), ((0.0, 1.0), (0.0, 1.0)))


def test_limit_directions_along_z_are_those_at_each_z():
    system = c2.examples.nonunique_sliding()
    found = directions_along(system, (-1.0, 1.5), count=6)
    for z in np.linspace(-1.0, 1.5, 6):
        at = found.z == z
        limits = c2.equator_equilibria(system, (z,))
        np.testing.assert_array_equal(found.theta[at], limits.theta)
        np.testing.assert_array_equal(found.lambda_rho[at], limits.lambda_rho)
        np.testing.assert_array_equal(found.lambda_theta[at], limits.lambda_theta)
    # Eight while chi^2 < 2, that is |z| < 2^(-1/4), and four beyond.
    assert [int((found.z == z).sum()) for z in np.linspace(-1.0, 1.5, 6)] == [4, 8, 8, 8, 4, 4]
