"""What a browser sends is refused in one sentence where it is of a wrong type or too large."""

import json

import pytest
from codim2_app.picture.draw.packing import unpack
from codim2_app.picture.state.cleaning import InputError, clean
from codim2_app.picture.state.controls import CONTROL_NAMES, ExplorerState
from codim2_app.picture.state.request_reading import MAX_TEXT_CHARACTERS, MOST_CONTROLS, read_request
from codim2_app.view.refresh import Frames
from hypothesis import given
from hypothesis import strategies as st

SMALL = st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=20)
ANYTHING = st.recursive(SMALL, lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=8), inner))


@pytest.fixture(scope="module")
def frames():
    return Frames(ExplorerState(layers=[], panel="psi", trajectories=0), ready=lambda *_: False)


@pytest.mark.parametrize(("request_", "said"), [
    ({"id": 1, "set": {"layers": ["equator"] * 10**6}}, "1000000 entries"),
    ({"id": 1, "set": {"a": 10**400}}, "too large"),
    ({"id": 1, "set": {"psi_text": "s" * 10**6}}, "1000000 characters"),
    ({"id": 1, "set": [1, 2]}, "came as list"),
    ({"id": 1, "set": {f"n{i}": 0 for i in range(MOST_CONTROLS + 1)}}, "at most"),
    ({"id": 1, "set": {"texts": {"U1": {"deeper": 1}}}}, "dict is no value"),
    ([1], "came as list"),
])  # fmt: skip
def test_it_is_refused_in_one_bounded_sentence(frames, request_, said):
    answer = frames.answer(request_)
    header, _ = unpack(answer)
    assert said in header["errors"][""]
    assert len(header["errors"][""]) < 300
    assert len(answer) < 20_000


@pytest.mark.parametrize("number", ["x" * 10**7, 10**400, None, [1], float("nan"), float("inf"), True])
def test_an_odd_number_of_a_request_is_not_sent_back(frames, number):
    answer = frames.answer({"id": number})
    assert unpack(answer)[0]["id"] == 0
    assert len(answer) < 20_000


@pytest.mark.parametrize("name", CONTROL_NAMES)
@pytest.mark.parametrize(
    "value", [None, True, [], [[]], [{}], {}, {"a": []}, 1e400, 10**400, "1e400", "x" * MAX_TEXT_CHARACTERS]
)
def test_every_control_takes_a_value_or_says_why_not(name, value):
    refused = None
    try:
        json.dumps(clean(name, value), allow_nan=False)
    except InputError as error:
        refused = error
    assert refused is None or (refused.control == name and len(str(refused)) < 600)


@given(ANYTHING)
def test_no_request_is_too_odd_to_be_read(given_):
    request, values, sentence = read_request(given_)
    assert set(request) <= {"id", "all", "rest", "window"}
    assert all(isinstance(name, str) for name in values)
    assert len(sentence) < 400


@given(st.dictionaries(st.sampled_from(CONTROL_NAMES), SMALL, max_size=3))
def test_no_value_is_too_odd_to_be_answered(frames, values):
    header, _ = unpack(frames.answer({"id": 3, "set": values}))
    assert header["id"] == 3
