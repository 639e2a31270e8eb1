"""Results show themselves: small pictures that hold what was computed, and the overlay of a scene."""

import re
from xml.etree import ElementTree

import holoviews as hv
import numpy as np
import pytest
from codim2_app import svg

import codim2_core as c2
from codim2_core import drawing
from codim2_core.bifurcations import saddle_node
from codim2_core.diagrams.diagram import diagram

SADDLE = c2.ELinear(1.0, 0.3, -1.2, (0.2, 0.45))
CYCLE = c2.presets["case3-n3"]
RESULTS = {
    "scene": lambda: c2.Scene(SADDLE),
    "scene of its own": lambda: c2.Scene(c2.System(U=("-c + k", "-s"), W=("c",), parameters={"k": 0.3}), z=0.5),
    "trajectories": lambda: c2.trajectories(SADDLE, c2.psi.constant(), [(0.1, 0.2), (1.2, 0.3)], t_max=5),
    "separatrices": lambda: c2.separatrices(SADDLE, c2.psi.constant()),
    "limit cycles": lambda: c2.limit_cycles(CYCLE.system, CYCLE.psi),
    "simulation": lambda: c2.simulate(c2.ELinear(-1, 1, -1), c2.psi.constant(), 0.1, (0.5, 0.2), (0, 3)),
    "curve": lambda: saddle_node(-2, 0.5, -1),
    "diagram": lambda: diagram(SADDLE, c2.psi.constant(), "f1", (-1, 1)),
}


@pytest.mark.parametrize("name", RESULTS)
def test_a_result_shows_itself(name):
    result = RESULTS[name]()
    shown = result._repr_svg_()
    root = ElementTree.fromstring(shown)
    assert root.get("viewBox")
    assert len(shown) < 50_000
    assert "var(" not in shown
    assert "nan" not in shown
    assert "<path" in shown
    html = getattr(result, "_repr_html_", None)
    if html:
        assert shown in html()
        assert len(html()) < 50_000


@pytest.mark.parametrize("key", c2.presets)
def test_every_portrait_is_small(key):
    preset = c2.presets[key]
    scene = c2.Scene(preset.system, preset.psi, preset.z, count=400)
    assert len(scene._repr_html_()) < 50_000


def test_a_portrait_has_the_marks_and_labels_of_its_scene():
    scene = c2.Scene(SADDLE)
    shown = scene._repr_svg_()
    labels = re.findall(r"<text[^>]*>([^<]*)</text>", shown)
    assert len(labels) == len(scene["equator"].theta) + len(scene["critical"])
    marked = [tuple(map(float, at)) for at in re.findall(r"translate\(([\d.]+) ([\d.]+)\)", shown)]
    (C,) = scene["critical"]
    assert min(np.hypot(x - 500 - C.p[0] * 1000 / 3.5, y - 500 + C.p[1] * 1000 / 3.5) for x, y in marked) < 1


def test_a_chart_runs_through_its_ends():
    run = RESULTS["simulation"]()
    shown = svg(run)
    assert re.findall(r">(x|y)</text>", shown) == ["x", "y"]
    assert f">{run.states[:, :2].max():.3g}</text>" in shown
    assert ">3</text>" in shown


def test_there_is_no_picture_of_just_anything():
    with pytest.raises(TypeError, match="no picture of a int"):
        svg(3)


def test_a_scene_plots_itself():
    picture = c2.Scene(SADDLE).plot()
    assert isinstance(picture, hv.Overlay)
    assert {element.label for element in picture} >= {"hemisphere", "inside", "equator", "critical"}


def test_without_the_app_there_are_tables(monkeypatch):
    monkeypatch.setattr(drawing, "DRAWER", "no_such_package")
    scene = c2.Scene(SADDLE)
    assert scene._repr_svg_() is None
    assert scene._repr_html_().count("<table>") == 2
    with pytest.raises(ValueError, match="pip install codim2"):
        scene.plot()
