"""Critical sets against 50-digit arithmetic, finite differences and the paper's numbers."""

import math
from fractions import Fraction

import mpmath
import numpy as np
import pytest
from hypothesis import given

from codim2_core import ELinear, System, critical_sets, equator_cycle, hemisphere, psi
from codim2_core.numerics.trigonometric import INPUT_ROUNDING
from codim2_core.portrait.layer_problem.linearisation import Existence, locate
from tests.core.strategies import regularisations, systems


@given(systems, regularisations)
def test_it_is_an_equilibrium_of_the_flow_and_of_50_digit_arithmetic(system, regularisation):
    at = system.at()
    with mpmath.workdps(80):  # exact: products of four doubles have up to 64 digits
        a, b, d, f1, f2 = map(mpmath.mpf, at.plane)
        det, n1, n2 = a * d + b * b, d * f1 + b * f2, a * f2 - b * f1
        exists = det != 0 and n1**2 + n2**2 < det**2
        blurred = abs(n1**2 + n2**2 - det**2) < 1e-14 * det**2
        e = (-n1 / det, -n2 / det) if exists else None
    found = critical_sets(system, regularisation)
    if blurred and locate(at).existence is Existence.EQUATOR:
        assert not found
        return
    assert len(found) == int(exists)
    if not exists or max(map(abs, e)) > 1 - 1e-9:
        return
    C = found[0]
    np.testing.assert_allclose(C.e, np.array(e, float), rtol=1e-14, atol=4e-16)
    size = max(map(abs, at.plane))
    np.testing.assert_allclose(hemisphere.flow(at, regularisation, C.p), 0.0, atol=1e-13 * size)
    np.testing.assert_allclose(hemisphere.disc_from_scaling(C.x2), C.p, rtol=1e-14, atol=1e-300)


@pytest.mark.parametrize("n", range(1, 9))
def test_case_three_trace_and_determinant(n):
    system = ELinear(172, 186, -200, (-86, -93))
    (C,) = critical_sets(system, psi.hill(n))
    np.testing.assert_allclose(C.e, [0.5, 0.0], rtol=0.0, atol=1e-16)
    assert C.trace == pytest.approx(-71 + 32.25 * n, rel=1e-13)
    assert C.determinant == pytest.approx(147 + 36.75 * n, rel=1e-12)
    assert C.discriminant == pytest.approx(C.trace**2 - 4 * C.determinant, rel=1e-11)


def test_on_the_equator_means_within_the_rounding_of_the_coefficients():
    """The gap det^2 - |adj(A) f|^2 against half its change by each coefficient in turn, in exact fractions."""
    rng, seen = np.random.default_rng(21), set()
    for _ in range(300):
        a, b, d = rng.normal(size=3).tolist()
        if rng.random() < 0.3:  # nearly singular
            d = -b * b / a * (1.0 + 10.0 ** rng.uniform(-9, -1))
        angle, distance = rng.uniform(0.0, 2.0 * math.pi), rng.choice([-1.0, 1.0]) * 10.0 ** rng.uniform(-17, -13)
        c, s = (1.0 + distance) * math.cos(angle), (1.0 + distance) * math.sin(angle)
        plane = [a, b, d, b * s - a * c, -b * c - d * s]
        exact = [Fraction(v) for v in plane]

        def gap(a, b, d, f1, f2):
            return (a * d + b * b) ** 2 - (d * f1 + b * f2) ** 2 - (a * f2 - b * f1) ** 2

        def slope(i, exact=exact):
            """x df/dx: five points are exact up to the fourth degree, in which b stands."""
            at = [gap(*(v * (1 + k * (j == i)) for j, v in enumerate(exact))) for k in (-2, -1, 1, 2)]
            return (8 * (at[2] - at[1]) - (at[3] - at[0])) / 12

        level = abs(gap(*exact)) / (sum(abs(slope(i)) for i in range(5)) / 2) / Fraction(2 * INPUT_ROUNDING)
        found = locate(ELinear(a, b, d, tuple(plane[3:])).at()).existence
        if found in (Existence.INSIDE, Existence.NONE, Existence.EQUATOR) and not Fraction(999, 1000) < level < 1:
            seen.add(found)
            inside = Existence.INSIDE if gap(*exact) > 0 else Existence.NONE
            assert found is (Existence.EQUATOR if level < 1 else inside)
    assert len(seen) == 3


