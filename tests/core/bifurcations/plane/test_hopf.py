"""Hopf and node-focus curves, the first Lyapunov coefficient, and what changes with n."""

import itertools
import math
from itertools import pairwise

import mpmath
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from codim2_core import ELinear, bifurcations, critical_sets, psi
from codim2_core.bifurcations.families.first_lyapunov import first_lyapunov
from codim2_core.portrait.layer_problem.linearisation import determinant_sign
from tests.core.exact_psi import regularisation
from tests.core.strategies import coefficient

matrices = st.tuples(coefficient, coefficient, coefficient)
CASE3 = (172.0, 186.0, -200.0)
PLAIN = psi.constant, psi.rational, psi.exponential, psi.tanh


def normal_form_coefficient(A, f, regularisation_mp, x0):
    """First Lyapunov coefficient by the planar formula with partial derivatives, in 30 digits."""
    with mpmath.workdps(40):

        def U(x, y):
            r = mpmath.sqrt(x * x + y * y + regularisation_mp(x * x + y * y))
            return (A[0, 0] * x / r + A[0, 1] * y / r + f[0], A[1, 0] * x / r + A[1, 1] * y / r + f[1])

        x0 = mpmath.findroot(lambda x, y: U(x, y), tuple(map(mpmath.mpf, x0)))
        J = mpmath.matrix([[mpmath.diff(lambda x, y, i=i: U(x, y)[i], tuple(x0), n) for n in ((1, 0), (0, 1))]
                           for i in range(2)])  # fmt: skip
        w = mpmath.sqrt(mpmath.det(J))
        # columns Re q, -Im q of the eigenvector: (u, v)' = [[0, -w], [w, 0]] (u, v) + ...
        P = mpmath.matrix([[J[0, 1], 0], [-J[0, 0], -w]])
        Q = P**-1

        def G(u, v):
            x = P * mpmath.matrix([u, v])
            return Q * mpmath.matrix(U(x0[0] + x[0], x0[1] + x[1]))

        D = lambda i, n: mpmath.diff(lambda u, v: G(u, v)[i], (0, 0), n)
        Jc = Q * J * P
        sign = mpmath.sign(Jc[1, 0])  # with (u, v)' = [[0, -w], [w, 0]] the formula holds; else mirror
        w = sign * w
        F = {n: D(0, n) for n in ((2, 0), (1, 1), (0, 2), (3, 0), (1, 2))}
        H = {n: D(1, n) for n in ((2, 0), (1, 1), (0, 2), (2, 1), (0, 3))}
        sixteen = (
            F[3, 0] + F[1, 2] + H[2, 1] + H[0, 3]
            + (F[1, 1] * (F[2, 0] + F[0, 2]) - H[1, 1] * (H[2, 0] + H[0, 2])) / w
            + (F[0, 2] * H[0, 2] - F[2, 0] * H[2, 0]) / w
        )  # fmt: skip
        # r' = (sixteen/16) r^3 in these coordinates; |x| of the vector q = P (1, -i)/2 normalised to length 1
        scale = 2 / sum(abs(P[i, j]) ** 2 for i in range(2) for j in range(2))
        return float(sixteen / 16 * scale * 2 / abs(w)), float(abs(w))


