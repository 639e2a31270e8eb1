"""What is painted in the page, read back in data space and held against the core's numbers.

The settings have no symmetry, so that no flip, no swap of two colours and no reversed arrow goes unnoticed. Colours and
shapes are written down here once more, as the legend and DESIGN say them.
"""

import math
from pathlib import Path

import numpy as np
import pytest
from codim2_app.picture.draw.theme import PICTURE_REACH

import codim2_core as c2
from codim2_core.portrait.basins import basins
from tests.app.near import gaps

RECORDER = (Path(__file__).parent / "recorder.js").read_text()
PAGE = "#ffffff"
#: Of the strokes: layer to colour, width, dash.
STROKES = {
    "outside": ("#a3b1c2", 1.2, []),
    "inside": ("#5f7186", 1.4, []),
    "continuations": ("#b3123f", 1.6, []),
    "stable separatrices": ("#6d28d9", 2, [7, 4]),
    "unstable separatrices": ("#6d28d9", 2, []),
    "cycles": ("#e0121f", 2.8, []),
    "rho": ("#0072bd", 1.8, []),
    "theta": ("#d95319", 1.8, []),
    "lines inside": ("#edb120", 1.8, []),
    "lines outside": ("#7e2f8e", 1.4, []),
}
ATTRACTING, REPELLING, CRITICAL, INK = "#15803d", "#be185d", "#c8102e", "#1c2430"
OUTCOMES = {"slide": "#0d9488", "cross": "#e8751a", "misses": "#dfe4ea", "undecided": "#64748b"}
ALL = "outside,inside,continuations,separatrices,cycles,rho,theta,lines,equator,critical,outcomes"

SETTINGS = {
    "node": {"a": -2.0, "b": 0.35, "d": -1.0, "f1": -0.4, "f2": 0.25, "B1": 1.0, "B2": 0.3, "g0": -0.2},
    "saddle": {"a": 1.0, "b": 0.3, "d": -1.2, "f1": 0.2, "f2": 0.45, "B1": 1.0, "B2": 0.3, "g0": 0.9},
    "focus": {"a": -1.1, "b": 1.0, "d": -0.7, "f1": 0.35, "f2": -0.5, "B1": -0.5, "B2": 1.0, "g0": 0.0},
}


class Drawn:
    """A page at one setting, and the scene that it must show."""

    def __init__(self, page, setting, psi="rational"):
        query = "&".join(f"{name}={value}" for name, value in setting.items())
        page.open(f"?{query}&k1=0&k2=0&psi={psi}&layers={ALL}")
        self.page = page
        self.items = page.find(".codim2").evaluate(RECORDER)
        B, g = ((setting["B1"], setting["B2"]),), (setting["g0"],)
        self.system = c2.ELinear(setting["a"], setting["b"], setting["d"], (setting["f1"], setting["f2"]), B=B, g=g)
        self.psi = getattr(c2.psi, psi)()
        self.scene = c2.Scene(self.system, self.psi, (0.0,), view=PICTURE_REACH)
        self.U = self.scene.coefficients.U

    def strokes(self, look):
        """The pieces of all strokes of one look, in order; circles are no pieces."""
        colour, width, dash = look
        return [
            np.array(piece["points"])
            for item in self.items
            if item["kind"] == "stroke" and (item["colour"], item["width"], item["dash"]) == (colour, width, dash)
            for piece in item["path"]
            if "arc" not in piece
        ]

    def heads(self, colour):
        """Arrowheads of one colour: where, and in which direction the tip lies from the base."""
        triangles = [
            np.array(piece["points"])
            for item in self.items
            if item["kind"] == "fill" and item["colour"] == colour and item["alpha"] == 1
            for piece in item["path"]
            if len(piece["points"]) == 3
        ]
        return [(t.mean(axis=0), t[0] - t[1:].mean(axis=0)) for t in triangles]

    def marks(self, colour):
        """Marks whose outline has one colour: middle, shape, and the colour that fills it."""
        found = []
        for before, item in zip(self.items, self.items[1:], strict=False):
            if item["kind"] == "stroke" and item["colour"] == colour and item["width"] == 2.5:
                same = before["kind"] == "fill" and before["path"] == item["path"]
                points = np.array([p for piece in item["path"] for p in piece["points"]])
                shape = "circle" if "arc" in item["path"][-1] else "x" if len(item["path"]) == 2 else _polygon(points)
                middle = item["path"][-1]["points"][0] if shape == "circle" else points.mean(axis=0)
                found.append((np.array(middle), shape, before["colour"] if same else None))
        return found


