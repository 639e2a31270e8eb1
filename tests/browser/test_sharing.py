"""The dialog "Share", and the page in a frame of another one."""

from urllib.error import HTTPError
from urllib.parse import quote
from urllib.request import urlopen

import pytest

pytestmark = pytest.mark.browser


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
    if len(link) <= 300:  # a longer one has no code
        page.find(".qr").wait_for()
        page.find(".qr").evaluate("(code) => code.decode()")  # refused if it is no picture
    assert "&s=" in link
    fresh = open_page().open(link.split("/")[-1])
    assert fresh.find("textarea[data-box=U2]").input_value() == "-q*s + 0.2*c"
    assert fresh.find("select.preset").input_value() == "case3-n3"
    assert fresh.ask("picture.seen") == pytest.approx([-0.5, 0.75, -1, 0.25])
    assert fresh.name() == page.name()
    page.page.keyboard.press("Escape")
    assert not page.find("dialog.sharing").is_visible()
    assert page.complaints == fresh.complaints == []


def test_the_code_is_of_the_text_that_is_asked_for(server):
    import segno

    with urlopen(f"{server}/qr.svg?text={quote('http://a.b/?v=1&x')}") as answer:
        drawn = answer.read().decode()
        assert answer.headers["Content-Type"] == "image/svg+xml"
    size = segno.make_qr("http://a.b/?v=1&x", error="l").symbol_size(border=3)
    assert f'viewBox="0 0 {size[0]} {size[1]}"' in drawn
    for text in ("", "x" * 3000):
        with pytest.raises(HTTPError) as caught:
            urlopen(f"{server}/qr.svg?text={text}")
        with caught.value as answer:
            assert answer.code == 400


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
