"""Return e as a function of (x, y): in the limit outside Sigma, and regularised."""

from __future__ import annotations

import numpy as np

from ...results.arrays import Array
from .function import Psi


def direction(psi: Psi | None, eps: float, xy: Array, along: Array | None = None) -> Array:
    """Return e (k, 2) at (x, y): regularised, or, for eps = 0, outside Sigma."""
    if psi is None or eps == 0.0:
        r = np.hypot(*xy.T)[:, None]
        e = np.divide(xy, r, out=np.zeros_like(xy), where=r > 0.0)
        return e if along is None else np.sign(e @ along)[:, None] * along
    return xy / (eps * np.sqrt((zeta := np.hypot(*xy.T) / eps) ** 2 + psi(zeta**2)))[:, None]


def outside(xy: Array, along: Array | None = None) -> tuple[Array, Array]:
    """Return e = (x, y)/|(x, y)| (k, 2) of the nonsmooth system and its derivative (k, 2, 2); 0 on Sigma itself.

    Shapes: xy (k, 2), along (2,).
    """
    r, e = np.hypot(*xy.T)[:, None], direction(None, 0.0, xy, along)
    if along is not None:
        return e, np.zeros((len(e), 2, 2))
    across = np.eye(2) - e[:, :, None] * e[:, None, :]
    return e, np.divide(across, r[:, :, None], out=np.zeros_like(across), where=r[:, :, None] > 0.0)


def smoothed_direction(psi: Psi, eps: float, xy: Array) -> tuple[Array, Array]:
    """Return e_Psi (k, 2), (2.19), and its derivative (k, 2, 2), Remark 3.2.

    Shapes: xy (k, 2).
    """
    r = np.hypot(*xy.T)
    radial, tangential = (factor / eps for factor in psi.jacobian_factors(r / eps))
    n = np.divide(xy, r[:, None], out=np.zeros_like(xy), where=r[:, None] > 0.0)
    De = tangential[:, None, None] * np.eye(2) + (radial - tangential)[:, None, None] * n[:, :, None] * n[:, None, :]
    return tangential[:, None] * xy, De