def _polygon(points):
    if len(points) == 4:
        return "square" if np.ptp(points[:2, 1]) < 1e-9 else "diamond"
    return f"{len(points)} corners"


@pytest.fixture(scope="module", params=list(SETTINGS))
def drawn(request, tabs):
    with tabs.page() as page:
        yield Drawn(page, SETTINGS[request.param])


def pieces(scene):
    """What the core says that each look must show."""
    branches = [*scene["nullclines_inside"], *scene["nullclines_outside"]]
    ways = [branch for branch in scene["separatrices"] if branch.inside]
    return {
        "outside": scene["outside"].points,
        "inside": scene["inside"].points,
        "continuations": scene["continuations"].points,
        "stable separatrices": [branch.points for branch in ways if branch.direction == "stable"],
        "unstable separatrices": [branch.points for branch in ways if branch.direction == "unstable"],
        "cycles": [cycle.points for cycle in scene["cycles"]],
        "rho": [branch.points for branch in branches if branch.kind == "rho"],
        "theta": [branch.points for branch in branches if branch.kind == "theta"],
        "lines inside": [b.points for b in branches if b.kind in ("U1", "U2") and b.inside],
        "lines outside": [b.points for b in branches if b.kind in ("U1", "U2") and not b.inside],
    }


@pytest.mark.parametrize("layer", STROKES)
def test_curves_are_those_of_the_core(drawn, layer):
    expected = [np.asarray(piece) for piece in pieces(drawn.scene)[layer] if len(piece) > 1]
    found = drawn.strokes(STROKES[layer])
    if layer in ("inside", "outside"):  # orbits end where they would come too near to one another
        assert len(found) > 5
        assert gaps(np.concatenate(found), [np.clip(piece, -4, 4) for piece in expected]).max() < 1e-3
        return
    assert [len(piece) for piece in found] == [len(piece) for piece in expected]
    for one, other in zip(found, expected, strict=True):
        assert np.abs(one - np.clip(other, -4, 4)).max() < 1e-3


def velocity(drawn, p):
    """The direction in which a point moves: on the hemisphere dp/dT, outside that of radius 1 + rho and theta."""
    radius = math.hypot(*p)
    e = p / radius
    if radius > 1:
        U = np.array(drawn.U(e))
        across = np.array([-e[1], e[0]])
        return (radius - 1) * (U @ e) * e + radius * (U @ across) * across
    share = radius**2 / (1 - radius**2)  # |x2|^2
    U = np.array(drawn.U(p / math.sqrt(radius**2 + (1 - radius**2) * drawn.psi(share))))
    return U - p * (p @ U)


@pytest.mark.parametrize("layer", ["outside", "inside", "continuations", "unstable separatrices", "cycles"])
def test_arrowheads_point_with_time(drawn, layer):
    curves = [piece for piece in pieces(drawn.scene)[layer] if len(piece) > 1]
    heads = [(at, way) for at, way in drawn.heads(STROKES[layer][0]) if abs(math.hypot(*at) - 1) > 0.01]
    assert bool(heads) == bool(curves)
    agree = [way @ velocity(drawn, at) / math.hypot(*way) / math.hypot(*velocity(drawn, at)) for at, way in heads]
    assert all(cosine > 0.8 for cosine in agree)


def test_the_sense_of_the_equator_is_that_of_theta(drawn):
    heads = [(at, way) for at, way in drawn.heads(INK) if abs(math.hypot(*at) - 1) < 0.01 and np.hypot(*way) > 0.04]
    assert len(heads) >= 2 or drawn.scene["equator"].all_directions
    for at, way in heads:
        e = at / math.hypot(*at)
        turn = np.array([-e[1], e[0]])
        assert (way @ turn) * (np.array(drawn.U(e)) @ turn) > 0


def test_equator_equilibria_have_their_place_colour_and_shape(drawn):
    q = drawn.scene["equator"]
    found = [(*mark, colour) for colour in (ATTRACTING, REPELLING) for mark in drawn.marks(colour)]
    assert len(found) == len(q.theta)
    for theta, rho, ang in zip(q.theta, q.lambda_rho, q.lambda_theta, strict=True):
        at = np.array([math.cos(theta), math.sin(theta)])
        middle, shape, fill, colour = min(found, key=lambda mark: np.hypot(*(mark[0] - at)))
        assert np.hypot(*(middle - at)) < 1e-3
        assert (colour, fill) == ((ATTRACTING, ATTRACTING) if rho < 0 else (REPELLING, PAGE))
        assert shape == ("circle" if ang < 0 else "diamond")


