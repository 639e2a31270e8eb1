"""The trails of fig:bads against a closed form and against `critical_sets`, point by point."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import codim2_core as c2
from codim2_core.bifurcations.diagrams.eigenvalue_path import linearisation_path

BAD = c2.ELinear(172, 186, -200, f=(-86, -93))


def test_hill_n_moves_the_paper_s_case_iii_along_a_line() -> None:
    # e = (1/2, 0), Psi = 3/4 at 4s = 1: both are linear in n
    n = np.linspace(1, 4, 31)
    path = linearisation_path(BAD, c2.psi.hill(1), "n", n)
    assert path.exists.all()
    np.testing.assert_allclose(path.trace, -71 + 32.25 * n, rtol=0, atol=2e-12)
    np.testing.assert_allclose(path.determinant, 147 + 36.75 * n, rtol=1e-13)
    np.testing.assert_allclose(path.discriminant, path.trace**2 - 4 * path.determinant, rtol=1e-9, atol=1e-9)
    assert path.kind[0] == "stable node"
    assert path.kind[-1] == "unstable node"
    assert "stable focus" in path.kind
    assert "unstable focus" in path.kind
    assert linearisation_path(BAD, c2.psi.hill(1), "n", [284 / 129]).trace[0] == pytest.approx(0, abs=1e-12)


@given(st.floats(-7.0, -1.0), st.floats(0.0, 6.28), st.sampled_from([c2.psi.constant(), c2.psi.tanh(), c2.psi.hill(2)]))
def test_near_the_equator_no_digits_are_lost(gap: float, theta: float, psi: c2.Psi) -> None:
    """1 - |e|^2 is a difference of squares: in doubles it would lose all digits but 16 + gap."""
    A = np.array([[-1.3, -0.4], [0.4, -2.1]])
    f = -(1.0 - 10.0**gap) * A @ [np.cos(theta), np.sin(theta)]
    system = c2.ELinear(-1.3, 0.4, -2.1, f=tuple(f))
    (C,) = c2.critical_sets(system, psi)
    path = linearisation_path(system, psi, "a", [-1.3, -1.0])
    size = abs(C.jacobian).max()
    assert path.trace[0] == pytest.approx(C.trace, rel=0, abs=2e-14 * size)
    assert path.determinant[0] == pytest.approx(C.determinant, rel=1e-13)


def test_no_critical_set_is_masked_and_nothing_is_nan() -> None:
    path = linearisation_path(c2.ELinear(-1, 0, -2), c2.psi.rational(), "f1", [-2, -1, 0, 1, 2, 0.5])
    assert path.exists.tolist() == [False, False, True, False, False, True]
    assert path.kind[0] == ""
    for array in (path.trace, path.determinant, path.discriminant, path.eigenvalues):
        assert np.isfinite(array).all()
        assert (array[~path.exists] == 0).all()
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1
