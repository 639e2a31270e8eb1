"""Symmetries of the mathematics as symmetries of every number, also of those that cross several modules.

Turning the axes (`from_matrix`), another unit of time, reversing it, (x, y) -> (-x, -y), reflecting, and another Psi.
"""

import math

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from codim2_core import (
    ELinear,
    classify,
    critical_sets,
    equator_cycle,
    equator_equilibria,
    limit_cycles,
    psi,
    sliding_flow,
    trajectories,
)  # fmt: skip

coefficient = st.floats(-3, 3).map(lambda v: round(v, 3))
planes = st.tuples(*[coefficient] * 5)
FAMILIES = [psi.constant(), psi.rational(), psi.exponential(), psi.tanh(), psi.hill(3)]
families = st.sampled_from(FAMILIES)
B, G = np.array([[1.0, -2.0], [0.5, 0.25]]), np.array([0.5, -1.0])
CASE3 = (172.0, 186.0, -200.0, -86.0, -93.0)


def system(plane, b=B):
    return ELinear(*plane[:3], plane[3:], B=b, g=G)


def robust(plane):
    """Not within 1e-6 of any change: then a rounding of the coefficients changes no name."""
    at = system(plane)
    equator = equator_equilibria(at)
    if classify(at, psi.constant()).degeneracies or equator.distance < 1e-6 or not any(plane[:3]):
        return False
    a, b, d, f1, f2 = plane
    det = a * d + b * b
    e = math.hypot(d * f1 + b * f2, a * f2 - b * f1)
    return abs(det) > 1e-6 and abs(e - abs(det)) > 1e-6 and (np.abs(equator.lambda_rho) > 1e-6).all()


def circular(theta):
    return np.sort(np.remainder(theta + 1e-9, 2 * math.pi))


def rounding(equator, plane):
    """What roundings of the coefficients change in limit directions and eigenvalues: the more the nearer two are."""
    if not len(equator):
        return 0.0
    gaps = np.diff([*equator.theta, equator.theta[0] + 2.0 * math.pi])
    return 1e-14 * max(1.0, *map(abs, plane)) / min(1.0, float(gaps.min()))


@settings(max_examples=60)
@given(planes, families, st.integers(-300, 300))
def test_another_unit_of_time(plane, family, power):
    """Coefficients times 2^k: every rate times 2^k, every place and name the same to the last bit."""
    assume(any(plane))
    scale = 2.0**power
    one, other = system(plane), ELinear(*(v * scale for v in plane[:3]), [v * scale for v in plane[3:]], B=B, g=G)
    Q, P = equator_equilibria(one), equator_equilibria(other)
    assert (Q.theta == P.theta).all()
    assert (Q.lambda_rho * scale == P.lambda_rho).all()
    assert (Q.lambda_theta * scale == P.lambda_theta).all()
    assert classify(one, family) == classify(other, family)
    for C, D in zip(critical_sets(one, family), critical_sets(other, family), strict=True):
        assert (C.p == D.p).all()
        assert C.kind == D.kind
        assert (C.slow_flow == D.slow_flow).all()
        assert C.trace * scale == D.trace
        assert (C.jacobian * scale == D.jacobian).all()
        assert (C.eigenvalues * scale == D.eigenvalues).all()
    own, scaled = equator_cycle(one), equator_cycle(other)
    assert (own is None) == (scaled is None)
    if own is not None and scaled is not None:
        assert own.exponent == scaled.exponent
        assert own.period / scale == scaled.period


