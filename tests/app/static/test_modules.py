"""The front end's modules: their own tests, run by Node, and how they are joined."""

import json
import os
import re
import signal
import subprocess
from pathlib import Path

from codim2_app.view.markup import script

HERE = Path(__file__).parent
STATIC = Path(__file__).parents[3] / "app" / "codim2_app" / "static"
#: No part of the page's script: a notebook's cell brings it before there is an explorer, a live file has its own, and a
#: menu is loaded when it is opened; a page without a server has a worker, and one that keeps its files.
APART = ("cell.js", "figures.js", "live_file.js", "offline.js", "presenter.js", "export_menu.js", "worker.js")
LONGEST = 180.0  # seconds for all of Node's tests, which take five: also where other work has most of the machine


def ended(command, folder, seconds):
    """Run a command in a group of processes that ends after some seconds; return its code and what it wrote."""
    with subprocess.Popen(
        command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True
    ) as process:
        try:
            output, _ = process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            output, _ = process.communicate()
            output = f"{output}\n{command}: no end after {seconds:g} s."
    return process.returncode, output


def in_a_document(path):
    """Whether a test, or one of what it is played with, needs a document to draw in."""
    text = path.read_text()
    played = ((path.parent / name).resolve() for name in re.findall(r'from "(\.[^"]+)"', text))
    return '"linkedom"' in text or any(in_a_document(one) for one in played if one.is_relative_to(HERE))


def test_node_tests(node, tmp_path):
    """One process for each folder, and for each file that lies in none.

    Those of what is drawn in a document need `npm --prefix tests/app/static ci`, which the linters run in CI.
    """
    files = sorted((*HERE.glob("*.test.js"), *HERE.glob("*/*.test.js")))
    if not os.environ.get("CI") and not (HERE / "node_modules" / "linkedom").is_dir():
        files = [file for file in files if not in_a_document(file)]
    for file in files:
        together = file.name if file.parent == HERE else f"{file.parent.name}.test.js"
        with (tmp_path / together.replace(".test.js", ".test.mjs")).open("a") as written:
            written.write(f"import {json.dumps(file.as_uri())}\n")  # all are read before the first test begins
    code, output = ended([node, "--test", "--test-reporter=tap"], tmp_path, LONGEST)
    assert code == 0, output
    assert int(re.search(r"^# pass (\d+)$", output, re.M)[1]) >= len(files) > 10


def test_the_joined_modules_are_one_module_that_node_reads(node, tmp_path):
    joined = tmp_path / "all.mjs"
    joined.write_text(script(), encoding="utf-8")
    done = subprocess.run([node, "--check", str(joined)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert "\nimport " not in script()


def test_every_module_is_reached():
    joined = script()
    for path in STATIC.rglob("*.js"):
        if path.name in APART:
            continue
        first = next(line for line in path.read_text(encoding="utf-8").splitlines() if line.startswith("// "))
        assert joined.count(first + "\n") == 1, path.name
