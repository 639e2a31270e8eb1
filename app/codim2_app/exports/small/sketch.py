"""Small pictures of results as numbers, which `svg` and Matplotlib draw alike."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

#: Colours of lines that a chart names, and of basins, by their words in the theme.
COLOURS = ("rho", "theta", "separatrix", "continuation", "node-focus", "soft")
BASIN_COLOURS = ("basin-1", "basin-2", "basin-3", "basin-4")


@dataclass(frozen=True)
class LineChart:
    """Lines over a parameter or time, each (name, x, y): those of one name have one colour."""

    lines: Sequence[tuple[str, Any, Any]]
    across: str
    up: str
    marks: Sequence[tuple[str, float, float]] = ()  # special points


@dataclass(frozen=True)
class RegionChart:
    """Regions of a plane, each (name, polygons): holes are polygons that run the other way."""

    areas: Sequence[tuple[str, Sequence[Any]]]
    spans: Sequence[tuple[float, float]]
    across: str
    up: str


@dataclass(frozen=True)
class Curves:
    """Curves of the picture over the hemisphere, each (colour, points), and places on them."""

    pieces: Sequence[tuple[str, Any]]
    places: Sequence[Any] = ()


@dataclass(frozen=True)
class Cells:
    """Cells of a square of the picture, each the number of a name, or -1 where it is undecided."""

    cells: Any
    box: tuple[float, float, float, float]
    names: Sequence[str]


Sketch = LineChart | RegionChart | Curves | Cells


def region_colour(name: str, known: Any) -> str:
    """Return the word of a region's colour: by its portrait, where there is one for that."""
    colour = f"r-{name.partition(';')[0].partition(',')[0].lower()}"
    return colour if colour in known else "r-other"
