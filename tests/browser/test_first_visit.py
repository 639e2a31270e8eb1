"""The first ten seconds: what the page is about, one thing to do, and the sheet of keys and marks."""

from itertools import pairwise

import pytest

from .conftest import PHONE


def middle(box):
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def test_it_says_what_it_is_about_with_the_sliders_in_sight(open_page):
    explorer = open_page(viewport={"width": 1440, "height": 900}).open()
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


CONTROLS = "button, input, select, textarea, summary, a[href], [role=tab]"
IN_SIGHT = f"""() => [...document.querySelectorAll(".codim2 :is({CONTROLS})")].filter((one) => {{
  const {{top, bottom, left, width, height}} = one.getBoundingClientRect()
  const seen = one.checkVisibility({{visibilityProperty: true, opacityProperty: true}})
  return seen && Math.min(width, height) > 6 && top < innerHeight - 4 && bottom > 0 && left < innerWidth
}}).length"""


@pytest.mark.parametrize("size", [(1024, 768), (1440, 900), (1920, 1080)])
def test_the_first_view_has_at_most_forty_controls_and_every_slider(open_page, size):
    explorer = open_page(first_visit=True, viewport=dict(zip(("width", "height"), size, strict=True)))
    explorer.page.goto(f"{explorer.address}/?v=1")
    explorer.page.wait_for_selector(".codim2[data-ready]")
    explorer.settle()
    assert explorer.page.evaluate(IN_SIGHT) <= 40
    foot = explorer.find(".gallery").bounding_box()["y"]
    for name in ("a", "b", "d", "f1", "f2", "z", "psi"):
        box = explorer.find(f"[data-control={name}]").bounding_box()
        assert box["y"] + box["height"] <= foot
    assert explorer.find(".puck").bounding_box()["height"] >= 180
    tabs = explorer.find(".tabs [role=tab]:visible")
    assert tabs.all_text_contents() == ["Lessons", "Atlas", "Numbers", "Motion"]
    explorer.find("[data-fold=tabs] summary").click()
    assert tabs.count() == 12
    explorer.reload()
    assert tabs.count() == 12  # remembered


def opening(open_page, query="", script="", **options):
    explorer = open_page(first_visit=True, **options)
    explorer.page.add_init_script(script)
    explorer.page.goto(f"{explorer.address}/{query}")
    explorer.page.wait_for_selector(".codim2[data-ready]")
    return explorer


#: Keeps all that the story says: each sentence stays for some seconds only.
STORY = """window.told = []
new MutationObserver(() => {
  const text = document.querySelector(".story")?.textContent
  if (text && window.told.at(-1) !== text) window.told.push(text)
}).observe(document, {subtree: true, childList: true, characterData: true})"""


def test_the_first_visit_begins_with_a_puck_that_comes_to_rest(open_page):
    explorer = opening(open_page, script=STORY)
    assert explorer.find(".puck").bounding_box()["height"] > 300
    assert "opposes the slip" in explorer.page.evaluate("window.told[0]")
    explorer.until("root.explorer.picture.lift.opened > 0.02 && root.explorer.picture.lift.opened < 0.98")
    outside = explorer.ask("picture.place")
    assert outside[0] ** 2 + outside[1] ** 2 > 1
    explorer.until("window.told.some((text) => text.includes('microscope'))")
    explorer.until("!root.classList.contains('storied')")
    C = explorer.ask("[picture.state.header.critical.x[0], picture.state.header.critical.y[0]]")
    assert explorer.ask("picture.place") == pytest.approx(C, abs=0.02)
    assert explorer.find(".headline").text_content().endswith("so it sticks.")
    explorer.until("!root.classList.contains('opening')")
    assert explorer.find(".controls").is_visible()
    assert explorer.ask("picture.lift.shown") is False
    explorer.page.goto(f"{explorer.address}/")
    explorer.page.wait_for_selector(".codim2[data-ready]")
    assert explorer.find(".controls").is_visible()  # once
    assert explorer.complaints == []


def test_any_touch_skips_the_opening_and_it_can_be_watched_again(open_page):
    explorer = opening(open_page, viewport={"width": 1024, "height": 768})
    explorer.page.mouse.click(300, 300)
    explorer.until("!root.classList.contains('opening')").settle()
    assert explorer.ask("root.explorer.values.orbits") == ""  # the touch that skips does nothing else
    explorer.find(".again").click()
    explorer.until("root.explorer.bench.moment && root.classList.contains('opening')")
    explorer.page.keyboard.press("Escape")
    explorer.until("!root.classList.contains('opening') && !root.explorer.picture.lift.shown")
    assert explorer.find(".legend").is_visible()
    assert explorer.complaints == []


