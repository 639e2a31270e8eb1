"""The node-focus curve at the paper's Case III, where 2 sqrt(det A) = |tr A|: through the circle on which sigma = 1."""

import numpy as np
import pytest

from codim2_core import ELinear, presets
from codim2_core.bifurcations import node_focus
from codim2_core.portrait.layer_problem.critical import critical_sets


@pytest.mark.parametrize("key", ["case3-n2", "case3-n3", "case3-n4"])
def test_it_does_not_jump_where_both_eigenvalues_agree_on_a_whole_circle(key):
    p = presets[key]
    assert 4.0 * (p.a * p.d + p.b * p.b) == (p.a + p.d) ** 2
    A = np.array([[p.a, -p.b], [p.b, p.d]])
    curves = node_focus(ELinear(p.a, p.b, p.d), p.psi).branches
    for curve in curves:
        e = -np.linalg.solve(A, curve.T).T
        assert np.hypot(*np.diff(e, axis=0).T).max() < 0.05
        for f1, f2 in curve[5:-5:40]:
            found = critical_sets(p.system.evolve(f1=float(f1), f2=float(f2)), p.psi)
            for C in found:
                assert abs(C.trace**2 - 4.0 * C.determinant) < 1e-6 * C.trace**2
