"""Pictures as inline SVG: the first one, shown before any script has loaded, and small portraits for the atlas.

Colours are the style sheet's custom properties, so that light and dark need no second drawing.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from typing import Any

import numpy as np

from codim2_core.scene import Scene

from . import glyphs
from .layers import LAYERS, Part, painted
from .packing import ANGLE_STEP, STEP, unpack
from .shapes import OPEN, shape
from .theme import DISCS, RING, VIEW

SIDE = 1000
SCALE = SIDE / (2 * VIEW)
#: Lines and marks have the size that they have in a picture of 700 px.
UNIT = SIDE / 700


def draw(buffer: bytes, layers: Collection[str]) -> str:
    """Return the picture of one packed frame as an ``<svg>`` element, about 30 kB.

    Coordinates are whole thousandths of the picture's side.

    Parameters
    ----------
    buffer : bytes
        A frame that holds everything.
    layers : collection of str
        Those that are shown.
    """
    header, blocks = unpack(buffer)
    parts = [
        f'<svg viewBox="0 0 {SIDE} {SIDE}" fill="none" stroke-linejoin="round" stroke-linecap="round">',
        f'<g fill="var(--shade)" style="fill-opacity:var(--shade-alpha)">{"".join(_disc(r) for r in DISCS)}</g>',
    ]
    drawn = [layer for layer in painted() if layer.name in layers]
    if "basins" in layers:
        parts += _basins(header.get("basins"), blocks)
    if "outcomes" in layers:
        parts += _arcs(header.get("outcomes"))
    parts += [piece for layer in drawn for part in layer.parts for piece in _curves(part, blocks)]
    parts += _equator(header)
    for name in ("equator", "critical"):
        if name in layers and header.get(name):
            parts += _marks(header[name])
    return "".join(parts) + "</svg>"


#: Layers of a small portrait, from bottom to top, and their widths in px where it is 80 px wide.
SMALL = {"outside": 0.5, "inside": 0.6, "continuations": 1.0, "cycles": 1.6}
SMALL_SIDE = 240


def small(scene: Scene, view: float) -> str:
    """Return a small portrait without words: trajectories, limit cycles, equator equilibria and critical sets.

    Parameters
    ----------
    scene : Scene
    view : float
        Half its width in picture units.

    Returns
    -------
    str
        An ``<svg>`` element of some 5 kB, in the style sheet's colours.
    """
    scale = SMALL_SIDE / (2 * view)
    unit = SMALL_SIDE / 80

    def place(points: Any) -> Any:
        return np.rint(np.asarray(points, float).reshape(-1, 2) * (scale, -scale) + SMALL_SIDE / 2).astype(int)

    parts = [f'<svg viewBox="0 0 {SMALL_SIDE} {SMALL_SIDE}" fill="none" stroke-linejoin="round" aria-hidden="true">']
    for name, width in SMALL.items():
        for part in LAYERS[name].parts:
            offsets, points = part.pieces(scene[part.scene])
            path = _path(np.split(place(points), offsets[1:-1]))
            parts.append(f'<path d="{path}" stroke="var(--{part.colour})" stroke-width="{width * unit:.1f}"/>')
    parts.append(f'<circle cx="120" cy="120" r="{scale:.0f}" stroke="var(--ink)" stroke-width="4"/>')
    for columns in (glyphs.equator_columns(scene["equator"]), glyphs.critical_columns(scene["critical"])):
        for i, (u, v) in enumerate(place(np.column_stack([columns["x"], columns["y"]])).tolist()):
            parts.append(_mark(columns, i, u, v, 18 / columns["size"][i], 4))
    return "".join(parts) + "</svg>"


def _pixels(values: Any) -> Any:
    points = np.asarray(values, float).reshape(-1, 2) * SCALE
    return np.rint(points * (1, -1) + SIDE / 2).astype(int)


def _path(pieces: Sequence[Any]) -> str:
    return "".join("M" + "L".join(f"{x} {y}" for x, y in piece.tolist()) for piece in pieces if len(piece) > 1)


def _disc(radius: float) -> str:
    return f'<circle cx="{SIDE // 2}" cy="{SIDE // 2}" r="{radius * SCALE:.0f}"/>'


def _curves(part: Part, blocks: Mapping[str, Any]) -> list[str]:
    """Return the strokes of one part, and its arrowheads."""
    if f"{part.name}.n" not in blocks:
        return []
    ends = np.cumsum(blocks[f"{part.name}.n"], dtype=np.int64)[:-1]
    path = _path(np.split(_pixels(blocks[f"{part.name}.xy"] * STEP), ends))
    dash = f' stroke-dasharray="{" ".join(f"{v * UNIT:.0f}" for v in part.dash)}"' if part.dash else ""
    drawn = [f'<path d="{path}" stroke="var(--{part.colour})" stroke-width="{part.width * UNIT:.1f}"{dash}/>']
    if f"{part.name}.at" in blocks:
        places = _pixels(blocks[f"{part.name}.at"] * STEP)
        drawn.append(_arrows(places, blocks[f"{part.name}.angle"] * ANGLE_STEP, 8, part.colour))
    return drawn


def _arrows(places: Any, angles: Any, size: float, colour: str) -> str:
    """Return filled triangles; `size` is from the middle to a corner."""
    corners = -np.asarray(angles)[:, None] + (0, 2.4, -2.4)
    u = places[:, :1] + size * np.cos(corners)
    v = places[:, 1:] + size * np.sin(corners)
    heads = np.rint(np.stack([u, v], axis=-1)).astype(int)
    path = "".join("M" + "L".join(f"{x} {y}" for x, y in head) + "Z" for head in heads.tolist())
    return f'<path d="{path}" fill="var(--{colour})"/>'


def _equator(header: Mapping[str, Any]) -> list[str]:
    """Return the circle |p| = 1, and arrowheads in the sense of theta'."""
    colour, width = ("degenerate", 6) if header.get("all_directions") else ("ink", 2)
    circle = f'<circle cx="500" cy="500" r="{SCALE:.0f}" stroke="var(--{colour})" stroke-width="{width * UNIT:.1f}"/>'
    sense = np.asarray(header.get("sense") or np.zeros((0, 3)), float)
    return [circle, *([_arrows(_pixels(sense[:, :2]), sense[:, 2], 11, "ink")] if len(sense) else [])]


