"""What a person does with the panels: open them, pick parameters, click special points, drag across the atlas."""

import re
from urllib.parse import parse_qs, urlparse

import pytest

from .drawn import plots

#: Elements of the inspector whose content is wider than they are; the strip of tabs may be drawn sideways on a phone.
TOO_WIDE = """() => {
    const all = (root) => [...root.querySelectorAll('*')].flatMap((e) => e.shadowRoot ? [e, ...all(e.shadowRoot)] : [e])
    return all(document)
        .filter((e) => e.closest('.inspector') && !(innerWidth < 500 && e.matches('.tabs')) && e.offsetParent)
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


def part_of(explorer, selector, x, y):
    """Where values of the axes are in a chart, in parts of its width and height."""
    box = explorer.find(selector).bounding_box()
    across, up = plots(explorer, selector)[0].pixels(x, y)
    return across / box["width"], up / box["height"]


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


@pytest.mark.parametrize(("width", "height"), [(1440, 900), (1180, 800), (390, 844)])
def test_controls_and_tabs_fit(open_page, width, height):
    page = open_page(viewport={"width": width, "height": height}).open()
    for words in OWN:
        open_panel(page, words)
        assert page.page.evaluate("document.documentElement.scrollWidth <= innerWidth")
        wide = page.page.evaluate(TOO_WIDE)
        assert wide == [], words
    if (width, height) == (1440, 900):
        page.find("[data-fold=slow]").evaluate("(it) => { it.open = false }")
        assert page.find(".controls").evaluate("(e) => e.scrollHeight <= e.clientHeight")
    box = page.find(".picture").bounding_box()
    assert box["width"] == pytest.approx(box["height"], abs=1)
    assert 0 <= box["x"] <= box["x"] + box["width"] <= width
    assert page.complaints == []


def test_portrait_changes_while_the_atlas_is_dragged(explorer):
    wanted = iter(("CM2", "NCM2"))
    for _ in drag(explorer, ".pad", (0.5, 0.5), (0.72, 0.5), (0.95, 0.95)):
        name = next(wanted)  # while the pointer is down
        explorer.page.locator(".portrait-name", has_text=re.compile(f"^{name}$")).wait_for()
        explorer.page.locator(".pad .tag", has_text=re.compile(rf"^{name}\b")).wait_for(state="attached")
    assert next(wanted, None) is None


def test_a_small_portrait_is_clicked(explorer):
    tiles = explorer.find(".thumbnails button")
    tiles.first.wait_for()
    assert tiles.count() == 4
    assert explorer.find(".thumbnails .here").text_content() == "CM4, stable node"
    tiles.filter(has_text="NCM2").click()
    explorer.settle()
    assert explorer.name() == "NCM2"
    assert explorer.find(".thumbnails .here").text_content() == "NCM2"


def test_pointing_at_a_region_marks_its_small_portrait(explorer):
    explorer.find(".thumbnails button").first.wait_for()
    box = explorer.find(".pad").bounding_box()
    explorer.page.mouse.move(box["x"] + 0.05 * box["width"], box["y"] + 0.05 * box["height"])
    assert explorer.find(".thumbnails .pointed").text_content() == "NCM2"
    explorer.find(".thumbnails button").filter(has_text="CM4").hover()
    assert explorer.find(".pad .region.pointed").get_attribute("data-region") == "CM4, stable node"


def test_a_bar_of_the_census_opens_a_portrait_of_its_name(explorer):
    open_panel(explorer, "Census")
    bars = explorer.find(".census-list button")
    explorer.find(".census-portrait svg").first.wait_for()
    assert bars.count() == 13
    assert explorer.find(".census-list .here .census-name").text_content() == "I CM4"
    bars.filter(has_text="II NCM4").first.click()
    explorer.settle()
    assert explorer.name() == "NCM4"
    assert explorer.find(".census-list .here .census-name").text_content() == "II NCM4"
    explorer.kept()


@pytest.mark.slow
def test_other_axes_of_the_atlas(explorer):
    choose(explorer, "across", "a")
    choose(explorer, "up", "d")
    explorer.find(".pad .region").first.wait_for()
    assert "det A = 0" in explorer.find(".pad-curves").text_content()
    assert explorer.find(".pad .tag").text_content() == "CM4, stable node"
    for _ in drag(explorer, ".pad", (0.25, 0.62), part_of(explorer, ".pad", -2.4, 2.4)):
        explorer.page.locator(".portrait-case", has_text=re.compile("^Case II$")).wait_for()
    assert value(explorer, "a") == pytest.approx(-2.4, abs=0.05)
    assert value(explorer, "d") == pytest.approx(2.4, abs=0.05)
    assert explorer.find(".pad .tag").text_content() == "CM4, saddle"
    choose(explorer, "up", "a")
    assert "two different" in explorer.find(".atlas-note").text_content()
    choose(explorer, "across", "f1")
    choose(explorer, "up", "f2")
    assert explorer.find(".pad .region").count() > 1
    assert "two different" not in explorer.find(".atlas-note").text_content()


def test_the_atlas_is_narrowed_around_the_handle(explorer):
    explorer.click(".panel-atlas .zoom .in")
    assert explorer.find(".pad .tag").text_content() == "CM4, stable node"
    box = explorer.find(".pad").bounding_box()
    explorer.page.mouse.click(box["x"] + 0.5 * box["width"], box["y"] + 0.3 * box["height"])
    explorer.settle()
    assert 0 < value(explorer, "f2") < 0.75
    explorer.click(".panel-atlas .zoom .out")
    assert explorer.find(".panel-atlas .zoom .out").is_disabled()


def test_a_special_point_is_gone_to_exactly(open_page):
    page = open_page().open("?preset=case3-n3&panel=diagram&along=n")
    page.find(".diagram .cycle").first.wait_for()
    page.click(".frames button[title^=Hopf]").kept()
    assert float(parse_qs(urlparse(page.page.url).query)["n"][0]) == pytest.approx(284 / 129, abs=1e-12)
    assert "here" in page.find(".frames button[title^=Hopf]").get_attribute("class")
    assert page.find(".happens").inner_text().startswith("At Hopf, n = 2.20155: ")
    page.find(".panel-diagram .play").click()
    page.find(".happens").filter(has_text="After Hopf").wait_for()
    page.find(".panel-diagram .play").click()
    page.find(".diagram .special").first.click()
    page.kept()
    assert float(parse_qs(urlparse(page.page.url).query)["n"][0]) == pytest.approx(4 / 3, abs=1e-9)
    assert page.complaints == []


def test_the_diagram_sets_its_parameter(explorer):
    open_panel(explorer, "Diagram")
    explorer.choose(".panel-diagram select.along", "d")
    for _ in drag(explorer, ".diagram", (0.3, 0.5), (0.8, 0.5)):
        pass
    assert value(explorer, "d") > 1.5
    explorer.press(".diagram", "ArrowRight")
    where = value(explorer, "d")
    explorer.click(".panel-diagram .zoom .in")
    low, high = (float(explorer.find(".diagram").get_attribute(f"aria-value{end}")) for end in ("min", "max"))
    assert high - low == pytest.approx(2.0)
    assert low < where < high
    line = explorer.find(".diagram .value").get_attribute("d")
    explorer.type("d", str(where + 0.1))
    assert explorer.find(".diagram .value").get_attribute("d") != line


def test_a_slider_leaves_a_trail_in_the_planes(open_page):
    page = open_page().open("?preset=case3-n2&panel=planes")
    assert page.find(".trace-plane .over").count() == 1
    assert "n = 4" in page.find(".plane-table").text_content()
    slider = page.find("#c2-n")
    slider.focus()
    for _ in range(5):
        slider.press("PageUp")
        page.settle()
    assert page.find(".trace-plane .trail").count() >= 5
    assert page.find(".eigen-plane .trail").count() == 2 * page.find(".trace-plane .trail").count()
    assert "unstable" in page.find(".trace-plane").get_attribute("aria-label")
    assert page.complaints == []


def test_outcomes_are_told_by_ring_and_table(open_page):
    page = open_page().open("?preset=case1-ncm4&panel=numbers")
    assert not page.find(".outcome-key").is_visible()
    before = page.picture()
    page.layer("outcomes").check()
    page.settle()
    assert page.find(".outcome-key").is_visible()
    assert page.picture() != before
    rows = page.find(".outcome-table li")
    assert rows.count() == 4
    assert rows.filter(has_text="Q₃").locator(".outcome.cross").count() == 1
    page.choose("select.preset", "case3-n3")
    open_panel(page, "Numbers")
    assert "slides around cycle 1" in page.find(".outcome-table").text_content()
    assert page.complaints == []


def test_the_words_of_the_ring_leave_a_phone_its_place(open_page):
    page = open_page(viewport={"width": 390, "height": 844}).open()
    before = page.find(".hero").bounding_box()["height"]
    page.layer("outcomes").check()
    page.settle()
    assert page.find(".hero").bounding_box()["height"] < before + 8


def test_theorems_come_with_their_numbers_and_follow(explorer):
    rows = explorer.find(".theorem-list li")
    assert rows.count() == 0
    open_panel(explorer, "Theorems")
    claim = rows.filter(has_text="Theorem 4.3(c)")
    assert "This portrait is CM4." in claim.text_content()
    assert "limit directions" in claim.locator("table").text_content()
    explorer.type("f1", "3")
    assert "This portrait is NCM2." in rows.filter(has_text="Theorem 4.3(c)").text_content()
    assert rows.filter(has_text="✗").count() == 0


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
    page.find("[data-fold=atlas] summary").click()
    keys = page.find(".gallery [data-preset]").evaluate_all("(all) => all.map((one) => one.dataset.preset)")
    for key in keys:
        page.click(f".gallery [data-preset={key}]").painted()
        assert page.ask(f"({SPILLS})()") == [], key
    page.find(".reset").click()
    for tab in page.find(".tabs [role=tab]").all():
        tab.click()
        page.settle().painted()
        assert page.ask(f"({SPILLS})()") == [], tab.text_content()
    page.open("?v=1&beside=psi%3Dhill%26n%3D3").painted()
    assert page.ask(f"({SPILLS})()") == []
