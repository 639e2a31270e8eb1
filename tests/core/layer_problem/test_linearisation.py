"""Determinants, traces and eigenvalues without cancellation, held against exact fractions and LAPACK."""

import math
from fractions import Fraction

import numpy as np
import pytest

from codim2_core import psi
from codim2_core.layer_problem.linearisation import (
    Frame,
    determinant_sign,
    exact_determinant,
    linearisation,
    linearisation_of,
    matrix_determinant,
    scaled,
    spectrum,
)
from codim2_core.numerics.trigonometric import ROUNDING

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
        blurred = abs(exact) <= 2 * Fraction(ROUNDING) * size
        assert sign == (0 if blurred else math.copysign(1, exact))
        signs.add(sign)
        # det of (a, -b; b, d): with the off-diagonal terms as -b * b
        a, b = m11, m12
        d = -b * b / a * (1.0 + 10.0 ** RANDOM.uniform(-17, -1)) if abs(b) < 3.0 * abs(a) else m22
        exact = Fraction(a) * Fraction(d) + Fraction(b) ** 2
        weight = abs(Fraction(a) * Fraction(d)) + Fraction(b) ** 2
        assert abs(Fraction(exact_determinant(a, b, d)) - exact) <= abs(exact) * Fraction(1e-12) + Fraction(5e-324)
        blurred = abs(exact) <= 2 * Fraction(ROUNDING) * weight
        assert determinant_sign(a, b, d) == (0 if blurred else math.copysign(1, exact))
    assert signs == {-1, 0, 1}


def test_what_vanishes_has_no_sign():
    assert matrix_determinant(0.0, 0.0, 0.0, 0.0) == (0.0, 0)
    assert matrix_determinant(1.0, 2.0, 0.0, 0.0) == (0.0, 0)
    assert matrix_determinant(0.0, 2.0, -3.0, 0.0) == (6.0, 1)
    assert matrix_determinant(2.0, 0.0, 5.0, -1e-200) == (-2e-200, -1)
    assert matrix_determinant(0.8, -0.8, 0.625, 0.625) == (1.0, 1)  # of size 1
    assert matrix_determinant(0.875, 0.75, 0.75, 0.5) == (-0.125, -1)
    assert determinant_sign(0.875, 0.75, 0.5) == 1
    assert [determinant_sign(*abd) for abd in ((0, 0, 0), (1, 0, 0), (0, 1e-160, 0), (-1e-160, 0, 1e-160))] == [
        0, 0, 1, -1,
    ]  # fmt: skip


def test_scaled_brings_the_largest_near_one_and_rounds_nothing():
    assert scaled((0.0, 0.0)) == (0.0, 0.0)
    for values in ((3e-200, -1e-201), (5.0, 7e5, -1e6), (1.0,), (-0.75, 0.1)):
        found = scaled(values)
        assert 0.5 <= max(map(abs, found)) < 1.0
        assert {Fraction(one) / Fraction(other) for one, other in zip(found, values, strict=True)} == {
            Fraction(found[0]) / Fraction(values[0])
        }


PSIS = [psi.constant(), psi.rational(), psi.tanh(), psi.hill(3)]
PLACES = [(0.0, 0.0), (0.3, 0.0), (-0.2, 0.6), (0.5, -0.5)]


def direct(M, regularisation, e):
    """J = M . D e_Psi by central differences of e_Psi = x2 / sqrt(zeta^2 + Psi(zeta^2))."""
    modulus = math.hypot(*e)
    zeta = float(regularisation.radius(modulus)) if modulus else 0.0
    x2 = np.array(e) / (modulus or 1.0) * zeta

    def e_psi(x):
        return x / math.sqrt(float(x @ x) + float(regularisation(float(x @ x))))

    h = 1e-5
    D = np.stack([(e_psi(x2 + h * u) - e_psi(x2 - h * u)) / (2 * h) for u in np.eye(2)], axis=1)
    return x2, np.array(M).reshape(2, 2) @ D


@pytest.mark.parametrize("regularisation", PSIS, ids=str)
@pytest.mark.parametrize("e", PLACES)
def test_the_jacobian_of_a_matrix_and_its_frame(regularisation, e):
    for M in ((-1.0, 0.3, 0.7, -2.0), (1.5, -2.0, 1.0, 0.4), (0.0, 1.0, -3.0, 0.2)):
        complement = 1.0 - e[0] ** 2 - e[1] ** 2
        det, sign = matrix_determinant(*M)
        x2, p, J, frame = linearisation_of(M, regularisation, e, complement, sign)
        place, numeric = direct(M, regularisation, e)
        np.testing.assert_allclose(x2, place, rtol=0.0, atol=1e-12)
        np.testing.assert_allclose(p, place / math.hypot(1.0, *place), rtol=0.0, atol=1e-12)
        J = np.reshape(J, (2, 2))
        np.testing.assert_allclose(J, numeric, atol=1e-7)
        # the frame: J in the axes along e and across it
        angle = math.atan2(e[1], e[0])
        R = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
        turned = R @ J @ R.T
        assert (frame.along, frame.across) == pytest.approx(np.diag(turned), abs=1e-12)
        assert frame.turning == pytest.approx(turned[0, 1] * turned[1, 0], abs=1e-12)
        assert frame.determinant == pytest.approx(np.linalg.det(J), rel=1e-12)
        assert frame.sign == math.copysign(1, det)
        assert frame.size >= abs(frame.along) + abs(frame.across) - 1e-12
        trace, determinant, discriminant, kind, pair = spectrum(frame)
        values = np.linalg.eigvals(J)
        np.testing.assert_allclose(np.sort_complex(pair), np.sort_complex(values), rtol=0.0, atol=1e-9)
        assert pair[0].real >= pair[1].real
        assert (trace, determinant) == pytest.approx((np.trace(J), np.linalg.det(J)), abs=1e-12)
        assert discriminant == pytest.approx(np.trace(J) ** 2 - 4.0 * np.linalg.det(J), abs=1e-11)
        if det < 0.0:
            assert kind == "saddle"
        else:
            stable = "stable" if np.trace(J) < 0.0 else "unstable"
            assert kind == f"{stable} {'focus' if abs(values[0].imag) > 0.0 else 'node'}"


@pytest.mark.parametrize("regularisation", PSIS, ids=str)
@pytest.mark.parametrize("e", PLACES)
def test_the_normal_form_is_a_matrix_like_any_other(regularisation, e):
    for a, b, d in ((-1.0, 0.5, -2.0), (0.3, -1.4, 0.2), (1.0, 0.2, -3.0)):
        complement = 1.0 - e[0] ** 2 - e[1] ** 2
        one = linearisation((a, b, d), regularisation, e, complement)
        M = (a, -b, b, d)
        other = linearisation_of(M, regularisation, e, complement, matrix_determinant(*M)[1])
        for mine, its in zip(one[:3], other[:3], strict=True):
            np.testing.assert_allclose(mine, its, rtol=0.0, atol=1e-14)
        for name in ("along", "across", "turning", "determinant", "sign"):
            assert getattr(one[3], name) == pytest.approx(getattr(other[3], name), abs=1e-13)
        assert 1.0 <= other[3].size / one[3].size + 1e-12 < 100.0
        assert linearisation((a, b, d), regularisation, e, complement, -7)[3].sign == -7


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
