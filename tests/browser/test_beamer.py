"""For the beamer: the picture is large, letters too; controls fade and come back; Esc ends it."""

from urllib.parse import urlparse

WIDE = {"width": 1280, "height": 720}
SHOWN = "Number(getComputedStyle(root.querySelector('.controls')).opacity)"


def test_the_picture_fills_the_screen_controls_fade_and_come_with_the_pointer(open_page):
    page = open_page(viewport=WIDE).open("?v=1&panel=numbers")
    width, labels = page.find(".picture").bounding_box()["width"], "picture.list.find((it) => it.kind === 'label').size"
    size = page.ask(labels)
    page.page.keyboard.press("b")
    page.until("root.classList.contains('beamer')")
    assert page.find(".beam").get_attribute("aria-pressed") == "true"
    assert "beamer=1" in page.page.url
    assert page.find(".picture").bounding_box()["width"] > 1.1 * width
    assert page.ask(labels) > 1.5 * size
    assert page.find(".tabs").is_hidden()
    page.until(f"{SHOWN} === 0")
    page.page.mouse.move(500, 300)
    page.until(f"{SHOWN} === 1")
    page.type("f1", "-1.5")
    assert page.find(".portrait-name").text_content() == "CM2"
    page.page.wait_for_timeout(3500)
    assert page.find(".codim2").evaluate(f"(root) => {SHOWN}") == 1  # a control is in use
    page.find("[data-control=f1] .number").blur()
    page.until(f"{SHOWN} === 0")
    page.page.keyboard.press("Escape")
    page.until("!root.classList.contains('beamer')")
    assert page.ask(labels) == size
    assert page.find(".tabs").is_visible()
    assert "beamer" not in page.page.url
    page.open("?v=1&panel=numbers&beamer=1")  # a link to a lecture's first picture
    assert page.find(".codim2.beamer").count() == 1
    assert page.ask(labels) > 1.5 * size
    page.type("f1", "-1.5").kept()
    assert "beamer=1" in page.page.url
    page.press(".undo", "Enter").kept()
    assert page.find(".codim2.beamer").count() == 1  # how it is looked at is no step
    assert page.complaints == []


def test_a_letter_that_is_typed_is_no_key(open_page):
    page = open_page(viewport=WIDE).open("?v=1&system=own&panel=numbers")
    page.press("textarea[data-box=U1]", "b")
    assert page.find(".codim2.beamer").count() == 0


def test_a_panel_stands_next_to_the_picture_and_kept_views_are_run_through(open_page):
    page = open_page(viewport={"width": 1920, "height": 1080}).open("?v=1&beamer=2&panel=atlas")
    page.find(".panel-atlas .region").first.wait_for()
    picture, panel = (page.find(name).bounding_box() for name in (".picture", ".panel-atlas"))
    assert picture["width"] > 0.45 * 1920
    assert panel["x"] > picture["x"] + picture["width"] - 1
    assert panel["width"] > 0.4 * 1920
    assert page.find(".panel-atlas text.name").first.evaluate("(it) => it.getBoundingClientRect().height") > 14
    assert page.find(".controls").bounding_box()["y"] > picture["y"] + 0.9 * picture["height"]  # not over the picture
    keys = page.page.keyboard
    keys.press("k")
    page.type("f1", "-1.5")
    page.find("[data-control=f1] .number").blur()
    keys.press("k")
    keys.press("PageUp")
    page.until("root.explorer.values.f1 > -1.4 && root.explorer.values.f1 < -0.6")  # on its way
    page.until("root.explorer.values.f1 === -0.5").settle()
    keys.press("p")
    assert page.find(".panel-atlas").is_hidden()
    page.open("?v=1&beamer=1")  # they are kept in this browser
    assert page.find(".views button[data-view='1']").count() == 1
    page.find(".tools .share").click()
    page.find(".sharing .qr").wait_for()
    carried = urlparse(page.find(".sharing .address").input_value())
    other = open_page().open(f"?{carried.query}")  # and travel with a link
    other.page.keyboard.press("PageDown")
    other.page.keyboard.press("PageDown")
    other.until("root.explorer.values.f1 === -1.5")
    assert page.complaints == []
