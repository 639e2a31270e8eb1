"""Newton's method for common zeros of k functions of n >= k numbers, by least changes where k < n."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from ...results.arrays import Array

Condition = Callable[[Array], tuple[Array, Array]]  # values (k,) and their derivatives (k, n)

MAX_ROUNDS = 12
NEWTON_TOLERANCE = 1e-12  # correction at which it stops,
ROUNDING_TOLERANCE = 1e-9  # or, where rounding does not let it come so far, at which a point counts as found
MAX_SIZE = 1e3
#: Rounds after which corrections that do not fall faster than this tell of no regular zero.
FREE_ROUNDS, MAX_CORRECTION_RATIO = 3, 0.4


def newton(
    condition: Condition, start: Array, reach: float = math.inf, close: float = NEWTON_TOLERANCE
) -> Array | None:
    """Find a common zero of at most n functions of n numbers, by least changes; None if there is none within reach.

    Shapes: start (n,).
    """
    v, size = start, math.inf
    for rounds in range(MAX_ROUNDS):
        value, slope = condition(v)
        if not (np.isfinite(value).all() and np.isfinite(slope).all()):
            return None
        try:
            if len(slope) == len(v):
                change = np.linalg.solve(slope, -value)
            else:
                change = slope.T @ np.linalg.solve(slope @ slope.T, -value)
        except np.linalg.LinAlgError:
            return None
        last, size = size, math.sqrt(change @ change)
        v = v + change
        if not size < MAX_SIZE or math.dist(v, start) > reach:
            return None
        if size < close:
            return v
        if rounds > FREE_ROUNDS and size > MAX_CORRECTION_RATIO * last:
            break
    return v if size < ROUNDING_TOLERANCE else None
