"""A folder of files in Debian's Firefox: Python comes, a slider is dragged, and a panel is computed next to it."""

import os

import pytest
from codim2_app.server.cli import main

from tests.app.serving import files_of
from tests.browser.test_static import release

from .bidi import firefox, path

NAME = "root.querySelector('.portrait-name').textContent"


@pytest.fixture
def page(tmp_path):
    if path() is None:
        (pytest.fail if os.environ.get("CODIM2_FIREFOX") else pytest.skip)("no Firefox: install firefox-esr")
    assert main(["static", "-o", str(tmp_path / "web"), *release()]) == 0
    (tmp_path / "profile").mkdir()
    with files_of(tmp_path / "web") as address, firefox(tmp_path / "profile") as found:
        found.open(f"{address}/?panel=diagram")
        yield found


def test_a_page_of_files_computes_in_firefox(page):
    page.until("root.explorer.requests.held === false")
    assert page.evaluate(NAME) == "CM4"
    if page.evaluate("Boolean(root.querySelector('.hint, .bubble'))"):
        page.press("\ue00c")  # what greets a first visit goes with Esc
    left, top, width, height = page.box("[data-control=f1] input[type=range]")
    start = left + width * 0.4375, top + height / 2
    page.drag(start, *((start[0] - width * share, start[1]) for share in (0.02, 0.05, 0.08, 0.12)))
    page.kept()
    assert page.evaluate(NAME) == "CM2"
    page.until("root.querySelector('.panel-diagram canvas, .panel-diagram svg')")
    assert page.complaints == []
