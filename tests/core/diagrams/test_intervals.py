"""Between two marked values of a diagram nothing changes: held against the exact functions at single values."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.diagrams.diagram import diagram
from codim2_core.layer_problem.vary import varied

PARTS = np.array([1e-4, 1e-2, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 0.9999])


def standing(system, psi, name, value):
    """How many limit directions, how many of them attract radially, and the kinds of the critical sets."""
    at, psi_at, z = varied(system, psi, (), name, value)
    equator = c2.equator_equilibria(at, z)
    kinds = sorted(C.kind for C in c2.critical_sets(at, psi_at, z))
    return len(equator), int((equator.lambda_rho < 0.0).sum()), tuple(kinds)


def hidden(system, psi, name, span, closest):
    """Intervals between marked values on which something changes; `closest`: to a marked value, of the span."""
    marked = [s.value for s in diagram(system, psi, name, span).special]
    beside = closest * (span[1] - span[0])
    out = []
    for low, high in pairwise([span[0], *sorted(set(marked)), span[1]]):
        x = low + (high - low) * PARTS
        x = x[(x > low + beside) & (x < high - beside)]
        if len({standing(system, psi, name, float(v)) for v in x}) > 1:
            out.append((low, high))
    return out


@pytest.mark.parametrize("seed", range(4))
def test_e_linear_systems(seed):
    rng = np.random.default_rng(seed)
    families = [c2.psi.constant(), c2.psi.rational(), c2.psi.exponential(), c2.psi.tanh(), None]
    for k in range(60):
        a, b, d, f1, f2 = rng.uniform(-2.0, 2.0, 5).tolist()
        size = 0.3 if k % 3 == 0 else 1.0
        psi = families[rng.integers(5)] or c2.psi.hill(int(rng.integers(1, 9)))
        name = ("a", "b", "d", "f1", "f2")[rng.integers(5)]
        span = (-3.0, 3.0)
        if psi.family == "hill" and k % 2:
            name, span = "n", (1.0, 9.0)
        assert hidden(c2.ELinear(a, b, d, (size * f1, size * f2)), psi, name, span, 4e-8) == []


@pytest.mark.parametrize("seed", range(4))
def test_general_systems(seed):
    rng = np.random.default_rng(seed)
    for _ in range(12):
        rows = rng.uniform(-2.0, 2.0, (2, int(rng.integers(3, 8)))).round(3).tolist()
        monomials = ("1", "c", "s", "c**2", "c*s", "s**2", "c**3")
        U = ["+".join(f"({v!r})*{m}" for v, m in zip(row, monomials, strict=False)) for row in rows]
        system = c2.System(U=(f"{U[0]} + p", f"{U[1]} - 0.5*p*c"), parameters={"p": 0.0})
        psi = (c2.psi.constant(), c2.psi.tanh(), c2.psi.hill(3))[rng.integers(3)]
        assert hidden(system, psi, "p", (-1.5, 1.5), 2e-7) == []


@pytest.mark.parametrize("span", [(-3.0, 3.0), (-1.6, -1.35)])
def test_all_that_happens_close_to_where_the_critical_set_reaches_the_equator(span):
    """A Hopf and a node-focus point 7e-4 and 9e-5 before it, in the last step of the samples of a branch."""
    f = (-0.528402726408638, -0.4461231082055761)
    system = c2.ELinear(-1.7358329509185673, -1.6547962306324093, 1.1149965797797612, f)
    found = {(s.kind, round(s.value, 6)) for s in diagram(system, c2.psi.rational(), "b", span).special}
    assert {("Hopf", -1.409604), ("node-focus", -1.408953), ("transcritical", -1.408867)} <= found


def test_two_folds_at_one_value_are_both_told():
    system = c2.System(U=("p+c-c**2", "s**2-0.04"), parameters={"p": 0.0})
    folds = [s for s in diagram(system, c2.psi.tanh(), "p", (-0.5, 0.2)).special if s.kind == "fold of critical sets"]
    assert [s.value for s in folds] == pytest.approx([-0.25, -0.25], abs=1e-9)
    heights = sorted(s.place[1] for s in folds)
    assert heights[0] == pytest.approx(-heights[1], abs=1e-3)


def test_two_saddle_nodes_that_undo_each_other_within_a_step():
    """Six limit directions for p from -1.428 to -1.409 only, and four on both sides."""
    U = (
        "1.641 + 0.246*c + 0.313*s - 1.223*c**2 + 0.104*c*s + 0.094*s**2 + p",
        "-1.644 + 1.928*c + 0.286*s - 1.974*c**2 + 1.091*c*s + 1.913*s**2",
    )
    special = diagram(c2.System(U=U, parameters={"p": 0.0}), c2.psi.tanh(), "p", (-1.5, 1.5)).special
    nodes = [s.value for s in special if s.kind == "saddle-node"]
    assert nodes[:2] == pytest.approx([-1.4280734, -1.4087529], abs=1e-6)
