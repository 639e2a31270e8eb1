"""Sliding on a limit cycle whose mean slow flow is given, against its closed form."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.motion.limit import slide_on_cycle as module
from codim2_core.motion.limit.slide_on_cycle import APART, RTOL, _means, slide_on_cycle

PSI = c2.psi.rational()
SYSTEM = c2.System(U=("-s", "c"), W=("1", "1"))
M, K = np.array([[-0.5, 0.3], [0.2, -1.0]]), np.array([0.4, -0.1])
TURN = np.linspace(0.0, math.tau, 61)[:-1]
CIRCLE = 0.3 * np.stack([np.cos(TURN), np.sin(TURN)], axis=-1)


def cycle(middle, flow, stable=True):
    return SimpleNamespace(stable=stable, points=np.array(middle) + CIRCLE, slow_flow=flow)


def played(monkeypatch, cycles):
    """Let the layer problem at z have these cycles."""
    asked = []

    def limit_cycles(system, psi, z):
        assert psi == PSI
        asked.append(z)
        return cycles(np.array(z))

    monkeypatch.setattr(module, "limit_cycles", limit_cycles)
    return asked


def exact(z, t):
    """Return z(t) of z' = M z + K."""
    values, vectors = np.linalg.eig(M)
    rest = -np.linalg.solve(M, K)
    return rest + (vectors @ (np.exp(values * t) * np.linalg.solve(vectors, z - rest))).real


def test_the_mean_slow_flow_is_followed_beside_others(monkeypatch):
    """Of the stable cycles the nearest one counts, though unstable ones are nearer, and it moves with z."""

    def cycles(z):
        place = 0.1 * z
        return [
            cycle(place, (9.0, 9.0), stable=False),
            cycle(place + np.array([0.15, 0.0]), (7.0, 7.0)),
            cycle(place, M @ z + K),
        ]

    played(monkeypatch, cycles)
    z0 = np.array([0.5, -0.2])
    found = slide_on_cycle(SYSTEM, PSI, 2, 1.0, z0, 3.0, 500)
    assert found.lives
    assert found.taken[0].start == 1.0
    assert found.taken[-1].end == 3.0
    assert len(found.e) == len(found.p) == len(found.taken) + 1
    for step in found.taken:
        assert step.last[:2].tolist() == step.first[:2].tolist() == [0.0, 0.0]
        np.testing.assert_allclose(step.last[2:], exact(z0, step.end - 1.0), atol=20.0 * RTOL)
        np.testing.assert_allclose(step.at(0.5)[2:], exact(z0, step.start + 0.5 * step.h - 1.0), atol=20.0 * RTOL)
        assert step.at(0.5)[:2].tolist() == [0.0, 0.0]
    for z, e, p in ((z0, found.e[0], found.p[0]), (exact(z0, 2.0), found.e[-1], found.p[-1])):
        means = _means(SYSTEM, PSI, z, cycle(0.1 * z, ()))
        np.testing.assert_allclose((e, p), means, atol=1e-5)


def problem_of(monkeypatch, cycles, z0, index=0):
    """Return the initial value problem in z that is handed to the integrator."""
    given = []
    played(monkeypatch, cycles)
    monkeypatch.setattr(module, "steps", lambda problem, *rest: given.append((problem, *rest)) or iter(()))
    slide_on_cycle(SYSTEM, PSI, index, 101.0, np.array(z0), 103.0, 77)
    return given[0]


def test_its_rate_slope_and_scale(monkeypatch):
    problem, t, t_end, z, rtol, h, most, shortest = problem_of(
        monkeypatch, lambda z: [cycle((0.0, 0.0), M @ z + K)], (0.5, -0.2)
    )
    assert (t, t_end, z.tolist(), rtol, most) == (101.0, 103.0, [0.5, -0.2], RTOL, 77)
    assert 0.0 < shortest < 1e-3 * h < 1e-3 * (t_end - t)
    at = np.array([3.0, -40.0])
    np.testing.assert_allclose(problem.F(at), M @ at + K)
    np.testing.assert_allclose(problem.J(at), M, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(problem.scale(at), [3.01, 40.01])
    assert problem.limit(at, problem.F(at), M) > 0.0


@pytest.mark.parametrize("far", [0.9 * APART, 1.1 * APART])
def test_a_cycle_far_from_the_last_one_is_another(monkeypatch, far):
    problem, *_ = problem_of(monkeypatch, lambda z: [cycle((0.0 if z[0] < 1.0 else far, 0.0), (1.0, 2.0))], (0.5, 0.0))
    assert problem.F(np.array([0.5, 0.0])).tolist() == [1.0, 2.0]
    there = problem.F(np.array([1.5, 0.0]))
    assert np.isnan(there).all() == (far > APART)
    problem.J(np.array([1.5, 0.0]))  # as at the end of a step: from there on it is the one
    assert problem.F(np.array([1.5, 0.0])).tolist() == [1.0, 2.0]


def test_without_a_stable_cycle_there_is_no_rate_and_no_slope(monkeypatch):
    problem, *_ = problem_of(
        monkeypatch, lambda z: [cycle((0.0, 0.0), (1.0, 2.0), stable=bool(z[0] < 1.0))], (0.5, 0.0)
    )
    assert np.isnan(problem.F(np.array([1.5, 0.0]))).all()
    assert problem.J(np.array([1.5, 0.0])).tolist() == [[0.0, 0.0], [0.0, 0.0]]


def test_it_is_followed_to_where_it_ends(monkeypatch):
    played(monkeypatch, lambda z: [cycle((0.0, 0.0), (1.0, -1.0), stable=bool(z[0] < 1.0))])
    found = slide_on_cycle(SYSTEM, PSI, 0, 0.0, np.array([0.25, 0.0]), 3.0, 500)
    assert not found.lives
    assert found.taken[-1].last[2:] == pytest.approx([1.0, -0.75], abs=1e-4)
    few = slide_on_cycle(SYSTEM, PSI, 0, 0.0, np.array([0.25, 0.0]), 0.5, 1)
    assert not few.lives  # given up


@pytest.mark.parametrize("psi", [c2.psi.constant(), PSI, c2.psi.tanh()], ids=str)
def test_means_are_those_in_time(psi):
    """On |e| = q with U = (2 + c) e turned, dt = dtheta/(2 + q cos theta): the mean of c is sqrt(4 - q^2) - 2."""
    q = 0.8
    zeta = float(psi.radius(q))
    angle = np.linspace(0.0, math.tau, 401)[:-1] + 0.2
    unit = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    around = SimpleNamespace(points=zeta / math.hypot(1.0, zeta) * unit)
    system = c2.System(U=("-s*(2 + c)", "c*(2 + c)"), W=("1",))
    e, p = _means(system, psi, np.array([0.0]), around)
    mean = math.sqrt(4.0 - q * q) - 2.0
    np.testing.assert_allclose(e, [mean, 0.0], atol=2e-5)
    np.testing.assert_allclose(p, [mean / q * zeta / math.hypot(1.0, zeta), 0.0], atol=2e-5)
