import math

import pytest
from codim2_app.state import portraits as state_portraits
from codim2_app.state.chosen_psi import build_psi
from codim2_app.state.cleaning import InputError, clean
from codim2_app.state.controls import CONTROL_NAMES, NUMBERS, ExplorerState, preset_values
from codim2_app.state.portraits import portraits
from codim2_app.state.slider_range import slider_range

KEYS = [item["key"] for item in portraits()]


def test_defaults_are_the_papers_simCM4():
    values = ExplorerState().values()
    assert (values["a"], values["b"], values["d"], values["f1"], values["f2"]) == (-2, 0, -1, -0.5, 0)


def test_every_number_declares_symbol_range_and_meaning():
    for name in NUMBERS:
        declared = ExplorerState.param[name]
        low, high = declared.softbounds
        assert declared.label
        assert declared.doc
        assert low < declared.default < high


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf, "", "two", None, [1], "1e999"])
@pytest.mark.parametrize("name", NUMBERS)
def test_bad_numbers_name_their_control(name, bad):
    with pytest.raises(InputError, match="number") as caught:
        clean(name, bad)
    assert caught.value.control == name


def test_unknown_control_lists_the_known_ones():
    with pytest.raises(InputError, match="the controls are a, b, d"):
        clean("c", 1)


@pytest.mark.parametrize(("values", "control"), [
    ({"psi": "custom", "psi_text": "1/(1+"}, "psi_text"),
    ({"psi": "custom", "psi_text": "import os"}, "psi_text"),
    ({"psi": "hill", "n": -1.0}, "n"),
])  # fmt: skip
def test_bad_psi_is_blamed_on_its_control(values, control):
    with pytest.raises(InputError) as caught:
        build_psi({**ExplorerState().values(), **values})
    assert caught.value.control == control


@pytest.mark.parametrize(("name", "value"), [
    ("parameters", "[1]"), ("parameters", {"k": "x"}), ("parameters", {f"p{i}": 1.0 for i in range(40)}),
    ("parameters", "{" * 50_000), ("texts", {"U1": 3}), ("texts", {"U1": "c" * 5000}), ("texts", "{not json"),
])  # fmt: skip
def test_mappings_that_cannot_be_used_name_their_control(name, value):
    with pytest.raises(InputError):
        clean(name, value)


@pytest.mark.parametrize("key", KEYS)
def test_a_portrait_is_every_value(key):
    values = preset_values(key)
    assert set(values) == set(CONTROL_NAMES)
    assert {name: clean(name, value) for name, value in values.items()} == values


def test_no_portrait_that_there_is_not():
    with pytest.raises(InputError, match="case1-cm0"):
        clean("preset", "case1-cm1")
    assert preset_values("case1-cm1") == preset_values("") == {}


def test_what_is_taken_from_a_portrait_is_nobody_elses():
    preset_values("attracting-repelling")["layers"].append("separatrices")
    assert "separatrices" not in preset_values("attracting-repelling")["layers"]


@pytest.mark.parametrize("name", ["", "Q1", "Q12", "C", "C3", "L2", "T", "T@0.244,-1.366", "U2@-12,0", "S3@0.5,1"])
def test_an_object_is_pinned_by_its_name(name):
    assert clean("pinned", name) == name


@pytest.mark.parametrize(
    "bad",
    [
        "Q",
        "Q0",
        "L",
        "C01",
        "Q1,Q2",
        "q1",
        "Q1234",
        " C",
        "C@0,0",
        "T@",
        "T@1",
        "T@a,b",
        "T@1e9,0",
        "T@0.1234,0",
        3,
        None,
        ["C"],
    ],
)
def test_what_names_no_object_is_not_pinned(bad):
    with pytest.raises(InputError, match="give an object such as Q2") as caught:
        clean("pinned", bad)
    assert caught.value.control == "pinned"


@pytest.mark.parametrize("text", ["", "psi=hill&n=3", "f1=-0.25&texts=%7B%22U1%22%3A%22-c%22%7D&system=own"])
def test_a_second_portrait_has_values_of_its_own(text):
    assert clean("beside", text) == text


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("panel=solid", "'panel' cannot be its own"),
        ("beside=f1%3D1", "'beside' cannot be its own"),
        ("f1=far", "f₁: 'far' is not a number"),
        ("psi=mine", "Ψ: 'mine' given"),
        ("texts=" + "x" * 20_000, "at most 10000 characters"),
        (3, "as text"),
    ],
)
def test_what_a_second_portrait_cannot_have_is_told(text, said):
    with pytest.raises(InputError, match=said):
        clean("beside", text)


def test_ranges_of_sliders_are_read_from_a_link_and_from_a_mapping():
    ranges = {"f1": [0.0, 0.5], "own:mu": [-1.0, 1.0]}
    assert clean("ranges", ranges) == clean("ranges", '{"f1": [0, 0.5], "own:mu": [-1, 1]}') == ranges


@pytest.mark.parametrize(
    "given",
    ['{"x y": [0, 1]}', '{"f1": [1, 0]}', '{"f1": [0, 0]}', '{"f1": 3}', '{"f1": [0, 1, 2]}', '{"f1": [0, "far"]}', "q",
     '{"psi": [0, 1]}', {"f1": [-1e308, 1e308]}, {f"own:m{i}": [0, 1] for i in range(40)}, 3],
)  # fmt: skip
def test_a_range_that_is_none_is_told(given):
    with pytest.raises(InputError, match="Ranges: ") as caught:
        clean("ranges", given)
    assert caught.value.control == "ranges"


@pytest.mark.parametrize(
    ("low", "high", "value", "held"),
    [
        (-4, 4, -7, (-10, 10)), (0, 4, 7, (0, 10)), (-4, 4, 4, (-4, 4)),
        (2, 3, -5, (-10, 10)), (2, 3, 1, (0, 3)), (2, 3, 0, (0, 3)), (0, 0.01, 0.05, (0, 0.1)),
        (-10, -5, 3, (-10, 5)), (0, 1, -0.25, (-0.5, 1)), (0.5, 6, 0.1, (0, 6)),
    ],
)  # fmt: skip
def test_a_range_widens_to_hold_the_value_as_it_does_in_the_browser(low, high, value, held):
    """The browser's rule is `rangeFor` of ranges.js, with the same rows in controls/ranges.test.js."""
    least, greatest, step = slider_range(low, high, value)
    assert (least, greatest) == pytest.approx(held)
    assert least <= value <= greatest
    assert 1e-4 <= step / (greatest - least) <= 1e-3 * (1 + 1e-9)


def test_the_values_of_a_portrait_are_read_off_its_own_preset(monkeypatch):
    asked = []
    monkeypatch.setattr(
        state_portraits, "_values", lambda preset: asked.append(preset.name) or {"system": "normal form"}
    )
    assert state_portraits.portrait_values("case1-cm0") == {"system": "normal form"}
    assert asked == ["case1-cm0"]
