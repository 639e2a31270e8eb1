"""The slow flow over a plane of z, and limit directions along z, against closed forms."""

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.portrait.sliding.along_z import directions_along, slow_plane

CRIT = 3.5 * 0.2 * c2.examples.GRAVITY  # of the ball with K = m = 1


def test_the_ball_slides_within_a_circle_of_its_plane():
    found = slow_plane(c2.examples.ball_in_pool(), c2.psi.constant(), ((-10.0, 10.0), (-6.0, 9.0)), count=9)
    net = [(z1, z2) for z2 in np.linspace(-6.0, 9.0, 9) for z1 in np.linspace(-10.0, 10.0, 9)]
    inside = [z for z in net if np.hypot(*z) < CRIT]
    np.testing.assert_allclose(found.z, inside)
    np.testing.assert_allclose(found.flow, -5.0 / 7.0 * found.z, rtol=0.0, atol=1e-12)
    assert found.stable.all()
    with pytest.raises(ValueError, match="m = 1"):
        slow_plane(c2.examples.nonunique_sliding(), c2.psi.constant(), ((0.0, 1.0), (0.0, 1.0)))


def test_limit_directions_along_z_are_those_at_each_z():
    system = c2.examples.nonunique_sliding()
    found = directions_along(system, (-1.0, 1.5), count=6)
    for z in np.linspace(-1.0, 1.5, 6):
        at = found.z == z
        limits = c2.equator_equilibria(system, (z,))
        np.testing.assert_allclose(found.theta[at], limits.theta, rtol=0.0, atol=1e-13)
        np.testing.assert_allclose(found.lambda_rho[at], limits.lambda_rho, rtol=0.0, atol=1e-13)
        np.testing.assert_allclose(found.lambda_theta[at], limits.lambda_theta, rtol=0.0, atol=1e-13)
    # Eight while chi^2 < 2, that is |z| < 2^(-1/4), and four beyond.
    assert [int((found.z == z).sum()) for z in np.linspace(-1.0, 1.5, 6)] == [4, 8, 8, 8, 4, 4]


def test_the_other_slow_variables_keep_their_values():
    system = c2.ELinear(
        -1.0, 0.5, "-1 - z3**2", ("z1/2", "z2/4"), B=((1.0, 0.0), (0.0, 1.0), (2.0, 0.0)), g=(0.0, "z3", 1.0)
    )
    found = slow_plane(system, c2.psi.constant(), ((-3.0, 3.0), (-2.0, 2.0)), rest=(0.7,), count=4)
    net = [(z1, z2, 0.7) for z2 in np.linspace(-2.0, 2.0, 4) for z1 in np.linspace(-3.0, 3.0, 4)]
    flows = {z: c2.sliding_flow(system, z) for z in net}
    slides = [z for z, flow in flows.items() if flow is not None]
    assert 0 < len(slides) < len(net)
    np.testing.assert_array_equal(found.z, [z[:2] for z in slides])
    np.testing.assert_allclose(found.flow, [flows[z] for z in slides], rtol=0.0, atol=1e-14)
    saddle = slow_plane(
        c2.ELinear(1.0, 0.0, -1.0, g=("z2", "z1")), c2.psi.constant(), ((0.0, 1.0), (0.0, 1.0)), count=2
    )
    assert saddle.stable.tolist() == [False] * 4
