"""The notebooks that come with the package: each runs without a warning, and is a finished page without a kernel."""

import json
from importlib.util import find_spec
from pathlib import Path

import codim2_app
import pytest

pytestmark = pytest.mark.skipif(find_spec("jupyterlab") is None, reason="no JupyterLab: pip install jupyterlab")

NOTEBOOKS = sorted((Path(codim2_app.__file__).parent / "site" / "notebooks").glob("*.ipynb"))
NAMES = [file.stem for file in NOTEBOOKS]
MOST = 600_000  # bytes of a notebook that has been run


@pytest.fixture
def executed(tmp_path, monkeypatch, file):
    """A notebook that has been run."""
    import nbformat
    from nbclient import NotebookClient

    monkeypatch.setenv("IPYTHONDIR", str(tmp_path))
    book = nbformat.read(file, 4)
    NotebookClient(book, timeout=600, kernel_name="python3").execute()
    return book


@pytest.mark.parametrize("file", NOTEBOOKS, ids=NAMES)
def test_a_notebook_is_kept_without_what_it_showed(file):
    cells = [cell for cell in json.loads(file.read_text())["cells"] if cell["cell_type"] == "code"]
    assert cells
    assert not [cell for cell in cells if cell["outputs"] or cell["execution_count"]]


@pytest.mark.parametrize("file", NOTEBOOKS, ids=NAMES)
def test_every_cell_runs_and_its_static_page_shows_the_finished_pictures(executed, file, chromium, tmp_path):
    outputs = [(cell, out) for cell in executed.cells if cell.cell_type == "code" for out in cell.outputs]
    for cell, out in outputs:
        assert out.output_type != "error", (cell.source, out)
        assert out.get("name") != "stderr", (cell.source, out)
        for kind, data in out.get("data", {}).items():
            assert len(data) < 100_000 or cell.source.startswith("Row("), (cell.source, kind)
    shown = [cell.source for cell in executed.cells if cell.cell_type == "code" and cell.outputs]
    assert len(shown) >= 7
    assert len(json.dumps(executed)) < MOST
    _shows_pictures(executed, chromium, tmp_path / f"{file.stem}.html")


def _shows_pictures(executed, chromium, page):
    from nbconvert import HTMLExporter

    page.write_text(HTMLExporter().from_notebook_node(executed)[0], encoding="utf-8")
    context = chromium.new_context(viewport={"width": 1100, "height": 900}, offline=True)
    tab = context.new_page()
    wrong = []
    tab.on("pageerror", lambda error: wrong.append(str(error)))
    tab.goto(page.as_uri(), wait_until="domcontentloaded")
    explorers = sum("explorer(" in cell.source for cell in executed.cells if cell.cell_type == "code")
    stills = tab.locator("[class^=explorer-still] img")
    assert stills.count() == explorers
    for i in range(explorers):
        still = stills.nth(i)
        assert still.is_visible()
        assert still.evaluate("(img) => img.decode().then(() => img.naturalWidth)") >= 500
        assert "limit directions" in still.get_attribute("alt")
    assert tab.locator(".jp-OutputArea-output svg, .jp-OutputArea-output img").count() >= 4
    assert [one for one in wrong if "require" not in one and "MathJax" not in one] == []  # which it has from elsewhere
    context.close()
