"""The shapes of marks as SVG paths about the origin, y downward, at the sizes that Bokeh's markers have."""

from __future__ import annotations

import math

#: Drawn by strokes alone.
OPEN = ("x",)


def shape(name: str, size: float) -> str:
    """Return the outline of a mark.

    Parameters
    ----------
    name : {"circle", "circle_dot", "square", "diamond", "triangle", "hex", "x"}
    size : float
        Its width; a diamond is two thirds as wide as high.
    """
    r = size / 2
    match name:
        case "circle":
            return _circle(r)
        case "circle_dot":
            return _circle(r) + _circle(r / 4)
        case "square":
            return f"M{-r:g} {-r:g}H{r:g}V{r:g}H{-r:g}Z"
        case "diamond":
            return _polygon([(0, -r), (r / 1.5, 0), (0, r), (-r / 1.5, 0)])
        case "triangle":
            return _polygon([(0, -size / math.sqrt(3)), (r, r / math.sqrt(3)), (-r, r / math.sqrt(3))])
        case "hex":
            return _polygon([(r * math.cos(k * math.pi / 3), r * math.sin(k * math.pi / 3)) for k in range(6)])
        case "x":
            return f"M{-r:g} {-r:g}L{r:g} {r:g}M{r:g} {-r:g}L{-r:g} {r:g}"
    raise ValueError(f"there is no mark {name!r}.")


def _circle(r: float) -> str:
    return f"M{r:g} 0A{r:g} {r:g} 0 1 1 {-r:g} 0A{r:g} {r:g} 0 1 1 {r:g} 0Z"


def _polygon(corners: list[tuple[float, float]]) -> str:
    return "M" + "L".join(f"{x:.3g} {y:.3g}" for x, y in corners) + "Z"
