"""The driven mass: its motion round a circle, by the closed form of tests/core/motion/periodic."""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.motion.periodic.search import forcing_period, settled_motion

from ...motion.periodic.closed_forms import Rotating

EXAMPLE = c2.examples.catalogue["driven_mass"]
PSI = c2.psi.constant()


def circle(F=1.0, omega=2.0, S=0.5, k=1.0, eps=0.0):
    return Rotating(S, 0.0, F, omega, eps, k)


def by_size(multipliers):
    return sorted(multipliers, key=lambda one: (-round(abs(one), 6), -one.imag))


@pytest.mark.parametrize(
    "values", [{}, {"omega": 1.3, "S": 0.2}, {"F": 1.5, "k": 0.4}, {"omega": 0.6, "S": 0.9}, {"eps": 1e-3}]
)
def test_it_goes_round_with_the_amplitude_and_multipliers_of_the_closed_form(values):
    exact = circle(**values)
    eps = values.get("eps", 0.0)
    mass = EXAMPLE.make(**{name: value for name, value in values.items() if name != "eps"})
    near = np.round(exact.start, 2)
    found = c2.periodic_motion(mass, near, math.tau / exact.w, PSI, eps)
    assert found.state0 == pytest.approx(exact.start, abs=1e-7)
    assert [phase.kind for phase in found.run.phases] == ["slip"]
    np.testing.assert_allclose(by_size(found.multipliers), by_size(exact.multipliers), atol=1e-6)


def test_it_opens_next_to_its_motion_and_goes_round_twice_or_more():
    mass, exact = EXAMPLE.make(), circle()
    np.testing.assert_allclose(EXAMPLE.launch, exact.start, atol=0.02)
    assert EXAMPLE.z == EXAMPLE.launch[2:]
    period = forcing_period(mass)
    assert period == pytest.approx(math.pi)
    assert EXAMPLE.t_end > 2.0 * period
    state, _ = settled_motion(mass, EXAMPLE.launch, PSI, 0.0, EXAMPLE.t_end)
    assert state == pytest.approx(exact.start, abs=1e-6)


def test_where_the_force_is_within_friction_it_stays():
    held = c2.simulate_nonsmooth(EXAMPLE.make(F=0.4), (0.0,) * 5, (0.0, 10.0), PSI)
    assert [phase.kind for phase in held.phases] == ["slide"]
    np.testing.assert_array_equal(held.states[-1, :4], 0.0)
