"""The compiled motion is the one in Python, for every Psi, in a line too; the same steps where implicit; and many."""

import numpy as np
import pytest

from codim2_core import System, examples, simulate
from codim2_core import psi as families
from codim2_core.initial_value.compiled_motion import is_compiled
from codim2_core.initial_value.field import field
from codim2_core.initial_value.problem import plane_problem
from codim2_core.motion import regularised
from codim2_core.motion.result import SimulationStatus

PSI = (
    families.constant(), families.rational(), families.exponential(), families.tanh(), families.hill(3),
    families.hill(2.5), families.custom("1/(1+s)**2"),
)  # fmt: skip
BALL = examples.ball_in_pool(K=2.0)


@pytest.mark.parametrize(("psi", "eps"), [*zip(PSI, [1e-1, 1e-5, 1e-11] * 3, strict=False), (PSI[1], 1e-11)])
def test_it_is_the_motion_in_python(monkeypatch, psi, eps):
    state0, span = (-1.0, 0.3, 10.0, 0.0), (0.0, 3.0)
    monkeypatch.setattr(regularised, "PYTHON_STEPS", 10**9)
    monkeypatch.setattr(regularised, "_is_compiled", lambda formulas: False)
    own = simulate(BALL, psi, eps, state0, span, rtol=1e-9)
    monkeypatch.setattr(regularised, "_is_compiled", lambda formulas: True)
    found = simulate(BALL, psi, eps, state0, span, rtol=1e-9)
    np.testing.assert_allclose(found.states[-1], own.states[-1], rtol=1e-7, atol=1e-8)
    np.testing.assert_allclose(found.dense(1.234), own.dense(1.234), rtol=1e-6, atol=1e-8)
    assert found.invariant < 1e-12
    assert [phase.kind for phase in found.phases] == [phase.kind for phase in own.phases]


@pytest.mark.parametrize(
    ("psi", "eps"), [(families.constant(), 1e-1), (families.tanh(), 1e-3), (families.hill(3), 1e-6), (PSI[0], 1e-12)]
)
def test_a_slide_takes_few_steps_whatever_eps_and_tolerance(psi, eps):
    for rtol, most in ((1e-3, 80), (1e-6, 120), (1e-9, 260)):
        run = simulate(BALL, psi, eps, [(-1.0, 0.3, 10.0, 0.0)] * regularised.MANY_MOTIONS, (0.0, 3.0), rtol=rtol)[0]
        assert len(run.times) < most, (rtol, len(run.times))
        assert run.evaluations < 24 * most


@pytest.mark.parametrize("eps", [1e-2, 1e-5])
def test_dense_output_of_all_steps_joins_and_solves_the_equations(eps):
    """Between the ends of steps, explicit or not, the slope of the curve is the rate at it."""
    psi, states = families.rational(), [(-1.0, 0.3, 10.0, 0.0)] * regularised.MANY_MOTIONS
    motion = simulate(BALL, psi, eps, states, (0.0, 3.0), rtol=1e-9)[0].motion
    problem = plane_problem(field(BALL), psi, eps, 1e-9, 1e-9)
    powers = np.arange(1, motion.polynomials.shape[2] + 1)
    for i, (h, coefficients) in enumerate(zip(motion.lengths, motion.polynomials, strict=True)):
        scale = problem.scale(motion.states[i])
        np.testing.assert_allclose(motion.in_step(i, 1.0) / scale, motion.states[i + 1] / scale, atol=1e-13)
        if h < 10.0 * eps:  # in a slide the rate multiplies what is left of the tolerance
            for u in (0.0, 0.3, 0.8):
                slope = coefficients @ (powers * u ** (powers - 1)) / h
                np.testing.assert_allclose(h * slope / scale, h * problem.F(motion.in_step(i, u)) / scale, atol=1e-5)


def test_as_many_slow_variables_as_there_may_be(monkeypatch):
    monkeypatch.setattr(regularised, "_is_compiled", lambda formulas: True)
    names = [f"z{i}" for i in range(1, 17)]
    system = System(U=("-c", "-s"), W=tuple(f"-{i}*{name}/8 + c" for i, name in enumerate(names, 1)))
    run = simulate(system, families.constant(), 1e-3, (0.0, 0.0, *[1.0] * 16), (0.0, 1.0), rtol=1e-9)
    np.testing.assert_allclose(run.states[-1, 2:], np.exp(-np.arange(1, 17) / 8), rtol=1e-7)


def test_a_long_motion_goes_on_compiled(monkeypatch):
    system = System(U=("1.4*cos(z) - c", "-s/2"), W=("1",))
    monkeypatch.setattr(regularised, "PYTHON_STEPS", 30)
    run = simulate(system, families.tanh(), 1e-4, (0.5, 0.0, 0.0), (0.0, 20.0))
    assert is_compiled(field(system))
    assert run.status is SimulationStatus.T_END
    assert run.times[-1] == 20.0
    assert (np.diff(run.times) >= 0.0).all()
    assert not run.states[:, 1].any()  # an invariant line
    again = simulate(system, families.tanh(), 1e-4, (0.5, 0.0, 0.0), (0.0, 20.0))
    np.testing.assert_allclose(again.states[-1], run.states[-1], atol=1e-6)


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
