"""A motion is the same compiled and as Python, for every Psi, in a line too; and of many."""

import numpy as np
import pytest

from codim2_core import ELinear, Event, System, examples, simulate
from codim2_core import psi as families
from codim2_core.motion.initial_value.field import field
from codim2_core.motion.initial_value.functions import called_back
from codim2_core.motion.initial_value.motion_steps import MotionSteps, rate_at
from codim2_core.motion.result import SimulationStatus
from tests.core.ways import WAYS, follow

PSI = (
    families.constant(), families.rational(), families.exponential(), families.tanh(), families.hill(3),
    families.hill(2.5), families.custom("1/(1+s)**2"),
)  # fmt: skip
BALL = examples.ball_in_pool(K=2.0)


@pytest.mark.parametrize(("psi", "eps"), [*zip(PSI, [1e-1, 1e-5, 1e-11] * 3, strict=False), (PSI[1], 1e-11)])
def test_it_is_the_same_motion_in_all_ways(monkeypatch, psi, eps):
    state0, span, rtol = (-1.0, 0.3, 10.0, 0.0), (0.0, 3.0), 1e-9
    found = []
    for way in WAYS:
        with monkeypatch.context() as only:
            follow(only, way)
            found.append(simulate(BALL, psi, state0, span, eps=eps, rtol=rtol))
    own, *others = found
    assert own.invariant < 1e-12
    for other in others:
        np.testing.assert_allclose(other.states[-1], own.states[-1], rtol=1e-7, atol=1e-8)
        np.testing.assert_allclose(other.dense(1.234), own.dense(1.234), rtol=1e-6, atol=1e-8)
        assert abs(len(other.times) - len(own.times)) <= 2
        assert [phase.kind for phase in other.phases] == [phase.kind for phase in own.phases]


def test_what_python_raises_in_a_formula_comes_out():
    own = field(System(U=("-c", "-s"), W=("1",)))

    def stopped(*_):
        raise KeyboardInterrupt

    functions = called_back(1, stopped, own.slope)
    rate = lambda state: np.zeros(3)
    motion = MotionSteps(functions, rate, 1.0, None, (0.0, 1.0), np.zeros(3), 1e-6, 1.0, 100)
    with pytest.raises(KeyboardInterrupt):
        list(motion.chunks())
    functions.check()  # once


@pytest.mark.parametrize(
    ("psi", "eps"), [(families.constant(), 1e-1), (families.tanh(), 1e-3), (families.hill(3), 1e-6), (PSI[0], 1e-12)]
)
def test_a_slide_takes_few_steps_whatever_eps_and_tolerance(psi, eps):
    for rtol, most in ((1e-3, 80), (1e-6, 120), (1e-9, 260)):
        run = simulate(BALL, psi, (-1.0, 0.3, 10.0, 0.0), (0.0, 3.0), eps=eps, rtol=rtol)
        assert len(run.times) < most, (rtol, len(run.times))
        assert run.evaluations < 24 * most


def test_the_tenth_slide_takes_as_few_steps_as_the_first():
    """U has the period 2 pi in z = t: it slides twice in each."""
    pushed = ELinear(-1.0, 0.3, -2.0, f=("1.3*sin(z1)", "0.4*cos(2*z1)"), B=((0.0, 0.0),), g=(1.0,))
    ends = Event(lambda t, state: t - 37.0, terminal=True)
    for eps, rtol in ((1e-5, 1e-6), (1e-4, 1e-8)):
        run = simulate(pushed, families.tanh(), (0.3, 0.2, 0.0), (0.0, 1e5), eps=eps, rtol=rtol, events=ends)
        assert run.status is SimulationStatus.EVENT
        assert sum(phase.kind == "slide" for phase in run.phases) >= 10
        per_turn = np.histogram(run.times, 2.0 * np.pi * np.arange(6))[0]
        assert per_turn.max() < 1.6 * per_turn.min()


@pytest.mark.parametrize("eps", [1e-2, 1e-5])
def test_dense_output_of_all_steps_joins_and_solves_the_equations(eps):
    """Between the ends of steps, explicit or not, the slope of the curve is the rate at it."""
    psi = families.rational()
    motion = simulate(BALL, psi, (-1.0, 0.3, 10.0, 0.0), (0.0, 3.0), eps=eps, rtol=1e-9).motion
    rate = lambda state: rate_at(field(BALL), psi, eps, None, state)
    powers = np.arange(1, motion.polynomials.shape[2] + 1)
    for i, (h, coefficients) in enumerate(zip(motion.lengths, motion.polynomials, strict=True)):
        x, y, *z = motion.states[i]
        scale = np.array([np.hypot(np.hypot(x, y), eps)] * 2 + [abs(value) + 1.0 for value in z])
        np.testing.assert_allclose(motion.in_step(i, 1.0) / scale, motion.states[i + 1] / scale, atol=1e-13)
        if h < 10.0 * eps:  # in a slide the rate multiplies what is left of the tolerance
            for u in (0.0, 0.3, 0.8):
                slope = coefficients @ (powers * u ** (powers - 1)) / h
                np.testing.assert_allclose(h * slope / scale, h * rate(motion.in_step(i, u)) / scale, atol=1e-5)


@pytest.mark.parametrize("way", WAYS)
def test_as_many_slow_variables_as_there_may_be(monkeypatch, way):
    follow(monkeypatch, way)
    names = [f"z{i}" for i in range(1, 17)]
    system = System(U=("-c", "-s"), W=tuple(f"-{i}*{name}/8 + c" for i, name in enumerate(names, 1)))
    few = way == "as Python"  # a step of 18 numbers takes most of a second then
    end, rtol = (0.02, 1e-3) if few else (1.0, 1e-9)
    run = simulate(system, families.constant(), (0.0, 0.0, *[1.0] * 16), (0.0, end), eps=1e-3, rtol=rtol)
    np.testing.assert_allclose(run.states[-1, 2:], np.exp(-np.arange(1, 17) * end / 8), rtol=1e-4 if few else 1e-7)


@pytest.mark.parametrize("count", [1, 3, 20])
def test_as_many_motions_as_states(count):
    states = np.random.default_rng(0).uniform(-1.0, 1.0, (count, 4))
    runs = simulate(BALL, families.constant(), states, (0.0, 1.0), eps=1e-4)
    assert isinstance(runs, tuple)
    assert len(runs) == count
    for state, run in list(zip(states, runs, strict=True))[:5]:
        np.testing.assert_array_equal(run.states[0], state)
        alone = simulate(BALL, families.constant(), state, (0.0, 1.0), eps=1e-4)
        np.testing.assert_allclose(run.states[-1], alone.states[-1], rtol=0.0, atol=1e-8)
