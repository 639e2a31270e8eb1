"""A disc that slides and spins: against quadrature over its base, and against what was published."""

import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import codim2_core as c2
from codim2_core import examples

angles = st.floats(-math.pi, math.pi)


def _sums(y, R):
    """Sums over a disc of radius R of the velocity's direction, and of its moment, turning about (0, y).

    By rays from there, at an angle phi, along which the direction is (-sin phi, cos phi): smooth in one angle.
    """
    inside = y < R
    half = math.pi if inside else math.asin(R / y)

    t, weight = np.polynomial.legendre.leggauss(300)
    end = math.pi if inside else math.pi / 2.0
    t, weight = (t + 1.0) * end / 2.0, weight * end / 2.0
    phi = (t if inside else half * np.sin(t)) - math.pi / 2.0
    middle, reach = -y * np.sin(phi), np.sqrt(R**2 - (y * np.cos(phi)) ** 2)
    near, far = np.zeros_like(t) if inside else middle - reach, middle + reach
    square, cube = (far**2 - near**2) / 2.0, (far**3 - near**3) / 3.0
    weight = 2.0 * weight * (1.0 if inside else half * np.cos(t))
    return float(weight @ (-np.sin(phi) * square)), float(weight @ (cube + y * np.sin(phi) * square))


def resistances(v, w, eta=0.0):
    """Force and torque over mu m g R of an annulus under uniform pressure: means over its base."""
    whole, inner = _sums(v / w, 1.0), _sums(v / w, eta) if eta else (0.0, 0.0)
    return tuple((a - b) / (math.pi * (1.0 - eta**2)) for a, b in zip(whole, inner, strict=True))


def test_force_and_torque_are_those_of_the_base():
    disc, annulus = (
        examples.spinning_disc(0.8, mu=1.0, g=1.0).at(()),
        examples.spinning_annulus(0.5, mu=1.0, g=1.0).at(()),
    )
    for theta in (0.02, 0.4, 0.9, 1.2, 1.55):
        e = np.array([math.cos(theta), math.sin(theta)])
        F, T = resistances(*e)
        assert pytest.approx(np.array([-F, -T / 0.64]), rel=1e-12, abs=1e-13) == disc.U(e)
        F, T = resistances(*e, eta=0.5)
        assert pytest.approx(np.array([-F, -T / 0.625]), rel=1e-12, abs=1e-13) == annulus.U(e)


@settings(max_examples=20)
@given(angles)
@example(0.0)
@example(math.pi / 2)
@example(math.pi / 4)
@example(1e-9)
@example(math.pi / 2 - 1e-9)
def test_slopes_are_those_of_the_potential(theta):
    """Force and torque are the slopes of the power that friction takes, of degree 1 in (v, w).

    So a rotor vanishes, tangentially: with U = -(F, T/k^2) on |e| = 1, (cos, k^2 sin).U' = 0 for U' by the angle.
    """
    e, k = np.array([math.cos(theta), math.sin(theta)]), 0.8
    at = examples.spinning_disc(k, mu=1.0, g=1.0).at(())
    turn = at.DU(e) @ np.array([-e[1], e[0]])
    assert e[0] * turn[0] + k**2 * e[1] * turn[1] == pytest.approx(0.0, abs=1e-12)
    assert at.U(-e) == pytest.approx(-at.U(e), abs=1e-15)
    assert at.U(e * [1, -1]) == pytest.approx(at.U(e) * [1, -1], abs=1e-15)


def stops(system):
    """v/(R omega) of limit directions with v and omega positive."""
    theta = c2.equator_equilibria(system).theta
    return (1.0 / np.tan(theta[(theta > 1e-6) & (theta < math.pi / 2 - 1e-6)])).tolist()


def test_a_uniform_disc_stops_along_one_direction():
    (ratio,) = stops(examples.spinning_disc())
    assert ratio == pytest.approx(0.653002, abs=6e-7)


@pytest.mark.parametrize(("k", "published"), [(0.55, 1.156), (0.65, 0.809), (0.75, 0.509)])
def test_by_its_radius_of_gyration(k, published):
    (ratio,) = stops(examples.spinning_disc(k))
    assert ratio == pytest.approx(published, abs=6e-4)


@pytest.mark.parametrize(("eta", "published"), [(0.25, 0.69009), (0.5, 0.77447), (0.75, 0.88047), (0.9, 0.95083)])
def test_an_annulus(eta, published):
    (ratio,) = stops(examples.spinning_annulus(eta))
    assert ratio == pytest.approx(published, abs=6e-6)


@pytest.mark.parametrize(("at", "pure"), [(0.5, 0.0), (math.sqrt(2.0 / 3.0), math.pi / 2)])
def test_a_pitchfork_of_limit_directions(at, pure):
    """At k = 1/2 out of pure sliding, at sqrt(2/3) into pure spinning: two directions meet it, and it turns."""

    def seen(k):
        found = c2.equator_equilibria(examples.spinning_disc(k))
        one = np.argmax(np.cos(found.theta - pure))
        return len(found.theta), found.lambda_theta[one], found.multiplicity[one]

    within, beyond = (at + 1e-4, at - 1e-4) if pure == 0.0 else (at - 1e-4, at + 1e-4)
    assert (seen(within)[0], seen(beyond)[0]) == (8, 4)
    assert seen(within)[1] * seen(beyond)[1] < 0.0
    assert seen(at)[0] == 4
    assert seen(at)[1] == pytest.approx(0.0, abs=1e-12)
    assert seen(at)[2] == 3


@settings(max_examples=2)
@given(st.floats(0.2, 3.0), st.floats(0.2, 3.0))
def test_both_stop_at_once(v, w):
    run = c2.simulate_nonsmooth(examples.spinning_disc(), (v, w), (0.0, 5.0))
    assert [phase.kind for phase in run.phases] == ["slip", "slide"]
    end = run.phases[0].t_end
    x, y = run.dense(end * (1.0 - 1e-7))[:2]
    assert x / y == pytest.approx(0.653, abs=0.02)
