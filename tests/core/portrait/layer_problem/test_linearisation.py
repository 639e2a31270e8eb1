"""Determinants, traces and eigenvalues without cancellation, held against exact fractions and LAPACK."""

import math
from fractions import Fraction

import numpy as np
import pytest

from codim2_core.numerics.trigonometric import INPUT_ROUNDING
from codim2_core.portrait.layer_problem.linearisation import (
    Frame,
    determinant_sign,
    matrix_determinant,
    spectrum,
)

RANDOM = np.random.default_rng(11)


def nearly_singular(count, scale):
    """Matrices whose rows are parallel but for a small part."""
    for _ in range(count):
        row, factor = RANDOM.normal(size=2), float(RANDOM.normal())
        other = factor * row + 10.0 ** RANDOM.uniform(-17, -1) * RANDOM.normal(size=2)
        yield tuple((scale * np.concatenate([row, other])).tolist())


@pytest.mark.parametrize("scale", [1e-150, 1e-9, 1.0, 1e6, 1e149])
def test_determinants_have_all_digits(scale):
    signs = set()
    for m11, m12, m21, m22 in nearly_singular(200, scale):
        exact = Fraction(m11) * Fraction(m22) - Fraction(m12) * Fraction(m21)
        size = abs(Fraction(m11) * Fraction(m22)) + abs(Fraction(m12) * Fraction(m21))
        found, sign = matrix_determinant(m11, m12, m21, m22)
        assert abs(Fraction(found) - exact) <= abs(exact) * Fraction(1e-12) + Fraction(5e-324)
        blurred = abs(exact) <= 2 * Fraction(INPUT_ROUNDING) * size
        assert sign == (0 if blurred else math.copysign(1, exact))
        signs.add(sign)
        # det of (a, -b; b, d): with the off-diagonal terms as -b * b
        a, b = m11, m12
        d = -b * b / a * (1.0 + 10.0 ** RANDOM.uniform(-17, -1)) if abs(b) < 3.0 * abs(a) else m22
        exact = Fraction(a) * Fraction(d) + Fraction(b) ** 2
        weight = abs(Fraction(a) * Fraction(d)) + Fraction(b) ** 2
        found = Fraction(matrix_determinant(a, -b, b, d)[0])
        assert abs(found - exact) <= abs(exact) * Fraction(1e-12) + Fraction(5e-324)
        blurred = abs(exact) <= 2 * Fraction(INPUT_ROUNDING) * weight
        assert determinant_sign(a, b, d) == (0 if blurred else math.copysign(1, exact))
    assert signs == {-1, 0, 1}


def test_a_trace_within_rounding_of_its_terms_is_a_centre():
    for along, kind in ((1.0, "centre (linear)"), (1.0 + 1e-15, "centre (linear)"), (1.0 + 1e-14, "unstable focus")):
        frame = Frame(along, -1.0, -9.0, 8.0, 1, 2.0)
        assert spectrum(frame)[3] == kind
    assert spectrum(Frame(1.0 - 1e-14, -1.0, -9.0, 8.0, 1, 2.0))[3] == "stable focus"
    assert spectrum(Frame(1.0, -1.0, 9.0, -10.0, -1, 2.0))[3] == "saddle"
    assert spectrum(Frame(-2.0, -2.0, 0.0, 4.0, 1, 4.0))[2:4] == (0.0, "stable node")  # a double eigenvalue
    # eigenvalues far apart keep their digits: -1 and -1e-18
    pair = spectrum(Frame(-1.0, -1e-18, 0.0, 1e-18, 1, 1.0))[4]
    assert [v.real for v in pair] == pytest.approx([-1e-18, -1.0])
    assert [v.real for v in spectrum(Frame(0.0, 0.0, 0.0, 0.0, 0, 1.0))[4]] == [0.0, 0.0]
