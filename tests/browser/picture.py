"""Make the README's pictures: ``python -m tests.browser.picture`` (needs Chromium, as the browser tests do)."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

from playwright.sync_api import sync_playwright

from ..app.serving import serving

FOLDER = Path(__file__).parents[2] / ".readme"
#: Name of the picture, and the address of the page.
PICTURES = {"explorer": "", "systems": "?preset=nonunique-sliding&panel=solid&solid=stack"}


def main() -> None:
    """Write a screenshot of the explorer as it opens, and one of another system."""
    FOLDER.mkdir(exist_ok=True)
    path = os.environ.get("CODIM2_CHROMIUM") or shutil.which("chromium")
    with serving() as address, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=["--no-sandbox", "--disable-gpu"])
        for name, query in PICTURES.items():
            page = browser.new_page(viewport={"width": 1440, "height": 900}, color_scheme="light")
            page.goto(f"{address}/{query}")
            page.wait_for_selector(".codim2[data-settled=true]")
            page.wait_for_timeout(1500)
            page.screenshot(path=str(FOLDER / f"{name}.png"))
            page.close()
        browser.close()


if __name__ == "__main__":
    main()
