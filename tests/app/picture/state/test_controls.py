import math

import pytest
from codim2_app.picture.state.cleaning import InputError, clean
from codim2_app.picture.state.controls import CONTROL_NAMES, NUMBERS, ExplorerState, preset_values
from codim2_app.picture.state.portraits import portraits
from codim2_app.picture.state.slider_range import slider_range

KEYS = [item["key"] for item in portraits()]


def test_defaults_are_the_papers_simCM4():
    values = ExplorerState().values()
    assert (values["a"], values["b"], values["d"], values["f1"], values["f2"]) == (-2, 0, -1, -0.5, 0)


@pytest.mark.parametrize("bad", [math.nan, -math.inf, "", "two", None, [1], "1e999"])
@pytest.mark.parametrize("name", NUMBERS)
def test_bad_numbers_name_their_control(name, bad):
    with pytest.raises(InputError, match="number") as caught:
        clean(name, bad)
    assert caught.value.control == name


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
    ["Q", "Q0", "L", "C01", "Q1,Q2", "q1", "Q1234", " C", "C@0,0", "T@", "T@1", "T@a,b", "T@1e9,0", "T@0.1234,0", None],
)  # fmt: skip
def test_what_names_no_object_is_not_pinned(bad):
    with pytest.raises(InputError, match="give an object such as Q2") as caught:
        clean("pinned", bad)
    assert caught.value.control == "pinned"


@pytest.mark.parametrize(
    ("low", "high", "value", "held"),
    [
        (-4, 4, -7, (-10, 10)), (0, 4, 7, (0, 10)), (-4, 4, 4, (-4, 4)),
        (2, 3, -5, (-6, 6)), (2, 3, 1, (0, 3)), (2, 3, 0, (0, 3)), (0, 0.01, 0.05, (0, 0.06)),
        (-10, -5, 3, (-10, 4)), (0, 1, -0.25, (-0.3, 1)), (0.5, 6, 0.1, (0, 6)),
    ],
)  # fmt: skip
def test_a_range_widens_to_hold_the_value_as_it_does_in_the_browser(low, high, value, held):
    """The browser's rule is `rangeFor` of ranges.js, with the same rows in controls/ranges.test.js."""
    least, greatest, step = slider_range(low, high, value)
    assert (least, greatest) == pytest.approx(held)
    assert least <= value <= greatest
    assert 1e-4 <= step / (greatest - least) <= 1e-3 * (1 + 1e-9)
