"""Find the critical set that a state of the regularised motion follows, if any: Section 3.2, Theorem 3.3.

The motion slides where it lies on a slow manifold, and that is O(eps) away from the critical set: in the chart
kappa_2, where ``eps x2' = U(e_Psi(x2), eps x2, z)`` up to the time, it is ``x2 = X(z) + eps X1(z) + O(eps^2)`` with
``J X1 = D_z X W - U_x X``. A state within twice that of a critical set, in p, follows it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..results.arrays import Array
from ..systems.psi.function import Psi
from .initial_value.field import Field
from .initial_value.slow_manifold import solve_critical

MANIFOLD_MARGIN = 2.0  # times the first-order distance of the slow manifold
FLOOR = 1e-3  # in p: what an orbit that runs into the set is given besides
MAX_DISTANCE = 0.25  # in p: near a fold, and near the equator, the expansion promises nothing


@dataclass(frozen=True)
class TrackedSet:
    """The critical set that a state follows."""

    e: Array  # (2,)
    p: Array  # (2,) Its place in the projected disc
    attracts: bool  # whether it attracts in the layer problem
    rate: float  # largest modulus of its eigenvalues, in the fast time of kappa_2
    growth: float  # largest real part of them


def in_disc(psi: Psi, e: Array) -> Array:
    """Point (2,) of the projected disc at which e_Psi = e, |e| <= 1."""
    modulus = math.hypot(e[0], e[1])
    if modulus == 0.0:
        return np.zeros(2)
    if modulus >= 1.0:
        return e / modulus
    zeta = float(psi.radius(modulus))
    return e / modulus * (zeta / math.hypot(1.0, zeta))


def place_on_hemisphere(psi: Psi, eps: float, x: float, y: float) -> tuple[Array, Array]:
    """Return (e, p) of a state of the regularised system, each of shape (2,): ``p = (x, y)/rho``."""
    r, rho = math.hypot(x, y), math.hypot(x, y, eps)
    p = np.array([x, y]) / rho
    return (p * (float(psi.modulus(r / eps)) * rho / r) if r > 0.0 else np.zeros(2)), p


def inverse_gain(psi: Psi, e: Array) -> tuple[float, Array, Array]:
    """Return |x2| where e_Psi(x2) = e, its direction, and D e_Psi there."""
    modulus = math.hypot(e[0], e[1])
    zeta = float(psi.radius(modulus))
    n = e / modulus if modulus > 0.0 else np.array([1.0, 0.0])
    radial, tangential = psi.jacobian_factors(zeta)
    return zeta, n, tangential * np.eye(2) + (radial - tangential) * np.outer(n, n)


def jacobian(field: Field, psi: Psi, e: Array, z: Array) -> Array:
    """Return J (2, 2) of the layer problem in kappa_2 at the critical set e."""
    D = field.jacobian(float(e[0]), float(e[1]), 0.0, 0.0, z.tolist())
    return D[:2, :2] @ inverse_gain(psi, e)[2]


def followed_critical_set(field: Field, psi: Psi, eps: float, state: Array) -> TrackedSet | None:
    """Return the critical set within O(eps) of which a state (2 + m,) lies, in p; None if there is none."""
    z = state[2:]
    own_e, own_p = place_on_hemisphere(psi, eps, float(state[0]), float(state[1]))
    e = solve_critical(field, own_e, z)
    if e is None or not math.hypot(e[0], e[1]) < 1.0:
        return None
    p = in_disc(psi, e)
    distance = float(np.hypot(*(own_p - p)))
    if not distance <= MAX_DISTANCE:
        return None
    zeta, n, De = inverse_gain(psi, e)
    along = np.outer(n, n)
    D = field.jacobian(float(e[0]), float(e[1]), 0.0, 0.0, z.tolist())
    J = D[:2, :2] @ De
    trace, determinant = float(np.trace(J)), float(np.linalg.det(J))
    split = 0.25 * trace * trace - determinant  # eigenvalues: trace/2 +- sqrt(split)
    rate = 0.5 * abs(trace) + math.sqrt(split) if split >= 0.0 else math.sqrt(determinant)
    if distance > FLOOR:
        with np.errstate(all="ignore"):
            try:
                W = np.array(field.value(float(e[0]), float(e[1]), 0.0, 0.0, *z.tolist())[2:])
                moved = np.linalg.solve(D[:2, :2] @ De, -(D[:2, 4:] @ W))  # D_z X W
                X1 = np.linalg.solve(J, moved - D[:2, 2:4] @ (zeta * n))
            except np.linalg.LinAlgError:
                return None
        height = 1.0 / math.hypot(1.0, zeta)
        change = height * X1 + (height**3 - height) * (along @ X1)
        if not distance <= FLOOR + MANIFOLD_MARGIN * eps * math.hypot(change[0], change[1]):
            return None
    return TrackedSet(e, p, determinant > 0.0 and trace < 0.0, rate, 0.5 * trace + math.sqrt(max(split, 0.0)))
