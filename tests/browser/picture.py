"""Make the README's pictures: ``python -m tests.browser.picture`` (needs Chromium and JupyterLab, as the tests do)."""

from __future__ import annotations

import base64
import io
import os
import shutil
import tempfile
from pathlib import Path

from codim2_app.view.markup import SCRIPT_FOLDER
from PIL import Image
from playwright.sync_api import Browser, sync_playwright

from ..app.serving import serving
from .jupyterlab import jupyterlab, write_notebook

FOLDER = Path(__file__).parents[2] / "app" / "pictures"
CELLS = (
    "import codim2_core as c2, codim2_app\nmine = c2.examples.nonunique_sliding()\n"
    "view = codim2_app.explorer(mine, psi='tanh', panel='numbers')\nview",
    "[(C.kind, C.slow_flow.tolist()) for C in view.frames.scene['critical']]",
)
PREVIEW = """<body style="margin:0;background:#fff;font-family:system-ui,sans-serif;color:#1c2430">
<img style="position:absolute;right:-10px;top:-36px;height:720px" src="data:image/png;base64,{}">
<div style="position:absolute;left:56px;top:150px;width:520px"><h1 style="font-size:62px;line-height:1.1;margin:0">
When friction stops pointing anywhere</h1><p style="font-size:27px;line-height:1.4;color:#5b6675;width:440px">
What does a friction force do when the slip stops pointing anywhere?</p></div></body>"""
IDLE = "window.jupyterapp?.shell.currentWidget?.sessionContext?.session?.kernel?.status === 'idle'"
RUN = """async () => {
    const {shell, commands} = window.jupyterapp
    await shell.currentWidget.sessionContext.ready
    await commands.execute("application:toggle-left-area")
    await commands.execute("notebook:run-all-cells")
}"""
SETTLED = """() => {
    const find = (root) => root.querySelector(".codim2[data-settled=true]")
        ?? [...root.querySelectorAll("*")].map((e) => e.shadowRoot && find(e.shadowRoot)).find(Boolean)
    return find(document) }"""


def the_page(browser: Browser) -> None:
    """The explorer as it opens."""
    with serving() as address:
        page = browser.new_page(viewport={"width": 1440, "height": 900}, color_scheme="light")
        page.goto(address)
        page.wait_for_selector(".codim2[data-settled=true]", timeout=60_000)
        page.wait_for_timeout(1500)
        page.screenshot(path=str(FOLDER / "explorer.png"))
        page.close()


def the_preview(browser: Browser) -> None:
    """What a pasted link shows: the hemisphere, lifted, and what the page asks."""
    with serving() as address:
        page = browser.new_page(viewport={"width": 1200, "height": 900}, color_scheme="light", reduced_motion="reduce")
        page.goto(f"{address}?v=1&layers=outside,inside,continuations,cycles,equator,critical")
        page.wait_for_selector(".codim2[data-settled=true]", timeout=60_000)
        page.locator(".lift").click()
        page.wait_for_timeout(1500)
        hemisphere = base64.b64encode(page.locator(".lifted").screenshot()).decode()
        page.set_viewport_size({"width": 1200, "height": 630})
        page.set_content(PREVIEW.format(hemisphere))
        page.wait_for_timeout(500)
        shot = Image.open(io.BytesIO(page.screenshot()))
        shot.convert("RGB").save(SCRIPT_FOLDER / "preview.jpg", quality=88, optimize=True)
        page.close()


def a_notebook(browser: Browser) -> None:
    """The explorer of a typed system in JupyterLab, and a cell that asks for its numbers."""
    with tempfile.TemporaryDirectory() as name, jupyterlab(Path(name)) as address:
        write_notebook(Path(name) / "notebooks" / "system.ipynb", CELLS)
        page = browser.new_page(viewport={"width": 1300, "height": 1000}, color_scheme="light")
        page.goto(f"{address}/lab/tree/system.ipynb?reset")
        page.wait_for_function(IDLE, timeout=120_000)
        page.evaluate(RUN)
        page.wait_for_function(SETTLED, timeout=120_000)
        page.wait_for_timeout(3000)
        page.evaluate("document.querySelector('.jp-WindowedPanel-outer').scrollTop = 0")
        page.wait_for_timeout(1000)
        page.screenshot(path=str(FOLDER / "notebook.png"))
        page.close()


def main() -> None:
    """Write all pictures."""
    path = os.environ.get("CODIM2_CHROMIUM") or shutil.which("chromium")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=["--no-sandbox", "--disable-gpu"])
        the_page(browser)
        the_preview(browser)
        a_notebook(browser)
        browser.close()


if __name__ == "__main__":
    main()
