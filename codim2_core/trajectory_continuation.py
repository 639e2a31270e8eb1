"""Local expansion of the orbit that leaves a limit direction up the hemisphere."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .regularisation import Psi
from .systems import Coefficients


def departures(
    coefficients: Coefficients, psi: Psi, theta: ArrayLike, rtol: float, backward: bool
) -> NDArray[np.float64]:
    """First states (k, 3)."""
    angle = np.atleast_1d(np.asarray(theta, float))
    w = 1e-4
    r = np.sqrt(1.0 - w * w)
    return np.stack([r * np.cos(angle), r * np.sin(angle), np.full_like(angle, w)], axis=-1)
