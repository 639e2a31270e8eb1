"""Figures hold what the core computes, with labels that are clear of each other, and a legend of what is drawn."""

import re
from html import unescape
from xml.etree import ElementTree

import numpy as np
import pytest
from codim2_app.exports.describe import system_words
from codim2_app.exports.figure import MM, Style, figure
from codim2_app.exports.view import view_of
from codim2_app.picture.draw.theme import themes
from codim2_app.picture.draw.vector.labels import LabelBox, width_of

from tests.app.near import gaps

SVG = "{http://www.w3.org/2000/svg}"
SEVERAL = ("case1-cm4", "case3-n3", "ball-dynamic", "attracting-repelling", "nonunique-sliding", "conics-4")


def strokes(svg, colour):
    """The polylines of one colour, in points of the drawing."""
    paths = re.findall(rf'<path d="(M[^"hHvV]*)" stroke="{colour}"', svg.split("</clipPath>")[1].split("</g></g>")[0])
    pieces = [piece for path in paths for piece in path.split("M")[1:]]
    return [np.array([[float(v) for v in pair.split()] for pair in piece.split("L")]) for piece in pieces]


@pytest.mark.parametrize(
    "text",
    [
        "a=-2&b=0.35&d=-1&f1=-0.4&f2=0.25&psi=rational&layers=inside,continuations",
        "a=-2&b=0.35&d=-1&f1=-0.4&f2=0.25&psi=rational&layers=inside,continuations&seen=-0.5,0.7,-0.3,0.9",
        "system=own&layers=inside,continuations&z=0.3",
    ],
)
def test_its_curves_are_those_of_the_core(text):
    view = view_of(text)
    svg = figure(view, Style(size=100.0, legend=False))
    left, right, _, top = view.seen
    scale = 100.0 * MM / (right - left)
    scene = view.scene().evolve(pixel=(right - left) / 1600)
    for colour, points in (("orbit", scene["inside"].points), ("continuation", scene["continuations"].points)):
        drawn = strokes(svg, themes()["light"][colour])
        assert drawn
        whole = [(np.asarray(p) - (left, top)) * (scale, -scale) for p in points]
        for piece in drawn:  # orbits end where they would run together, and a window cuts what is far outside away
            assert gaps(piece[:: max(1, len(piece) // 8)], whole).max() < 0.02


@pytest.mark.parametrize("key", SEVERAL)
@pytest.mark.parametrize("theme", ["light", "dark", "paper"])
def test_it_needs_nothing_else_and_nothing_is_clipped(key, theme):
    svg = figure(view_of(key), Style(size=80.0, theme=theme, ticks=True, title=True, caption=True))
    root = ElementTree.fromstring(svg)
    assert "var(" not in svg
    assert not re.search(r'(href|src)="', svg)
    assert len(svg) < 400_000
    _, _, width, height = map(float, root.get("viewBox").split())
    foots = [float(text.get("y")) for text in root.findall(f"{SVG}text")]
    assert min(foots) > 0
    assert max(foots) < height - 2
    for text in root.findall(f"{SVG}text"):
        if text.get("text-anchor") is None:
            assert float(text.get("x")) + width_of(text.text, float(text.get("font-size"))) < width + 1
    colours = set(re.findall(r"#[0-9a-f]{6}", svg))
    if theme == "paper":
        assert all(len(set((c[1:3], c[3:5], c[5:7]))) == 1 for c in colours)
    else:
        assert colours <= set(themes()[theme].values())


def boxes(svg):
    """The labels of the picture, each as the box in which its letters are."""
    found = []
    inside = svg.split('clip-path="url(#picture)">')[1].split("</g>")[0]
    for x, y, size, anchor, text in re.findall(
        r'<text [^>]*?x="([\d.]+)" y="([\d.]+)" font-size="([\d.]+)"[^>]*?(text-anchor="middle")?>([^<]*)<', inside
    ):
        wide = width_of(text, float(size))
        left = float(x) - (wide / 2 if anchor else 0)
        found.append(LabelBox(left, float(y) - 0.8 * float(size), wide, 0.9 * float(size)))
    return found


@pytest.mark.parametrize("key", [*SEVERAL, "case1-ncm4", "transcritical-at"])
def test_no_label_stands_over_another(key):
    view = view_of(key)
    svg = figure(view, Style(size=60.0, legend=False))
    found = boxes(svg)
    scene = view.scene()
    assert len(found) == len(scene["equator"].theta) + len(scene["critical"])
    for i, one in enumerate(found):
        assert one.fits(60.0 * MM, 60.0 * MM)
        assert not any(one.meets(other) for other in found[:i])


def test_the_legend_lists_what_is_drawn_and_nothing_else():
    words = re.findall(r"<text[^>]*>([^<]*)</text>", figure(view_of("case1-cm4")).split("</g></g>")[1])
    assert {"ρ-nullclines", "θ-nullclines", "Orbits inside", "C: stable node"} <= set(words)
    assert "Limit cycles" not in words  # there are none
    assert "Stable separatrices" not in words  # they are not shown
    assert sum(word.startswith("Q: ") for word in words) == 2
    shown = figure(view_of("preset=case3-n3&layers=cycles,separatrices,outcomes,critical"))
    words = re.findall(r"<text[^>]*>([^<]*)</text>", shown)
    assert {"Limit cycles", "Stable separatrices", "Unstable separatrices", "C: unstable focus"} <= set(words)
    assert any(word.startswith("From there: ") for word in words)
    assert "ρ-nullclines" not in words


def test_launched_orbits_start_where_they_were_launched():
    svg = figure(view_of("orbits=0.3,0.2;1.2,-0.4&layers=launched"), Style(size=100.0, legend=False))
    found = re.findall(r'<circle cx="([\d.]+)" cy="([\d.]+)" r="3.0"', svg)
    scale = 100.0 * MM / 3.5
    expected = [((x + 1.75) * scale, (1.75 - y) * scale) for x, y in ((0.3, 0.2), (1.2, -0.4))]
    assert np.allclose([list(map(float, pair)) for pair in found], expected, atol=0.01)


def test_a_picture_without_layers_is_the_bare_hemisphere():
    svg = figure(view_of("layers="), Style(caption=True))
    assert "<text" in svg.split("</g></g>")[1]  # the caption
    assert strokes(svg, themes()["light"]["orbit"]) == []
    assert svg.count("<circle") == 2  # the hemisphere and its rim


@pytest.mark.parametrize(("style", "said"), [({"size": 4.0}, "40 to 400"), ({"theme": "red"}, "light, dark, paper")])
def test_a_style_that_there_is_not(style, said):
    with pytest.raises(ValueError, match=said):
        Style(**style)


@pytest.mark.parametrize(("g", "told"), [(0.9, "out of the page"), (-0.9, "into the page")])
def test_the_legend_says_which_way_the_slow_flow_goes(g, told):
    words = re.findall(r"<text[^>]*>([^<]*)</text>", figure(view_of(f"v=1&g0={g}&B1=0")))
    (said,) = (word for word in words if "the page" in word)
    assert unescape(said) == f"z′ {'>' if g > 0 else '<'} 0: {told}"


def test_the_caption_has_the_signs_of_the_system():
    view = view_of("v=1&f1=-0.4&k1=0.25&f2=0.2&k2=-0.75&B1=-1.5&B2=0.5&g0=-0.1&a=-2.5&b=0.3&d=-1.25")
    assert system_words(view) == (
        "(x, y)′ = A e + f with a = −2.5, b = 0.3, d = −1.25, f = (−0.4 + 0.25 z, 0.2 − 0.75 z); "
        "z′ = B e + g with B = (−1.5, 0.5), g = −0.1"
    )
