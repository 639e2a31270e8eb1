"""Formulas with kinks and jumps as smooth branches, each with the guards that end it."""

import math

import pytest

from codim2_core.formulas.expression import ExpressionError, parse
from codim2_core.formulas.switches import branch_at, has_switches

NAMES = ("t", "x", "c")


def _branch(text, t, rate=1.0, **others):
    values = {"t": t, "x": 0.0, "c": 0.3, **others}
    return branch_at([parse(text, NAMES)], ("t", "x"), values, {"t": rate, "x": 0.0})


@pytest.mark.parametrize(
    "text",
    [
        "max(0, t - 3)", "2*sign(sin(t))", "abs(max(t, 3) - 4)*sign(t - 3)", "mod(t, 2) + floor(1.7*t)",
        "(t > 3)*(t <= 5)", "min(t, 2, 4 - t)", "max(sign(t - 1), 0)*exp(t)", "abs(sin(3*t)) + |cos(t)|",
    ],
)  # fmt: skip
def test_a_branch_is_the_formula_as_long_as_its_guards_are_positive(text):
    formula = parse(text, NAMES)
    assert has_switches([formula], ("t",))
    for k in range(1, 97):
        t = 0.061803 * k
        branch = _branch(text, t)
        values = {"t": t}
        assert branch.rows[0].evaluate(values) == pytest.approx(formula.evaluate(values), abs=1e-14)
        assert all(guard.evaluate(values) > 0.0 for guard in branch.guards)
        assert not has_switches(branch.rows, ("t",))


def test_on_the_border_the_motion_decides():
    assert _branch("sign(t - 3)", 3.0).choices == (1,)
    assert _branch("sign(t - 3)", 3.0, rate=-1.0).choices == (-1,)
    assert _branch("sign(sin(t))", math.pi).choices == (-1,)
    assert _branch("floor(t)", 2.0).choices == (2,)
    assert _branch("floor(t)", 2.0, rate=-1.0).choices == (1,)


def test_jumps_and_kinks_are_distinguished():
    assert _branch("sign(t)*max(0, t - 1)", 0.5).jumps == (True, False)


def test_a_kink_in_e_is_no_switch():
    branch = _branch("abs(c) + max(0, x - 1)", 0.0)
    assert branch.choices == (-1,) or branch.choices == (1,)
    assert branch.rows[0].text == "abs(c)"


@pytest.mark.parametrize(
    ("text", "mend"), [("0 < t < 1", r"\(0 < t\)\*\(t < 1\)"), ("mod(t)", "mod"), ("mod(t, 1, 2)", "mod")]
)
def test_what_cannot_be_compared_is_refused(text, mend):
    with pytest.raises(ExpressionError, match=mend):
        parse(text, NAMES)
