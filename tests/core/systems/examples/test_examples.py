"""The examples against what the paper and the literature state of them."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import codim2_core as c2
from codim2_core import examples, psi

positive = st.floats(0.1, 3.0)
angles = st.floats(-math.pi, math.pi)

TINY = 1e-310  # below the normal doubles digits are lost


@settings(max_examples=20)
@given(positive, positive, positive, st.floats(1.0, 20.0), angles)
def test_the_ball_sticks_below_z_crit_and_slips_above(mu, m, K, g, phi):
    ball = examples.ball_in_pool(mu, m, K, g)
    crit = 7.0 * mu * m * g / (2.0 * K)
    below, above = (np.array([math.cos(phi), math.sin(phi)]) * crit * f for f in (1.0 - 1e-9, 1.0 + 1e-9))
    (C,) = c2.critical_sets(ball, psi.tanh(), below)
    np.testing.assert_allclose(C.e, -2.0 * K / (7.0 * mu * m * g) * below, rtol=1e-12, atol=TINY)
    np.testing.assert_allclose(C.slow_flow, -5.0 * K / (7.0 * m) * below, rtol=1e-12, atol=TINY)
    assert C.kind.startswith("stable")
    assert not c2.critical_sets(ball, psi.tanh(), above)


@given(st.floats(0.1, 20.0), angles)
def test_the_balls_limit_directions_are_along_its_velocity(speed, phi):
    """Eigenvalues of theta*_1 and theta*_2, sec:ballpool."""
    ball = examples.ball_in_pool(0.2, 1.5, 0.8, 9.81)
    z = speed * np.array([math.cos(phi), math.sin(phi)])
    Q = c2.equator_equilibria(ball, z)
    pull, rub = 0.8 / 1.5 * speed, 3.5 * 0.2 * 9.81
    along = int(np.argmin(np.abs(np.exp(1j * (Q.theta - phi)) - 1.0)))
    np.testing.assert_allclose(np.exp(1j * Q.theta[along]), np.exp(1j * phi), rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(Q.lambda_rho[[along, 1 - along]], [-rub - pull, -rub + pull], rtol=0.0, atol=1e-11)
    np.testing.assert_allclose(Q.lambda_theta[[along, 1 - along]], [pull, -pull], rtol=1e-9)


@given(st.floats(0.05, 1.0), st.floats(0.05, 1.0), angles)
def test_the_block_sticks_while_gravity_is_in_the_friction_ellipse(mu1, mu2, phi):
    block = examples.tilting_block(mu1, mu2, phi)
    slips = math.atan(1.0 / math.hypot(math.cos(phi) / mu1, math.sin(phi) / mu2))
    assert len(c2.critical_sets(block, psi.constant(), (slips - 1e-9,))) == 1
    assert not c2.critical_sets(block, psi.constant(), (slips + 1e-9,))


def test_unit_vector_control_reaches_the_set_in_the_time_known_and_then_forgets_the_disturbance():
    control = examples.unit_vector_control(K=2.0, k=1.5, w1=0.7, w2=-0.4, h=0.0)
    at = control.at((0.3, -0.2))
    # sliding: e = w/K, and q falls at the rate k
    np.testing.assert_allclose(at.U((0.35, -0.2)), 0.0, atol=1e-15)
    np.testing.assert_allclose(at.W((0.35, -0.2)), [-0.45, 0.3], rtol=0.0, atol=1e-15)
    # without disturbance |(x, y)|' = -K exactly
    free = examples.unit_vector_control(w1=0.0, w2=0.0, h=0.0).at((0.0, 0.0))
    e = np.array([0.6, 0.8])
    assert free.U(e) @ e == pytest.approx(-2.0, abs=1e-15)


@given(st.floats(0.1, 6.0), st.floats(0.05, 0.5))
def test_the_ball_on_a_turntable_rolls_at_two_sevenths_of_its_rate(Omega, mu):
    table = examples.ball_on_turntable(mu, Omega)
    speed = 0.9 * 3.5 * mu * examples.GRAVITY / Omega
    v = speed * np.array([0.6, -0.8])
    flow = c2.sliding_flow(table, (*v, 0.1, 0.2))
    np.testing.assert_allclose(flow, [-2 / 7 * Omega * v[1], 2 / 7 * Omega * v[0], *v], rtol=1e-12)
    assert c2.sliding_flow(table, (*(v * 1.2), 0.1, 0.2)) is None


@pytest.mark.parametrize("example", examples.catalogue.values(), ids=lambda e: e.key)
def test_the_catalogue_gives_every_parameter_a_range_around_its_default(example):
    system = example.make()
    assert len(example.z) == system.m == len(example.slow)
    assert set(example.ranges) == set(dict(system.parameters))
    for name, value in system.parameters.items():
        low, high = example.ranges[name]
        assert low <= value <= high
    for value, (_, low, high) in zip(example.z, example.slow, strict=True):
        assert low <= value <= high
    assert len(example.launch) == 2 + system.m
    assert np.isfinite(system.at(example.z).U((1.0, 0.0))).all()
