"""Parts of the equator of a general system, each alone, on fields whose Theta is chosen: U = -e + t e turned."""

import math

import numpy as np
import pytest

from codim2_core import equator_cycle, equator_equilibria
from codim2_core.portrait.layer_problem.equator_zeros import equator_zeros
from codim2_core.systems.typed import System

THIRD = math.pi / 3
TURN = 2.0 * math.pi


def with_theta(t, radial="-1"):
    """Return a field with Theta = t and lambda_rho = radial on the equator."""
    return System(U=(f"({radial})*c - s*({t})", f"({radial})*s + c*({t})"))


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
