"""Local invariant manifolds of a saddle of the layer problem, as polynomials of order ORDER.

In kappa_2, ``x2' = F(x2) = U(e_Psi(x2))``, in the e-linear system ``A (e_Psi(x2) - e_C)``. The manifold along
the eigenvector v with eigenvalue lambda is the curve ``W(sigma) = C + sigma v + h_2 sigma^2 + ...`` up to order ORDER
on which sigma' = lambda sigma: ``F(W(sigma)) = lambda sigma W'(sigma)``. Order by order ``(J - k lambda) h_k = -N_k``,
N_k the coefficients of the nonlinear part of F along the curve, read off at Chebyshev nodes: no second derivative of
Psi is needed. At a saddle J - k lambda is regular for k >= 2. The error at sigma is of order sigma^(ORDER + 1).
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

from ..results.arrays import Array
from ..systems.frozen import FrozenSystem
from ..systems.psi.function import Psi
from .layer_problem.critical import CriticalSet
from .layer_problem.eigendirections import to_disc

ORDER = 5
FITTED = 9  # nodes the coefficients are read off at
FIRST_DISTANCE, MIN_DISTANCE = 0.2, 1e-6  # start distances tried, in units of hypot(1, |x2|) of the saddle


@lru_cache(maxsize=1)
def _fit() -> tuple[Array, Array]:
    """Nodes t on [-1, 1], and the matrix from N(t)/t^2 there to the coefficients N_2 .. N_ORDER."""
    t = np.cos(math.pi * (np.arange(FITTED - 1) + 0.5) / (FITTED - 1))  # an even number: none is 0
    powers = t[:, None] ** np.arange(FITTED - 1)
    return t, (np.linalg.inv(powers) / t[None, :] ** 2)[: ORDER - 1]


def _projected_velocity(at: FrozenSystem, psi: Psi, critical: CriticalSet, x2: Array) -> Array:
    zeta = np.hypot(x2[:, 0], x2[:, 1])
    e = x2 * (psi.modulus(zeta) / np.maximum(zeta, 1e-300))[:, None]
    if at.as_given is not None:
        return (e - critical.e) @ at.as_given.A.T
    return at.U(e) - at.U(critical.e)  # what rounding leaves of U at C would be amplified


def expansion(
    at: FrozenSystem, psi: Psi, critical: CriticalSet, eigenvalue: float, reach: float
) -> tuple[Array, float]:
    """Coefficients (ORDER + 1, 2) of W in powers of sigma, and its defect, for |sigma| <= reach.

    defect: Largest ``|F(W) - lambda sigma W'|/|lambda|`` at sigma = +-reach: of order reach^(ORDER + 1).
    """
    J = critical.jacobian
    # The longer row of J - lambda has the eigenvector across it.
    rows = J - eigenvalue * np.eye(2)
    row = rows[int(np.argmax(np.hypot(rows[:, 0], rows[:, 1])))]
    vector = np.array([-row[1], row[0]]) / math.hypot(row[0], row[1])
    t, fit = _fit()
    scaled = np.zeros((ORDER + 1, 2))  # h_k reach^k
    scaled[0], scaled[1] = critical.x2, vector * reach
    inverses = [np.linalg.inv(J - k * eigenvalue * np.eye(2)) for k in range(2, ORDER + 1)]
    powers = t[:, None] ** np.arange(ORDER + 1)
    for _ in range(ORDER):  # each round settles one more order
        x2 = powers @ scaled
        nonlinear = _projected_velocity(at, psi, critical, x2) - (x2 - critical.x2) @ J.T
        parts = fit @ nonlinear
        before = scaled.copy()
        for k in range(2, ORDER + 1):
            scaled[k] = -inverses[k - 2] @ parts[k - 2]
        if np.abs(scaled - before).max() <= 1e-17 * reach:
            break
    ends = np.array([-1.0, 1.0])[:, None] ** np.arange(ORDER + 1)
    slope = ends @ (scaled * np.arange(ORDER + 1)[:, None])
    defect = _projected_velocity(at, psi, critical, ends @ scaled) - eigenvalue * slope
    order = np.arange(ORDER + 1)[:, None]
    return scaled / reach**order, float(np.abs(defect).max() / abs(eigenvalue))


def manifold_starts(
    at: FrozenSystem, psi: Psi, critical: CriticalSet, eigenvalue: float, tolerance: float
) -> tuple[Array, Array]:
    """Points of the disc (2, 2) on the two halves of a manifold, and unit tangents (2, 2) there at C."""
    scale = math.hypot(1.0, float(np.hypot(*critical.x2)))
    reach = FIRST_DISTANCE * scale
    terms, defect = expansion(at, psi, critical, eigenvalue, reach)
    for _ in range(6):
        ratio = defect / (tolerance * scale)
        if ratio <= 1.0 or reach <= MIN_DISTANCE * scale:
            break
        reach = max(MIN_DISTANCE * scale, 0.8 * reach * max(ratio ** (-1.0 / (ORDER + 1)), 1e-2))
        terms, defect = expansion(at, psi, critical, eigenvalue, reach)
    sigma = np.array([-reach, reach])
    x2 = (sigma[:, None] ** np.arange(ORDER + 1)) @ terms
    points = x2 / np.hypot(1.0, np.hypot(x2[:, :1], x2[:, 1:]))
    tangent = np.array(to_disc(critical.x2, (float(terms[1, 0]), float(terms[1, 1]))))
    return points, np.array([-tangent, tangent])
