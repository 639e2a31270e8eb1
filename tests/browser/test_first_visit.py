"""The bubbles of a first visit, which never come again, and the sheet of keys and marks."""

import pytest

pytestmark = pytest.mark.browser

PHONE = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True}


def test_drag_click_read_and_never_again(open_page):
    explorer = open_page(first_visit=True).open()
    hint = explorer.find(".hint")
    assert hint.text_content().startswith("Drag a slider")
    explorer.find("#c2-f1").press("ArrowRight")
    explorer.settle()
    assert hint.text_content().startswith("Click or tap")
    box = hint.bounding_box()  # what is below a bubble is reached through it
    explorer.page.mouse.click(box["x"] + 0.5 * box["width"], box["y"] + 10)  # no curve is there
    explorer.settle()
    assert explorer.ask("picture.state.header.launched.x.length") == 1
    assert hint.text_content().startswith("Read here")
    explorer.page.keyboard.press("Escape")
    assert hint.count() == 0
    explorer.open()
    assert hint.count() == 0
    assert explorer.complaints == []


def test_by_the_keyboard_and_on_a_phone(open_page):
    explorer = open_page(first_visit=True, **PHONE).open()
    hint = explorer.find(".hint")
    assert hint.get_attribute("role") == "status"
    for words in ("Drag", "Click", "Read"):
        assert hint.text_content().startswith(words)
        box = hint.bounding_box()
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= 390
        assert box["y"] >= 0
        assert box["y"] + box["height"] <= 844
        hint.locator("button").first.press("Enter")
    assert hint.count() == 0


def test_none_in_a_frame_of_another_page(open_page):
    assert open_page(first_visit=True).open("?embed=1").find(".hint").count() == 0


@pytest.mark.parametrize("options", [{}, PHONE], ids=["desktop", "phone"])
def test_the_sheet_of_keys_and_marks_is_there_on_demand(open_page, options):
    explorer = open_page(**options).open()
    sheet = explorer.find("dialog.helping")
    explorer.page.keyboard.press("?")
    assert sheet.is_visible()
    for words in ("Keys and hands", "Shift and drag", "eigenvector, stable", "Approach outcomes", "Limit direction Q"):
        assert words in sheet.text_content()
    assert sheet.evaluate("(it) => it.scrollWidth <= it.clientWidth")
    explorer.page.keyboard.press("Escape")
    assert not sheet.is_visible()
    if not options:  # the controls of a phone are in a sheet of their own
        explorer.find("[data-control=f1] .number").press("?")
        assert not sheet.is_visible()
    explorer.find(".help").click()
    assert sheet.is_visible()
    assert explorer.complaints == []
