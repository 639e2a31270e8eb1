"""What each mark, colour and word stands for, written down once more; and the small parts that pictures are made of."""

import math
import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from bokeh.core.validation import check_integrity
from codim2_app.draw import glyphs, plane_curves
from codim2_app.draw.figure import make_figure
from codim2_app.draw.layers import LAYERS, TRACES, painted, shown, swatches, table
from codim2_app.draw.mathml import equations_mathml, mathml, plain_symbol, symbol
from codim2_app.draw.packing import EXTENT, Polylines, pack, unpack
from codim2_app.draw.shapes import OPEN, shape
from codim2_app.draw.still import page_of, still
from codim2_app.draw.svg import draw, small
from codim2_app.draw.theme import DISCS, HATCHES, NEAREST, REACH, RING, VIEW, WIDEST, custom_properties, themes
from codim2_app.draw.thumbnails import COUNT, MOST, PIXEL, thumbnails
from codim2_app.draw.thumbnails import VIEW as SMALL_VIEW
from codim2_app.draw.vector import parts as vector
from codim2_app.draw.vector.paper import DASHES, paper
from codim2_app.draw.vector.parts import SIDE, Place

import codim2_core as c2
from codim2_core.expressions.expression import parse


def test_layers_lie_above_each_other_as_the_legend_says():
    assert [layer.name for layer in painted()] == [
        "basins", "outcomes", "lines", "rho", "theta", "conics", "outside", "inside", "continuations", "separatrices",
        "cycles", "launched", "equator", "critical",
    ]  # fmt: skip
    assert [row["name"] for row in table()] == [layer.name for layer in painted()]
    assert set(LAYERS) - set(shown()) == {"separatrices", "conics", "outcomes", "basins"}


def test_what_is_told_of_a_point_is_drawn_thicker_than_what_only_fills_the_picture():
    widths = {part.name: part.width for layer in painted() for part in layer.parts}
    expected = {
        "outside": 0.9, "inside": 0.9, "continuations": 1.6, "lines_inside": 1.8, "lines_outside": 1.4,
        "rho_inside": 1.8, "rho_outside": 1.8, "theta_inside": 1.8, "theta_outside": 1.8, "separatrices_stable": 2.0,
        "separatrices_unstable": 2.0, "conics": 2.4, "cycles": 2.8, **{f"launched_{k}": 2.4 for k in range(1, 7)},
    }  # fmt: skip
    assert widths == expected
    dashes = {part.name: part.dash for layer in painted() for part in layer.parts if part.dash}
    assert dashes == {"separatrices_stable": (7, 4), "conics": (9, 3)}
    assert {layer.name for layer in painted() if layer.hidden} == {"separatrices", "conics", "outcomes", "basins"}
    assert {layer.name for layer in painted() if not layer.compiled} == {
        "lines", "rho", "theta", "conics", "equator", "critical", "outcomes", "basins",
    }  # fmt: skip
    assert [layer.name for layer in painted() if layer.optional] == ["launched"]


def test_parts_take_from_the_scene_what_is_theirs():
    """Separatrices within, by their direction; nullclines by their kind; launched orbits in turn by their colour."""
    parts = {part.name: part.pieces for layer in painted() for part in layer.parts}

    def one(k, **more):
        return SimpleNamespace(points=np.full((k + 2, 2), float(k)), **more)

    ways = [(inside, direction) for inside in (True, False) for direction in ("stable", "unstable")]
    branches = [one(k, inside=inside, direction=direction) for k, (inside, direction) in enumerate(ways)]
    for k, name in enumerate(("separatrices_stable", "separatrices_unstable")):
        offsets, points = parts[name](branches)
        assert (np.diff(offsets).tolist(), set(points.ravel())) == ([k + 2], {float(k)})
    lines = [one(k, kind=kind) for k, kind in enumerate(("rho", "theta", "U1", "U2"))]
    for name, kinds in (
        ("rho_inside", {0}),
        ("theta_outside", {1}),
        ("lines_inside", {2, 3}),
        ("lines_outside", {2, 3}),
    ):
        assert set(parts[name](lines)[1].ravel()) == kinds
    orbits = SimpleNamespace(orbits=SimpleNamespace(points=[np.full((2, 2), float(k)) for k in range(8)]))
    assert set(parts["launched_2"](orbits)[1].ravel()) == {1.0, 7.0}


