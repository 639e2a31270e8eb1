"""What surely slides where it arrives at Sigma."""

from __future__ import annotations

import math

import numpy as np
import pytest

from codim2_core import System, critical_sets
from codim2_core.initial_value.compiled import functions_of
from codim2_core.initial_value.field import field
from codim2_core.initial_value.kernels import slow
from codim2_core.initial_value.kernels.arrival import (
    _along,
    _captured,
    _ends_on_a_set,
    _layer_rate,
    _limit_direction,
    _size,
    slides,
)
from codim2_core.stepping.layout import PARAMETERS
from codim2_core.stepping.numbers import PSI

from .placing import CURVED, HILL, TANH, directions, placed


def _slides(system, theta, psi=None, affine=False, line=(0.0, 0.0), z=()):
    S, P = placed(system, z, psi or TANH), np.zeros(PARAMETERS)
    P[PSI] = (psi or TANH).parameter
    gain = int(functions_of(field(system), psi or TANH).addresses[2])
    found = slides(S, P, gain, 2 + len(z), affine, psi is not None, *line, theta)
    return bool(found), (float(S[slow.PLACE]), float(S[slow.PLACE + 1]))


@pytest.mark.parametrize(
    ("C", "A", "expected"),
    [
        ((0.4, -0.2), (-1.0, 2.0, -0.5, -1.5), True),  # A + A^T negative definite
        ((0.9, -0.6), (-1.0, 2.0, -0.5, -1.5), False),  # outside
        ((0.4, -0.2), (-1.0, 2.6, 0.5, -1.5), False),  # A + A^T is not
        ((0.4, -0.2), (-2.0, 0.0, 0.0, -1e-7), False),  # hardly
        ((-0.3, 0.8), (-1.0, -3.0, 3.0, -0.2), True),  # round and round onto it: there is no direction
        ((0.4, -0.2), (-1.0, 0.6, -0.2, -1.5), True),
    ],
)
def test_what_arrives_slides_on_the_only_set(C, A, expected):
    a, b, c, d = A
    system = System(U=(f"{a}*(c - {C[0]}) + {b}*(s - {C[1]})", f"{c}*(c - {C[0]}) + {d}*(s - {C[1]})"))
    found, place = _slides(system, 0.3, affine=True)
    assert found is expected
    if expected:
        assert place == pytest.approx(C, abs=1e-14)


def test_what_arrives_slides_where_two_orbits_end():
    system = System(U=("-(c - 0.4) + 0.6*(s + 0.2)", "-0.2*(c - 0.4) - 1.5*(s + 0.2)"))
    theta = _attracting(system)
    found, place = _slides(system, theta, TANH)
    assert found
    assert place == pytest.approx((0.4, -0.2), abs=1e-9)
    assert _slides(system, theta + 0.1, TANH)[0]
    assert not _slides(system, theta + 0.5, TANH)[0]  # no direction is near
    assert not _slides(system, theta)[0]  # with no Psi known


def _attracting(system):
    for theta in directions(system, ()):
        c, s = math.cos(theta), math.sin(theta)
        D = field(system).jacobian(c, s, 0.0, 0.0, ())[:2, :2]
        u, v = field(system).value(c, s, 0.0, 0.0)[:2]
        if c * u + s * v < 0.0 and -s * (D[0] @ [-s, c]) + c * (D[1] @ [-s, c]) < c * u + s * v:
            return theta
    raise AssertionError("there is none")


@pytest.mark.parametrize("psi", [TANH, HILL], ids=lambda psi: psi.text)
def test_of_two_sets_the_direction_tells_the_one(psi):
    """c = 0.5 and c = -0.5 attract, 0 repels in c; all attract in s."""
    two = System(U=("3*c*(0.25 - c**2)", "-4*s"))
    for theta, e in ((0.05, 0.5), (math.pi - 0.05, -0.5)):
        found, place = _slides(two, theta, psi)
        assert found
        assert place == pytest.approx((e, 0.0), abs=1e-9)
    assert not _slides(two, 0.5 * math.pi, psi)[0]  # where nothing arrives


def test_where_orbits_on_both_sides_end_on_two_sets_it_is_not_sure():
    """The one between them, up c = 0, ends at the saddle."""
    assert not _slides(System(U=("c*(0.5 - 4*s**2 - c**2)", "-1.5*s")), 0.5 * math.pi, TANH)[0]


