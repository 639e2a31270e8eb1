"""What is drawn means what was typed: the MathML of a formula's LaTeX is read back and evaluated."""

import html
import math
import re
from xml.etree import ElementTree

import pytest
from codim2_app.picture.draw.mathml import equations_mathml, mathml
from hypothesis import example, given
from hypothesis import strategies as st

import codim2_core as c2
from codim2_core.formulas.expression import parse
from codim2_core.formulas.functions import known
from codim2_core.formulas.latex import latex_formula

NAMES = ("c", "s", "mu", "z1", "K")
VALUES = {"c": 0.4, "s": -0.7, "mu": 1.3, "z1": 0.6, "K": 2.1}
SYMBOLS = {"c": "c", "s": "s", "μ": "mu", "z_1": "z1", "K": "K", "e": "math.e", "π": "math.pi"}
FUNCTIONS = ("sin", "cos", "tan", "log", "tanh", "sinh", "cosh", "atan")
OWN = {"min": min, "max": max, "ellipk": known["ellipk"].scalar}


def read(element):
    """The Python text that a reader of the formula would write down, from left to right."""
    if element.tag == "msub":
        return SYMBOLS[f"{element[0].text}_{element[1][0].text}"]
    inside = [read(child) for child in element]
    text = element.text or ""
    match element.tag:
        case "mn":
            return text
        case "mi":
            return SYMBOLS[text]
        case "mo":
            return f"math.{text}" if text in FUNCTIONS else {"−": "-", "⋅": "*"}.get(text, text)
        case "mspace":
            return "*"
        case "mfrac":
            return f"(({inside[0]})/({inside[1]}))"
        case "msup":
            return f"(({inside[0]})**({inside[1]}))"
        case "msqrt":
            return f"math.sqrt({''.join(inside)})"
        case "mrow" if len(inside) > 2 and inside[0] == inside[-1] == "|":
            return f"abs({''.join(inside[1:-1])})"
        case "msubsup":
            return f"(({SYMBOLS[f'{element[0].text}_{element[1][0].text}']})**({inside[2]}))"
        case _:
            return "".join(inside)


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("4/(3*pi)*c", "43πc"), ("c/pi", "cπ"), ("-2*c/(9*pi) + 1/pi", "1π"), ("c - 5*pi/6", "5π6"), ("-pi*c", "π"),
        ("c**(2*pi)", "2π"), ("9.42*c", "9.42"), ("3.14159*c", "3.14159"),
    ],
)  # fmt: skip
def test_a_multiple_of_pi_is_written_as_one_and_no_other_number_is(text, shown):
    formula = parse(text, NAMES)
    assert shown in re.sub("<[^>]*>|⋅", "", html.unescape(mathml(latex_formula(formula))))
    assert value(formula) == pytest.approx(formula.evaluate(VALUES), rel=1e-14)


def test_functions_of_two_and_those_of_the_list_are_written_as_calls():
    for text in ("max(c, s)*mu", "K - min(c**2, 1 - s, mu)", "ellipk(min(c, s)/K)/2"):
        formula = parse(text, NAMES)
        assert value(formula) == pytest.approx(formula.evaluate(VALUES))


def value(formula):
    text = read(ElementTree.fromstring(f"<math>{mathml(latex_formula(formula))}</math>"))
    # a sign binds as in Python, so that what is written side by side must not rely on anything else
    return eval(text, {"math": math, **OWN, **VALUES})


leaves = st.sampled_from([*NAMES, "2", "0.5", "3"])
formulas = st.recursive(
    leaves,
    lambda inner: st.one_of(
        st.tuples(inner, st.sampled_from("+-*/"), inner).map(lambda t: f"({t[0]}){t[1]}({t[2]})"),
        inner.map(lambda t: f"-({t})"),
        st.tuples(inner, st.sampled_from(["2", "3"])).map(lambda t: f"({t[0]})^{t[1]}"),
        st.tuples(st.sampled_from(["sin", "cos", "atan", "exp", "abs"]), inner).map(lambda t: f"{t[0]}({t[1]})"),
        inner.map(lambda t: f"sqrt(abs({t}))"),
    ),
    max_leaves=8,
)