def test_what_differs_in_meaning_differs_by_dashes_and_carries_its_arrows():
    parts = {part.name: part for layer in LAYERS.values() for part in layer.parts}
    assert {name for name, part in parts.items() if part.dash} == {"separatrices_stable", "conics"}
    carry = {"outside", "inside", "continuations", "separatrices_stable", "separatrices_unstable", "cycles"}
    carry |= {f"launched_{k}" for k in range(1, 7)}
    assert {name for name, part in parts.items() if part.arrows} == carry
    assert [(part.name, bool(part.dash)) for part in TRACES] == [("limit", True), ("motion", False)]
    assert (parts["rho_inside"].scene, parts["rho_outside"].scene) == ("nullclines_inside", "nullclines_outside")
    assert (parts["lines_inside"].colour, parts["lines_outside"].colour) == ("lines-in", "lines-out")


@pytest.mark.parametrize(
    ("name", "light", "dark"),
    [
        ("page", "#ffffff", "#12161d"), ("ink", "#1c2430", "#e6eaf0"), ("attr", "#15803d", "#4ade80"),
        ("rep", "#be185d", "#f472b6"), ("crit", "#c8102e", "#ff5468"), ("slide", "#0d9488", "#2dd4bf"),
        ("cross", "#e8751a", "#fb923c"), ("depends", "#7c3aed", "#a78bfa"), ("rho", "#0072bd", "#4aa8e8"),
        ("theta", "#d95319", "#ff8552"), ("lines-in", "#edb120", "#f2c14e"), ("lines-out", "#7e2f8e", "#c58ad6"),
        ("cycle", "#e0121f", "#ff3b47"), ("separatrix", "#6d28d9", "#b794ff"), ("motion", "#c026d3", "#f0abfc"),
    ],
)  # fmt: skip
def test_colours_of_light_and_dark(name, light, dark):
    assert (themes()["light"][name], themes()["dark"][name]) == (light, dark)
    first, second = custom_properties().splitlines()
    assert first.startswith(".codim2 {")
    assert f"--{name}: {light};" in first
    assert second.startswith(".codim2.dark {")
    assert f"--{name}: {dark};" in second


def test_the_ring_is_told_apart_by_hatches_and_lies_just_outside_the_equator():
    assert HATCHES == {"slide": "", "cross": "/", "depends": "x", "undecided": ".", "misses": ""}
    assert RING == (1.03, 1.075)
    assert DISCS[-1] == 1.0
    assert np.diff(DISCS[:-1]) == pytest.approx(0.06)
    assert (DISCS[0], len(DISCS)) == (0.04, 17)
    assert pytest.approx(VIEW * math.sqrt(2.0), rel=0.02) == REACH  # to the corners of the square picture


def test_bokeh_has_no_warning_for_the_hosts_log():
    plot = make_figure()
    assert check_integrity(plot.references()).warning == []
    assert check_integrity(plot.references()).error == []


def test_the_figure_is_empty_and_sends_nothing_back():
    plot = make_figure()
    assert plot.renderers == []
    assert len(list(plot.references())) < 16
    assert not any(model.syncable for model in plot.references())
    for given in (plot.x_range, plot.y_range):
        assert (given.start, given.end, given.min_interval, given.max_interval) == (-VIEW, VIEW, 0.1, 24.0)
    wheel = next(tool for tool in plot.tools if type(tool).__name__ == "WheelZoomTool")
    assert wheel.modifiers == {"ctrl": True}
    assert next(tool for tool in plot.tools if type(tool).__name__ == "BoxZoomTool").match_aspect


def test_nothing_stands_around_the_picture():
    plot = make_figure()
    assert (plot.min_border, plot.title, plot.toolbar_location, plot.lod_threshold) == (0, None, None, None)
    assert (plot.outline_line_color, plot.background_fill_color, plot.border_fill_color) == (None, None, None)
    assert [axis.end for axis in (plot.x_range, plot.y_range)] == [VIEW, VIEW]
    assert [axis.start for axis in (plot.x_range, plot.y_range)] == [-VIEW, -VIEW]
    assert (plot.x_range.min_interval, plot.x_range.max_interval) == (2 * NEAREST, 2 * WIDEST)


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


@pytest.mark.parametrize(
    ("rho", "ang", "multiplicity", "words"),
    [
        (-1, -1, 1, "radially and angularly attracting"), (1, 2, 1, "radially and angularly repelling"),
        (-1, 1, 1, "radially attracting, angularly repelling"), (1, -1, 1, "radially repelling, angularly attracting"),
        (0, 1, 1, "radially neutral, angularly repelling"), (-1, 0, 1, "radially attracting, angularly degenerate"),
        (1, -1, 2, "radially repelling, angularly degenerate"),
    ],
)  # fmt: skip
def test_words_on_equator_equilibria(rho, ang, multiplicity, words):
    assert glyphs.equator_type(rho, ang, multiplicity) == words


