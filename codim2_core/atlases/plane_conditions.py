"""What is zero along curves that belong to no place on the portrait: functions of both parameters alone."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ..bifurcations.implicit_curve import Condition
from .family import AXES, Family

Array = NDArray[np.float64]

FEW, MANY = 64, 2**12  # angles of the mean rule
SETTLED = np.array([1e-13, 1e-9, 1e-9])  # of the mean, and of its slopes
NOWHERE = np.full(1, math.nan), np.full((1, 2), math.nan)


def singular_matrix(family: Family) -> Condition:
    """Det A = 0, of an e-linear system."""

    def condition(v: Array) -> tuple[Array, Array]:
        jet = family.jet(0.0, 0.0, *v.tolist())
        a, b, c, d = jet[1], jet[2], jet[13], jet[14]
        slopes = [a * jet[k + 12 + 3] + d * jet[k] - b * jet[k + 12] - c * jet[k + 3] for k in (7, 8)]
        return np.array([a * d - b * c]), np.array([slopes])

    return condition


def neutral_equator(family: Family) -> Condition:
    """Find where the mean of lambda_rho/|Theta| over the equator is zero, of a closed equator (thm:geneps0(c)).

    Means over equally spaced angles, twice as many until they stand; NaNs where there are limit directions.
    """
    rows = family.unit_rows
    slopes = [[row.derivative(name) for name in AXES] for row in rows]
    enough = [FEW]

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
        return np.array(out) / np.abs(1.0 / turning).mean()  # a weighted mean of lambda_rho

    def condition(v: Array) -> tuple[Array, Array]:
        count = enough[0]  # for the last place: it is not far
        before = means(v, count)
        while before is not None and count < MANY:
            count *= 2
            now = means(v, count)
            if now is not None and (np.abs(now - before) <= SETTLED * (1.0 + np.abs(now))).all():
                enough[0] = max(count // 4, FEW)
                return now[:1], now[None, 1:]
            before = now
        return NOWHERE

    return condition
