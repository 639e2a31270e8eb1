"""Results show themselves: small pictures that hold what was computed, and the overlay of a scene."""

import re
import sys

import holoviews as hv
import numpy as np
import pytest
from codim2_app import svg
from codim2_app.exports.small.chart import line_chart
from codim2_app.exports.small.results import sketch
from codim2_app.exports.small.sketch import Curves, LineChart, RegionChart
from matplotlib.figure import Figure

import codim2_core as c2
from codim2_core.bifurcations import saddle_node
from codim2_core.bifurcations.diagrams.eigenvalue_path import linearisation_path
from codim2_core.portrait.basins import Basins
from codim2_core.results import drawing

SADDLE = c2.ELinear(1.0, 0.3, -1.2, (0.2, 0.45))
NODE = c2.ELinear(-2, 0, -1, f=(-0.5, 0))
CYCLE = c2.presets["case3-n3"]
PUSHED = c2.System(U=("-z1 - 0.3*c + 0.5*cos(2*z3)", "-z2 - 0.3*s + 0.5*sin(2*z3) + z4/1000"), W=("x", "y", "1", "-z4"))
RESULTS = {
    "scene": lambda: c2.Scene(SADDLE),
    "scene of its own": lambda: c2.Scene(c2.System(U=("-c + k", "-s"), W=("c",), parameters={"k": 0.3}), z=0.5),
    "trajectories": lambda: c2.trajectories(SADDLE, c2.psi.constant(), [(0.1, 0.2), (1.2, 0.3)], t_max=5),
    "separatrices": lambda: c2.separatrices(SADDLE, c2.psi.constant()),
    "limit cycles": lambda: c2.limit_cycles(CYCLE.system, CYCLE.psi),
    "simulation": lambda: c2.simulate(c2.ELinear(-1, 1, -1), c2.psi.constant(), (0.5, 0.2), (0, 3), eps=0.1),
    "periodic motion": lambda: c2.periodic_motion(PUSHED, (0.3, 0.0, 0.0, -0.1, 0.0, 0.0), np.pi),
    "curve": lambda: saddle_node(c2.ELinear(-2, 0.5, -1)),
    "branches": lambda: c2.branches(SADDLE, c2.psi.constant(), "f1", (-1, 1)),
}


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


def _areas(svg):
    """Rectangles of basins: colour, left, top, right, bottom."""
    for path, colour in re.findall(r'<path d="([^"]*)" fill="([^"]*)" opacity', svg):
        for x, y, wide, tall in re.findall(r"M([-\d.]+) ([-\d.]+)h([\d.]+)v([\d.]+)h-[\d.]+Z", path):
            left, top = float(x), float(y)
            yield colour, left, top, left + float(wide), top + float(tall)


def test_basins_are_drawn_where_they_are():
    """One cell in four leads to the first set: that at the lower left; all others to the second."""
    cells = np.ones((32, 32), np.int8)
    cells[:16, :16] = 0
    found = Basins(cells, ("C1", "C2"), (None, None), 0)
    first, second = {}, {}
    for colour, left, top, right, bottom in _areas(svg(found)):
        first.setdefault(colour, []).append((left, right))
        second.setdefault(colour, []).append((top, bottom))
    size = max(right for spans in first.values() for _, right in spans)
    (small,) = (c for c in first if sum(b - a for a, b in first[c]) < 0.3 * 32 * size)
    assert max(right for _, right in first[small]) == pytest.approx(size / 2, abs=2)
    assert min(top for top, _ in second[small]) == pytest.approx(size / 2, abs=size / 32 + 2)
    assert max(bottom for _, bottom in second[small]) == pytest.approx(size, abs=2)


