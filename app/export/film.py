"""A film of a sweep: the figure while one slider moves there and back, as an animated GIF or WebP.

Each picture is the figure for print, drawn by Typst as a PNG is; Pillow, which Bokeh needs anyhow, puts them together.
"""

from __future__ import annotations

import io
from collections.abc import Callable, Sequence

from PIL import Image

from .figure import Style, figure
from .live import Slider
from .printing import png
from .view import View

KINDS = {".gif": "GIF", ".webp": "WEBP"}
#: Positions of the slider; milliseconds that each is seen; at the ends it rests so many times longer.
POSITIONS, MOST_POSITIONS, PACE, REST = 41, 121, 60, 8
#: Width of the picture in mm, and dots to those of the screen: 567 px.
STYLE = Style(size=120.0, legend=False, title=True)
DENSITY = 1.25
COLOURS, MOST = 128, 24_000_000  # of a GIF's picture; bytes of a film


def film(
    view: View,
    slider: str,
    kind: str = ".gif",
    style: Style = STYLE,
    positions: int = POSITIONS,
    progress: Callable[[int, int], None] | None = None,
) -> bytes:
    """Return the film: from the low end of the slider to the high one and back, without end.

    Parameters
    ----------
    view : View
    slider : str
        ``NAME`` or ``NAME=LOW,HIGH``.
    kind : {".gif", ".webp"}
    style : Style
    positions : int
        Of the slider, 2 to 121: pictures that are drawn.
    progress : callable, optional
        Called with (pictures drawn, all of them).

    Raises
    ------
    ValueError
        The slider is none, a picture cannot be had, Typst is missing, or the film is too large.
    """
    if kind not in KINDS:
        raise ValueError(f"a film ends in {kind[:20]!r}; give one of {', '.join(KINDS)}.")
    if not 2 <= positions <= MOST_POSITIONS:
        raise ValueError(f"{positions} positions given; allowed is 2 to {MOST_POSITIONS}.")
    drawn: list[bytes] = []
    for i in range(positions):
        drawn += pictures(view, slider, style, positions, i, i + 1)
        if progress is not None:
            progress(i + 1, positions)
    return joined(drawn, kind)


def pictures(view: View, slider: str, style: Style, positions: int, first: int, last: int) -> list[bytes]:
    """Return the pictures of a film from one position on and up to another, as PNG: a film can be drawn in parts."""
    chosen = Slider.of(view, slider)
    places = chosen.values(positions, view.number(chosen.name))
    return [picture(view, slider, value, style) for value in places[first:last]]


def picture(view: View, slider: str, value: float, style: Style = STYLE) -> bytes:
    """Return the figure with the slider at a value, which its title tells, as PNG."""
    chosen = Slider.of(view, slider)
    heading = f"{chosen.symbol} = {value:.2f}".replace("-", "−")
    try:
        drawn = figure(view.changed({chosen.name: value}), style, heading)
    except (ValueError, ArithmeticError) as error:
        raise ValueError(f"There is no picture at {heading}: {error}") from error
    return png(drawn, DENSITY)


def joined(pictures: Sequence[bytes], kind: str = ".gif") -> bytes:
    """Return pictures of one size as a film, there and back.

    Raises
    ------
    ValueError
        It is too large.
    """
    shown = [Image.open(io.BytesIO(one)).convert("RGB") for one in pictures]
    if kind == ".gif":  # by what they cover of all colours: a small mark keeps its own, which the median cut mixes
        shown = [one.quantize(COLOURS, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE) for one in shown]
    order = [*range(len(shown)), *range(len(shown) - 2, 0, -1)]
    durations = [PACE * (REST if i in (0, len(shown) - 1) else 1) for i in order]
    film = io.BytesIO()
    first, *others = (shown[i] for i in order)
    first.save(film, KINDS[kind], save_all=True, append_images=others, duration=durations, loop=0)
    if film.tell() > MOST:
        raise ValueError(f"The film would hold {film.tell() / 1e6:.0f} MB; show fewer layers, or fewer positions.")
    return film.getvalue()
