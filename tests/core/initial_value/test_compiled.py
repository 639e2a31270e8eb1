"""The compiled motion is the one in Python, for every Psi, in a line too; the same steps where implicit; and many."""

from __future__ import annotations

import math

import numpy as np
import pytest

from codim2_core import ELinear, Event, System, examples, simulate, simulate_nonsmooth
from codim2_core import psi as families
from codim2_core.initial_value import compiled
from codim2_core.initial_value.compiled import CompiledMotion, is_compiled
from codim2_core.initial_value.field import field
from codim2_core.initial_value.kernels.explicit import DEGREE
from codim2_core.initial_value.kernels.motion import COUNT, IMPLICIT
from codim2_core.initial_value.problem import direction, plane_problem, smoothed
from codim2_core.motion import regularised
from codim2_core.motion.result import SimulationStatus

PSI = (
    families.constant(),
    families.rational(),
    families.exponential(),
    families.tanh(),
    families.hill(3),
    families.hill(2.5),
    families.custom("1/(1+s)**2"),
)
BALL = examples.ball_in_pool(K=2.0)
FORCED = System(U=("1.5*cos(z) - c", "-s"), W=("1",))


@pytest.mark.parametrize(("psi", "eps"), [*zip(PSI, [1e-1, 1e-5, 1e-11] * 3, strict=False), (PSI[1], 1e-11)])
def test_it_is_the_motion_in_python(monkeypatch, psi, eps):
    state0, span = (-1.0, 0.3, 10.0, 0.0), (0.0, 3.0)
    monkeypatch.setattr(regularised, "PATIENCE", 10**9)
    monkeypatch.setattr(regularised, "_is_compiled", lambda formulas: False)
    own = simulate(BALL, psi, eps, state0, span, rtol=1e-9)
    monkeypatch.setattr(regularised, "_is_compiled", lambda formulas: True)
    found = simulate(BALL, psi, eps, state0, span, rtol=1e-9)
    np.testing.assert_allclose(found.states[-1], own.states[-1], rtol=1e-7, atol=1e-8)
    np.testing.assert_allclose(found.dense(1.234), own.dense(1.234), rtol=1e-6, atol=1e-8)
    assert found.invariant < 1e-12
    assert [phase.kind for phase in found.phases] == [phase.kind for phase in own.phases]


@pytest.mark.parametrize("eps", [1e-1, 1e-5, 1e-11])
def test_implicit_alone_it_takes_the_steps_of_python(monkeypatch, eps):
    def implicit(*arguments):
        motion = CompiledMotion(*arguments)
        motion.control[IMPLICIT], motion.control[COUNT] = 1.0, -math.inf  # no count of signs turns it explicit
        return motion

    def run(chosen, is_compiled):
        monkeypatch.setattr(regularised, "_is_compiled", lambda formulas: is_compiled)
        monkeypatch.setattr(compiled, "CompiledMotion", chosen)
        never = Event(lambda t, state: 1.0)  # a motion under watch is stepped part by part
        return simulate(BALL, families.rational(), eps, (-1.0, 0.3, 10.0, 0.0), (0.0, 3.0), rtol=1e-9, events=never)

    monkeypatch.setattr(regularised, "PATIENCE", 10**9)
    own, found = run(CompiledMotion, False), run(implicit, True)
    # Newton's method takes a slope by differences, so that a step may be taken or not.
    assert len(found.times) == pytest.approx(len(own.times), abs=6)
    assert found.evaluations == pytest.approx(own.evaluations, rel=0.1)
    np.testing.assert_allclose(found.states[-1], own.states[-1], rtol=1e-7, atol=1e-8)


@pytest.mark.parametrize(
    ("psi", "eps"), [(families.constant(), 1e-1), (families.tanh(), 1e-3), (families.hill(3), 1e-6), (PSI[0], 1e-12)]
)
def test_a_slide_takes_few_steps_whatever_eps_and_tolerance(psi, eps):
    for rtol, most in ((1e-3, 80), (1e-6, 120), (1e-9, 260)):
        run = simulate(BALL, psi, eps, [(-1.0, 0.3, 10.0, 0.0)] * regularised.MANY, (0.0, 3.0), rtol=rtol)[0]
        assert len(run.times) < most, (rtol, len(run.times))
        assert run.evaluations < 24 * most


