"""A small chart as SVG: lines over a parameter or time."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from typing import Any

import numpy as np

from ..draw.still import coloured
from ..draw.theme import themes
from ..draw.vector.parts import Place, stroke, words

COLOURS = ("rho", "theta", "separatrix", "continuation", "node-focus", "soft")
WIDTH, HEIGHT, LEFT, BOTTOM = 360.0, 220.0, 44.0, 34.0
POINTS = 3000  # of all lines together
#: Names of lines that are told; letters of one, up to which all stand in one row; height of a row.
NAMED, LETTERS, ROW = 4, 14, 13


def chart(lines: Sequence[tuple[str, Any, Any]], across: str, up: str) -> str:
    """Return lines over a parameter or time, with the ends of both axes and a word for each kind of line.

    Parameters
    ----------
    lines : sequence of (name, x, y)
        Those of one name have one colour.
    across, up : str
        Names of the axes.
    """
    kept = [(name, thinned(np.column_stack([x, y]), max(2, POINTS // len(lines)))) for name, x, y in lines if len(x)]
    every = np.concatenate([points for _, points in kept]) if kept else np.zeros((1, 2))
    (left, low), (right, high) = every.min(axis=0), every.max(axis=0)
    colours = dict(zip(dict.fromkeys(name for name, _ in kept), COLOURS * 9, strict=False))
    named = list(colours.items())[:NAMED]
    beside = all(len(name) <= LETTERS for name, _ in named)  # else each has a row of its own
    top = 18 + (0 if beside else ROW * (len(named) - 1))
    wide, tall = WIDTH - LEFT - 8, HEIGHT - BOTTOM - 22
    scale = wide / ((right - left) or 1.0), -tall / ((high - low) or 1.0)
    place = Place(side=WIDTH, unit=1.0, decimals=1)
    floor = top + tall + 4
    parts = [f'<rect x="{LEFT}" y="{top}" width="{wide}" height="{tall + 4}" stroke="var(--line)"/>']
    for name, points in kept:
        placed = (points - (left, low)) * scale + (LEFT, floor - 2)
        path = place.path([np.round(placed, 1)])
        parts.append(f'<path d="{path}" {stroke(colours[name], 1.6, (), place)}/>')
    for i, (name, colour) in enumerate(named):
        x, y = (i * wide / len(named), 12) if beside else (0, 12 + ROW * i)
        parts.append(words(LEFT + 4 + x, y, escape(name), 11.0).replace("--ink", f"--{colour}"))
    foot = floor + 14
    parts += [words(LEFT, foot, _short(left), 11.0), words(WIDTH - 8, foot, _short(right), 11.0, "end")]
    parts += [words(LEFT - 4, y, _short(value), 11.0, "end") for y, value in ((floor, low), (top + 10, high))]
    parts += [
        words((LEFT + WIDTH) / 2, foot, across, 12.0, "middle"),
        words(LEFT - 12, (top + floor) / 2, up, 12.0, "end"),
    ]
    return finished("".join(parts), WIDTH, foot + 8, WIDTH, foot + 8)


def thinned(points: Any, most: int) -> Any:
    """Return points of a line, of many evenly left out, its ends kept."""
    if len(points) <= most:
        return points
    return points[np.unique(np.linspace(0, len(points) - 1, max(2, most)).astype(int))]


def _short(value: float) -> str:
    return f"{0.0 if abs(value) < 1e-12 else value:.3g}".replace("-", "−")


def finished(inner: str, width: float, height: float, wide: float, high: float) -> str:
    """Return elements as an SVG that needs nothing else."""
    whole = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:g}" width="{wide:g}" '
        f'height="{high:g}" fill="none" stroke-linejoin="round" font-family="sans-serif">'
        f'<rect width="{width:g}" height="{height:g}" fill="var(--page)"/>{inner}</svg>'
    )
    return coloured(whole, themes()["light"])