@given(formulas)
@example("c-(-s*mu)")
@example("c*(-s*mu)")
@example("c-(-s/mu)*K")
@example("c-(-s)")
@example("-(-s*mu)")
@example("c-(-(-s*mu))")
@example("c-(-2*s)")
def test_no_sign_stands_behind_another(text):
    """A minus within a sum or a product has brackets, or is the sum's own."""
    try:
        formula = parse(text, NAMES)
    except ValueError:
        return
    assert not re.search(r"[-+*]-", read(ElementTree.fromstring(f"<math>{mathml(latex_formula(formula))}</math>")))


@given(formulas)
def test_the_drawn_formula_has_the_value_of_the_typed_one(text):
    try:
        formula = parse(text, NAMES)
    except ValueError:
        return  # a constant part such as 1/(2-2)
    expected = formula.evaluate(VALUES)
    if math.isfinite(expected) and abs(expected) < 1e8:
        assert value(formula) == pytest.approx(expected, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("example", c2.examples.catalogue.values(), ids=lambda e: e.key)
def test_the_equations_of_an_example_are_its_right_hand_sides(example):
    system = example.make()
    at = system.at(example.z)
    values = {"c": 0.6, "s": -0.8, "x": 0.0, "y": 0.0, "z": (*example.z, 0.0)[0], **dict(system.parameters)}
    values.update((f"z{i + 1}", v) for i, v in enumerate(example.z))
    values["t"] = (0.0, *example.z)[-1]  # the last of z, where formulas read it
    rates = [float(right.evaluate(values)) for _, right in system.equations]
    found = [*at.U((0.6, -0.8)), *at.W((0.6, -0.8))]
    assert rates == pytest.approx(found[: len(rates)], abs=1e-12)
    assert found[len(rates) :] in ([], [1.0])  # t' = 1 is not written
    ElementTree.fromstring(equations_mathml(system))


@pytest.mark.parametrize(
    "more",
    [{}, {"g": (0.25,)}, {"B": ((0.5, -2.0),)}, {"B": ((0.5, -2.0),), "g": ("z - 1",)}, {"B": ((0.5, 1.0),) * 2}],
    ids=repr,
)
@pytest.mark.parametrize("b", [0.3, "mu*z"])
def test_the_equations_of_an_e_linear_system_are_its_right_hand_sides(more, b):
    system = c2.ELinear(-1.0, b, "mu", (0.1, -0.2), parameters={"mu": 1.5}, **more)
    z = (0.7, -0.4)[: system.m] or (0.7,) * isinstance(b, str)
    at = system.at(z)
    values = {"c": 0.6, "s": -0.8, "mu": 1.5, "z": 0.7, "z1": 0.7, "z2": -0.4}
    rates = [float(right.evaluate(values)) for _, right in system.equations]
    assert rates == pytest.approx([*at.U((0.6, -0.8)), *at.W((0.6, -0.8))], abs=1e-12)
    assert [left for left, _ in system.equations] == ["x", "y", "z1", "z2"][: 2 + system.m]


def test_a_matrix_is_written_as_given():
    system = c2.ELinear.from_matrix([["k", 2.0], [0.0, -1.0]], (0.5, "z"), g=(1.0,), parameters={"k": -3.0})
    rows = dict(system.equations)
    assert rows["x"].evaluate({"c": 0.6, "s": 0.8, "k": -3.0}) == pytest.approx(-1.8 + 1.6 + 0.5)
    assert rows["y"].evaluate({"c": 0.6, "s": 0.8, "z": 0.25}) == pytest.approx(-0.8 + 0.25)
