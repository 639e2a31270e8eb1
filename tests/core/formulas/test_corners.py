"""Formulas with kinks: values at a corner, and slopes that are the mean of the two sides or none."""

import math
import re

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from codim2_core.formulas.arrays import program
from codim2_core.formulas.expression import Expression, parse
from codim2_core.formulas.tape import compact
from tests.core.formulas.exact import with_mpmath

NAMES = ("x", "y")


def test_on_a_kink_the_slope_is_the_mean_of_the_two_sides():
    for text, slope in (("abs(x)", 0.0), ("min(x, 3*x)", 2.0), ("max(x, -x, 3*x)", 1.5), ("abs(x) + x", 1.0)):
        assert parse(text, ("x",)).derivative("x").evaluate({"x": 0.0}) == slope


# Slopes at the places where a rule of calculus meets 0 times infinity: (formula, x, y, derivative by x)
CORNERS = [
    ("x**y", 0.0, 0.0, 0.0),
    ("x**y", -0.7, 0.0, 0.0),
    ("x**y", 0.0, 1.0, 1.0),
    ("x**y", -0.5, 3.0, 0.75),
    ("y**x", 0.0, 0.0, -math.inf),  # 0^x jumps at 0: 1 there, 0 beyond
    ("abs(x)**(2 + x)", 0.0, 0.0, 0.0),
    ("abs(x)**y", 0.0, 0.5, 0.0),
    ("sqrt(x**2 + y**2)", 0.0, 0.0, 0.0),
    ("sqrt(x**2 + y**2)", 0.3, 0.4, 0.6),
    ("sqrt(x)", 0.0, 0.0, math.inf),
    ("x*sqrt(x)", 0.0, 0.0, 0.0),
    ("(x + x**2)*(1 + sqrt(x))", 0.0, 0.0, 1.0),
    ("x*sqrt(x**2 + y**2)", 0.0, 0.0, 0.0),
    ("(x**2 + y**2)**0.5", 0.0, 0.0, 0.0),
    ("x**x", 0.0, 0.0, -math.inf),
    ("(x**2)**(x**2)", 0.0, 0.0, 0.0),
    ("x**0.5*y", 0.0, 0.0, 0.0),
    ("max(sqrt(x), 1)", 0.0, 0.0, 0.0),
    ("min(1 + sqrt(x), 0.5 + x)", 0.0, 0.0, 1.0),
    ("sqrt(x**4 + y**2)", 0.0, 0.0, 0.0),
]


@pytest.mark.parametrize(("text", "x", "y", "slope"), CORNERS)
def test_a_slope_at_a_corner_in_all_its_forms(text, x, y, slope):
    expression = parse(text, NAMES)
    derivative = expression.derivative("x")
    assert derivative.evaluate({"x": x, "y": y}) == pytest.approx(slope, rel=1e-15, abs=0)
    assert derivative.evaluate({"x": np.array([x]), "y": y}).tolist() == pytest.approx([slope], rel=1e-15, abs=0)
    plane = parse(re.sub(r"\by\b", "s", re.sub(r"\bx\b", "c", text)), ("c", "s"))
    assert program(((plane,), ())).evaluate(np.array([[x, y]]))[0, 0, 1] == pytest.approx(slope, rel=1e-15, abs=0)


_BASES = st.sampled_from(
    ["x", "abs(x)", "x**2", "x**2 + y**2", "x*y", "(1 + x)", "max(x, y)", "abs(x - y)", "x**2*y**2"]
)


def on_kinks(expression, x, y):
    """Entries of the tape that are on a kink, or at the root of 0, at a point."""
    parts = [Expression(compact(list(expression.tape), k)) for k in range(len(expression.tape))]
    values = [part.evaluate({"x": x, "y": y}) for part in parts]
    found = []
    for k, (op, *args) in enumerate(expression.tape):
        rooted = op in ("abs", "sqrt", "**") and values[args[0]] == 0.0
        if rooted or (op in ("min", "max") and values[args[0]] == values[args[1]]):
            found.append(k)
    return found


def _rough(children):
    return st.one_of(
        st.builds("({}{}{})".format, children, st.sampled_from(["+", "-", "*"]), children),
        st.builds(
            "({})**{}".format, children, st.sampled_from(["y", "0.5", "1.5", "2", "0", "(1 + y)", "abs(x)", "1"])
        ),
        st.builds("sqrt({})".format, children),
        st.builds("{}({})".format, st.sampled_from(["exp", "sin", "abs", "tanh"]), children),
        st.builds("{}({}, {})".format, st.sampled_from(["min", "max"]), children, children),
    )


ROUGH = st.recursive(_BASES, _rough, max_leaves=4)
ROUND = st.sampled_from([0.0, 1.0, -1.0, 0.5, 2.0, -0.0])


@given(ROUGH, ROUND, ROUND)
@settings(max_examples=20, deadline=None)
def test_derivatives_at_corners_are_the_mean_of_the_sides_or_told_to_be_none(text, x, y):
    """Held against differences in 60 digits; where the slopes nearby do not settle, infinite or NaN is right too."""
    expression = parse(text, NAMES)
    value = expression.evaluate({"x": x, "y": y})
    if not math.isfinite(value):
        return
    derivative = expression.derivative("x").evaluate({"x": x, "y": y})
    with mpmath.workdps(80):

        def sides(h):
            at = [with_mpmath(expression, mpmath.mpf(x) + k * h, mpmath.mpf(y)) for k in (-1, 0, 1)]
            return [mpmath.mpf(0) if at[1] == at[0] else (at[1] - at[0]) / h, (at[2] - at[1]) / h]

        try:
            near, nearer = sides(mpmath.mpf(10) ** -16), sides(mpmath.mpf(10) ** -24)
        except (TypeError, ValueError, ZeroDivisionError):
            return  # complex beside: the border of where the formula is defined
        if any(isinstance(q, mpmath.mpc) and q.imag for q in (*near, *nearer)):
            return
        near, nearer = [float(mpmath.re(q)) for q in near], [float(mpmath.re(q)) for q in nearer]
    kinks = on_kinks(expression, x, y)
    if math.isnan(derivative):
        assert any(expression.tape[k][0] in ("sqrt", "**") for k in kinks)  # infinite slopes meet
        return
    if len(kinks) > 1:  # min(x, abs(x)) is x near 0, and the rules of calculus mean each kink by itself
        return
    settled = all(abs(p - q) <= 1e-5 * (1.0 + abs(p)) for p, q in zip(near, nearer, strict=True))
    smooth = settled and abs(nearer[0] - nearer[1]) <= 1e-5 * (1.0 + abs(nearer[0]))
    if smooth:
        assert derivative == pytest.approx(nearer[0], rel=1e-4, abs=1e-4)
    elif settled:
        low, high = sorted(nearer)
        assert low - 1e-4 <= derivative <= high + 1e-4  # a kink: between the slopes of its sides
