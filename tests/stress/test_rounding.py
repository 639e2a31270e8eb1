"""Names at borders reach exactly as far as the rounding of the input: one rounding of every coefficient, not four."""

import itertools
import math

import numpy as np
import pytest

from codim2_core import ELinear, classify, psi
from codim2_core.portrait.layer_problem.linearisation import Existence, locate
from codim2_core.portrait.portrait_name import NEARER
from codim2_core.results.words import power

SIGNS = [*itertools.product((-1.0, 1.0), repeat=5), (1.0, 0.0, -1.0, 0.0, 1.0), (0.0,) * 5]
UNIT = 2.0**-53

# On |A^-1 f| = 1 exactly, with all five coefficients at work.
BORDERS = [
    (-5.0, 0.0, -5.0, 3.0, 4.0), (5.0, 10.0, -10.0, 5.0, 2.0), (5.0, 0.0, -10.0, -3.0, 8.0),
    (10.0, 5.0, 15.0, -2.0, -15.0), (13.0, 26.0, 39.0, 19.0, -46.0), (0.0, 5.0, 0.0, 3.0, 4.0),
]  # fmt: skip
SINGULAR = [
    ((1.0, 1.0, -1.0, 0.5, 0.5), Existence.SINGULAR_LINE),
    ((4.0, 2.0, -1.0, 1.0, 0.5), Existence.SINGULAR_LINE),
    ((-9.0, 3.0, 1.0, 1.5, -0.5), Existence.SINGULAR_LINE),
    ((1.0, 1.0, -1.0, 0.5, 0.25), Existence.SINGULAR_NONE),
    ((1.0, 1.0, -1.0, 5.0, 5.0), Existence.SINGULAR_OUTSIDE),
]


def rounded(plane, signs, units):
    """Each coefficient moved by so many half-units in the last place, up, down or not."""
    return tuple(v * (1.0 + units * s * 2.0 * UNIT) if v else 0.0 for v, s in zip(plane, signs, strict=True))


def gap(plane):
    """How far |A^-1 f| = 1 is, to first order in units of one rounding of every coefficient."""
    from fractions import Fraction

    def value(q):
        a, b, d, f1, f2 = q
        return (a * d + b * b) ** 2 - (d * f1 + b * f2) ** 2 - (a * f2 - b * f1) ** 2

    q = [Fraction(v) for v in plane]
    h = Fraction(1, 2**40)
    change = sum(abs(value([*q[:i], v * (1 + h), *q[i + 1 :]]) - value(q)) for i, v in enumerate(q)) / h
    return float(abs(value(q)) / change / Fraction(UNIT))


@pytest.mark.parametrize("scale", [1.0, 2.0**-490, 2.0**480])
@pytest.mark.parametrize("plane", BORDERS)
def test_transcritical_within_rounding_and_not_beyond(plane, scale):
    beyond = 0
    for signs in SIGNS:
        for units in (0.5, 1.0, 2.0, 4.0, 64.0):
            moved = rounded(plane, signs, units)
            distance = gap(moved)
            named = locate(ELinear(*(v * scale for v in moved[:3]), [v * scale for v in moved[3:]]).at()).existence
            if distance <= 1.39:  # ROUNDING is 1.4 half-units
                assert named is Existence.EQUATOR, (moved, distance)
            elif distance >= 1.41:
                assert named in (Existence.INSIDE, Existence.NONE), (moved, distance)
                beyond += 1
    assert beyond > 32


@pytest.mark.parametrize(("plane", "existence"), SINGULAR)
def test_singular_within_rounding_and_not_beyond(plane, existence):
    for signs in SIGNS:
        moved = rounded(plane, signs, 0.5)
        assert locate(ELinear(*moved[:3], moved[3:]).at()).existence is existence, moved
    for k in range(3):
        for side in (1.0, -1.0):
            moved = list(plane)
            moved[k] *= 1.0 + side * 64 * UNIT
            assert not locate(ELinear(*moved[:3], moved[3:]).at()).singular
    if existence is Existence.SINGULAR_LINE:
        for k in (3, 4):
            moved = list(plane)
            moved[k] *= 1.0 + 16 * UNIT
            assert locate(ELinear(*moved[:3], moved[3:]).at()).existence is Existence.SINGULAR_NONE


@pytest.mark.parametrize(("plane", "existence"), SINGULAR)
def test_the_line_of_critical_points_is_where_u_vanishes(plane, existence):
    at = ELinear(*plane[:3], plane[3:]).at()
    line = locate(at).line
    assert (line is not None) == (existence is Existence.SINGULAR_LINE)
    if line is not None:
        for w in (0.0, 0.3, 1.0):
            e = (1 - w) * np.array(line[0]) + w * np.array(line[1])
            np.testing.assert_allclose(at.U(e), 0.0, atol=4e-15)
        assert math.dist(*line) > 0.1


def test_products_that_underflow_are_decided_too():
    """Coefficients of very different sizes: squares of the small ones are below the smallest double."""
    tiny = 1e-120
    for a, d in ((tiny, tiny), (-tiny, -2 * tiny)):
        found = locate(ELinear(a, 0.0, d, (0.5 * a, 0.0)).at())
        assert found.existence is Existence.INSIDE
        assert found.e == pytest.approx((-0.5, 0.0), abs=1e-15)
    found = locate(ELinear(1.0, tiny, 0.0, (0.25, 0.25 * tiny)).at())
    assert found.existence is Existence.INSIDE
    assert found.e == pytest.approx((-0.25, 0.0), abs=1e-15)
    assert locate(ELinear(1.0, tiny, 0.0, (1.25, 1.25 * tiny)).at()).existence is Existence.NONE
    assert locate(ELinear(1.0, tiny, 0.0, (1.0, tiny)).at()).existence is Existence.EQUATOR


def test_a_small_component_keeps_its_digits():
    """e = (1/2, 1e-13): its small part is the difference of products a billion times larger."""
    a, b, d = 3.0, 7.0, -2.0
    for small in (1e-13, -1e-11, 1e-7):
        c, s = 0.5, small
        plane = (a, b, d, -(a * c - b * s), -(b * c + d * s))
        from fractions import Fraction

        q = [Fraction(v) for v in plane]
        det = q[0] * q[2] + q[1] ** 2
        exact = float(-(q[0] * q[4] - q[1] * q[3]) / det)
        assert locate(ELinear(a, b, d, plane[3:]).at()).e[1] == pytest.approx(exact, rel=1e-12)


def test_neutral_trace_and_equator_reach_as_far_as_they_say():
    """a = -d and |f1| = |f2|: tr J = 0 by symmetry; a few roundings are within, 1e-14 is not."""
    for change, named in ((0.0, True), (2.0**-52, True), (1e-14, False), (-1e-14, False)):
        found = classify(ELinear(1.0 + change, 2.0, -1.0, (0.5, -0.5)), psi.rational())
        names = {d.name: d for d in found.degeneracies}
        assert ("tr J = 0" in names) == named
        assert ("neutral equator" in names) == named
        for d in names.values():
            assert f"{NEARER} {power(d.within)} of " in d.sentence
