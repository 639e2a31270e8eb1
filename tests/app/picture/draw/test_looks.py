"""What layers, colours, shapes and the empty figure look like, written down once more."""

import math
import re
from types import SimpleNamespace

import numpy as np
import pytest
from bokeh.core.validation import check_integrity
from codim2_app.picture.draw.figure import make_figure
from codim2_app.picture.draw.layers import LAYERS, TRACES, default_layers, layer_table, layers_in_paint_order, swatches
from codim2_app.picture.draw.shapes import OPEN, shape
from codim2_app.picture.draw.theme import (
    HALF_VIEW,
    HATCHES,
    MAX_HALF_VIEW,
    NEAREST,
    PICTURE_REACH,
    RING,
    themes,
)
from codim2_app.picture.draw.vector.paper import DASHES, paper


def test_layers_lie_above_each_other_as_the_legend_says():
    assert [layer.name for layer in layers_in_paint_order()] == [
        "basins", "outcomes", "lines", "rho", "theta", "conics", "outside", "inside", "continuations", "separatrices",
        "cycles", "launched", "equator", "critical",
    ]  # fmt: skip
    assert [row["name"] for row in layer_table()] == [layer.name for layer in layers_in_paint_order()]
    assert set(LAYERS) - set(default_layers()) == {"separatrices", "conics", "outcomes", "basins"}


def test_what_is_told_of_a_point_is_drawn_thicker_than_what_only_fills_the_picture():
    widths = {part.name: part.width for layer in layers_in_paint_order() for part in layer.parts}
    expected = {
        "outside": 1.2, "inside": 1.4, "continuations": 1.6, "lines_inside": 1.8, "lines_outside": 1.4,
        "rho_inside": 1.8, "rho_outside": 1.8, "theta_inside": 1.8, "theta_outside": 1.8, "separatrices_stable": 2.0,
        "separatrices_unstable": 2.0, "conics": 2.4, "cycles": 2.8, **{f"launched_{k}": 2.4 for k in range(1, 7)},
    }  # fmt: skip
    assert widths == expected
    dashes = {part.name: part.dash for layer in layers_in_paint_order() for part in layer.parts if part.dash}
    assert dashes == {"separatrices_stable": (7, 4), "conics": (9, 3)}
    assert {layer.name for layer in layers_in_paint_order() if not layer.compiled} == {
        "lines", "rho", "theta", "conics", "equator", "critical", "outcomes", "basins",
    }  # fmt: skip
    assert [layer.name for layer in layers_in_paint_order() if layer.optional] == ["launched"]


def test_parts_take_from_the_scene_what_is_theirs():
    """Separatrices within, by their direction; nullclines by their kind; launched orbits in turn by their colour."""
    parts = {part.name: part.pieces for layer in layers_in_paint_order() for part in layer.parts}

    def one(k, **more):
        return SimpleNamespace(points=np.full((k + 2, 2), float(k)), **more)

    ways = [(inside, direction) for inside in (True, False) for direction in ("stable", "unstable")]
    branches = [one(k, inside=inside, direction=direction) for k, (inside, direction) in enumerate(ways)]
    for k, name in enumerate(("separatrices_stable", "separatrices_unstable")):
        offsets, points = parts[name](branches)
        assert (np.diff(offsets).tolist(), set(points.ravel())) == ([k + 2], {float(k)})
    lines = [one(k, kind=kind) for k, kind in enumerate(("rho", "theta", "U1", "U2"))]
    of = {"rho_inside": {0}, "theta_outside": {1}, "lines_inside": {2, 3}, "lines_outside": {2, 3}}
    assert {name: set(parts[name](lines)[1].ravel()) for name in of} == of
    orbits = SimpleNamespace(orbits=SimpleNamespace(points=[np.full((2, 2), float(k)) for k in range(8)]))
    assert set(parts["launched_2"](orbits)[1].ravel()) == {1.0, 7.0}


