"""One step of either method."""

from __future__ import annotations

import math

import numpy as np
import pytest

from codim2_core import System
from codim2_core.initial_value.compiled import numbers_of_tableau
from codim2_core.initial_value.field import field
from codim2_core.initial_value.kernels import explicit, radau, rate
from codim2_core.initial_value.kernels.motion import price
from codim2_core.initial_value.kernels.stages import tableau_of, workspace
from codim2_core.initial_value.problem import plane_problem
from codim2_core.numerics.radau import tableau

from .placing import CURVED, TANH, motion_of


@pytest.mark.parametrize("line", [None, (0.8, 0.6)])
def test_one_explicit_step_solves_the_equations(line):
    """The motion inside a step, and its slope there; in a line it stays."""
    psi, h = TANH, 0.05
    motion = motion_of(CURVED, psi, 0.3, line=line or (0.0, 0.0))
    problem = plane_problem(field(CURVED), psi, 0.3, 1e-6, 1e-8, line)
    work, clock, y = workspace(4, psi.parameter), np.zeros(4), np.array([0.4, 0.3, 0.7, -0.2])
    first, polynomial, end = y.copy(), np.empty((4, explicit.DEGREE)), np.empty(4)
    explicit.begin(motion, y, work)
    rate.sizes(motion, y, work.size)
    accepted, change = explicit.attempt(motion, h, clock, work)
    assert accepted
    assert change > 1.0
    explicit.keep(motion, y, clock, work, polynomial, end)
    assert clock[3] == 15.0
    np.testing.assert_array_equal(y, end)
    np.testing.assert_allclose(first + polynomial.sum(axis=1), end, atol=1e-14)
    powers = np.arange(1, explicit.DEGREE + 1)
    for u in (0.0, 0.3, 0.6, 1.0):
        there, slope = first + polynomial @ u**powers, polynomial @ (powers * u ** (powers - 1)) / h
        np.testing.assert_allclose(slope, problem.F(there), atol=1e-7)
    if line is not None:
        assert abs(y[0] * 0.6 - y[1] * 0.8) < 1e-15
    explicit.go_on(motion, work)
    np.testing.assert_allclose(work.rate[:4], problem.F(y), rtol=1e-12)
    np.testing.assert_allclose(work.size[:4], [math.hypot(y[0], y[1], 0.3)] * 2 + [*(abs(y[2:]) + 0.01)])


def test_one_implicit_step_solves_the_equations():
    psi, h = TANH, 0.02
    motion, table = motion_of(CURVED, psi, 0.3, rtol=1e-8), tableau_of(numbers_of_tableau())
    problem = plane_problem(field(CURVED), psi, 0.3, 1e-8, 1e-10)
    work, clock, y = workspace(4, psi.parameter), np.zeros(4), np.array([0.4, 0.3, 0.7, -0.2])
    first, polynomial, end = y.copy(), np.full((4, explicit.DEGREE), math.nan), np.empty(4)
    radau.linearised(motion, y, h, clock, work)
    accepted, change = radau.attempt(motion, table, y, h, 0.0, False, clock, work)
    assert accepted
    assert change > 1.0
    radau.keep(table, y, work, polynomial, end)
    np.testing.assert_array_equal(y, end)
    np.testing.assert_allclose(first + polynomial.sum(axis=1), end, atol=1e-14)
    assert not polynomial[:, 5:].any()
    for u in tableau().nodes:
        powers = np.arange(1, 6)
        slope = polynomial[:, :5] @ (powers * u ** (powers - 1)) / h
        np.testing.assert_allclose(slope, problem.F(first + polynomial[:, :5] @ u**powers), atol=3e-6)


@pytest.mark.parametrize("h", [40.0, 3.0])
def test_a_step_that_is_too_long_is_not_taken_and_made_shorter(h):
    motion, table = motion_of(CURVED, TANH, 0.01), tableau_of(numbers_of_tableau())
    work, clock, y = workspace(4, 0.0), np.zeros(4), np.array([0.4, 0.3, 0.7, -0.2])
    radau.linearised(motion, y, h, clock, work)
    accepted, change = radau.attempt(motion, table, y, h, 0.0, False, clock, work)
    assert not accepted
    assert change <= 0.8
    explicit.begin(motion, y, work)
    rate.sizes(motion, y, work.size)
    accepted, change = explicit.attempt(motion, h, clock, work)
    assert not accepted
    assert 0.1 < change <= 0.8


def test_stiff_is_what_a_step_that_long_would_be_for_stability_alone():
    """z' = -k z: a step of 0.05/k is not, one of 2/k is."""
    for k in (3.0, 3000.0):
        decays = System(U=(f"-{k}*x + 0*c", f"-{k}*y"))
        motion, work, y = motion_of(decays, TANH, 1.0), workspace(2, 0.0), np.array([0.4, 0.3])
        for part, is_stiff in ((0.05, False), (2.0, True)):
            explicit.begin(motion, y, work)
            rate.sizes(motion, y, work.size)
            explicit.attempt(motion, part / k, np.zeros(4), work)
            assert bool(explicit.stiff(motion, part / k, work)) is is_stiff


def test_an_implicit_step_costs_what_was_measured():
    assert [price(n) for n in (2, 4)] == [2.0, 5.0]
