"""The strip of small portraits below the picture: what else there is to see, each with a few words to enter by."""

from __future__ import annotations

from functools import lru_cache

from codim2_core.figures.presets import presets
from codim2_core.orbits.trajectories import is_warm

from .thumbnails import thumbnail

#: Presets of the strip, and what is said of each.
HOOKS = {
    "case1-cm4": "Everything sticks",
    "case1-cm0": "Spirals in, forever turning",
    "case2-saddle": "A saddle: sticks only by luck",
    "case3-n3": "It neither rests nor leaves",
    "transcritical-after": "Pushed too hard: it slips",
    "ball-stick": "A ball in a pool of water",
    "nonunique-sliding": "Two answers at once",
    "spinning-disc": "A spinning disc",
}
FIRST_PRESET = "case1-cm4"  # the one whose portrait the page opens with
STRIP_SEEDS = 14  # starting points of a small portrait of the strip


def gallery() -> list[dict[str, str]]:
    """Return key, title, hook and drawing of each; the drawing is empty until its kernels are compiled."""
    return [
        {"key": key, "title": presets[key].title, "hook": hook, "drawn": _draw_thumbnail(key)}
        for key, hook in HOOKS.items()
    ]


def _draw_thumbnail(key: str) -> str:
    preset = presets[key]
    return _small(key) if is_warm(preset.psi, preset.system) else ""


@lru_cache(maxsize=len(HOOKS))
def _small(key: str) -> str:
    preset = presets[key]
    return thumbnail(preset.system, preset.psi, preset.z, STRIP_SEEDS)


def draw_all() -> None:
    """Draw all small portraits, compiling what they need."""
    for key in HOOKS:
        _small(key)
