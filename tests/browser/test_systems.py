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
