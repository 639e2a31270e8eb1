"""The equator of general systems: the paper's examples, closed forms, and zeros counted by a net that is much finer."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import codim2_core as c2
from codim2_core import ELinear, equator_cycle, equator_equilibria
from codim2_core.numerics.fourier_zeros import series, zeros
from codim2_core.portrait.layer_problem.equator_zeros import equator_zeros
from codim2_core.systems.typed import System
from tests.core.general_systems import ATTRACTING, NONUNIQUE, circle, polynomials, smooth
from tests.core.strategies import systems

THIRD = math.pi / 3


def test_attracting_and_repelling_directions():
    """sec:mateslidecross: Q_i at (i - 1) pi/3; lambda_rho = 2 cos^3 - cos/2 - 1 (the paper's formula slips)."""
    found = equator_equilibria(ATTRACTING, 0.3)
    np.testing.assert_allclose(found.theta, [i * THIRD for i in range(6)], rtol=0.0, atol=2e-15)
    np.testing.assert_allclose(found.lambda_rho, [0.5, -1, -1, -2.5, -1, -1], rtol=1e-14)
    np.testing.assert_allclose(found.lambda_theta, [-1.5, 1.5] * 3, rtol=1e-14)
    assert found.proven
    assert "degree 3" in found.certificate
    assert found.exact_count == 6
    assert found.kind(0) == "radially repelling, angularly attracting"


@pytest.mark.parametrize("z", [0.0, 0.5, -0.8, 0.84])
def test_eight_directions_while_chi_is_small(z):
    """sec:nonunique with the errata: 8 directions while |z| < 2^(-1/4)."""
    chi2 = ((1 + 2 * z**2) / (1 + z**2)) ** 2
    inner = math.acos(math.sqrt((chi2 + 2) / 4))
    expected = sorted(
        t % (2 * math.pi)
        for t in (0, math.pi / 2, math.pi, -math.pi / 2, inner, -inner, math.pi + inner, math.pi - inner)
    )
    found = equator_equilibria(NONUNIQUE, z)
    # near z = 0.84 the outer ones are about to meet at 0 and pi: a coefficient's rounding moves them by more
    np.testing.assert_allclose(found.theta, expected, rtol=0.0, atol=4e-15 / inner)
    assert (found.lambda_rho < 0).all()
    np.testing.assert_array_equal(np.sign(found.lambda_theta), [1, -1] * 4)


def test_the_pitchfork_between_them_is_named():
    found = equator_equilibria(System(U=("-c*(c**2 - 1/2)", "-s/2")))  # chi^2 = 2 exactly
    np.testing.assert_array_equal(found.multiplicity, [3, 1, 3, 1])
    np.testing.assert_array_equal(found.lambda_theta[[0, 2]], 0.0)
    assert found.symmetric
    assert found.kind(0) == "radially attracting, angularly non-hyperbolic: triple zero (pitchfork), weakly attracting"
    assert found.distance == 0.0


@given(systems)
@settings(max_examples=20)
def test_elinear_systems_written_as_text(system):
    at = system.at()
    a, b, d, f1, f2 = at.plane
    closed = equator_equilibria(at)
    typed = System(U=(f"({a!r})*c - ({b!r})*s + ({f1!r})", f"({b!r})*c + ({d!r})*s + ({f2!r})"))
    found = equator_equilibria(typed)
    assert found.all_directions == closed.all_directions
    if closed.distance < 1e-9:
        return
    assert len(found) == len(closed)
    assert found.proven
    size = max(map(abs, at.plane))
    np.testing.assert_allclose(found.theta, closed.theta, rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(found.lambda_rho, closed.lambda_rho, rtol=0.0, atol=1e-12 * size)
    np.testing.assert_allclose(found.lambda_theta, closed.lambda_theta, rtol=0.0, atol=1e-12 * size)
    orbit, exact = equator_cycle(typed), equator_cycle(at)
    assert (orbit is None) == (exact is None)
    if exact is not None:
        assert orbit.direction == exact.direction
        assert orbit.period == pytest.approx(exact.period, rel=1e-12)
        assert orbit.exponent == pytest.approx(exact.exponent, rel=1e-11, abs=1e-12)
        assert orbit.neutral == exact.neutral


@given(st.one_of(polynomials, smooth))
@settings(max_examples=20)
def test_no_direction_is_missing_and_every_one_is_one(system):
    at = system.at()
    found = equator_equilibria(at)
    assume(not found.all_directions)
    assert found.proven
    n = 20_000
    theta, e = circle(n)
    U = at.U(e)
    Theta = e[:, 0] * U[:, 1] - e[:, 1] * U[:, 0]
    size = np.abs(U).sum(axis=1).max()
    changes = theta[np.flatnonzero((Theta > 0) != (np.roll(Theta, -1) > 0))]
    if found.distance > 1e-6:
        assert len(changes) == (found.multiplicity % 2 == 1).sum()
    for t in changes:
        away = np.abs(np.remainder(found.theta - t + math.pi, 2 * math.pi) - math.pi)
        assert away.min() < 2 * 2 * math.pi / n
    c, s = np.cos(found.theta), np.sin(found.theta)
    at_zero = at.U(np.stack([c, s], axis=-1))
    np.testing.assert_allclose(c * at_zero[:, 1] - s * at_zero[:, 0], 0.0, atol=4e-15 * size)
    np.testing.assert_allclose(found.lambda_rho, c * at_zero[:, 0] + s * at_zero[:, 1], rtol=0.0, atol=1e-12 * size)
    simple = found.multiplicity == 1
    if simple.all() and len(found):
        assert (np.sign(found.lambda_theta) == -np.sign(np.roll(found.lambda_theta, 1))).all()


@pytest.mark.parametrize(
    ("function", "multiplicity"),
    [
        (lambda t: 1 - np.cos(t - 1), [2]), (lambda t: (1 - np.cos(t - 1)) ** 2, [4]),
        (lambda t: np.sin(t - 1) ** 3, [3, 3]), (lambda t: (1 - np.cos(t - 1)) * np.sin(t - 1.001), [2, 1, 1]),
        (lambda t: (1 - np.cos(t - 1)) ** 2 * np.sin(t - 1), [5, 1]), (lambda t: 1 - np.cos(t - 1) + 1e-11, []),
        (lambda t: 1 - np.cos(t - 1) - 1e-11, [1, 1]), (lambda t: (1 - np.cos(t - 1)) * (1 - np.cos(t - 2)), [2, 2]),
    ],
)  # fmt: skip
def test_multiple_zeros(function, multiplicity):
    values = function(circle(64)[0])
    found = zeros(series(values, float(np.abs(values).max())))
    assert found.multiplicity.tolist() == multiplicity
    assert found.proven
    assert (found.distance == 0.0) == any(m > 1 for m in multiplicity)
    if len(multiplicity) == 1:
        np.testing.assert_allclose(found.theta, 1.0, rtol=0.0, atol=1e-8)


def test_high_degrees_are_resolved_or_said_not_to_be():
    assert len(equator_equilibria(System(U=("-c - s*cos(30*c)", "-s + c*cos(30*c)")))) == 40  # 30 c = pi/2 + k pi
    assert equator_equilibria(System(U=("-c - s*c**40", "-s + c*(c**40 - 1/2)"))).proven
    assert not equator_equilibria(System(U=("-(c**1000)**100 + s", "-s*c**77 - 2*c"))).proven


def test_rounding_of_a_zero_below_zero_is_zero():
    assert equator_equilibria(System(U=("-c", "-2*s"))).theta[0] == 0.0


_NEAR = System(
    U=("a*c - b*s + f1 + k*c**2*s", "b*c + d*s + f2"), parameters={"a": 0, "b": 0, "d": 0, "f1": 0, "f2": 0, "k": 0}
)
_thousandths = st.integers(-1000, 1000).map(lambda n: n / 1000)


@given(_thousandths, _thousandths, _thousandths, _thousandths, _thousandths)
@settings(max_examples=20)
def test_across_saddle_nodes_counts_are_those_of_the_closed_form(a, d, f1, f2, from_b):
    """Theta loses its last zeros as b grows: up to the loss, and past it, none is missed or made up."""
    closed = lambda b: equator_equilibria(ELinear(a, b, d, (f1, f2)))
    low, high = from_b, 4.0
    assume(max(map(abs, (a, d, f1, f2, from_b))) > 0.0)
    assume(len(closed(low)) > len(closed(high)) == 0)
    while high - low > 1e-13:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if len(closed(middle)) else (low, middle)
    for step in 10.0 ** np.arange(-10.0, -1.0, 0.7):
        for b in (low - step, low + step):
            exact = closed(b)
            if exact.distance < 1e-11:
                continue  # both may name the multiple zero, within their own roundings
            for k in (0.0, 1e-4 * exact.distance * max(map(abs, (a, b, d, f1, f2)))):  # too little for a multiple zero
                found = equator_equilibria(_NEAR.evolve(a=a, b=b, d=d, f1=f1, f2=f2, k=k))
                assert len(found) == len(exact)
                assert found.proven


@pytest.mark.parametrize(("U", "arc", "others"), [
    (("-c", "-s + (abs(c) - c)"), (1.5 * np.pi, 0.5 * np.pi), 0),
    (("-c", "-s + abs(c) - c"), (1.5 * np.pi, 0.5 * np.pi), 0),
    (("abs(s) - s - 2*c", "-2*s"), (0.0, np.pi), 0),
    (("-c - s*(abs(c) - c)*(1 - 2*c)", "-s + c*(abs(c) - c)*(1 - 2*c)"), (1.5 * np.pi, 0.5 * np.pi), 0),
    (("-c - s*(abs(c) - c)*(s - 1/2)", "-s + c*(abs(c) - c)*(s - 1/2)"), (1.5 * np.pi, 0.5 * np.pi), 1),
])  # fmt: skip
def test_an_arc_of_limit_directions_is_named(U, arc, others):
    system = System(U=U)
    found = c2.equator_equilibria(system)
    np.testing.assert_allclose(found.arcs, [arc], atol=1e-5)
    assert len(found) == others
    said = c2.classify(system, c2.psi.constant())
    assert "arc of directions" in [d.name for d in said.degeneracies]
    assert c2.equator_cycle(system) is None
    c2.approach_outcomes(system, c2.psi.constant())
    c2.Scene(system)["classification"]


@pytest.mark.parametrize("power", [1, 3, 5])
def test_the_degree_where_all_zeros_are_multiple(power):
    """U = c e + s^power times e turned: once round e itself, and once more round by c + i s^power."""
    found = equator_zeros(System(U=(f"c*c - s*s**{power}", f"c*s + c*s**{power}")).at().key)
    assert found.degree == 2
    other = equator_zeros(System(U=(f"c*c + s*s**{power}", f"c*s - c*s**{power}")).at().key)
    assert other.degree == 0
