"""A live file: one HTML that moves a slider or two with no server, its frames computed beforehand.

The frames are those of the wire (`draw.packing`), drawn by the page's own painter (static/live_file.js).
"""

from __future__ import annotations

import base64
import gzip
import json
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any

from codim2_core import __version__

from ..picture.draw.bundle import bundle
from ..picture.draw.layers import layer_table
from ..picture.draw.mathml import plain_symbol
from ..picture.draw.packing import pack
from ..picture.draw.theme import MEASURES, themes
from ..picture.state.animation_pacing import paced_values
from ..picture.state.chosen_system import parameters_of
from ..picture.state.controls import NUMBERS, ExplorerState
from .describe import place_words, psi_words, system_words
from .view import OWN, View

SCRIPTS = Path(__file__).parents[1] / "static"
#: Bytes of a file at most; of what is around the frames.
MAX_BYTES, PAGE_BYTES = 2_000_000, 60_000
#: Positions of one slider, of each of two; at least.
ONE, TWO, FEWEST = 121, 13, 3
#: Positions that are tried next, where so many are too large.
GRID_SHRINKAGE = 0.85
#: How finely frames are sampled, as a share of the picture's width, and where arrowheads are placed.
PRECISION_SHARE = 1 / 700
MOST_SLIDERS = 2


@dataclass(frozen=True)
class Slider:
    """A slider of a live file."""

    name: str  # a control that is a number, or "own:" and a parameter of the system
    low: float
    high: float
    events: tuple[float, ...] = ()  # values between them at which something happens: a film goes slowly there

    @classmethod
    def from_text(cls, view: View, text: str) -> Slider:
        """Return the slider that ``NAME``, ``NAME=LOW,HIGH`` or ``NAME=LOW,HIGH;EVENT,...`` names.

        Its range is by default that of the explorer.

        Raises
        ------
        ValueError
            The system has no such number, or the range is none.
        """
        name, _, span = text.partition("=")
        own = name.removeprefix(OWN)
        values = view.values
        parameters = parameters_of(values["system"], values["texts"]) if view.system is None else {}
        if name not in NUMBERS and own not in parameters:
            known = ", ".join([*NUMBERS[:5], "z", "n", *parameters])
            raise ValueError(f"{name[:40]!r} is no slider of this system; give one such as {known}.")
        low, high = (-4.0, 4.0) if own in parameters and name not in NUMBERS else _softbounds(name)
        events: tuple[float, ...] = ()
        if span:
            span, _, at = span.partition(";")
            try:
                low, high = (float(word) for word in span.split(","))
                events = tuple(float(word) for word in at.split(",") if word)
            except ValueError:
                raise ValueError(f"{text[:60]!r} given; give NAME=LOW,HIGH such as f1=-1,1.") from None
        if not low < high or not abs(low) + abs(high) < 1e9:
            raise ValueError(f"{name} from {low:g} to {high:g}; give a range such as f1=-1,1.")
        return cls(name if name in NUMBERS else OWN + own, low, high, tuple(v for v in events if low < v < high))

    @property
    def symbol(self) -> str:
        """Return the symbol before the slider."""
        if self.name in NUMBERS:
            return str(ExplorerState.param[self.name].label)
        return plain_symbol(self.name.removeprefix(OWN))

    def values(self, count: int, present: float) -> list[float]:
        """Return so many positions: evenly over its range, the present value among them; or slowly near its events."""
        if self.events:
            return paced_values(self.low, self.high, self.events, count)
        step = (self.high - self.low) / (count - 1)
        places = [self.low + step * k for k in range(count)]
        if self.low <= present <= self.high:
            places[round((present - self.low) / step)] = present
        return places


def _softbounds(name: str) -> tuple[float, float]:
    low, high = ExplorerState.param[name].softbounds
    return float(low), float(high)


