"""The panel "Lessons" as a browser meets it: the list, an open lesson, a question posed, answered, and its goal."""

import pytest
from codim2_app.lessons import library
from codim2_app.lessons.library import add_lessons, lessons, read_lesson
from codim2_app.panels.lessons import Quiz, opening_values, read_quiz
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.view.refresh import Frames

from .opening import settled

LIMITS = "03-limit-directions"
OWN = "---\ntitle: Mine\nsummary: My own.\nportrait: case1-cm0\n---\nHere [](fact:name).\n"


def opened(key):
    frames = Frames(ExplorerState.from_values(opening_values(lessons()[key])))
    return frames, settled(frames, all=True)


def test_the_list_comes_first_and_once():
    frames = Frames(ExplorerState(panel="lessons"))
    header = settled(frames, all=True)
    assert [entry["key"] for entry in header["lesson"]["list"]] == list(lessons())
    assert "lesson" not in settled(frames, set={"f1": -0.4})


def test_a_lesson_brings_its_text_once_and_its_facts_when_they_change():
    frames, header = opened(LIMITS)
    assert header["lesson"]["key"] == LIMITS
    assert header["facts"] == {"limit_directions": "4", "along_an_open_set": "2"}
    moved = settled(frames, set={"f1": -0.45})
    assert "lesson" not in moved
    assert "facts" not in moved
    assert settled(frames, set={"f1": -1.4})["facts"] == {"limit_directions": "2", "along_an_open_set": "1"}


def test_a_closed_panel_costs_nothing():
    frames, _ = opened(LIMITS)
    assert not {"lesson", "facts", "goal"} & settled(frames, set={"panel": "numbers", "f1": -1.4}).keys()


def test_predict_reveal_explain_vary():
    frames, _ = opened(LIMITS)
    posed = settled(frames, set={"quiz": "0.17"})["pose"]
    assert posed["question"] == 0
    settled(frames, set=posed["values"])
    count = len(frames.scene["equator"].theta)
    truth = {0: 0, 2: 1, 4: 2}[count]
    said = settled(frames, set={"quiz": f"0.17.{truth}"})
    assert said["judged"]["right"] is True
    assert said["judged"]["truth"] == truth
    assert said["judged"]["explain"].startswith(f"There are {count}:")
    name = frames.scene["classification"].name
    assert said["goal"] == {"question": 0, "reached": False, "now": f"portrait: {name}"}
    there = settled(frames, set={"a": -0.3, "b": 0.0, "d": -1.0, "f1": 0.5, "f2": 0.0})
    assert there["goal"]["reached"] is True
    assert "judged" not in there  # what was answered stays answered


def test_a_wrong_answer_is_told_with_the_right_one():
    frames, _ = opened(LIMITS)
    settled(frames, set=settled(frames, set={"quiz": "0.5"})["pose"]["values"])
    truth = {0: 0, 2: 1, 4: 2}[len(frames.scene["equator"].theta)]
    said = settled(frames, set={"quiz": f"0.5.{(truth + 1) % 3}"})["judged"]
    assert (said["right"], said["truth"]) == (False, truth)


def test_the_same_seed_poses_the_same_system_whatever_the_sliders_are():
    one, _ = opened(LIMITS)
    other, _ = opened(LIMITS)
    settled(other, set={"a": 3.0, "psi": "tanh"})
    assert settled(one, set={"quiz": "0.99"})["pose"] == settled(other, set={"quiz": "0.99"})["pose"]


@pytest.mark.parametrize(
    "text", ["", "0", "9.1", "0.x", "0.1.9", "0.1.2.3", "1.1.9.8.7", "1.1.8001.0", "-1.2", "0.12345678901", "٣.1"]
)
def test_a_quiz_that_is_none_is_passed_over(text):
    assert read_quiz(text, lessons()[LIMITS]) is None
    frames, _ = opened(LIMITS)
    assert not {"pose", "judged", "errors"} & {k for k, v in settled(frames, set={"quiz": text}).items() if v}


def test_a_quiz_is_read():
    assert read_quiz("0.12", lessons()[LIMITS]) == Quiz(0, 12, None)
    assert read_quiz("0.12.2", lessons()[LIMITS]) == Quiz(0, 12, 2)
    assert read_quiz("1.12.3500.4250", lessons()[LIMITS]) == Quiz(1, 12, (-0.5, 0.25))


@pytest.fixture
def offered_here_only(monkeypatch):
    with monkeypatch.context() as patch:
        patch.setattr(library, "_own", {})
        yield
    lessons.cache_clear()


@pytest.mark.usefixtures("offered_here_only")
def test_a_lesson_of_ones_own_is_one_file(tmp_path):
    path = tmp_path / "own-lesson.md"
    path.write_text(OWN, encoding="utf-8")
    add_lessons({"own-lesson": read_lesson(path)})
    frames, header = opened("own-lesson")
    assert header["lesson"]["title"] == "Mine"
    assert header["facts"] == {"name": "CM0"}
    assert settled(frames, set={"lesson": ""})["lesson"]["list"][-1]["key"] == "own-lesson"
