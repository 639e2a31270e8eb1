"""A small drawing in the plane or in space: curves, arrows, dots and words at places of the figure's own axes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from html import escape
from typing import Any

import numpy as np

from ...exports.small.chart import close_svg
from ...picture.draw.vector.parts import Placement, arrows, stroke, words

SIDE = 360.0
#: Half the length of an arrowhead, in px, and how near to each other words of a drawing are set.
HEAD, TEXT = 4.5, 14.0
#: How space is seen, from 25 degrees above and turned by 30: to the right and upwards for each of x, y, z.
SPACE = np.array([[0.87, -0.21], [0.50, 0.37], [0.0, 0.91]])
#: The same with Σ lying, from left to right, as in the paper's sketches of limit vectors.
LYING = np.array([[-0.30, -0.45], [0.20, 0.85], [1.0, -0.12]])


class Drawing:
    """A drawing that grows from back to front.

    Parameters
    ----------
    reach : float
        Half the width of what is seen.
    axes : (k, 2) array
        What a step along each axis is in the drawing.
    """

    def __init__(self, reach: float, axes: Any = None) -> None:
        self.place = Placement((-reach, reach, -reach, reach), SIDE, 1.0, TEXT, 1)
        self.axes = np.eye(2) if axes is None else np.asarray(axes)
        self.parts: list[str] = []

    def points(self, values: Any) -> Any:
        """Return places of the figure's axes as points of the drawing."""
        return self.place.points(np.asarray(values, float).reshape(-1, len(self.axes)) @ self.axes)

    def line(self, values: Any, colour: str = "ink", width: float = 1.4, dashes: Sequence[float] = ()) -> Drawing:
        """Draw a curve."""
        path = self.place.path([self.points(values)])
        self.parts.append(f'<path d="{path}" {stroke(colour, width, dashes, self.place)}/>')
        return self

    def arrow(self, start: Any, end: Any, colour: str = "ink", width: float = 1.6) -> Drawing:
        """Draw an arrow that ends at `end`."""
        ends = self.points([start, end])
        (u, v), (u1, v1) = ends.tolist()
        if math.hypot(u1 - u, v1 - v) > HEAD:
            angle = math.atan2(v - v1, u1 - u)
            tip = ends[1:] - HEAD * np.array([[math.cos(angle), -math.sin(angle)]])
            self.line([start, end], colour, width)
            self.parts.append(arrows(tip, [angle], HEAD, colour, self.place))
        return self

    def dot(self, at: Any, colour: str = "ink", size: float = 4.0) -> Drawing:
        """Draw a dot."""
        [[u, v]] = self.points(at).tolist()
        self.parts.append(f'<circle cx="{u}" cy="{v}" r="{size}" fill="var(--{colour})"/>')
        return self

    def text(self, at: Any, said: str, anchor: str = "start", off: tuple[float, float] = (6.0, -6.0)) -> Drawing:
        """Write a word next to a place."""
        [[u, v]] = self.points(at).tolist()
        self.parts.append(words(u + off[0], v + off[1], escape(said), TEXT, anchor))
        return self

    def ring(self, height: float, colour: str = "soft", width: float = 1.0, dashes: Sequence[float] = ()) -> Drawing:
        """Draw the unit circle at a height."""
        t = np.linspace(0.0, 2.0 * np.pi, 121)
        return self.line(np.column_stack([np.cos(t), np.sin(t), np.full_like(t, height)]), colour, width, dashes)

    def svg(self) -> str:
        """Return the drawing as a file."""
        return close_svg("".join(self.parts), SIDE, SIDE, SIDE, SIDE)
