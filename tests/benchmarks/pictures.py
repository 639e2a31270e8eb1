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
    """A log-log plot, and the labels of its axes."""

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


def style(lines: Sequence[Line]) -> dict[str, tuple[str, str]]:
    """Colour and dash of each name, ours the first colour; the same in all plots that list the same names."""
    bold = {line.name for line in lines if line.bold}
    others = [name for name in dict.fromkeys(line.name for line in lines) if name not in bold]
    rest = COLOURS[1:]
    styles = {name: (rest[i % len(rest)], DASHES[(i // 5) % len(DASHES)]) for i, name in enumerate(others)}
    return {name: (COLOURS[0], "") for name in bold} | styles


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
    for k in range(x0, x1 + 1, math.ceil((x1 - x0) / 6)):
        u, v = place(10.0**k, 10.0**y0).split(",")
        out.append(f'<path d="M{u} {v}V{top + 20}" stroke="#dddddd"/>')
        out.append(f'<text x="{u}" y="{float(v) + 14:.1f}" text-anchor="middle">{_power(k)}</text>')
    for k in range(y0, y1 + 1, math.ceil((y1 - y0) / 8)):
        u, v = place(10.0**x0, 10.0**k).split(",")
        out.append(f'<path d="M{u} {v}H{left + 42 + across:.1f}" stroke="#dddddd"/>')
        out.append(f'<text x="{float(u) - 4:.1f}" y="{float(v) + 3:.1f}" text-anchor="end">{_power(k)}</text>')
    foot = top + 20 + up + 27
    out.append(f'<text x="{left + 42 + across / 2:.0f}" y="{foot:.0f}" text-anchor="middle">{escape(figure.x)}</text>')
    middle = top + 20 + up / 2
    turned = f'transform="translate({left + 9} {middle:.0f}) rotate(-90)"'
    out.append(f'<text {turned} text-anchor="middle">{escape(figure.y)}</text>')
    for line in sorted(figure.lines, key=lambda line: line.bold):
        colour, dash = styles[line.name]
        path = " ".join(place(*point) for point in line.points)
        wide = 2.6 if line.bold else 1.2
        out.append(
            f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="{wide}" stroke-dasharray="{dash}"/>'
        )
        for point in line.points:
            u, v = place(*point).split(",")
            out.append(f'<circle cx="{u}" cy="{v}" r="{2.4 if line.bold else 1.6}" fill="{colour}"/>')
    return "\n".join(out)


def _legend(entries: Sequence[tuple[str, tuple[str, str]]], left: float, top: float, columns: int, width: float) -> str:
    out = []
    for i, (name, (colour, dash)) in enumerate(entries):
        x, y = left + 42 + (i % columns) * width, top + 12 + 15 * (i // columns)
        out.append(f'<path d="M{x:.0f} {y - 3:.0f}h20" stroke="{colour}" stroke-width="2" stroke-dasharray="{dash}"/>')
        out.append(f'<text x="{x + 24:.0f}" y="{y:.0f}">{escape(name)}</text>')
    return "\n".join(out)


def svg(figures: Sequence[Plot], columns: int = 3, width: float = 300.0, height: float = 250.0) -> str:
    """Some plots side by side as an SVG picture that needs nothing else; one legend if all show the same curves."""
    columns = min(columns, len(figures))
    rows = math.ceil(len(figures) / columns)
    names = [{line.name for line in figure.lines} for figure in figures]
    shared = all(len(other & names[0]) >= 2 for other in names)
    most = max(map(len, names))
    band = 0 if shared else 15 * most + 8
    styles = style([line for figure in figures for line in figure.lines])
    per_row = max(1, int(columns * width // 165))
    foot = 15 * math.ceil(len(styles) / per_row) + 10 if shared else 0
    across, down = columns * width, rows * (height + band) + foot
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {across:.0f} {down:.0f}" '
        'font-family="system-ui, sans-serif" font-size="10" fill="#222222">',
        f'<rect width="{across:.0f}" height="{down:.0f}" fill="#ffffff"/>',
    ]
    for i, figure in enumerate(figures):
        left, top = (i % columns) * width, (i // columns) * (height + band)
        own = styles if shared else style(figure.lines)
        out.append(panel(figure, left, top, width, height, own))
        if not shared:
            out.append(_legend(list(own.items()), left, top + height, 1, width))
    if shared:
        out.append(_legend(list(styles.items()), 0.0, rows * height, per_row, 165.0))
    return "\n".join([*out, "</svg>\n"])
