"""Limit directions keep their names while a value moves, in the frame and in the link."""

import json
import math
import struct

import numpy as np
import pytest
from codim2_app.picture.draw.glyphs import equator_arrows, equator_columns
from codim2_app.picture.frame.scenes import make_scene
from codim2_app.picture.state.links import read_link, write_link
from codim2_app.view.refresh import Frames

import codim2_core as c2


def moved(frames, **values):
    """Return the header of the next frame."""
    data = frames.answer({"set": values})
    (length,) = struct.unpack_from("<I", data)
    return json.loads(data[4 : 4 + length])


def turned(one, other):
    return float(np.abs(np.mod(np.asarray(one) - other + math.pi, 2.0 * math.pi) - math.pi).max())


@pytest.mark.parametrize("key", c2.presets)
def test_they_follow_in_every_portrait(key):
    frames = Frames(read_link({"preset": key, "layers": "equator"}).state)
    assert frames.values["cut"] == 0.0
    name = next((one for one in ("f2", "z") if one not in frames.locked and frames.values["system"] == "normal"), "z")
    first, size = frames.values[name], 0.01 * max(1.0, abs(frames.values[name]))
    before = frames.scene["equator"].theta
    for step in [*range(1, 16), *range(14, -16, -1)]:
        moved(frames, **{name: first + step * size})
        now = frames.scene["equator"].theta
        if len(now) == len(before) and len(now):
            rolls = [turned(np.roll(now, k), before) for k in range(len(now))]
            assert rolls[0] == min(rolls)
        before = now


def test_a_link_carries_them():
    frames = Frames(read_link({}).state)
    first = frames.scene["equator"].theta
    header = moved(frames, f2=0.005)
    assert turned(frames.scene["equator"].theta, first) < 0.02
    assert header["set"].keys() == {"f2", "cut"}
    opened = read_link(write_link(frames.values)).state.values()
    assert opened["cut"] == frames.values["cut"] > 0.0
    np.testing.assert_array_equal(make_scene(opened)["equator"].theta, frames.scene["equator"].theta)
    moved(frames, preset="case1-cm2")
    assert frames.values["cut"] == 0.0
    assert "cut" not in write_link(frames.values)


@pytest.mark.parametrize("cut", [0.5, 2.5, 5.23])
def test_what_is_drawn_is_where_it_was_whichever_is_the_first(cut):
    system = c2.ELinear(-2.0, 0.1, -1.0, (-0.4, 0.05))
    plain, turned = (c2.Scene(system, cut=c)["equator"] for c in (0.0, cut))
    one, other = (
        dict(zip(columns["theta"], columns["label_y"], strict=True))
        for columns in map(equator_columns, (plain, turned))
    )
    assert one.keys() == other.keys()
    assert [other[angle] for angle in one] == pytest.approx(list(one.values()), abs=1e-12)
    np.testing.assert_allclose(sorted(equator_arrows(turned)), sorted(equator_arrows(plain)), atol=1e-12)
