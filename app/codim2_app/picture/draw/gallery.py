"""The strip of small portraits below the picture: what else there is to see, each with a few words to enter by.

They are drawings of fixed numbers, kept as a file: no page waits for the kernels that drew them.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path

from codim2_core.systems.presets.presets import presets

#: One drawing a line, in the order of `HOOKS`; ``python -m tests.pictures --accept`` draws it again.
STRIP = Path(__file__).parents[2] / "static" / "gallery.html"

#: Presets of the strip, and what is said of each.
HOOKS = {
    "case1-cm4": "Everything sticks",
    "case1-cm0": "Spirals in, forever turning",
    "case2-saddle": "A saddle: sticks only by luck",
    "case3-cycle": "It neither rests nor leaves",
    "transcritical-after": "Pushed too hard: it slips",
    "ball-stick": "A ball in a pool of water",
    "nonunique-sliding": "Two answers at once",
    "spinning-disc": "A spinning disc",
}
FIRST_PRESET = "case1-cm4"  # the one whose portrait the page opens with


@cache
def gallery() -> list[dict[str, str]]:
    """Return key, title, hook and drawing of each."""
    drawings = STRIP.read_text(encoding="utf-8").splitlines()
    return [
        {"key": key, "title": presets[key].title, "hook": hook, "drawn": drawn}
        for (key, hook), drawn in zip(HOOKS.items(), drawings, strict=True)
    ]
