"""Checks of what is claimed of the systems of the literature."""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import examples

from .claim_case import HILL, NET, ONE
from .read_back import number


def ball(case, _):
    A, f = case.matrix
    sticks = np.hypot(*f) < abs(A[0, 0])
    assert bool(c2.critical_sets(case.at, case.psi)) == sticks
    run = c2.simulate(case.system, case.psi, 1e-4, (1e-3, 1e-3, *case.z), (0.0, 0.2))
    assert (np.hypot(*run.states[-1, :2]) < 1e-2) == sticks
    if sticks:
        (C,) = c2.critical_sets(case.at, case.psi)
        np.testing.assert_allclose(C.slow_flow, 5.0 / 7.0 * f, rtol=0.0, atol=1e-9)


def attracting_repelling(case, _):
    assert case.directions == 6
    angles = np.arange(6) * math.pi / 3.0
    rates = [np.interp(t % math.tau, NET, case.rho) for t in angles]
    assert [rate < 0.0 for rate in rates] == [False] + [True] * 5
    kinds = {one: [C.kind for C in sorted(c2.critical_sets(case.at, one), key=lambda C: C.e[0])] for one in (ONE, HILL)}
    assert all(found == ["stable node", "saddle"] for found in kinds.values())


def within_a_third(case, _):
    for angle in (0.2, -0.8, 1.0, 1.3, 2.6, -1.9):
        start = 0.05 * np.array([math.cos(angle), math.sin(angle)])
        run = c2.simulate_nonsmooth(case.system, (*start, *case.z), (0.0, 0.6), case.psi)
        kinds = [phase.kind for phase in run.phases]
        if len(kinds) > 1:
            assert ("cross" in kinds) == (abs(angle) < math.pi / 3.0), (angle, kinds)


def nonunique(case, _):
    z = case.z[0]
    chi = (1.0 + 2.0 * z * z) / (1.0 + z * z)
    found = sorted(c2.critical_sets(case.at, case.psi), key=lambda C: C.e[0])
    np.testing.assert_allclose([C.e[0] for C in found], [-chi / 2, 0.0, chi / 2], rtol=0.0, atol=1e-9)
    assert [C.kind for C in found] == ["stable node", "saddle", "stable node"]
    np.testing.assert_allclose([C.slow_flow[0] for C in found], [chi + 0.25, 0.25, -chi + 0.25], rtol=0.0, atol=1e-9)
    assert case.directions == (8 if chi**2 < 2.0 else 4)


def flows_said(case, fields):
    found = sorted(c2.critical_sets(case.at, case.psi), key=lambda C: C.e[0])
    assert number(fields["first"]) == pytest.approx(found[0].slow_flow[0], rel=1e-3)
    assert number(fields["third"]) == pytest.approx(found[2].slow_flow[0], rel=1e-3)


BALL, ATTRACTING, NONUNIQUE = examples.ball_in_pool(), examples.attracting_repelling(), examples.nonunique_sliding()
