"""A live file holds the frames that the core computes at each place of its sliders, and is small."""

import base64
import gzip
import json
import re

import pytest
from codim2_app.exports import live as module
from codim2_app.exports.live import MAX_BYTES, Slider, live
from codim2_app.exports.view import view_of
from codim2_app.picture.draw.packing import INT16_STEP, unpack

from tests.app.near import gaps


@pytest.fixture(autouse=True)
def _few(monkeypatch):
    """A few frames show what many do; browser tests make whole files."""
    monkeypatch.setattr(module, "ONE", 5)
    monkeypatch.setattr(module, "TWO", 3)


def held(made):
    """The settings of a file, and its frames."""
    text = made.decode()
    settings = json.loads(re.search(r'id="settings">(.*?)</script>', text)[1])
    packed = gzip.decompress(base64.b64decode(re.search(r'id="frames">(.*?)</script>', text)[1]))
    frames, at = [], 0
    for size in settings["sizes"]:
        frames.append(unpack(packed[at : at + size]))
        at += size + -size % 4
    assert at == len(packed)
    return settings, frames


@pytest.mark.parametrize(
    ("text", "sliders"),
    [
        ("case1-cm4", ["f1=-1,1"]),
        ("preset=case3-n3&layers=inside,cycles,equator", ["n", "f1=-88,-84"]),
        ("system=ball_in_pool&layers=inside,outside", ["own:mu=0.1,0.5"]),
        ("system=own&layers=inside", ["mu=0.5,1.5", "f=-1,1"]),
        ("a=-2&f1=-0.4&layers=inside&seen=-0.5,0.5,-0.5,0.5", ["b"]),
    ],
)
def test_its_frames_are_those_of_the_core(text, sliders):
    view = view_of(text)
    settings, frames = held(live(view, sliders))
    values = [slider["values"] for slider in settings["sliders"]]
    places = [(v,) for v in values[0]] if len(values) == 1 else [(v, w) for v in values[0] for w in values[1]]
    assert len(frames) == len(places)
    for k in (0, len(frames) // 2, len(frames) - 1):
        names = [slider["name"] for slider in settings["sliders"]]
        there = view.with_values(dict(zip(names, places[k], strict=True)))
        scene = there.scene().evolve(pixel=view.width / 700)
        header, blocks = frames[k]
        assert header["portrait"]["name"] == scene["classification"].name
        drawn = blocks["inside.xy"].reshape(-1, 2) * (1 if header.get("exact") else INT16_STEP)
        assert len(drawn)
        near = 1e-6 if header.get("exact") else INT16_STEP
        assert gaps(drawn[::20], scene["inside"].points).max() <= near
    for slider, present in zip(settings["sliders"], map(view.number, names), strict=True):
        at = slider["values"][slider["at"]]
        assert abs(at - present) <= (slider["values"][1] - slider["values"][0]) / 2 + 1e-9


def test_the_present_value_is_a_position():
    slider = Slider("f1", -1.0, 1.0)
    assert slider.values(5, 0.3) == [-1.0, -0.5, 0.0, 0.3, 1.0]
    assert slider.values(3, 7.0) == [-1.0, 0.0, 1.0]


def test_a_file_that_would_be_too_large_has_fewer_positions(monkeypatch):
    monkeypatch.setattr(module, "ONE", 9)
    view = view_of("layers=inside,outside&trajectories=120")
    whole = live(view, ["f1"])
    assert len(whole) < MAX_BYTES
    monkeypatch.setattr(module, "MAX_BYTES", len(whole) - 20_000)
    smaller = live(view, ["f1"])
    assert len(smaller) < len(whole) - 20_000
    assert 3 <= len(held(smaller)[0]["sliders"][0]["values"]) < 9
    monkeypatch.setattr(module, "MAX_BYTES", module.PAGE_BYTES + 3000)
    with pytest.raises(ValueError, match="fewer starting points"):
        live(view, ["f1"])


def test_it_asks_nobody_for_anything():
    text = live(view_of("preset=case1-cm0&trajectories=8"), ["f1"]).decode()
    assert not re.search(r"(src|href)=|import |https?://(?!www\.w3\.org)", re.sub(r'id="frames">.*?<', "", text))


def test_a_place_where_nothing_can_be_drawn_says_why():
    _, frames = held(live(view_of("preset=case3-n3&layers=inside"), ["n=-1,3"]))
    assert "n is" in frames[0][0]["portrait"]["sentence"] or "Hill" in frames[0][0]["portrait"]["sentence"]
    assert frames[-1][0]["portrait"]["name"] == "CM4"


@pytest.mark.parametrize(
    ("sliders", "said"),
    [
        ([], "one or two"), (["f1", "f1=0,1"], "one or two"), (["a", "b", "d"], "one or two"),
        (["q"], "no slider of this system"), (["f1=1,0"], "give a range"), (["f1=x"], "NAME=LOW,HIGH"),
        (["f1=0,inf"], "give a range"),
    ],
)  # fmt: skip
def test_sliders_that_there_are_not(sliders, said):
    with pytest.raises(ValueError, match=said):
        live(view_of("case1-cm0"), sliders)
