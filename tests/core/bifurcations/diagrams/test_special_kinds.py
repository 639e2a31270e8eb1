"""A kind of special value is a row of `special_kinds`: added there, diagrams, tables and the page have it."""

import pytest
from codim2_app.panels.parameters.diagram import branch_columns

import codim2_core as c2
from codim2_core.results import special_kinds

NEUTRAL_SADDLE = special_kinds.SpecialKind(
    "neutral saddle",
    lambda trace, _: trace,
    lambda _, determinant: determinant < 0.0,
    "tr J = 0 > det J: a loop of this saddle would be neutral.",
    "tr J = 0 > det J",
    "eq:scjaco",
)
PLANE = c2.ELinear(1.0, 0.5, -2.0, (0.1, 0.2))
TYPED = c2.System(U=("a*c - 0.5*s + 0.1", "0.5*c - 2*s + 0.2 + k*c*s"), W=(), parameters={"a": 1.0, "k": 0.0})


@pytest.fixture
def row(request):
    special_kinds.SPECIAL_KINDS.append(request.param)
    yield request.param
    special_kinds.SPECIAL_KINDS.remove(request.param)


@pytest.mark.parametrize("system", [PLANE, TYPED], ids=["e-linear", "typed"])
@pytest.mark.parametrize("row", [NEUTRAL_SADDLE], indirect=True)
def test_a_row_added_is_found_and_labelled(row, system):
    found = c2.branches(system, c2.psi.tanh(), "a", (1.0, 4.0), with_cycles=False)
    (special,) = (one for one in found.special if one.kind == row.kind)
    assert (special.label, special.sentence) == (row.label, row.says)
    (shown,) = (one for one in branch_columns(found)["special"] if one["kind"] == row.kind)
    assert (shown["value"], shown["sentence"]) == (pytest.approx(special.value), row.says)
    (C,) = c2.critical_sets(PLANE.evolve(a=special.value), c2.psi.tanh())
    assert abs(C.trace) < 1e-9
