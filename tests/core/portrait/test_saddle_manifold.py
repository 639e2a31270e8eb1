"""Manifolds of a saddle: the order of the local expansion, and where on them branches start."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from codim2_core import critical_sets, presets, psi
from codim2_core.portrait.separatrix_branches import ORDER, expansion

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
