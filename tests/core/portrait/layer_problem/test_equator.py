"""Equilibria and the closed orbit on the equator, against the formulas of the paper in 40 digits."""

import math

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from codim2_core.portrait.layer_problem.closed_equator import equator_cycle
from codim2_core.portrait.layer_problem.equator import equator_equilibria
from codim2_core.systems.elinear import ELinear
from tests.core.exact_trigonometric import count_equilibria, polished, theta_coefficients

plain = st.one_of(st.floats(-2, 2).map(lambda v: round(v, 9)), st.integers(-20, 20).map(lambda k: k / 10))


def system(a, b, d, f1, f2):
    return ELinear(a, b, d, f=(f1, f2))


def exact_eigenvalues(q, theta):
    """(lambda_rho, lambda_theta) at the exact zero of Theta near theta."""
    a, _, d, f1, f2 = map(mp.mpf, q)
    with mp.workdps(50):
        c, s = mp.cos_sin(polished(theta_coefficients(*q), theta))
        return a * c**2 + d * s**2 + f1 * c + f2 * s, (d - a) * (c**2 - s**2) - f2 * s - f1 * c


@settings(max_examples=20, deadline=None)
@given(st.tuples(*[plain] * 5))
def test_eigenvalues(q):
    found = equator_equilibria(system(*q))
    assert found.exact_count == count_equilibria(*q)
    assert ((found.lambda_theta == 0) == (found.multiplicity > 1)).all()
    assert ((found.lambda_rho == 0) == found.radially_degenerate).all()
    for i, theta in enumerate(found.theta):
        if found.multiplicity[i] > 1:
            continue
        rho, slope = exact_eigenvalues(q, theta)
        size = sum(map(abs, q))
        bend = 4 * size / abs(slope)
        assert abs(found.lambda_theta[i] - slope) <= 1e-15 * size * (4 + bend)
        if not found.radially_degenerate[i]:
            assert abs(found.lambda_rho[i] - rho) <= 1e-15 * size * (4 + bend)
            assert np.sign(found.lambda_rho[i]) == mp.sign(rho)


def test_pitchfork_of_the_paper():
    found = equator_equilibria(system(-1, 0, -1.5, -0.5, 0))
    assert found.theta.tolist() == [0.0, math.pi]
    assert found.multiplicity.tolist() == [3, 1]
    assert found.lambda_theta.tolist() == [0.0, -1.0]
    assert found.lambda_rho.tolist() == [-1.5, -0.5]
    assert found.kind(0).endswith("triple zero (pitchfork), weakly repelling")
    # Theta = sin (1 - cos)/2 has the sign of sin: it does repel.
    assert not found.radially_degenerate.any()


def test_critical_set_at_the_equator():
    exact = system(1, 0, 2, -1, 0)
    assert equator_equilibria(exact).radially_degenerate.tolist() == [True, False]
    for side in (1e-15, -1e-15, 1e-9):
        found = equator_equilibria(system(1, 0, 2, -1 - side, 0))
        assert not found.radially_degenerate.any()
        assert np.sign(found.lambda_rho[0]) == -np.sign(side)


@pytest.mark.parametrize("power", [1, 4, 5, 9, 14])
def test_cycle_near_a_saddle_node(power):
    # a = d: the integral of 1/(b - |f| cos) is 2 pi/sqrt(b^2 - |f|^2); here |f| = 5 exactly.
    b = 5.0 * (1 + 10.0**-power)
    cycle = equator_cycle(system(2, b, 2, 3.0, 4.0))
    assert cycle is not None
    with mp.workdps(40):
        expected = float(2 * mp.pi / mp.sqrt(mp.mpf(b) ** 2 - 25))
    assert cycle.period == pytest.approx(expected, rel=4e-15 if power > 4 else 2e-15 * 10.0**power + 4e-15)
    assert cycle.exponent == pytest.approx(2 * cycle.period, rel=1e-14)
    assert cycle.direction == 1
    assert not cycle.stable_outside


