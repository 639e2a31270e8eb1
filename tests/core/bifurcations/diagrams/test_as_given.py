"""Signs are decided by the matrix as given, not by what a rotation into the normal form has rounded: by fractions."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from codim2_core import ELinear, System, critical_sets, psi
from codim2_core.bifurcations.diagrams.eigenvalue_path import linearisation_path
from codim2_core.bifurcations.diagrams.equilibrium_branches import equilibrium_branches

halves = st.integers(-9, 9).map(lambda k: 0.5 * k)


def typed(A, f):
    rows = zip(A, f, strict=True)
    return System(U=tuple(f"({row[0]!r})*c + ({row[1]!r})*s + ({value!r})" for row, value in rows))


@pytest.mark.parametrize("A", [[[1.0, -1.0], [-2.0, 2.0]], [[-1.0, -3.0], [-1.5, -4.5]], [[0.5, 3.5], [1.5, 10.5]]])
def test_no_critical_set_along_a_line_of_singular_systems(A):
    found = equilibrium_branches(ELinear.from_matrix(A, (0.3, 0.7)), psi.hill(3), "f1", (-3.0, 3.0))
    assert found.critical == ()
    assert not {s.kind for s in found.special} & {"transcritical", "Hopf", "det A = 0"}


@given(halves, st.sampled_from([0.5, -1.0, 2.0, -4.0]), st.integers(1, 40))
def test_trace_zero_is_a_centre_in_any_axes(p, q, det):
    r = -(p * p + det) / q  # exact
    for system in (ELinear.from_matrix([[p, q], [r, -p]]), typed([[p, q], [r, -p]], (0.0, 0.0))):
        (C,) = critical_sets(system, psi.tanh())
        assert C.kind == "centre (linear)"


@given(st.lists(halves, min_size=6, max_size=6), st.sampled_from([psi.constant(), psi.hill(3), psi.exponential()]))
def test_the_sweep_and_the_one_system_agree_in_place_kind_and_numbers(entries, family):
    A, f = np.array(entries[:4]).reshape(2, 2), np.array(entries[4:]) / 4.0
    system = ELinear.from_matrix(A, f)
    sets = critical_sets(system, family)
    path = linearisation_path(system, family, "f1", [f[0]])
    assert path.exists[0] == bool(sets)
    if sets:
        (C,) = sets
        assert path.kind[0] == C.kind
        assert path.trace[0] == pytest.approx(C.trace, rel=1e-11, abs=1e-13 * abs(C.jacobian).max())
        assert path.determinant[0] == pytest.approx(C.determinant, rel=1e-11)
