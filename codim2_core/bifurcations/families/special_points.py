"""Zeros of test functions of equilibria along one parameter: Newton's method from many starts at once.

Equations are in (theta, u) on the equator and in (c, s, u) within it, u from 0 to 1 along the parameter. Those of a row
of `special_kinds` are that the object is an equilibrium there and that the row's test function is zero.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...results.arrays import Array
from ...results.special_kinds import SpecialKind
from .family import AXES, SystemFamily

Equations = Callable[[Array], Array]  # of places (n, k): values (n, k)

MAX_ROUNDS, FREE_ROUNDS, MIN_GAIN = 40, 6, 0.75  # Newton steps; those after which each must be so much of the last
DIFFERENCE_STEP = 1e-5  # of derivatives: of angles, of e, and of the span
SLOPE_STEP = 1e-3  # of Theta'', by which the derivatives of Theta' are taken
MAX_ANGLE_STEP, MAX_PLACE_STEP = 0.3, 0.2
#: Steps after which Newton's method stops, or has found a zero within rounding.
CONVERGED_STEP, SETTLED_STEP = 1e-14, 1e-6
MIN_DETERMINANT = 1e-7  # of the derivatives at a simple zero: equations are of the order of 1


class SpecialPoints(NamedTuple):
    """Zeros of a test function."""

    y: Array  # (n, k) Their places
    regular: NDArray[np.bool_]  # (k,) The zero is simple, and known to the last digits


def equator_numbers(family: SystemFamily, y: Array) -> tuple[Array, Array, Array]:
    """Return Theta, lambda_rho and lambda_theta at places (2, k) of the equator."""
    c, s = np.cos(y[0]), np.sin(y[0])
    (U, V), ((Uc, Us), (Vc, Vs)) = family.on_net(c, s, y[1])
    radial = c * U + s * V
    return c * V - s * U, radial, c * (c * Vs - s * Vc) - s * (c * Us - s * Uc) - radial


def set_numbers(family: SystemFamily, y: Array) -> tuple[Array, Array, Array, tuple[Array, Array]]:
    """Return U (2, k), tr J and det J at places (3, k) of the disc, and what these are of the order of.

    Beyond the disc Psi has its share of the rim.
    """
    c, s, u = y
    U, ((Uc, Us), (Vc, Vs)) = family.on_net(c, s, u)
    square = c * c + s * s
    radial, tangential = family.jacobian_factors(square, np.clip(u, 0.0, 1.0)[:, None])
    along = (c * c * Uc + c * s * (Us + Vc) + s * s * Vs) / np.where(square > 0.0, square, 1.0)
    trace = tangential * (Uc + Vs) + (radial - tangential) * along
    return U, trace, radial * tangential * (Uc * Vs - Us * Vc), (tangential, radial * tangential)


def kind_equations(family: SystemFamily, kind: SpecialKind) -> Equations:
    """Return the equations of a row of `special_kinds`, each of the order of 1."""

    def equations(y: Array) -> Array:
        U, trace, determinant, (one, other) = set_numbers(family, y)
        size = np.abs(kind.function(one, 0.0 * other)) + np.abs(kind.function(0.0 * one, other))
        return np.stack([*U, kind.function(trace, determinant) / size])

    return equations


def meeting(family: SystemFamily) -> Equations:
    """Theta = Theta' = 0: two limit directions meet."""
    return lambda y: np.stack(equator_numbers(family, y)[::2])


def triple_meeting(family: SystemFamily) -> Equations:
    """Theta = Theta' = Theta'' = 0: three limit directions meet, by a symmetry or where the parameter passes a cusp."""

    def equations(y: Array) -> Array:
        step = np.array([SLOPE_STEP, 0.0])[:, None]
        (_, _, before), (theta, _, here), (_, _, after) = (
            equator_numbers(family, y + way) for way in (-step, 0.0 * step, step)
        )
        return np.stack([theta, here, (after - before) / (2.0 * SLOPE_STEP)])

    return equations