def test_neutral_cycles():
    for q in ((0.0, 1.0, 0.0, 0.3, 0.2), (0.5, 1.0, -0.5, 0.0, 0.0), (0.1, 0.3, -0.1, 0.0, 0.0)):
        cycle = equator_cycle(system(*q))
        assert cycle is not None
        assert cycle.neutral
        assert cycle.exponent == 0.0
        assert "neutral" in cycle.sentence
    cycle = equator_cycle(system(0.5, 1.0, -0.5 - 1e-12, 0.0, 0.0))
    assert cycle is not None
    assert not cycle.neutral
    assert cycle.stable_outside


@pytest.mark.parametrize("second", [0.3, 1e-2, 1e-5, 1e-9, 1e-13, 1e-17])
@pytest.mark.parametrize("first", [0.0, 0.7, 1e-2, 1e-5, 1e-9, 1e-16])
@pytest.mark.parametrize("b", [1.0, -1.0])
def test_cycle_where_harmonics_are_of_very_different_sizes(first, second, b):
    """b, f and d - a far apart in size: (0, 1, 1e-5, (0, 0) once divided by zero."""
    q = (0.3, b, 0.3 + second, first * math.cos(0.7), first * math.sin(0.7))
    is_the_mean(q) or first + second > 0.9 or pytest.fail("there is no closed equator")


@pytest.mark.parametrize("f", [math.sqrt(2), 1.4142])
def test_cycle_where_two_complex_zeros_nearly_coincide(f):
    """It once cost half the digits."""
    assert is_the_mean((0.0, 1.65, 1.0, f, -f))


def is_the_mean(q):
    """Whether there is a closed equator; hold it to means over 4000 angles."""
    cycle = equator_cycle(system(*q))
    if cycle is None:
        return False
    theta = np.arange(4000) * (2 * math.pi / 4000)
    c, s = np.cos(theta), np.sin(theta)
    size = np.abs((q[2] - q[0]) * s * c + q[4] * c - q[3] * s + q[1])
    assert cycle.period == pytest.approx(2 * math.pi * (1 / size).mean(), rel=1e-13)
    speed = q[0] * c * c + q[2] * s * s + q[3] * c + q[4] * s
    assert cycle.exponent == pytest.approx(2 * math.pi * (speed / size).mean(), rel=1e-12)
    return True


def test_only_the_limit_direction_that_the_critical_set_reached_is_radially_degenerate():
    found = equator_equilibria(system(0, 1, 1e-5, 0, 1))  # two zeros of Theta within 2e-5 of each other
    assert len(found) == 2
    assert found.radially_degenerate.sum() == 1
    assert np.count_nonzero(found.lambda_rho) == 1


@pytest.mark.parametrize("power", [-490, -300, 300, 490])
@pytest.mark.parametrize("f", [(0.0, 0.0), (0.0, -1.1), (0.3, -1.1)])
def test_a_closed_equator_in_any_unit_of_time(power, f):
    """Times a power of two, even where squares over- and underflow: nothing is rounded otherwise."""
    q, unit = (-0.7, 1.5, 0.4, *f), 2.0**power
    plain, scaled = equator_cycle(system(*q)), equator_cycle(system(*(v * unit for v in q)))
    assert (scaled.exponent, scaled.period * unit) == (plain.exponent, plain.period)
    assert (scaled.direction, scaled.neutral) == (plain.direction, plain.neutral)


@pytest.mark.parametrize("size", [1.0, -1e100])
@pytest.mark.parametrize("b", [5e-324, -1e-310, 1e-308])
def test_an_equator_that_hardly_turns_has_an_infinite_period(size, b):
    """Theta = b is so far below a = d that the period 2 pi/|b|, or the exponent a times that, is beyond all doubles."""
    found = equator_cycle(ELinear(size, b, size))
    assert found.direction == math.copysign(1, b)
    assert found.period == math.inf or found.period * abs(b) == pytest.approx(2.0 * math.pi)
    assert found.exponent == math.copysign(math.inf, size)
    assert not found.neutral
