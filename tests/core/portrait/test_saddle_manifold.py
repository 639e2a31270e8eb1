"""Manifolds of a saddle: the order of the local expansion, and where on them branches start."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from codim2_core import ELinear, System, critical_sets, presets, psi
from codim2_core.portrait.saddle_manifold import FIRST, ORDER, SMALLEST, expansion, starts

SADDLE = presets["case2-saddle"].system
FAMILIES = [psi.constant(), psi.rational(), psi.exponential(), psi.tanh(), psi.hill(3)]


@pytest.mark.parametrize("p", FAMILIES, ids=lambda p: p.text)
@pytest.mark.parametrize("which", [0, 1])
def test_expansion_has_its_order(p, which):
    (C,) = critical_sets(SADDLE, p)
    value = float(C.eigenvalues.real[which])
    defect = [expansion(SADDLE.at(()), p, C, value, reach)[1] for reach in (0.03, 0.015)]
    assert math.log2(defect[0] / defect[1]) == pytest.approx(ORDER + 1, abs=0.25)
    assert defect[0] < 2e-9


@pytest.mark.parametrize("p", FAMILIES, ids=lambda p: p.text)
def test_expansion_is_tangent_and_invariant(p):
    (C,) = critical_sets(SADDLE, p)
    value = float(C.eigenvalues.real[0])
    terms, _ = expansion(SADDLE.at(()), p, C, value, 0.02)
    assert C.jacobian @ terms[1] == pytest.approx(value * terms[1], abs=1e-12)

    # On the manifold sigma' = lambda sigma: doubling sigma takes ln 2/lambda.
    def field(_, x):
        zeta = math.hypot(*x)
        return SADDLE.at(()).U(x * float(p.modulus(zeta)) / zeta)

    near, far = (np.array([0.01, 0.02])[:, None] ** np.arange(ORDER + 1)) @ terms
    end = solve_ivp(field, (0.0, math.log(2.0) / value), near, method="DOP853", rtol=1e-13, atol=1e-14).y[:, -1]
    assert end == pytest.approx(far, abs=3e-11)


def test_expansion_is_exact_where_manifolds_are_straight():
    """For f = 0 the orbits are those of x2' = A x2."""
    system = ELinear(1.0, 0.3, -1.0)
    (C,) = critical_sets(system, psi.tanh())
    terms, defect = expansion(system.at(()), psi.tanh(), C, float(C.eigenvalues.real[0]), 0.05)
    assert np.abs(terms[1][0] * terms[2:, 1] - terms[1][1] * terms[2:, 0]).max() < 1e-6
    assert defect < 1e-9
    points, tangents = starts(system.at(()), psi.tanh(), C, float(C.eigenvalues.real[0]), 1e-10)
    assert tangents == pytest.approx(points / np.linalg.norm(points, axis=1)[:, None], abs=1e-9)


FAR_OUT = ELinear(1.0, 0.3, -1.2, f=(-0.94, -0.2))


def _start(system, p, value, tolerance):
    """The saddle in x2, and where in x2 both halves start."""
    (C,) = critical_sets(system, p)
    points, _ = starts(system.at(()), p, C, value, tolerance)
    return C, points / np.sqrt(1.0 - (points**2).sum(axis=1))[:, None]


@pytest.mark.parametrize("which", [0, 1])
def test_branches_start_where_the_expansion_has_the_error_that_is_allowed(which):
    """Relative to the distance of the saddle in x2, which is 2 here: no larger, and not thirty times smaller."""
    p = psi.rational()
    (C,) = critical_sets(FAR_OUT, p)
    scale, value = math.hypot(1.0, *C.x2), float(C.eigenvalues.real[which])
    assert scale > 1.8
    for tolerance in (1e-6, 1e-9):
        _, ends = _start(FAR_OUT, p, value, tolerance)
        reach = 0.5 * math.dist(*ends)  # sigma, but for its square
        assert 0.03 * tolerance * scale < expansion(FAR_OUT.at(()), p, C, value, reach)[1] < 1.1 * tolerance * scale