def equator(theta, rho, ang, multiplicity=None, all_directions=False):
    columns = {"theta": theta, "lambda_rho": rho, "lambda_theta": ang, "multiplicity": multiplicity or [1] * len(theta)}
    arrays = {name: np.array(values, float) for name, values in columns.items()}
    return type("Equator", (), {**arrays, "all_directions": all_directions})()


def test_equator_columns_say_what_the_numbers_are():
    q = glyphs.equator_columns(equator([0.25, 1.0, 2.5, 4.0], [-1, 2, 0, -3], [0.5, -1, 2, 0.0], [1, 1, 1, 2]))
    assert q["label"] == ["Q₁", "Q₂", "Q₃", "Q₄"]
    assert q["filled"] == [1, 0, 0, 1]
    assert q["shape"] == ["diamond", "circle", "diamond", "triangle"]
    assert q["size"] == [18, 13, 18, 15]
    assert q["colour"] == ["attr", "rep", "degenerate", "degenerate"]
    assert (q["x"][1], q["y"][1]) == (math.cos(1.0), math.sin(1.0))
    assert (q["label_x"][1], q["label_y"][1]) == pytest.approx((1.11 * math.cos(1.095), 1.11 * math.sin(1.095)))
    assert (q["lambda_rho"], q["lambda_theta"], q["multiplicity"]) == ([-1, 2, 0, -3], [0.5, -1, 2, 0], [1, 1, 1, 2])


def test_labels_that_are_too_near_move_apart_fairly_also_across_zero():
    assert glyphs.spread([1.0, 1.1]) == pytest.approx([0.97, 1.13])
    assert glyphs.spread([1.0, 1.16, 3.0]) == pytest.approx([1.0, 1.16, 3.0])
    assert glyphs.spread([0.02, 3.0, 2 * math.pi - 0.02]) == pytest.approx([0.08, 3.0, 2 * math.pi - 0.08])
    assert glyphs.spread([2.0]) == [2.0]
    apart = np.diff(glyphs.spread([1.0, 1.01, 1.02, 1.03]))
    assert apart == pytest.approx([0.16] * 3, abs=1e-6)


def test_arrows_on_the_equator_leave_what_repels_and_reach_what_attracts():
    found = glyphs.equator_arrows(equator([0.5, 1.5, 1.6, 4.0], [1] * 4, [1.0, -2.0, 3.0, -1.0]))
    middles = [1.0, (1.6 + 4.0) / 2, (4.0 + 0.5) / 2 + math.pi]  # none where there is no room
    assert [x for x, *_ in found] == pytest.approx([math.cos(t) for t in middles])
    assert [y for _, y, _ in found] == pytest.approx([math.sin(t) for t in middles])
    senses = [1, 1, -1]
    assert [a for *_, a in found] == pytest.approx([t + s * math.pi / 2 for t, s in zip(middles, senses, strict=True)])
    [one] = glyphs.equator_arrows(equator([1.0], [1], [-1.0]))
    assert one == pytest.approx((math.cos(1 + math.pi), math.sin(1 + math.pi), 1 + math.pi + -1 * math.pi / 2))
    # of a double zero the next one tells
    first, second = glyphs.equator_arrows(equator([1.0, 3.0], [1, 1], [0.0, -1.0], [2, 1]))
    assert first[2] == pytest.approx(2.0 + math.pi / 2)
    assert second[2] == pytest.approx(2.0 + math.pi - math.pi / 2)
    assert glyphs.equator_arrows(equator([0.5], [1], [1], all_directions=True)) == []
    assert glyphs.equator_arrows(equator([], [], [])) == []
    turning = glyphs.equator_arrows(equator([], [], []), -1)
    places = [math.pi * (i + 0.5) / 2 for i in range(4)]
    assert [a for *_, a in turning] == pytest.approx([t - math.pi / 2 for t in places])
    assert [x for x, *_ in turning] == pytest.approx([math.cos(t) for t in places])


