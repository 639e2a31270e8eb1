"""The nonsmooth limit: closed forms, quadratures, and the regularised system as eps goes to 0."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from codim2_core import ELinear, System, examples
from codim2_core import psi as families
from codim2_core.motion.result import SimulationStatus
from codim2_core.motion.simulate import simulate_nonsmooth
from tests.core.ways import WAYS, follow

G = 9.81
CASE_3 = ELinear(172.0, 186.0, -200.0, ("-172*z", "-186*z"), B=((0.5, 0.0),))  # C at e = (z, 0), z' = e_1/2
ARRIVING = (8.5e-4, 5.2e-4)  # (x, y) from which it comes to Sigma along Q1, and onto C or its cycle


def kinds(run):
    return [phase.kind for phase in run.phases]


@settings(max_examples=10, deadline=None)
@given(st.floats(0.05, 1.0), st.floats(0.1, 10.0), st.floats(-3.0, 3.0))
def test_textbook_ball(mu, v0, direction):
    c, s = math.cos(direction), math.sin(direction)
    slips = 2.0 * v0 / (7.0 * mu * G)
    run = simulate_nonsmooth(examples.ball_in_pool(K=0.0, mu=mu), (v0 * c, v0 * s, v0 * c, v0 * s), (0.0, 2.0 * slips))
    assert kinds(run) == ["slip", "slide"]
    assert run.phases[0].t_end == pytest.approx(slips, rel=1e-9)
    np.testing.assert_allclose(run.states[-1], (0.0, 0.0, 5 / 7 * v0 * c, 5 / 7 * v0 * s), rtol=0.0, atol=1e-9 * v0)
    half = 0.5 * slips
    np.testing.assert_allclose(run.dense(half)[2:], (v0 - mu * G * half) * np.array([c, s]), rtol=0.0, atol=1e-9 * v0)


def test_ball_sticks_below_the_critical_speed_and_slips_above():
    ball, critical = examples.ball_in_pool(K=2.0), 7 * 0.2 * G / 4.0
    at = lambda speed: (0.0, 0.0, 0.6 * speed, 0.8 * speed)
    assert kinds(simulate_nonsmooth(ball, at(0.999 * critical), (0.0, 0.1))) == ["slide"]
    assert kinds(simulate_nonsmooth(ball, at(1.001 * critical), (0.0, 1e-4))) == ["slip"]
    # At the critical speed itself C lies on the equator and moves in.
    run = simulate_nonsmooth(ball, (0.0, 0.0, critical, 0.0), (0.0, 1.0))
    assert kinds(run) == ["slide"]
    assert run.states[-1, 2] == pytest.approx(critical * math.exp(-10 / 7), rel=1e-9)


@pytest.mark.parametrize(("f1", "after"), [(1, "slide"), ("1 - z", "slide"), ("1 + z", "slip")])
def test_in_a_line_a_critical_set_on_the_equator_is_slid_on_where_it_stays_or_moves_in(f1, after):
    moving = ELinear(-1.0, 0.0, -1.0, (f1, 0.0), B=((0.0, 0.0),), g=(1.0,))
    assert kinds(simulate_nonsmooth(moving, (0.0, 0.0, 0.0), (0.0, 0.2))) == [after]


def test_crossing_at_once_and_coming_back():
    run = simulate_nonsmooth(examples.ball_in_pool(K=2.0), (1.0, 0.0, 12.0, 0.0), (0.0, 3.0))
    assert kinds(run) == ["slip", "cross", "slip", "slide"]
    cross = run.phases[1]
    assert cross.t_start == cross.t_end == run.phases[0].t_end
    assert "crosses" in cross.reason
    # Leaving: z' = mu g - 2 z, x' = 7/2 mu g - 2 z from (0, z) on.
    z0, friction, t = run.dense(cross.t_end)[2], 0.2 * G, 1.0
    z = (z0 - friction / 2) * math.exp(-2 * t) + friction / 2
    np.testing.assert_allclose(
        run.dense(cross.t_end + t)[[0, 2]], [2.5 * friction * t + z - z0, z], rtol=0.0, atol=1e-9
    )


@pytest.mark.parametrize("way", WAYS)
def test_arrival_by_a_spiral(monkeypatch, way):
    follow(monkeypatch, way)
    # f = 0, a = d: rho' = a, theta' = b/rho.
    run = simulate_nonsmooth(ELinear(-0.3, 1.0, -0.3), (0.6, 0.8), (0.0, 5.0))
    assert run.phases[0].t_end == pytest.approx(1.0 / 0.3, abs=1e-10)
    assert kinds(run) == ["slip", "slide"]
    t = np.linspace(0.0, 3.0, 7)
    rho, theta = 1.0 - 0.3 * t, math.atan2(0.8, 0.6) - np.log(1.0 - 0.3 * t) / 0.3
    np.testing.assert_allclose(run.dense(t), (rho * np.array([np.cos(theta), np.sin(theta)])).T, rtol=0.0, atol=1e-8)


def test_sliding_ends_where_the_critical_set_reaches_the_equator():
    # x' = -c + z, z' = 1 along a line: slides until z = 1, and then x = (z - 1)^2/2.
    system = ELinear(-1.0, 0.0, -1.0, ("z", 0.0), g=(1.0,))
    run = simulate_nonsmooth(system, (0.0, 0.0, 0.25), (0.0, 2.0))
    assert kinds(run) == ["slide", "slip"]
    assert run.phases[0].t_end == pytest.approx(0.75, abs=1e-10)
    t = np.linspace(0.75, 2.0, 9)
    np.testing.assert_allclose(
        run.dense(t), np.stack([(t - 0.75) ** 2 / 2, 0 * t, 0.25 + t], axis=-1), rtol=0.0, atol=1e-10
    )


def test_block_slips_when_the_incline_leaves_the_friction_ellipse():
    run = simulate_nonsmooth(examples.tilting_block(), (0.3, 0.1, 0.1), (0.0, 12.0), rtol=1e-11)
    assert kinds(run) == ["slip", "slide", "slip"]
    steepest = math.atan(1.0 / math.hypot(math.cos(0.5) / 0.3, math.sin(0.5) / 0.6))
    assert run.phases[1].t_end == pytest.approx((steepest - 0.1) / 0.02, abs=1e-9)
    coarse = simulate_nonsmooth(examples.tilting_block(), (0.3, 0.1, 0.1), (0.0, 12.0), rtol=1e-8)
    np.testing.assert_allclose(coarse.states[-1], run.states[-1], rtol=1e-6)


FOLD = System(U=("c**2 - z", "-s"), W=("-1/2 + c/4",))


def test_sliding_ends_in_a_fold():
    # On C1, c = -sqrt(z): with u = sqrt(z), dt = 2 u du/(1/2 + u/4), and the fold is at u = 0.
    u = math.sqrt(0.3)
    run = simulate_nonsmooth(FOLD, (0.0, 0.0, 0.3), (0.0, 1.0), families.constant())
    assert kinds(run) == ["slide", "slip"]
    assert run.phases[0].t_end == pytest.approx(8.0 * (u - 2.0 * math.log(1.0 + u / 2.0)), abs=1e-9)
    assert "fold" in run.phases[1].reason
    # Then along theta = 0: z' = -1/4, x' = 1 - z.
    t = 1.0 - run.phases[0].t_end
    np.testing.assert_allclose(run.states[-1], (t + t * t / 8.0, 0.0, -t / 4.0), rtol=0.0, atol=1e-8)


@pytest.mark.parametrize(("U2", "kept"), [("-s", ["slide", "slip", "slide"]), ("-s + (c + 1/2)/9", ["slide", "slip"])])
def test_what_follows_a_fold_is_what_is_there_then_and_not_a_hundredth_of_the_time_later(U2, kept):
    """At z = 0 the set at c = -sqrt(-z) is gone and nothing is there; from z = 0.07 on another one attracts."""
    system = System(U=("z + c**2 - (1 + tanh(200*(z - 0.07)))*c", U2), W=("1",))
    run = simulate_nonsmooth(system, (0.0, 0.0, -0.09), (0.0, 10.0), families.constant())
    assert kinds(run)[: len(kept)] == kept
    if U2 == "-s":
        assert run.phases[1].t_start == pytest.approx(0.09, abs=1e-9)


def test_through_two_hopf_bifurcations_and_off_the_equator():
    run = simulate_nonsmooth(CASE_3, (*ARRIVING, 0.3), (0.0, 2.6), families.hill(3))
    assert [(phase.kind, phase.onto) for phase in run.phases] == [
        ("slip", None),
        ("slide", "C"),
        ("slide", "C"),  # delayed
        ("slide", "cycle 1"),
        ("slide", "C"),
        ("slip", None),
    ]
    # z = z0 exp(t/2) all along (prop:LC), to z = 1.
    t0 = run.phases[1].t_start
    z0, t = run.dense(t0)[2], np.array([0.5, 1.5, 2.2])
    np.testing.assert_allclose(run.dense(t0 + t)[:, 2], z0 * np.exp(0.5 * t), rtol=0.0, atol=1e-9)
    assert run.phases[4].t_end - t0 == pytest.approx(2.0 * math.log(1.0 / z0), abs=1e-9)


def stopped(system, state0, psi=None):
    run = simulate_nonsmooth(system, state0, (0.0, 5.0), psi)
    assert run.status is SimulationStatus.NOT_UNIQUE
    assert run.reason.startswith(run.status.value)
    assert len(run.reason) > len(run.status.value)
    return run


def test_stops_where_the_limit_is_not_unique():
    # Psi decides whether C attracts, and none was given.
    assert "give it" in stopped(CASE_3, (0.1, 0.0, 0.5)).reason
    # On Sigma two critical sets attract, and the middle is the saddle between them.
    both = examples.nonunique_sliding()
    assert "2 stable critical sets" in stopped(both, (0.0, 0.0, 0.1)).reason
    # C repels, and every direction leads away.
    assert stopped(ELinear(1.0, 0.0, 1.0), (0.0, 0.0)).times[-1] == 0.0
    # Spirals away from Sigma, at any phase.
    assert not stopped(ELinear(1.0, 3.0, 1.0), (0.0, 0.0)).phases
    # In Case I with a, d > 0 an approach along a repelling direction cannot choose a way out.
    assert "Σ" in stopped(ELinear(2.0, 0.0, 1.0, (0.0, 0.0)), (0.0, 0.0)).reason


def test_a_state_within_underflow_of_sigma_is_on_it():
    run = simulate_nonsmooth(examples.ball_in_pool(), (1e-290, 0.0, 1.0, 0.0), (0.0, 1.0))
    assert kinds(run) == ["slide"]


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_turn_close_to_sigma_is_no_arrival(side):
    # x' = -c, y' = s: x y is constant, and with x y = 1e-28 the motion turns 1e-14 from Sigma.
    run = simulate_nonsmooth(ELinear(-1.0, 0.0, 1.0), (1.0, side * 1e-28), (0.0, 3.0), families.constant())
    assert kinds(run) == ["slip"]
    assert 1e-16 < np.hypot(*run.states[:, :2].T).min() < 1e-13
    np.testing.assert_allclose(run.states[-1], (0.0, side * 2.0), rtol=0.0, atol=1e-9)
    near = simulate_nonsmooth(ELinear(-1.0, 0.0, 1.0), (1.0, side * 1e-4), (0.0, 3.0), rtol=1e-12)
    np.testing.assert_allclose(near.states[:, 0] * near.states[:, 1], side * 1e-4, rtol=1e-6)


def test_a_motion_in_a_line_that_comes_back_is_known_from_its_first_moment():
    """U1 = z - c, z' = -1 from z = 3/2: x = t/2 - t^2/2 leaves Sigma, and is there again at t = 1."""
    system = ELinear(-1.0, 0.0, -1.0, ("z", 0.0), g=(-1.0,))
    run = simulate_nonsmooth(system, (0.0, 0.0, 1.5), (0.0, 1.25), families.rational())
    assert [phase.kind for phase in run.phases] == ["slip", "slide"]
    assert run.phases[1].t_start == pytest.approx(1.0, abs=1e-9)
    t = np.array([1e-12, 1e-10, 1e-6, 0.25, 0.5, 0.9])
    np.testing.assert_allclose(run.dense(t)[:, 0], t / 2 - t * t / 2, rtol=1e-6)
    assert run.times[1] < 1e-6  # the first step away is short
