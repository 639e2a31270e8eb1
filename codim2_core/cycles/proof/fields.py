"""The field with time changed, ``F = q U``, its divergence, and the mean of that over a cycle; for arrays of places."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ...psi.function import Psi
from ...psi.kernel import VECTOR

Array = NDArray[np.float64]


def fields(psi: Psi, numbers: Sequence[float], places: Array) -> tuple[Array, Array]:
    """Return F (n, 2) and its divergence (n,) at x2 (n, 2), for numbers a, b, c, d (of A, by rows) and f, g."""
    a, b, c, d, f, g = numbers
    s = (places**2).sum(axis=1)
    kernel = psi.kernel
    with np.errstate(all="ignore"):
        value, slope = kernel.value(VECTOR, s), kernel.slope(VECTOR, s)
    q = np.sqrt(s + value)
    e = places / q[:, None]
    U = np.stack([a * e[:, 0] + b * e[:, 1] + f, c * e[:, 0] + d * e[:, 1] + g], axis=1)
    return q[:, None] * U, a + d + (1.0 + slope) * (e @ (f, g))


def mean_divergence(psi: Psi, numbers: Sequence[float], places: Array) -> float:
    """Return the mean of div F over a closed orbit, in the time of F."""
    step = np.hypot(*np.diff(places, axis=0).T)
    F, divergence = fields(psi, numbers, 0.5 * (places[1:] + places[:-1]))
    time = step / np.hypot(*F.T)
    return float(divergence @ time / time.sum())
