"""SVG and HoloViews show what the core computes: read back in data space, at settings without any symmetry."""

import math
import re

import holoviews as hv
import numpy as np
import pytest
from codim2_app.picture.draw import layers
from codim2_app.picture.draw.overlay import elements, holoviews
from codim2_app.picture.draw.svg import SMALL_SIDE, draw, small
from codim2_app.picture.draw.theme import HALF_VIEW, themes
from codim2_app.picture.draw.vector.parts import VIEWBOX_SIDE
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.view.refresh import Frames

from tests.app.near import gaps

NODE = {"a": -2.0, "b": 0.35, "d": -1.0, "f1": -0.4, "f2": 0.25, "psi": "rational"}
SADDLE = {"a": 1.0, "b": 0.3, "d": -1.2, "f1": 0.2, "f2": 0.45, "psi": "rational"}
SETTINGS = pytest.mark.parametrize("setting", [NODE, SADDLE], ids=["node", "saddle"])


def picture(setting, *shown):
    """The picture's SVG, and the scene that it shows."""
    frames = Frames(ExplorerState(**setting, layers=list(shown)))
    return draw(frames.answer({"all": True}), list(shown)), frames.scene


def attributes(svg, tag="path"):
    return [dict(re.findall(r'([\w-]+)="([^"]*)"', found)) for found in re.findall(rf"<{tag} [^>]*>", svg)]


def pieces(path, side, view):
    """The polylines of a path of M and L, in data space."""
    return [
        np.array([[float(v) for v in pair.split()] for pair in piece.split("L")]) * (2 * view / side, -2 * view / side)
        + (-view, view)
        for piece in path.strip("Z").split("M")[1:]
    ]


@SETTINGS
@pytest.mark.parametrize(("layer", "colour"), [("outside", "outside"), ("inside", "orbit")])
def test_svg_orbits_are_parts_of_the_cores(setting, layer, colour):
    svg, scene = picture(setting, layer)
    [stroke] = [one for one in attributes(svg) if one.get("stroke") == f"var(--{colour})"]
    found = pieces(stroke["d"], VIEWBOX_SIDE, HALF_VIEW)
    assert len(found) > 10
    assert gaps(np.concatenate(found), scene[layer].points).max() < 2 * HALF_VIEW / VIEWBOX_SIDE


@SETTINGS
def test_svg_marks_have_their_place_colour_and_inside(setting):
    whole = *picture(setting, "equator", "critical"), VIEWBOX_SIDE, HALF_VIEW
    for svg, scene, side, view in (whole, _small(setting)):
        marks = [one for one in attributes(svg) if "transform" in one]
        q = scene["equator"]
        assert len(marks) == len(q.theta) + 1
        for theta, rho, ang, mark in zip(q.theta, q.lambda_rho, q.lambda_theta, marks, strict=False):
            assert _middle(mark, side, view) == pytest.approx((math.cos(theta), math.sin(theta)), abs=2 * view / side)
            colour = "var(--attr)" if rho < 0 else "var(--rep)"
            assert (mark["stroke"], mark["fill"]) == (colour, colour if rho < 0 else "var(--page)")
            assert ("A" in mark["d"]) == (ang < 0)  # a circle, or a diamond
        [C] = scene["critical"]
        assert _middle(marks[-1], side, view) == pytest.approx(C.p, abs=2 * view / side)
        fill = "none" if C.kind == "saddle" else "var(--crit)"
        assert (marks[-1]["stroke"], marks[-1]["fill"]) == ("var(--crit)", fill)


def _small(setting):
    scene = Frames(ExplorerState(**setting)).scene.evolve(view=2.1, count=22)
    return small(scene, 1.5), scene, SMALL_SIDE, 1.5


def _middle(mark, side, view):
    u, v = map(float, re.match(r"translate\((\S+) (\S+)\)", mark["transform"]).groups())
    return u * 2 * view / side - view, view - v * 2 * view / side


