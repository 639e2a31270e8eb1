"""A student's way through a lesson: open it, drag a number, predict, see the answer, reach the goal."""

import json
from itertools import pairwise

from .conftest import PHONE


def test_a_lesson_from_the_list_to_its_goal(open_page):
    explorer = open_page().open("?panel=lessons")
    explorer.click("[data-open='03-limit-directions']")
    assert explorer.find(".lesson-text math").count() > 5
    assert explorer.find("[data-fact=limit_directions]").first.text_content() == "4"
    predict, mark = (explorer.find(f"[data-question='{i}']") for i in (0, 1))
    predict.locator(".begin").click()
    predict.locator(".options").wait_for()
    explorer.settle()
    assert explorer.find("[data-fact=limit_directions]").first.text_content() == "?"
    assert not explorer.find(".portrait-name").is_visible()
    count = int(explorer.name()[-1])  # CM4
    predict.locator(f"[data-choice='{count // 2}']").click()
    predict.locator(".verdict b").wait_for()
    assert predict.locator(".verdict b").text_content() == "Right."
    assert explorer.find(".portrait-name").is_visible()
    predict.locator(".vary .clue summary").click()
    assert predict.locator(".vary .clue p").is_visible()
    for name, value in {"a": -0.3, "b": 0, "d": -1, "f1": 0.5, "f2": 0}.items():
        explorer.type(name, str(value))
    assert explorer.name() == "NCM4"
    assert predict.locator(".goal").text_content() == "Done ✓"
    mark.locator(".begin").click()
    mark.locator(".options").wait_for()
    explorer.settle()
    box = explorer.find(".bokeh").bounding_box()
    explorer.page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)  # it has no angle
    mark.locator(".verdict b").wait_for()
    assert mark.locator(".verdict").text_content().startswith("Not quite. Try again.")
    kept = json.loads(explorer.page.evaluate("localStorage.getItem('codim2-lessons')"))
    assert kept == {"03-limit-directions": {"0": ["answer", "goal"]}}
    explorer.click("[data-open='']")
    assert explorer.find("[data-open='03-limit-directions'] .lesson-done").text_content() == "1/2"
    assert explorer.complaints == []


def test_on_a_phone_a_question_its_sliders_the_picture_and_the_answers_are_in_one_view(open_page):
    page = open_page(**PHONE).open("?lesson=02-blowing-up")
    page.find(".question .begin").first.tap()
    page.settle()
    page.until("root.classList.contains('asked')")
    answers = ".question .options [data-choice] >> nth="
    boxes = [
        page.find(name).first.bounding_box() for name in (".picture", "#c2-a", ".ask", answers + "0", answers + "2")
    ]
    assert all(box["x"] >= 0 and box["y"] >= -1 and box["y"] + box["height"] <= 844 for box in boxes)
    assert all(above["y"] + above["height"] <= below["y"] + 1 for above, below in pairwise(boxes))
    assert boxes[0]["height"] >= 290
    page.find(answers + "0").tap()
    page.settle()
    box = page.find(".verdict").first.bounding_box()
    foot = page.find(".sheets").bounding_box()["y"]
    assert box["height"] > 15
    assert box["y"] + box["height"] <= foot + 1
    page.find(".sheets [data-sheet=controls]").tap()
    assert page.find(".top").is_visible()
    assert page.complaints == []
