"""Requests of a browser for a file of what it shows: read, bounded, and made."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any

from ..picture.draw.layers import LAYERS
from ..picture.draw.packing import Rectangle
from ..picture.frame.window import Window
from ..picture.slow_layers.proof import proof
from ..picture.slow_layers.slip import slip
from ..picture.state.chosen_system import System_
from .figure import THEMES, Style, figure
from .files import DATA
from .film import STYLE, film
from .live import MOST_SLIDERS, live
from .printing import pdf
from .tex.picture import tikz
from .view import WHOLE, View

#: Bytes of a file; what holds more goes by the command line.
MAX_FILE_BYTES = 24_000_000
TOO_LARGE = "The file would hold {} MB; show fewer layers, or fewer starting points."
TYPES: Mapping[str, str] = MappingProxyType(
    {
        "svg": "image/svg+xml", "pdf": "application/pdf", "zip": "application/zip", "json": "application/json",
        "npz": "application/octet-stream", "py": "text/x-python", "tex": "text/x-tex", "tikz": "text/x-tex",
        "html": "text/html", "gif": "image/gif", "proof": "application/json", "motion": "application/json",
    }
)  # fmt: skip
MAX_SLIDER_CHARACTERS, LONGEST_LINK = 200, 2000  # characters of a slider, bytes of an address that a phone can read
PROOF = "proof"
#: What the page itself shows, and is computed while files are taken.
SHOWN = (PROOF, "motion")


@dataclass(frozen=True)
class ExportRequest:
    """One request for a file."""

    kind: str  # how the file's name ends: a key of `TYPES`
    style: Style = field(default_factory=Style)  # of a figure
    sliders: tuple[str, ...] = ()  # of a live file; the first of a film
    start: str = ""  # of a motion: a place of the picture

    @property
    def job(self) -> str:
        """Return the name of the job; of each name a browser has one at a time, and a newer one replaces an older."""
        return self.kind if self.kind in SHOWN else "take"

    @property
    def slider(self) -> str:
        """The one of a film."""
        return self.sliders[0] if self.sliders else ""

    @property
    def moving(self) -> Style:
        """Return the style of a film."""
        return replace(STYLE, theme=self.style.theme)

    @classmethod
    def read(cls, request: Any) -> ExportRequest:
        """Return the wish of a request.

        Raises
        ------
        ValueError
            It is none.
        """
        if not isinstance(request, Mapping) or str(request.get("kind")) not in TYPES:
            raise ValueError(f"There is no such file to take; the kinds are {', '.join(TYPES)}.")
        theme, sliders = request.get("theme", "light"), request.get("sliders", ())
        if theme not in THEMES or not isinstance(sliders, (list, tuple)) or len(sliders) > MOST_SLIDERS:
            raise ValueError(f"Give a theme ({', '.join(THEMES)}) and at most {MOST_SLIDERS} sliders.")
        if not all(isinstance(one, str) and len(one) <= MAX_SLIDER_CHARACTERS for one in sliders):
            raise ValueError("Give sliders as NAME or NAME=LOW,HIGH.")
        link = request.get("link", "")
        if not isinstance(link, str) or len(link.encode()) > LONGEST_LINK:
            raise ValueError(f"Give an address of at most {LONGEST_LINK} bytes.")
        legend, poster = bool(request.get("legend", True)), bool(link)
        style = Style(theme=theme, legend=legend, title=poster, caption=poster, link=link)
        return cls(str(request["kind"]), style, tuple(sliders), str(request.get("start", "")))


def seen_by(request: Any, values: Mapping[str, Any], system: System_ | None) -> View:
    """Return the view of a browser: the values that are drawn, the layers and the rectangle that it shows."""
    asked = request if isinstance(request, Mapping) else {}
    window = Window.read(asked.get("window"))
    seen: Rectangle = WHOLE if window is None else window.rectangle
    layers = asked.get("layers")
    if isinstance(layers, (list, tuple)):  # a question of a lesson may hide some
        shown = [name for name in LAYERS if name in layers]
        values = {**values, "layers": [name for name in values["layers"] if name in shown]}
    return View(dict(values), seen, system)


def make_file(view: View, wish: ExportRequest) -> tuple[str, bytes]:
    """Return the file's name and what it holds.

    Raises
    ------
    ValueError
        It cannot be had, or is too large.
    """
    make: Callable[[View], bytes] = {
        "svg": lambda one: figure(one, wish.style).encode(),
        "pdf": lambda one: pdf(figure(one, wish.style)),
        "tikz": lambda one: tikz(figure(one, wish.style)).encode(),
        "html": lambda one: live(one, wish.sliders),
        "gif": lambda one: film(one, wish.slider, style=wish.moving),
        "proof": lambda one: proof(one.scene()),
        "motion": lambda one: slip(one.scene(), wish.start),
    }.get(wish.kind) or DATA[f".{wish.kind}"]
    made = make(view)
    if len(made) > MAX_FILE_BYTES:
        raise ValueError(TOO_LARGE.format(round(len(made) / 1e6)))
    return file_name(view, wish), made


def file_name(view: View, wish: ExportRequest) -> str:
    """Return the name of a file: letters, figures and dashes, which no system and no command line minds."""
    name = view.values["preset"] or view.scene()["name"].name.lower()
    moves = wish.slider.partition("=")[0] if wish.kind == "gif" else ""  # two films of one portrait are two files
    words = re.findall("[a-z0-9]+", f"{name} {moves}".lower())
    return f"codim2-{'-'.join(words) or 'view'}.{wish.kind}"
