"""Loops through the equator: their arcs from what the limit directions are, their gaps from where separatrices go."""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.portrait.cycles.heteroclinic_cycle import loop_gap
from codim2_core.portrait.cycles.ray_section import heteroclinic_arcs
from codim2_core.portrait.layer_problem.problem import LayerProblem

# a, b, d, f1, f2 with one arc each, found at random
PLANES = [(1.45, -1.49, -1.38, 0.94, -0.85), (-1.18, -0.95, 0.27, -0.81, -0.81), (0.55, 0.67, -0.58, 0.67, 0.65)]
EVERY = pytest.mark.parametrize("plane", PLANES)
PSI = c2.psi.rational()


def made(plane, time=1.0):
    a, b, d, f1, f2 = (time * v for v in plane)
    return c2.ELinear(a, b, d, (f1, f2)).at()


def heteroclinic_cycles(at):
    """Arcs in the sense in which orbits turn about C."""
    arcs = heteroclinic_arcs(LayerProblem(at, PSI))
    return [arc for arc in arcs if arc.sense == math.copysign(1, at.b)]


def splitting(at, p, arc):
    problem = LayerProblem(at, p)
    return loop_gap(problem, problem.critical[0], arc)


def mirrored(plane):
    """In y -> -y, which turns the other way."""
    a, b, d, f1, f2 = plane
    return a, -b, d, f1, -f2


@EVERY
@pytest.mark.parametrize("time", [1.0, -1.0])
def test_the_arc_leads_from_where_orbits_come_down_to_where_they_go_up(plane, time):
    for at in (made(plane, time), made(mirrored(plane), time)):
        (loop,) = heteroclinic_cycles(at)
        limits = c2.equator_equilibria(at)
        i, j = (int(np.argmin(np.abs(limits.theta - angle))) for angle in (loop.source, loop.sink))
        assert (limits.theta[i], limits.theta[j]) == (loop.source, loop.sink)
        assert (
            min(limits.lambda_rho[i], limits.lambda_theta[i]) > 0.0 > max(limits.lambda_rho[j], limits.lambda_theta[j])
        )
        sense = math.copysign(1.0, at.b)
        width = (sense * (loop.sink - loop.source)) % math.tau
        along = loop.source + sense * width * np.linspace(0.0, 1.0, 50)[1:-1]
        e = np.stack([np.cos(along), np.sin(along)], axis=-1)
        U = at.U(e)
        assert (sense * (e[:, 0] * U[:, 1] - e[:, 1] * U[:, 0]) > 0.0).all()
        ratios = limits.lambda_rho / limits.lambda_theta
        assert loop.ratio == pytest.approx(ratios[i] / ratios[j], rel=1e-12)


@EVERY
@pytest.mark.parametrize("time", [1e-4, 1e4])
def test_loops_do_not_know_the_unit_of_time(plane, time):
    (one,), (other,) = heteroclinic_cycles(made(plane)), heteroclinic_cycles(made(plane, time))
    assert (other.source, other.sink, other.ratio) == pytest.approx((one.source, one.sink, one.ratio), rel=1e-12)
    assert splitting(made(plane, time), PSI, other) == pytest.approx(splitting(made(plane), PSI, one), rel=1e-7)


@EVERY
def test_against_time_ends_change_places_and_the_gap_its_sign(plane):
    for one in (plane, mirrored(plane)):
        forward, backward = made(one), made(one, -1.0)
        (there,), (back,) = heteroclinic_cycles(forward), heteroclinic_cycles(backward)
        assert (there.source, there.sink) == pytest.approx((back.sink, back.source), abs=1e-12)
        assert there.ratio * back.ratio == pytest.approx(1.0, rel=1e-9)
        assert splitting(forward, PSI, there) == pytest.approx(-splitting(backward, PSI, back), rel=1e-8)
    assert splitting(made(plane), PSI, heteroclinic_cycles(made(plane))[0]) == pytest.approx(
        splitting(forward, PSI, there), rel=1e-8
    )


@EVERY
@pytest.mark.parametrize("time", [1.0, -1.0])
def test_the_gap_tells_where_the_separatrix_goes(plane, time):
    at = made(plane, time)
    (loop,) = heteroclinic_cycles(at)
    up = next(
        s
        for s in c2.separatrices(at, PSI)
        if s.inside and s.direction == "unstable" and math.cos(s.departure_angle - loop.sink) > 1 - 1e-9
    )
    assert (splitting(at, PSI, loop) < 0.0) == (not up.end.startswith("Q"))
