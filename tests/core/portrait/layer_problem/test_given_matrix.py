"""A matrix that a rotation brings into the normal form is judged as it is given, where nothing is rounded."""

import itertools
import math
from fractions import Fraction

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import ELinear, System, psi
from codim2_core.portrait.layer_problem.linearisation import Existence, locate

HALVES = [Fraction(k, 2) for k in range(-6, 7)]
# -A has the zeros of A for -f, which lie opposite: half of all matrices say everything
MATRICES = [A for A in itertools.product(HALVES[::2] + HALVES[1::4], repeat=4) if next(filter(None, A), 0) >= 0]


def as_text(A, f):
    (a11, a12, a21, a22), (f1, f2) = map(float, A), map(float, f)
    return System(U=(f"{a11!r}*c + {a12!r}*s + {f1!r}", f"{a21!r}*c + {a22!r}*s + {f2!r}"))


def as_matrix(A, f):
    return ELinear.from_matrix([list(map(float, A[:2])), list(map(float, A[2:]))], tuple(map(float, f)))


def exact(A, f):
    """Case and existence in exact arithmetic."""
    a11, a12, a21, a22 = A
    det, sym = a11 * a22 - a12 * a21, a11 * a22 - ((a12 + a21) / 2) ** 2
    case = None if sym == 0 else "I" if sym > 0 else None if det == 0 else "III" if det > 0 else "II"
    n = a22 * f[0] - a12 * f[1], a11 * f[1] - a21 * f[0]
    gap = det * det - n[0] ** 2 - n[1] ** 2
    if det == 0:
        if not any(A):
            return case, {Existence.EVERYTHING if not any(f) else Existence.SINGULAR_NONE}
        if any(n):
            return case, {Existence.SINGULAR_NONE}
        return case, {Existence.SINGULAR_LINE, Existence.SINGULAR_OUTSIDE}
    return case, {Existence.EQUATOR if gap == 0 else Existence.INSIDE if gap > 0 else Existence.NONE}


FORCES = [(Fraction(0), Fraction(0)), (Fraction(-1, 2), Fraction(1)), (Fraction(3, 2), Fraction(1, 2))]


@pytest.mark.parametrize("f", FORCES, ids=str)
@pytest.mark.parametrize("given", [as_matrix, as_text])
def test_half_integer_matrices_are_decided_exactly(given, f):
    # each matrix is asked with one of the forces
    matrices = MATRICES[FORCES.index(f) :: len(FORCES)] if given is as_matrix else MATRICES[::17]
    for A in matrices:
        if not any(A) and not any(f):
            continue
        at = given(A, f).at()
        case, existence = exact(A, f)
        found = locate(at)
        assert found.existence in existence, (A, f, found)
        (a11, a12, a21, a22), form = A, at.normal_form
        assert np.sign(form.a * form.d) == np.sign(float(a11 * a22 - ((a12 + a21) / 2) ** 2)), A
        if found.e is not None:
            e = np.array(found.e)
            assert np.abs(at.U(e)).max() <= 1e-14 * (1.0 + at.size)
        if case in ("II", "III") and found.existence is Existence.INSIDE:
            (C,) = c2.critical_sets(at, psi.rational())
            assert (C.kind == "saddle") == (case == "II")


def test_singular_matrices_are_named_so_and_certified_as_nothing():
    """Both were given a case and a critical set: the rotation had rounded their determinants."""
    for A, f, name in (([[1, -1], [-2, 2]], (-0.5, 1), "line of equilibria"),
                       ([[-1, -3], [-1.5, -4.5]], (0, 0), "line of equilibria")):  # fmt: skip
        for system in (ELinear.from_matrix(A, f), as_text(np.ravel(A), f)):
            found = c2.classify(system, psi.constant())
            assert found.case is None, A
            assert name in [d.name for d in found.degeneracies], found
            assert c2.critical_sets(system, psi.constant()) == ()
            assert len(c2.limit_cycles(system, psi.constant())) == 0