def test_in_a_line_it_slides_on_the_first_zero_if_that_attracts():
    n = (0.6, -0.8)
    q = "(0.6*c - 0.8*s)"
    line = System(U=(f"0.6*({q} - 0.2)*({q} + 0.5)*(-1.3 - {q})", f"-0.8*({q} - 0.2)*({q} + 0.5)*(-1.3 - {q})"))
    theta = math.atan2(-0.8, 0.6)
    found, place = _slides(line, theta, line=n)
    assert found
    assert place == pytest.approx((0.2 * 0.6, -0.2 * 0.8), abs=1e-12)
    assert not _slides(line, theta + math.pi, line=n)[0]  # it leaves at that end
    through = System(U=("-0.6 + 0*c", "0.8 + 0*c"))
    assert not _slides(through, theta, line=n)[0]
    flat = System(U=(f"-0.6*({q} - 0.2)**3", f"0.8*({q} - 0.2)**3"))
    assert not _slides(flat, theta, line=n)[0]  # it may attract or not
    near = System(U=("-0.6*(0.6*c - 0.8*s + 0.9999999)", "0.8*(0.6*c - 0.8*s + 0.9999999)"))
    assert not _slides(near, theta, line=n)[0]  # within 1e-6 of the other end


@pytest.mark.parametrize(
    ("D", "away", "attracts"),
    [
        ((-1.0, 0.5, -0.5, -1.0), 0.0, True),
        ((-1.0, 0.5, -0.5, -1.0), 0.005, True),
        ((-1.0, 0.5, -0.5, -1.0), 0.03, False),
        ((-1.0, 4.0, -1.5, -1.0), 0.0, False),  # along C it repels: an eigenvalue of D e_Psi may be small
        ((-0.3, -2.0, 1.9, -0.3), 0.0, True),
        ((-1.0, -1.5, 4.0, -1.0), 0.0, False),
        ((1.0, 0.5, -0.5, -3.0), 0.0, False),  # a saddle
        ((-1.0, 0.999, 0.995, -1.0), 0.0, False),  # hardly a node
        ((1.0, 0.5, -0.5, 1.0), 0.0, False),
        ((-3.0, 2.0, -4.0, 0.9), 0.0, None),
        ((-3.0, 2.9, 2.9, -3.0), 0.0, True),
        ((0.0, -2.0, 2.0, 0.0), 0.0, False),  # a centre
    ],
)
def test_an_orbit_has_ended_at_a_set_that_attracts_under_every_psi(D, away, attracts):
    e, n = np.array([0.3, 0.4]), np.array([0.6, 0.8])
    a, b, c, d = D
    system = System(U=(f"{a}*(c - 0.3) + {b}*(s - 0.4)", f"{c}*(c - 0.3) + {d}*(s - 0.4)"))
    J, across = np.array(D).reshape(2, 2), np.array([-n[1], n[0]])
    if attracts is None:  # both parts of the trace, by themselves
        attracts = bool(max(n @ J @ n, across @ J @ across) < 0.0)
    (C,) = critical_sets(system, TANH)
    S, P = placed(system, ()), np.zeros(PARAMETERS)
    gain = int(functions_of(field(system), TANH).addresses[2])
    p = C.p + away * n
    assert bool(_captured(S, P, gain, 0, p[0], p[1])) is attracts
    np.testing.assert_allclose(S[slow.PLACE : slow.PLACE + 2], e, atol=1e-12)


def _gain(psi=TANH):
    return int(functions_of(field(CURVED), psi).addresses[2])


@pytest.mark.parametrize("which", range(4))
def test_sizes_are_those_of_the_largest_slope_and_of_u(which):
    S, D = np.zeros(slow.EXTENT), [0.5, -0.4, 0.3, -0.2]
    D[which] *= -10.0
    S[slow.TABLE : slow.TABLE + 2], S[slow.TABLE + 6 : slow.TABLE + 8] = D[:2], D[2:]
    S[slow.RATES : slow.RATES + 2] = -3.0, 0.25
    largest = abs(D[which])
    assert _size(S, 2) == pytest.approx((largest, largest + 3.25), rel=1e-15)


@pytest.mark.parametrize("n", [(0.6, -0.8), (-0.8, 0.6), (1.0, 0.0)])
@pytest.mark.parametrize("q", [-0.9, 0.3])
def test_along_a_line_u_and_its_slope_are_those_of_the_field(n, q):
    z, n = (0.7, 0.3), np.array(n)
    S, at = placed(CURVED, z), field(CURVED)
    value, slope = _along(S, 2, *n, q)
    assert value == pytest.approx(n @ at.value(*(q * n), 0.0, 0.0, *z)[:2], rel=1e-13)
    assert slope == pytest.approx(n @ at.jacobian(*(q * n), 0.0, 0.0, z)[:2, :2] @ n, rel=1e-13)


