"""Black and white, as the paper's figures are: lines differ by dashes and width, areas by grey and hatch."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from ..theme import themes

INK, DIM, FAINT_INK = "#000000", "#555555", "#8a8a8a"

#: What is not simply black.
GREYS: Mapping[str, str] = MappingProxyType(
    {
        "page": "#ffffff", "shade": "#000000", "shade-lit": "0", "shade-middle": "0.04", "shade-limb": "0.14",
        "outside": DIM, "lines-in": FAINT_INK,
        "lines-out": FAINT_INK, "degenerate": FAINT_INK, "soft": DIM, "line": FAINT_INK,
        "launch-2": DIM, "launch-4": DIM, "launch-6": DIM,
        "slide": "#222222", "cross": "#9a9a9a", "depends": "#666666", "undecided": "#c4c4c4", "misses": "#f0f0f0",
        "basin-1": "#000000", "basin-2": "#777777", "basin-3": "#b0b0b0", "basin-4": "#444444",
    }
)  # fmt: skip
#: Dashes of lines that colour alone tells apart on a screen, in px, by colour.
DASHES: Mapping[str, tuple[float, ...]] = MappingProxyType(
    {
        "rho": (9, 4), "theta": (2, 3), "lines-in": (10, 3, 2, 3), "lines-out": (10, 3, 2, 3, 2, 3),
        "launch-3": (12, 3), "launch-4": (12, 3), "launch-5": (4, 3), "launch-6": (4, 3),
    }
)  # fmt: skip


def paper() -> dict[str, str]:
    """Return the colours of all that is drawn, by name."""
    return dict.fromkeys(themes()["light"], INK) | dict(GREYS)
