"""The main journey in Debian's Firefox: open, drag a slider, launch an orbit, undo and redo, Back, panels."""

import os

import pytest

from tests.app.serving import serving

from .bidi import firefox, path

CONTROL = "\ue009"
VALUES = "root.explorer.values"


@pytest.fixture
def page(tmp_path):
    if path() is None:
        (pytest.fail if os.environ.get("CODIM2_FIREFOX") else pytest.skip)("no Firefox: install firefox-esr")
    with serving() as address, firefox(tmp_path) as found:
        found.open(f"http://{address.split('//')[-1]}/?v=1")
        yield found


def test_the_main_journey(page):
    name = "root.querySelector('.portrait-name').textContent"
    assert page.evaluate(name) == "CM4"
    if page.evaluate("Boolean(root.querySelector('.hint, .bubble'))"):
        page.press("\ue00c")  # what greets a first visit goes with Esc
    # a slider is dragged: the picture follows, and it is one step
    left, top, width, height = page.box("[data-control=f1] input[type=range]")
    frame = page.evaluate("Number(root.dataset.frame)")
    start = left + width * 0.4375, top + height / 2
    page.drag(start, *((start[0] - width * share, start[1]) for share in (0.02, 0.05, 0.08, 0.12)))
    page.kept()
    moved = page.evaluate(f"{VALUES}.f1")
    assert moved < -1.0
    assert page.evaluate("Number(root.dataset.frame)") > frame
    assert page.evaluate(name) == "CM2"
    assert page.evaluate("window.history.length") > 1
    # the picture is painted
    assert page.evaluate("root.explorer.picture.list.length") > 10
    # a click launches an orbit
    left, top, width, height = page.box(".bokeh")
    page.drag((left + 0.62 * width, top + 0.3 * height))
    page.kept()
    orbits = page.evaluate(f"{VALUES}.orbits")
    assert orbits.count(",") == 1
    assert page.evaluate("root.querySelector('.orbit-words').textContent")
    # undo by key, by button and by Back; forward again
    page.press(CONTROL, "z")
    page.kept()
    assert page.evaluate(f"[{VALUES}.orbits, {VALUES}.f1]") == ["", moved]
    page.click(".undo")
    page.kept()
    assert page.evaluate(f"{VALUES}.f1") == -0.5
    for _ in range(2):
        page.ask("browsingContext.traverseHistory", context=page.tab, delta=1)
        page.kept()
    assert page.evaluate(f"[{VALUES}.orbits, {VALUES}.f1]") == [orbits, moved]
    # every panel opens, and says something
    for key in page.evaluate("[...root.querySelectorAll('.tabs [role=tab]')].map((tab) => tab.dataset.panel)"):
        page.click(f".tabs [data-panel={key}]")
        page.kept()
        assert page.evaluate(f"root.querySelector('.panel-{key}').hidden") is False
        assert page.evaluate(f"root.querySelector('.panel-{key}').textContent.trim().length") > 10
    assert page.complaints == []
