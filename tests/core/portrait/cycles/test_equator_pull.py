"""Which orbits close to the equator it draws in: by hand, on equators of which all is known."""

import numpy as np
import pytest

from codim2_core import ELinear, psi
from codim2_core.portrait.cycles.ray_section import EquatorPull, equator_pull
from codim2_core.portrait.layer_problem.problem import LayerProblem

QUARTERS = 0.5 * np.pi * np.arange(4)


def field(first, radial):
    """Theta = sin 2 (theta - first), and lambda_rho."""

    def U(e):
        theta = np.arctan2(e[:, 1], e[:, 0])
        across = np.stack([-e[:, 1], e[:, 0]], axis=-1)
        return radial(theta)[:, None] * e + np.sin(2.0 * (theta - first))[:, None] * across

    return U


def states(theta):
    theta = np.asarray(theta)
    return np.stack([np.cos(theta), np.sin(theta), np.full(len(theta), 1e-12)], axis=-1)


# two in each quarter; of the quarters that run to direction 1 it is the first two
THETA = np.array([0.1, 1.4, 1.7, 3.0, 3.3, 4.6, 4.8, 6.2])


@pytest.mark.parametrize("first", [0.0, 0.4, 1.5])
@pytest.mark.parametrize("backward", [False, True])
def test_an_orbit_comes_to_the_next_equilibrium_on_its_way(first, backward):
    """Forward directions 1 and 3 attract along the equator, backward 0 and 2."""
    order = np.argsort((QUARTERS + first) % (2.0 * np.pi))
    theta = ((QUARTERS + first) % (2.0 * np.pi))[order]
    nobody = np.zeros(4, bool)
    one = (np.array([True, False, False, False]) if backward else np.array([False, True, False, False]))[order]
    pull = EquatorPull(theta, (nobody, one) if backward else (one, nobody), False)
    rate = -1.0 if backward else 1.0  # so that the direction draws the orbits in, in the time that runs
    drawn = (0, 1, 6, 7) if backward else (0, 1, 2, 3)
    found = pull.may_return(states(THETA + first), field(first, lambda theta: np.full_like(theta, rate)), backward)
    assert np.flatnonzero(~found).tolist() == list(drawn)
    # in the other time nothing draws
    assert pull.may_return(states(THETA), field(first, lambda theta: np.full_like(theta, rate)), not backward).all()


def test_of_a_saddle_the_directions_out_draw():
    """U = (x, -y): Theta = -sin 2 theta, lambda_rho = cos 2 theta; orbits above it run out along theta = 0 and pi."""
    at = ELinear(1.0, 0.0, -1.0).at()
    pull = equator_pull(at, LayerProblem(at, psi.constant()).location)
    assert pull.theta == pytest.approx(QUARTERS)
    assert pull.draws[0].tolist() == [True, False, True, False]
    assert pull.draws[1].tolist() == [False, True, False, True]