@pytest.mark.parametrize("family", [*(make() for make in PLAIN), psi.hill(3), psi.custom("1/(1+s)**2")])
def test_first_lyapunov_coefficient_is_that_of_the_planar_normal_form(family):
    a, b, d = 1.0, 1.5, -1.2
    A = np.array([[a, -b], [b, d]])
    curve = bifurcations.hopf(ELinear(a, b, d), family)
    for branch, values in zip(curve.branches, curve.values, strict=True):
        for i in (len(branch) // 3, 2 * len(branch) // 3):
            f = branch[i]
            (C,) = critical_sets(ELinear(a, b, d, tuple(f)), family)
            expected, _ = normal_form_coefficient(A, f, regularisation(family)[0], C.x2)
            assert values[i] == pytest.approx(expected, rel=1e-8)


@pytest.mark.parametrize("regularisation", [psi.hill(1), psi.hill(2), psi.hill(3.5), psi.tanh(), psi.rational()])
def test_a_critical_set_at_the_origin_has_its_coefficient_whatever_psi(regularisation):
    """In plane coordinates e = q (cos, sin) a cycle of U = (k q^2 c - s, c + k q^2 s) grows by k q^3: l1 ~ k."""
    A = np.array([[[0.0, -1.0], [1.0, 0.0]]])
    third = np.zeros((1, 2, 2, 2, 2))
    for i, j in itertools.product(range(2), repeat=2):  # of k c (c^2 + s^2), k s (c^2 + s^2)
        for a, b, c in {(i, j, j), (j, i, j), (j, j, i)}:
            third[0, i, a, b, c] = 6.0 if i == j else 2.0
    own = [first_lyapunov(A, regularisation, np.array([[size, 0.0]]), None, third)[0] for size in (0.0, 1e-9)]
    assert own[0] == pytest.approx(own[1], rel=1e-6)
    assert own[0] > 0.1


def test_where_there_is_no_hopf_curve_it_says_why():
    assert not bifurcations.hopf(ELinear(-1, 1, -2), psi.hill(4)).branches
    assert "Case III" in bifurcations.hopf(ELinear(1, 0.1, -1), psi.constant()).sentence
    assert "everywhere" in bifurcations.hopf(ELinear(0, 1, 0), psi.constant()).name
    reversible = bifurcations.hopf(ELinear(1, 2, -1), psi.constant())
    assert "reversible" in reversible.sentence
    assert all((v == 0.0).all() for v in reversible.values)


def test_case_three_changes_at_284_129_and_two_more():
    found = bifurcations.hill_changes(ELinear(*CASE3, (-86, -93)))
    assert [c.type for c in found] == ["node-focus", "Hopf", "node-focus"]
    assert found[1].n == pytest.approx(284 / 129, abs=1e-12)
    # (-71 + 32.25 n)^2 = 4 (147 + 36.75 n)
    with mpmath.workdps(30):
        p, q, r = mpmath.mpf("32.25") ** 2, -2 * 71 * mpmath.mpf("32.25") - 147, mpmath.mpf(71) ** 2 - 588
        root = mpmath.sqrt(q * q - 4 * p * r)
        roots = [float((-q - root) / (2 * p)), float((-q + root) / (2 * p))]
    assert [found[0].n, found[2].n] == pytest.approx(roots, abs=1e-12)
    assert [found[0].before, *(c.after for c in found)] == [
        "stable node", "stable focus", "unstable focus", "unstable node",
    ]  # fmt: skip


@settings(max_examples=20)
@given(matrices, st.floats(0.05, 0.95), st.floats(0, 6.3))
def test_kinds_between_the_changes_of_n(abd, m, t):
    assume(determinant_sign(*abd) > 0)
    A = np.array([[abd[0], -abd[1]], [abd[1], abd[2]]])
    assume(np.linalg.cond(A) < 1e4)
    system = ELinear(*abd, tuple(-A @ np.array([m * math.cos(t), m * math.sin(t)])))
    changes = bifurcations.hill_changes(system)
    edges = [0.02, *(c.n for c in changes if 0.02 < c.n < 900), 900]
    for low, high in pairwise(edges):
        if high / low < 1 + 1e-6:
            continue
        kinds = {critical_sets(system, psi.hill(low * (high / low) ** u))[0].kind for u in (0.03, 0.4, 0.97)}
        assert len(kinds) == 1
    for c in changes:
        if 0.02 < c.n < 900 and all(abs(o.n / c.n - 1) > 1e-5 for o in changes if o is not c):
            kinds = [critical_sets(system, psi.hill(c.n * (1 + s * 1e-6)))[0].kind for s in (-1, 1)]
            assert kinds == [c.before, c.after]
