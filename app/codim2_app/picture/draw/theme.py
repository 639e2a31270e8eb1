"""Colours of page and picture, light and dark, which become the style sheet's custom properties, and measures."""

from __future__ import annotations

from collections.abc import Mapping

from .layers import LAYERS, TRACE_COLOURS

#: Colours of the page around the layers: light, dark.
PAGE: Mapping[str, tuple[str, str]] = {
    "page": ("#ffffff", "#12161d"),
    "panel": ("#f5f7fa", "#1a202a"),
    "line": ("#dbe1e9", "#2e3745"),
    "ink": ("#1c2430", "#e6eaf0"),
    "soft": ("#5b6675", "#9aa6b6"),
    "accent": ("#0072bd", "#4aa8e8"),
    "bad": ("#b91c1c", "#ff8a80"),
    "warn-bg": ("#fff6e0", "#2e2711"),
    "warn-line": ("#eab308", "#a3811a"),
    # parts of the equation, and their sliders
    "of-A": ("#0b61c4", "#6fb1ff"),
    "of-f": ("#a85800", "#f0a848"),
    "of-z": ("#8a6d00", "#e0c452"),
    # the hemisphere, and how dense it is from where the light falls to its limb
    "shade": ("#3b6ea5", "#7fb2ff"),
    "shade-lit": ("0", "0.3"),
    "shade-middle": ("0.1", "0.15"),
    "shade-limb": ("0.32", "0.06"),
    # curves and regions of the panels
    "hopf": ("#c8102e", "#ff5468"),
    "node-focus": ("#15803d", "#4ade80"),
    "r-cm0": ("#8b5cf6", "#a78bfa"),
    "r-cm2": ("#38a3e0", "#38bdf8"),
    "r-cm4": ("#16a06a", "#34d399"),
    "r-ncm2": ("#b4bfcc", "#94a3b8"),
    "r-ncm4": ("#e8890c", "#fbbf24"),
    "r-more0": ("#d6409f", "#f472b6"),
    "r-more1": ("#0d9488", "#2dd4bf"),
    "r-more2": ("#b45309", "#d9a066"),
    "r-more3": ("#4f46e5", "#818cf8"),
    "r-more4": ("#a3b318", "#d3e35c"),
    "r-more5": ("#dc4a3d", "#f58a7d"),
    "r-other": ("#94a3b8", "#94a3b8"),
    "r-soft": (".2", ".2"),
    "r-here": (".4", ".34"),
}

#: Half the width of the picture: the disc has radius 1.
HALF_VIEW = 1.75
#: Half the width of what is seen at the nearest and at the widest.
NEAREST, MAX_HALF_VIEW = 0.05, 12.0
#: Radius up to which the scene is computed: the corners of the square picture.
PICTURE_REACH = 2.45

#: Where the light falls on the hemisphere, in radii from the centre, and how far from there to the middle shade.
LIGHT, MIDDLE = (-0.36, 0.4), 0.5

#: The ring of approach outcomes: its radii, and the pattern over each colour, so that colour is not all there is.
RING = (1.03, 1.075)
HATCHES = {"slide": "", "cross": "/", "depends": "x", "undecided": ".", "misses": ""}
#: What the page and a live file draw by.
MEASURES = {"light": LIGHT, "middle": MIDDLE, "ring": RING, "hatches": HATCHES, "view": HALF_VIEW}


def themes() -> dict[str, dict[str, str]]:
    """Return the colours of the light and of the dark theme, by name."""
    pairs = {**PAGE, **TRACE_COLOURS}
    for layer in LAYERS.values():
        pairs.update(layer.colours)
    return {theme: {name: pair[i] for name, pair in pairs.items()} for i, theme in enumerate(("light", "dark"))}


def custom_properties() -> str:
    """Return the colours of both themes as rules of the style sheet."""
    return "\n".join(
        f".codim2{'.dark' if theme == 'dark' else ''} {{ "
        + " ".join(f"--{name}: {colour};" for name, colour in colours.items())
        + f" color-scheme: {theme}; }}"
        for theme, colours in themes().items()
    )
