"""Hands on the picture: a click, a drag, a tap; what is launched stays, is in the link, and is told in words."""

import math

import numpy as np
import pytest
from codim2_app.picture.draw.theme import HALF_VIEW

from .conftest import PHONE


def place(explorer, x, y):
    """The point of the window over a point of the picture, which shows [-VIEW, VIEW] across its shorter side."""
    box = explorer.find(".bokeh").bounding_box()
    unit = min(box["width"], box["height"]) / (2 * HALF_VIEW)
    return box["x"] + box["width"] / 2 + x * unit, box["y"] + box["height"] / 2 - y * unit


def starts(explorer):
    return explorer.page.evaluate("new URLSearchParams(location.search).get('orbits')")


def test_a_click_launches_the_orbit_through_that_point(open_page):
    explorer = open_page().open("?panel=orbits")
    explorer.page.mouse.click(*place(explorer, -0.4, 0.3))
    explorer.settle()
    assert explorer.find(".orbit-goes").all_text_contents() == ["Tends to C, a stable node: sliding."]
    assert explorer.find(".orbit-words").text_content() == "Tends to C, a stable node: sliding."
    explorer.page.mouse.click(*place(explorer, 1.2, 0.8))
    explorer.settle()
    assert explorer.find(".orbit-goes").nth(1).text_content().startswith("Reaches Σ along Q₂, θ = 2.094, after t = ")
    explorer.kept()
    (x, y), (u, v) = [tuple(map(float, entry.split(","))) for entry in starts(explorer).split(";")]
    assert (x, y, u, v) == pytest.approx((-0.4, 0.3, 1.2, 0.8), abs=0.02)
    again = open_page().open("?panel=orbits&orbits=" + starts(explorer).replace(";", "%3B"))
    assert again.find(".orbit-goes").all_text_contents() == explorer.find(".orbit-goes").all_text_contents()
    assert explorer.complaints == []


def test_a_limit_direction_is_turned_by_hand_and_by_keys(open_page):
    """f changes by as little as it can: across that direction."""
    explorer = open_page().open("?f1=-0.5&a=-2&d=-1&b=0")
    page = explorer.page

    def drawn():
        found = explorer.ask("picture.state.header.equator")
        return np.column_stack([found["x"], found["y"]])

    start, goal = drawn()[1], np.array([math.cos(1.7), math.sin(1.7)])
    page.mouse.move(*place(explorer, *start))
    explorer.find(".card").filter(has_text="f follows").wait_for()
    page.mouse.down()
    for share in (0.3, 0.7, 1.0):
        page.mouse.move(*place(explorer, *(1.1 * (start + share * (goal - start)))))
        explorer.painted()
    page.mouse.up()
    explorer.settle()
    assert min(np.linalg.norm(drawn() - goal, axis=1)) < 0.02
    explorer.kept()
    f = np.array([float(explorer.find(f"[data-control={name}] .number").input_value()) for name in ("f1", "f2")])
    assert (f - (-0.5, 0.0)) @ goal == pytest.approx(0.0, abs=0.02)
    assert starts(explorer) is None
    explorer.press(".objects [data-object=Q2]", "Shift+ArrowRight")
    assert min(np.linalg.norm(drawn() - (math.cos(1.6), math.sin(1.6)), axis=1)) < 0.02
    assert explorer.complaints == []


def test_a_drag_takes_the_orbit_along_and_its_start_can_be_moved_later(open_page):
    explorer = open_page().open("?panel=orbits&preset=case1-ncm2")
    page = explorer.page
    page.mouse.move(*place(explorer, -0.4, 0.3))
    page.mouse.down()
    first = explorer.frame()
    for step in range(1, 9):
        page.mouse.move(*place(explorer, -0.4 + 0.1 * step, 0.3))
        explorer.painted()
    page.mouse.up()
    explorer.settle()
    assert explorer.frame() >= first + 3  # it followed
    assert explorer.find(".orbit-list li").count() == 1
    assert explorer.find(".orbit-goes").text_content() == "Comes down to Q₁ and leaves Σ along θ = 0."
    explorer.drag(place(explorer, 0.4, 0.3), place(explorer, 1.3, 0.5))
    assert explorer.find(".orbit-list li").count() == 1
    assert explorer.find(".orbit-goes").text_content() == "Leaves the picture."


def test_an_orbit_is_named_hidden_and_removed(open_page):
    explorer = open_page().open("?panel=orbits&orbits=-0.4,0.3%3B0.2,-0.5")
    explorer.find(".orbit-name").first.fill("mine")
    explorer.find(".orbit-name").first.press("Enter")
    explorer.find(".orbit-list .hide").nth(1).click()
    explorer.settle()
    assert explorer.find(".orbit-goes").all_text_contents()[1] == "hidden"
    explorer.kept()
    assert starts(explorer) == "-0.4,0.3:mine;0.2,-0.5,-"
    explorer.find(".orbit-list .remove").first.click()
    explorer.settle()
    assert explorer.find(".orbit-list li").count() == 1
    explorer.click(".clear")
    assert explorer.find(".orbit-list li").count() == 0


