"""Lyapunov exponents against closed forms, an integrator of its own, and a published chaotic pendulum."""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.motion.reference.oscillators import round_multipliers
from codim2_core.results.words import say

PENDULUM = c2.System(U=("-0.1*x - sin(z1) + 2.5*sin(z2)", "-y"), W=("x", "1"))
ONE = c2.psi.constant()


def test_of_a_linear_oscillator_they_are_the_real_parts_of_its_eigenvalues():
    """Roots of a^2 + 0.3 a + 1 (complex) across, of a + 2 along, and of a + 1 for y."""
    system = c2.System(U=("-0.3*x - z1", "-y"), W=("x", "-2*z2"))
    found = c2.lyapunov_exponents(system, (1.0, 1e-3, 0.5, 1.0), 2.0, ONE, 0.5, count=64)
    assert found.values == pytest.approx([-0.15, -0.15, -1.0, -2.0], abs=5e-3)
    assert found.values.sum() == pytest.approx(-3.3, abs=1e-8)
    assert found.reason == say("exponents", count=64, time=128.0)


def test_of_a_mass_that_friction_brakes_they_are_the_logarithms_of_its_multipliers():
    """It goes round on a circle; all four multipliers are in closed form."""
    F, S, w = 1.0, 0.5, 2.0
    mass = c2.System(U=("-z1 - c/2 + cos(2*z3)", "-z2 - s/2 + sin(2*z3)"), W=("x", "y", "1"))
    radius = math.sqrt(F * F - S * S) / abs(1.0 - w * w)
    found = c2.lyapunov_exponents(mass, (0.0, -0.55, -0.28, 0.07, 0.0), math.pi, count=64, transient=60)
    wanted = sorted((math.log(abs(v)) / math.pi for v in round_multipliers(S, w, radius)), reverse=True)
    assert found.values == pytest.approx(wanted, abs=2e-3)
    assert found.values.sum() == pytest.approx(sum(wanted), abs=1e-6)
    assert np.hypot(*found.section[-1, 2:4]) == pytest.approx(radius, abs=1e-6)


def test_a_driven_pendulum_is_as_chaotic_as_is_published():
    """0.160 for y'' + 0.1 y' + sin y = 2.5 sin t (J. C. Sprott's driven pendulum, arXiv physics/0303077)."""
    found = c2.lyapunov_exponents(PENDULUM, (0.5, 0.0, 1.0, 0.0), 2.0 * math.pi, ONE, 1e-3, count=1500)
    assert found.errors[0] < 0.008
    assert found.values[0] == pytest.approx(0.160, abs=3.0 * found.errors[0])
    assert found.values.sum() == pytest.approx(-1.1, abs=1e-8)  # the divergence of the field
    assert found.section.shape == (1500, 4)


def test_a_stick_forgets_where_it_came_from():
    """Leine's cycle: 0 along it, and all else is lost at Sigma."""
    block = c2.System(U=("-z1 - c/(1 + delta*abs(x))", "-s"), W=("x + v",), parameters={"delta": 3.0, "v": 0.2})
    found = c2.lyapunov_exponents(block, (0.0, 0.0, 0.0), 12.00103129483, count=16, transient=4)
    assert found.values[0] == pytest.approx(0.0, abs=1e-6)
    assert np.isneginf(found.values[1:]).all()
    assert (found.errors[1:] == 0.0).all()


def test_a_motion_that_ends_is_refused_with_what_ended_it():
    apart = c2.System(U=("x*x", "-y"), W=("1",))
    with pytest.raises(ValueError, match=r"0 periods could be counted, of 16 that are needed at least. It stopped"):
        c2.lyapunov_exponents(apart, (1.0, 0.0, 0.0), 2.0, ONE, 1.0, transient=0)
    with pytest.raises(ValueError, match="count is 3; give at least 16 periods"):
        c2.lyapunov_exponents(PENDULUM, (0.5, 0.0, 1.0, 0.0), 1.0, count=3)