def test_what_differs_in_meaning_differs_by_dashes_and_carries_its_arrows():
    parts = {part.name: part for layer in LAYERS.values() for part in layer.parts}
    assert {name for name, part in parts.items() if part.dash} == {"separatrices_stable", "conics"}
    carry = {"outside", "inside", "continuations", "separatrices_stable", "separatrices_unstable", "cycles"}
    carry |= {f"launched_{k}" for k in range(1, 7)}
    assert {name for name, part in parts.items() if part.arrows} == carry
    assert [(part.name, bool(part.dash)) for part in TRACES] == [("limit", False), ("motion", True)]
    assert (parts["rho_inside"].scene, parts["rho_outside"].scene) == ("nullclines_inside", "nullclines_outside")
    assert (parts["lines_inside"].colour, parts["lines_outside"].colour) == ("lines-in", "lines-out")


def test_the_ring_is_told_apart_by_hatches_and_lies_just_outside_the_equator():
    assert HATCHES == {"slide": "", "cross": "/", "depends": "x", "undecided": ".", "misses": ""}
    assert RING == (1.03, 1.075)
    assert pytest.approx(HALF_VIEW * math.sqrt(2.0), rel=0.02) == PICTURE_REACH  # to the corners of the square picture


def test_the_figure_is_empty_and_sends_nothing_back():
    plot = make_figure()
    integrity = check_integrity(plot.references())  # no word for the host's log
    assert integrity.warning == integrity.error == plot.renderers == []
    assert (plot.min_border, plot.title, plot.toolbar_location, plot.lod_threshold) == (0, None, None, None)
    assert (plot.outline_line_color, plot.background_fill_color, plot.border_fill_color) == (None, None, None)
    assert len(list(plot.references())) < 16
    assert not any(model.syncable for model in plot.references())
    for given in (plot.x_range, plot.y_range):
        assert (given.start, given.end, given.min_interval, given.max_interval) == (-HALF_VIEW, HALF_VIEW, 0.1, 24.0)
    assert (2 * NEAREST, 2 * MAX_HALF_VIEW) == (0.1, 24.0)
    wheel = next(tool for tool in plot.tools if type(tool).__name__ == "WheelZoomTool")
    assert wheel.modifiers == {"ctrl": True}
    assert next(tool for tool in plot.tools if type(tool).__name__ == "BoxZoomTool").match_aspect


def corners(name, size=12.0):
    return [tuple(map(float, pair)) for pair in re.findall(r"(-?[\d.e-]+) (-?[\d.e-]+)", shape(name, size))]


def test_marks_have_their_shapes_with_y_downward():
    assert shape("square", 12) == "M-6 -6H6V6H-6Z"
    assert corners("diamond") == [(0, -6), (4, 0), (0, 6), (-4, 0)]
    assert corners("triangle") == [(0, -6.93), (6, 3.46), (-6, 3.46)]
    assert corners("x") == [(-6, -6), (6, 6), (6, -6), (-6, 6)]
    assert len(corners("hex")) == 6
    assert [math.hypot(*corner) for corner in corners("hex")] == pytest.approx([6] * 6, abs=0.01)
    assert corners("hex")[:2] == [(6, 0), (3, 5.2)]
    assert shape("circle", 12) == "M6 0A6 6 0 1 1 -6 0A6 6 0 1 1 6 0Z"
    assert shape("circle_dot", 12) == shape("circle", 12) + shape("circle", 3)
    assert OPEN == ("x",)
    with pytest.raises(ValueError, match="no mark 'star'"):
        shape("star", 12)


@pytest.mark.parametrize("layer", LAYERS.values(), ids=lambda layer: layer.name)
def test_the_mark_beside_a_layers_control_has_the_layers_colours_in_their_order(layer):
    rule = next(line for line in swatches().splitlines() if f".swatch-{layer.name} " in line)
    named = re.findall(r"var\(--([\w-]+)\)", rule)
    assert named
    assert named == list(layer.colours)[: len(named)]


def test_in_black_and_white_lines_that_colours_tell_apart_differ():
    looks = {}
    for layer in layers_in_paint_order():
        for part in layer.parts:
            look = (paper()[part.colour], part.dash or DASHES.get(part.colour, ()), part.width)
            looks.setdefault(look, set()).add(part.name.removesuffix("_inside").removesuffix("_outside"))
    alike = [names for names in looks.values() if len(names) > 1]
    assert alike == []
    assert all(len(dash) % 2 == 0 and min(dash) >= 2 for dash in DASHES.values())
    assert set(DASHES) <= set(themes()["light"])
