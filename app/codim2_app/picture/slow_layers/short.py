"""Numbers as they are sent: five digits are a tenth of a pixel of the widest chart."""

from __future__ import annotations

from typing import Any


def short(values: Any, digits: int = 5) -> list[float]:
    """Return the values as floats of so many digits."""
    return [float(f"{v:.{digits}g}") for v in values]
