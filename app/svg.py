"""The first picture as inline SVG, so that the page shows it before any script has loaded."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from .packing import STEP, unpack
from .theme import ARROWED, DISCS, LINES, VIEW

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
