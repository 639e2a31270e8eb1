"""A figure for print: the picture as SVG with a legend, and, where requested, ticks, a title and a caption.

The picture itself is `draw.svg.content`, which draws the page's first picture too. Lengths are points (1/72 inch).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from html import escape

import segno

from ..picture.draw.packing import unpack
from ..picture.draw.still import fill_colours
from ..picture.draw.svg import content
from ..picture.draw.theme import themes
from ..picture.draw.vector import parts as vector
from ..picture.draw.vector.labels import width_of
from ..picture.draw.vector.paper import DASHES, paper
from ..picture.draw.vector.parts import Placement
from .describe import caption_of
from .legend import Entry, entries
from .view import View

THEMES = ("light", "dark", "paper")
#: What the programs that make PNG and PDF of it bring along; the others are what a reader may have.
FONTS = "Libertinus Serif, Linux Libertine O, STIX Two Text, Times New Roman, Liberation Serif, Nimbus Roman, serif"
#: Points to a millimetre; to a px of the screen, for widths of lines and sizes of marks.
MM, PX = 72 / 25.4, 0.55
LABEL_SIZE, SMALL_SIZE = 11.0, 8.0
#: Height of a title.
TITLE = 22.0
#: The sample of a legend's entry, what is between it and the words, between columns, and between lines.
SAMPLE, GAP, GUTTER, LINE = 22.0, 5.0, 12.0, 12.0
#: Between ticks: about so many on an axis.
TICKS = 6
#: Labels stand outside the ring of outcomes.
CLIP_FACTOR = 1.6
MIN_WIDTH_MM, MAX_WIDTH_MM = 40.0, 400.0  # mm
CODE = 64.0  # of a QR code


@dataclass(frozen=True)
class Style:
    """The look of a figure: size, theme, letters, and what is written next to it."""

    size: float = 120.0  # width of the picture in mm, 40 to 400
    theme: str = "light"  # "paper" is black and white
    legend: bool = True  # whether it has a legend
    labels: bool = True
    ticks: bool = False
    title: bool = False
    caption: bool = False
    link: str = ""  # an address, as a QR code next to the caption

    def __post_init__(self) -> None:
        if not MIN_WIDTH_MM <= self.size <= MAX_WIDTH_MM:
            raise ValueError(
                f"size is {self.size:g}; give the width of the picture in mm, {MIN_WIDTH_MM:g} to {MAX_WIDTH_MM:g}."
            )
        if self.theme not in THEMES:
            raise ValueError(f"theme is {self.theme!r}; choose one of {', '.join(THEMES)}.")


def figure(view: View, style: Style | None = None, heading: str = "") -> str:
    """Return a view as an SVG file that needs nothing else, 50 to 300 kB.

    Parameters
    ----------
    view : View
    style : Style, optional
    heading : str
        Of the title, before the portrait's name; by default the title is that of the figure.
    """
    style = style or Style()
    buffer, layers = view.frame(), view.values["layers"]
    header, blocks = unpack(buffer)
    side = style.size * MM
    place = Placement(view.seen, side, PX, LABEL_SIZE, 2, DASHES if style.theme == "paper" else {}, CLIP_FACTOR)
    left, right = (30.0, 8.0) if style.ticks else (0.0, 0.0)
    parts: list[str] = []
    y = 0.0
    if style.title:
        name = header["portrait"]["name"]
        own = view.title if view.values["preset"] else f"{view.title}: {name}"
        title = f"{heading}: {name}" if heading else own
        parts.append(vector.words(left + side / 2, 14.0, escape(title), 12.0, "middle", bold=True))
        y = TITLE
    drawn = content(buffer, layers, place, style.labels)
    frame = f'x="0" y="0" width="{side:.2f}" height="{place.height:.2f}"'
    parts.append(
        f'<clipPath id="picture"><rect {frame}/></clipPath><g transform="translate({left:g} {y:g})">'
        f'<g clip-path="url(#picture)">{_clear(drawn)}</g>{"".join(_ticks(place)) if style.ticks else ""}</g>'
    )
    y += place.height + (30.0 if style.ticks else 0.0)
    width = left + side + right
    if style.legend:
        columns = _legend_columns(entries(header, blocks, layers), side)
        parts += _legend(columns, place, left, y + 6.0, side)
        y += 6.0 + LINE * max((len(column) for _, column in columns), default=0) + 4.0
    if style.caption:
        room = side - (CODE + GUTTER if style.link else 0.0)
        lines = list(_wrap_text(caption_of(view, header), room))
        parts += [
            vector.words(left, y + LINE * (i + 1), escape(line), SMALL_SIZE, room=room) for i, line in enumerate(lines)
        ]
        if style.link:
            parts.append(_code(style.link, left + side - CODE, y + 4.0))
        y += max(LINE * len(lines), CODE if style.link else 0.0) + 8.0
    whole = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.2f}pt" height="{y:.2f}pt" '
        f'viewBox="0 0 {width:.2f} {y:.2f}" fill="none" stroke-linejoin="round" stroke-linecap="butt" '
        f'font-family="{FONTS}"><title>{escape(caption_of(view, header))}</title>'
        f'<rect width="{width:.2f}" height="{y:.2f}" fill="var(--page)"/>{"".join(parts)}</svg>\n'
    )
    return fill_colours(whole, paper() if style.theme == "paper" else themes()[style.theme])


def _wrap_text(text: str, width: float) -> Iterator[str]:
    """Return a text in lines that are not wider."""
    line = ""
    for word in text.split():
        longer = f"{line} {word}".lstrip()
        if line and width_of(longer, SMALL_SIZE) > width:
            yield line
            longer = word
        line = longer
    yield line


def _code(link: str, x: float, y: float) -> str:
    """Return an address as a QR code, dark on white in any theme."""
    rows = [bytes(row) for row in segno.make_qr(link, error="l", boost_error=False).matrix]
    size = CODE / (len(rows) + 4)  # with a margin of two squares
    squares = "".join(f"M{j + 2} {i + 2}h1v1h-1z" for i, row in enumerate(rows) for j, dark in enumerate(row) if dark)
    return (
        f'<g transform="translate({x:.2f} {y:.2f}) scale({size:.4f})"><rect width="{len(rows) + 4}" '
        f'height="{len(rows) + 4}" fill="#fff"/><path d="{squares}" fill="#000"/></g>'
    )


def _clear(drawn: str) -> str:
    """Return a drawing whose labels are clear of the lines behind them."""
    return drawn.replace("<text ", '<text paint-order="stroke" stroke="var(--page)" stroke-width="2.6" ')


def _legend_columns(shown: list[Entry], side: float) -> list[tuple[float, list[Entry]]]:
    """Return the columns of the legend, as many as there is room for: where each begins, and its entries."""
    lines = sum(entry.part is not None for entry in shown)
    found: list[tuple[float, list[Entry]]] = []
    for rows in (math.ceil(len(shown) / 3), math.ceil(len(shown) / 2), max(lines, len(shown) - lines), len(shown)):
        cut = lines if rows == max(lines, len(shown) - lines) else rows  # lines next to marks, whose words are longer
        found, x = [], 2.0
        for first, last in [(0, cut), *((k, k + rows) for k in range(cut, len(shown), max(1, rows)))]:
            column = shown[first:last]
            if column:
                found.append((x, column))
                x += SAMPLE + GAP + max(width_of(entry.words, SMALL_SIZE) for entry in column) + GUTTER
        if x - GUTTER <= side:
            break
    return found


def _legend(
    columns: list[tuple[float, list[Entry]]], place: Placement, left: float, y: float, side: float
) -> Iterator[str]:
    for k, (x, column) in enumerate(columns):
        end = columns[k + 1][0] - GUTTER if k + 1 < len(columns) else side
        begin = x + SAMPLE + GAP
        tight = any(vector.MAX_LABEL_SCALE * width_of(entry.words, SMALL_SIZE) > end - begin for entry in column)
        for i, entry in enumerate(column):
            middle = y + LINE * (i + 0.5)
            yield entry.draw(place, left + x, middle, SAMPLE)
            foot = middle + 0.34 * SMALL_SIZE
            yield vector.words(left + begin, foot, escape(entry.words), SMALL_SIZE, room=0.0 if tight else math.inf)


def _ticks(place: Placement) -> Iterator[str]:
    """Return a frame with ticks, their numbers, and the names of both axes."""
    left, right, bottom, top = place.seen
    line = vector.stroke("soft", 1.2, (), place)
    yield f'<rect width="{place.side:.2f}" height="{place.height:.2f}" {line}/>'
    for value in _round_steps(left, right):
        [[u, _]] = place.points((value, 0.0)).tolist()
        yield f'<path d="M{u} {place.height:.2f}v-4M{u} 0v4" {line}/>'
        yield vector.words(u, place.height + 11.0, _svg_number(value), SMALL_SIZE, "middle")
    for value in _round_steps(bottom, top):
        [[_, v]] = place.points((0.0, value)).tolist()
        yield f'<path d="M0 {v}h4M{place.side:.2f} {v}h-4" {line}/>'
        yield vector.words(-4.0, v + 0.34 * SMALL_SIZE, _svg_number(value), SMALL_SIZE, "end")
    yield vector.words(
        place.side / 2, place.height + 24.0, "x̄ = p₁ inside, (1 + ρ) cos θ outside", SMALL_SIZE, "middle"
    )
    turned = vector.words(0.0, 0.0, "ȳ", SMALL_SIZE, "middle")
    yield f'<g transform="translate(-22 {place.height / 2:.1f})">{turned}</g>'


def _round_steps(low: float, high: float) -> list[float]:
    """Return round values between two, about `TICKS` of them, clear of the corners."""
    rough = (high - low) / TICKS
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(power * k for k in (1, 2, 5, 10) if power * k >= rough)
    margin = 0.02 * (high - low)
    first = math.ceil((low + margin) / step)
    return [k * step for k in range(first, math.floor((high - margin) / step) + 1)]


def _svg_number(value: float) -> str:
    return f"{0.0 if abs(value) < 1e-12 else value:.6g}".replace("-", "−")
