"""The state (x, y, z) as an initial value problem: regularised (eps > 0), or nonsmooth outside Sigma (eps = 0).

These are the global coordinates of eq:blowup in another scaling: with rho = sqrt(x^2 + y^2 + eps^2), the errors of
x and y are measured by rho. Relative accuracy then holds at every distance from Sigma, as it would with log(rho), but
rho ebar = eps holds to the last digit, and a straight slip is one step.
"""

from __future__ import annotations

import math

import numpy as np

from ..arrays import Array
from ..numerics.radau import Problem
from ..psi.function import Psi
from .field import Field

MAX_INWARD_SHARE = 0.9  # of rho: how far towards Sigma one step may go
CONTACT = 20.0  # times eps: so near, what looks like a way inward may be the rounding of a slide, eps times 1/rtol
MIN_ARRIVAL_RADIUS, ARRIVAL_RTOL_SHARE = 1e-13, 5e-5  # of the largest rho of a slip; of that times rtol
MAX_STEP_GROWTH = 1.0  # longest step times a growth rate: an L-stable method damps faster growth away


def arrival_radius(rtol: float) -> float:
    """Part of the largest rho of a slip at which it has arrived at Sigma: the rest of the way is straight.

    What is left to turn on it, to a limit direction that attracts, is a small part of 1: rtol has room for it.
    """
    return max(MIN_ARRIVAL_RADIUS, ARRIVAL_RTOL_SHARE * rtol)


def growth_bound(jacobian: Array) -> float:
    """Longest step in which an L-stable method follows growth away from an unstable state instead of damping it."""
    growth = float(np.linalg.eigvals(jacobian).real.max()) if jacobian.size else 0.0
    return MAX_STEP_GROWTH / growth if growth > 0.0 else math.inf


def own_time(problem: Problem, state: Array, rate: Array) -> float:
    """Time in which a state changes by its own size; infinite where it stands."""
    speed = float(np.max(np.abs(rate) / problem.scale(state)))
    return 1.0 / speed if speed > 0.0 else math.inf


def direction(psi: Psi | None, eps: float, x: float, y: float) -> tuple[float, float, float, float, float, float]:
    """Return e and what its derivative by (x, y) is made of.

    Parameters
    ----------
    psi : Psi or None
        Unused for eps = 0.
    eps : float
        0 gives e = (x, y)/|(x, y)|.
    x, y : float

    Returns
    -------
    c, s : float
        ``e_Psi``, eq:ePsi.
    radial, tangential : float
        Eigenvalues of ``D e_Psi`` along (x, y) and across it, rem:jaco_properties.
    n1, n2 : float
        Unit vector along (x, y).
    """
    r = math.hypot(x, y)
    n1, n2 = (x / r, y / r) if r > 0.0 else (1.0, 0.0)
    if eps == 0.0 or psi is None:
        tangential = 1.0 / r if r > 0.0 else math.nan
        return n1, n2, 0.0, tangential, n1, n2
    radial, tangential = psi.jacobian_factors(r / eps)
    radial, tangential = radial / eps, tangential / eps
    return tangential * x, tangential * y, radial, tangential, n1, n2


def smoothed_direction(psi: Psi | None, eps: float, x: float, y: float) -> tuple[float, float]:
    """Return e alone, as `direction` does."""
    r = math.hypot(x, y)
    if eps == 0.0 or psi is None:
        return (x / r, y / r) if r > 0.0 else (1.0, 0.0)
    if r == 0.0:
        return 0.0, 0.0
    part = psi.modulus(r / eps) / r
    return part * x, part * y


def plane_problem(
    field: Field, psi: Psi | None, eps: float, rtol: float, atol: float, line: tuple[float, float] | None = None
) -> Problem:
    """State (x, y, z) of the regularised system; for eps = 0 of the nonsmooth one, away from Sigma.

    Parameters
    ----------
    field : Field
    psi : Psi or None
    eps : float
    rtol, atol : float
        Errors of x and y are measured by rho, those of z by |z| + atol/rtol.
    line : (2,), optional
        Unit vector along an invariant line, in which (x, y) is kept.
    """
    value, floor, contact = field.value, atol / rtol, (CONTACT * eps) ** 2 + eps * eps
    n1, n2 = (0.0, 0.0) if line is None else line

    def F(state: Array) -> Array:
        x, y, *z = state.tolist()
        if line is not None:
            along = n1 * x + n2 * y
            x, y = n1 * along, n2 * along
        try:
            c, s = smoothed_direction(psi, eps, x, y)
        except ValueError:  # a stage of a step far too long is at infinity
            return np.full(len(state), math.nan)
        rate = value(c, s, x, y, *z)
        if line is not None:
            along = n1 * rate[0] + n2 * rate[1]
            rate = (n1 * along, n2 * along, *rate[2:])
        return np.array(rate)

    def J(state: Array) -> Array:
        x, y, *z = state.tolist()
        c, s, radial, tangential, n1, n2 = direction(psi, eps, x, y)
        all_slopes = field.jacobian(c, s, x, y, z)
        spread = radial - tangential
        across = spread * n1 * n2
        De = np.array([[tangential + spread * n1 * n1, across], [across, tangential + spread * n2 * n2]])
        slopes = all_slopes[:, 2:].copy()
        slopes[:, :2] += all_slopes[:, :2] @ De
        return slopes

    def scale(state: Array) -> Array:
        size = np.abs(state) + floor
        size[:2] = math.hypot(state[0], state[1], eps)
        return size

    def limit(state: Array, rate: Array, jacobian: Array) -> float:
        x, y, u, v = float(state[0]), float(state[1]), float(rate[0]), float(rate[1])
        inward, square = -(x * u + y * v), x * x + y * y + eps * eps
        bound = MAX_INWARD_SHARE * square / inward if inward > 0.0 and square > contact else math.inf
        return min(bound, growth_bound(jacobian))

    return Problem(F, J, scale, limit)
