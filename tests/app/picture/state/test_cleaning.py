"""What a browser sends is of its control's kind, or is told to be otherwise."""

import pytest
from codim2_app.picture.state import cleaning
from codim2_app.picture.state.choices import OWN_AXIS
from codim2_app.picture.state.cleaning import MAX_PORTRAIT_TEXT, MOST_ENTRIES, InputError, clean
from codim2_app.picture.state.controls import ExplorerState

LOW, HIGH = ExplorerState.param["trajectories"].bounds
START = "1.4,0.5; "
RANGES = {f"{OWN_AXIS}p{k}": [0.0, 1.0] for k in range(2 * MOST_ENTRIES)}
NUMBERS = {f"p{k}": float(k) for k in range(MOST_ENTRIES)}
#: Of each kind: what may be given and what it is then, what is refused, and with which words.
KINDS = {
    "trajectories": ([(LOW, LOW), (3.0, 3), ("3", 3), (HIGH, HIGH)], (2.5, LOW - 1, HIGH + 1, "many", None), "."),
    "layers": (
        [(given, ["inside", "cycles"]) for given in (["inside", "cycles", "inside"], "inside,,cycles")],
        (3, ["inside", 4], [None], ["nothing"], "nothing", {"inside": 1}), "Layers",
    ),
    "lesson": ([("x" * 200, "x" * 200)], ("x" * 201, 7, None, ["x"]), "200 characters"),
    "ranges": (
        [(RANGES, RANGES), ('{"f1": [0, 0.5], "own:mu": [-1, 1]}', {"f1": [0.0, 0.5], "own:mu": [-1.0, 1.0]})],
        ({**RANGES, "a": [0.0, 1.0]}, {1: [0.0, 1.0]}, {"psi": [0.0, 1.0]}, {"a": [1.0, 1.0]}, {"a": [0.0]}), ".",
    ),
    "parameters": ([(NUMBERS, NUMBERS)], ({**NUMBERS, "q": 1.0}, {1: 2.0}, [1.0], {"p": "c"}), "."),
    "beside": (
        [("f1=0.3&b=2", "f1=0.3&b=2"), ("", "")],
        ("f1=", "layers=inside", "f1=x", 3, "f1=" + "1" * MAX_PORTRAIT_TEXT), ".",
    ),
    "orbits": (
        [(START, START)], (START * (1 + cleaning.LONGEST_TEXT // len(START)), 3, ["1.4,0.5"]),
        f"at most {cleaning.LONGEST_TEXT} characters",
    ),
    "across": ([(axis, axis) for axis in ("f1", f"{OWN_AXIS}mu")], ("nothing", "mu", 7, None), "choose one such as"),
}  # fmt: skip


@pytest.mark.parametrize("name", KINDS)
def test_a_value_is_read_by_its_kind_or_refused(name):
    allowed, refused, words = KINDS[name]
    for given, read in allowed:
        assert clean(name, given) == read
    for wrong in refused:
        with pytest.raises(InputError, match=words):
            clean(name, wrong)
