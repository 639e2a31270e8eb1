import math
from urllib.parse import parse_qs

import pytest
from codim2_app.state.controls import NAMES, NUMBERS, ExplorerState, InputError, build_psi, clean
from codim2_app.state.portraits import portraits
from hypothesis import given
from hypothesis import strategies as st

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
    assert [error.control for error in errors] == ["a", "psi", "trajectories", "layers"]


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


def test_presets_set_only_known_controls_to_allowed_values():
    for portrait in portraits():
        for name, value in portrait["values"].items():
            assert clean(name, value) == value


def test_a_link_may_name_a_portrait_and_change_it():
    state, errors = ExplorerState.from_query("preset=case3-n3&z=0.25")
    assert errors == []
    assert (state.a, state.b, state.psi, state.n, state.z) == (172.0, 186.0, "hill", 3.0, 0.25)
