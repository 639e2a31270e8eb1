"""Parts of the picture as SVG elements: where a point of it lies in a drawing, and what is drawn there.

Colours are custom properties of the style sheet, ``var(--name)``, so that themes need no second drawing.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..layers import Part
from ..packing import ANGLE_STEP, INT16_STEP, Rectangle
from ..shapes import OPEN, shape
from ..theme import HALF_VIEW, HATCHES, LIGHT, MIDDLE, RING
from .labels import LabelBox, clear_of, width_of

VIEWBOX_SIDE = 1000
#: A hatch's strokes are so far apart, in px of the screen.
HATCH = 7.0
#: Width of a text in the widest font that a reader may see it in, and in the usual one, over `width_of`.
MAX_LABEL_SCALE, USUAL = 1.25, 0.87
#: The part of a mark's width over which no label stands.
CORE = 0.8


@dataclass(frozen=True)
class Placement:
    """Position and size of the picture in a drawing."""

    seen: Rectangle = (-HALF_VIEW, HALF_VIEW, -HALF_VIEW, HALF_VIEW)  # what is drawn of the picture
    side: float = VIEWBOX_SIDE  # its width in the drawing; its corner is at (0, 0)
    unit: float = VIEWBOX_SIDE / 700  # what is a px on the screen: of widths of lines and sizes of marks
    text: float = 22.0  # size of labels
    decimals: int = 0  # of coordinates
    # by colour, where lines differ by dashes, in px of the screen, as they are in black and white
    dashes: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    beyond: float = 1.0  # how much farther out labels of limit directions stand where there is the ring of outcomes

    @property
    def scale(self) -> float:
        """Return the radius of the disc in px."""
        return self.side / (self.seen[1] - self.seen[0])

    @property
    def height(self) -> float:
        """Return the height of the drawing in px."""
        return self.scale * (self.seen[3] - self.seen[2])

    def points(self, values: Any) -> Any:
        """Return points of the picture in the drawing, as an array (n, 2)."""
        points = (np.asarray(values, float).reshape(-1, 2) - (self.seen[0], self.seen[3])) * (self.scale, -self.scale)
        return self.round_coordinates(points)

    def round_coordinates(self, points: Any) -> Any:
        """Return coordinates with as many decimals as are written."""
        if not self.decimals:
            return np.rint(points).astype(int)
        return np.round(points, self.decimals)

    def path(self, pieces: Iterable[Any]) -> str:
        """Return polylines of points of the drawing as the text of a path."""
        write = str if not self.decimals else f"{{:.{self.decimals + 3}g}}".format
        return "".join(
            "M" + "L".join(f"{write(x)} {write(y)}" for x, y in piece.tolist()) for piece in pieces if len(piece) > 1
        )

    def holds(self, x: float, y: float) -> bool:
        """Whether a point of the drawing is in it."""
        return 0 <= x <= self.side and 0 <= y <= self.height


def steps(blocks: Mapping[str, Any], name: str) -> Any:
    """Return packed coordinates as numbers."""
    values = blocks[name]
    return values * INT16_STEP if values.dtype == np.int16 else values


def rim(place: Placement) -> str:
    """Begin a circle that is the equator."""
    [[x, y]] = place.points((0.0, 0.0)).tolist()
    return f'<circle cx="{x}" cy="{y}" r="{place.scale:.{place.decimals}f}"'


def sphere(place: Placement) -> str:
    """Return the hemisphere, shaded smoothly from where the light falls."""
    lit = f'fx="{0.5 + 0.5 * LIGHT[0]:.3g}" fy="{0.5 - 0.5 * LIGHT[1]:.3g}"'
    stops = "".join(
        f'<stop offset="{at:g}" style="stop-color:var(--shade);stop-opacity:var(--shade-{name})"/>'
        for at, name in ((0.0, "lit"), (MIDDLE, "middle"), (1.0, "limb"))
    )
    return (
        f'<radialGradient id="codim2-sphere" cx="0.5" cy="0.5" r="0.5" {lit}>{stops}</radialGradient>'
        f'{rim(place)} fill="url(#codim2-sphere)"/>'
    )


def curves(part: Part, blocks: Mapping[str, Any], place: Placement) -> str:
    """Return the strokes of one part; "" if there are none."""
    if f"{part.name}.n" not in blocks:
        return ""
    ends = np.cumsum(blocks[f"{part.name}.n"], dtype=np.int64)[:-1]
    path = place.path(np.split(place.points(steps(blocks, f"{part.name}.xy")), ends))
    dashes = part.dash or place.dashes.get(part.colour, ())
    return f'<path d="{path}" {stroke(part.colour, part.width, dashes, place)}/>'


def stroke(colour: str, width: float, dashes: Sequence[float], place: Placement) -> str:
    """Return the attributes of a line."""
    dash = f' stroke-dasharray="{" ".join(f"{v * place.unit:.{place.decimals}f}" for v in dashes)}"' if dashes else ""
    return f'stroke="var(--{colour})" stroke-width="{width * place.unit:.{max(1, place.decimals)}f}"{dash}'


def heads(part: Part, blocks: Mapping[str, Any], place: Placement) -> str:
    """Return the arrowheads of one part; "" if there are none."""
    if f"{part.name}.at" not in blocks:
        return ""
    places = place.points(steps(blocks, f"{part.name}.at"))
    return arrows(places, blocks[f"{part.name}.angle"] * ANGLE_STEP, 5.6, part.colour, place)


def arrows(places: Any, angles: Any, size: float, colour: str, place: Placement) -> str:
    """Return filled triangles; `size` is from the middle to a corner."""
    corners = -np.asarray(angles)[:, None] + (0, 2.4, -2.4)
    u = places[:, :1] + size * place.unit * np.cos(corners)
    v = places[:, 1:] + size * place.unit * np.sin(corners)
    found = place.path(place.round_coordinates(np.stack([u, v], axis=-1)))
    return f'<path d="{found.replace("M", "ZM")[1:]}Z" fill="var(--{colour})"/>' if found else ""


def equator(header: Mapping[str, Any], place: Placement) -> list[str]:
    """Return the circle |p| = 1, and arrowheads in the sense of theta'."""
    colour, width = ("degenerate", 6) if header.get("all_directions") else ("ink", 2)
    circle = f"{rim(place)} {stroke(colour, width, (), place)}/>"
    sense = np.asarray(header.get("sense") or np.zeros((0, 3)), float)
    return [circle, arrows(place.points(sense[:, :2]), sense[:, 2], 7.7, "ink", place) if len(sense) else ""]


