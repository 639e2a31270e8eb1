"""The first ten seconds: what the page is about, one thing to do, and the sheet of keys and marks."""

import pytest

from .conftest import PHONE

pytestmark = pytest.mark.browser


def middle(box):
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def test_it_says_what_it_is_about_with_the_sliders_in_sight(open_page):
    explorer = open_page(first_visit=True, viewport={"width": 1440, "height": 900}).open()
    assert explorer.find("h1").is_visible()
    assert "(x, y)′ = A e + f + z k" in explorer.find(".top math:visible").get_attribute("aria-label")
    for name in ("a", "b", "d", "f1", "f2", "z", "psi"):
        box = explorer.find(f"[data-control={name}]").bounding_box()
        assert box["y"] + box["height"] < 900
    picture = explorer.find(".picture").bounding_box()
    assert picture["width"] > 0.46 * 1440
    assert explorer.page.evaluate("document.documentElement.scrollHeight") <= 900
    chips = [box.bounding_box() for box in explorer.find(".legend > .layer, .more > summary").all()]
    assert max(box["y"] for box in chips) - min(box["y"] for box in chips) < 8  # one row
    explorer.page.set_viewport_size({"width": 1024, "height": 768})
    assert explorer.find(".gallery").evaluate("(it) => it.scrollWidth <= it.clientWidth")
    assert explorer.complaints == []


def test_the_puck_slips_and_sticks_beside_the_sphere_and_a_dot_runs_on_it(open_page):
    explorer = open_page(viewport={"width": 1440, "height": 900}).open("?v=1&B1=0")
    dot = "picture.above.list.find((item) => item.kind === 'mark')"
    explorer.fill(".table input", "1.2")
    assert explorer.find("[data-control=f1] .number").input_value() == "-1.2"
    explorer.find(".table .play").click()
    explorer.until(f"Boolean(root.explorer.{dot})")
    start = explorer.ask(f"[{dot}.x, {dot}.y]")
    explorer.until("root.explorer.table.player.at > 4")
    end = explorer.ask(f"[{dot}.x, {dot}.y]")
    C = explorer.ask("[picture.state.header.critical.x[0], picture.state.header.critical.y[0]]")
    assert start[0] ** 2 + start[1] ** 2 > 1
    assert end == pytest.approx(C, abs=0.01)
    explorer.type("f2", "0.1")  # another system: what was played is left
    assert explorer.ask("picture.above.list.length") == 0
    assert explorer.complaints == []


def test_c_is_dragged_out_of_the_sphere_and_f_follows(open_page):
    explorer = open_page(first_visit=True).open()
    invitation = explorer.find(".grab .invitation")
    invitation.wait_for()  # the handle comes once the picture knows its own size
    mouse, start = explorer.page.mouse, explorer.find(".grab").bounding_box()
    x, y = middle(start)
    unit = explorer.ask("picture.pixel(1, 0).x - picture.pixel(0, 0).x")
    mouse.move(x, y)
    mouse.down()
    mouse.move(x + 0.5 * unit, y - 0.2 * unit, steps=4)
    explorer.settle()
    before = explorer.ask("picture.state.header.critical")
    assert explorer.find("[data-control=f2] .number").input_value() != "0"
    mouse.move(x + 1.5 * unit, y - 0.2 * unit, steps=4)
    explorer.settle()
    assert explorer.name().startswith("NCM")
    assert explorer.find(".grab-words").is_visible()
    assert "nothing slides" in explorer.find(".headline").text_content()
    mouse.up()
    explorer.kept()
    assert not explorer.find(".grab-words").is_visible()
    assert not invitation.is_visible()
    assert (before["x"][0], before["y"][0]) == pytest.approx((-0.2582 + 0.5, 0.2), abs=0.01)
    explorer.find(".grab").press("Shift+ArrowLeft")  # and back, by keys
    for _ in range(12):
        explorer.press(".grab", "Shift+ArrowLeft")
    assert explorer.name().startswith("CM")
    explorer.open()
    assert not invitation.is_visible()  # who has done it is not asked again
    assert explorer.complaints == []


def test_a_number_of_the_headline_is_dragged(explorer):
    number = explorer.find(".dragged[data-number=push]")
    x, y = middle(number.bounding_box())
    explorer.drag((x, y), (x + 160, y))
    assert explorer.find("[data-control=f1] .number").input_value() == "-1"
    assert number.text_content() == "1.00"


def test_nothing_moves_while_a_slider_does(open_page):
    explorer = open_page(viewport={"width": 1440, "height": 900}).open()
    places = [".tabs", ".picture", ".gallery", ".panel-atlas"]

    def tops():
        return [(box["x"], box["y"]) for box in (explorer.find(name).bounding_box() for name in places)]

    before = tops()
    for name, values in {"a": (-4, -1, 0, 1, 3), "f1": (-2, 0, 1, 3), "b": (0.2, 1, 3)}.items():
        for value in values:
            explorer.type(name, str(value))
            assert tops() == before, (name, value)


def test_a_portrait_is_entered_by_the_gallery_also_on_a_phone(open_page):
    for options in ({}, PHONE):
        explorer = open_page(**options).open()
        if options:
            explorer.find("[data-sheet=gallery]").click()
        explorer.click(".gallery [data-preset=case2-saddle]")
        assert explorer.find(".gallery .here").get_attribute("data-preset") == "case2-saddle"
        assert explorer.find("select.preset").input_value() == "case2-saddle"
        assert explorer.complaints == []


def test_what_is_one_step_away_stays_open_and_a_link_opens_what_it_sets(open_page):
    explorer = open_page()
    explorer.page.goto(f"{explorer.address}/")
    explorer.page.wait_for_selector(".codim2[data-ready]")
    fold = explorer.find("[data-fold=slow]")
    assert fold.get_attribute("open") is None
    fold.locator("summary").click()
    explorer.page.reload()
    explorer.page.wait_for_selector(".codim2[data-ready]")
    assert fold.get_attribute("open") is not None
    other = open_page()
    other.page.goto(f"{other.address}/?v=1&B2=0.5")
    other.page.wait_for_selector(".codim2[data-ready]")
    assert other.find("[data-control=B2]").is_visible()


@pytest.mark.parametrize("options", [{}, PHONE], ids=["desktop", "phone"])
def test_the_sheet_of_keys_and_marks_is_there_on_demand(open_page, options):
    explorer = open_page(**options).open()
    sheet = explorer.find("dialog.helping")
    explorer.page.keyboard.press("?")
    assert sheet.is_visible()
    said = ("Keyboard and mouse", "Shift and drag", "eigenvector, stable", "Approach outcomes", "Limit direction Q")
    assert [words for words in said if words not in sheet.text_content()] == []
    assert sheet.evaluate("(it) => it.scrollWidth <= it.clientWidth")
    explorer.page.keyboard.press("Escape")
    assert not sheet.is_visible()
    if not options:  # the controls of a phone are in a sheet of their own
        explorer.find("[data-control=f1] .number").press("?")
        assert not sheet.is_visible()
    explorer.find(".help").click()
    assert sheet.is_visible()
    assert explorer.complaints == []