def test_critical_columns_say_what_the_core_does():
    system = c2.ELinear(1.0, 0.3, -1.2, (0.2, 0.45), B=((1.0, 0.3),), g=(0.9,))
    [C] = c2.critical_sets(system, c2.psi.rational(), (0.0,))
    told = glyphs.critical_columns([C])
    assert (told["label"], told["kind"], told["shape"], told["filled"]) == (["C"], ["saddle"], ["x"], [0])
    assert told["e"] == [[float(v) for v in C.e]]
    assert told["x2"] == [[float(v) for v in C.x2]]
    assert told["e"] != told["x2"]
    numbers = ("x", "y", "trace", "determinant", "discriminant")
    assert [told[name] for name in numbers] == [[C.p[0]], [C.p[1]], [C.trace], [C.determinant], [C.discriminant]]
    assert told["eigenvalues"] == [[[v.real, v.imag] for v in C.eigenvalues]]
    assert told["slow_flow"] == [[float(v) for v in C.slow_flow]]
    assert told["sense"] == ["⊙" if C.slow_flow[0] > 0 else "⊗"]
    assert (told["size"], told["colour"]) == ([15], ["crit"])
    assert glyphs.critical_columns([C, C])["label"] == ["C₁", "C₂"]


@pytest.mark.parametrize(
    ("kind", "mark"),
    [
        ("stable node", ("square", 1)), ("unstable node", ("square", 0)), ("stable focus", ("circle", 1)),
        ("unstable focus", ("circle", 0)), ("saddle", ("x", 0)), ("centre (linear)", ("circle_dot", 0)),
        ("saddle-node", ("triangle", 0)), ("degenerate", ("hex", 0)),
    ],
)  # fmt: skip
def test_marks_of_critical_sets(kind, mark):
    [C] = c2.critical_sets(c2.ELinear(-2, 0, -1), c2.psi.constant())
    told = glyphs.critical_columns([replace(C, kind=kind)])
    assert (told["shape"], told["filled"]) == ([mark[0]], [mark[1]])


def test_a_simple_direction_need_not_be_said_to_be_simple():
    assert glyphs.equator_type(-1.0, -2.0) == "radially and angularly attracting"
    assert glyphs.equator_type(-1.0, -2.0, 2) == "radially attracting, angularly degenerate"


@pytest.mark.parametrize(
    ("angles", "moved"),
    [
        ([1.0], [1.0]),
        ([1.0, 2.0, 5.0], [1.0, 2.0, 5.0]),  # apart already
        ([1.0, 1.1], [0.95, 1.15]),
        ([0.05, 6.2], [0.083407, 6.166593]),  # neighbours across 0
        ([1.0, 1.0, 1.0], [0.8, 1.0, 1.2]),
        ([1.0, 1.0, 4.0, 4.1], [0.9, 1.1, 3.95, 4.15]),
        ([], []),
    ],
)
def test_labels_move_apart_by_as_little_on_either_side(angles, moved):
    found = glyphs.spread(angles, 0.2)
    assert found == pytest.approx(moved, abs=1e-5)
    assert sum(found) == pytest.approx(sum(angles))


def test_no_pieces_are_no_points():
    offsets, points = glyphs.join([])
    assert (offsets.tolist(), points.shape) == ([0], (0, 2))


def curve(*branches):
    return type("Curve", (), {"branches": branches})()


def test_curves_of_the_plane_travel_over_their_largest_coordinate():
    line = np.array([[0.5, -4.0], [1.0, 2.0], [3.0, 1.0]])
    assert plane_curves.size_of([curve(line), curve(0.5 * line)]) == 4.0
    assert plane_curves.size_of([curve(np.zeros((1, 2)))]) == 1.0
    assert plane_curves.size_of([]) == 1.0
    offsets, points = plane_curves.curve_lines(curve(line, line[:1]), 4.0)
    assert offsets.tolist() == [0, 3, 4]
    assert points == pytest.approx(np.concatenate([line, line[:1]]) / 4.0)
    region = type("Region", (), {"name": "CM4", "inside": (1.0, -2.0), "bounded": True, "boundary": [line, line[:3]]})
    told = plane_curves.region_columns([region], 4.0)
    assert told == {"name": ["CM4"], "inside": [[0.25, -0.5]], "bounded": [True], "loops": [2], "size": 4.0}
    assert plane_curves.region_lines([region], 4.0)[0].tolist() == [0, 3, 6]


