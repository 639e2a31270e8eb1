"""The range and the step of a slider, widened where a value lies outside."""

from __future__ import annotations


def slider_range(low: float, high: float, value: float) -> tuple[float, float, float]:
    """Return (low, high, step) of a slider, widened to hold the value; the same rule as in controls.js."""
    size = abs(value)
    if value < low or value > high:
        reach = _round_up(size)
        low, high = (-reach, reach) if low < 0 else (low, reach)
    return low, high, 10.0 ** (len(str(int(high - low))) - 4)


def _round_up(size: float) -> float:
    """Return 1, 2 or 5 times a power of ten, at least 1.2 times the size."""
    target, power = 1.2 * size, 1.0
    while power * 10 <= target:
        power *= 10
    return next(power * k for k in (1, 2, 5, 10) if power * k >= target)
