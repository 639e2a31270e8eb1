from urllib.parse import parse_qs, urlparse

import pytest
from codim2_app.picture.state.controls import NUMBERS
from codim2_app.picture.state.portraits import portraits

ELSEWHERE = {"n", "z2", "z3", "z4", "log_eps", "t_end"}  # of Hill's Ψ, of other systems, of the panel "Motion"
SLIDERS = [name for name in NUMBERS if name not in ELSEWHERE]


def test_page_asks_nobody_else_and_says_nothing(explorer):
    assert explorer.name() == "CM4"
    hosts = {urlparse(url).netloc for url in explorer.requests if not url.startswith(("data:", "blob:"))}
    assert hosts == {urlparse(explorer.address).netloc}
    assert explorer.complaints == []


def test_first_picture_comes_with_the_page(open_page):
    page = open_page(java_script_enabled=False)
    page.page.goto(page.address)
    assert page.find(".first svg path").count() >= 5
    assert page.name() == "CM4"


@pytest.fixture(scope="module")
def walked(tabs):
    """One page on which all portraits and sliders are tried, as by someone who stays."""
    with tabs.page() as page:
        yield page.open()
        assert page.complaints == []


@pytest.mark.parametrize("name", SLIDERS)
def test_each_slider_redraws(walked, name):
    explorer, words = walked, ".inspector" if name in ("B1", "B2", "g0") else ".picture"
    explorer.find("select.preset").select_option(portraits()[0]["key"])  # which resets what others moved
    explorer.settle()
    if name in ("k1", "k2", "B2"):  # these act only away from z = 0, and where C has s != 0
        explorer.type("z", "0.7").type("f2", "0.3")
    before = explorer.find(words).screenshot()
    frame = explorer.frame()
    slider = explorer.find(f"#c2-{name}")
    slider.focus()
    slider.press("ArrowRight")
    slider.press("PageUp")
    slider.press("PageUp")
    explorer.settle()
    assert explorer.frame() > frame
    assert explorer.find(words).screenshot() != before


def test_fast_drag_ends_on_the_last_value_and_queues_nothing(explorer):
    box = explorer.find("#c2-f1").bounding_box()
    y = box["y"] + box["height"] / 2
    explorer.page.mouse.move(box["x"] + 0.42 * box["width"], y)
    explorer.page.mouse.down()
    for i in range(100):
        explorer.page.mouse.move(box["x"] + (0.42 + 0.004 * i) * box["width"], y)
    explorer.page.mouse.up()
    explorer.settle()
    last = explorer.find("[data-control=f1] .number").input_value()
    assert float(last) == pytest.approx(1.9, abs=0.3)
    explorer.kept()
    assert parse_qs(urlparse(explorer.page.url).query)["f1"] == [last]
    name, numbers = explorer.name(), explorer.find(".critical-table").text_content()
    fresh = explorer.open(f"?f1={last}")
    assert (fresh.name(), fresh.find(".critical-table").text_content()) == (name, numbers)