def live(view: View, sliders: Sequence[str]) -> bytes:
    """Return the file, under 2 MB.

    Parameters
    ----------
    view : View
    sliders : one or two of ``NAME`` or ``NAME=LOW,HIGH``

    Raises
    ------
    ValueError
        A slider is none, there are more than two or none, or no frame can be had.
    """
    if not 1 <= len(sliders) <= MOST_SLIDERS or len({text.partition("=")[0] for text in sliders}) < len(sliders):
        raise ValueError(f"{len(sliders)} sliders given; give one or two different ones, such as f1 and f2.")
    chosen = [Slider.from_text(view, text) for text in sliders]
    count = ONE if len(chosen) == 1 else TWO
    while True:
        places = [slider.values(count, view.number(slider.name)) for slider in chosen]
        budget = (MAX_BYTES - PAGE_BYTES) * 3 // 4
        packed = _pack_frames(view, chosen, places, budget)
        if packed is not None:
            break
        count = int(GRID_SHRINKAGE * count)
        if count < FEWEST:
            raise ValueError("This view is too large for a live file; show fewer layers, or fewer starting points.")
    return _page(view, chosen, places, packed).encode()


def _pack_frames(
    view: View, chosen: Sequence[Slider], places: Sequence[Sequence[float]], budget: int
) -> tuple[list[int], bytes] | None:
    """Return the size of each frame and all of them packed, the first slider slowest; None if they are too large."""
    sizes: list[int] = []
    frames: list[bytes] = []
    every = len(places[0]) if len(chosen) == 1 else len(places[0]) * len(places[1])
    for one in places[0]:
        for other in places[1] if len(chosen) > 1 else (None,):
            changes = {chosen[0].name: one} | ({chosen[1].name: other} if other is not None else {})
            frame = _frame(view.with_values(changes))
            frames.append(frame + b"\0" * (-len(frame) % 4))
            sizes.append(len(frame))
        done = len(frames)
        if len(gzip.compress(b"".join(frames), 6)) * every > 1.1 * budget * done and done >= every // 4:
            return None
    packed = gzip.compress(b"".join(frames), 9, mtime=0)
    return (sizes, packed) if len(packed) <= budget else None


def _frame(view: View) -> bytes:
    """Return one frame; where there is nothing to be drawn, the sentence that says why."""
    try:
        return view.frame(PRECISION_SHARE, whole=True)
    except (ValueError, ArithmeticError) as error:
        return pack({"portrait": {"case": None, "name": "", "sentence": str(error), "degeneracies": []}}, {})


def _page(
    view: View, chosen: Sequence[Slider], places: Sequence[Sequence[float]], packed: tuple[list[int], bytes]
) -> str:
    sizes, frames = packed
    settings: dict[str, Any] = {
        "sliders": [
            {"name": slider.name, "symbol": slider.symbol, "values": values, "at": _nearest_index(values, view, slider)}
            for slider, values in zip(chosen, places, strict=True)
        ],
        "sizes": sizes, "seen": view.seen, "layers": view.values["layers"], "table": layer_table(), "themes": themes(),
        "measures": MEASURES,
    }  # fmt: skip
    data = json.dumps(settings, separators=(",", ":")).replace("<", "\\u003c")
    script = bundle(SCRIPTS / "live_file.js").replace("</script", "<\\/script")
    setting = "; ".join(filter(None, (system_words(view), psi_words(view), place_words(view))))
    at_first = f'<p class="note">At first: {escape(setting)}. Made by codim2 {__version__}.</p>'
    return html_page(
        view.title,
        '<canvas role="img" aria-label="The projected hemisphere: phase portrait">'
        f'</canvas><div class="sliders"></div><p class="sentence" aria-live="polite"></p>{at_first}\n'
        f'<script type="application/json" id="settings">{data}</script>\n'
        f'<script type="text/plain" id="frames">{base64.b64encode(frames).decode()}</script>\n'
        f'<script type="module">{script}</script>',
    )


def html_page(title: str, body: str) -> str:
    """Return a page of its own with a title above."""
    return (
        f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{escape(title)}</title>\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1"><meta name="color-scheme" '
        f'content="light dark">\n<style>{(SCRIPTS / "live_file.css").read_text(encoding="utf-8")}</style></head>\n'
        f"<body><h1>{escape(title)}</h1>{body}</body></html>\n"
    )


def _nearest_index(values: Sequence[float], view: View, slider: Slider) -> int:
    present = view.number(slider.name)
    return min(range(len(values)), key=lambda i: abs(values[i] - present))
