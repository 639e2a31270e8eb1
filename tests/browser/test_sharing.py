"""The dialog "Share", and the page in a frame of another one."""

import pytest

from tests.app.static.test_qr_codes import code_of

from .conftest import PHONE

#: What is dark in the middle of each square of a code, as the browser paints it.
SQUARES = """async (code) => {
  await code.decode()
  const side = decodeURIComponent(code.src).match(/viewBox="0 0 (\\d+)/)[1] * 1
  const canvas = Object.assign(document.createElement("canvas"), {width: 8 * side, height: 8 * side})
  const paint = canvas.getContext("2d", {willReadFrequently: true})
  paint.drawImage(code, 0, 0, 8 * side, 8 * side)
  const dark = (x, y) => Number(paint.getImageData(8 * x + 4, 8 * y + 4, 1, 1).data[0] < 128)
  return Array.from({length: side - 6}, (_, y) => Array.from({length: side - 6}, (_, x) => dark(x + 3, y + 3)))
}"""


def controls(page):
    """The controls that are seen."""
    shown = page.find(".control[data-control]:has(input):visible")
    return shown.evaluate_all("(all) => all.map((e) => e.dataset.control)")


def test_the_link_opens_the_same_view_and_is_in_the_code_for_phones(open_page):
    page = open_page().open()
    page.find("select.preset").select_option("case3-n3")
    page.settle().find(".system-box select").select_option("own")
    page.settle().find("textarea[data-box=U2]").fill("-q*s + 0.2*c")
    page.settle()
    page.ask("picture.seen = [-0.5, 0.75, -1, 0.25]")
    page.find(".share").click()
    link = page.find(".address").input_value()
    assert len(link) > 300
    page.find(".qr").wait_for()
    assert page.find(".qr").evaluate(SQUARES) == code_of(link)
    assert "&s=" in link
    fresh = open_page().open(link.split("/")[-1])
    assert fresh.find("textarea[data-box=U2]").input_value() == "-q*s + 0.2*c"
    assert fresh.find("select.preset").input_value() == "case3-n3"
    assert fresh.ask("picture.seen") == pytest.approx([-0.5, 0.75, -1, 0.25])
    assert fresh.name() == page.name()
    page.page.keyboard.press("Escape")
    assert not page.find("dialog.sharing").is_visible()
    assert page.complaints == fresh.complaints == []


@pytest.mark.parametrize("size", [(640, 620), (1280, 800), (360, 640)])
def test_an_embedded_page_is_the_picture_and_the_controls_that_it_names(open_page, size):
    page = open_page(viewport={"width": size[0], "height": size[1]}).open("?embed=1&controls=f1,n&f1=-1.5")
    shown = controls(page)
    assert shown == ["f1"]  # n is a control of another family of Psi
    assert not page.find(".tabs, .legend, .sheets, .share").filter(visible=True).count()
    box = page.find(".picture").bounding_box()
    assert box["width"] > 0.5 * min(size)
    assert page.page.evaluate("document.documentElement.scrollHeight <= innerHeight")
    name = page.name()
    page.type("f1", "0")
    assert (name, page.name()) == ("CM2", "CM4")
    page.page.wait_for_function("() => location.search.includes('embed=1') && location.search.includes('f1=0')")
    with page.page.context.expect_page() as opened:
        page.find(".whole").click()
    whole = opened.value
    whole.wait_for_selector(".codim2[data-ready]")
    assert whole.locator(".tabs").is_visible()
    assert whole.locator("[data-control=f1] .number").input_value() == "0"
    assert page.complaints == []


@pytest.mark.parametrize("options", [{"color_scheme": "dark"}, PHONE])
def test_the_printed_page_is_the_picture_its_sentences_values_and_a_code(open_page, options):
    explorer = open_page(**options).open("?v=1&b=0.4")
    explorer.page.evaluate("window.dispatchEvent(new Event('beforeprint'))")
    explorer.page.emulate_media(media="print")
    explorer.page.set_viewport_size({"width": 718, "height": 1047})  # A4 within its margins
    explorer.painted()
    names = (".headline", ".sentence", ".on-paper canvas", ".on-paper p", ".on-paper img")
    seen = {name: explorer.find(name).bounding_box() for name in names}
    for one in seen.values():
        assert one["x"] >= 0
        assert one["x"] + one["width"] <= 718
        assert one["y"] + one["height"] <= 1047
    assert seen[".headline"]["y"] + seen[".headline"]["height"] <= seen[".on-paper canvas"]["y"]
    assert explorer.find(".on-paper p").text_content().startswith("a = −2, b = 0.4, d = −1")
    for name in (".controls", ".sheets", ".gallery", ".tab-row", ".bokeh", ".tools"):
        assert not explorer.find(name).is_visible()
    # a sentence too long for the screen is whole on paper, its last line too
    mask = "(it) => { it.classList.add('longer'); return getComputedStyle(it).maskImage }"
    assert explorer.find(".sentence").evaluate(mask) == "none"
    light = explorer.find(".on-paper canvas").evaluate("(it) => [...it.getContext('2d').getImageData(2, 2, 1, 1).data]")
    assert light == [255, 255, 255, 255]
    explorer.page.evaluate("window.dispatchEvent(new Event('afterprint'))")
    explorer.page.emulate_media(media="screen")
    assert explorer.find(".codim2").evaluate("(it) => it.classList.contains('dark')") == ("color_scheme" in options)