@settings(max_examples=60)
@given(planes, families)
@example(CASE3, psi.hill(4))
def test_reversing_time(plane, family):
    """U -> -U: every eigenvalue changes its sign, every place stays."""
    assume(any(plane))
    one, other = system(plane), system(tuple(-v + 0.0 for v in plane))
    Q, P = equator_equilibria(one), equator_equilibria(other)
    assert (Q.multiplicity == P.multiplicity).all()
    np.testing.assert_allclose(Q.theta, P.theta, rtol=0.0, atol=rounding(Q, plane))
    np.testing.assert_allclose(Q.lambda_rho, -P.lambda_rho, rtol=0.0, atol=rounding(Q, plane))
    np.testing.assert_allclose(Q.lambda_theta, -P.lambda_theta, rtol=0.0, atol=rounding(Q, plane))
    swap = {"stable": "unstable", "unstable": "stable"}
    for C, D in zip(critical_sets(one, family), critical_sets(other, family), strict=True):
        assert (C.e == D.e).all()
        assert (C.jacobian == -D.jacobian).all()
        assert C.trace == -D.trace
        assert C.determinant == D.determinant
        word, *rest = C.kind.split()
        assert D.kind.split() == [swap.get(word, word), *rest]
    assert (sliding_flow(one) is None) == (sliding_flow(other) is None)


@settings(max_examples=60)
@given(planes, families)
def test_reflecting(plane, family):
    """(x, y) -> (x, -y) is b -> -b, f2 -> -f2 and B -> B diag(1, -1)."""
    assume(robust(plane))
    a, b, d, f1, f2 = plane
    one, other = system(plane), system((a, -b + 0.0, d, f1, -f2 + 0.0), B @ np.diag([1.0, -1.0]))
    Q, P = equator_equilibria(one), equator_equilibria(other)
    np.testing.assert_allclose(circular(-Q.theta), circular(P.theta), rtol=0.0, atol=rounding(Q, plane))
    np.testing.assert_allclose(np.sort(Q.lambda_theta), np.sort(P.lambda_theta), rtol=0.0, atol=rounding(Q, plane))
    for C, D in zip(critical_sets(one, family), critical_sets(other, family), strict=True):
        assert (C.e == D.e * (1.0, -1.0)).all()
        assert C.kind == D.kind
        assert C.trace == D.trace
        np.testing.assert_array_equal(C.slow_flow, D.slow_flow)
    assert classify(one, family).name == classify(other, family).name


@pytest.mark.parametrize("family", FAMILIES, ids=lambda p: p.text)
def test_turned_and_reversed_trajectories(family):
    """Half a turn of the seeds is half a turn of the lines; backward in time is forward with -U."""
    plane = (-2.0, 0.5, -1.0, -0.5, 0.2)
    seeds = np.array([[0.3, 0.1], [-0.2, 0.7], [1.4, 0.3], [-0.99, 0.05]])
    options = {"t_max": 2.0, "rtol": 1e-9, "atol": 1e-11}
    one = trajectories(system(plane), family, seeds, (0, 0), **options)
    a, b, d, f1, f2 = plane
    half = trajectories(system((a, b, d, -f1, -f2)), family, -seeds, (0, 0), **options)
    np.testing.assert_allclose(one.ends[:, :2], -half.ends[:, :2], rtol=0.0, atol=1e-12)
    back = trajectories(system(plane), family, seeds, (0, 0), backward=True, **options)
    minus = trajectories(system(tuple(-v for v in plane)), family, seeds, (0, 0), **options)
    np.testing.assert_array_equal(back.ends, minus.ends)
    np.testing.assert_array_equal(back.clock, -minus.clock)


@pytest.mark.parametrize("n", [3, 4])
def test_cycles_under_all_of_them(n):
    (one,) = limit_cycles(system(CASE3), psi.hill(n))
    a, b, d, f1, f2 = CASE3
    for plane, turn in (((a, b, d, -f1, -f2), 1), ((a, -b, d, f1, -f2), -1), (tuple(-v for v in CASE3), -1)):
        (other,) = limit_cycles(system(plane), psi.hill(n))
        assert other.period == pytest.approx(one.period, rel=1e-11)
        sign = -1.0 if plane[0] < 0.0 else 1.0
        assert math.log(other.multiplier) == pytest.approx(sign * math.log(one.multiplier), rel=1e-9)
        assert other.direction == turn * one.direction
        assert other.kind == ("unstable" if sign < 0.0 else "stable")
    (scaled,) = limit_cycles(system(tuple(v / 64.0 for v in CASE3)), psi.hill(n))
    assert scaled.period == 64.0 * one.period
    assert scaled.multiplier == one.multiplier
