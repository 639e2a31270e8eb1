"""A kind of special value is a row of `special_kinds`: added there, diagrams, atlases, tables and the page have it."""

import numpy as np
import pytest
from codim2_app.panels.parameters.atlas_columns import atlas_columns
from codim2_app.panels.parameters.diagram import branch_columns

import codim2_core as c2
from codim2_core.bifurcations.atlases.atlas import curves_over
from codim2_core.results import special_kinds

NEUTRAL_SADDLE = special_kinds.SpecialKind(
    "neutral saddle",
    0.0,
    "tr J = 0 > det J: a loop of this saddle would be neutral.",
    "tr J = 0 > det J",
    "eq:scjaco",
    sign=-1,
)
DAMPED = special_kinds.SpecialKind("half damped", 1.0, "tr(J)² = det J.", "tr(J)² = det J", "eq:scjaco")
PLANE = c2.ELinear(1.0, 0.5, -2.0, (0.1, 0.2))
TYPED = c2.System(U=("a*c - 0.5*s + 0.1", "0.5*c - 2*s + 0.2 + k*c*s"), W=(), parameters={"a": 1.0, "k": 0.0})
TURNING = c2.ELinear(1.0, 2.5, -2.0, (0.1, 0.2))
OTHER = c2.System(U=("a*c - 2.5*s + 0.1", "2.5*c - 2*s + 0.2 + k*c*s"), W=(), parameters={"a": 1.0, "k": 0.0})
EITHER = pytest.mark.parametrize(
    ("system", "row"),
    [(PLANE, NEUTRAL_SADDLE), (TYPED, NEUTRAL_SADDLE), (TURNING, DAMPED), (OTHER, DAMPED)],
    ids=["neutral, e-linear", "neutral, typed", "damped, e-linear", "damped, typed"],
    indirect=["row"],
)


@pytest.fixture
def row(request):
    special_kinds.SPECIAL_KINDS.append(request.param)
    yield request.param
    special_kinds.SPECIAL_KINDS.remove(request.param)


def off_the_row(row, system):
    """Return the least |function| of a row, in units of J, over the critical sets of its sign of det J."""
    sets = [C for C in c2.critical_sets(system, c2.psi.tanh()) if row.sign * C.determinant > 0.0]
    return min(abs(row.function(C.trace, C.determinant)) / (C.trace**2 + abs(C.determinant)) for C in sets)


@EITHER
def test_a_row_added_is_found_along_a_parameter(row, system):
    found = c2.branches(system, c2.psi.tanh(), "a", (1.0, 4.0), with_cycles=False)
    special = [one for one in found.special if one.kind == row.kind]
    assert special
    shown = [one for one in branch_columns(found)["special"] if one["kind"] == row.kind]
    for one, other in zip(special, shown, strict=True):
        assert (one.label, one.sentence) == (row.label, row.says)
        assert (other["value"], other["sentence"]) == (pytest.approx(one.value), row.says)
        assert off_the_row(row, system.evolve(a=one.value)) < 1e-9


@EITHER
def test_a_row_added_is_followed_over_two_parameters(row, system):
    up = "d" if system in (PLANE, TURNING) else "k"
    found = curves_over(system, c2.psi.tanh(), "a", up, ((1.0, 4.0), (-3.0, 1.0)))
    curves = [one for one in found.curves if one.kind == row.kind]
    assert curves
    places, points = (np.concatenate([getattr(one, name) for one in curves]) for name in ("places", "points"))
    for a, other in points[np.hypot(*places.T) < 1.0 - 1e-6][::7]:  # on the equator there is no critical set
        assert off_the_row(row, system.evolve(**{"a": a, up: other})) < 1e-7
    header, _ = atlas_columns(found, ("a", up))
    assert row.kind in header["curve"]
