"""Eigendirections in the picture against differences of the flow on the closed disc, and against trajectories."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings

from codim2_core import ELinear, System, critical_sets, hemisphere, psi
from codim2_core.portrait.layer_problem.eigendirections import of_critical_set, of_limit_directions
from codim2_core.portrait.layer_problem.problem import LayerProblem
from tests.core.strategies import regularisations, systems

STEP = 1e-5


def difference(at, family, p):
    """The Jacobian (2, 2) of the flow on the disc at an inner point, by central differences."""
    steps = STEP * np.eye(2)
    columns = [(hemisphere.flow(at, family, p + h) - hemisphere.flow(at, family, p - h)) / (2 * STEP) for h in steps]
    return np.stack(columns, axis=-1)


@settings(max_examples=20)
@given(systems, regularisations)
def test_of_a_critical_set_they_are_eigenvectors_of_the_flow_on_the_disc(system, family):
    sets = critical_sets(system, family)
    assume(sets and np.hypot(*sets[0].p) < 0.95)
    C, found = sets[0], of_critical_set(sets[0])
    F = difference(system.at(), family, C.p)
    ebar = float(hemisphere.height(C.p))  # dT = ebar dtau
    size = np.abs(F).sum()
    if C.eigenvalues[0].imag:
        assert not found.directions
        assume(abs(C.eigenvalues[0].imag) > 1e-6 * size)

        assert found.turning == np.sign(F[1, 0])
        return
    assert found.turning == 0
    if found.every:
        np.testing.assert_allclose(F, F[0, 0] * np.eye(2), atol=3e-6 * size)
        return
    for one in found.directions:
        v = np.array(one.direction)
        assert np.hypot(*v) == pytest.approx(1.0)
        np.testing.assert_allclose(F @ v, one.value / ebar * v, atol=3e-6 * size / ebar)
    assert [one.value for one in found.directions] == sorted({float(v.real) for v in C.eigenvalues}, reverse=True)


@settings(max_examples=20)
@given(systems, regularisations)
def test_at_a_limit_direction_they_are_eigenvectors_of_the_flow_on_the_closed_disc(system, family):
    problem = LayerProblem(system.at(), family)
    size = problem.at.size
    for i, one in enumerate(of_limit_directions(problem)):
        theta, rho, turn = (float(v[i]) for v in (problem.equator.theta, problem.equator.lambda_rho,
                                                  problem.equator.lambda_theta))  # fmt: skip
        e = np.array([math.cos(theta), math.sin(theta)])
        assert one.directions[0].direction == pytest.approx((-e[1], e[0]))
        assert one.directions[0].where == "equator"
        assert one.directions[0].value == turn
        for d in one.directions[1:]:
            assert d.value == (rho if d.where == "outside" else -rho)
            assert (np.array(d.direction) @ e > 0.0) == (d.where == "outside")
            if d.where == "outside":  # e-linear: along rays
                assert d.direction == pytest.approx((e[0], e[1]))
        up = [d for d in one.directions if d.where == "up"]
        if not up or abs(2 * rho + turn) < 1e-2 * size:
            continue
        if family.limit == 0.0:
            assert up[0].direction == pytest.approx((-e[0], -e[1]))
            continue
        h = 1e-6
        v = np.array(up[0].direction)
        towards = hemisphere.flow(problem.at, family, e + h * v / -(v @ e)) / h
        # |p|' = (1 - |p|^2) p.U: the distance from the equator changes at the rate -2 lambda_rho
        np.testing.assert_allclose(towards, -2.0 * rho * v / -(v @ e), atol=2e-4 * size / abs(v @ e) ** 2)


def test_outside_they_are_eigenvectors_of_the_flow_of_a_system_that_reads_position():
    system = System(U=("-2*c + s/5 + x + y/3", "-s + c/10 + 0.7*x - y"))
    problem = LayerProblem(system.at(), psi.constant())
    h = 1e-6
    for theta, rho, one in zip(problem.equator.theta, problem.equator.lambda_rho, of_limit_directions(problem),
                               strict=True):  # fmt: skip
        e = np.array([math.cos(theta), math.sin(theta)])
        (out,) = (np.array(d.direction) for d in one.directions if d.where == "outside")
        assert abs(out @ (-e[1], e[0])) > 1e-2
        away = h * out / (out @ e)
        c, s = (e + away) / np.hypot(*(e + away))
        r = np.hypot(*(e + away)) - 1.0
        u, v = (-2 * c + s / 5 + r * c + r * s / 3, -s + c / 10 + 0.7 * r * c - r * s)
        radial, around = c * u + s * v, c * v - s * u  # of r, times r, and of theta
        speed = r * radial * np.array([c, s]) + (1.0 + r) * around * np.array([-s, c])
        np.testing.assert_allclose(speed / h, rho * away / h, atol=1e-4)


def test_what_has_no_two_directions():
    star = of_critical_set(critical_sets(ELinear(-1, 0, -1, (0, 0)), psi.constant())[0])
    assert (star.directions, star.turning, star.every) == ((), 0, True)
    focus = of_critical_set(critical_sets(ELinear(-1, 2, -1, (0, 0)), psi.constant())[0])
    assert (focus.directions, focus.turning, focus.every) == ((), 1, False)  # U = A e turns by +b
    assert of_critical_set(critical_sets(ELinear(-1, -2, -1, (0, 0)), psi.constant())[0]).turning == -1
    centre = of_critical_set(critical_sets(ELinear(0, 1, 0, (0, 0)), psi.constant())[0])
    assert centre.turning == 1
    # [[0, -1], [1, -2]]: -1 twice, with the one eigenvector (1, 1)
    jordan = critical_sets(ELinear(0, 1, -2, (0, 0)), psi.constant())[0]
    (one,) = of_critical_set(jordan).directions
    assert (abs(one.direction[0]), one.value) == pytest.approx((math.sqrt(0.5), -1.0))
    triple = critical_sets(System(U=("-c**3", "-s")), psi.constant())[0]
    assert triple.kind == "degenerate"
    assert of_critical_set(triple).directions == ()


def test_a_resonance_leaves_the_half_line_out():
    # theta = 0: lambda_rho = a, lambda_theta = d - a = -2 a for a = -1, d = 1; Theta_e = b = 0: nothing leans
    plain = LayerProblem(ELinear(-1, 0, 1, (0, 0)).at(), psi.constant())
    assert [d.where for d in of_limit_directions(plain)[0].directions] == ["equator", "up", "outside"]
    # Theta = (d - a) s c + f2 c + b with b = -f2: theta = 0 stays, lambda_rho = a, lambda_theta = d - a, Theta_e = b
    leaning = LayerProblem(ELinear(-1, 0.5, 1, (0, -0.5)).at(), psi.constant())
    assert leaning.equator.theta[0] == pytest.approx(0.0, abs=1e-12)
    assert leaning.equator.lambda_theta[0] == pytest.approx(2.0)
    assert [d.where for d in of_limit_directions(leaning)[0].directions] == ["equator", "outside"]
    # Psi falls to zero at infinity: nothing leans
    upright = LayerProblem(ELinear(-1, 0.5, 1, (0, -0.5)).at(), psi.rational())
    assert [d.where for d in of_limit_directions(upright)[0].directions] == ["equator", "up", "outside"]


@pytest.mark.parametrize("growing", ["sqrt(1+s)", "1 + log(1+s)"])
def test_where_psi_has_no_finite_limit_only_what_does_not_lean_is_shown(growing):
    # as above, but at no resonance: lambda_theta + 2 lambda_rho = 1
    upright, leaning = (LayerProblem(ELinear(-1, b, 2, (0, -b)).at(), psi.custom(growing)) for b in (0.0, 0.5))
    at = [int(np.argmin(np.abs(np.sin(0.5 * problem.equator.theta)))) for problem in (upright, leaning)]
    assert [d.where for d in of_limit_directions(upright)[at[0]].directions] == ["equator", "up", "outside"]
    assert [d.where for d in of_limit_directions(leaning)[at[1]].directions] == ["equator", "outside"]