def test_the_ring_lies_where_the_trajectories_arrive():
    svg, scene = picture(SADDLE, "outcomes")
    colours = {"slide": "var(--slide)", "cross": "var(--cross)", "misses": "var(--misses)", "cycle": "var(--slide)"}
    arcs = scene["outcomes"].arcs
    found = [one for one in attributes(svg) if one.get("fill") in {*colours.values(), "var(--depends)"}]
    assert len(found) == len(arcs) > 1
    for (start, end, outcome), one in zip(arcs, found, strict=True):
        [points] = pieces(one["d"], VIEWBOX_SIDE, HALF_VIEW)
        middle = points[: len(points) // 2].mean(axis=0)
        side = 1 if end - start < math.pi else -1  # of more than half a turn, the mean lies opposite
        assert side * math.cos(math.atan2(middle[1], middle[0]) - (start + end) / 2) > 0.99
        assert one["fill"] == ("var(--depends)" if outcome.depends_on_psi else colours[outcome.verdict])


@SETTINGS
def test_holoviews_shows_the_core(setting):
    hv.extension("bokeh")
    scene = Frames(ExplorerState(**setting)).scene
    made = elements(scene)
    inside, outside = scene["nullclines_inside"], scene["nullclines_outside"]
    lines = ("U1", "U2")
    for name, colour, expected in [
        ("lines-in", "#edb120", [b.points for b in inside if b.kind in lines]),
        ("lines-out", "#7e2f8e", [b.points for b in outside if b.kind in lines]),
        ("rho", "#0072bd", [b.points for b in (*inside, *outside) if b.kind == "rho"]),
        ("inside", themes()["light"]["orbit"], scene["inside"].points),
        ("outside", themes()["light"]["outside"], scene["outside"].points),
    ]:
        element = made[{"lines-in": "lines_inside", "lines-out": "lines_outside"}.get(name, name)]
        found = element.split(datatype="array")
        assert len(found) == len(expected)
        assert all(np.array_equal(one, other) for one, other in zip(found, expected, strict=True))
        assert element.opts.get("style").kwargs["color"] == colour
    q, marks = scene["equator"], made["equator"]
    assert marks.dimension_values(0) == pytest.approx(np.cos(q.theta))
    assert marks.dimension_values(1) == pytest.approx(np.sin(q.theta))
    expected = ["#15803d" if rho < 0 else "#be185d" for rho in q.lambda_rho]
    assert list(marks.dimension_values("colour")) == expected
    assert list(marks.dimension_values("fill")) == [c if c == "#15803d" else "#ffffff" for c in expected]
    assert np.column_stack([made["critical"].dimension_values(i) for i in (0, 1)]) == pytest.approx(
        np.array([C.p for C in scene["critical"]])
    )


def test_holoviews_has_equal_axes_of_the_pictures_window_and_its_widths():
    hv.extension("bokeh")
    scene = Frames(ExplorerState(**NODE)).scene
    made, drawn = elements(scene), hv.render(holoviews(scene), backend="bokeh")
    for axis in (drawn.x_range, drawn.y_range):
        assert (axis.start, axis.end) == (-HALF_VIEW, HALF_VIEW)
    plot = holoviews(scene).opts.get("plot").kwargs
    assert (plot["data_aspect"], plot["frame_width"]) == (1, 500)
    assert "launched" not in made  # nobody has asked for one
    assert "launched_1" in elements(scene.evolve(launch=((0.3, 0.2),)))
    circle = made["hemisphere"].array()
    assert np.hypot(*circle.T) == pytest.approx(np.ones(len(circle)))
    widths = {name: element.opts.get("style").kwargs["line_width"] for name, element in made.items()}
    curves = {part.name: part.width for layer in layers.layers_in_paint_order() for part in layer.parts}
    for name in ("rho", "theta", "inside", "outside", "lines_inside", "lines_outside"):
        assert widths[name] == (curves[name] if name in curves else curves[f"{name}_inside"])
    assert widths["hemisphere"] == widths["equator"] == widths["critical"] == 2  # as marks have in the page
    sizes = [made[name].opts.get("style").kwargs["size"] for name in ("equator", "critical")]
    assert sizes == [11, 12]
    assert all("hover" in made[name].opts.get("plot").kwargs["tools"] for name in ("equator", "critical"))
