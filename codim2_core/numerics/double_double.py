"""Sums of products in twice the precision (Dekker), for floats and arrays: where the last subtraction cancels."""

from __future__ import annotations

from typing import Any

Pair = tuple[Any, Any]  # a number (float or array) as the sum of two, the second below the rounding of the first

SPLIT = 134217729.0  # 2^27 + 1


def product(x: Any, y: Any) -> Pair:
    """``x y`` and what its rounding lost; for |x|, |y| below 1e290 whose product neither over- nor underflows."""
    p = x * y
    u, v = SPLIT * x, SPLIT * y
    x1, y1 = u - (u - x), v - (v - y)
    x2, y2 = x - x1, y - y1
    return p, ((x1 * y1 - p) + x1 * y2 + x2 * y1) + x2 * y2


def add_pairs(u: Pair, v: Pair) -> Pair:
    """Return the sum of two pairs."""
    s = u[0] + v[0]
    b = s - u[0]
    lost = (u[0] - (s - b)) + (v[0] - b) + u[1] + v[1]
    high = s + lost
    return high, lost - (high - s)


def negative(u: Pair) -> Pair:
    """Return a pair with the other sign."""
    return -u[0], -u[1]


def square(u: Pair) -> Pair:
    """Return the square of a pair."""
    p, lost = product(u[0], u[0])
    return add_pairs((p, lost), (2.0 * u[0] * u[1], 0.0 * p))
