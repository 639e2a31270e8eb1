"""axe-core finds nothing serious, in every panel, in the dark and on a phone."""

import os
from pathlib import Path

import pytest

AXE = Path(__file__).parents[1] / "app" / "static" / "node_modules" / "axe-core" / "axe.min.js"

SERIOUS = """async (rules) => { const found = await axe.run(document, {resultTypes: ['violations'],
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
    "phone": {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True},
}


COLOURS = ["color-contrast", "link-in-text-block"]  # all that the dark can change


@pytest.mark.parametrize("state", STATES)
def test_nothing_serious_in_any_panel(open_page, axe, state):
    rules = COLOURS if state == "dark" else None
    page = open_page(**STATES[state]).open("?preset=case3-n3")
    page.page.evaluate(axe)
    for tab in page.find(".tabs [role=tab]").all():
        tab.click()
        page.settle()
        assert page.page.evaluate(SERIOUS, rules) == [], tab.text_content()
    if state == "phone":
        page.find(".sheets [data-sheet=controls]").click()
        assert page.page.evaluate(SERIOUS, rules) == [], "controls"
