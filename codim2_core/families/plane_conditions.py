"""Equations of curves without a place on the portrait: functions of both parameters alone."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache

import numpy as np

from ..arrays import Array
from ..curves.newton import Condition
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

    Means over equally spaced angles, twice as many until they stand; NaNs where there are limit directions.
    """
    means = _affine_means(family) if family.affine else _means(family)
    enough = [MIN_ANGLES]

    def condition(v: Array) -> tuple[Array, Array]:
        count = enough[0]  # for the last place: it is not far
        before = means(v, count)
        while before is not None and count < MAX_ANGLES:
            count *= 2
            now = means(v, count)
            if now is not None and (np.abs(now - before) <= MEAN_TOLERANCES * (1.0 + np.abs(now))).all():
                enough[0] = max(count // 4, MIN_ANGLES)
                return now[:1], now[None, 1:]
            before = now
        return NO_VALUE

    return condition


#: At a place of the unit square, over so many angles: the mean of lambda_rho with the weight 1/|Theta|, and its slopes.
Means = Callable[[Array, int], "Array | None"]


def _means(family: SystemFamily) -> Means:
    rows = family.unit_rows
    slopes = [[row.derivative(name) for name in AXES] for row in rows]

    def means(v: Array, count: int) -> Array | None:
        theta = 2.0 * math.pi * np.arange(count) / count
        c, s = np.cos(theta), np.sin(theta)
        values = {"c": c, "s": s, AXES[0]: float(v[0]), AXES[1]: float(v[1])}
        U, V = (row.evaluate(values) for row in rows)
        turning = c * V - s * U
        if not (np.isfinite(turning).all() and (turning.min() > 0.0 or turning.max() < 0.0)):
            return None
        radial, out = (c * U + s * V) / turning, [0.0, 0.0, 0.0]
        out[0] = radial.mean()
        for k in range(2):
            Uk, Vk = slopes[0][k].evaluate(values), slopes[1][k].evaluate(values)
            out[1 + k] = (((c * Uk + s * Vk) - radial * (c * Vk - s * Uk)) / turning).mean()
        return np.array(out) / np.abs(1.0 / turning).mean()

    return means


def _affine_means(family: SystemFamily) -> Means:
    """Likewise: Theta and lambda_rho are sums of c, s, c^2, c s and s^2 with coefficients that a place decides."""

    def means(v: Array, count: int) -> Array | None:
        basis = _quadratic(count)
        U, Uc, Us, Uu, Uv, _, _, Ucu, Ucv, _, Usu, Usv, *rest = family.jet(0.0, 0.0, *v.tolist())
        V, Vc, Vs, Vu, Vv, _, _, Vcu, Vcv, _, Vsu, Vsv = rest
        entries = (U, Uc, Us, V, Vc, Vs), (Uu, Ucu, Usu, Vu, Vcu, Vsu), (Uv, Ucv, Usv, Vv, Vcv, Vsv)
        radial = np.array([(p, q, a, b + c, d) for p, a, b, q, c, d in entries])
        turning = np.array([(q, -p, c, d - a, -b) for p, a, b, q, c, d in entries])
        around = turning[0] @ basis
        if not (around.min() > 0.0 or around.max() < 0.0):  # also NaN
            return None
        weight = 1.0 / around
        once = basis @ weight
        twice = basis @ (weight * weight * (radial[0] @ basis))
        out = radial @ once
        out[1:] -= turning[1:] @ twice
        return out / abs(float(weight.sum()))

    return means


@lru_cache(maxsize=8)
def _quadratic(count: int) -> Array:
    """Return c, s, c^2, c s and s^2 (5, count) at equally spaced angles."""
    theta = 2.0 * math.pi * np.arange(count) / count
    c, s = np.cos(theta), np.sin(theta)
    return np.stack([c, s, c * c, c * s, s * s])