def launch_marks(launched: Mapping[str, Any] | None, parts: Sequence[Part], place: Placement) -> list[str]:
    """Return where launched orbits start."""
    if not launched:
        return []
    found = place.points(np.column_stack([launched["x"], launched["y"]])).tolist()
    return [
        f'<circle cx="{u}" cy="{v}" r="{5.5 * place.unit:.1f}" fill="var(--{parts[i % len(parts)].colour})" '
        f"{stroke('page', 2.4, (), place)}/>"
        for i, (u, v) in enumerate(found)
    ]


def marks(columns: Mapping[str, Any], place: Placement, taken: list[LabelBox]) -> list[str]:
    """Return the marks of equator equilibria or critical sets; their boxes are added to `taken`."""
    drawn = []
    for i, (u, v) in enumerate(place.points(np.column_stack([columns["x"], columns["y"]])).tolist()):
        if place.holds(u, v):
            drawn.append(mark(columns, i, u, v, place.unit, 2.1 * place.unit))
            size = CORE * columns["size"][i] * place.unit
            taken.append(LabelBox(u - size / 2, v - size / 2, size, size))
    return drawn


def labels(columns: Mapping[str, Any], place: Placement, taken: list[LabelBox], ringed: bool) -> list[str]:
    """Return the labels of marks: none stands over what is in `taken`, to which their boxes are added.

    `ringed`: there is a ring around the equator.
    """
    drawn = []
    for i, (u, v) in enumerate(place.points(np.column_stack([columns["x"], columns["y"]])).tolist()):
        if not place.holds(u, v):
            continue
        if "label_x" in columns:
            away = np.array([columns["label_x"][i] - columns["x"][i], columns["y"][i] - columns["label_y"][i]])
            away *= min(place.scale, place.side / (2 * HALF_VIEW))  # zoomed in, it stays as near to its mark
            away *= place.beyond if ringed else 1.0
            drawn.append(label(columns["label"][i], u + away[0], v + away[1], "middle", place, taken))
        else:
            text = f"{columns['label'][i]} {columns['sense'][i]}".strip()
            drawn.append(label(text, u + 12.6 * place.unit, v - 12.2 * place.unit, "start", place, taken))
    return drawn


def mark(columns: Mapping[str, Any], i: int, u: float, v: float, unit: float, width: float) -> str:
    """Return mark i of some columns at a place of the drawing."""
    name, colour = columns["shape"][i], f"var(--{columns['colour'][i]})"
    fill = "none" if name in OPEN else colour if columns["filled"][i] else "var(--page)"
    look = f'stroke="{colour}" stroke-width="{width:.3g}" fill="{fill}"'
    return f'<path transform="translate({u} {v})" d="{shape(name, columns["size"][i] * unit)}" {look}/>'


