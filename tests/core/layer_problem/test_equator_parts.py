"""Parts of the equator of a general system, each alone, on fields whose Theta is chosen: U = -e + t e turned."""

import math

import numpy as np
import pytest

from codim2_core import equator_cycle, equator_equilibria
from codim2_core.layer_problem import equator_zeros as module
from codim2_core.layer_problem.equator_zeros import component_series, component_zeros, equator_zeros
from codim2_core.numerics.fourier_zeros import series
from codim2_core.systems.typed import System
from tests.core.general_systems import circle

THIRD = math.pi / 3
TURN = 2.0 * math.pi


def with_theta(t, radial="-1"):
    """Return a field with Theta = t and lambda_rho = radial on the equator."""
    return System(U=(f"({radial})*c - s*({t})", f"({radial})*s + c*({t})"))


def trigonometric(function, n=64):
    return series(function(circle(n)[0]), 1.0)


@pytest.mark.parametrize("degree", [0, 1, 2, 5, 6, 7, 8, 13, 14, 20])
def test_polynomials_of_any_degree_are_resolved_exactly(degree):
    """The real part of (c + i s)^k is cos k theta: a polynomial that needs all of the series."""
    rows = ["1/3", "1/7"]
    if degree:
        terms = [(math.comb(degree, j) * (-1) ** (j // 2), j) for j in range(0, degree + 1, 2)]
        rows[0] += "".join(f" + ({n})" + "*c" * (degree - j) + "*s" * j for n, j in terms)
    key = System(U=tuple(rows)).at().key
    theta = np.linspace(0.1, 6.0, 37)
    u = 1.0 / 3.0 + (np.cos(degree * theta) if degree else 0.0)
    v, c, s = np.full(37, 1.0 / 7.0), np.cos(theta), np.sin(theta)
    for kind, values in {"U1": u, "U2": v, "rho": c * u + s * v, "theta": c * v - s * u}.items():
        f = component_series(key, kind)
        np.testing.assert_allclose(f.derivatives(theta, range(1))[0], values, rtol=0.0, atol=1e-12)
        assert f.exact
        assert f.resolved
        assert f.degree <= degree + 1  # of the rounding of large terms nothing is left beyond


@pytest.mark.parametrize("width", [0.3, 0.05, 0.03])
def test_a_narrow_peak_is_resolved_or_said_not_to_be(width):
    """exp(k(c - 1)) is so wide: cos theta lies between the angles of a coarse net, beside a zero of sin too."""
    key = System(U=(f"-1 - exp((c - 1)/{width**2})", "1/2")).at().key
    theta = np.linspace(-0.5, 0.5, 101)
    f = component_series(key, "theta")
    exact = 0.5 * np.cos(theta) + np.sin(theta) * (1.0 + np.exp((np.cos(theta) - 1.0) / width**2))
    np.testing.assert_allclose(f.derivatives(theta, range(1))[0], exact, rtol=0.0, atol=1e-11)
    assert (f.exact, f.resolved) == (False, True)
    assert not component_series(System(U=("-1 - exp((c - 1)*1e8)", "abs(s)")).at().key, "U1").resolved


def test_crossings_of_simple_double_and_triple_zeros():
    f = trigonometric(lambda t: np.sin(t) ** 3 * (1.0 - np.cos(t - 1.0)))
    theta, multiplicity = np.array([0.0, 1.0, math.pi]), np.array([3, 2, 3])
    assert module._crossings(f, theta, multiplicity).tolist() == [1.0, 0.0, -1.0]
    only = trigonometric(lambda t: 1.0 - np.cos(t - 1.0))
    assert module._crossings(only, np.array([1.0]), np.array([2])).tolist() == [0.0]


def test_reflections_and_changes_of_sign():
    f = trigonometric(lambda t: np.sin(t - 1.0) ** 3 + 0.3 * np.sin(5.0 * (t - 1.0)))
    assert module._odd_about(f, 1.0)
    assert module._odd_about(f, 1.0 + math.pi)
    assert not module._odd_about(f, 1.1)
    assert not module._odd_about(trigonometric(lambda t: np.sin(t) + 1e-3 * np.cos(t)), 0.0)
    for level, changes in ((0.9, True), (1.1, False), (-0.9, True), (-1.1, False)):
        assert module._changes_sign(trigonometric(lambda t, level=level: np.cos(3.0 * t) + level)) == changes


@pytest.mark.parametrize(
    ("radial", "degree"), [("2 + c", 1), ("-2 - s", 1), ("c + 1/3", None), ("0*c", None), ("c - 1", None)]
)
def test_the_degree_where_every_direction_is_one(radial, degree):
    """U = lambda_rho e turns once with e, unless lambda_rho vanishes somewhere."""
    found = equator_zeros(with_theta("0", radial).at().key)
    assert found.all_directions
    assert found.degree == degree


@pytest.mark.parametrize(
    ("t", "theta", "slopes", "multiplicity"),
    [
        ("abs(c - 1/2)", [THIRD, 5 * THIRD], None, [2, 2]),  # touches, with a corner
        ("-abs(c - 1/2)", [THIRD, 5 * THIRD], None, [2, 2]),
        ("2*s + abs(s)", [0.0, math.pi], None, [1, 1]),  # through a corner
        ("s*(1/5 + abs(s))", [0.0, math.pi], [0.2, -0.2], [1, 1]),
        ("s*abs(s)", [0.0, math.pi], [0.0, 0.0], [3, 3]),  # through, with no slope
        ("s*(1e-7 + abs(s))", [0.0, math.pi], [1e-7, -1e-7], [1, 1]),  # with very little
        ("(c - 1/2)*(2 + abs(s - 1/3))", [THIRD, 5 * THIRD], None, [1, 1]),  # corners elsewhere
        ("(c - 1/2)**2*(2 + abs(s - 1/3))", [THIRD, 5 * THIRD], None, [2, 2]),
        ("abs(s) + 1/10", [], None, []),
        ("abs(s)", [0.0, math.pi], None, [2, 2]),
        ("abs(c - 1/2)*s", [0.0, THIRD, math.pi, 5 * THIRD], None, [1, 2, 1, 2]),
    ],
)
def test_zeros_of_a_theta_with_corners(t, theta, slopes, multiplicity):
    found = equator_zeros(with_theta(t).at().key)
    away = np.abs(np.remainder(found.theta - theta + 1.0, TURN) - 1.0)
    assert (away < 1e-9).all()
    assert found.multiplicity.tolist() == multiplicity
    np.testing.assert_allclose(found.lambda_rho, -1.0, atol=1e-6)
    if slopes is not None:
        np.testing.assert_allclose(found.lambda_theta, slopes, rtol=1e-6)
    assert not found.proven
    assert len(found.arcs) == 0


def test_corners_are_where_the_arguments_of_abs_vanish():
    system = System(U=("abs(c - p) + max(s, 1/2)", "s"), parameters={"p": 0.5})
    found = module._kinks(system.at().key)
    np.testing.assert_allclose(found, [math.pi / 6, THIRD, 5 * math.pi / 6, 5 * THIRD], rtol=0.0, atol=1e-12)
    found = module._kinks(system.evolve(p=-0.5).at().key)
    np.testing.assert_allclose(found, [math.pi / 6, 2 * THIRD, 5 * math.pi / 6, 4 * THIRD], rtol=0.0, atol=1e-12)
    assert len(module._kinks(System(U=("c**3", "exp(s)")).at().key)) == 0


def test_components_vanish_where_they_say():
    key = System(U=("(c - 1/2)*(2 + s)", "abs(s) + s/2 - 1/4")).at().key
    theta, multiplicity = component_zeros(key, "U1")
    np.testing.assert_allclose(theta, [THIRD, 5 * THIRD], rtol=0.0, atol=1e-12)
    assert multiplicity.tolist() == [1, 1]
    theta, multiplicity = component_zeros(key, "U2")  # s = 1/6 above, s = -1/2 below
    low = math.asin(1.0 / 6.0)
    np.testing.assert_allclose(theta, [low, math.pi - low, 7 * math.pi / 6, 11 * math.pi / 6], rtol=0.0, atol=1e-12)
    assert multiplicity.tolist() == [1] * 4
    on = equator_zeros(key)
    theta, multiplicity = component_zeros(key, "theta")
    np.testing.assert_array_equal(theta, on.theta)
    np.testing.assert_array_equal(multiplicity, on.multiplicity)


def test_angles_on_arcs():
    arcs = np.array([(0.9, 1.5), (6.0, 6.0 + 1.0)])
    inside = [0.9, 1.0, 1.5, 6.1, 0.2, 7.0 - TURN, 0.9 - 5e-7, 1.5 + 5e-7]
    outside = [0.9 - 1e-5, 1.5 + 1e-5, 3.0, 5.9, 7.0 - TURN + 1e-5]
    assert module._on(np.array(inside), arcs).all()
    assert not module._on(np.array(outside), arcs).any()
    assert not module._on(np.array(inside), arcs[:0]).any()


@pytest.mark.parametrize("size", [1e-12, 1.0, 1e9])
def test_a_limit_direction_is_radially_degenerate_within_rounding_in_any_unit(size):
    """lambda_rho = k (c - 1 + delta): zero at theta = 0 for delta = 0 only, whatever the unit of time is."""
    for delta, flat in ((0.0, True), (1e-12, False), (-1e-12, False)):
        field = with_theta(f"{size!r}*s", f"{size!r}*(c*c - 1 + {delta!r})")
        found = equator_equilibria(field)
        assert found.radially_degenerate.tolist() == [flat, flat]
        assert np.sign(found.lambda_rho).tolist() == [np.sign(delta)] * 2
        assert (equator_zeros(field.at().key).degree is None) == flat


@pytest.mark.parametrize("sign", [1, -1])
def test_a_closed_equator_by_its_mean(sign):
    """Theta = 2 + cos 3 theta: the period is 2 pi/sqrt 3; lambda_rho = Theta (1/5 + cos) has the exponent 2 pi/5."""
    cubic = "(4*c**3 - 3*c + 2)"
    field = with_theta(f"({sign})*{cubic}", f"{cubic}*(1/5 + c)")
    found = equator_cycle(field)
    assert (found.direction, found.neutral, found.stable_outside) == (sign, False, False)
    assert found.period == pytest.approx(TURN / math.sqrt(3.0), rel=1e-13)
    assert found.exponent == pytest.approx(TURN / 5.0, rel=1e-13)
    assert equator_cycle(with_theta(cubic, f"{cubic}*(1e-13 + c)")).exponent == pytest.approx(TURN * 1e-13, rel=0.05)
    assert equator_cycle(with_theta(cubic, f"{cubic}*c")).neutral
    narrow = equator_cycle(with_theta("1.0001 + c", "-1/2"))  # close to a saddle-node
    assert narrow.period == pytest.approx(TURN / math.sqrt(1.0001**2 - 1.0), rel=1e-10)
    assert narrow.exponent == pytest.approx(-0.5 * narrow.period, rel=1e-10)


@pytest.mark.parametrize("slope", [1.0, 1e-3, 1e-5])
@pytest.mark.parametrize("shift", [0.0, 1e-5, -1e-5])
def test_where_both_vanish_a_flat_theta_blurs_lambda_rho(slope, shift):
    """Theta = k (s - 3/5) and lambda_rho = s - 3/5 + shift, multiplied out, so that each term is rounded alone."""
    k, f = repr(slope), repr(-0.6 + shift)
    field = System(U=(f"s*c + ({f})*c - {k}*s*s + 3/5*{k}*s", f"s*s + ({f})*s + {k}*s*c - 3/5*{k}*c"))
    found = equator_equilibria(field)
    low = math.asin(0.6)
    np.testing.assert_allclose(found.theta, [low, math.pi - low], rtol=0.0, atol=1e-9)
    assert found.radially_degenerate.tolist() == [shift == 0.0] * 2
    np.testing.assert_allclose(found.lambda_rho, shift, rtol=0.0, atol=1e-9)


@pytest.mark.parametrize("at", [0.5, 2.5, 4.0, 5.5])
def test_a_change_of_sign_is_found_wherever_it_is(at):
    assert module._changes_sign(trigonometric(lambda t: 0.98 - np.cos(t - at)))
    assert module._changes_sign(trigonometric(lambda t: np.cos(t - at) - 0.98))
    assert not module._changes_sign(trigonometric(lambda t: 1.02 - np.cos(t - at)))
    assert not module._changes_sign(trigonometric(lambda t: np.cos(t - at) - 1.02))
