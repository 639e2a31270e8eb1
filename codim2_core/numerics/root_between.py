"""One root, between two ends or by some values about it, without loading SciPy's optimisers; a vertex by three."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from ..results.arrays import Array


def root_between(function: Callable[[float], float], low: float, high: float, tolerance: float = 1e-300) -> float:
    """Find a root in an interval by Chandrupatla's method; its better end if there is no change of sign to be seen.

    It does what Brent's method does, and importing SciPy's optimisers would cost more than all curves together.
    """
    x1, x2 = high, low
    f1, f2 = function(x1), function(x2)
    if f1 == 0.0 or f2 == 0.0 or (f1 > 0.0) == (f2 > 0.0):
        return x2 if abs(f2) <= abs(f1) else x1
    t, best = 0.5, x1
    for _ in range(200):
        x = x1 + t * (x2 - x1)
        f = function(x)
        if (f > 0.0) == (f1 > 0.0):
            x3, f3 = x1, f1
        else:
            x3, f3, x2, f2 = x2, f2, x1, f1
        x1, f1 = x, f
        best, least = (x1, f1) if abs(f1) < abs(f2) else (x2, f2)
        part = (5e-16 * abs(best) + 0.5 * tolerance) / abs(x2 - x1) if x2 != x1 else 1.0
        if least == 0.0 or part >= 0.5:
            return best
        xi, phi = (x1 - x2) / (x3 - x2), (f1 - f2) / (f3 - f2)
        t = 0.5
        if phi * phi < xi and (1.0 - phi) ** 2 < 1.0 - xi:  # inverse quadratic interpolation is safe
            t = f1 / (f2 - f1) * f3 / (f2 - f3) + (x3 - x1) / (x2 - x1) * f1 / (f3 - f1) * f2 / (f3 - f2)
        t = min(max(t, part), 1.0 - part)
    return best


def root_through(x: Sequence[float] | Array, y: Sequence[float] | Array) -> float:
    """Lagrange's polynomial for the place x as a function of the value y, all different, at zero."""
    return sum(
        float(x[j]) * math.prod(float(-y[k] / (y[j] - y[k])) for k in range(len(y)) if k != j) for j in range(len(y))
    )
