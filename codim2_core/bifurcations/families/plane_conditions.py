"""Equations of curves without a place on the portrait: functions of both parameters alone."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache

import numpy as np

from ...numerics.curves.arclength import Condition
from ...results.arrays import Array
from .family import AXES, SystemFamily

MIN_ANGLES, MAX_ANGLES = 64, 2**12  # angles of the mean rule
MEAN_TOLERANCES = np.array([1e-13, 1e-9, 1e-9])  # of the mean, and of its slopes
NO_VALUE = np.full(1, math.nan), np.full((1, 2), math.nan)


def singular_matrix(family: SystemFamily) -> Condition:
    """Det A = 0, of an e-linear system."""

    def condition(v: Array) -> tuple[Array, Array]:
        jet = family.jet(0.0, 0.0, *v.tolist())
        a, b, c, d = jet[1], jet[2], jet[13], jet[14]
        slopes = [a * jet[k + 12 + 3] + d * jet[k] - b * jet[k + 12] - c * jet[k + 3] for k in (7, 8)]
        return np.array([a * d - b * c]), np.array([slopes])

    return condition


def neutral_equator(family: SystemFamily) -> Condition:
    """Find where the mean of lambda_rho/|Theta| over the equator is zero, of a closed equator (Theorem 3.1(c)).

    Means over equally spaced angles, with those between until they stand; NaNs where there are limit directions.
    """
    sums = _affine_sums(family) if family.affine else _sums(family)
    enough = [MIN_ANGLES]

    def condition(v: Array) -> tuple[Array, Array]:
        count = enough[0]  # for the last place: it is not far
        found = sums(v, count, 0.0)
        while found is not None and count < MAX_ANGLES:
            between = sums(v, count, 0.5)
            if between is None or between[3] * found[3] < 0.0:
                break
            before, found = found[:3] / abs(found[3]), found + between
            count *= 2
            now = found[:3] / abs(found[3])
            if (np.abs(now - before) <= MEAN_TOLERANCES * (1.0 + np.abs(now))).all():
                enough[0] = max(count // 4, MIN_ANGLES)
                return now[:1], now[None, 1:]
        return NO_VALUE

    return condition


#: At a place of the unit square, over so many angles from a part of their distance: sums of lambda_rho/Theta and of its
#: slopes, and of 1/Theta (4,); None where Theta has not one sign at all of them.
Sums = Callable[[Array, int, float], "Array | None"]


def _sums(family: SystemFamily) -> Sums:
    rows = family.unit_rows
    slopes = [[row.derivative(name) for name in AXES] for row in rows]

    def sums(v: Array, count: int, part: float) -> Array | None:
        theta = 2.0 * math.pi * (np.arange(count) + part) / count
        c, s = np.cos(theta), np.sin(theta)
        values = {"c": c, "s": s, AXES[0]: float(v[0]), AXES[1]: float(v[1])}
        U, V = (row.evaluate(values) for row in rows)
        turning = c * V - s * U
        if not (np.isfinite(turning).all() and (turning.min() > 0.0 or turning.max() < 0.0)):
            return None
        radial = (c * U + s * V) / turning
        out = np.array([radial.sum(), 0.0, 0.0, (1.0 / turning).sum()])
        for k in range(2):
            Uk, Vk = slopes[0][k].evaluate(values), slopes[1][k].evaluate(values)
            out[1 + k] = (((c * Uk + s * Vk) - radial * (c * Vk - s * Uk)) / turning).sum()
        return out

    return sums


def _affine_sums(family: SystemFamily) -> Sums:
    """Likewise: Theta and lambda_rho are sums of c, s, c^2, c s and s^2 with coefficients that a place decides."""

    def sums(v: Array, count: int, part: float) -> Array | None:
        basis = _quadratic(count, part)
        U, Uc, Us, Uu, Uv, _, _, Ucu, Ucv, _, Usu, Usv, *rest = family.jet(0.0, 0.0, *v.tolist())
        V, Vc, Vs, Vu, Vv, _, _, Vcu, Vcv, _, Vsu, Vsv = rest
        entries = (U, Uc, Us, V, Vc, Vs), (Uu, Ucu, Usu, Vu, Vcu, Vsu), (Uv, Ucv, Usv, Vv, Vcv, Vsv)
        radial = np.array([(p, q, a, b + c, d) for p, a, b, q, c, d in entries])
        turning = np.array([(q, -p, c, d - a, -b) for p, a, b, q, c, d in entries])
        around = turning[0] @ basis
        if not (around.min() > 0.0 or around.max() < 0.0):  # also NaN
            return None
        weight = 1.0 / around
        out = radial @ (basis @ weight)
        out[1:] -= turning[1:] @ (basis @ (weight * weight * (radial[0] @ basis)))
        return np.append(out, weight.sum())

    return sums


@lru_cache(maxsize=16)
def _quadratic(count: int, part: float) -> Array:
    """Return c, s, c^2, c s and s^2 (5, count) at equally spaced angles, the first a part of their distance from 0."""
    theta = 2.0 * math.pi * (np.arange(count) + part) / count
    c, s = np.cos(theta), np.sin(theta)
    return np.stack([c, s, c * c, c * s, s * s])
