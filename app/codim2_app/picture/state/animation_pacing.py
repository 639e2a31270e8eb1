"""The pace of a parameter in play and in films: slow near special values."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

#: The least share of the usual pace; how near a special value it falls, in parts of the span.
MIN_PACE, SLOW_DISTANCE = 0.25, 0.05
PACE_STEPS = 2000  # steps in which the pace is summed


def paced_values(low: float, high: float, events: Sequence[float], count: int) -> list[float]:
    """Return so many values from low to high, at moments of equal distance; each special value is one of them."""
    x = np.linspace(low, high, PACE_STEPS + 1)
    middle = 0.5 * (x[1:] + x[:-1])
    gap = np.min(np.abs(middle[:, None] - np.asarray(events)), axis=1, initial=high - low)
    steps = 1.0 / np.clip(gap / (SLOW_DISTANCE * (high - low)), MIN_PACE, 1.0)
    time = np.concatenate([[0.0], np.cumsum(steps)])
    values = np.interp(np.linspace(0.0, time[-1], count), time, x)
    for event in events:
        values[np.argmin(np.abs(values - event))] = event
    return [float(v) for v in values]
