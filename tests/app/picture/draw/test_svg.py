"""One frame as SVG: each mark and line at its place, in its colour and order."""

import math
import re

import numpy as np
from codim2_app.picture.draw.packing import Polylines, pack
from codim2_app.picture.draw.still import page_of, still
from codim2_app.picture.draw.svg import draw, small
from codim2_app.picture.draw.theme import themes
from codim2_app.picture.draw.thumbnails import MAX_KEPT, THUMBNAIL_PIXEL, THUMBNAIL_SEEDS, thumbnails
from codim2_app.picture.draw.thumbnails import THUMBNAIL_HALF_VIEW as SMALL_VIEW

import codim2_core as c2

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
    assert 'd="M500 400L700 500" stroke="var(--orbit)" stroke-width="2.0"/>' in svg
    assert 'd="M500 500L500 300" stroke="var(--separatrix)" stroke-width="2.9" stroke-dasharray="10 6"/>' in svg
    assert '<circle cx="500" cy="500" r="286" stroke="var(--ink)" stroke-width="2.9"/>' in svg
    assert 'transform="translate(671 271)"' in svg
    assert 'stroke="var(--attr)" stroke-width="3" fill="var(--attr)"' in svg
    assert 'transform="translate(400 300)"' in svg
    assert 'd="M-5 -5L5 5M5 -5L-5 5" stroke="var(--crit)" stroke-width="3" fill="none"' in svg
    letters = 'font-size="22" font-weight="700" fill="var(--ink)"'
    assert f'<text x="642.4" y="149.9" {letters} text-anchor="middle">Q₁</text>' in svg
    assert f'<text x="418" y="290.1" {letters}>C ⊙</text>' in svg
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
    assert bare.count("<circle") == 2  # the hemisphere and its rim


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
        assert svg.index("<rect") < svg.index("<circle")
        assert svg.count("<rect width=") == 1
    page = page_of(light, "One < two.", "A & B")
    assert "padding:0 1em" in page  # on a phone the words do not touch the border
    assert "<p>One &lt; two.</p>" in page
    assert "<title>A &amp; B</title>" in page


def test_thumbnails_are_the_portraits_at_their_places():
    system, psi = c2.ELinear(-2.0, 0.3, -1.0, (0.1, 0.2)), c2.psi.rational()
    places = [(4, "CM4", (0.6, -0.3)), (2, "CM2", (-1.5, 0.9))]
    made = thumbnails(system, psi, (), ("f1", "f2"), places)
    assert [row[:3] for row in made] == [[4, "CM4", [0.6, -0.3]], [2, "CM2", [-1.5, 0.9]]]
    for (_, _, (f1, f2)), (*_, svg) in zip(places, made, strict=True):
        there = c2.ELinear(-2.0, 0.3, -1.0, (f1, f2))
        scene = c2.Scene(there, psi, (), count=THUMBNAIL_SEEDS, view=SMALL_VIEW * 1.4, pixel=THUMBNAIL_PIXEL)
        assert svg == small(scene, SMALL_VIEW)
    assert len(thumbnails(system, psi, (), ("f1", "f2"), places * 20)) == MAX_KEPT == 24