@pytest.mark.parametrize("eps", [1e-2, 1e-5])
def test_dense_output_of_all_steps_joins_and_solves_the_equations(eps):
    """Between the ends of steps, explicit or not, the slope of the curve is the rate at it."""
    psi, states = families.rational(), [(-1.0, 0.3, 10.0, 0.0)] * regularised.MANY
    motion = simulate(BALL, psi, eps, states, (0.0, 3.0), rtol=1e-9)[0].motion
    problem = plane_problem(field(BALL), psi, eps, 1e-9, 1e-9)
    powers = np.arange(1, motion.polynomials.shape[2] + 1)
    for i, (h, coefficients) in enumerate(zip(motion.lengths, motion.polynomials, strict=True)):
        scale = problem.scale(motion.states[i])
        np.testing.assert_allclose(motion.within(i, 1.0) / scale, motion.states[i + 1] / scale, atol=1e-13)
        if h < 10.0 * eps:  # in a slide the rate multiplies what is left of the tolerance
            for u in (0.0, 0.3, 0.8):
                slope = coefficients @ (powers * u ** (powers - 1)) / h
                np.testing.assert_allclose(h * slope / scale, h * problem.F(motion.within(i, u)) / scale, atol=1e-5)


def test_as_many_slow_variables_as_there_may_be(monkeypatch):
    monkeypatch.setattr(regularised, "_is_compiled", lambda formulas: True)
    names = [f"z{i}" for i in range(1, 17)]
    system = System(U=("-c", "-s"), W=tuple(f"-{i}*{name}/8 + c" for i, name in enumerate(names, 1)))
    run = simulate(system, families.constant(), 1e-3, (0.0, 0.0, *[1.0] * 16), (0.0, 1.0), rtol=1e-9)
    np.testing.assert_allclose(run.states[-1, 2:], np.exp(-np.arange(1, 17) / 8), rtol=1e-7)


def test_a_long_motion_goes_on_compiled(monkeypatch):
    system = System(U=("1.4*cos(z) - c", "-s/2"), W=("1",))
    monkeypatch.setattr(regularised, "PATIENCE", 30)
    run = simulate(system, families.tanh(), 1e-4, (0.5, 0.0, 0.0), (0.0, 20.0))
    assert is_compiled(field(system))
    assert run.status is SimulationStatus.T_END
    assert run.times[-1] == 20.0
    assert (np.diff(run.times) >= 0.0).all()
    assert not run.states[:, 1].any()  # an invariant line
    again = simulate(system, families.tanh(), 1e-4, (0.5, 0.0, 0.0), (0.0, 20.0))
    np.testing.assert_allclose(again.states[-1], run.states[-1], atol=1e-6)


def test_a_system_that_comes_again_is_followed_compiled_from_the_start(monkeypatch):
    system = System(U=("-c + 0.31*s", "-s - 0.31*c"), W=("c + 2.5",))
    assert not regularised._is_compiled(field(system))
    simulate(system, families.tanh(), 0.01, [(1.0, 0.5, 0.0)] * regularised.MANY, (0.0, 0.1))
    assert regularised._is_compiled(field(system))
    monkeypatch.setattr(regularised, "steps", None)  # the method in Python
    assert simulate(system, families.tanh(), 0.01, (1.0, 0.5, 0.0), (0.0, 1.0)).times[-1] == 1.0


def test_short_motions_of_one_system_are_compiled_once_they_are_a_long_one_together(monkeypatch):
    system = System(U=("-c + 0.29*s", "-s - 0.29*c"), W=("c + 2.5",))
    monkeypatch.setattr(regularised, "PATIENCE", 60)
    runs = [simulate(system, families.tanh(), 0.01, (1.0, 0.5, 0.0), (0.0, 0.3))]
    steps = len(runs[0].times) - 1
    assert steps < 60
    while not is_compiled(field(system)):
        runs.append(simulate(system, families.tanh(), 0.01, (1.0, 0.5, 0.0), (0.0, 0.3)))
        assert steps * (len(runs) - 1) <= 60
    assert steps * len(runs) >= 60
    for run in runs:
        np.testing.assert_allclose(run.states[-1], runs[0].states[-1], atol=1e-7)
    other = System(U=("-c + 0.28*s", "-s - 0.28*c"), W=("c + 2.5",))
    simulate(other, families.tanh(), 0.01, (1.0, 0.5, 0.0), (0.0, 0.3))
    assert not is_compiled(field(other))


