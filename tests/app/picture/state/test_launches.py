"""Launched orbits in the link: read back as they were written, or refused in a sentence."""

import pytest
from codim2_app.picture.draw.packing import unpack
from codim2_app.picture.state.cleaning import InputError, clean
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.picture.state.launches import MAX_LAUNCHES, TYPED, Launch, read_launches, selected_place
from codim2_app.view.refresh import Frames


def test_orbits_are_read():
    assert read_launches("0.3,0.2;1.5,-0.1,-;-1,0.25:slow one") == (
        Launch(0.3, 0.2),
        Launch(1.5, -0.1, hidden=True),
        Launch(-1.0, 0.25, name="slow one"),
    )
    assert read_launches("") == ()


@pytest.mark.parametrize(
    "text", ["1", "1,2,3", "a,b", "nan,0", "9,9", "inf,1", ";".join(["0,0"] * (MAX_LAUNCHES + 1)), "0,0:" + "x" * 60]
)
def test_what_is_none_is_refused(text):
    with pytest.raises(ValueError, match=r"\.$"):
        read_launches(text)
    with pytest.raises(InputError) as told:
        clean("orbits", text)
    assert told.value.control == "orbits"


def test_a_frame_brings_the_orbits_and_their_words_once():
    frames = Frames(ExplorerState())
    header, _ = unpack(frames.answer({"all": True}))
    assert "launched" not in header
    header, blocks = unpack(frames.answer({"set": {"orbits": "1.5,0.3;0.2,0.1,-;-0.4,0.2"}}))
    assert header["launched"]["x"] == [1.5, -0.4]
    assert header["launched"]["goes"][0].startswith("Reaches Σ along Q₂")
    assert header["launched"]["goes"][1] == "Tends to C, a stable node: sliding."
    assert {name for name in blocks if name.startswith("launched_1")}
    header, blocks = unpack(frames.answer({"set": {"B1": 0.4}}))
    assert "launched" not in header
    assert not [name for name in blocks if name.startswith("launched")]
    header, _ = unpack(frames.answer({"set": {"f1": -1.5}}))
    assert header["launched"]["goes"][0].startswith("Reaches Σ along Q")
    header, blocks = unpack(frames.answer({"set": {"orbits": ""}}))
    assert header["launched"]["x"] == []
    assert "launched_1.n" in blocks


@pytest.mark.parametrize(
    ("text", "number", "place"),
    [
        ("", 1, TYPED), ("0,0", 0, TYPED), ("0,0", 1, 0), ("0,0", 9, 0), ("0,0,-", 1, None), ("0,0,-;1,1;2,2", 3, 1),
        ("0,0;1,1,-;2,2", 9, 1), ("0,0;1,1,-", 2, None),
    ],
)  # fmt: skip
def test_the_chosen_orbit_has_its_place_among_those_that_are_shown(text, number, place):
    assert selected_place(read_launches(text), number) == place
