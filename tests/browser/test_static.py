"""The folder of `codim2 static`, under a prefix of a server of plain files: dragged, and again without a network."""

import os
from pathlib import Path

import pytest
from codim2_app.server.cli import main

from tests.app.serving import files_of

from .conftest import PATIENCE, VISITED, WINDOW, Explorer

PREFIX = "lecture/codim2"
#: Told of a page whose files come from a release of Pyodide and from `codim2 kernels`.
NEEDED = "set CODIM2_PYODIDE to the folder of Pyodide's release, with its wheel of NumPy and our compiled kernels"
ANSWERS = "() => document.querySelector('.codim2')?.explorer?.requests.held === false"


def release():
    """The options that name the files, or no test."""
    pyodide = os.environ.get("CODIM2_PYODIDE")
    if pyodide is None:
        pytest.skip(NEEDED)
    kernels = ["--kernels", pyodide] if (Path(pyodide) / "kernels.so").is_file() else []
    return ["--pyodide", pyodide, *kernels]


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    folder = tmp_path_factory.mktemp("web")
    assert main(["static", "-o", str(folder / PREFIX), *release()]) == 0
    with files_of(folder) as host:
        yield f"{host}/{PREFIX}"


def worker_count(page):
    """Count the workers of a page once that has come which computes next to the one that answers."""
    for _ in range(int(PATIENCE / 100)):
        if len(page.workers) > 1:
            break
        page.wait_for_timeout(100)
    return len(page.workers)


def portraits_of_a_drag(explorer, places):
    """Drag f1 by the mouse; return the names that the portrait has on the way."""
    box = explorer.find("[data-control=f1] input[type=range]").bounding_box()
    at = lambda share: (box["x"] + share * box["width"], box["y"] + box["height"] / 2)
    mouse, names = explorer.page.mouse, []
    mouse.move(*at(places[0]))
    mouse.down()
    for place in places[1:]:
        mouse.move(*at(place), steps=3)
        names.append(explorer.settle().name())
    mouse.up()
    explorer.kept()
    return names


def test_a_folder_of_files_is_dragged_and_again_without_a_network(chromium, address):
    context = chromium.new_context(viewport=WINDOW)
    context.add_init_script(VISITED)
    context.set_default_timeout(PATIENCE)
    explorer = Explorer(context.new_page(), address)
    page, everything = explorer.page, []
    context.on("request", lambda request: everything.append(request.url))  # the workers' too
    page.goto(f"{address}/")
    page.wait_for_selector(".codim2[data-ready]")
    assert explorer.name() == "CM4"  # as it was saved, while the mathematics is loaded
    page.wait_for_selector(".busy:has-text('mathematics')")
    explorer.find("[data-control=b] .number").fill("0.1")  # what is set meanwhile is drawn when it is there
    explorer.find("[data-control=b] .number").press("Enter")
    assert explorer.frame() == 0
    page.wait_for_function(ANSWERS)
    assert explorer.settle().frame() > 0
    assert portraits_of_a_drag(explorer, (0.42, 0.3, 0.1)) == ["CM2", "NCM2"]
    page.evaluate("navigator.serviceWorker.ready.then(() => true)")
    context.set_offline(True)
    page.reload()
    page.wait_for_function(ANSWERS)
    page.wait_for_selector(".codim2[data-ready]")
    assert explorer.settle().name() == "NCM2"  # the link has brought it back
    assert explorer.find("[data-control=b] .number").input_value() == "0.1"
    assert portraits_of_a_drag(explorer, (0.1, 0.3, 0.42)) == ["CM2", "CM4"]
    assert explorer.complaints == []
    assert [url for url in everything if not url.startswith(f"{address}/")] == []
    context.close()