def test_compiled_motions_end_as_others_do(monkeypatch):
    monkeypatch.setattr(regularised, "_is_compiled", lambda formulas: True)
    grows = System(U=("x**2 - c", "-s"))
    run = simulate(grows, families.constant(), 1e-4, (2.0, 0.0), (0.0, 20.0))
    assert run.status is SimulationStatus.BLOW_UP
    assert run.times[-1] == pytest.approx(0.5 * np.log(3.0), rel=1e-6)
    undefined = System(U=("-c", "-s"), W=("-1/2 + log(z) - log(z)",))
    run = simulate(undefined, families.constant(), 1e-3, (1.0, 0.0, 1.0), (0.0, 3.0))
    assert run.status is SimulationStatus.STEP_LIMIT
    assert run.times[-1] == pytest.approx(2.0, abs=1e-6)
    run = simulate(FORCED, families.constant(), 1e-4, (0.5, 0.0, 0.0), (0.0, 200.0), max_steps=300)
    assert run.status is SimulationStatus.STEP_LIMIT
    assert 1.0 < run.times[-1] < 200.0
    stop = Event(lambda t, q: t - 2.5, terminal=True)
    run = simulate(FORCED, families.constant(), 1e-4, (0.5, 0.0, 0.0), (0.0, 200.0), events=stop)
    assert run.status is SimulationStatus.EVENT
    assert run.times[-1] == pytest.approx(2.5, abs=1e-12)


@pytest.mark.parametrize("count", [1, 3, 20])
def test_as_many_motions_as_states(count):
    states = np.random.default_rng(0).uniform(-1.0, 1.0, (count, 4))
    runs = simulate(BALL, families.constant(), 1e-4, states, (0.0, 1.0))
    assert isinstance(runs, tuple)
    assert len(runs) == count
    for state, run in list(zip(states, runs, strict=True))[:5]:
        np.testing.assert_array_equal(run.states[0], state)
        alone = simulate(BALL, families.constant(), 1e-4, state, (0.0, 1.0))
        np.testing.assert_allclose(run.states[-1], alone.states[-1], rtol=0.0, atol=1e-8)


@pytest.mark.parametrize("line", [False, True])
def test_the_slip_of_a_nonsmooth_motion_compiled_is_that_in_python(monkeypatch, line):
    start = (1.0, 0.0, 12.0, 0.0) if line else (-1.0, 0.3, 10.0, 0.0)

    def run(compiled):
        monkeypatch.setattr(regularised, "_is_compiled", lambda formulas: compiled)
        return simulate_nonsmooth(BALL, start, (0.0, 3.0), families.rational(), rtol=1e-11)

    monkeypatch.setattr(regularised, "PATIENCE", 10**9)
    own, found = run(False), run(True)
    assert [phase.kind for phase in found.phases] == [phase.kind for phase in own.phases]
    ends = [[phase.t_end for phase in run.phases] for run in (found, own)]
    np.testing.assert_allclose(ends[0], ends[1], rtol=1e-10)
    np.testing.assert_allclose(found.states[-1], own.states[-1], rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(found.dense(np.linspace(0.0, 3.0, 50)), own.dense(np.linspace(0.0, 3.0, 50)), atol=1e-7)
    assert found.motion.polynomials.shape[2] == DEGREE  # it was compiled


def test_states_that_are_none_say_so():
    with pytest.raises(ValueError, match="shape"):
        simulate(BALL, families.constant(), 1e-4, np.zeros((3, 5)), (0.0, 1.0))
    with pytest.raises(ValueError, match="finite"):
        simulate(BALL, families.constant(), 1e-4, [[0.0] * 4, [np.nan] * 4], (0.0, 1.0))
    with pytest.raises(ValueError, match="numbers"):
        simulate(BALL, families.constant(), 1e-4, [[0.0] * 4, ["a"] * 4], (0.0, 1.0))
    assert simulate(ELinear(-1.0, 0.0, -1.0), families.constant(), 1e-4, [[1.0, 0.0]], (0.0, 1.0))[0].times[-1] == 1.0


@pytest.mark.parametrize("psi", PSI, ids=lambda psi: psi.text)
def test_the_smoothed_direction_alone_is_that_with_its_slopes(psi):
    for eps, x, y in ((0.3, -0.7, 0.2), (1e-14, 1e-9, -3.0), (1e6, 2e-3, 5.0), (1e-3, 0.0, 0.0), (1.0, 5e-324, 0.0)):
        assert smoothed(psi, eps, x, y) == pytest.approx(direction(psi, eps, x, y)[:2], rel=1e-15, abs=1e-300)
    assert smoothed(None, 0.0, -3.0, 4.0) == (-0.6, 0.8)