@pytest.mark.parametrize("size", [1e-310, 1e-150])
def test_a_coefficient_that_is_next_to_nothing_changes_nothing(size):
    for one, other in (
        (ELinear(-1.0, size, -2.0, (0.2, 0.3)), ELinear(-1.0, 0.0, -2.0, (0.2, 0.3))),
        (ELinear(size, 1.5, -0.5, (0.2, 0.3)), ELinear(0.0, 1.5, -0.5, (0.2, 0.3))),
        (
            ELinear.from_matrix([[-1, size], [0.5, -2]], (0.2, 0.3)),
            ELinear.from_matrix([[-1, 0], [0.5, -2]], (0.2, 0.3)),
        ),
        (ELinear(1.0, 3.0, 1.2, (size, 0.3)), ELinear(1.0, 3.0, 1.2, (0.0, 0.3))),
    ):
        (C,), (D,) = (critical_sets(system, psi.rational()) for system in (one, other))
        np.testing.assert_allclose(C.e, D.e, rtol=0.0, atol=1e-15)
        np.testing.assert_allclose(C.jacobian, D.jacobian, rtol=0.0, atol=1e-14)
        assert (C.kind, C.determinant, C.trace) == (D.kind, pytest.approx(D.determinant), pytest.approx(D.trace))
        mine, its = equator_cycle(one), equator_cycle(other)
        assert (mine is None) == (its is None)
        if mine is not None:
            assert (mine.period, mine.exponent) == (pytest.approx(its.period), pytest.approx(its.exponent))


@pytest.mark.parametrize(
    ("plane", "existence"),
    [
        ((1.0, 1.0, -1.0, 0.5, 0.5), Existence.SINGULAR_LINE),
        ((1.0, 1.0, -1.0, 0.5, 0.4), Existence.SINGULAR_NONE),
        ((1.0, 1.0, -1.0, 5.0, 5.0), Existence.SINGULAR_OUTSIDE),
        ((0.0, 0.0, 0.0, 0.5, 0.5), Existence.SINGULAR_NONE),
        ((0.0, 0.0, 0.0, 0.0, 0.0), Existence.EVERYTHING),
        ((0.0, 0.0, 2.0, 0.0, 1.0), Existence.SINGULAR_LINE),
        ((0.1 * 3, 0.3, -0.3, 0.0, 0.0), Existence.SINGULAR_LINE),
    ],
)
def test_singular_matrices_are_named(plane, existence):
    a, b, d, f1, f2 = plane
    found = locate(ELinear(a, b, d, (f1, f2)).at())
    assert found.existence is existence
    assert critical_sets(ELinear(a, b, d, (f1, f2)), psi.constant()) == ()
    for e in found.line or ():
        assert np.hypot(*e) == pytest.approx(1.0, abs=1e-15)
        np.testing.assert_allclose(ELinear(a, b, d, (f1, f2)).at().U(e), 0.0, atol=1e-15)


def test_a_trace_that_vanishes_by_its_formula_is_neutral_whatever_is_rounded():
    rng = np.random.default_rng(1)
    for a, b, c, d, p, q in rng.normal(size=(40, 6)).round(3).tolist():
        # traceless at 0, which is a critical set since U is odd; its terms cancel in decimals
        first = f"{a}*c + {b}*s + {p}*(sin(2*c) - 2*c) + {p}*2*c - {2 * p:.6f}*c + {q}*(exp(s) - exp(-s))"
        system = System(U=(first, f"{c}*c - {a}*s + {d}*c**3"))
        kinds = [C.kind for C in critical_sets(system, psi.tanh()) if np.hypot(*C.e) < 1e-9]
        assert kinds in (["saddle"], ["centre (linear)"])