def crossing(family: SystemFamily) -> Equations:
    """Theta' = dTheta/du = 0: where Theta vanishes too, branches of limit directions pass through each other."""
    return lambda y: np.stack([equator_numbers(family, y)[2], theta_by_parameter(family, y)])


def theta_by_parameter(family: SystemFamily, y: Array) -> Array:
    """Return dTheta/du at places (2, k)."""
    c, s = np.cos(y[0]), np.sin(y[0])
    U, V = family.speed_on_net(c, s, y[1], by=AXES[0])
    return c * V - s * U


def reaching_equator(family: SystemFamily) -> Equations:
    """U = 0 and |e| = 1."""
    return lambda y: np.stack([*family.speed_on_net(*y), 1.0 - y[0] ** 2 - y[1] ** 2])


def folding(family: SystemFamily) -> Equations:
    """U = 0 and det D_e U = 0: two critical sets meet."""

    def equations(y: Array) -> Array:
        U, ((Uc, Us), (Vc, Vs)) = family.on_net(*y)
        return np.stack([*U, Uc * Vs - Us * Vc])

    return equations


def solve(equations: Equations, starts: Array, reach: float) -> SpecialPoints:
    """Find zeros of n equations or more in n unknowns, from starts (n, k) and within `reach` along the parameter."""
    n = len(starts)
    most = np.array([MAX_ANGLE_STEP if n == 2 else MAX_PLACE_STEP] * (n - 1) + [reach])[:, None]
    ways = DIFFERENCE_STEP * np.concatenate([np.zeros((1, n)), np.eye(n), -np.eye(n)])
    y, first, last = starts.copy(), starts[-1].copy(), np.full(starts.shape[1], np.inf)
    found, regular = [np.zeros((n, 0))], [np.zeros(0, bool)]
    for turn in range(MAX_ROUNDS):
        if not y.shape[1]:
            break
        with np.errstate(all="ignore"):
            values = equations((y[:, None] + ways.T[:, :, None]).reshape(n, -1)).reshape(-1, 2 * n + 1, y.shape[1])
            slopes = (values[:, 1 : n + 1] - values[:, n + 1 :]) / (2.0 * DIFFERENCE_STEP)
            step, determinant = _solve_linear(slopes, values[:, 0])
            size = np.abs(step).max(axis=0)
            y = y - step / np.maximum((np.abs(step) / most).max(axis=0), 1.0)
        near = np.isfinite(size) & (np.abs(y[-1] - first) <= reach) & (np.abs(y[:-1]).max(axis=0) < 10.0)
        near &= (turn > 0) | (np.abs(step[-1]) <= 2.0 * reach)
        near &= (turn < FREE_ROUNDS) | (size <= np.maximum(MIN_GAIN * last, SETTLED_STEP))
        done = near & ((size <= CONVERGED_STEP) | ((turn + 1 == MAX_ROUNDS) & (size <= SETTLED_STEP)))
        found.append(y[:, done])
        regular.append(np.abs(determinant[done]) > MIN_DETERMINANT)
        y, first, last = y[:, near & ~done], first[near & ~done], size[near & ~done]
    return SpecialPoints(np.concatenate(found, axis=1), np.concatenate(regular))


def _solve_linear(slopes: Array, values: Array) -> tuple[Array, Array]:
    """Solve equations (m, n, k) for (n, k), by least squares if m > n; also their determinants (k,)."""
    A, b = np.moveaxis(slopes, -1, 0), values.T
    if A.shape[1] > A.shape[2]:
        A, b = np.einsum("kij,kil->kjl", A, A), np.einsum("kij,ki->kj", A, b)
    determinant = np.linalg.det(A)
    columns = []
    for j in range(A.shape[2]):
        B = A.copy()
        B[:, :, j] = b
        columns.append(np.linalg.det(B) / determinant)
    return np.where(values.any(axis=0), np.stack(columns), 0.0), determinant