LINE = c2.ELinear(-1, 0, -1, ("z", "0.25*z"), B=((0, 0),), g=(0.25,))
STEEP = c2.ELinear(-1, 0, -1, ("0.25*z", "z"), B=((0, 0),), g=(0.25,))
ROUND = c2.System(U=("-z1 - S*c + cos(2*z3)", "-z2 - S*s + sin(2*z3)"), W=("x", "y", "1"), parameters={"S": 0.5})
CHARTS = {
    "branches": (lambda: c2.branches(SADDLE, c2.psi.constant(), "f1", (-1, 1)),
                lambda r: [(b.value, b.theta) for b in r.limit_directions]
                + [(b.value, np.unwrap(np.arctan2(b.e[:, 1], b.e[:, 0]))) for b in r.critical], ("f1", "θ")),
    "simulation": (RESULTS["simulation"], lambda r: [(r.times, r.states[:, i]) for i in (0, 1)], ("t", "")),
    "periodic motion": (RESULTS["periodic motion"],  # the clock, z3, would crush it
                        lambda r: [(r.run.times, r.run.states[:, i]) for i in (0, 1, 2, 3, 5)], ("t", "")),
    "curve": (RESULTS["curve"], lambda r: [(b[:, 0], b[:, 1]) for b in r.branches], ("f₁", "f₂")),
    "linearisation": (lambda: linearisation_path(SADDLE, c2.psi.constant(), "f1", (-0.3, 0.3)),
                      lambda r: [(r.values, r.trace)], ("f1", "tr J")),
    "slow portrait": (lambda: c2.slow_portrait(LINE, c2.psi.constant(), "z1", (-0.5, 0.6)),
                      lambda r: [(b.z, b.e[:, 0]) for b in r.branches], ("z", "c")),
    "slow portrait, steep": (lambda: c2.slow_portrait(STEEP, c2.psi.constant(), "z1", (-0.5, 0.6)),
                             lambda r: [(b.z, b.e[:, 1]) for b in r.branches], ("z", "s")),
    "response curve": (
        lambda: c2.response_curve(ROUND, (0.0, -0.55, -0.28, 0.07, 0.0), np.pi, along="S", span=(0.49, 0.51)),
        lambda r: [(r.values, r.amplitude[:, 0])], ("S", "amplitude of z₁")),
    "psi": (lambda: c2.psi.tanh(), lambda r: [(np.linspace(0, 4, 161), r(np.linspace(0, 4, 161)))], ("s", "Ψ")),
}  # fmt: skip


@pytest.mark.parametrize("name", CHARTS)
def test_charts_have_the_parameter_across_and_the_number_up(name):
    make, columns, axes = CHARTS[name]
    result = make()
    shown = sketch(result)
    assert (shown.across, shown.up) == axes
    wanted = [np.column_stack(pair) for pair in columns(result)]
    found = np.concatenate([np.column_stack([x, y]) for _, x, y in shown.lines])
    np.testing.assert_allclose(found[np.lexsort(found.T)], (every := np.concatenate(wanted))[np.lexsort(every.T)])


def test_a_chart_has_its_axes_right_and_up():
    line = ("rises", np.array([1.0, 2.0, 4.0]), np.array([-3.0, -2.5, 5.0]))
    shown, _ = line_chart(LineChart([line], "across", "up"))
    points = re.search(r'<path d="M([-\d. L]+)"', shown)[1]
    (x0, y0), (x1, y1), (x2, y2) = (map(float, pair.split()) for pair in points.split("L"))
    assert (x1 - x0) / (x2 - x0) == pytest.approx(1 / 3, abs=2e-3)
    assert (y1 - y0) / (y2 - y0) == pytest.approx(0.5 / 8, abs=2e-3)
    assert x2 > x0
    assert y2 < y0  # y is downward in SVG
    at = {
        word: (float(x), float(y)) for x, y, word in re.findall(r'<text x="([\d.]+)" y="([\d.]+)"[^>]*>([^<]*)<', shown)
    }
    assert at["1"][0] < at["4"][0]
    assert at["5"][1] < at["−3"][1]


