"""A film of play: the dot of a launched orbit runs along it, the portrait next to x and y over time.

The portrait and the chart are drawn once, by Typst; the dots are put on by Pillow.
"""

from __future__ import annotations

import io
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from codim2_core.portrait.orbits.in_time import InTime, in_time

from ..picture.draw.theme import themes
from ..picture.draw.vector.paper import paper
from ..picture.draw.vector.parts import Placement
from ..picture.phrases import say
from ..picture.state.launches import TYPED, read_launches, selected_place
from .figure import MM, PX, TITLE, Style, figure
from .printing import DPI, png
from .small.chart import Frame, line_chart
from .small.sketch import LineChart
from .view import View

if TYPE_CHECKING:
    from PIL import Image

#: What stands in the place of a slider's name.
PLAY = "play"
#: Pictures of a film; dots to those of the screen; radius of a dot, of its rim, in px; so finer it is drawn and shrunk.
PICTURES, DENSITY, DOT, RIM, FINER = 101, 1.25, 6.0, 2.0, 4
#: Points of an SVG to px of the film; the chart's own px to those of the film.
SCALE, CHART = DPI * DENSITY / 72, 1.15


@dataclass(frozen=True)
class Scenery:
    """The parts of a film that do not move."""

    drawn: Image.Image
    orbit: InTime
    place: Placement  # of the portrait in it, in points, from its upper edge
    chart: Frame  # of x and y over time
    corner: tuple[float, float]  # of the chart, in px
    colours: tuple[str, str]  # of a dot and of its rim

    def picture_at(self, share: float) -> bytes:
        """Return the picture at a share of the orbit's time, 0 to 1, as PNG."""
        time, points = self.orbit.time, self.orbit.points
        now = time[0] + share * (time[-1] - time[0])
        x, y = (float(np.interp(now, time, column)) for column in points.T)
        left, right, bottom, top = self.place.seen
        dots = []
        if left <= x <= right and bottom <= y <= top:
            [[u, v]] = self.place.points((x, y)).tolist()
            dots = [(SCALE * u, SCALE * (v + TITLE))]
        for values in self.orbit.xy.T:
            x, y = self.chart.place(now, np.interp(now, time, values))
            dots.append((self.corner[0] + CHART * x, self.corner[1] + CHART * y))
        shown = self.drawn.copy()
        for dot in dots:
            _put_dot(shown, dot, self.colours)
        file = io.BytesIO()
        shown.save(file, "PNG", compress_level=1)
        return file.getvalue()


def pictures(view: View, style: Style, positions: int, first: int, last: int) -> list[bytes]:
    """Return the pictures of a film of play from one on and up to another, as PNG.

    Raises
    ------
    ValueError
        No launched orbit is chosen, or no time passes on it; a picture cannot be had.
    """
    still = scenery(view, style)
    return [still.picture_at(k / (positions - 1)) for k in range(first, last)]


def scenery(view: View, style: Style) -> Scenery:
    """Return the background of the film of a view."""
    from PIL import Image  # late, as in film.py

    i = selected_place(read_launches(view.values["orbits"]), view.values["orbit"])
    if i is None or i == TYPED:
        raise ValueError(say("nothing to play"))
    scene = view.scene()
    seed, clock = scene.launch[i], scene["launched"].orbits.times[i]
    if np.hypot(*seed) == 1.0:
        raise ValueError(say("no time passes"))
    orbit = in_time(scene.coefficients, scene.psi, seed, (float(clock[0]), float(clock[-1])))
    portrait = _open_png(png(figure(view, style), DENSITY))
    names, time = (("x/ε", "y/ε"), "τ = t/ε") if orbit.fast else (("x", "y"), "t")
    lines = [(name, orbit.time, values) for name, values in zip(names, orbit.xy.T, strict=True)]
    colours = paper() if style.theme == "paper" else themes()[style.theme]
    over_time, frame = line_chart(LineChart(lines, time, ""), colours)
    right = _open_png(png(over_time, CHART))
    drawn = Image.new("RGB", (portrait.width + right.width, max(portrait.height, right.height)), colours["page"])
    corner = portrait.width, (drawn.height - right.height) // 2
    drawn.paste(portrait, (0, 0))
    drawn.paste(right, corner)
    place = Placement(view.seen, style.size * MM, PX, decimals=2)
    return Scenery(drawn, orbit, place, frame, corner, (colours["motion"], colours["page"]))


def _open_png(drawn: bytes) -> Image.Image:
    from PIL import Image

    return Image.open(io.BytesIO(drawn)).convert("RGB")


def _put_dot(shown: Image.Image, place: tuple[float, float], colours: tuple[str, str]) -> None:
    """Put a dot on a picture, where it is to parts of a px."""
    from PIL import Image, ImageDraw

    reach = int(DOT + RIM) + 2
    x, y = (round(v) for v in place)
    box = x - reach, y - reach, x + reach, y + reach
    side, fine = 2 * reach, 2 * reach * FINER
    patch = shown.crop(box).resize((fine, fine), Image.Resampling.NEAREST)
    pen = ImageDraw.Draw(patch)
    u, v = (FINER * (reach + value - whole) for value, whole in zip(place, (x, y), strict=True))
    for radius, colour in zip((DOT + RIM, DOT), reversed(colours), strict=True):
        pen.ellipse([u - FINER * radius, v - FINER * radius, u + FINER * radius, v + FINER * radius], fill=colour)
    shown.paste(patch.resize((side, side), Image.Resampling.BOX), box[:2])
