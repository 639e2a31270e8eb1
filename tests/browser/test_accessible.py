"""axe-core finds nothing serious, in every panel, in the dark and on a phone."""

import os
from pathlib import Path

import pytest

from .conftest import PHONE

AXE = Path(__file__).parents[1] / "app" / "static" / "node_modules" / "axe-core" / "axe.min.js"

SERIOUS = """async (place, rules) => { const found = await axe.run(place, {resultTypes: ['violations'],
    ...(rules && {runOnly: {type: 'rule', values: rules}})})
    return found.violations.filter((it) => ['serious', 'critical'].includes(it.impact))
        .map((it) => [it.id, it.nodes.slice(0, 5).map((node) => `${node.target}: ${node.failureSummary}`)]) }"""


@pytest.fixture
def axe():
    if not AXE.is_file():
        (pytest.fail if os.environ.get("CI") else pytest.skip)("no axe-core: run `npm ci` in tests/app/static")
    return AXE.read_text(encoding="utf-8")


STATES = {
    "desktop": {"viewport": {"width": 1440, "height": 900}},
    "dark": {"viewport": {"width": 1440, "height": 900}, "color_scheme": "dark"},
    "phone": PHONE,
}


COLOURS = ["color-contrast", "link-in-text-block"]  # all that the dark can change


@pytest.mark.parametrize("state", STATES)
def test_nothing_serious_in_any_panel(open_page, axe, state):
    rules = COLOURS if state == "dark" else None
    page = open_page(**STATES[state]).open()
    page.page.evaluate(axe)
    assert page.find("html").evaluate(SERIOUS, rules) == []
    for tab in page.find(".tabs [role=tab]").all():
        tab.click()
        page.settle()
        panel = page.find(f"#{tab.get_attribute('aria-controls')}")
        assert panel.evaluate(SERIOUS, rules) == [], tab.text_content()
    if state == "phone":
        page.find(".sheets [data-sheet=controls]").click()
        assert page.find("html").evaluate(SERIOUS, rules) == [], "controls"


#: What else a person comes to: what is pressed there, after the link.
PLACES = {
    "two portraits": ("?v=1&beside=psi%3Dhill%26n%3D3", [".second-bar summary"]),
    "beamer": ("?v=1", [".beam"]),
    "orbits": ("?v=1&panel=orbits&orbits=0.4,0.3;1.5,0.6,-:slow&orbit=1&orbit_eps=show", []),
    "a ball": ("?v=1&panel=orbits&system=ball_in_pool&orbit_eps=show", []),
    "a range": ("?v=1&system=own&panel=numbers", ["[data-control=parameter-mu] label"]),
    "a card": ("?v=1&pinned=C&panel=numbers", []),
    "help": ("?v=1", [".help"]),
    "share": ("?v=1", [".share"]),
    "a room": ("room", []),
    "a question": ("?panel=lessons&lesson=04-sliding&quiz=0.3", [".question > .clue summary"]),
}


@pytest.mark.parametrize("place", PLACES)
def test_nothing_serious_elsewhere(open_page, axe, place):
    query, pressed = PLACES[place]
    page = open_page(**STATES["desktop"]).open(query)
    if place == "a room":
        page.until("root.querySelector('dialog.room .qr')?.src")
    if place == "two portraits":
        page.page.wait_for_selector(".second-place iframe").content_frame().wait_for_selector(".codim2[data-ready]")
    for selector in pressed:
        page.find(selector).click()
    page.settle()
    for frame in page.page.frames:
        frame.evaluate(axe)
    assert page.find("html").evaluate(SERIOUS, None) == []
    page.page.emulate_media(color_scheme="dark")
    for frame in page.page.frames:
        frame.locator(".codim2.dark").wait_for()
    assert page.painted().settle().find("html").evaluate(SERIOUS, COLOURS) == []