PLOTTED = {
    **{name: make for name, (make, *_) in CHARTS.items() if name != "psi"},
    **{name: RESULTS[name] for name in ("trajectories", "separatrices", "limit cycles")},
    "nullclines": lambda: c2.nullclines(SADDLE, c2.psi.constant()),
    "atlas": lambda: c2.atlas(SADDLE, c2.psi.constant(), ("f1", "f2")),
    "regions": lambda: c2.bifurcations.regions(c2.ELinear(-2, 0.5, -1)),
    "basins": lambda: c2.basins(SADDLE, c2.psi.constant(), n=32),
}


@pytest.mark.parametrize("name", PLOTTED)
def test_matplotlib_draws_what_the_notebook_shows(name):
    """Every number of the picture is in the axes that were given; without axes there are new ones."""
    result, shown = PLOTTED[name](), sketch(PLOTTED[name]())
    axes = Figure().add_subplot()
    assert result.plot(axes) is axes
    lines = [line.get_xydata() for line in axes.lines]
    if isinstance(shown, LineChart):
        assert (axes.get_xlabel(), axes.get_ylabel()) == (shown.across, shown.up)
        for line, (_, x, y) in zip(lines, shown.lines, strict=False):
            np.testing.assert_array_equal(line, np.column_stack([x, y]))
    elif isinstance(shown, Curves):
        for line, (_, points) in zip(lines, shown.pieces, strict=False):
            np.testing.assert_array_equal(line, points)
    elif isinstance(shown, RegionChart):
        assert [patch.get_label().lstrip("_") for patch in axes.patches] == [name for name, _ in shown.areas]
        assert (axes.get_xlim(), axes.get_ylim()) == tuple(shown.spans)
    else:
        (image,) = axes.images
        np.testing.assert_array_equal(image.get_array().data, shown.cells)
        assert [text.get_text() for text in axes.get_legend().texts] == list(shown.names)


def test_without_matplotlib_it_is_said(monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(ValueError, match="pip install matplotlib"):
        RESULTS["curve"]().plot()


SAVED = {name: PLOTTED[name] for name in ("trajectories", "separatrices", "nullclines", "basins", "branches", "atlas")}
SAVED |= {name: RESULTS[name] for name in ("scene", "simulation")}


@pytest.mark.parametrize("name", SAVED)
def test_a_picture_is_written_as_svg_png_and_pdf(name, tmp_path):
    pytest.importorskip("typst")
    result = SAVED[name]()
    for kind, first in (("svg", b"<svg"), ("png", b"\x89PNG"), ("pdf", b"%PDF")):
        result.save(tmp_path / f"it.{kind}")
        assert (tmp_path / f"it.{kind}").read_bytes().startswith(first)
    with pytest.raises(ValueError, match=r"\.svg, \.png or \.pdf"):
        result.save(tmp_path / "it.jpg")


def test_a_result_without_a_picture_says_what_to_do(tmp_path):
    with pytest.raises(ValueError, match="draw its Scene"):
        c2.classify(SADDLE, c2.psi.constant()).save(tmp_path / "it.svg")


def test_matplotlib_draws_a_portrait_with_names_and_branches_with_special_points():
    one, other, plane = Figure().subplots(1, 3)
    scene = c2.Scene(NODE)
    assert scene.plot(one) is one
    assert {"Q1", "Q2", "Q3", "Q4", "C1"} <= {text.get_text() for text in one.texts}
    assert "Orbits inside" in {text.get_text() for text in one.get_legend().texts}
    c2.branches(NODE, c2.psi.constant(), "f1", (-3.0, 3.0)).plot(other)
    assert {"C, stable node", "transcritical", "pitchfork"} <= {text.get_text() for text in other.get_legend().texts}
    c2.atlas(NODE, c2.psi.constant(), ("f1", "f2")).plot(plane)
    names = [text.get_text() for text in plane.get_legend().texts]
    assert len(names) == len(set(names)) >= 3
    assert np.allclose(np.hypot(*scene.to_frame()[["p_1", "p_2"]].iloc[:4].to_numpy().T), 1.0)
