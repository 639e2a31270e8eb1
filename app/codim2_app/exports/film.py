"""A film of a sweep, or of play: the figure while one slider moves there and back, as GIF, WebP or MP4.

Each picture is the figure for print, drawn by Typst as a PNG is; Pillow, which Bokeh needs anyhow, puts them together.
"""

from __future__ import annotations

import io
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from .figure import Style, figure
from .live import Slider
from .play import PICTURES, PLAY
from .play import pictures as played
from .printing import png
from .view import View

if TYPE_CHECKING:
    from PIL import Image

FILM_KINDS = {".gif": "GIF", ".webp": "WEBP", ".mp4": "MP4"}
#: Positions of the slider; milliseconds that each is seen; at the ends it rests so many times longer.
POSITIONS, MOST_POSITIONS, PACE, REST = 41, 121, 60, 8
#: Width of the picture in mm, and dots to those of the screen: 567 px.
STYLE = Style(size=120.0, legend=False, title=True)
DENSITY = 1.25
COLOURS, MAX_FILM_BYTES = 256, 24_000_000  # of a GIF's picture; bytes of a film


def film(
    view: View,
    slider: str,
    kind: str = ".gif",
    style: Style = STYLE,
    positions: int = 0,
    progress: Callable[[int, int], None] | None = None,
) -> bytes:
    """Return the film: from the low end of the slider to the high one and back, without end.

    Parameters
    ----------
    view : View
    slider : str
        ``NAME`` or ``NAME=LOW,HIGH``, or `play.PLAY`: then the chosen launched orbit is run along.
    kind : {".gif", ".webp", ".mp4"}
    style : Style
    positions : int
        Pictures that are drawn, 2 to 121; 0 for as many as `count_of` says.
    progress : callable, optional
        Called with (pictures drawn, all of them).

    Raises
    ------
    ValueError
        The slider is none, a picture cannot be had, Typst is missing, or the film is too large.
    """
    if kind not in FILM_KINDS:
        raise ValueError(f"a film ends in {kind[:20]!r}; give one of {', '.join(FILM_KINDS)}.")
    positions = positions or count_of(slider)
    if not 2 <= positions <= MOST_POSITIONS:
        raise ValueError(f"{positions} positions given; allowed is 2 to {MOST_POSITIONS}.")
    drawn: list[bytes] = []
    while len(drawn) < positions:
        drawn += pictures(view, slider, style, positions, len(drawn), min(len(drawn) + part_of(slider), positions))
        if progress is not None:
            progress(len(drawn), positions)
    return encode_film(drawn, kind, play=slider == PLAY)


def count_of(slider: str) -> int:
    """Return of how many pictures a film is."""
    return PICTURES if slider == PLAY else POSITIONS


def part_of(slider: str) -> int:
    """Return how many pictures are drawn in one turn: those of play are cheap, once the background is drawn."""
    return 26 if slider == PLAY else 1


def pictures(view: View, slider: str, style: Style, positions: int, first: int, last: int) -> list[bytes]:
    """Return the pictures of a film from one position on and up to another, as PNG: a film can be drawn in parts."""
    if slider == PLAY:
        return played(view, style, positions, first, last)
    chosen = Slider.from_text(view, slider)
    places = chosen.values(positions, view.number(chosen.name))
    return [picture(view, slider, value, style) for value in places[first:last]]


def picture(view: View, slider: str, value: float, style: Style = STYLE) -> bytes:
    """Return the figure with the slider at a value, which its title tells, as PNG."""
    chosen = Slider.from_text(view, slider)
    heading = f"{chosen.symbol} = {value:.2f}".replace("-", "−")
    try:
        drawn = figure(view.with_values({chosen.name: value}), style, heading)
    except (ValueError, ArithmeticError) as error:
        raise ValueError(f"There is no picture at {heading}: {error}") from error
    return png(drawn, DENSITY)


def encode_film(pictures: Sequence[bytes], kind: str = ".gif", play: bool = False) -> bytes:
    """Return pictures of one size as a film without end: there and back, of play there alone.

    The pictures of play have the colours of the first: each then costs in a file what moves in it.

    Raises
    ------
    ValueError
        It is too large.
    """
    from PIL import Image  # late: it is compiled code, which a page without a server does not have

    shown = [Image.open(io.BytesIO(one)).convert("RGB") for one in pictures]
    if kind == ".mp4":
        return _encode_mp4([one for i in _order(len(shown), play) for one in [shown[i]] * _rest(i, len(shown))])
    if kind == ".gif":  # by what they cover of all colours: a small mark keeps its own, which the median cut mixes
        palette = _reduce_palette(shown[0])
        shown = [
            one.quantize(palette=palette, dither=Image.Dither.NONE) if play else _reduce_palette(one) for one in shown
        ]
    order = _order(len(shown), play)
    durations = [PACE * _rest(i, len(shown)) for i in order]
    film = io.BytesIO()
    first, *others = (shown[i] for i in order)
    first.save(film, FILM_KINDS[kind], save_all=True, append_images=others, duration=durations, loop=0)
    if film.tell() > MAX_FILM_BYTES:
        raise ValueError(f"The film would hold {film.tell() / 1e6:.0f} MB; show fewer layers, or fewer positions.")
    return film.getvalue()


def _order(count: int, play: bool) -> list[int]:
    """Return in which order pictures are seen: there and back, of play there alone."""
    return [*range(count), *(() if play else range(count - 2, 0, -1))]


def _rest(i: int, count: int) -> int:
    """Return how many times `PACE` a picture is seen."""
    return REST if i in (0, count - 1) else 1


def _encode_mp4(shown: Sequence[Image.Image]) -> bytes:
    """Return pictures as an MP4 film that every player reads: H.264, of an even number of pixels."""
    program = shutil.which("ffmpeg")
    if program is None:
        raise ValueError("ffmpeg, which makes MP4, is not on the path; install it, or give a name in .gif or .webp.")
    wide, tall = shown[0].size
    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder, "film.mp4")
        run = subprocess.run(
            [program, "-v", "error", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{wide}x{tall}",
             "-r", f"{1000 / PACE:.6g}", "-i", "-", "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-c:v", "libx264",
             "-pix_fmt", "yuv420p", "-movflags", "+faststart", str(made)],
            input=b"".join(one.tobytes() for one in shown), capture_output=True, check=False,
        )  # fmt: skip
        if run.returncode:
            raise ValueError(f"ffmpeg made no film: {run.stderr.decode(errors='replace').strip()[-200:]}")
        return made.read_bytes()


def _reduce_palette(shown: Image.Image) -> Image.Image:
    from PIL import Image

    return shown.quantize(COLOURS, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
