"""What a browser sends is of its control's kind, or is told to be otherwise."""

import pytest
from codim2_app.state import cleaning
from codim2_app.state.choices import OWN_AXIS
from codim2_app.state.cleaning import MOST_ENTRIES, MOST_OWN, InputError, clean
from codim2_app.state.controls import ExplorerState


def test_a_count_is_a_whole_number_within_its_bounds():
    low, high = ExplorerState.param["trajectories"].bounds
    assert [clean("trajectories", value) for value in (low, 3, 3.0, "3", high)] == [low, 3, 3, 3, high]
    for wrong in (2.5, low - 1, high + 1, "many", None):
        with pytest.raises(InputError):
            clean("trajectories", wrong)


def test_layers_are_names_each_once_from_a_list_or_a_text():
    for given in (["inside", "cycles", "inside"], ("inside", "cycles"), "inside,,cycles"):
        assert clean("layers", given) == ["inside", "cycles"]
    for wrong in (3, ["inside", 4], [None], ["nothing"], "nothing", {"inside": 1}):
        with pytest.raises(InputError, match="Layers"):
            clean("layers", wrong)


def test_a_text_of_no_kind_of_its_own_is_short():
    name = "lesson"
    assert name not in cleaning._READ
    assert clean(name, "x" * 200) == "x" * 200
    for wrong in ("x" * 201, 7, None, ["x"]):
        with pytest.raises(InputError, match="200 characters"):
            clean(name, wrong)


def test_ranges_are_so_many_pairs_by_name():
    many = {f"{OWN_AXIS}p{k}": [0.0, 1.0] for k in range(2 * MOST_ENTRIES)}
    assert clean("ranges", many) == many
    assert clean("ranges", '{"f1": [0, 0.5], "own:mu": [-1, 1]}') == {"f1": [0.0, 0.5], "own:mu": [-1.0, 1.0]}
    for wrong in ({**many, "a": [0.0, 1.0]}, {1: [0.0, 1.0]}, {"psi": [0.0, 1.0]}, {"a": [1.0, 1.0]}, {"a": [0.0]}):
        with pytest.raises(InputError):
            clean("ranges", wrong)


def test_parameters_are_so_many_numbers_by_name():
    many = {f"p{k}": float(k) for k in range(MOST_ENTRIES)}
    assert clean("parameters", many) == many
    for wrong in ({**many, "q": 1.0}, {1: 2.0}, [1.0], {"p": "c"}):
        with pytest.raises(InputError):
            clean("parameters", wrong)


def test_own_values_of_a_second_portrait_may_be_empty_and_are_named():
    assert clean("beside", "f1=0.3&b=2") == "f1=0.3&b=2"
    for wrong in ("f1=", "layers=inside", "f1=x", 3, "f1=" + "1" * MOST_OWN):
        with pytest.raises(InputError):
            clean("beside", wrong)


def test_launched_orbits_are_a_text_that_is_not_too_long():
    start = "1.4,0.5; "
    assert clean("orbits", start) == start
    for wrong in (start * (1 + cleaning.LONGEST_TEXT // len(start)), 3, ["1.4,0.5"]):
        with pytest.raises(InputError, match=f"at most {cleaning.LONGEST_TEXT} characters"):
            clean("orbits", wrong)


def test_an_axis_is_a_control_or_a_name_of_ones_own():
    assert [clean("across", name) for name in ("f1", "z", f"{OWN_AXIS}mu")] == ["f1", "z", f"{OWN_AXIS}mu"]
    for wrong in ("nothing", "mu", 7, None):
        with pytest.raises(InputError, match="choose one such as"):
            clean("across", wrong)