@pytest.mark.parametrize("which", [0, 1])
def test_branches_start_as_far_out_as_is_tried_if_that_is_good_enough(which):
    p = psi.rational()
    (C,) = critical_sets(FAR_OUT, p)
    scale, value = math.hypot(1.0, *C.x2), float(C.eigenvalues.real[which])
    terms, defect = expansion(FAR_OUT.at(()), p, C, value, FIRST * scale)
    farthest = np.array([[-1.0], [1.0]]) ** np.arange(ORDER + 1) * (FIRST * scale) ** np.arange(ORDER + 1) @ terms
    _, ends = _start(FAR_OUT, p, value, 1.01 * defect / scale)
    np.testing.assert_allclose(ends, farthest, rtol=1e-12)
    _, ends = _start(FAR_OUT, p, value, 0.95 * defect / scale)
    assert 0.6 * math.dist(*farthest) < math.dist(*ends) < 0.85 * math.dist(*farthest)


def test_branches_start_no_nearer_than_there_are_digits():
    p = psi.rational()
    (C,) = critical_sets(FAR_OUT, p)
    _, ends = _start(FAR_OUT, p, float(C.eigenvalues.real[0]), 1e-40)
    assert math.dist(*ends) == pytest.approx(2.0 * SMALLEST * math.hypot(1.0, *C.x2), rel=1e-6)


@pytest.mark.parametrize("p", FAMILIES, ids=lambda p: p.text)
def test_the_defect_is_that_of_the_equation_of_the_manifold(p):
    """F(W) = lambda sigma W' at both ends, in units of lambda."""
    (C,), reach = critical_sets(FAR_OUT, p), 0.4
    for value in C.eigenvalues.real.tolist():
        terms, defect = expansion(FAR_OUT.at(()), p, C, value, reach)
        worst = 0.0
        for sigma in (-reach, reach):
            x2 = sigma ** np.arange(ORDER + 1) @ terms
            slope = (np.arange(1, ORDER + 1) * sigma ** np.arange(ORDER)) @ terms[1:]
            zeta = math.hypot(*x2)
            F = FAR_OUT.at(()).U(x2 * float(p.modulus(zeta)) / zeta)
            worst = max(worst, np.abs(F - value * sigma * slope).max() / abs(value))
        assert defect == pytest.approx(worst, rel=1e-6)
        assert np.hypot(*terms[1]) == pytest.approx(1.0, rel=1e-14)


@pytest.mark.parametrize("p", [psi.rational(), psi.tanh()], ids=lambda p: p.text)
def test_in_turned_axes_the_manifold_is_the_same_one_turned(p):
    """Through 0.7, as formulas: in no normal form."""
    R = np.array([[math.cos(0.7), -math.sin(0.7)], [math.sin(0.7), math.cos(0.7)]])
    at = FAR_OUT.at(())
    U = [f"{a!r}*c + {b!r}*s + {f!r}" for (a, b), f in zip((R @ at.A @ R.T).tolist(), (R @ at.f).tolist(), strict=True)]
    turned = System(U=U)
    (C,), (D,) = critical_sets(FAR_OUT, p), critical_sets(turned, p)
    for one, other in zip(sorted(C.eigenvalues.real), sorted(D.eigenvalues.real), strict=True):
        terms, defect = expansion(at, p, C, one, 0.3)
        own, found = expansion(turned.at(()), p, D, other, 0.3)
        side = np.sign(own[1] @ R @ terms[1]) ** np.arange(ORDER + 1)  # either way along the eigenvector
        far = 0.3 ** np.arange(ORDER + 1)[:, None]
        np.testing.assert_allclose(far * own, far * side[:, None] * terms @ R.T, rtol=0.0, atol=1e-11)
        assert defect / 1.42 < found < 1.42 * defect  # the larger of two components
