"""For the beamer: the picture is large, letters too; controls fade and come back; Esc ends it."""

WIDE = {"width": 1280, "height": 720}
SHOWN = "Number(getComputedStyle(root.querySelector('.controls')).opacity)"


def test_the_picture_fills_the_screen_controls_fade_and_come_with_the_pointer(open_page):
    page = open_page(viewport=WIDE).open("?v=1&panel=numbers")
    width, labels = (
        page.find(".picture").bounding_box()["width"],
        "picture.list.find((item) => item.kind === 'label').size",
    )
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
    page.find(".undo").press("Enter")
    page.kept()
    assert page.find(".codim2.beamer").count() == 1  # how it is looked at is no step
    assert page.complaints == []


def test_a_letter_that_is_typed_is_no_key(open_page):
    page = open_page(viewport=WIDE).open("?v=1&system=own&panel=numbers")
    page.find("textarea[data-box=U1]").press("b")
    page.settle()
    assert page.find(".codim2.beamer").count() == 0
