"""Beside an invariant line that repels as a motion arrives: by which power of an angle, and what is left of it."""

import math

import numpy as np
import pytest

from codim2_core import System, periodic_motion, psi, simulate_nonsmooth
from codim2_core.motion.variation.passage import shrinks_across

#: Pushed by f against friction S along, q across: r = f + S, t = f + S - q, R = f - S, T = f - S + q.
PUSHED = System(U=("f - S*c", "-q*s"), parameters={"f": 1.0, "S": 0.3, "q": 0.3})


def powers(f, S, q):
    """Exponents of the delay r/t, and of the angle r T/(t R)."""
    return (f + S) / (f + S - q), (f + S) * (f - S + q) / ((f + S - q) * (f - S))


@pytest.mark.parametrize(("f", "S", "q"), [(1.0, 0.3, 0.3), (1.0, 0.5, 0.2), (0.6, 0.3, 0.25)])
def test_the_powers_are_those_of_motions(f, S, q):
    """From (-1, d), at the same x on the other side of Sigma."""
    system = PUSHED.evolve(f=f, S=S, q=q)
    end = 1.0 / (f + S) + 1.0 / (f - S)

    def after(d):
        run = simulate_nonsmooth(system, (-1.0, d), (0.0, end), rtol=1e-12, atol=1e-30)
        assert [phase.kind for phase in run.phases] == ["slip"]
        return run.states[-1]

    first, second = after(1e-6), after(1e-8)
    delay, angle = powers(f, S, q)
    assert math.log(first[1] / second[1]) / math.log(100.0) == pytest.approx(angle, abs=2e-3)
    late = [1.0 - one[0] for one in (first, second)]
    if min(map(abs, late)) > 1e-12:
        assert math.log(late[0] / late[1]) / math.log(100.0) >= min(delay, 2.0) - 0.05
    assert shrinks_across(system, None, (), math.pi, 0.0)


@pytest.mark.parametrize(("q", "shrinks"), [(0.3, True), (1e-3, True), (-1e-3, False), (-0.2, False)])
def test_it_is_left_where_friction_across_brakes(q, shrinks):
    system = PUSHED.evolve(q=q)
    assert (powers(1.0, 0.3, q)[1] > 1.0) is shrinks
    assert shrinks_across(system, None, (), math.pi, 0.0) is shrinks


def test_other_ways_out_between_are_no_passage():
    """With stronger braking across than along, two limit directions lie between: what is beside goes there."""
    system = PUSHED.evolve(f=0.5, S=0.3, q=0.1).evolve(S=0.9)
    assert not shrinks_across(system, None, (), math.pi, 0.0)
    assert not shrinks_across(PUSHED, None, (), math.pi, 1.0)  # it leaves elsewhere
    assert not shrinks_across(PUSHED, None, (), 0.0, math.pi)  # nothing arrives there


def test_a_stick_forgets_how_it_was_come_to():
    """Leine's block: pushed on as it arrives, so that the line repels; what is beside goes round, and sticks."""
    block = System(U=("-z1 - c/(1 + 3*abs(x))", "-s"), W=("x + 0.2",))
    run = simulate_nonsmooth(block, (0.0, 0.0, 0.9), (0.0, 3.0))
    found = periodic_motion(block, run.states[-1], 12.0)
    assert found.stability == "stable"
    assert found.multipliers.tolist() == [0.0, 0.0]
    z = found.run.dense(next(phase.t_start for phase in found.run.phases if phase.kind == "slide"))[2:]
    assert shrinks_across(block, None, tuple(z.tolist()), math.pi, None)
    assert shrinks_across(block, psi.hill(2), tuple(z.tolist()), math.pi, None)
    for d in (1e-3, 1e-5):
        start = found.state0 + d * np.eye(3)[1]
        one = simulate_nonsmooth(block, start, (0.0, found.period), rtol=1e-11, atol=1e-20).states[-1]
        assert abs(one[1]) < 1e-12
        assert np.abs(one - found.state0).max() < 10.0 * d
