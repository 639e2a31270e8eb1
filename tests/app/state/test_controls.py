import math
from urllib.parse import parse_qs

import pytest
from codim2_app.state.chosen import has_atlas, titles
from codim2_app.state.controls import NAMES, NUMBERS, ExplorerState, InputError, build_psi, clean, preset_values
from codim2_app.state.portraits import portraits
from hypothesis import given
from hypothesis import strategies as st

KEYS = [item["key"] for item in portraits()]
finite = st.floats(allow_nan=False, allow_infinity=False)


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


@given(st.fixed_dictionaries({name: finite for name in NUMBERS}))
def test_query_carries_every_value_exactly(numbers):
    state = ExplorerState(**numbers, psi="hill", layers=["rho", "inside"], trajectories=7, psi_text="1/(1+s)&?=")
    query = state.to_query()
    assert set(parse_qs(query, keep_blank_values=True)) == set(NAMES)
    read, errors = ExplorerState.from_query(query)
    assert errors == []
    assert read.values() == state.values()


def test_query_with_bad_values_keeps_the_rest():
    state, errors = ExplorerState.from_query("a=nan&b=0.25&psi=none&unknown=3&trajectories=1e9&layers=rho,nothing")
    assert state.b == 0.25
    assert state.a == -2
    assert [error.control for error in errors] == ["a", "psi", "trajectories", "layers", ""]
    assert "unknown" in str(errors[-1])


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


@given(st.dictionaries(st.text(min_size=1, max_size=8), finite, max_size=8))
def test_query_carries_parameters_and_texts(numbers):
    texts = {"U1": "c + \u00e9 & s", "W": "1\n2"}
    state = ExplorerState(system="own", parameters=numbers, texts=texts)
    read, errors = ExplorerState.from_query(state.to_query())
    assert errors == []
    assert read.values() == state.values()


@pytest.mark.parametrize(("name", "value"), [
    ("parameters", "[1]"), ("parameters", {"k": "x"}), ("parameters", {f"p{i}": 1.0 for i in range(40)}),
    ("parameters", "{" * 50_000), ("texts", {"U1": 3}), ("texts", {"U1": "c" * 5000}), ("texts", "{not json"),
])  # fmt: skip
def test_mappings_that_cannot_be_used_name_their_control(name, value):
    with pytest.raises(InputError):
        clean(name, value)


def test_a_link_may_name_a_system_and_opens_where_that_starts():
    state, errors = ExplorerState.from_query("system=ball_in_pool&z2=1.5")
    assert errors == []
    assert (state.z, state.z2, state.t_end) == (4.0, 1.5, 5.0)
    assert state.launch == "9, 3, 9, 0"


@pytest.mark.parametrize("key", KEYS)
def test_a_portrait_is_every_value_and_its_link_is_the_same(key):
    values = preset_values(key)
    assert set(values) == set(NAMES)
    assert {name: clean(name, value) for name, value in values.items()} == values
    state, errors = ExplorerState.from_query(f"preset={key}")
    assert (state.values(), errors) == (values, [])
    assert ExplorerState.from_query(state.to_query())[0].values() == values


def test_no_portrait_that_there_is_not():
    with pytest.raises(InputError, match="case1-cm0"):
        clean("preset", "case1-cm1")
    state, errors = ExplorerState.from_query("preset=case1-cm1&a=-1")
    assert (state.preset, state.a, [error.control for error in errors]) == ("", -1.0, ["preset"])
    assert preset_values("case1-cm1") == preset_values("") == {}


def test_what_is_taken_from_a_portrait_is_nobody_elses():
    preset_values("attracting-repelling")["layers"].append("separatrices")
    assert "separatrices" not in preset_values("attracting-repelling")["layers"]


@pytest.mark.parametrize("choice", titles())
def test_a_system_opens_on_a_panel_that_can_show_something(choice):
    state, _ = ExplorerState.from_query(f"system={choice}")
    assert (state.panel == "atlas") == has_atlas(choice)
    assert ExplorerState.from_query(f"system={choice}&panel=time")[0].panel == "time"


def test_a_link_may_name_a_portrait_and_change_it():
    state, errors = ExplorerState.from_query("preset=case3-n3&z=0.25")
    assert errors == []
    assert (state.a, state.b, state.psi, state.n, state.z) == (172.0, 186.0, "hill", 3.0, 0.25)
