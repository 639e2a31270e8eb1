"""theta, lambda_rho and lambda_theta in 50 digits, against what rounding the coefficients does to them."""

import math
import random

import numpy as np
import pytest

from codim2_core import ELinear, equator_equilibria

from .reference import direction, measure
from .samples import anywhere, with_critical_set

NAMES = ("theta", "lambda_rho", "lambda_theta")
BOUND = 12.0  # units of one rounding; angles near 2 pi are rounded to 4 units of 1

WORST = [
    (-0.9991207259482846, -0.24240476336203054, 0.15223963419525832, 3.853054480681543e-06, 1.627676801701933e-06),
    (-0.10009204796312021, 0.04980456424258861, -0.5774801017204783, 0.10392176173538273, 0.3964930275502689),
]


def errors(plane):
    """Errors of the three numbers at each simple zero, in units."""
    found = equator_equilibria(ELinear(*plane[:3], plane[3:]))
    for i in range(len(found)):
        if found.multiplicity[i] > 1:
            continue
        reported = [found.theta[i], found.lambda_rho[i], found.lambda_theta[i]]
        # lambda_rho keeps relative accuracy near 0 only; where it is larger, theta's own rounding comes in.
        size = max(map(abs, plane))
        floors = (0.0, size if abs(found.lambda_rho[i]) > 1e-3 * size else 0.0, 0.0)
        values = dict(zip(NAMES, measure(reported, direction(found.theta[i]), plane, floors), strict=True))
        if found.radially_degenerate[i]:
            del values["lambda_rho"]  # 0 within rounding, and said to be 0
        if found.theta[i] == 0.0 and values["theta"] > BOUND:
            del values["theta"]  # just below 0: 2 pi less a little is reported as 0
        yield values


@pytest.mark.parametrize("plane", WORST)
def test_worst_cases(plane):
    assert all(max(values.values()) < BOUND for values in errors(plane))


def test_every_number_of_a_limit_direction():
    planes = [*anywhere(200, 7), *(plane for plane, _ in with_critical_set(100, 8))]
    count = 0
    for plane in planes:
        for values in errors(plane):
            count += 1
            name = max(values, key=values.__getitem__)
            assert values[name] < BOUND, (name, values[name], plane)
    assert count > 500


def test_the_radial_eigenvalue_keeps_its_digits_near_zero():
    """lambda_rho of 1e-14 of its terms: from integers, not from the rounded theta; at every scale."""
    rng = random.Random(9)
    for scale in (1.0, 2.0**-300, 2.0**300):
        for _ in range(40):
            a, b, d, t = (*(rng.uniform(-2, 2) for _ in range(3)), rng.uniform(0, 6.28))
            off = 10.0 ** rng.uniform(-13, -3)
            c, s = (1 - off) * math.cos(t), (1 - off) * math.sin(t)
            plane = tuple(scale * v for v in (a, b, d, -(a * c - b * s), -(b * c + d * s)))
            for values in errors(plane):
                assert values.get("lambda_rho", 0.0) < BOUND, plane


@pytest.mark.parametrize("scale", [1.0, 2.0**-400, 2.0**400])
def test_a_line_of_critical_points_ends_where_directions_are_radially_degenerate(scale):
    """det A = 0 = U on a chord: both its ends are limit directions with lambda_rho = 0, and no others."""
    chord = math.acos(-0.5 / math.sqrt(2))
    for a, b, d, f1, f2, ends in (
        (1.0, 1.0, -1.0, 0.5, 0.5, (chord - math.pi / 4, -chord - math.pi / 4)),
        (0.0, 0.0, 2.0, 0.0, 1.0, (-math.pi / 6, math.pi + math.pi / 6)),
        (3.0, 0.0, 0.0, 1.5, 0.0, (2 * math.pi / 3, -2 * math.pi / 3)),
    ):  # fmt: skip
        found = equator_equilibria(ELinear(a * scale, b * scale, d * scale, (f1 * scale, f2 * scale)))
        flat = np.sort(found.theta[found.radially_degenerate])
        np.testing.assert_allclose(flat, np.sort(np.remainder(ends, 2 * math.pi)), rtol=0.0, atol=1e-15)
        assert (found.lambda_rho[found.radially_degenerate] == 0.0).all()
        assert (np.abs(found.lambda_rho[~found.radially_degenerate]) > 0.1 * scale).all()
    # off the range of A by little: no longer degenerate
    found = equator_equilibria(ELinear(scale, scale, -scale, (0.5 * scale, 0.5 * scale * (1 + 1e-13))))
    assert not found.radially_degenerate.any()
    assert np.abs(found.lambda_rho).min() < 1e-12 * scale
