"""The trails of fig:bads against a closed form and against `critical_sets`, point by point."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

import codim2_core as c2
from codim2_core.diagrams.eigenvalue_path import linearisation_path
from codim2_core.diagrams.sweep import CANCELS

BAD = c2.ELinear(172, 186, -200, f=(-86, -93))
numbers = st.floats(-3, 3).map(lambda v: round(v, 3))


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


@given(numbers, numbers, numbers, numbers, st.sampled_from([c2.psi.constant(), c2.psi.tanh(), c2.psi.hill(2)]))
@example(-1.859, -2.687, -1.859, -1.859, c2.psi.constant())  # 1 - |e|^2 = 0.08 at a = -1.999
@example(2.334, 3.0, 0.0, 2.335, c2.psi.constant())  # |A^-1 f| = 1 - 2e-4 at a = 0.001
def test_every_point_agrees_with_critical_sets(b: float, d: float, f1: float, f2: float, psi: c2.Psi) -> None:
    values = np.linspace(-2, 2, 9) + 1e-3
    system = c2.ELinear(1, b, d, f=(f1, f2))
    path = linearisation_path(system, psi, "a", values)
    for i, value in enumerate(values):
        found = c2.critical_sets(system.evolve(a=value), psi)
        if path.exists[i] != bool(found):  # only within rounding of the border
            assert c2.classify(system.evolve(a=value), psi).degeneracies
            continue
        if found:
            scale = abs(found[0].jacobian).max()
            # e = -A^-1 f is known to cond(A) roundings; 1 - |e|^2, which J reads, to all digits where it cancels much,
            # and else to roundings of 1
            inside = 1.0 - float(found[0].e @ found[0].e)
            lost = 1.0 / inside if inside >= CANCELS else 1.0
            rounding = 2.0**-52 * (lost + np.linalg.cond([[value, -b], [b, d]]))
            assert path.trace[i] == pytest.approx(found[0].trace, rel=0, abs=8 * rounding * scale)
            assert path.determinant[i] == pytest.approx(found[0].determinant, rel=0, abs=16 * rounding * scale**2)
            assert path.discriminant[i] == pytest.approx(found[0].discriminant, rel=0, abs=32 * rounding * scale**2)
            np.testing.assert_allclose(path.eigenvalues[i].sum(), path.trace[i], rtol=0.0, atol=1e-12 * scale)
            np.testing.assert_allclose(path.eigenvalues[i].prod(), path.determinant[i], rtol=0.0, atol=1e-12 * scale**2)
            if abs(path.discriminant[i]) > 1e-12 * scale**2 and abs(path.trace[i]) > 1e-12 * scale:
                assert path.kind[i] == found[0].kind


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


def test_slow_variables_and_parameters_in_text() -> None:
    system = c2.ELinear("k - z1", 1, -2, f=("z1**2/4", 0.1), parameters={"k": 0.5})
    for name, other in (("z1", "k"), ("k", "z1")):
        path = linearisation_path(system, c2.psi.exponential(), name, [0.1, 0.4, 0.7], z=(0.3,))
        for i, value in enumerate([0.1, 0.4, 0.7]):
            z, k = (value, 0.5) if name == "z1" else (0.3, value)
            C = c2.critical_sets(system.evolve(k=k), c2.psi.exponential(), z=(z,))[0]
            assert path.trace[i] == pytest.approx(C.trace, rel=1e-13), other
    turned = c2.ELinear.from_matrix([["1 + z", 0.3], [-0.7, -2]], f=("z/9", 0.1))
    path = linearisation_path(turned, c2.psi.tanh(), "z1", [0.2, 0.9], z=(0,))
    for i, z in enumerate([0.2, 0.9]):
        assert path.trace[i] == pytest.approx(c2.critical_sets(turned, c2.psi.tanh(), z=z)[0].trace, rel=1e-12)


@pytest.mark.parametrize(
    ("name", "values", "message"),
    [("n", [1], "cannot be varied"), ("a", [np.nan], "finite"), ("q", [0], "choose one of a, b, d, f1, f2")],
)
def test_wrong_input_is_explained(name: str, values: list[float], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        linearisation_path(c2.ELinear(1, 2, 3), c2.psi.tanh(), name, values)
    with pytest.raises(ValueError, match=r"beyond 0\.01 to 1000"):
        linearisation_path(BAD, c2.psi.hill(1), "n", [0.0])
