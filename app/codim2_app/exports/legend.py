"""The legend of a figure: what each line, mark and area is, of all that is drawn and of nothing else."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from codim2_core.results.words import written_label

from ..picture.draw.layers import Part, layers_in_paint_order
from ..picture.draw.vector import parts as vector
from ..picture.draw.vector.parts import Placement
from ..picture.slow_layers.outcomes import WORDS as OUTCOMES

#: What a part of a layer is, where it is not the whole layer.
LEGEND_PARTS: Mapping[str, str] = {
    "lines_inside": "U₁ = 0, U₂ = 0 inside",
    "lines_outside": "U₁ = 0, U₂ = 0 outside",
    "separatrices_stable": "Stable separatrices",
    "separatrices_unstable": "Unstable separatrices",
}
#: The sense of the slow flow, by its mark.
SENSES: Mapping[str, str] = {"⊙": "z′ > 0: out of the page", "⊗": "z′ < 0: into the page"}


@dataclass(frozen=True)
class Entry:
    """One line of the legend."""

    words: str
    part: Part | None = None  # a line of this look
    mark: tuple[Mapping[str, Any], int] | None = None  # the mark i of some columns
    area: str = ""  # a patch of this colour
    sign: str = ""  # a letter

    def draw(self, place: Placement, x: float, y: float, width: float) -> str:
        """Return its sample, `width` wide, with its middle height at y."""
        if self.part is not None:
            dashes = self.part.dash or place.dashes.get(self.part.colour, ())
            line = vector.stroke(self.part.colour, self.part.width, dashes, place)
            return f'<path d="M{x:.1f} {y:.1f}H{x + width:.1f}" {line}/>'
        if self.mark is not None:
            columns, i = self.mark
            return vector.mark(columns, i, round(x + width / 2, 1), round(y, 1), place.unit, 2.1 * place.unit)
        if self.area:
            box = f'x="{x:.1f}" y="{y - 3:.1f}" width="{width:.1f}" height="6"'
            faint = ' fill-opacity=".3"' if self.area.startswith("basin") else ""
            return f'<rect {box} fill="var(--{self.area})"{faint} {vector.stroke("line", 0.6, (), place)}/>'
        return vector.words(x + width / 2, y + 0.34 * place.text, self.sign, place.text, "middle", bold=True)


def entries(header: Mapping[str, Any], blocks: Mapping[str, Any], layers: Collection[str]) -> list[Entry]:
    """Return the entries for what one frame shows, lines first."""
    found = [
        entry for layer in layers_in_paint_order() if layer.name in layers for entry in _line_entries(layer, blocks)
    ]
    for name in ("equator", "critical"):
        if name in layers and header.get(name):
            found += _marks(header[name], "Q" if name == "equator" else "C")
    if "critical" in layers and header.get("critical"):
        found += [Entry(SENSES[sign], sign=sign) for sign in SENSES if sign in header["critical"]["sense"]]
    if "outcomes" in layers and header.get("outcomes"):
        kinds = dict.fromkeys(header["outcomes"]["kind"])
        found += [Entry(f"From there: {OUTCOMES[kind]}", area=kind) for kind in kinds]
    if "basins" in layers and header.get("basins"):
        found += _basin_entries(header["basins"])
    return found


def _line_entries(layer: Any, blocks: Mapping[str, Any]) -> Iterator[Entry]:
    listed = set()
    for part in layer.parts:
        words = LEGEND_PARTS.get(part.name, layer.words)
        if len(blocks.get(f"{part.name}.xy", ())) and words not in listed:
            listed.add(words)
            yield Entry(words, part=part)


def _marks(columns: Mapping[str, Any], letter: str) -> Iterator[Entry]:
    kinds = columns["type" if letter == "Q" else "kind"]
    for kind in dict.fromkeys(kinds):
        yield Entry(f"{letter}: {kind}", mark=(columns, kinds.index(kind)))


def _basin_entries(found: Mapping[str, Any]) -> Iterator[Entry]:
    colours = found["colours"][2:]  # the first two are of what is outside the disc, and of what is undecided
    for colour in dict.fromkeys(colours):
        names = [written_label(name) for name, its in zip(found["destinations"], colours, strict=True) if its == colour]
        yield Entry(f"Basin of {', '.join(names)}", area=colour)
