"""Local expansion of the orbit that leaves a limit direction up the hemisphere, Theorem 3.1(b).

Write ``p = sqrt(1 - w^2) (cos theta, sin theta)``, w = ebar. At a limit direction theta_0, Theta = 0, and
``theta' = Theta - w^2 Psi Theta_e/2 + ...`` with ``Theta_e = (-sin, cos).D_e U (cos, sin)`` (A for D_e U in the
e-linear system), ``w' = -lambda_rho w``. Psi falls like s^-mu as s = 1/w^2 grows (mu = 0 for Psi = 1), so
``theta = theta_0 + k w^2`` with

    k = (Psi/2) Theta_e/(lambda_theta + (2 + 2 mu) lambda_rho),

up to terms of order w^4. At the resonance, where that denominator vanishes, k has a logarithm instead:
``k = (Psi/2) Theta_e ln(w)/lambda_rho``. Where lambda_theta > 0 many orbits leave; this is the smooth one.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...results.arrays import join_columns
from ...systems.frozen import FrozenSystem
from ...systems.psi.function import Psi

HIGHEST = 1e-3  # start no further up than this: 1 - |p| is then 5e-7, well below a pixel
LIMIT = 1e-6  # |Theta| allowed of a limit direction, in units of |U|
RESONANCE = 1e-6


def _tilt(
    lambda_theta: NDArray[np.float64],
    lambda_rho: NDArray[np.float64],
    forcing: NDArray[np.float64],
    mu: float,
    w: float,
) -> NDArray[np.float64]:
    """(theta - theta_0)/w^2, solving ``theta' = lambda_theta theta - forcing w^2`` along ``w' = -lambda_rho w``."""
    gap = lambda_theta + (2.0 + 2.0 * mu) * lambda_rho
    resonant = np.abs(gap) <= RESONANCE * np.abs(lambda_rho)
    return np.where(resonant, forcing * np.log(w) / lambda_rho, forcing / np.where(resonant, 1.0, gap))


def departures(at: FrozenSystem, psi: Psi, theta: ArrayLike, rtol: float, backward: bool) -> NDArray[np.float64]:
    """First states (k, 3) of the orbits that leave limit directions; as `departures_under` for one Psi."""
    return departures_under(at, (psi,), theta, rtol, backward)[0]


def departures_under(
    at: FrozenSystem, psis: Sequence[Psi], theta: ArrayLike, rtol: float, backward: bool
) -> list[NDArray[np.float64]]:
    """First states (p_x, p_y, ebar) of the orbits that leave limit directions (k,), under each Psi."""
    try:
        angle = np.array(theta, float).reshape(-1)
    except (TypeError, ValueError) as error:
        raise ValueError(f"theta is {theta!r}; give limit directions in radians, shape (k,).") from error
    if not np.isfinite(angle).all():
        raise ValueError(f"theta is {theta!r}; every limit direction must be a finite angle in radians.")
    size = at.speed
    e = join_columns(np.cos(angle), np.sin(angle))
    across = join_columns(-e[:, 1], e[:, 0])
    U, DU = at.U(e) / size, at.DU(e) / size
    Theta, lambda_rho = (across * U).sum(axis=-1), (e * U).sum(axis=-1)
    tilting = np.einsum("ki,kij,kj->k", across, DU, e)
    lambda_theta = np.einsum("ki,kij,kj->k", across, DU, across) - lambda_rho
    for i in (np.abs(Theta) > LIMIT).nonzero()[0]:
        raise ValueError(
            f"theta[{i}] = {angle[i]} is no limit direction: Theta is {Theta[i] * size:.3g} there, not 0; "
            "take theta from equator_equilibria."
        )
    wrong = lambda_rho <= 0.0 if backward else lambda_rho >= 0.0
    for i in wrong.nonzero()[0]:
        raise ValueError(
            f"theta[{i}] = {angle[i]} has lambda_rho = {lambda_rho[i] * size:.3g}; a trajectory continues up the "
            f"hemisphere {'backward where lambda_rho > 0' if backward else 'where lambda_rho < 0'} only."
        )
    w = min(HIGHEST, (0.1 * rtol) ** 0.25)
    far, r, found = 1.0 / (w * w), math.sqrt((1.0 - w) * (1.0 + w)), []
    for psi in psis:
        value = psi(far)
        mu = max(-far * psi.derivative(far) / value, 0.0) if value > 0.0 else 0.0
        turned = angle + w * w * _tilt(lambda_theta, lambda_rho, 0.5 * value * tilting, mu, w)
        found.append(join_columns(r * np.cos(turned), r * np.sin(turned), np.full_like(turned, w)))
    return found
