"""One of each is added from a folder, by one registration or one row, and used in the live page.

A panel, a family of Psi and a layer.
"""

import os
from pathlib import Path

import numpy as np
import pytest

import codim2_core as c2
from tests.app.serving import serving

ROOT = Path(__file__).parents[2]
STATIC = ROOT / "app" / "codim2_app" / "static"
RECORDER = (Path(__file__).parent / "recorder.js").read_text()

pytestmark = pytest.mark.slow  # a server of its own, with workers, for each of what programs add

PYTHON = """
import sys
from pathlib import Path

import numpy as np
from codim2_app.panels import registry
from codim2_app.panels.panel import Panel


def add(draft):
    draft.header["twice"] = 2.0 * draft.values["a"]


FOLDER = Path(sys.argv[1])
registry.register(Panel("twice", "Twice", add, "Twice the entry a.", {"unit": "of A"}, FOLDER))

from codim2_core import examples, psi
from codim2_core.systems.presets.presets import register
from codim2_core.scene import Recipe as Row, scene
from codim2_app.picture.draw.layers import LAYERS, Layer, Part
from tests.core.additions import EXAMPLE, FROM_FORMULA, PRESET, module

psi.register(module(FOLDER, "added_family", FROM_FORMULA).FAMILY)
examples.register(module(FOLDER, "added_example", EXAMPLE).EXAMPLE)
register(PRESET)


class Ray:
    def __init__(self, setting):
        C = setting.problem.critical[0].p
        self.points = np.array([[0.0, 0.0], C, 2.0 * C])


scene.layers = {**scene.layers, "ray": Row(("plane", "slow", "psi"), lambda setting: (Ray(setting),))}
LAYERS["ray"] = Layer("ray", "A ray through C", 65, (Part("ray", "ray", 2.5, "ray"),), {"ray": ("#123456", "#abcdef")})

from codim2_app.server.cli import main

if __name__ == "__main__":  # the server's workers import this script, and have its registrations by that
    main(sys.argv[2:])
"""

LESSON = """---
title: A lesson of my own
summary: One sentence.
portrait: added-cm0
---
All orbits reach **C**.
"""

SCRIPT = """
import {register} from "%s/widgets/panels.js"

register("twice", (box, {settings, move}) => {
  box.innerHTML = '<button type="button"></button>'
  const button = box.firstElementChild
  button.addEventListener("click", () => move({a: 1.5}))
  return {apply: ({header}) => { if ("twice" in header) button.textContent = `2a = ${header.twice} ${settings.unit}` }}
})
"""


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    """The address of a server whose script registers one of each."""
    folder = tmp_path_factory.mktemp("added")
    (folder / "serve.py").write_text(PYTHON)
    (folder / "twice.js").write_text(SCRIPT % os.path.relpath(STATIC, folder))
    (folder / "twice.css").write_text(".codim2 .panel-twice button { color: rgb(1, 2, 3); }")
    (folder / "course").mkdir()
    (folder / "course" / "01-own.md").write_text(LESSON)
    script = (str(folder / "serve.py"), str(folder))
    path = {**os.environ, "PYTHONPATH": str(ROOT)}
    with serving("--lessons", str(folder / "course"), command=script, environment=path) as found:
        yield found


@pytest.fixture
def page(open_page, address):
    made = open_page()
    made.address = address
    yield made
    assert made.complaints == []


def test_a_panel_from_a_folder_is_one_registration(page):
    page.open("?panel=twice")
    assert sum("explorer.js" in url for url in page.requests) == 1  # fetched first, and used
    assert page.find(".tabs [role=tab]").all_text_contents()[-1] == "Twice"
    button = page.find(".panel-twice button")
    assert button.text_content() == "2a = -4 of A"
    assert button.evaluate("(it) => getComputedStyle(it).color") == "rgb(1, 2, 3)"
    button.click()
    page.settle()
    assert button.text_content() == "2a = 3 of A"
    page.click("#c2-tab-atlas")
    assert not button.is_visible()


def test_a_family_of_psi_is_chosen_and_moves_the_critical_set(page):
    page.open("?f2=0.3")
    page.choose("select.psi", "power")
    power = c2.psi.custom("(1+s/2)**(-2)")
    [C] = c2.critical_sets(c2.ELinear(-2, 0, -1, (-0.5, 0.3)), power)
    words = page.find(".critical-table").text_content()
    assert f"({C.x2[0]:.3f}, {C.x2[1]:.3f})".replace("-", "−") in words
    again = page.open(page.kept().page.url.split("/", 3)[3])
    assert again.find("select.psi").input_value() == "power"


def test_the_servers_workers_have_what_the_script_registers(page):
    page.open("?panel=atlas&psi=power")
    page.find(".panel-atlas .pad .region").first.wait_for()  # computed in a process of its own
    assert page.find(".panel-atlas .atlas-note").text_content() == ""


def test_a_layer_is_seen_painted(page):
    page.open("?a=-2.1&b=0.3&d=-1.3&f1=-0.6&f2=0.4&layers=critical,ray")
    marks = "picture.list.filter((it) => it.layer === 'critical' && it.kind === 'mark').map((it) => [it.x, it.y])"
    C = np.array(page.ask(marks)[0])
    [stroke] = [it for it in page.find(".codim2").evaluate(RECORDER) if it.get("colour") == "#123456"]
    assert (stroke["kind"], stroke["width"]) == ("stroke", 2.5)
    [piece] = stroke["path"]
    np.testing.assert_allclose(piece["points"], [[0, 0], C, 2 * C], atol=1e-3)
    assert abs(C[0] * C[1]) > 0.01  # no flip and no swap is the same
    assert page.find("label:has(input[value=ray])").text_content().strip() == "A ray through C"
    page.layer("ray").uncheck()
    page.settle()
    assert not [it for it in page.find(".codim2").evaluate(RECORDER) if it.get("colour") == "#123456"]
