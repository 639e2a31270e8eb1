"""Special values of general systems by secants of what goes through zero there: in few looks, and where they are."""

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.diagrams.standing import standing
from codim2_core.diagrams.typed import rounding
from codim2_core.diagrams.typed.narrowing import narrowed
from codim2_core.diagrams.typed.rounding import States

NUMBERS = {"a": 172.0, "b": 186.0, "d": -200.0, "f1": -86.0, "f2": -93.0}
TWIN = c2.System(U=("a*c - b*s + f1", "b*c + d*s + f2"), parameters=NUMBERS)
EXACT = c2.ELinear(172.0, 186.0, -200.0, (-86.0, -93.0))
PSI = c2.psi.hill(3.0)
#: By what it goes through zero: the trace, the discriminant, lambda_rho; and what comes from two that meet.
KINDS = {"Hopf", "node-focus", "transcritical", "saddle-node"}


def test_special_values_take_few_states(monkeypatch):
    """280 states for eight special values; by bisection alone it took 462."""
    made, real = [], rounding.State
    monkeypatch.setattr(rounding, "State", lambda *given: made.append(given) or real(*given))
    found = standing(TWIN, PSI, "a", (150.0, 190.0)).special
    assert len(made) < 320
    exact = [one for one in standing(EXACT, PSI, "a", (150.0, 190.0)).special if one.kind != "det A = 0"]
    assert [one.kind for one in found] == [one.kind for one in exact]
    assert {one.kind for one in found} == KINDS
    np.testing.assert_allclose([s.value for s in found], [s.value for s in exact], rtol=0.0, atol=1e-10 * 40.0)


@pytest.mark.parametrize(("low", "high", "part"), [(171.0, 172.03, 1), (172.1, 172.3, 1), (173.0, 175.0, 0)])
def test_a_change_is_enclosed_on_both_sides(low, high, part):
    states = States(TWIN, PSI, "a", (150.0, 190.0), ())
    left, right = states(low), states(high)
    assert left.part(part) != right.part(part)
    value = narrowed(states, left, right, part, 1e-9)
    assert states(value - 1e-9).part(part) == left.part(part)
    assert states(value + 1e-9).part(part) != left.part(part)


def test_where_the_secants_lead_nowhere_it_is_bisected(monkeypatch):
    states = States(TWIN, PSI, "a", (150.0, 190.0), ())
    expected = narrowed(states, states(171.0), states(172.03), 1, 1e-9)
    for other in (None, lambda _: np.nan, lambda _: 1.0, lambda state: 1.0 + state.value):
        monkeypatch.setattr("codim2_core.diagrams.typed.narrowing._measure", lambda *_, other=other: other)
        assert narrowed(states, states(171.0), states(172.03), 1, 1e-9) == pytest.approx(expected, abs=2e-9)