def test_thinning_keeps_ends_corners_and_what_a_pixel_would_show():
    turn = np.linspace(0.0, 1.5 * math.pi, 2001)
    arc = np.column_stack([np.cos(turn), np.sin(turn)]) * 5.0
    offsets, points = plane_curves.thin([arc, arc + 20.0], 5.0)
    one = points[: offsets[1]]
    assert 95 < len(one) < 105  # one for each tenth of a radian, and one for each 0.09 of the size
    assert len(points) == 2 * len(one)
    assert one[[0, -1]] == pytest.approx(arc[[0, -1]] / 5.0)
    assert points[offsets[1]] == pytest.approx(arc[0] / 5.0 + 4.0)
    middles = 0.5 * (one[1:] + one[:-1])
    assert 1.0 - np.hypot(*middles.T).min() < 0.0004  # the sag of a chord
    assert np.hypot(*np.diff(one, axis=0).T).max() < 0.055
    straight = np.column_stack([np.linspace(0.0, 1.0, 1001), np.zeros(1001)])
    kept = plane_curves.thin([straight], 1.0)[1]
    assert 11 <= len(kept) <= 14
    corner = np.concatenate([straight, np.column_stack([np.ones(1000), np.linspace(0.001, 1.0, 1000)])])
    assert (plane_curves.thin([corner], 1.0)[1] == [1.0, 0.0]).all(axis=1).any()


def test_lines_and_arrays_are_packed_side_by_side():
    line = np.array([[0.5, -0.25], [0.75, 1.0], [-EXTENT, 9.0]])
    blocks = {
        "a": Polylines(np.array([0, 3]), line, True),
        "b": Polylines(np.array([0, 1, 1]), line[:1]),
        "c": np.arange(3, dtype=np.uint16),
    }
    header, arrays = unpack(pack({"id": 7}, blocks, window=(-2.0, 2.0, -2.0, 2.0), pixel=0.001))
    assert header["exact"] is True
    assert arrays["a.xy"].tolist() == line.ravel().tolist()
    assert arrays["b.n"].tolist() == [1, 0]
    assert (arrays["a.n"].tolist(), arrays["c"].tolist(), arrays["c"].dtype.name) == ([3], [0, 1, 2], "uint16")
    assert len(arrays["a.angle"]) * 2 == len(arrays["a.at"]) > 0
    assert "b.at" not in arrays
    header, arrays = unpack(pack({"id": 7}, blocks))
    assert "exact" not in header
    assert arrays["a.xy"].tolist() == [4096, -2048, 6144, 8192, -32767, 32767]
    slope = math.atan2(1.25, 0.25)
    assert arrays["a.angle"][0] == round(slope / math.pi * 32767)


def test_thumbnails_are_the_portraits_at_their_places():
    system, psi = c2.ELinear(-2.0, 0.3, -1.0, (0.1, 0.2)), c2.psi.rational()
    places = [(4, "CM4", (0.6, -0.3)), (2, "CM2", (-1.5, 0.9))]
    made = thumbnails(system, psi, (), ("f1", "f2"), places)
    assert [row[:3] for row in made] == [[4, "CM4", [0.6, -0.3]], [2, "CM2", [-1.5, 0.9]]]
    for (_, _, (f1, f2)), (*_, svg) in zip(places, made, strict=True):
        there = c2.ELinear(-2.0, 0.3, -1.0, (f1, f2))
        assert svg == small(c2.Scene(there, psi, (), count=COUNT, view=SMALL_VIEW * 1.4, pixel=PIXEL), SMALL_VIEW)
    assert len(thumbnails(system, psi, (), ("f1", "f2"), places * 20)) == MOST == 24


FRAME = pack(
    {
        "equator": {"label": ["Q₁"], "x": [0.6], "y": [0.8], "label_x": [0.5], "label_y": [1.25], "shape": ["circle"],
                    "filled": [1], "colour": ["attr"], "size": [14]},
        "critical": {"label": ["C"], "sense": ["⊙"], "x": [-0.35], "y": [0.7], "shape": ["x"], "filled": [0],
                     "colour": ["crit"], "size": [7]},
        "sense": [[0.0, 1.0, math.pi]], "all_directions": False,
        "outcomes": {"start": [0.0], "end": [math.pi / 2], "kind": ["slide"]},
        "basins": {"cells": 2, "box": [-1, 1, -1, 1], "colours": ["", "basin-1"]},
    },
    {"inside": Polylines(np.array([0, 2]), np.array([[0.0, 0.35], [0.7, 0.0]]), True),
     "separatrices_stable": Polylines(np.array([0, 2]), np.array([[0.0, 0.0], [0.0, 0.7]])),
     "basins": np.array([1, 0, 2, 1, 1, 0], np.uint16)},
)  # fmt: skip


