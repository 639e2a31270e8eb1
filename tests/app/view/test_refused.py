"""What a link or a box asks for in vain is told in words and kept in its box; all else is drawn."""

import pytest
from codim2_app.picture.draw.packing import unpack
from codim2_app.picture.state.controls import preset_values
from codim2_app.picture.state.links import read_link
from codim2_app.view.refresh import Frames

from .asking import ask

REFUSED = [
    ('system=own&texts={"U1":"-2*c %2B"}', "text:U1", "texts"),
    ('system=typed&texts={"a":"1/z"}', "text:a", "texts"),
    ('system=own&texts={"U1":"' + "%2B".join(f"k{i}*c" for i in range(13)) + '"}', "text:U1", "texts"),
    ("psi=custom&psi_text=1/s", "psi_text", "psi_text"),
    ("z=1e300", "z", "z"),
    ("a=nan", "a", "a"),
    ("preset=ball-stick&z=1e300", "z", "z"),
    ('system=ball_in_pool&parameters={"mu":1e200}', "parameters", "parameters"),
]


@pytest.mark.parametrize(("query", "control", "name"), REFUSED, ids=[row[0][:30] for row in REFUSED])
def test_a_link_that_cannot_be_drawn_draws_the_rest_and_says_what_not(query, control, name):
    link = read_link(query)
    given = next((e.given for e in link.errors), link.state.values()[name])
    frames = Frames(link.state, errors=link.errors)
    header, _ = unpack(frames.answer({"all": True}))
    assert list(header["errors"]) == [control]
    assert len(header["errors"][control]) < 600
    assert "portrait" in header
    assert frames.refused == {name: given}  # it is kept, for its box
    for part in query.split("&"):  # and all else is as the link says
        other, text = part.split("=", 1)
        if other not in (name, "preset"):
            assert frames.values[other] == text
    frames.publish()
    assert frames.state.values() == frames.values
    header, _ = unpack(frames.answer({"set": {"B1": 0.5}}))  # it is still wrong
    assert list(header["errors"]) == [control]
    header, _ = unpack(frames.answer({"set": preset_values("case1-cm0")}))
    assert header["errors"] == {}
    assert frames.refused == {}


@pytest.mark.parametrize(
    ("query", "says"),
    [
        ("panel=nothing", "nothing"), ("preset=case9", "case9"), ("layers=rho,nothing", "nothing"),
        ("unheard=3", "unheard"), ("&".join(f"q{i}=1" for i in range(90)), "87 more"),
        ('system=own&parameters={"gone":3}', "gone"), ('parameters={"mu":3}', "it has none"), ("launch=1,2", "Start"),
        ("log_eps=100", "log₁₀ ε"), ("lesson=nope", "nope"), ("seen=1,1,1,1", "seen"), ("controls=<b>", "controls"),
        ("v=99", "version"), ("s=notthewhole", "Copy the whole link"), ("system=nothing", "nothing"),
        ("solid=" + "x" * 5000, "xxx"),
    ],
)  # fmt: skip
def test_what_a_link_asks_for_in_vain_is_said_until_something_is_set(query, says):
    link = read_link(query)
    frames = Frames(link.state, errors=link.errors)
    header, _ = unpack(frames.answer({"all": True}))
    assert says in header["errors"][""]
    assert len(header["errors"][""]) < 400
    header, _ = unpack(frames.answer({"rest": True}))
    assert "" in header["errors"]
    header, _ = unpack(frames.answer({"set": {"a": -1.0, "launch": "1, 1, 0", "log_eps": -2.0}}))
    assert header["errors"] == {}


def test_a_text_stays_wrong_until_it_is_mended(frames):
    ask(frames, system="own")
    header, _ = ask(frames, texts={"W": "foo + "})
    assert list(header["errors"]) == ["text:W"]
    for z in (0.1, 0.2, 0.3):
        header, _ = ask(frames, z=z)
        assert list(header["errors"]) == ["text:W"]
        assert frames.values["z"] == z
    header, _ = ask(frames, texts={"W": "foo"})
    assert header["errors"] == {}
    assert frames.scene.system.at((0.0,)).W((1.0, 0.0)).tolist() == [1.0]


def test_what_is_refused_may_become_right_by_another_control(frames):
    ask(frames, system="own")
    header, _ = ask(frames, texts={"U1": "-c + sqrt(z - 1)"})
    assert list(header["errors"]) == ["text:U1"]
    header, _ = ask(frames, z=2.0)
    assert header["errors"] == {}
    assert frames.values["texts"] == {"U1": "-c + sqrt(z - 1)"}
    header, _ = ask(frames, z=0.5)  # where it has no value
    assert list(header["errors"]) == ["z"]
    assert frames.values["z"] == 2.0


def test_a_refused_text_does_not_keep_the_picture_from_coming_once_all_is_compiled():
    ready = [False]
    link = read_link("system=spinning_disc&psi=custom&psi_text=1/(1%2B")  # a field that needs the compiler
    frames = Frames(link.state, ready=lambda *_: ready[0], errors=link.errors)
    header, _ = unpack(frames.answer({"all": True}))
    assert header["ready"] is False
    header, _ = unpack(frames.answer({"id": 1}))
    assert (header["ready"], list(header["errors"])) == (False, ["psi_text"])
    ready[0] = True
    header, _ = unpack(frames.answer({"id": 2}))
    assert (header["ready"], list(header["errors"])) == (True, ["psi_text"])
    assert "portrait" in header