@pytest.mark.parametrize(
    ("query", "options"), [("?a=-2", {}), ("", {"reduced_motion": "reduce"}), ("?v=1&embed=1", {})]
)
def test_a_link_and_a_visitor_without_motion_see_the_portrait_at_once(open_page, query, options):
    explorer = opening(open_page, query, **options)
    assert not explorer.find(".story").is_visible()
    assert explorer.find(".bokeh").is_visible()
    if "embed" not in query:
        assert "friction in use" in explorer.find(".state").text_content()


def test_a_phone_has_the_opening_and_the_puck_below_the_picture(open_page):
    explorer = opening(open_page, **PHONE)
    boxes = [explorer.find(name).bounding_box() for name in (".puck", ".story", ".skip", ".picture")]
    for above, below in pairwise(boxes):
        assert above["y"] + above["height"] <= below["y"] + 1
    assert boxes[-1]["y"] + boxes[-1]["height"] <= 845
    explorer.page.touchscreen.tap(200, 200)
    explorer.until("!root.classList.contains('opening')").settle()
    puck = explorer.find(".puck").bounding_box()
    assert puck["height"] >= 180
    assert puck["y"] + puck["height"] < 800
    assert explorer.complaints == []


#: a, b, d, f1, f2, z, k1.
RANDOM = [
    (-2, 0, -1, -0.5, 0, 0, 0),
    (-2, 0.7, -0.4, 1.1, -0.6, 0.5, 1),
    (-1, -1.5, -1, 2.4, 0.3, 0, 0),
    (-0.3, 0, -3, 0.1, 0.2, -1, 0.5),
    (1, 1.6, -2, -0.5, 0, 0, 0),
    (1, 0.5, 2, 0.3, 0.1, 0, 0),
    (-1, 0.1, 2, 0.2, 0.2, 0, 0),
    (-3, 2, -3, 3.4, -0.2, 1, -2),
    (-1, 0, -1, 0, 0, 0, 0),
]


#: Moves the puck; returns what its words and the headline's are on the way. Frames come as fast as they are drawn.
MOVED = """async (root, place) => {
    const read = (name) => root.querySelector(name).textContent, said = new Set()
    const own = window.requestAnimationFrame
    let now = 0
    window.requestAnimationFrame = (call) => setTimeout(() => call(now += 60), 0)
    const frame = () => said.add(`${read(".state").split(" ·")[0]} | ${read(".headline strong")}`)
    await root.explorer.bench.run(place, {frame})
    window.requestAnimationFrame = own
    return [...said] }"""


@pytest.mark.parametrize("i", range(len(RANDOM)))
def test_the_puck_never_contradicts_the_headline(open_page, i):
    setting, place = RANDOM[i], [(1.3, 0.9), (-1.2, 1.1), (0.4, -1.5)][i % 3]
    names = ("a", "b", "d", "f1", "f2", "z", "k1")
    query = "&".join(f"{name}={value}" for name, value in zip(names, setting, strict=True))
    explorer = open_page().open(f"?v=1&{query}").painted()
    puck, told = explorer.find(".state").text_content(), explorer.find(".headline strong").text_content()
    share = explorer.ask("Math.hypot(...(picture.state.header.critical.e[0] ?? [9]))")
    arrows = explorer.find(".puck .arrow").evaluate_all("(all) => all.map((one) => one.classList[1])")
    assert told in puck
    assert ("active contact" in puck) == (setting[0] > 0 or setting[2] > 0)
    if told == "sticks" and "active" not in puck:
        assert share < 1
        assert puck == f"sticks, {round(100 * share)} % of friction in use"
        assert "slip" not in arrows
    if told == "slips":
        assert "slip" in arrows
        assert "in use" not in puck
    said = explorer.find(".codim2").evaluate(MOVED, list(place))
    assert said
    for one in said:
        puck, headline = one.split(" | ")
        if puck == "slipping":
            assert headline.startswith("slips"), one
        if headline == "slips":
            assert puck in ("slipping", "at rest for an instant", "slips"), one
        if headline.startswith("sticks") and "luck" not in headline:
            assert (puck == "still slipping") == ("once slip stops" in headline), one
    assert explorer.complaints == []