def label(text: str, x: float, y: float, anchor: str, place: Placement, taken: list[LabelBox]) -> str:
    """Return a label next to (x, y), the middle of its height, or where it stands over no other."""
    box = clear_of(taken, text, x, y, anchor, place.text, place.side, place.height)
    taken.append(box)
    at = box.x + box.width / 2 if anchor == "middle" else box.x
    return words(at, box.y + box.height / 2 + 0.34 * place.text, text, place.text, anchor, bold=True)


def words(
    x: float, y: float, text: str, size: float, anchor: str = "start", bold: bool = False, room: float = math.inf
) -> str:
    """Return a line of text; `y` is that of its foot. In a wide font it is condensed where there is no more `room`."""
    look = f'font-size="{size:g}"' + (' font-weight="700"' if bold else "") + ' fill="var(--ink)"'
    aligned = f' text-anchor="{anchor}"' if anchor != "start" else ""
    if MAX_LABEL_SCALE * width_of(text, size) > room:
        aligned += f' textLength="{USUAL * width_of(text, size):.1f}" lengthAdjust="spacingAndGlyphs"'
    return f'<text x="{round(x, 1):g}" y="{round(y, 1):g}" {look}{aligned}>{text}</text>'


def arcs(outcomes: Mapping[str, Any] | None, place: Placement) -> list[str]:
    """Return the ring of approach outcomes: colours, and hatches over them."""
    if not outcomes:
        return []
    drawn = []
    for start, end, kind in zip(outcomes["start"], outcomes["end"], outcomes["kind"], strict=True):
        ring = place.points(_ring(start, end, *RING))
        drawn.append(f'<path d="{place.path([ring])}Z" fill="var(--{kind})"/>')
        if strokes := _hatching(start, end, HATCHES[kind], place):
            drawn.append(f'<path d="{place.path(place.points(s) for s in strokes)}" {stroke("page", 1.4, (), place)}/>')
    return drawn


def _ring(start: float, end: float, inner: float, outer: float) -> list[tuple[float, float]]:
    """Return the outline of one arc of the ring as a closed polygon of points of the picture."""
    count = max(2, math.ceil((end - start) / 0.1) + 1)
    angles = [start + (end - start) * i / (count - 1) for i in range(count)]
    there = [(outer * math.cos(t), outer * math.sin(t)) for t in angles]
    return there + [(inner * math.cos(t), inner * math.sin(t)) for t in reversed(angles)]


def _hatching(start: float, end: float, hatch: str, place: Placement) -> list[Any]:
    """Return strokes across an arc of the ring: "/" one way, "x" both ways, "." short ones along its middle."""
    inner, outer = RING
    middle = (inner + outer) / 2
    step, lean = HATCH * place.unit / (middle * place.scale), (outer - inner) / middle / 2
    ways = {"/": ((inner, -lean, outer, lean),), "x": ((inner, -lean, outer, lean), (inner, lean, outer, -lean)),
            ".": ((middle, -lean / 4, middle, lean / 4),)}.get(hatch, ())  # fmt: skip
    angles = np.arange(start + step / 2, end, step)
    return [
        [(r * math.cos(t + back), r * math.sin(t + back)), (q * math.cos(t + on), q * math.sin(t + on))]
        for t in angles
        for r, back, q, on in ways
    ]


def basins(found: Mapping[str, Any] | None, blocks: Mapping[str, Any], place: Placement) -> list[str]:
    """Return the basins, a rectangle for each run of cells in a row; rows rise with y."""
    if not found:
        return []
    cells = found["cells"]
    x0, x1, y0, _ = found["box"]
    side = (x1 - x0) * place.scale / cells
    left, bottom = ((x0 - place.seen[0]) * place.scale, (place.seen[3] - y0) * place.scale)
    paths: dict[str, list[str]] = {}
    at = 0
    for length, which in blocks["basins"].reshape(-1, 2).tolist():
        colour = found["colours"][which]
        while length:
            row, column = divmod(at, cells)
            here = min(length, cells - column)
            if colour:
                x, y = left + column * side, bottom - (row + 1) * side
                paths.setdefault(colour, []).append(
                    f"M{x:.1f} {y:.1f}h{here * side:.1f}v{side:.1f}h{-here * side:.1f}Z"
                )
            at, length = at + here, length - here
    look = 'opacity=".3" shape-rendering="crispEdges"'  # no seams between the rows
    return [f'<path d="{"".join(path)}" fill="var(--{colour})" {look}/>' for colour, path in paths.items()]
