"""A small chart as SVG: lines over a parameter or time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape
from itertools import pairwise
from typing import Any

import numpy as np

from ...picture.draw.still import fill_colours
from ...picture.draw.theme import themes
from ...picture.draw.vector.parts import Placement, stroke, words
from .sketch import COLOURS, LineChart, RegionChart, region_colour

CHART_WIDTH, CHART_HEIGHT, LEFT_MARGIN, BOTTOM = 360.0, 220.0, 44.0, 34.0
SQUARE, EDGE, NAME_ROOM = 360.0, 'stroke="var(--soft)" stroke-width="0.8"', 60.0
MAX_CHART_POINTS = 3000  # of all lines together
#: Width of a letter, and height of a row of names.
LETTER, ROW_HEIGHT = 6.2, 13


@dataclass(frozen=True)
class Frame:
    """The frame of a chart: its lower left corner is (left, low), as far as (right, high) is (wide, tall) px."""

    corner: tuple[float, float]
    foot: tuple[float, float]
    scale: tuple[float, float]

    def place(self, x: Any, y: Any) -> tuple[float, float]:
        """Return the place of a point, in px."""
        (left, low), (across, up), (u, v) = self.corner, self.scale, self.foot
        return float((x - left) * across + u), float((y - low) * up + v)


def line_chart(shown: LineChart, colours: Mapping[str, str] | None = None) -> tuple[str, Frame]:
    """Return lines with the ends of both axes and a word for each kind, and where values are.

    Parameters
    ----------
    shown : LineChart
    colours : mapping, optional
        By name; by default those of the light theme.
    """
    lines, across, up = shown.lines, shown.across, shown.up
    kept = [
        (name, thin_out(np.column_stack([x, y]), max(2, MAX_CHART_POINTS // len(lines))))
        for name, x, y in lines
        if len(x)
    ]
    every = np.concatenate([points for _, points in kept]) if kept else np.zeros((1, 2))
    (left, low), (right, high) = every.min(axis=0), every.max(axis=0)
    kinds = dict(zip(dict.fromkeys(name for name, _ in kept), COLOURS * 9, strict=False))
    named = list(kinds.items())[: len(COLOURS)]
    wide, tall = CHART_WIDTH - LEFT_MARGIN - 8, CHART_HEIGHT - BOTTOM - 22
    in_one_row = all(LETTER * len(name) <= wide / len(named) for name, _ in named)  # else each has a row of its own
    top = 18 + (0 if in_one_row else ROW_HEIGHT * (len(named) - 1))
    scale = wide / ((right - left) or 1.0), -tall / ((high - low) or 1.0)
    place = Placement(side=CHART_WIDTH, unit=1.0, decimals=1)
    floor = top + tall + 4
    frame = Frame((float(left), float(low)), (LEFT_MARGIN, floor - 2), scale)
    parts = [f'<rect x="{LEFT_MARGIN}" y="{top}" width="{wide}" height="{tall + 4}" stroke="var(--line)"/>']
    for name, points in kept:
        placed = (points - (left, low)) * scale + (LEFT_MARGIN, floor - 2)
        path = place.path([np.round(placed, 1)])
        parts.append(f'<path d="{path}" {stroke(kinds[name], 1.6, (), place)}/>')
    for i, (name, colour) in enumerate(named):
        x, y = (i * wide / len(named), 12) if in_one_row else (0, 12 + ROW_HEIGHT * i)
        parts.append(words(LEFT_MARGIN + 4 + x, y, escape(name), 11.0).replace("--ink", f"--{colour}"))
    foot = floor + 14
    parts += [
        words(LEFT_MARGIN, foot, _short_number(left), 11.0),
        words(CHART_WIDTH - 8, foot, _short_number(right), 11.0, "end"),
    ]
    parts += [
        words(LEFT_MARGIN - 4, y, _short_number(value), 11.0, "end") for y, value in ((floor, low), (top + 10, high))
    ]
    parts += [
        words((LEFT_MARGIN + CHART_WIDTH) / 2, foot, across, 12.0, "middle"),
        words(LEFT_MARGIN - 12, (top + floor) / 2, up, 12.0, "end"),
    ]
    return close_svg("".join(parts), CHART_WIDTH, foot + 8, CHART_WIDTH, foot + 8, colours), frame


def regions(shown: RegionChart) -> str:
    """Return regions of a plane in the colours of the atlas, each with its name where there is room."""
    areas, spans, across, up = shown.areas, shown.spans, shown.across, shown.up
    (left, right), (low, high) = spans
    wide, tall = SQUARE - LEFT_MARGIN - 8, SQUARE - LEFT_MARGIN - 8
    scale, place = (wide / (right - left), -tall / (high - low)), Placement(side=SQUARE, unit=1.0, decimals=1)
    floor = 8 + tall
    each = MAX_CHART_POINTS // max(1, sum(len(polygons) for _, polygons in areas))
    parts, names = [], []
    for name, polygons in areas:
        placed = [np.round((thin_out(one, each) - (left, low)) * scale + (LEFT_MARGIN, floor), 1) for one in polygons]
        fill = region_colour(name, themes()["light"])
        path = place.path(placed).replace("M", "ZM")[1:] + "Z"
        parts.append(f'<path d="{path}" fill="var(--{fill})" fill-opacity=".45" fill-rule="evenodd" {EDGE}/>')
        x, y, room = _widest_middle(placed)
        if room > NAME_ROOM:
            names.append(words(x, y + 4, escape(name), 10.0, "middle"))
    parts += [f'<rect x="{LEFT_MARGIN}" y="8" width="{wide}" height="{tall}" stroke="var(--line)"/>', *names]
    foot = floor + 14
    parts += [
        words(LEFT_MARGIN, foot, _short_number(left), 11.0),
        words(SQUARE - 8, foot, _short_number(right), 11.0, "end"),
    ]
    parts += [words(LEFT_MARGIN - 4, y, _short_number(value), 11.0, "end") for y, value in ((floor, low), (18, high))]
    parts += [
        words((LEFT_MARGIN + SQUARE) / 2, foot, across, 12.0, "middle"),
        words(LEFT_MARGIN - 12, 8 + tall / 2, up, 12.0, "end"),
    ]
    clip = f'<clipPath id="plane"><rect x="{LEFT_MARGIN}" y="8" width="{wide}" height="{tall}"/></clipPath>'
    inside = f'{clip}<g clip-path="url(#plane)">{"".join(parts[: len(areas)])}</g>{"".join(parts[len(areas) :])}'
    return close_svg(inside, SQUARE, foot + 8, SQUARE, foot + 8)


def _widest_middle(polygons: Sequence[Any]) -> tuple[float, float, float]:
    """Return the middle of the widest horizontal stretch inside polygons, and how long it is."""
    rings = [np.vstack([one, one[:1]]) for one in polygons]
    heights = np.concatenate(polygons)[:, 1]
    best = (0.0, 0.0, 0.0)
    for y in np.linspace(heights.min(), heights.max(), 25)[1:-1] + 0.017:
        crossed = sorted(
            float(x0 + (y - y0) / (y1 - y0) * (x1 - x0))
            for ring in rings
            for (x0, y0), (x1, y1) in pairwise(ring.tolist())
            if (y0 < y) != (y1 < y)
        )
        for x0, x1 in zip(crossed[::2], crossed[1::2], strict=True):
            if x1 - x0 > best[2]:
                best = (0.5 * (x0 + x1), float(y), x1 - x0)
    return best


def thin_out(points: Any, most: int) -> Any:
    """Return points of a line, of many evenly left out, its ends kept."""
    if len(points) <= most:
        return points
    return points[np.unique(np.linspace(0, len(points) - 1, max(2, most)).astype(int))]


def _short_number(value: float) -> str:
    return f"{0.0 if abs(value) < 1e-12 else value:.3g}".replace("-", "−")


def close_svg(
    inner: str, width: float, height: float, wide: float, high: float, colours: Mapping[str, str] | None = None
) -> str:
    """Return elements as an SVG that needs nothing else."""
    whole = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:g}" width="{wide:g}" '
        f'height="{high:g}" fill="none" stroke-linejoin="round" font-family="sans-serif">'
        f'<rect width="{width:g}" height="{height:g}" fill="var(--page)"/>{inner}</svg>'
    )
    return fill_colours(whole, themes()["light"] if colours is None else colours)