def test_orbits_stay_through_every_slider_move(open_page):
    explorer = open_page().open("?panel=orbits&orbits=1.2,0.8")
    before = explorer.find(".orbit-goes").text_content()
    explorer.type("f1", "-1.5")
    assert explorer.find(".orbit-list li").count() == 1
    assert explorer.find(".orbit-goes").text_content() != before


def objects(explorer, kind):
    """Where the objects of a kind are, in the picture."""
    columns = explorer.ask(f"picture.state.header.{kind}")
    return list(zip(columns["x"], columns["y"], strict=True))


def test_a_click_on_an_object_pins_it_and_one_elsewhere_launches(open_page):
    explorer = open_page().open("?b=0.3&panel=orbits&layers=inside,launched,equator,critical")
    page, pinned = explorer.page, explorer.find(".card.pinned")
    at = objects(explorer, "critical")[0]
    page.mouse.click(*place(explorer, *at))
    explorer.kept()
    assert pinned.text_content().startswith("×C stable node(c, s)")
    assert "pinned=C" in page.url
    drawn = [item["kind"] for item in explorer.ask("picture.above.list")]
    assert drawn == ["ray"] * 4 + ["ring", "path", "path", "mark", "label"]  # and the motion from the typed start
    page.keyboard.press("Escape")  # the picture has no focus
    explorer.kept()
    assert not pinned.is_visible()
    page.mouse.click(*place(explorer, *at))
    explorer.kept()
    page.mouse.click(*place(explorer, at[0] + 0.2, at[1]))
    explorer.kept()
    assert explorer.find(".orbit-list li").count() == 1
    before = pinned.text_content()
    explorer.type("f1", "-0.3")  # the pin follows its object
    explorer.settle()
    assert pinned.text_content() != before
    ring = next(item for item in explorer.ask("picture.above.list") if item["kind"] == "ring")
    assert (ring["x"], ring["y"]) == pytest.approx(objects(explorer, "critical")[0])
    explorer.kept()
    explorer.find(".undo").click()
    explorer.click(".undo")
    assert pinned.text_content() == before
    page.keyboard.press("Escape")
    explorer.kept()
    assert not pinned.is_visible()
    assert "pinned" not in page.url
    assert explorer.complaints == []


def test_a_tap_on_an_object_pins_it(open_page):
    explorer = open_page(**PHONE).open("?b=0.3&panel=orbits")
    explorer.page.touchscreen.tap(*place(explorer, *objects(explorer, "critical")[0]))
    explorer.settle()
    assert explorer.find(".card.pinned").text_content().startswith("×C stable node")
    assert explorer.find(".orbit-list li").count() == 0
    explorer.page.touchscreen.tap(*place(explorer, 1.1, 0.9))
    explorer.settle()
    assert explorer.find(".orbit-list li").count() == 1
    assert explorer.find(".card.pinned").is_visible()


def test_a_typed_start_is_in_the_link_undone_and_let_move_from_a_launched_orbit(open_page):
    explorer = open_page().open("?panel=orbits&orbits=1.2,0.8&z=0.25")
    assert explorer.find("[data-control=t_end]").is_hidden()
    explorer.click(".orbit-time .here").kept()
    box = explorer.find("[data-control=launch] input")
    r = (1.2**2 + 0.8**2) ** 0.5
    start = [float(word) for word in box.input_value().split(",")]
    assert start == pytest.approx([1.2 * (r - 1) / r, 0.8 * (r - 1) / r, 0.25], abs=1e-5)
    explorer.page.wait_for_selector(".phases li")
    explorer.press(".orbit-eps input", "Space").kept()
    assert explorer.find("[data-control=log_eps]").is_visible()
    assert "broken line and bands: ε = 0.01" in explorer.find(".orbit-key").text_content()
    query = explorer.page.evaluate("location.search")
    again = open_page().open(query)
    again.page.wait_for_selector(".phases li")
    assert again.find(".orbit-typed.chosen").count() == 1
    assert again.find(".orbit-note").text_content() == explorer.find(".orbit-note").text_content() != ""
    for _ in range(2):
        explorer.page.keyboard.press("Control+z")
        explorer.kept()
    assert box.input_value() == "0.6, 0.8, 0"
    assert explorer.find(".orbit-list li.chosen").count() == 1
    box.fill("0.6, 0.8")
    box.press("Enter")
    explorer.settle()
    assert "give 3 numbers" in explorer.find(".orbit-note").text_content()
    assert again.complaints == explorer.complaints == []