@pytest.mark.parametrize("psi", [TANH, HILL], ids=lambda psi: psi.text)
def test_the_rate_on_the_disc_is_that_of_the_layer_problem(psi):
    """(p, q)' = U - (p, q) ((p, q).U), at e_Psi(p, q)."""
    z = (0.7, 0.3)
    S, P = placed(CURVED, z, psi), np.zeros(PARAMETERS)
    P[PSI] = psi.parameter
    for place in ((0.3, -0.5), (-0.7, 0.6), (1e-3, 0.02)):
        p, r = np.array(place), math.hypot(*place)
        e = p / r * float(psi.modulus(r / math.sqrt(1.0 - r * r)))
        U = np.array(field(CURVED).value(*e, 0.0, 0.0, *z)[:2])
        np.testing.assert_allclose(_layer_rate(S, P, _gain(psi), *place), U - p * (p @ U), rtol=1e-11)
        np.testing.assert_allclose(S[slow.PLACE : slow.PLACE + 2], e, rtol=1e-12)
    assert np.isnan(_layer_rate(S, P, _gain(psi), 0.6, 0.8)).all()
    assert np.isnan(_layer_rate(S, P, _gain(psi), -0.9, 0.9)).all()


def test_an_arrival_comes_to_the_limit_direction_that_it_is_led_to():
    """From both sides, if that attracts along the equator and inward; elsewhere it is not sure."""
    told = {True: 0, False: 0}
    for z in ((1.2, 0.4), (-1.0, 0.3), (2.5, -1.0), (0.2, 0.3)):
        at, S = field(CURVED), placed(CURVED, z)
        for theta in directions(CURVED, z):
            n, t = np.array([math.cos(theta), math.sin(theta)]), np.array([-math.sin(theta), math.cos(theta)])
            radial = n @ at.value(*n, 0.0, 0.0, *z)[:2]
            attracts = bool(max(radial, t @ at.jacobian(*n, 0.0, 0.0, z)[:2, :2] @ t - radial) < -1e-3)
            for away in (0.0, 0.05, -0.05):
                found = _limit_direction(S, 2, theta + away)
                assert bool(found == pytest.approx(theta, abs=1e-9)) is attracts
                assert attracts or math.isnan(found)
            told[attracts] += 1
    assert told[True] > 1
    assert told[False] > 1


@pytest.mark.parametrize("unit", [1e-9, 1.0, 1e9])
def test_where_an_arrival_comes_to_depends_on_no_unit_of_time(unit):
    U = ("-c + s/2", "-2*s + c/4")
    theta = min(directions(System(U=U), ()), key=abs)  # 0.22: lambda_rho = -0.89 and lambda_theta = -1.22
    S = placed(System(U=tuple(f"{unit}*({row})" for row in U)), ())
    assert _limit_direction(S, 0, theta + 0.1) == pytest.approx(theta, abs=1e-8)


@pytest.mark.parametrize(("lean", "there"), [(0.25, True), (0.29, True), (0.31, False)])
def test_an_arrival_is_led_no_farther_than_newtons_method_is_sure(lean, there):
    """Theta = -sin(theta - 1), near enough to a straight line."""
    system = System(U=(f"{-math.cos(1.0)} - 2*c", f"{-math.sin(1.0)} - 2*s"))
    S = placed(system, ())
    at = 1.0 + math.pi
    for side in (-1.0, 1.0):
        found = _limit_direction(S, 0, at + side * lean)
        assert bool(found == pytest.approx(at, abs=1e-12)) is there
        assert there or math.isnan(found)


def test_an_arrival_past_another_direction_is_not_sure():
    """Theta = 0 at 0, 0.1 and 0.2, about: the one between repels."""
    system = System(U=("-c - s*(-40*s*(s - 0.1*c)*(s - 0.2*c))", "-s + c*(-40*s*(s - 0.1*c)*(s - 0.2*c))"))
    S = placed(system, ())
    for theta, to in ((0.25, math.atan(0.2)), (0.19, math.atan(0.2)), (-0.05, 0.0), (0.01, 0.0)):
        assert _limit_direction(S, 0, theta) == pytest.approx(to, abs=1e-9)
    for theta in (
        math.atan(0.1),
        0.101,
        0.0985,
        0.149,
        0.15,
        0.051,
    ):  # two leap
        assert math.isnan(_limit_direction(S, 0, theta))


@pytest.mark.parametrize("psi", [TANH, HILL], ids=lambda psi: psi.text)
def test_an_orbit_from_beside_the_equator_ends_on_the_set_that_it_is_led_to(psi):
    """c = 0.5 and c = -0.5 attract, on both sides of c = 0."""
    two = System(U=("3*c*(0.25 - c**2)", "-4*s"))
    P = np.zeros(PARAMETERS)
    P[PSI] = psi.parameter
    for angle, c in ((0.3, 0.5), (-1.0, 0.5), (2.8, -0.5), (4.0, -0.5)):
        S = placed(two, (), psi)
        assert _ends_on_a_set(S, P, _gain(psi), 0, angle)
        np.testing.assert_allclose(S[slow.PLACE : slow.PLACE + 2], [c, 0.0], atol=1e-12)
    for turns in (System(U=("-s", "c")), System(U=("c", "s"))):  # round and round; outward
        assert not _ends_on_a_set(placed(turns, (), psi), P, _gain(psi), 0, 0.3)
