"""Stribeck's law: the formula, what of it Sigma sees, and where steady sliding loses its stability."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import codim2_core as c2
from codim2_core import psi
from codim2_core.systems.mechanics import Mechanism, stribeck

STATIC, KINETIC, SPEED = 0.6, 0.4, 0.05


def block(law, force=("F", 0), **parameters):
    """A block of mass 1 pressed with 10 N."""
    return Mechanism(
        M=np.eye(2), J=np.eye(2), force=force, mu=law, normal=10, velocities=("vx", "vy"), parameters=parameters
    )


@settings(max_examples=20)
@given(
    st.floats(0.1, 1.0), st.floats(0.05, 1.0), st.floats(0.01, 1.0), st.sampled_from([0.5, 1.0, 2.0, 3.0]),
    st.floats(0.0, 0.3), st.floats(0.0, 2.0), st.floats(0.0, 6.28),
)  # fmt: skip
def test_the_coefficient_is_stribecks(static, kinetic, speed, exponent, viscous, v, angle):
    as_names = {"mus": static, "muk": kinetic, "vs": speed, "d": exponent, "kv": viscous}
    system = block(stribeck("mus", "muk", "vs", "d", "kv"), **as_names, F=0.0).system
    same = block(stribeck(*as_names.values()), F=0.0).system
    e = math.cos(angle), math.sin(angle)
    known = {"c": e[0], "s": e[1], "x": v * e[0], "y": v * e[1]}
    mu = kinetic + (static - kinetic) * math.exp(-((v / speed) ** exponent)) + viscous * v
    for one in (system, same):
        U = [float(row.evaluate({**dict(one.parameters), **known})) for row in one.U]
        assert np.array(U) == pytest.approx(-10.0 * mu * np.array(e), rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("exponent", [0.5, 1.0, 2.0])
@pytest.mark.parametrize("pull", [5.0, 7.0])
def test_sigma_sees_the_static_coefficient_alone(exponent, pull):
    """At speed 0: so limit directions, their eigenvalues and critical sets are Coulomb's, whatever the slope there."""
    law = block(stribeck(STATIC, KINETIC, SPEED, exponent, 0.3), F=pull).system
    coulomb = block(STATIC, F=pull).system
    mine, known = c2.equator_equilibria(law), c2.equator_equilibria(coulomb)
    assert mine.theta == pytest.approx(known.theta, abs=1e-12)
    assert mine.lambda_rho == pytest.approx(known.lambda_rho, rel=1e-12)
    assert mine.lambda_theta == pytest.approx(known.lambda_theta, rel=1e-12)
    mine, known = (c2.critical_sets(one, psi.tanh()) for one in (law, coulomb))
    assert len(mine) == len(known) == (pull < 10.0 * STATIC)
    for one, other in zip(mine, known, strict=True):
        assert one.e == pytest.approx(other.e, abs=1e-12)
        assert one.jacobian == pytest.approx(other.jacobian, rel=1e-9, abs=1e-12)


def on_belt(v, viscous=0.0):
    """Mass and spring 1, N = 1, on a belt of speed v."""
    return Mechanism(
        M=np.eye(2), J=np.eye(2), force=("-q", 0), mu=stribeck(STATIC, KINETIC, SPEED, 2.0, viscous), normal=1,
        velocities=("vx", "vy"), slow=("q",), rates={"q": "vx"}, surface=(v, 0.0),
    )  # fmt: skip


def slope(v, viscous):
    return -2.0 * v / SPEED**2 * (STATIC - KINETIC) * math.exp(-((v / SPEED) ** 2)) + viscous


@pytest.mark.parametrize(("v", "viscous"), [(0.1, 0.0), (0.1, 0.5), (0.15, 0.02)])
def test_steady_sliding_swells_where_friction_falls(v, viscous):
    """Beside steady sliding, q'' + mu'(v) q' + q = 0: it swells where mu falls with the speed, whatever mu(0) is."""
    belt = on_belt(v, viscous)
    mu = KINETIC + (STATIC - KINETIC) * math.exp(-((v / SPEED) ** 2)) + viscous * v
    start, small = belt.state(vx=0.0, vy=0.0, q=mu + 1e-6), slope(v, viscous)
    w = math.sqrt(1.0 - small * small / 4.0)
    run = c2.simulate_nonsmooth(belt.system, start, (0.0, 2.0 * math.pi / w), rtol=1e-12)
    assert (run.states[-1, 2] - mu) / 1e-6 == pytest.approx(math.exp(-small * math.pi / w), rel=1e-4)


def test_it_sticks_and_slips_where_steady_sliding_swells():
    slow = c2.simulate_nonsmooth(on_belt(0.05).system, (0.0, 0.0, 0.0), (0.0, 60.0))
    assert [phase.kind for phase in slow.phases].count("slide") >= 3
    steady = c2.simulate_nonsmooth(on_belt(0.05, 5.0).system, (0.0, 0.0, 0.0), (0.0, 60.0))
    assert [phase.kind for phase in steady.phases] == ["slide", "slip"]


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"static": None}, "static is None; give a number, or text."),
        ({"speed": 0.0}, "speed is 0; give a positive number, or text."),
        ({"exponent": -1}, "exponent is -1; give a positive number, or text."),
    ],
)
def test_what_is_wrong_is_said(change, said):
    with pytest.raises(ValueError, match=said):
        stribeck(**{"static": 0.5, "kinetic": 0.3, "speed": 0.1, **change})