def test_critical_sets_have_their_place_and_mark_and_sense(drawn):
    [C] = drawn.scene["critical"]
    [(middle, shape, fill)] = drawn.marks(CRITICAL)
    assert np.hypot(*(middle - C.p)) < 1e-3
    kind = C.kind.split()[-1]
    assert shape == {"node": "square", "focus": "circle", "saddle": "x"}[kind]
    if kind != "saddle":
        assert fill == (CRITICAL if C.kind.startswith("stable") else PAGE)
    [label] = [item for item in drawn.items if item["kind"] == "text" and item["text"].startswith("C")]
    assert label["text"] == ("C ⊙" if C.slow_flow[0] > 0 else "C ⊗")
    assert np.hypot(*(np.array(label["at"]) - C.p)) < 0.15


def test_the_ring_of_outcomes_lies_where_the_trajectories_arrive(drawn):
    rings = [
        (item["colour"], item["path"][0]["arc"])
        for item in drawn.items
        if item["kind"] == "fill" and len(item["path"]) == 2 and all("arc" in piece for piece in item["path"])
    ]
    arcs = drawn.scene["outcomes"].arcs
    assert len(rings) == len(arcs)
    for (colour, (radius, start, end, back)), (begin, finish, outcome) in zip(rings, arcs, strict=True):
        assert (start, end) == pytest.approx((begin, finish))
        assert back  # against the clock, as angles grow
        assert radius == pytest.approx(1.075)
        kind = "slide" if outcome.verdict == "cycle" else outcome.verdict
        assert colour == ("#7c3aed" if outcome.depends_on_psi and kind != "misses" else OUTCOMES[kind])


def colour_at(page, point):
    """The colour on the screen's canvas at a point of the picture."""
    return page.ask(f"""(() => {{
        const {{primary}} = view.canvas_view, ratio = primary.pixel_ratio
        const [x, y] = [view.frame.x_scale.compute({point[0]}), view.frame.y_scale.compute({point[1]})]
        const pixel = primary.ctx.getImageData(Math.round(ratio * x), Math.round(ratio * y), 1, 1)
        return [...pixel.data].slice(0, 3) }})()""")


def test_basins_on_the_screen_are_those_of_the_core(open_page):
    """The bitmap's way to the screen is another one than that of vectors."""
    page = open_page().open("?preset=nonunique-sliding&z=0.3&layers=basins&panel=numbers")
    preset = c2.presets["nonunique-sliding"]
    scene = c2.Scene(preset.system, preset.psi, (0.3,))
    found = basins(scene.coefficients, scene.psi, n=64)
    colours = {}
    for x, y in [(-0.8, 0.13), (-0.5, -0.6), (0.45, 0.52), (0.7, -0.22), (-0.6, 0.5), (0.5, -0.6)]:
        cell = found.cells[int((y + 1) * 32), int((x + 1) * 32)]
        red, green, blue = colour_at(page, (x, y))
        colours.setdefault(cell, []).append("teal" if green > red + 10 and green >= blue - 6 else "violet")
    assert len(colours) == 2
    assert [set(seen) for _, seen in sorted(colours.items())] == [{"teal"}, {"violet"}]


def test_the_screen_shows_the_marks_the_right_way_up(drawn):
    [C] = drawn.scene["critical"]
    if C.kind == "stable node":
        assert colour_at(drawn.page, (C.p[0] + 0.02, C.p[1] + 0.02)) == [0xC8, 0x10, 0x2E]
        assert colour_at(drawn.page, (C.p[0] + 0.02, -C.p[1])) != [0xC8, 0x10, 0x2E]


def test_a_motion_starts_where_it_is_launched(open_page):
    page = open_page().open("?panel=orbits&orbit_eps=show&k1=0&k2=0&launch=-0.3,0.4,0")
    page.settle()
    *paths, dot = [item for item in page.find(".codim2").evaluate(RECORDER, "above") if item["kind"] == "stroke"]
    assert {tuple(path["dash"]) for path in paths} == {(), (5, 4)}  # the limit, and the motion for eps > 0
    for item in paths:
        assert item["path"][0]["points"][0] == pytest.approx([-0.9, 1.2], abs=0.02)  # radius 1 + rho, rho = 1/2
    assert dot["path"][0]["points"][0] == pytest.approx([-0.9, 1.2], abs=0.05)  # on the rim of its mark
