"""A matrix that a rotation brings into the normal form is judged as it is given, where nothing is rounded."""

import itertools
import math
from fractions import Fraction

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import ELinear, System, psi
from codim2_core.layer_problem.location import Existence, locate
from codim2_core.numerics.trigonometric import ROUNDING

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


def test_a_singular_matrix_is_certified_as_nothing():
    singular = ELinear.from_matrix([[1, -1], [-2, 2]], (-0.5, 1))
    found = {c.theorem: c.verdict.value for c in c2.certificates(singular, psi.constant())}
    assert found["thm:case2(a)"] == found["thm:case2(b)"] == found["thm:lineps1(a)"] == "does not apply"
    assert "fails" not in found.values()


@pytest.mark.parametrize("angle", [0.5 * math.pi, math.pi, 0.7, 1.9, -0.3])
@pytest.mark.parametrize("key", ["case1-cm4", "case2-ncm4", "case3-n3", "case1-cm0"])
def test_an_affine_system_at_any_rotation_has_closed_forms(monkeypatch, key, angle):
    """Its equator, critical sets and cycles are those of the normal form, turned; nothing is searched for."""
    from codim2_core.cycles import limit_cycles
    from codim2_core.layer_problem import critical, equator

    def never(*arguments):
        raise AssertionError("searched for what has a closed form")

    preset = c2.presets[key]
    own = preset.system.at(preset.z)
    exactly = {0.5 * math.pi: (0.0, 1.0), math.pi: (-1.0, 0.0)}
    k, n = exactly.get(angle, (math.cos(angle), math.sin(angle)))
    R = np.array([[k, -n], [n, k]])
    A, f = R @ own.A @ R.T, R @ own.f
    expected = (c2.equator_equilibria(own), c2.critical_sets(own, preset.psi), c2.limit_cycles(own, preset.psi))
    monkeypatch.setattr(equator, "_general", never)
    monkeypatch.setattr(critical, "_general_sets", never)
    monkeypatch.setattr(limit_cycles, "_general", never)
    for system in (as_text(A.ravel(), f), ELinear.from_matrix(A, f)):
        at = system.at()
        back = 0.0 if at.typed is not None else at.rotation
        equilibria, sets, cycles = expected
        found = c2.equator_equilibria(at)
        turned = equilibria.theta + angle + back
        gaps = np.abs(np.remainder(found.theta[:, None] - turned + math.pi, 2 * math.pi) - math.pi)
        assert len(found) == len(equilibria)
        assert len(found) == 0 or gaps.min(axis=1).max() < 1e-7
        assert np.sort(found.lambda_rho) == pytest.approx(np.sort(equilibria.lambda_rho), rel=1e-7, abs=1e-7)
        assert found.multiplicity.tolist() == [1] * len(equilibria)
        Q = np.array([[math.cos(back), -math.sin(back)], [math.sin(back), math.cos(back)]]) @ R
        for C, D in zip(c2.critical_sets(at, preset.psi), sets, strict=True):
            assert C.e == pytest.approx(Q @ D.e, abs=1e-14)
            assert C.trace == pytest.approx(D.trace, rel=1e-11)
            assert C.determinant == pytest.approx(D.determinant, rel=1e-11)
            assert C.kind == D.kind
        for one, other in zip(c2.limit_cycles(at, preset.psi), cycles, strict=True):
            assert one.period == pytest.approx(other.period, rel=1e-9)
            assert one.mean_e == pytest.approx(Q @ other.mean_e, abs=1e-9)
            radius = np.hypot(*other.points.T)
            assert np.hypot(*one.points.T).max() == pytest.approx(radius.max(), rel=1e-3)
        cycle, other = c2.equator_cycle(at), c2.equator_cycle(own)
        assert (cycle is None) == (other is None)
        if other is not None:
            assert cycle.exponent == pytest.approx(other.exponent, rel=1e-12)
        name = c2.classify(at, preset.psi)
        assert (name.case, name.name) == (c2.classify(own, preset.psi).case, c2.classify(own, preset.psi).name)


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


def fields(rng):
    """Matrices and forces whose zero e is at 1 + distance from the centre, from far away to within rounding."""
    for _ in range(400):
        A = rng.normal(size=(2, 2))
        if rng.random() < 0.3:  # nearly singular
            A[1] = rng.normal() * A[0] + 10.0 ** rng.uniform(-9, -1) * rng.normal(size=2)
        angle, distance = rng.uniform(0, 2 * math.pi), rng.choice([-1.0, 1.0]) * 10.0 ** rng.uniform(-17, -13)
        f = -(1.0 + distance) * A @ [math.cos(angle), math.sin(angle)]
        yield tuple(A.ravel().tolist()), tuple(f.tolist())


def test_on_the_equator_means_within_the_rounding_of_the_entries():
    """The gap det^2 - |adj(A) f|^2 against half its change by each entry in turn, all in exact fractions."""
    seen = set()
    for A, f in fields(np.random.default_rng(9)):
        entries = [Fraction(v) for v in (*A, *f)]

        def gap(m11, m12, m21, m22, f1, f2):
            return (m11 * m22 - m12 * m21) ** 2 - (m22 * f1 - m12 * f2) ** 2 - (m11 * f2 - m21 * f1) ** 2

        change = Fraction(0)
        for i, entry in enumerate(entries):  # of second degree in each: a central difference is exact
            up, down = list(entries), list(entries)
            up[i], down[i] = entry * 2, Fraction(0)
            change += abs(gap(*up) - gap(*down)) / 4
        level = abs(gap(*entries)) / change / Fraction(2 * ROUNDING)
        found = locate(ELinear.from_matrix([A[:2], A[2:]], f).at()).existence
        if found in (Existence.INSIDE, Existence.NONE, Existence.EQUATOR) and not Fraction(999, 1000) < level < 1:
            seen.add(found)
            inside = Existence.INSIDE if gap(*entries) > 0 else Existence.NONE
            assert found is (Existence.EQUATOR if level < 1 else inside)
    assert len(seen) == 3


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


def test_the_determinant_of_a_matrix_that_is_nearly_singular_is_that_of_its_numbers():
    """Turned into the normal form it would be lost: 3.5e-13 of 2."""
    M = ((0.7, 1.1), (1.4, 2.2 + 5e-13))
    f = tuple((-np.array(M) @ (0.3, -0.4)).tolist())
    (m11, m12), (m21, m22) = (map(Fraction, row) for row in M)
    for one in (c2.psi.constant(), c2.psi.rational()):
        (C,) = c2.critical_sets(ELinear.from_matrix(M, f), one)
        radial, tangential = one.jacobian_factors(float(np.hypot(*C.x2)))
        assert C.determinant == pytest.approx(float(m11 * m22 - m12 * m21) * radial * tangential, rel=1e-12, abs=0.0)