def test_the_push_and_c_are_linked_both_ways_and_a_launched_orbit_is_slipped_along(open_page):
    explorer = open_page().open("?v=1&a=-1&d=-1&f1=-0.4")
    tip = """(() => {
        const head = [...root.querySelectorAll(".puck .push path")].at(-1).getBoundingClientRect()
        return [head.x + head.width / 2, head.y + head.height / 2] })()"""
    x, y = explorer.ask(tip)
    explorer.drag((x, y), (x + 10, y - 20), steps=5)
    f = explorer.ask("[root.explorer.values.f1, root.explorer.values.f2]")
    assert f[1] > 0.2
    C = explorer.ask("[picture.state.header.critical.x[0], picture.state.header.critical.y[0]]")
    assert pytest.approx(f, abs=0.01) == C  # A = -1
    before = explorer.find(".puck").inner_html()
    explorer.press(".grab", "Shift+ArrowRight").painted()
    assert explorer.find(".puck").inner_html() != before
    assert explorer.ask("root.explorer.values.f1") == pytest.approx(f[0] + 0.1, abs=0.01)
    place = explorer.ask("""(() => {
        const {x, y} = picture.pixel(0.8, 1.1), box = root.querySelector(".bokeh").getBoundingClientRect()
        return [box.x + x, box.y + y] })()""")
    explorer.page.mouse.click(*place)
    explorer.until(
        "root.querySelector('.state').textContent.startsWith('still slipping') && root.explorer.picture.place"
    )
    assert explorer.find(".headline strong").text_content() == "sticks once slip stops"
    assert explorer.ask("picture.place[1]") == pytest.approx(1.1, abs=0.3)
    explorer.until("root.querySelector('.state').textContent.startsWith('sticks')")
    assert explorer.find(".headline strong").text_content() == "sticks"


@pytest.mark.parametrize(("size", "longer"), [((1440, 900), False), ((1920, 1080), False), ((1024, 768), True)])
def test_a_long_sentence_is_seen_whole_or_fades_where_it_goes_on(open_page, size, longer):
    page = open_page(viewport=dict(zip(("width", "height"), size, strict=True))).open("?preset=case3-cycle")
    cut = page.find(".sentence").evaluate("(it) => it.scrollHeight > it.clientHeight + 2")
    assert (cut, "longer" in page.find(".sentence").get_attribute("class")) == (longer, longer)


def test_a_push_that_cannot_be_held_breaks_loose(open_page):
    explorer = open_page().open("?v=1")
    explorer.find(".bench input").evaluate(
        "(it) => { it.value = '2.4'; it.dispatchEvent(new Event('input', {bubbles: true})) }"
    )
    explorer.until("root.explorer.bench.moment && root.querySelector('.state').textContent.startsWith('slipping')")
    explorer.until("root.explorer.picture.place?.[0] < -1.3")
    assert (
        explorer.find(".headline").text_content()
        == "You push with 2.40. Friction can hold only 2.00 this way, so it slips."
    )


def test_c_is_dragged_out_of_the_sphere_and_f_follows(open_page):
    explorer = open_page(first_visit=True).open("?v=1")
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
    assert "so it slips" in explorer.find(".headline").text_content()
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


def test_nothing_moves_while_a_slider_does(open_page):
    explorer = open_page(viewport={"width": 1440, "height": 900}).open()
    places = [".tabs", ".picture", ".gallery", ".panel-atlas"]

    def tops():
        return [(box["x"], box["y"]) for box in (explorer.find(name).bounding_box() for name in places)]

    before = tops()
    for name, values in {"a": (0, 3), "f1": (-2, 3), "b": (1,)}.items():
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


def test_the_invitation_to_drag_c_comes_once_for_six_seconds_and_in_no_question(open_page):
    explorer = open_page(first_visit=True).open("?panel=lessons&lesson=04-sliding&quiz=0.3")
    invitation = explorer.find(".grab .invitation")
    assert not invitation.is_visible()
    explorer.page.evaluate("localStorage.removeItem('codim2-welcome')")
    explorer.open("?v=1")
    invitation.wait_for()
    explorer.until("root.querySelector('.grab').classList.contains('known')")
    assert not invitation.is_visible()
    explorer.open("?v=1")
    assert not invitation.is_visible()
