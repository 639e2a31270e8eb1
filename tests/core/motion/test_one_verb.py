"""`simulate` with eps = 0 is the limit; all functions of motions take their arguments in one order."""

import math

import numpy as np
import pytest

import codim2_core as c2

BALL = c2.examples.ball_in_pool(K=0.0)
START = (1.0, 0.0, 1.0, 0.0)


def same(one, other):
    return [phase.kind for phase in one.phases] == [phase.kind for phase in other.phases] and np.array_equal(
        one.states, other.states
    )


def test_eps_0_is_the_limit_with_or_without_psi():
    limit = c2.simulate_nonsmooth(BALL, START, (0.0, 0.5))
    assert same(c2.simulate(BALL, None, START, (0.0, 0.5), eps=0), limit)
    assert same(c2.simulate(BALL, START, (0.0, 0.5), eps=0), limit)
    assert same(c2.simulate(BALL, state0=START, t_span=(0.0, 0.5), eps=0), limit)
    with_psi = c2.simulate_nonsmooth(BALL, START, (0.0, 0.5), c2.psi.hill(3))
    assert same(c2.simulate(BALL, "hill:3", START, (0.0, 0.5), eps=0), with_psi)
    both = c2.simulate(BALL, None, [START, START], (0.0, 0.5), eps=0)
    assert len(both) == 2
    near = c2.simulate(BALL, c2.psi.constant(), START, (0.0, 0.5), eps=1e-6)
    assert np.abs(near.states[-1] - limit.states[-1]).max() < 1e-5


@pytest.mark.parametrize("eps", [1e-3, -1.0, 1e-20, math.nan])
def test_eps_above_0_wants_psi_and_a_size_that_is_allowed(eps):
    with pytest.raises(ValueError, match="eps is"):
        c2.simulate(BALL, None, START, (0.0, 0.5), eps=eps)
    if eps > 0.0:
        with pytest.raises(ValueError, match="stiction is"):
            c2.simulate(BALL, "constant", START, (0.0, 0.5), eps=1e-3, stiction=1.5)


def test_the_order_without_psi_is_read_too():
    mass = c2.System(
        U=("-z1 - mu*c + F*cos(w*z3)", "-z2 - mu*s + F*sin(w*z3)"), W=("x", "y", "1"),
        parameters={"mu": 0.3, "F": 0.5, "w": 2.0},
    )  # fmt: skip
    start = (0.3, 0.0, 0.0, -0.1, 0.0)
    found = c2.periodic_motion(mass, None, start, math.pi)
    assert np.array_equal(c2.periodic_motion(mass, start, math.pi).state0, found.state0)
    given = c2.periodic_motion(mass, start, math.pi, c2.psi.constant(), 1e-3)
    assert np.array_equal(given.state0, c2.periodic_motion(mass, "constant", start, math.pi, eps=1e-3).state0)
