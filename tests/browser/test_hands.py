"""Hands on the picture: a click, a drag, a tap; what is launched stays, is in the link, and is told in words."""

import pytest
from codim2_app.picture.draw.theme import HALF_VIEW


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