@pytest.mark.parametrize("angle", [0.5 * math.pi, math.pi, 0.7, 1.9, -0.3])
@pytest.mark.parametrize("key", ["case1-cm4", "case2-ncm4", "case3-n3", "case1-cm0"])
def test_an_affine_system_at_any_rotation_is_its_normal_form_turned(key, angle):
    preset = c2.presets[key]
    own, p = preset.system.at(preset.z), preset.psi
    k, n = {0.5 * math.pi: (0.0, 1.0), math.pi: (-1.0, 0.0)}.get(angle, (math.cos(angle), math.sin(angle)))
    R = np.array([[k, -n], [n, k]])
    A, f = R @ own.A @ R.T, R @ own.f
    equator, portrait = c2.equator_equilibria(own), c2.classify(own, p)
    for at in (as_text(A.ravel(), f).at(), ELinear.from_matrix(A, f).at()):
        back = 0.0 if at.typed is not None else at.rotation
        found, name = c2.equator_equilibria(at), c2.classify(at, p)
        assert (name.case, name.name) == (portrait.case, portrait.name)
        assert found.multiplicity.tolist() == [1] * len(equator)
        gaps = np.remainder(found.theta[:, None] - equator.theta - angle - back + math.pi, 2 * math.pi) - math.pi
        assert (np.abs(gaps).min(axis=1, initial=9.0) < 1e-7).all()
        assert np.sort(found.lambda_rho) == pytest.approx(np.sort(equator.lambda_rho), rel=1e-7, abs=1e-7)
        Q = np.array([[math.cos(back), -math.sin(back)], [math.sin(back), math.cos(back)]]) @ R
        for C, D in zip(c2.critical_sets(at, p), c2.critical_sets(own, p), strict=True):
            assert C.e == pytest.approx(Q @ D.e, abs=1e-14)
            assert (C.trace, C.determinant) == pytest.approx((D.trace, D.determinant), rel=1e-11)
            assert C.kind == D.kind
        for one, other in zip(c2.limit_cycles(at, p), c2.limit_cycles(own, p), strict=True):
            assert one.period == pytest.approx(other.period, rel=1e-9)
            assert one.mean_e == pytest.approx(Q @ other.mean_e, abs=1e-9)
        one, other = c2.equator_cycle(at), c2.equator_cycle(own)
        assert (one is None) == (other is None)
        assert one is None or one.exponent == pytest.approx(other.exponent, rel=1e-12)


@pytest.mark.parametrize(("A", "f", "name"), [
    ([[0.0, 1.0], [1.0, 0.0]], (0.7, 0.7), "none"),
    ([[0.0, 1.0], [1.0, 0.0]], (2.0, 2.0), "pitchfork"),
    ([[-1.5, 0.5], [0.5, -1.5]], (-1.0, -1.0), "pitchfork"),
])  # fmt: skip
def test_a_pitchfork_of_a_turned_matrix_is_named(A, f, name):
    """f is an eigenvector: with |f| = |d - a| Theta has a triple zero (D2); the rotation rounds f."""
    scale = np.ptp(np.linalg.eigvalsh(A))
    f = np.array(f) if name == "none" else np.array(f) / np.hypot(*f) * scale
    for system in (ELinear.from_matrix(A, tuple(f)), as_text(np.ravel(A), f)):
        equator = c2.equator_equilibria(system)
        assert equator.symmetric
        names = [d.name for d in c2.classify(system, psi.constant()).degeneracies]
        assert ("pitchfork" in names) == (name == "pitchfork"), names


@pytest.mark.parametrize("small", [1e-3, 1e-9, 1e-14, -1e-9])
def test_a_determinant_that_a_rotation_would_round_is_that_of_the_matrix_as_given(small):
    A, f = [[1.0, 2.0], [0.5, 1.0 + small]], (0.25 * small, 0.0)
    system = ELinear.from_matrix(A, f)
    (C,) = c2.critical_sets(system, psi.rational())
    radial, tangential = psi.rational().jacobian_factors(float(np.hypot(*C.x2)))
    exact = Fraction(A[0][0]) * Fraction(A[1][1]) - Fraction(A[0][1]) * Fraction(A[1][0])
    assert C.determinant == pytest.approx(float(exact) * radial * tangential, rel=1e-9)
    np.testing.assert_allclose(system.at().U(C.e), 0.0, atol=1e-14)
    assert (C.kind == "saddle") == (small < 0.0)
