"""A kind of special value is a row of `special_kinds`: added there, diagrams, tables and the page have it."""

import math

import numpy as np
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
STAR = special_kinds.SpecialKind(
    "equal rates",
    lambda rho, theta: rho - theta,
    lambda rho, theta: rho * theta > 0.0,
    "λ_ρ = λ_θ: orbits come to this limit direction from all sides alike.",
    "λ_ρ = λ_θ",
    "thm:geneps0",
    of="limit direction",
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


NODES = c2.ELinear(-2.0, 0.1, -1.0, (-0.3, 0.1))
TYPED_NODES = c2.System(U=("-2*c - 0.1*s - 0.3", "0.1*c + d*s + 0.1 + k*c*s"), W=(), parameters={"d": -1.0, "k": 0.0})


@pytest.mark.parametrize("system", [NODES, TYPED_NODES], ids=["e-linear", "typed"])
@pytest.mark.parametrize("row", [STAR], indirect=True)
def test_a_row_of_limit_directions_is_found(row, system):
    special = c2.branches(system, c2.psi.tanh(), "d", (-1.5, -0.5), with_cycles=False).special
    found = [one for one in special if one.kind == row.kind]
    assert len(found) == 2  # of the two nodes among four limit directions
    for one in found:
        (c, s), step = one.place, 1e-6

        def U(c, s, d=one.value):
            return np.array([-2.0 * c - 0.1 * s - 0.3, 0.1 * c + d * s + 0.1])

        def turning(t, U=U):
            return np.array([-math.sin(t), math.cos(t)]) @ U(math.cos(t), math.sin(t))

        theta = math.atan2(s, c)
        slope = (turning(theta + step) - turning(theta - step)) / (2.0 * step)
        assert abs(turning(theta)) < 1e-9
        assert np.array([c, s]) @ U(c, s) == pytest.approx(slope, abs=1e-8)
