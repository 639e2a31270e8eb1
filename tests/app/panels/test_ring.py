"""The ring of outcomes around the picture: live where a theorem answers, at rest otherwise."""

import numpy as np
import pytest
from codim2_app.picture.draw.svg import draw
from codim2_app.picture.slow_layers import outcomes
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.view.refresh import Frames

from .opening import CASE3, ask, opened, settled


def test_outcomes_are_live_where_a_theorem_answers_and_at_rest_otherwise():
    frames, header = opened("numbers")
    assert header["outcomes"]["kind"] == ["slide"] * 4
    header = ask(frames, f1=3.0)
    assert "late" not in header
    assert set(header["outcomes"]["kind"]) == {"misses"}
    header = ask(frames, **CASE3)
    assert header["late"] == ["outcomes"]
    header = settled(frames, rest=True)
    assert header["outcomes"]["kind"] == ["slide", "misses", "misses", "slide"]
    label, kind, _, sentence, families = header["outcomes"]["rows"][0]
    assert (label, kind) == ("Q₁", "slide")
    assert sentence.endswith("with the same slow flow.")
    assert [words for words, _ in families] == ["slides on C", "slides around cycle 1"]


def test_the_ring_is_the_circle_cut_at_the_limit_directions():
    for values in ({}, {"f1": 3.0}, {"b": 3.0}, {"a": 1.0, "b": 0.0, "d": -1.0}):
        frames = Frames(ExplorerState(panel="numbers", **values))
        arcs = settled(frames, all=True)["outcomes"]
        assert sum(np.subtract(arcs["end"], arcs["start"])) == pytest.approx(2 * np.pi)
        assert set(arcs["kind"]) <= outcomes.WORDS.keys()


def test_the_ring_is_sent_when_its_layer_is_on_whatever_is_open():
    frames, header = opened("theorems")
    assert "outcomes" not in header
    assert "outcomes" in ask(frames, layers=["outcomes", "inside"])


def test_the_first_picture_has_the_ring():
    layers = ["outcomes", "inside"]
    hidden = draw(Frames(ExplorerState()).answer({"all": True}), layers)
    shown = draw(Frames(ExplorerState(layers=layers)).answer({"all": True}), layers)
    assert "var(--slide)" not in hidden
    assert shown.count("var(--slide)") == 4
