"""t in formulas: it is one more slow variable, a clock, that starts where a motion's time does."""

import math
import pickle

import numpy as np
import pytest

from codim2_core import psi, simulate, simulate_nonsmooth
from codim2_core.formulas.expression import ExpressionError
from codim2_core.systems.typed import System

SHAKEN = {"U": ("-mu*c + F*cos(w*t)", "-mu*s"), "parameters": {"mu": 0.3, "F": 0.5, "w": 2.0}}


def test_t_is_a_last_slow_variable_with_the_rate_1():
    by_hand = System(U=("-mu*c + F*cos(w*z1)", "-mu*s"), W=("1",), parameters=SHAKEN["parameters"])
    timed = System(**SHAKEN)
    assert (timed.U, timed.W, timed.m, timed.clock) == (by_hand.U, by_hand.W, 1, "z1")
    assert by_hand.clock == ""
    both = System(U=("-c + sin(t)*z2", "-s"), W=("x", "-z"))
    assert (both.m, both.clock, both.W[2].constant) == (3, "z3", 1.0)
    assert System(U=("-c + sin(t)", "-s*z2")).clock == "z3"
    assert System(U=("-c", "-s"), W=("t",)).clock == "z2"
    assert System(U=("-c + push", "-s"), definitions={"push": "sin(t)"}).clock == "z1"


def test_a_name_t_that_is_given_means_what_it_is_given_as():
    assert System(U=("-c + t", "-s"), parameters={"t": 0.5}).m == 0
    named = System(U=("-c + t(z)", "-s"), W=("1",), definitions={"t(z)": "z^2"})
    assert (named.m, named.clock) == (1, "")


def test_it_stays_one_clock_whatever_is_changed():
    timed = System(U=("-c + sin(t)", "-s*z1"), W=("x",))
    assert timed.evolve(U=("-c + cos(t)", "-s*z1")).m == 2
    assert timed.evolve(U=("-c", "-s*z1")).m == 1
    assert timed.evolve(parameters={"k": 1.0}) == System(U=("-c + sin(t)", "-s*z1"), W=("x",), parameters={"k": 1.0})
    assert System(**SHAKEN).evolve(w=3.0).clock == "z1"
    again = pickle.loads(pickle.dumps(timed))
    assert (again, again.clock, hash(again)) == (timed, "z2", hash(timed))


def test_a_portrait_is_that_of_an_instant():
    timed = System(**SHAKEN)
    assert timed.at(0.3).U((0.0, 0.0))[0] == 0.5 * math.cos(0.6)
    assert timed.at().U((0.0, 0.0))[0] == 0.5  # t = 0 where nothing is said
    assert System(U=("-c + t", "-s*z1"), W=("x",)).at(2.0).z == (2.0, 0.0)


@pytest.mark.parametrize("start", [0.0, 1.3])
def test_a_motion_begins_at_the_time_of_its_span(start):
    timed = System(U=("cos(t)", "-s/2 + t"))
    for run in (
        simulate(timed, psi.constant(), (1.0, 2.0), (start, start + 0.7), eps=1e-3),
        simulate_nonsmooth(timed, (1.0, 2.0), (start, start + 0.7)),
    ):
        np.testing.assert_allclose(run.states[:, 2], run.times, atol=1e-12)
        np.testing.assert_allclose(run.states[-1, 0], 1.0 + math.sin(start + 0.7) - math.sin(start), rtol=1e-7)
    several = simulate_nonsmooth(timed, [(1.0, 2.0), (2.0, 2.0)], (start, start + 0.1))
    assert [one.states[0, 2] for one in several] == [start, start]


def test_a_start_may_name_its_instant():
    timed = System(U=("cos(t)", "-s/2"))
    run = simulate_nonsmooth(timed, (1.0, 2.0, 0.5), (0.0, 0.4))
    np.testing.assert_allclose(run.states[-1, 0], 1.0 + math.sin(0.9) - math.sin(0.5), rtol=1e-9)


def test_a_wrong_number_of_a_start_is_told():
    with pytest.raises(ValueError, match="m = 2"):
        simulate_nonsmooth(System(U=("-c + sin(t)", "-s"), W=("x",)), (1.0, 0.0), (0.0, 1.0))
    with pytest.raises(ExpressionError, match="tt"):
        System(U=("-c + tt", "-s"))
