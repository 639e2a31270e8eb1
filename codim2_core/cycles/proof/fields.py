"""The field with time changed, ``F = q U``, its divergence, and the mean of that over a cycle; for arrays of places."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...psi.kernel import VECTOR
from .flow import Flow

Array = NDArray[np.float64]


def fields(flow: Flow, places: Array) -> tuple[Array, Array]:
    """Return F (n, 2) and its divergence (n,) at x2 (n, 2)."""
    a, b, c, d, f, g = flow.numbers
    s = (places**2).sum(axis=1)
    kernel = flow.psi.kernel
    with np.errstate(all="ignore"):
        value, slope = kernel.value(VECTOR, s), kernel.slope(VECTOR, s)
    q = np.sqrt(s + value)
    e = places / q[:, None]
    U = np.stack([a * e[:, 0] + b * e[:, 1] + f, c * e[:, 0] + d * e[:, 1] + g], axis=1)
    return q[:, None] * U, a + d + (1.0 + slope) * (e @ (f, g))


def mean_divergence(flow: Flow, places: Array) -> float:
    """Return the mean of div F over a closed orbit, in the time of F."""
    step = np.hypot(*np.diff(places, axis=0).T)
    F, divergence = fields(flow, 0.5 * (places[1:] + places[:-1]))
    time = step / np.hypot(*F.T)
    return float(divergence @ time / time.sum())
