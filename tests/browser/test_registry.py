"""A panel is one file in Python, one in JavaScript, and one registration: shown by adding one from a folder."""

import os
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path
from urllib.request import urlopen

STATIC = Path(__file__).parents[2] / "app" / "static"

PYTHON = """
import sys
from pathlib import Path

from codim2_app.panels import registry
from codim2_app.panels.panel import Panel


def add(draft):
    draft.header["twice"] = 2.0 * draft.values["a"]


registry.register(Panel("twice", "Twice", add, "Twice the entry a.", {"unit": "of A"}, Path(sys.argv[1])))

from codim2_app.server.cli import main

if __name__ == "__main__":  # the server's workers import this script
    main(["serve", "--port", "0"])
"""

SCRIPT = """
import {register} from "%s/panels.js"

register("twice", (box, {settings, move}) => {
  box.innerHTML = '<button type="button"></button>'
  const button = box.firstElementChild
  button.addEventListener("click", () => move({a: 1.5}))
  return {apply: ({header}) => { if ("twice" in header) button.textContent = `2a = ${header.twice} ${settings.unit}` }}
})
"""


@contextmanager
def served(folder):
    (folder / "serve.py").write_text(PYTHON)
    (folder / "twice.js").write_text(SCRIPT % os.path.relpath(STATIC, folder))
    (folder / "twice.css").write_text(".codim2 .panel-twice button { color: rgb(1, 2, 3); }")
    command = [sys.executable, str(folder / "serve.py"), str(folder)]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    try:
        said = process.stdout.readline()
        assert "http://" in said, said + process.stdout.read()
        yield "http://" + said.split("http://")[1].split("/")[0]
    finally:
        process.terminate()
        process.wait(10)
        process.stdout.close()


def test_a_panel_from_a_folder_is_one_registration(open_page, tmp_path):
    with served(tmp_path) as address:
        with urlopen(address + "/health", timeout=20):
            pass
        page = open_page()
        page.address = address
        page.open("?panel=twice")
        assert page.find(".tabs [role=tab]").all_text_contents()[-1] == "Twice"
        button = page.find(".panel-twice button")
        assert button.text_content() == "2a = -4 of A"
        assert button.evaluate("(it) => getComputedStyle(it).color") == "rgb(1, 2, 3)"
        button.click()
        page.settle()
        assert button.text_content() == "2a = 3 of A"
        page.find("#c2-tab-atlas").click()
        page.settle()
        assert not button.is_visible()
        assert page.complaints == []
