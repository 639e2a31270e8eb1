"""From a choice and some text to a system and its controls."""

import numpy as np
import pytest
from codim2_app.picture.state.chosen_system import (
    BOXES,
    OWN_SYSTEM,
    STARTERS,
    TYPED,
    TextError,
    build,
    describe,
    starting_z,
    texts_of,
    titles,
)

import codim2_core as c2
from codim2_core import examples


@pytest.mark.parametrize("choice", [key for key in titles() if key != "normal"])
def test_every_choice_opens_with_a_picture_and_a_control_for_each_of_its_names(choice):
    system = build(choice, {}, {})
    z = starting_z(choice) or (0.0,) * system.m
    assert len(z) == system.m
    assert np.isfinite(system.at(z).U((0.6, 0.8))).all()
    told = describe(choice, system)
    assert [p["name"] for p in told["parameters"]] == [*system.parameters]
    assert len(told["slow"]) == system.m
    assert told["equations"].startswith("<math")


@pytest.mark.parametrize("title", [*STARTERS])
def test_a_system_of_ones_own_begins_with_friction_or_another_example(title):
    system = build(OWN_SYSTEM, STARTERS[title], {})
    made = np.array([system.at((0.3,) * system.m).U(e) for e in ((1.0, 0.0), (-1.0, 0.0), (0.0, 1.0))])
    assert np.isfinite(made).all()
    assert made[2][1] < 0.0  # it opposes the slip
    first = build(OWN_SYSTEM, {}, {})
    assert (first.m, dict(first.parameters)) == (0, {"mu": 1.0, "f": 0.5})
    assert dict(build(OWN_SYSTEM, {"U1": "-2*c"}, {}).parameters) == {"mu": 1.0}  # what is no longer read is no fault


def test_a_name_that_is_typed_becomes_a_parameter():
    system = build(
        OWN_SYSTEM, {"U1": "k2*c - amp*sin(z)", "U2": "-s", "W": "0", "where": ""}, {"amp": 0.5, "gone": 3.0}
    )
    assert dict(system.parameters) == {"k2": 1.0, "amp": 0.5}
    assert describe(OWN_SYSTEM, system)["parameters"][1]["symbol"] == "amp"


def test_definitions_may_be_used_and_their_names_become_parameters_too():
    system = build(OWN_SYSTEM, {"U1": "-c*q(z)", "where": "q(z) = 1 + w*z^2"}, {"w": 2.0, "mu": 0.5})
    assert system.at((3.0,)).U((1.0, 1.0)).tolist() == [-19.0, -0.5]


def test_typed_coefficients_make_an_e_linear_system():
    system = build(TYPED, {"a": "-2 - q", "f2": "z^2"}, {"q": 1.0})
    assert isinstance(system, c2.ELinear)
    assert system.at((0.5,)).plane == (-3.0, 0.0, -1.0, -0.25, 0.25)


def test_an_example_takes_its_parameters_by_name():
    assert build("ball_in_pool", {}, {"mu": 0.5, "k": 7.0}) == examples.ball_in_pool(mu=0.5)


@pytest.mark.parametrize(
    ("choice", "texts", "box", "column"),
    [
        (OWN_SYSTEM, {"U1": "c +* s"}, "U1", 4),
        (OWN_SYSTEM, {"U2": "c.real"}, "U2", 2),
        (OWN_SYSTEM, {"W": "-z\nz2*("}, "W", 5),
        (OWN_SYSTEM, {"where": "chi(z) = 1/(2 - 2)"}, "where", 2),
        (OWN_SYSTEM, {"U1": "(" * 5000}, "U1", 1000),
        (TYPED, {"f1": "z**"}, "f1", 4),
        (TYPED, {"d": "__import__('os')"}, "d", 12),
    ],
)
def test_text_that_cannot_be_used_names_its_box_and_column(choice, texts, box, column):
    with pytest.raises(TextError) as caught:
        build(choice, texts, {})
    assert caught.value.box == box
    assert caught.value.column == column


@pytest.mark.parametrize(
    ("choice", "box", "text", "said"),
    [
        (OWN_SYSTEM, "U2", "-s + U1*c", "is the name of a box"), (TYPED, "d", "-1 - a", "is the name of a box"),
        (OWN_SYSTEM, "U1", "-c*psi(s)", "no regularisation"), (TYPED, "d", "-1 - t", "is the time"),
    ],
)  # fmt: skip
def test_a_name_with_another_meaning_gets_no_slider(choice, box, text, said):
    with pytest.raises(TextError, match=said) as caught:
        build(choice, {box: text}, {})
    assert caught.value.box == box
    assert text[caught.value.column - 1].lower() in "uwapet"


def test_time_in_equations_of_ones_own_is_a_slow_variable_of_that_name():
    texts = {"U1": "-c + F*cos(w*t)", "U2": "-s*z", "W": "x"}
    system = build(OWN_SYSTEM, texts, {})
    assert [*system.parameters] == ["F", "w"]
    told = describe(OWN_SYSTEM, system, texts)
    assert [one["symbol"] for one in told["slow"]] == ["z", "t"]
    assert "<mi>t</mi>" in told["equations"]
    assert told["equations"].count("<mover") == 3  # x, y and z: t has no row
    with pytest.raises(TextError, match="t, and with it at most 4"):
        build(OWN_SYSTEM, {"U1": "-c + t", "U2": "-s", "W": "1\n1\n1\n1"}, {})


def test_boxes_that_were_not_touched_keep_their_text():
    assert texts_of(OWN_SYSTEM, {"U2": "-s"})["U1"] == BOXES[OWN_SYSTEM][0].text
    assert texts_of("normal", {}) == {}


@pytest.mark.parametrize("text", ["theta", "-sin(theta)", "Theta*c"])
def test_theta_is_no_slider_but_says_write_c(text):
    with pytest.raises(TextError, match="rite c for cos"):
        build(OWN_SYSTEM, {"U1": text}, {})


@pytest.mark.parametrize("choice", [OWN_SYSTEM, TYPED])
@pytest.mark.parametrize("line", ["mu = 0.3 in [0, 1]", "  mu=.3  in [ 0 ; 1e0 ] ", "mu = 3e-1 in [0,1]"])
def test_a_line_gives_a_parameter_its_value_and_the_range_of_its_slider(choice, line):
    texts = {"U1": "-mu*c", "W": "0", "where": line, "U2": "-s", "a": "-mu"}
    system = build(choice, texts, {})
    assert dict(system.parameters)["mu"] == 0.3
    [told] = [p for p in describe(choice, system, texts)["parameters"] if p["name"] == "mu"]
    assert (told["value"], told["range"]) == (0.3, [0.0, 1.0])
    assert dict(build(choice, texts, {"mu": 0.75}).parameters)["mu"] == 0.75  # its slider was moved


def test_a_range_may_be_negative_and_stands_next_to_definitions():
    texts = {"U1": "-q(z)*c", "U2": "-s", "W": "0", "where": "w = −0.5 in [−2, 0]\nq(z) = 1 + w*z^2"}
    system = build(OWN_SYSTEM, texts, {})
    assert system.parameters == {"w": -0.5}
    assert system.at((2.0,)).U((1.0, 0.0)).tolist() == [1.0, 0.0]
    assert describe(OWN_SYSTEM, system, texts)["parameters"][0]["range"] == [-2.0, 0.0]
