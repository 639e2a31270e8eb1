"""What a person does with other systems: choose one, type one's own, play a motion, turn the 3-D view."""

from urllib.parse import parse_qs, urlparse

import pytest

from .test_panels import open_panel, value


def choose(explorer, key):
    return explorer.choose(".system-box select", key)


def test_an_example_brings_its_equations_sliders_and_place(explorer):
    choose(explorer, "ball_in_pool")
    assert explorer.find(".equations math mtr").count() == 4
    assert explorer.find(".parameters .control").count() == 4
    assert explorer.name() == "CM2"
    assert value(explorer, "slow-z") == 4
    assert not explorer.find("[data-control=f1]").is_visible()
    explorer.type("slow-z", "9")
    assert explorer.name() == "NCM2"  # beyond z_crit = 6.867 it slips
    explorer.type("parameter-mu", "0.5")
    assert explorer.name() == "CM2"  # more friction: z_crit = 17.2
    explorer.kept()
    query = parse_qs(urlparse(explorer.page.url).query)
    assert query["parameters"] == ['{"mu":0.5}']
    explorer.reload()
    assert value(explorer, "parameter-mu") == 0.5
    assert explorer.name() == "CM2"


@pytest.mark.parametrize("size", [(1024, 768), (1440, 900), (390, 844)])
def test_equations_and_numbers_are_seen_whole(open_page, size):
    page = open_page(viewport=dict(zip(("width", "height"), size, strict=True))).open("?system=spinning_disc")
    if size[0] < 800:
        page.click("button[data-sheet=controls]")
    assert page.find(".equations").evaluate("(box) => box.scrollHeight <= box.clientHeight")
    page.type("parameter-k", "-0.123456")
    cut = "(all) => all.filter((it) => it.offsetWidth && it.scrollWidth > it.clientWidth).map((it) => it.value)"
    assert page.find(".controls input.number").evaluate_all(cut) == []


@pytest.mark.slow
def test_a_box_is_as_high_as_its_formula(explorer):
    choose(explorer, "own")
    box = explorer.find("textarea[data-box=U1]")
    box.fill("q*c")
    low = box.bounding_box()["height"]
    box.fill(" + ".join(["q*c*(c**2 + s**2)"] * 6))
    explorer.settle()
    assert box.evaluate("(it) => it.scrollHeight <= it.clientHeight")
    assert box.bounding_box()["height"] > 3 * low
    box.fill("q*c")
    explorer.settle()
    assert box.bounding_box()["height"] == low


@pytest.mark.slow
def test_play_drifts_along_the_slow_flow_to_its_equilibrium(explorer):
    choose(explorer, "ball_in_pool")
    open_panel(explorer, "Along z")
    explorer.find(".panel-along .speed").evaluate("(e) => { e.value = 4 }")
    explorer.find(".panel-along .play").click()
    z = "Number(root.querySelector('[data-control=slow-z] .number').value)"
    explorer.until(f"0 < {z} && {z} < 3.5")
    explorer.page.locator(".along-note", has_text="rest").wait_for()
    assert abs(value(explorer, "slow-z")) < 0.1
    explorer.settle()  # what is drawn anew at rest leaves the sentence
    assert "rest" in explorer.find(".along-note").inner_text()


def test_a_motion_plays_in_step_in_all_views(explorer):
    choose(explorer, "ball_in_pool")
    open_panel(explorer, "Motion")
    explorer.page.wait_for_selector(".phases li:nth-child(2)")
    start = value(explorer, "slow-z")
    explorer.find(".panel-orbits .play").click()
    explorer.until(f"Number(root.querySelector('[data-control=slow-z] .number').value) !== {start}")
    explorer.click(".panel-orbits .play")
    assert "t =" in explorer.find(".orbit-now").text_content()
    assert value(explorer, "slow-z") != start
    drawn = explorer.find(".codim2").evaluate("(root) => root.explorer.picture.above.list.map((item) => item.kind)")
    assert drawn == ["path", "path", "mark", "label"]  # near the present z, and faint elsewhere


