"""Pictures as inline SVG: the first one, shown before any script has loaded, and small portraits for the atlas."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from codim2_core.scene import Scene

from .packing import STEP, unpack
from .theme import ARROWED, DISCS, LINES, RING, VIEW

#: Colours are the style sheet's, so that light and dark need no second drawing.
COLOURS = {
    "lines_outside": "lines-out",
    "lines_inside": "lines-in",
    "rho": "rho",
    "theta": "theta",
    "outside": "outside",
    "orbit": "orbit",
    "continuation": "continuation",
    "separatrix": "separatrix",
    "cycle": "cycle",
}
SIDE = 1000
SCALE = SIDE / (2 * VIEW)


def draw(buffer: bytes) -> str:
    """Return the picture of one packed frame as an ``<svg>`` element, about 30 kB.

    Coordinates are whole thousandths of the picture's side; marks stand at the size that they have at 700 px.
    """
    header, blocks = unpack(buffer)
    parts = [
        f'<svg viewBox="0 0 {SIDE} {SIDE}" fill="none" stroke-linejoin="round" stroke-linecap="round">',
        *(f'<circle cx="500" cy="500" r="{r * SCALE:.0f}" fill="#3b6ea5" opacity=".022"/>' for r in DISCS),
    ]
    outcomes = header.get("outcomes") or {"kind": []}
    for start, end, kind in zip(outcomes.get("start", ()), outcomes.get("end", ()), outcomes["kind"], strict=True):
        outline = [(500 + SCALE * x, 500 - SCALE * y) for x, y in _ring(start, end, *RING)]
        parts.append(f'<path d="{_path(np.rint(outline).astype(int))}Z" fill="var(--{kind})"/>')
    for name, colour, width in LINES:
        if f"{name}.n" in blocks:
            ends = np.cumsum(blocks[f"{name}.n"], dtype=np.int64)[:-1]
            path = "".join(map(_path, np.split(_pixels(blocks[f"{name}.xy"]), ends)))
            parts.append(f'<path d="{path}" stroke="var(--{COLOURS[colour]})" stroke-width="{width * 1.4:.1f}"/>')
        if name in ARROWED and f"{name}.at" in blocks:
            heads = np.column_stack([_pixels(blocks[f"{name}.at"]), -blocks[f"{name}.angle"] * (180 / 32767)])
            path = "".join(map(_arrow, heads))
            parts.append(f'<path d="{path}" fill="var(--{COLOURS[colour]})"/>')
    parts.append(f'<circle cx="500" cy="500" r="{SCALE:.0f}" stroke="var(--ink)" stroke-width="2.8"/>')
    parts += _marks(header)
    return "".join(parts) + "</svg>"


#: Layers of a small portrait, from bottom to top: colour and width in px where the portrait is 80 px wide.
SMALL = {"outside": ("outside", 0.5), "inside": ("orbit", 0.6), "continuations": ("continuation", 1.0)}
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

    def stroke(pieces: Sequence[Any], colour: str, width: float) -> str:
        path = "".join(_path(place(piece)) for piece in pieces if len(piece) > 1)
        return f'<path d="{path}" stroke="var(--{COLOURS[colour]})" stroke-width="{width * unit:.1f}"/>'

    def dot(x: float, y: float, colour: str, filled: bool) -> str:
        [[u, v]] = place([[x, y]])
        fill = f"var(--{colour})" if filled else "var(--page)"
        return f'<circle cx="{u}" cy="{v}" r="9" stroke="var(--{colour})" stroke-width="4" fill="{fill}"/>'

    parts = [f'<svg viewBox="0 0 {SMALL_SIDE} {SMALL_SIDE}" fill="none" stroke-linejoin="round" aria-hidden="true">']
    for name, (colour, width) in SMALL.items():
        lines = scene[name]
        parts.append(stroke(np.split(lines.buffer, lines.offsets[1:-1]), colour, width))
    parts.append(stroke([cycle.points for cycle in scene["cycles"]], "cycle", 1.6))
    parts.append(f'<circle cx="120" cy="120" r="{scale:.0f}" stroke="var(--ink)" stroke-width="4"/>')
    equator = scene["equator"]
    for theta, rate in zip(equator.theta, equator.lambda_rho, strict=True):
        parts.append(dot(np.cos(theta), np.sin(theta), "attr" if rate < 0 else "rep", rate < 0))
    for C in scene["critical"]:
        [[u, v]] = place([C.p])
        cross = f'<path d="M{u - 9} {v - 9}l18 18m0-18l-18 18" stroke="var(--crit)" stroke-width="6"/>'
        parts.append(cross if C.kind == "saddle" else dot(C.p[0], C.p[1], "crit", C.kind.startswith("stable")))
    return "".join(parts) + "</svg>"


def _pixels(values: Any) -> Any:
    points = np.asarray(values, float).reshape(-1, 2) * (STEP * SCALE)
    return np.rint(points * (1, -1) + SIDE / 2).astype(int)


def _path(points: Any) -> str:
    return "M" + "L".join(f"{x} {y}" for x, y in points.tolist()) if len(points) else ""


def _arrow(head: Any) -> str:
    x, y, angle = head
    turn = np.radians(angle)
    corners = [(x + 8 * np.cos(turn + k), y + 8 * np.sin(turn + k)) for k in (0, 2.4, -2.4)]
    return "M" + "L".join(f"{u:.0f} {v:.0f}" for u, v in corners) + "Z"


def _marks(header: Mapping[str, Any]) -> list[str]:
    parts = []
    equator = header.get("equator") or {"x": []}
    for i in range(len(equator["x"])):
        x, y = 500 + SCALE * equator["x"][i], 500 - SCALE * equator["y"][i]
        colour = "var(--attr)" if equator["filled"][i] else "var(--rep)"
        fill = colour if equator["filled"][i] else "var(--page)"
        lx, ly = 500 + SCALE * equator["label_x"][i], 500 - SCALE * equator["label_y"][i]
        parts.append(f'<circle cx="{x:.0f}" cy="{y:.0f}" r="9" stroke="{colour}" stroke-width="3" fill="{fill}"/>')
        parts.append(_text(lx, ly + 7, equator["label"][i], 'text-anchor="middle"'))
    critical = header.get("critical") or {"x": []}
    for i in range(len(critical["x"])):
        x, y = 500 + SCALE * critical["x"][i], 500 - SCALE * critical["y"][i]
        fill = "var(--crit)" if critical["kind"][i].startswith("stable") else "var(--page)"
        parts.append(f'<circle cx="{x:.0f}" cy="{y:.0f}" r="9" stroke="var(--crit)" stroke-width="3" fill="{fill}"/>')
        parts.append(_text(x + 18, y - 10, critical["label"][i]))
    return parts


def _text(x: float, y: float, words: str, more: str = "") -> str:
    return f'<text x="{x:.0f}" y="{y:.0f}" font-size="22" font-weight="700" fill="var(--ink)" {more}>{words}</text>'


def _ring(start: float, end: float, inner: float, outer: float) -> list[tuple[float, float]]:
    """Return the outline of one arc of the ring as a closed polygon of points of the picture."""
    count = max(2, math.ceil((end - start) / 0.1) + 1)
    angles = [start + (end - start) * i / (count - 1) for i in range(count)]
    there = [(outer * math.cos(t), outer * math.sin(t)) for t in angles]
    return there + [(inner * math.cos(t), inner * math.sin(t)) for t in reversed(angles)]
