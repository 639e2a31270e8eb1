"""The regularised system: closed forms, independent integration, and every eps from 1e3 to 1e-12."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from codim2_core import ELinear, System, examples
from codim2_core import psi as families
from codim2_core.motion.result import MAX_POINTS, MIN_TIMES, SimulationStatus
from codim2_core.motion.simulate import simulate
from tests.core.strategies import coefficient, regularisations


def reference(system, psi, eps, state0, t_end):
    """The same motion by an explicit method of another kind, straight from the definitions."""

    def rate(_, state):
        xy, z = state[:2], tuple(state[2:])
        r = math.hypot(*xy)
        e = xy / math.sqrt(r * r + eps * eps * psi(r * r / (eps * eps)))
        at = system.at(z)
        return np.concatenate([at.U(e, xy), at.W(e, xy)])

    return solve_ivp(rate, (0.0, t_end), state0, method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]


@settings(max_examples=15, deadline=None)
@given(coefficient, coefficient, coefficient, coefficient, coefficient, regularisations, st.sampled_from((2.0, 0.3)))
def test_agrees_with_another_method(a, b, d, f1, f2, psi, eps):
    system = ELinear(a, b, d, (f1, "f2 + z"), B=((0.5, -1.0),), g=("1 - z",), parameters={"f2": f2})
    state0 = (0.4, -0.3, 0.2)
    run = simulate(system, psi, state0, (0.0, 1.0), eps=eps, rtol=1e-10, atol=1e-12)
    assert run.status is SimulationStatus.T_END
    np.testing.assert_allclose(run.states[-1], reference(system, psi, eps, state0, 1.0), rtol=1e-7, atol=1e-8)


@pytest.mark.parametrize("name", ["attracting_repelling", "nonunique_sliding", "unit_vector_control"])
def test_general_systems_agree_with_another_method(name):
    system = getattr(examples, name)()
    state0 = np.array([0.5, 0.4, *([0.3, -0.2][: system.m])])
    run = simulate(system, families.rational(), state0, (0.0, 2.0), eps=0.1, rtol=1e-11, atol=1e-13)
    np.testing.assert_allclose(
        run.states[-1], reference(system, families.rational(), 0.1, state0, 2.0), rtol=0.0, atol=1e-9
    )


@pytest.mark.parametrize("eps", [1e3, 1.0, 1e-4, 1e-12])
@pytest.mark.parametrize("state0", [(1.0, 0.5, -1.0, 0.4), (0.0, 0.0, 3.0, 1.0)])
def test_any_eps_without_choosing_a_method(eps, state0):
    run = simulate(examples.ball_in_pool(), families.hill(2), state0, (0.0, 3.0), eps=eps)
    assert run.status is SimulationStatus.T_END
    assert run.times[-1] == 3.0
    assert np.isfinite(run.states).all()
    assert (np.diff(run.times) >= 0.0).all()
    assert run.invariant < 1e-12
    if eps < 1e-2:  # it has come to Sigma, and rolls
        assert run.phases[-1].kind == "slide"
        assert np.hypot(*run.states[-1, :2]) < 20.0 * eps


def test_a_small_eps_costs_no_more_than_five_times_a_large_one():
    def work(eps):
        return simulate(
            examples.ball_in_pool(K=2.0), families.constant(), (-1.0, 0.3, 10.0, 0.0), (0.0, 4.0), eps=eps
        ).evaluations

    assert work(1e-10) < 5 * work(1e-3)


def test_dense_output_between_steps():
    system, psi, eps, state0 = examples.nonunique_sliding(), families.constant(), 0.05, (0.3, 0.2, 0.1)
    run = simulate(system, psi, state0, (0.0, 1.5), eps=eps, rtol=1e-10)
    for t in (0.123, 0.7, 1.234):
        np.testing.assert_allclose(run.dense(t), reference(system, psi, eps, state0, t), atol=1e-7)
    np.testing.assert_array_equal(run.dense(run.times), run.states)
    assert run.dense(np.zeros((2, 3))).shape == (2, 3, 3)
    with pytest.raises(ValueError, match="known for"):
        run.dense(1.6)


def test_an_unstable_critical_set_is_left_and_not_damped():
    # U = e: x2 = 0 repels at the rate 1/eps. L-stable steps longer than eps would hold the motion there.
    system, eps = ELinear(1.0, 0.0, 1.0), 1e-6
    run = simulate(system, families.constant(), (1e-12, 0.0), (0.0, 1.0), eps=eps)
    # It grows as exp(t/eps) up to x = eps, which takes some 14 eps, and then moves at speed 1.
    assert 1.0 - 20 * eps < run.states[-1, 0] < 1.0 - 10 * eps
    assert run.phases[-1].kind == "slip"


def test_a_limit_cycle_ends_at_the_step_limit():
    system = ELinear(172.0, 186.0, -200.0, (-86.0, -93.0), B=((0.5, 0.0),))
    run = simulate(system, families.hill(4), (5.5e-9, 0.0, 0.0), (0.0, 1.0), eps=1e-8, max_steps=300)
    assert run.status is SimulationStatus.STEP_LIMIT
    assert "limit cycle" in run.reason
    assert 0.0 < run.times[-1] < 1.0


def test_a_drawn_motion_is_even_in_time_and_of_bounded_length():
    run = simulate(ELinear(-1.0, 0.25, -1.75), families.rational(), (0.3, 0.2), (0.0, 5.0), eps=0.5)
    drawn = run.drawn()
    assert np.diff(drawn.times).max() <= 5.0 / (MIN_TIMES - 1) * (1.0 + 1e-9)
    assert (drawn.times[0], drawn.times[-1]) == (0.0, 5.0)
    assert len(drawn.times) <= MAX_POINTS
    np.testing.assert_allclose(drawn.states, run.dense(drawn.times))
    rho = np.hypot(np.hypot(*drawn.states[:, :2].T), 0.5)
    np.testing.assert_allclose(
        drawn.points, (drawn.states[:, :2] / rho[:, None]) * (1.0 + rho)[:, None], rtol=0.0, atol=1e-12
    )


@pytest.mark.parametrize("eps", [1e-14, 1e6])
def test_eps_goes_as_far_as_is_said(eps):
    still = System(U=("-c", "-s"), W=("1",))
    span = (0.0, 1e-3 * min(eps, 1.0))
    assert simulate(still, families.constant(), (0.3 * eps, 0.0, 0.0), span, eps=eps).times[-1] == span[1]
    beyond = eps * (1.1 if eps > 1.0 else 0.9)
    with pytest.raises(ValueError, match=r"1e-14 <= eps <= 1e\+06"):
        simulate(still, families.constant(), (0.3 * eps, 0.0, 0.0), span, eps=beyond)
