"""A challenge that came with a link: met or not, in words; what is no condition is told."""

import pytest
from codim2_app.lessons.condition import condition
from codim2_app.lessons.facts import FACT_NAMES
from codim2_app.panels.challenge import GOALS
from codim2_app.picture.draw.packing import unpack
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.picture.state.links import read_link
from codim2_app.view.refresh import Frames


def told(**asked):
    frames = Frames(ExplorerState())
    header, _ = unpack(frames.answer({"id": 1, "set": asked, "rest": True}))
    return header.get("challenge")


def test_it_says_whether_it_is_met_and_where_the_system_stands():
    goal = GOALS["the portrait is NCM4"]
    before, after = told(goal=goal), told(goal=goal, a=-0.3, f1=0.5)
    assert before == {"goal": goal, "words": "the portrait is NCM4", "met": False, "now": "portrait: CM4"}
    assert after["met"]
    assert after["now"] == "portrait: NCM4"
    assert told() is None


def test_what_is_no_condition_is_told_and_the_picture_is_drawn():
    assert "cannot be read" in told(goal="name ==")["error"]
    assert "facts are" in told(goal="portrait == 1")["error"]


@pytest.mark.parametrize("goal", GOALS.values())
def test_what_share_offers_is_a_condition_and_a_link_carries_it(goal):
    assert condition(goal, FACT_NAMES).names
    assert read_link({"v": "1", "goal": goal}).state.goal == goal
