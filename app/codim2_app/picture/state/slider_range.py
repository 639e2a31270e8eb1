"""The ranges of sliders: as a person has set them, and wide enough for their values; the same rule as in ranges.js."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any


def slider_range(low: float, high: float, value: float) -> tuple[float, float, float]:
    """Return (low, high, step) of a slider, widened to hold the value."""
    if value < low or value > high:
        reach = round_up(abs(value))
        if low < 0 or value < 0:
            low, high = min(low, -reach), max(high, reach)
        else:
            low, high = (0.0, high) if value < low else (low, reach)
    return low, high, 10.0 ** (math.floor(math.log10(high - low)) - 3)


def edited_range(values: Mapping[str, Any], name: str, first: tuple[float, float]) -> tuple[float, float]:
    """Return the range that a person has set for a slider, or the one it came with."""
    low, high = values["ranges"].get(name, first)
    return low, high


def round_up(size: float) -> float:
    """Return a round number, at least 1.2 times the size; 0 for 0."""
    if size == 0.0:
        return 0.0
    target = 1.2 * size
    power = 10.0 ** math.floor(math.log10(target))
    return next((float(f"{power * k:.2g}") for k in (1, 1.5, 2, 3, 4, 5, 6, 8) if power * k >= target), 10.0 * power)
