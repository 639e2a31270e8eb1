"""Motions followed backwards: the past of a state runs forward, as far as the state tells it."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import codim2_core as c2

PSI = c2.psi.rational()
BALL = c2.examples.ball_in_pool()
TURNING = c2.ELinear(-1.0, 2.0, -0.5, (0.3, -0.2), [[0.5, -0.3]], [0.1])
CROSSING = c2.ELinear(-1.0, 0.3, -0.7, (2.0, 0.4), [[1.0, 0.0]], [0.2])


def to_and_fro(system, state, t, eps, **options):
    there = c2.simulate(system, PSI, state, (0.0, t), eps=eps, **options)
    return there, c2.simulate(system, PSI, there.states[-1], (t, 0.0), eps=eps, **options)


@pytest.mark.parametrize(
    ("system", "state", "t", "eps"),
    [
        (BALL, (1.0, 0.3, 1.0, 0.2), 0.1, 1e-3),
        (TURNING, (1.0, 0.5, 0.2), 0.6, 0.5),
        (CROSSING, (-0.6, 0.1, 0.0), 1.2, 0.2),
    ],
)
def test_a_past_is_the_motion_that_led_there(system, state, t, eps):
    there, past = to_and_fro(system, state, t, eps, rtol=1e-10)
    assert past.status is c2.SimulationStatus.T_END
    assert past.states[-1].tolist() == there.states[-1].tolist()
    assert (past.times[0], past.times[-1]) == (0.0, t)
    assert (np.diff(past.times) >= 0.0).all()
    assert past.states[0] == pytest.approx(state, abs=2e-6)
    when = np.linspace(0.0, t, 31)
    assert past.dense(when) == pytest.approx(there.dense(when), abs=2e-6)
    assert [phase.kind for phase in past.phases] == [phase.kind for phase in there.phases]


def test_a_past_against_another_method():
    """SciPy backwards, with e_Psi = (x, y)/sqrt(r^2 + eps^2 Psi(r^2/eps^2)) written out (eq:ePsi)."""
    eps, state = 0.7, np.array([0.4, -0.3, 0.2])
    at = TURNING.at()

    def rate(_, y):
        rho2 = y[:2] @ y[:2] + eps**2 * PSI(y[:2] @ y[:2] / eps**2)
        e = y[:2] / np.sqrt(rho2)
        return [*at.U(e), *at.W(e)]

    other = solve_ivp(rate, (1.0, 0.2), state, method="DOP853", rtol=1e-12, atol=1e-12).y[:, -1]
    past = c2.simulate(TURNING, PSI, state, (1.0, 0.2), eps=eps, rtol=1e-11)
    assert past.states[0] == pytest.approx(other, abs=1e-8)


def test_what_slides_has_forgotten_where_it_came_from():
    eps = 1e-3
    there, past = to_and_fro(BALL, (1.0, 0.3, 1.0, 0.2), 1.0, eps)
    assert [phase.kind for phase in there.phases] == ["slip", "slide"]
    assert past.status is c2.SimulationStatus.FORGOTTEN
    assert "forgets where it came from" in past.reason
    first = past.times[0]
    (C,) = c2.critical_sets(BALL, PSI, there.states[-1, 2:])
    fastest = np.abs(C.eigenvalues.real).max()  # in the fast time
    assert (1.0 - first) * fastest / eps == pytest.approx(np.log(1e-2 / 1e-8), rel=0.1)
    when = np.linspace(first, 1.0, 50)
    assert past.dense(when)[:, :2] == pytest.approx(there.dense(when)[:, :2], abs=0.02 * eps)
    assert past.states[-1].tolist() == there.states[-1].tolist()


def test_events_of_a_past_are_those_of_the_motion():
    height = lambda t, state: state[0] - 0.2 * np.cos(3.0 * t)
    for direction in (-1, 0, 1):
        watched = (c2.Event(height, direction),)
        there, past = to_and_fro(TURNING, (1.0, 0.5, 0.2), 3.0, 0.5, rtol=1e-11, events=watched)
        assert past.events[0] == pytest.approx(there.events[0], abs=1e-5)
        assert len(there.events[0]) or direction
    stopped = c2.simulate(
        TURNING, PSI, there.states[-1], (3.0, 0.0), eps=0.5, events=(c2.Event(height, 0, terminal=True),), rtol=1e-11
    )
    free = c2.simulate(TURNING, PSI, there.states[-1], (3.0, 0.0), eps=0.5, events=(height,), rtol=1e-11)
    assert stopped.status is c2.SimulationStatus.EVENT
    assert stopped.times[0] == pytest.approx(free.events[0][-1], abs=1e-9)
    assert stopped.events[0].tolist() == pytest.approx([stopped.times[0]])


def test_a_span_of_no_time_is_refused():
    with pytest.raises(ValueError, match="give two different finite times"):
        c2.simulate(TURNING, PSI, (1.0, 0.0, 0.0), (1.0, 1.0), eps=0.3)


def test_the_past_of_a_slip_is_the_slip():
    there = c2.simulate_nonsmooth(CROSSING, (-0.6, 0.1, 0.0), (0.0, 1.2))
    past = c2.simulate_nonsmooth(CROSSING, there.states[-1], (1.2, 0.0), events=(lambda t, y: y[0],))
    assert past.status is c2.SimulationStatus.T_END
    assert past.states[-1].tolist() == there.states[-1].tolist()
    when = np.linspace(0.0, 1.2, 20)
    assert past.dense(when) == pytest.approx(there.dense(when), abs=1e-8)
    assert past.phases[0].e(0.5) == pytest.approx(there.phases[0].e(0.5), abs=1e-8)
    assert past.events[0] == pytest.approx(
        c2.simulate_nonsmooth(CROSSING, (-0.6, 0.1, 0.0), (0.0, 1.2), events=(lambda t, y: y[0],)).events[0], abs=1e-8
    )
    assert past.variation("f1").last == pytest.approx(there.variation("f1").last, abs=1e-6)


def test_a_past_is_told_back_to_where_it_left_sigma():
    """U = e: it leaves Sigma at the time |x| ago, whatever was before."""
    away = c2.ELinear(1.0, 0.0, 1.0, (0.0, 0.0), [[0.0, 0.0]], [0.2])
    past = c2.simulate_nonsmooth(away, (0.3, 0.4, 1.0), (0.0, -9.0))
    assert past.status is c2.SimulationStatus.FORGOTTEN
    assert "It left Σ at t = −0.5" in past.reason
    assert [phase.kind for phase in past.phases] == ["slip"]
    assert past.times[0] == pytest.approx(-0.5, abs=1e-9)
    assert past.states[0] == pytest.approx([0.0, 0.0, 0.9], abs=1e-9)
    assert past.states[-1].tolist() == [0.3, 0.4, 1.0]
    assert past.dense(-0.25) == pytest.approx([0.15, 0.2, 0.95], abs=1e-9)


def test_on_sigma_there_is_no_one_past():
    with pytest.raises(ValueError, match="where motions meet"):
        c2.simulate_nonsmooth(BALL, (0.0, 0.0, 1.0, 0.2), (0.0, -1.0))
