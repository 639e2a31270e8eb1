"""What a person does with the panels: open them, pick parameters, click special points, drag across the atlas."""

import re
from urllib.parse import parse_qs, urlparse

import pytest

#: Elements of the inspector whose content is wider than they are.
TOO_WIDE = """() => {
    const all = (root) => [...root.querySelectorAll('*')].flatMap((e) => e.shadowRoot ? [e, ...all(e.shadowRoot)] : [e])
    return all(document)
        .filter((e) => e.closest('.inspector') && e.offsetParent)
        .filter((e) => !e.matches('.frames')) // the film strip scrolls
        .filter((e) => e.scrollWidth > e.clientWidth + 1 && getComputedStyle(e).display !== 'inline')
        .map((e) => e.className) }"""

OWN = ["Atlas", "Numbers", "Planes", "Diagram", "Theorems", "Along z", "3-D", "Motion", "Response", "Ψ", "Census"]


def value(explorer, name):
    return float(explorer.find(f"[data-control={name}] .number").input_value())


def open_panel(explorer, words):
    explorer.find(".tabs").get_by_role("tab", name=words, exact=True).click()
    return explorer.settle()


def choose(explorer, name, option):
    return explorer.choose(f"select.{name}", option)


def drag(explorer, selector, *places):
    """Press at the first place, given in parts of width and height, and move through the others."""
    explorer.find(selector).scroll_into_view_if_needed()
    box = explorer.find(selector).bounding_box()
    points = [(box["x"] + u * box["width"], box["y"] + v * box["height"]) for u, v in places]
    explorer.page.mouse.move(*points[0])
    explorer.page.mouse.down()
    for point in points[1:]:
        explorer.page.mouse.move(*point, steps=8)
        yield point
    explorer.page.mouse.up()
    explorer.settle()


def test_a_tab_opens_its_panel_and_the_address_keeps_it(explorer):
    for words in OWN:
        open_panel(explorer, words)
        tab = explorer.find("[role=tab][aria-selected=true]")
        assert tab.text_content() == words
        assert explorer.find("[role=tabpanel]:visible").count() == 1
        assert explorer.find(f"#{tab.get_attribute('aria-controls')}").is_visible()
        explorer.kept()
        name = tab.get_attribute("data-panel")
        if words != "Atlas":  # that one is open from the start
            assert parse_qs(urlparse(explorer.page.url).query)["panel"] == [name]
        if words in OWN[::5]:
            explorer.reload()
            assert explorer.find("[role=tabpanel]:visible").count() == 1
            assert explorer.find(f"[role=tabpanel][data-panel={name}]").is_visible()


def test_only_keys_ring_a_chart(explorer):
    ring = "(e) => [e.matches(':focus'), getComputedStyle(e).outlineStyle]"
    pad = explorer.find("svg.pad")
    pad.click(position={"x": 60, "y": 60})
    assert pad.evaluate(ring) == [True, "none"]
    explorer.page.keyboard.press("ArrowRight")
    assert pad.evaluate(ring) == [True, "solid"]


def test_portrait_changes_while_the_atlas_is_dragged(explorer):
    wanted = iter(("CM2", "NCM2"))
    for _ in drag(explorer, ".pad", (0.5, 0.5), (0.72, 0.5), (0.95, 0.95)):
        name = next(wanted)  # while the pointer is down
        explorer.page.locator(".portrait-name", has_text=re.compile(f"^{name}$")).wait_for()
        explorer.page.locator(".pad .tag", has_text=re.compile(rf"^{name}\b")).wait_for(state="attached")
    assert next(wanted, None) is None


def test_the_words_of_the_ring_leave_a_phone_its_place(open_page):
    page = open_page(viewport={"width": 390, "height": 844}).open()
    before = page.find(".hero").bounding_box()["height"]
    page.layer("outcomes").check()
    page.settle()
    assert page.find(".hero").bounding_box()["height"] < before + 8


SPILLS = """() => {
  const foot = root.querySelector(".gallery").getBoundingClientRect(), page = document.documentElement
  const over = ["bench", "picture", "legend", "inspector", "tab-row", "panel-atlas .pad"].filter((name) => {
    const one = root.querySelector(`.${name}`), {bottom, right} = one.getBoundingClientRect()
    const drawn = !name.endsWith(".pad") || !root.classList.contains("twofold") // of two, panels are drawn up by a hand
    return drawn && one.checkVisibility() && (bottom > foot.top + 1 || right > innerWidth + 1)
  })
  const wide = page.scrollHeight > innerHeight || page.scrollWidth > innerWidth || foot.bottom > innerHeight
  return [...over, ...(wide ? ["page"] : [])]
}"""


@pytest.mark.parametrize("size", [(1024, 768), (1440, 900), (1920, 1080)])
def test_every_view_fits_its_window(open_page, size):
    page = open_page(viewport=dict(zip(("width", "height"), size, strict=True))).open("?v=1")
    page.find("[data-fold=slow]").evaluate("(it) => { it.open = false }")
    assert page.find(".controls").evaluate("(e) => e.scrollHeight <= e.clientHeight") or size[0] < 1440
    box = page.find(".picture").bounding_box()
    assert box["width"] == pytest.approx(box["height"], abs=1)
    page.find("[data-fold=atlas] summary").click()
    keys = page.find(".gallery [data-preset]").evaluate_all("(all) => all.map((one) => one.dataset.preset)")
    for key in keys[::3]:
        page.click(f".gallery [data-preset={key}]").painted()
        assert page.ask(f"({SPILLS})()") == [], key
    page.find(".reset").click()
    for tab in page.find(".tabs [role=tab]").all():
        tab.click()
        page.settle().painted()
        assert page.ask(f"({SPILLS})()") == [], tab.text_content()
        assert page.page.evaluate(TOO_WIDE) == [], tab.text_content()
    page.open("?v=1&beside=psi%3Dhill%26n%3D3").painted()
    assert page.ask(f"({SPILLS})()") == []
