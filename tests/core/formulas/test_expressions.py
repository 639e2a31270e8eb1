"""Typed text: values and derivatives."""

import math
import pickle

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from codim2_core.formulas.expression import parse
from tests.core.formulas.exact import with_mpmath

NAMES = ("x", "y")
LEAVES = st.sampled_from(["x", "y", "2", "0.5", "pi", "3.25e-1", "1."])
SAFE_FUNCTIONS = ["sin", "cos", "tanh", "atan", "abs", "exp", "sinh", "cosh", "tan"]


def _grow(children):
    return st.one_of(
        st.builds("({}{}{})".format, children, st.sampled_from(["+", "-", "*"]), children),
        st.builds("{}/(2+({})**2)".format, children, children),
        st.builds("-{}".format, children.filter(lambda t: not t.startswith("-"))),
        st.builds("({})^{}".format, children, st.sampled_from(["2", "3"])),
        st.builds("{}(sin({}))".format, st.sampled_from(SAFE_FUNCTIONS), children),
        st.builds("log(2+cos({}))".format, children),
        st.builds("sqrt(1+({})**2)".format, children),
    )


FORMULAS = st.recursive(LEAVES, _grow, max_leaves=8)
NUMBERS = st.floats(-3.0, 3.0)


@given(FORMULAS, NUMBERS, NUMBERS)
@settings(max_examples=20, deadline=None)
def test_value_source_and_arrays_agree_with_50_digits(text, x, y):
    expression = parse(text, NAMES)
    value = expression.evaluate({"x": x, "y": y})
    assert isinstance(value, float)
    with mpmath.workdps(50):
        exact = with_mpmath(expression, mpmath.mpf(x), mpmath.mpf(y))
        size = max(1.0, abs(float(exact)))
    assert value == pytest.approx(float(exact), rel=1e-9, abs=1e-9 * size)
    array = expression.evaluate({"x": np.array([x, x]), "y": y})
    assert array.shape == (2,)
    assert array == pytest.approx(value, rel=1e-12, abs=1e-9)


@given(FORMULAS, NUMBERS, NUMBERS)
@settings(max_examples=20, deadline=None)
def test_derivative_agrees_with_50_digit_differences(text, x, y):
    expression = parse(text, NAMES)
    derivative = expression.derivative("x").evaluate({"x": x, "y": y})
    with mpmath.workdps(60):
        h = mpmath.mpf(10) ** -20
        above = with_mpmath(expression, mpmath.mpf(x) + h, mpmath.mpf(y))
        below = with_mpmath(expression, mpmath.mpf(x) - h, mpmath.mpf(y))
        quotient, middle = (above - below) / (2 * h), with_mpmath(expression, mpmath.mpf(x), mpmath.mpf(y))
        kink = abs(above - 2 * middle + below) > h * mpmath.mpf(10) ** -9
    if kink or math.isnan(derivative):  # at the corner of abs
        assert "abs" in text
        return
    assert derivative == pytest.approx(float(quotient), rel=1e-7, abs=1e-7)


@given(FORMULAS)
@settings(max_examples=20, deadline=None)
def test_text_reads_back_equal(text):
    expression = parse(text, NAMES)
    for one in (expression, expression.derivative("x")):
        again = parse(one.text, NAMES) if len(one.text) < 1000 else one
        assert again.text == one.text
    again = parse(expression.text, NAMES)
    assert again == expression
    assert hash(again) == hash(expression)
    assert pickle.loads(pickle.dumps(expression)) == expression
    assert set(expression.names) <= set(NAMES)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("-x**2", -9.0), ("2**-x", 0.125), ("2^3^2", 512.0), ("2*-x", -6.0), ("--x", 3.0), ("6/2/x", 1.0),
        ("1-x-x", -5.0), (" 1 +\t2 * x\n", 7.0), (".5*x", 1.5), ("e**x", math.e**3), ("abs(-x)+atan(0)", 3.0),
        ("x**0", 1.0),
    ],
)  # fmt: skip
def test_precedence(text, value):
    assert parse(text, ("x",)).evaluate({"x": 3.0}) == pytest.approx(value, rel=1e-15)


def test_poles_are_ieee_and_silent():
    assert parse("1/x", NAMES).evaluate({"x": 0.0}) == math.inf
    assert math.isnan(parse("log(x)", NAMES).evaluate({"x": -1.0}))
    assert parse("exp(x)", NAMES).evaluate({"x": 1e4}) == math.inf
    assert math.isnan(parse("x**0.5", NAMES).evaluate({"x": -1.0}))  # never complex
    values = parse("1/x+log(x)+exp(1e3*x)", NAMES).evaluate({"x": np.array([0.0, -1.0, 5.0])})
    assert not np.isfinite(values).any()