def _marks(columns: Mapping[str, Any]) -> list[str]:
    """Return the marks and labels of equator equilibria or critical sets."""
    parts = []
    for i, (u, v) in enumerate(_pixels(np.column_stack([columns["x"], columns["y"]])).tolist()):
        parts.append(_mark(columns, i, u, v, UNIT, 3))
        if "label_x" in columns:
            [[x, y]] = _pixels([columns["label_x"][i], columns["label_y"][i]]).tolist()
            parts.append(_text(x, y + 7, columns["label"][i], ' text-anchor="middle"'))
        else:
            parts.append(_text(u + 18, v - 10, f"{columns['label'][i]} {columns['sense'][i]}".strip()))
    return parts


def _mark(columns: Mapping[str, Any], i: int, u: float, v: float, unit: float, width: float) -> str:
    """Return mark i of some columns at a place in the picture."""
    name, colour = columns["shape"][i], f"var(--{columns['colour'][i]})"
    fill = "none" if name in OPEN else colour if columns["filled"][i] else "var(--page)"
    look = f'stroke="{colour}" stroke-width="{width}" fill="{fill}"'
    return f'<path transform="translate({u} {v})" d="{shape(name, columns["size"][i] * unit)}" {look}/>'


def _text(x: float, y: float, words: str, more: str = "") -> str:
    return f'<text x="{x:.0f}" y="{y:.0f}" font-size="22" font-weight="700" fill="var(--ink)"{more}>{words}</text>'


def _arcs(outcomes: Mapping[str, Any] | None) -> list[str]:
    """Return the ring of approach outcomes."""
    if not outcomes:
        return []
    arcs = zip(outcomes["start"], outcomes["end"], outcomes["kind"], strict=True)
    return [
        f'<path d="{_path([_pixels(_ring(start, end, *RING))])}Z" fill="var(--{kind})"/>' for start, end, kind in arcs
    ]


def _ring(start: float, end: float, inner: float, outer: float) -> list[tuple[float, float]]:
    """Return the outline of one arc of the ring as a closed polygon of points of the picture."""
    count = max(2, math.ceil((end - start) / 0.1) + 1)
    angles = [start + (end - start) * i / (count - 1) for i in range(count)]
    there = [(outer * math.cos(t), outer * math.sin(t)) for t in angles]
    return there + [(inner * math.cos(t), inner * math.sin(t)) for t in reversed(angles)]


def _basins(basins: Mapping[str, Any] | None, blocks: Mapping[str, Any]) -> list[str]:
    """Return the basins, a rectangle for each run of cells in a row; rows rise with y."""
    if not basins:
        return []
    cells, side = basins["cells"], 2 * SCALE / basins["cells"]
    left, top = SIDE / 2 - SCALE, SIDE / 2 + SCALE
    paths: dict[str, list[str]] = {}
    at = 0
    for length, which in blocks["basins"].reshape(-1, 2).tolist():
        colour = basins["colours"][which]
        while length:
            row, column = divmod(at, cells)
            here = min(length, cells - column)
            if colour:
                x, y = left + column * side, top - (row + 1) * side
                paths.setdefault(colour, []).append(
                    f"M{x:.1f} {y:.1f}h{here * side:.1f}v{side:.1f}h{-here * side:.1f}Z"
                )
            at, length = at + here, length - here
    return [f'<path d="{"".join(path)}" fill="var(--{colour})" opacity=".3"/>' for colour, path in paths.items()]
