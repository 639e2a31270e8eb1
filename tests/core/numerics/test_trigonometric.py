"""Zeros of trigonometric polynomials of degree 2, against Sturm sequences and 50-digit Newton."""

import math
import random
from itertools import pairwise

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from codim2_core.numerics.trigonometric import radial_zeros, real_zeros, tangential_zeros
from tests.core.exact_trigonometric import count_equilibria, count_zeros, integers, root_error, theta_coefficients

plain = st.floats(-2, 2)
grid = st.integers(-40, 40).map(lambda k: k / 20)
small = st.sampled_from([0.0, 1.0, -1.0, 0.5, -0.5, 2.0, -1.5])
wide = st.builds(lambda m, e: m * 10.0**e, st.floats(-1, 1), st.integers(-149, 149))
five = st.one_of(*(st.tuples(*[s] * 5) for s in (plain, grid, small, wide, st.one_of(plain, small, wide))))


def check(zeros, count, identically=False):
    """Counts and the invariants every answer keeps."""
    assert zeros.exact_count == count
    assert zeros.identically_zero or sum(zeros.multiplicity) in (0, 2, 4)
    assert list(zeros.theta) == sorted(zeros.theta)
    assert all(0.0 <= t < 2 * math.pi for t in zeros.theta)
    assert [s == 0.0 for s in zeros.slope] == [m > 1 for m in zeros.multiplicity]
    if zeros.identically_zero or max(zeros.multiplicity, default=1) > 1:
        assert zeros.distance == 0.0
        return
    assert zeros.distance > 0.0
    assert len(zeros.theta) == count
    assert all((x < 0.0) != (y < 0.0) for x, y in pairwise(zeros.slope))


@settings(max_examples=20, deadline=None)
@given(five)
@example((-1.0, 0.0, -1.5, -0.5, 0.0))
@example((0.0, 1e-320, 1.0, 0.0, 0.0))
@example((0.0, 0.5, 1.0, 0.0, 0.0))
@example((0.0, 1.0, 1e150, 1e-150, 1e-170))
@example((4.735007393174035e34, 1e21, 1e53, 0.0, 1e53))  # d - a has more digits than a double
def test_counts_and_digits_of_theta(q):
    zeros = tangential_zeros(*q)
    check(zeros, count_equilibria(*q))
    coefficients = theta_coefficients(*q)
    size = max(map(abs, q))
    for theta, slope in zip(zeros.theta, zeros.slope, strict=True):
        # The reference takes Newton steps in 50 digits and needs a slope that those can see.
        if abs(slope) > 1e-30 * size:
            assert root_error(coefficients, theta)[0] < 5


@settings(max_examples=20, deadline=None)
@given(five)
def test_counts_of_general_polynomials(q):
    check(real_zeros(*q), count_zeros(*q))


@settings(max_examples=20, deadline=None)
@given(five)
def test_counts_of_radial_zeros(q):
    a, d, f1, f2 = q[:4]
    i, j, k, n = integers((a, d, f1, f2))
    check(radial_zeros(a, d, f1, f2), count_zeros(i + j, 2 * k, 2 * n, i - j, 0))


def on_stratum(a, b, d, theta):
    """Equation eq:tangencies, in doubles."""
    c, s = math.cos(theta), math.sin(theta)
    return b * s - (a - d) * c**3, (a - d) * s**3 - b * c


@pytest.mark.parametrize("family", ["general", "typed", "a = d", "b = 0", "cusp", "fourfold", "f = 0"])
def test_strata_computed_in_doubles_are_named(family):
    rng = random.Random(11)
    missed, n = 0, 100
    for _ in range(n):
        a, b, d = (rng.uniform(-2, 2) for _ in range(3))
        theta, order = rng.uniform(0, 2 * math.pi), 2
        if family == "typed":
            a, b, d = (round(v * 20) / 20 for v in (a, b, d))
        elif family == "a = d":
            d = a
        elif family == "b = 0":
            b = 0.0
        elif family == "cusp":
            b, order = 1.5 * (d - a) * math.sin(2 * theta), 3
        elif family == "fourfold":
            theta = rng.choice((1, 5)) * math.pi / 4
            b, order = 1.5 * (d - a), 4
        f1, f2 = on_stratum(a, b, d, theta)
        if family == "f = 0":
            b, f1, f2 = 0.5 * (d - a), 0.0, 0.0
        zeros = tangential_zeros(a, b, d, f1, f2)
        check(zeros, count_equilibria(a, b, d, f1, f2))
        named = [(t, m) for t, m in zip(zeros.theta, zeros.multiplicity, strict=True) if m >= order]
        missed += not named
        if family == "f = 0":
            assert zeros.multiplicity == (2, 2)
        for t, _ in named:
            # A double zero is as sharp as the bend there; a triple or fourfold one moves with a root of rounding.
            off = min(abs(math.remainder(t - s, 2 * math.pi)) for s in (theta, theta + math.pi))
            assert family == "f = 0" or off < 1e-4
    # Five roundings can, rarely, leave a computed point farther off than one rounding of every input.
    assert missed <= n // 100