def test_the_svg_of_one_frame():
    svg = draw(FRAME, ["inside", "separatrices", "equator", "critical", "outcomes", "basins"])
    assert 'd="M500 400L700 500" stroke="var(--orbit)" stroke-width="1.3"/>' in svg
    assert 'd="M500 500L500 300" stroke="var(--separatrix)" stroke-width="2.9" stroke-dasharray="10 6"/>' in svg
    assert '<circle cx="500" cy="500" r="286" stroke="var(--ink)" stroke-width="2.9"/>' in svg
    assert 'transform="translate(671 271)"' in svg
    assert 'stroke="var(--attr)" stroke-width="3" fill="var(--attr)"' in svg
    assert 'transform="translate(400 300)"' in svg
    assert 'd="M-5 -5L5 5M5 -5L-5 5" stroke="var(--crit)" stroke-width="3" fill="none"' in svg
    assert (
        '<text x="642.4" y="149.9" font-size="22" font-weight="700" fill="var(--ink)" text-anchor="middle">Q₁</text>'
        in svg
    )
    assert '<text x="418" y="290.1" font-size="22" font-weight="700" fill="var(--ink)">C ⊙</text>' in svg
    [head] = re.findall(r'd="(M[^"]*)" fill="var\(--orbit\)"', svg)  # its tip to the right and down
    assert head == "M607 454L592 452L597 443Z"
    [sense] = re.findall(r'd="(M[^"]*)" fill="var\(--ink\)"', svg)
    assert sense == "M489 214L508 207L508 221Z"  # to the left, as theta grows there
    [ring] = re.findall(r'd="M([^"]*)Z" fill="var\(--slide\)"', svg)
    points = [tuple(map(int, pair.split())) for pair in ring.split("L")]
    assert (points[0], points[-1]) == ((807, 500), (794, 500))
    assert (500, 193) in points
    assert (500, 206) in points
    assert len(points) == 2 * 17
    boxes = re.findall(r"M([\d.]+) ([\d.]+)h([\d.]+)v([\d.]+)", svg)
    assert boxes == [("500.0", "500.0", "285.7", "285.7"), ("214.3", "214.3", "285.7", "285.7")]
    assert svg.index("basins" if "basins" in svg else "--basin-1") < svg.index("--slide") < svg.index("--orbit")
    assert svg.index("--orbit") < svg.index("--separatrix") < svg.index("--attr") < svg.index("--crit")
    bare = draw(FRAME, [])
    assert "--orbit" not in bare
    assert "--attr" not in bare
    assert bare.count("<circle") == len(DISCS) + 1


def test_every_direction_is_a_thick_circle():
    svg = draw(pack({"all_directions": True}, {}), ["equator", "critical", "basins", "outcomes"])
    assert '<circle cx="500" cy="500" r="286" stroke="var(--degenerate)" stroke-width="8.6"/>' in svg


def test_a_picture_of_its_own_has_the_colours_of_its_theme():
    light, dark = still(FRAME, ["inside"]), still(FRAME, ["inside"], "dark", 300)
    assert 'width="560" height="560"' in light
    assert 'width="300" height="300"' in dark
    for svg, theme in ((light, "light"), (dark, "dark")):
        colours = themes()[theme]
        assert f'<rect width="1000" height="1000" fill="{colours["page"]}"/>' in svg
        assert f'stroke="{colours["orbit"]}"' in svg
        assert svg.index("<rect") < svg.index("<g ")
        assert svg.count("<rect width=") == 1
    page = page_of(light, "One < two.", "A & B")
    assert "padding:0 1em" in page  # on a phone the words do not touch the border
    assert "<p>One &lt; two.</p>" in page
    assert "<title>A &amp; B</title>" in page


@pytest.mark.parametrize(
    ("text", "drawn"),
    [
        ("c+s", "<mi>c</mi><mo>+</mo><mrow><mi>s</mi></mrow>"),
        ("c-s", "<mi>c</mi><mo>−</mo><mrow><mi>s</mi></mrow>"),
        ("c-(s+c)", "<mi>c</mi><mo>−</mo><mrow><mo>(</mo><mi>s</mi><mo>+</mo><mrow><mi>c</mi></mrow><mo>)</mo></mrow>"),
        ("c/s", "<mfrac><mrow><mi>c</mi></mrow><mrow><mi>s</mi></mrow></mfrac>"),
        ("-c/s", "<mo>−</mo><mfrac><mrow><mrow><mi>c</mi></mrow></mrow><mrow><mi>s</mi></mrow></mfrac>"),
        ("c**2", "<msup><mrow><mi>c</mi></mrow><mrow><mn>2</mn></mrow></msup>"),
        ("exp(c)", "<msup><mi>e</mi><mrow><mi>c</mi></mrow></msup>"),
        ("sqrt(c)", "<msqrt><mi>c</mi></msqrt>"),
        ("2*c", "<mn>2</mn><mo>&#8290;</mo><mrow><mi>c</mi></mrow>"),
        ("c*2", "<mrow><mi>c</mi></mrow><mo>·</mo><mrow><mn>2</mn></mrow>"),
        ("sin(c)", "<mrow><mi>sin</mi><mo>(</mo><mi>c</mi><mo>)</mo></mrow>"),
    ],
)
def test_formulas_are_written_as_one_writes_them(text, drawn):
    assert mathml(parse(text, ("c", "s"))) == drawn


