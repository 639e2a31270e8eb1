"""Work-precision pictures: log-log plots as SVG, from numbers, and the same figures for Bokeh's HTML page."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

COLOURS = (
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f7f7f", "#8c564b", "#bcbd22", "#9467bd",
    "#17becf", "#e377c2", "#2ca02c", "#000000",
)  # fmt: skip
DASHES = ("", "6 3", "2 2", "8 3 2 3")


@dataclass(frozen=True)
class Line:
    """One curve: points (x, y), both positive."""

    name: str
    points: tuple[tuple[float, float], ...]
    bold: bool = False


@dataclass(frozen=True)
class Plot:
    """A log-log plot.

    Attributes
    ----------
    title, x, y : str
        Labels of the axes.
    lines : tuple of Line
    """

    title: str
    lines: tuple[Line, ...]
    x: str = "error"
    y: str = "seconds"


def plot(title: str, curves: dict[str, Sequence[tuple[float, float]]], first: str = "ours", **labels: str) -> Plot:
    """Make a plot of curves; points that are zero or not finite are left out (errors of 0 are drawn at 1e-17)."""
    lines = []
    for name, points in curves.items():
        clean = tuple(
            (max(x, 1e-17), y) for x, y in points if math.isfinite(x) and math.isfinite(y) and x >= 0.0 and y > 0.0
        )
        if clean:
            lines.append(Line(name, clean, name.startswith(first)))
    return Plot(title, tuple(lines), **labels)


def style(names: Sequence[str]) -> dict[str, tuple[str, str]]:
    """Colour and dash of each name; the same in all plots that list the same names."""
    return {
        name: (COLOURS[i % len(COLOURS)], DASHES[(i // 5) % len(DASHES)]) for i, name in enumerate(dict.fromkeys(names))
    }


def _decades(values: Sequence[float]) -> tuple[int, int]:
    low, high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))
    return low, max(high, low + 1)


def _power(k: int) -> str:
    return f'10<tspan dy="-4" font-size="8">{str(k).replace("-", "−")}</tspan>'


def panel(figure: Plot, left: float, top: float, width: float, height: float, styles: dict) -> str:
    """One plot as an SVG group."""
    points = [point for line in figure.lines for point in line.points]
    if not points:
        return ""
    (x0, x1), (y0, y1) = _decades([p[0] for p in points]), _decades([p[1] for p in points])
    across, up = width - 52, height - 52

    def place(x: float, y: float) -> str:
        u = left + 42 + across * (math.log10(x) - x0) / (x1 - x0)
        v = top + 20 + up * (1.0 - (math.log10(y) - y0) / (y1 - y0))
        return f"{u:.1f},{v:.1f}"

    out = [f'<text x="{left + 42}" y="{top + 13}" font-weight="600">{escape(figure.title)}</text>']
    for k in range(x0, x1 + 1, max(1, (x1 - x0) // 6)):
        u, v = place(10.0**k, 10.0**y0).split(",")
        out.append(f'<path d="M{u} {v}V{top + 20}" stroke="#dddddd"/>')
        out.append(f'<text x="{u}" y="{float(v) + 14:.1f}" text-anchor="middle">{_power(k)}</text>')
    for k in range(y0, y1 + 1):
        u, v = place(10.0**x0, 10.0**k).split(",")
        out.append(f'<path d="M{u} {v}H{left + 42 + across:.1f}" stroke="#dddddd"/>')
        out.append(f'<text x="{float(u) - 4:.1f}" y="{float(v) + 3:.1f}" text-anchor="end">{_power(k)}</text>')
    foot = top + 20 + up + 27
    out.append(f'<text x="{left + 42 + across / 2:.0f}" y="{foot:.0f}" text-anchor="middle">{escape(figure.x)}</text>')
    middle = top + 20 + up / 2
    out.append(
        f'<text transform="translate({left + 9} {middle:.0f}) rotate(-90)" text-anchor="middle">{escape(figure.y)}</text>'
    )
    for line in sorted(figure.lines, key=lambda line: line.bold):
        colour, dash = styles[line.name]
        path = " ".join(place(*point) for point in sorted(line.points))
        wide = 2.6 if line.bold else 1.2
        out.append(
            f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="{wide}" stroke-dasharray="{dash}"/>'
        )
        for point in line.points:
            u, v = place(*point).split(",")
            out.append(f'<circle cx="{u}" cy="{v}" r="{2.4 if line.bold else 1.6}" fill="{colour}"/>')
    return "\n".join(out)


def svg(figures: Sequence[Plot], columns: int = 3, width: float = 300.0, height: float = 250.0) -> str:
    """Some plots side by side with one legend, as an SVG picture that needs nothing else."""
    styles = style([line.name for figure in figures for line in figure.lines])
    rows = math.ceil(len(figures) / columns)
    columns = min(columns, len(figures))
    per_row = max(1, int(columns * width // 165))
    legend = 18 * math.ceil(len(styles) / per_row) + 8
    total = (columns * width, rows * height + legend)
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {total[0]:.0f} {total[1]:.0f}" '
        'font-family="system-ui, sans-serif" font-size="10" fill="#222222">',
        f'<rect width="{total[0]:.0f}" height="{total[1]:.0f}" fill="#ffffff"/>',
    ]
    for i, figure in enumerate(figures):
        out.append(panel(figure, (i % columns) * width, (i // columns) * height, width, height, styles))
    for i, (name, (colour, dash)) in enumerate(styles.items()):
        x, y = 42 + (i % per_row) * 165, rows * height + 12 + 18 * (i // per_row)
        out.append(f'<path d="M{x} {y - 3}h22" stroke="{colour}" stroke-width="2" stroke-dasharray="{dash}"/>')
        out.append(f'<text x="{x + 27}" y="{y}">{escape(name)}</text>')
    return "\n".join([*out, "</svg>\n"])