# (a, b, d, f1, f2), multiplicities in order of theta, which coefficients to move. Moving f1 = 0.6 by 1e-15 when
# a = d leaves a point within one rounding of every input, so that one is not here.
STRATA = {
    "pitchfork at 0": ((-1.0, 0.0, -1.5, -0.5, 0.0), (3, 1), (0, 2, 3)),
    "pitchfork at pi": ((-1.0, 0.0, -1.5, 0.5, 0.0), (1, 3), (0, 2, 3)),
    "pitchfork at pi/2": ((1.0, 0.0, 3.0, 0.0, 2.0), (1, 3), (2, 4)),
    "a = d, |f| = |b|": ((0.0, 1.0, 0.0, 0.6, 0.8), (2,), (1, 4)),
    "a = d not 0": ((7.0, -1.0, 7.0, 0.6, 0.8), (2,), (1, 4)),
    "f = 0, 2b = d - a": ((0.0, 0.5, 1.0, 0.0, 0.0), (2, 2), (1, 2)),
    "f = 0, 2b = a - d": ((0.0, -0.5, 1.0, 0.0, 0.0), (2, 2), (1, 2)),
}


@pytest.mark.parametrize("scale", [1.0, 2.0**-498, 2.0**496])
@pytest.mark.parametrize("name", STRATA)
def test_strata_and_both_sides(name, scale):
    q, multiplicity, movable = STRATA[name]
    scaled = tuple(v * scale for v in q)
    assert tangential_zeros(*scaled).multiplicity == multiplicity
    assert tangential_zeros(*(v * 1e149 for v in q)).multiplicity == multiplicity
    for k in movable:
        for power in (3, 6, 9, 12, 15):
            for side in (1, -1):
                moved = list(scaled)
                moved[k] *= 1 + side * 10.0**-power
                zeros = tangential_zeros(*moved)
                assert max(zeros.multiplicity, default=1) == 1
                check(zeros, count_equilibria(*moved))
                coefficients = theta_coefficients(*moved)
                assert all(root_error(coefficients, t)[0] < 5 for t in zeros.theta)


def test_axes_are_exact():
    assert tangential_zeros(1.0, 0.0, 2.0, 0.3, 0.0).theta[::2] == (0.0, math.pi)
    assert tangential_zeros(0.1, 0.0, 0.1, 0.3, 0.0).theta == (0.0, math.pi)
    zeros = tangential_zeros(1.0, 0.0, 2.0, 0.0, 0.3).theta
    assert 0.5 * math.pi in zeros
    assert 1.5 * math.pi in zeros
    assert tangential_zeros(1.0, 0.0, 2.0, 0.0, 0.0).theta == (0.0, 0.5 * math.pi, math.pi, 1.5 * math.pi)
    assert tangential_zeros(-1.0, 0.0, -1.5, -0.5, 0.0).theta == (0.0, math.pi)


def test_tiny_angles():
    # Theta = -f1 sin + b: one zero at asin(b/f1); below 0 by less than a spacing it is 0.0, not nearly 2 pi.
    assert tangential_zeros(0.0, 1e-17, 0.0, 1.0, 0.0).theta[0] == 1e-17
    assert tangential_zeros(0.0, -1e-17, 0.0, 1.0, 0.0).theta[0] == 0.0
    assert tangential_zeros(0.0, -1e-14, 0.0, 1.0, 0.0).theta[1] == pytest.approx(2 * math.pi - 1e-14, abs=1e-15)
    assert tangential_zeros(0.0, 1e-100, 0.0, 1e100, 0.0).theta[0] == pytest.approx(1e-200, rel=1e-14)


def test_all_directions():
    for q in ((1.0, 0.0, 1.0, 0.0, 0.0), (0.0,) * 5, (0.1 + 0.2, 0.0, 0.3, 0.0, 0.0)):
        assert tangential_zeros(*q).identically_zero
    nearly = tangential_zeros(1.0, 0.0, 1.0 + 1e-15, 0.0, 0.0)
    assert nearly.theta == (0.0, 0.5 * math.pi, math.pi, 1.5 * math.pi)
    assert real_zeros(0.0, 0.0, 0.0, 0.0, 0.0).identically_zero
    assert radial_zeros(0.0, 0.0, 0.0, 0.0).identically_zero
    assert real_zeros(1.0, 0.0, 0.0, 0.0, 0.0).theta == ()