def test_names_have_indices_and_dots():
    assert symbol("z1") == "<msub><mi>z</mi><mn>1</mn></msub>"
    assert symbol("mu_k") == "<msub><mi>μ</mi><mn>k</mn></msub>"
    assert symbol("z", dot=True) == "<mover><mi>z</mi><mo>˙</mo></mover>"
    assert symbol("z2", dot=True) == "<msub><mover><mi>z</mi><mo>˙</mo></mover><mn>2</mn></msub>"
    assert symbol("Psi") == "<mi>Ψ</mi>"
    assert plain_symbol("B_12") == "B₁₂"
    assert plain_symbol("a_b_c") == "a_b_c"


def test_a_system_is_a_table_with_its_definitions_after_it():
    system = c2.System(U=("K*c", "s"), W=("z1-c",), definitions={"K": "1+c"})
    rows = re.findall(r"<mtr>(.*?)</mtr>", equations_mathml(system))
    left = [re.sub(r"<[^>]*>", "", row.partition("<mo>=</mo>")[0]) for row in rows]
    assert left == ["x˙", "y˙", "z˙", "K"]
    assert "<mi>z</mi><mo>−</mo>" in rows[2]
    assert "<mi>K</mi>" in rows[0]
    assert "<mn>1</mn><mo>+</mo>" in rows[3]


@pytest.mark.parametrize("layer", LAYERS.values(), ids=lambda layer: layer.name)
def test_the_mark_beside_a_layers_control_has_the_layers_colours_in_their_order(layer):
    rule = next(line for line in swatches().splitlines() if f".swatch-{layer.name} " in line)
    named = re.findall(r"var\(--([\w-]+)\)", rule)
    assert named
    assert named == list(layer.colours)[: len(named)]


def lengths(*steps):
    """A line along x with these steps."""
    return np.column_stack([np.concatenate([[0.0], np.cumsum(steps)]), np.zeros(len(steps) + 1)])


def test_a_thinned_line_keeps_a_point_for_each_allowed_length_and_turn():
    far, near = 1.01 * plane_curves.LENGTH, 0.26 * plane_curves.LENGTH
    assert len(plane_curves.thin([lengths(*[far] * 6)], 1.0)[1]) == 7  # all
    assert len(plane_curves.thin([lengths(*[2.0 * far] * 6)], 2.0)[1]) == 7  # in units of the size
    assert [len(plane_curves.thin([lengths(*[1e-3] * k)], 1.0)[1]) for k in (2, 3, 4)] == [3, 2, 2]
    kept = plane_curves.thin([lengths(*[near] * 40)], 1.0)[1][:, 0]
    assert 10 <= len(kept) <= 13
    assert np.diff(kept).max() <= plane_curves.LENGTH + near  # the first point at which it is that long
    angle = np.linspace(0.0, 6.0, 601)
    _, kept = plane_curves.thin([1e-3 * np.column_stack([np.cos(angle), np.sin(angle)])], 1.0)
    turns = np.diff(np.unwrap(np.arctan2(kept[:, 1], kept[:, 0])))
    assert turns.max() <= 1.2 * plane_curves.TURN  # of so small a circle only the turns count
    assert len(kept) < 1.2 * 6.0 / plane_curves.TURN
    corner = np.concatenate([lengths(*[near] * 10), [(10 * near, k * near) for k in range(1, 11)]])
    _, kept = plane_curves.thin([corner], 1.0)
    assert {(round(x / near), round(y / near)) for x, y in kept.tolist()} >= {
        (0, 0),
        (9, 0),
        (10, 0),
        (10, 1),
        (10, 10),
    }


