"""Live figures in a page of anybody's, from a server of plain files: a picture first, then dragged, by one worker."""

import pytest
from codim2_app.server.cli import main

from tests.app.serving import files_of

from .conftest import PATIENCE
from .test_static import release, worker_count

PAGE = """<!DOCTYPE html><html lang="en"><meta charset="utf-8"><title>Notes</title><link rel="icon" href="data:,">
<h1>Two portraits</h1>
<div data-codim2="v=1&preset=case1-cm4&controls=f1"><img src="one.svg" alt="Case I"></div>
<div data-codim2="v=1&preset=case3-n3&controls=f1" data-start="press"><img src="other.svg" alt="Case III"></div>
<script type="module" src="explorer-files/figures.js"></script></html>
"""


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    folder = tmp_path_factory.mktemp("notes")
    assert main(["static", "-o", str(folder / "explorer-files"), *release()]) == 0
    for name, key in (("one", "case1-cm4"), ("other", "case3-n3")):
        assert main(["figure", key, "-o", str(folder / f"{name}.svg"), "--no-legend"]) == 0
    (folder / "notes.html").write_text(PAGE, encoding="utf-8")
    with files_of(folder) as host:
        yield host


def names_of_a_drag(page, inner, places):
    """Drag f1 of a figure by the mouse; return the names that its portrait has on the way."""
    settled = "() => document.querySelector('.codim2').dataset.settled === 'true'"
    box = inner.query_selector("[data-control=f1] input[type=range]").bounding_box()
    at = lambda share: (box["x"] + share * box["width"], box["y"] + box["height"] / 2)
    page.mouse.move(*at(places[0]))
    page.mouse.down()
    names = []
    for place in places[1:]:
        page.mouse.move(*at(place), steps=3)
        inner.wait_for_function(settled)
        names.append(inner.text_content(".portrait-name"))
    page.mouse.up()
    return names


def test_two_figures_are_dragged_by_one_worker(chromium, address):
    context = chromium.new_context(viewport={"width": 700, "height": 1400})
    context.set_default_timeout(PATIENCE)
    page, complaints, asked = context.new_page(), [], []
    page.on("console", lambda said: complaints.append(said.text) if said.type in ("error", "warning") else None)
    page.on("pageerror", lambda error: complaints.append(str(error)))
    context.on("request", lambda request: asked.append(request.url))
    page.goto(f"{address}/notes.html")
    first, second = page.query_selector_all("[data-codim2]")
    size = first.bounding_box()
    assert first.query_selector("img").evaluate("(it) => it.complete && it.naturalWidth > 0")  # before all else
    page.wait_for_selector("[data-codim2].live")
    inner = first.query_selector("iframe").content_frame()
    assert names_of_a_drag(page, inner, (0.417, 0.3, 0.1)) == ["CM2", "NCM2"]
    assert second.query_selector("iframe") is None  # nothing is loaded for it before it is asked for
    second.query_selector("button").click()
    page.wait_for_function("() => document.querySelectorAll('[data-codim2].live').length === 2")
    other = second.query_selector("iframe").content_frame()
    assert "Case III" in other.text_content(".portrait-case")
    before = other.text_content(".portrait-name")
    assert names_of_a_drag(page, other, (0.5, 0.05))[-1] != before
    assert inner.text_content(".portrait-name") == "NCM2"  # the other has left it alone
    assert names_of_a_drag(page, inner, (0.1, 0.417)) == ["CM4"]
    assert worker_count(page) == 2  # one answers both, one computes for both
    assert first.bounding_box() == size
    assert [url for url in asked if not url.startswith((f"{address}/", "data:"))] == []
    assert complaints == []
    context.close()