def test_the_solid_view_turns_without_asking_the_server(explorer):
    open_panel(explorer, "3-D")
    canvas = explorer.find("canvas.solid")
    before, frame = canvas.screenshot(), explorer.frame()
    box = canvas.bounding_box()
    explorer.drag((box["x"] + 60, box["y"] + 80), (box["x"] + 160, box["y"] + 110)).painted()
    assert canvas.screenshot() != before
    assert explorer.frame() == frame
    for words in ("Along z", "Filippov"):
        explorer.find(".panel-solid").get_by_role("button", name=words).click()
        explorer.settle()
        assert explorer.find(".solid-note").text_content() != "…"


def test_what_was_typed_is_in_a_list_that_this_browser_keeps(open_page):
    explorer = open_page().open("?system=own")
    box = explorer.find("textarea[data-box=U1]")
    box.fill("-c*(c + 1/3)*2")
    explorer.kept()
    explorer.click(".reset")
    yours = explorer.find(".yours")
    assert yours.locator("summary").text_content() == "Yours (1)"
    yours.locator("summary").click()
    yours.locator(".open").click()
    explorer.settle()
    assert box.input_value() == "-c*(c + 1/3)*2"
    yours.locator("input").fill("thirds")
    yours.locator("input").press("Enter")
    explorer.open("?")
    yours.locator("summary").click()
    assert yours.locator("input").input_value() == "thirds"
    yours.locator(".remove").click()
    assert yours.locator("li").text_content().startswith("Removed: thirds")
    yours.locator(".put-back").click()
    assert yours.locator("input").input_value() == "thirds"
    assert explorer.complaints == []


def ends(explorer, name):
    slider = explorer.find(f"[data-control={name}] input[type=range]")
    return float(slider.get_attribute("min")), float(slider.get_attribute("max"))


def test_a_range_is_typed_next_to_a_slider_is_in_the_link_and_is_undone(open_page):
    explorer = open_page().open()
    first = ends(explorer, "f1")
    explorer.type("f1", "0.25 in [0, 1]").kept()
    assert (ends(explorer, "f1"), value(explorer, "f1")) == ((0.0, 1.0), 0.25)
    explorer.find("[data-control=a] label").click()
    low = explorer.find("[data-control=a] .ends input").first
    low.fill("-3")
    low.press("Enter")
    explorer.kept()
    assert ends(explorer, "a") == (-3.0, 4.0)
    assert explorer.find("[data-control=a] .ends").count() == 0
    explorer.type("b", "3 in [0, 1]")
    assert "0.3 in [0, 1]" in explorer.find("[data-control=b] .error").text_content()
    again = open_page().open(explorer.page.evaluate("location.search"))
    assert (ends(again, "a"), ends(again, "f1"), value(again, "f1")) == ((-3.0, 4.0), (0.0, 1.0), 0.25)
    explorer.click(".undo").kept()
    assert (ends(explorer, "a"), ends(explorer, "f1")) == ((-4.0, 4.0), (0.0, 1.0))
    explorer.click(".undo").kept()
    assert (ends(explorer, "f1"), value(explorer, "f1")) == (first, -0.5)
    assert explorer.complaints == again.complaints == []


def test_a_line_of_ones_own_system_gives_a_parameter_its_value_and_range(open_page):
    explorer = open_page().open("?v=1&panel=numbers")
    choose(explorer, "own")
    explorer.find("textarea[data-box=U1]").fill("-mu*c + f + k")
    where = explorer.find("textarea[data-box=where]")
    where.fill(f"{where.input_value()}\nk = 0.3 in [0, 1]")
    explorer.settle()
    assert (ends(explorer, "parameter-k"), value(explorer, "parameter-k")) == ((0.0, 1.0), 0.3)
    explorer.type("parameter-k", "0.75")
    where.fill(where.input_value().replace("0.3 in [0, 1]", "0.4 in [0, 2]"))
    explorer.settle()
    assert (ends(explorer, "parameter-k"), value(explorer, "parameter-k")) == ((0.0, 2.0), 0.4)
    explorer.kept()
    again = open_page().open(explorer.page.evaluate("location.search"))
    assert (ends(again, "parameter-k"), value(again, "parameter-k")) == ((0.0, 2.0), 0.4)
    where.fill("mu = 1\nf = 0.5\nk = 3 in [0, 1]")
    explorer.settle()
    assert "a range [low, high] that holds the value" in explorer.find("[data-box=where] .error").text_content()
    assert explorer.complaints == again.complaints == []