def test_thinned_pieces_are_those_of_each_alone():
    angle = np.linspace(0.0, 2.0, 200)
    pieces = [
        np.column_stack([np.cos(angle), 0.3 * np.sin(angle)]), lengths(*[0.01] * 50) + 3.0,
        np.array([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]), np.array([(5.0, 5.0)]), lengths(0.001, 0.001),
    ]  # fmt: skip
    offsets, points = plane_curves.thin(pieces, 4.0)
    for i, piece in enumerate(pieces):
        own = points[offsets[i] : offsets[i + 1]]
        assert own[0] == pytest.approx(piece[0] / 4.0)
        assert own[-1] == pytest.approx(piece[-1] / 4.0)
        away = np.abs(own[:, None] - piece / 4.0).max(axis=2).min(axis=1)
        assert away.max() < 1e-15  # none is made up
    assert np.diff(offsets)[2:].tolist() == [3, 1, 3]
    assert plane_curves.size_of([]) == 1.0


@pytest.mark.parametrize(("hatch", "strokes"), [("/", 1), ("x", 2), (".", 1), ("", 0)])
def test_hatches_lie_on_the_ring_as_far_apart_on_any_screen(hatch, strokes):
    inner, outer = RING
    middle = (inner + outer) / 2
    for place in (Place(), Place(side=500.0, unit=500 / 700), Place(unit=SIDE / 350)):
        found = vector._hatching(0.5, 2.0, hatch, place)
        step = vector.HATCH * place.unit / (middle * place.scale)  # of the angle
        assert len(found) == strokes * math.floor(1.5 / step + 0.5)
        for i, ((x, y), (u, v)) in enumerate(found):
            angle = 0.5 + (i // max(strokes, 1) + 0.5) * step
            one, other = math.atan2(y, x) - angle, math.atan2(v, u) - angle
            assert one == pytest.approx(-other)
            lean = (outer - inner) / middle / 2
            if hatch == ".":
                assert (math.hypot(x, y), math.hypot(u, v)) == pytest.approx((middle, middle))
                assert other == pytest.approx(lean / 4)
            else:
                assert (math.hypot(x, y), math.hypot(u, v)) == pytest.approx((inner, outer))
                assert other == pytest.approx(lean if i % strokes == 0 else -lean)  # at 45 degrees


def test_no_label_stands_over_the_core_of_a_mark():
    columns = {
        "x": [0.5, 9.0], "y": [-0.25, 0.0], "shape": ["circle"] * 2, "size": [14, 14], "colour": ["attr"] * 2,
        "filled": [1, 1],
    }  # fmt: skip
    for place in (Place(), Place(unit=3.0)):
        taken = []
        assert len(vector.marks(columns, place, taken)) == 1  # the other is not seen
        [box] = taken
        [(u, v)] = place.points([(0.5, -0.25)]).tolist()
        assert (box.x + box.width / 2, box.y + box.height / 2) == pytest.approx((u, v))
        assert box.width == box.height == pytest.approx(vector.CORE * 14 * place.unit)
        assert 0.5 * 14 * place.unit < box.width < 14 * place.unit


def test_zoomed_in_a_label_stands_as_near_to_its_mark():
    columns = {"x": [0.6], "y": [0.8], "label": ["Q₁"], "label_x": [0.75], "label_y": [0.95]}
    offsets = []
    for seen in ((-VIEW, VIEW, -VIEW, VIEW), (0.1, 1.1, 0.3, 1.3), (-7.0, 7.0, -7.0, 7.0)):
        place = Place(seen)
        [text] = vector.labels(columns, place, [], False)
        [(u, v)] = place.points([(0.6, 0.8)]).tolist()
        x, y = (float(re.search(rf' {name}="([^"]*)"', text)[1]) for name in "xy")
        offsets.append((x - u, y - 0.34 * place.text - v))
    scale = SIDE / (2 * VIEW)
    assert offsets[0] == pytest.approx((0.15 * scale, -0.15 * scale), abs=0.6)
    assert offsets[1] == pytest.approx(offsets[0], abs=1.1)
    assert offsets[2] == pytest.approx((0.15 * SIDE / 14, -0.15 * SIDE / 14), abs=1.1)  # smaller with all else


def test_in_black_and_white_lines_that_colours_tell_apart_differ():
    looks = {}
    for layer in painted():
        for part in layer.parts:
            look = (paper()[part.colour], part.dash or DASHES.get(part.colour, ()), part.width)
            looks.setdefault(look, set()).add(part.name.removesuffix("_inside").removesuffix("_outside"))
    alike = [names for names in looks.values() if len(names) > 1]
    assert alike == []
    assert all(len(dash) % 2 == 0 and min(dash) >= 2 for dash in DASHES.values())
    assert set(DASHES) <= set(themes()["light"])
