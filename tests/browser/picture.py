"""Make the README's picture: ``python -m tests.browser.picture`` (needs Chromium, as the browser tests do)."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

from playwright.sync_api import sync_playwright

from ..app.serving import serving

PICTURE = Path(__file__).parents[2] / ".readme" / "explorer.png"


def main() -> None:
    """Write a screenshot of the explorer as it opens."""
    PICTURE.parent.mkdir(exist_ok=True)
    path = os.environ.get("CODIM2_CHROMIUM") or shutil.which("chromium")
    with serving() as address, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=["--no-sandbox", "--disable-gpu"])
        page = browser.new_page(viewport={"width": 1440, "height": 900}, color_scheme="light")
        page.goto(address)
        page.wait_for_selector(".codim2[data-ready]")
        page.wait_for_timeout(1500)
        page.screenshot(path=str(PICTURE))
        browser.close()


if __name__ == "__main__":
    main()
