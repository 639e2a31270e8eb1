"""Equations of each kind of curve, with derivatives: in (theta, u, v) on the equator, in (c, s, u, v) within it.

With n = e and t across it on the equator, Theta = t.U, and by theta

    Theta'  = t.DU t - n.U,    Theta'' = t.D²U(t, t) - 2 n.DU t - t.DU n - t.U.

Within, J has the determinant of DU times a positive factor, and tr J is a positive factor times

    T = tr DU - (1 - sigma) n.DU n = tr DU - bend e.DU e,    sigma = 1 - bend |e|^2 (`Family.ratio`):

so for a row of `special_kinds` that is T = 0, or T^2 = level^2 sigma det DU. U and its derivatives are plain numbers:
arrays of two would take ten times as long.

Equations of curves without a place on the portrait: functions of both parameters alone.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache

import numpy as np

from ...numerics.arclength import Condition
from ...results.arrays import Array
from ...results.special_kinds import SpecialKind
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
    """Find where the mean of lambda_rho/|Theta| over a closed equator is zero (Theorem 3.1(c)); else NaN."""
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


DIFFERENCE_STEP = 1e-5  # for derivatives of Theta''


class EquatorEquations:
    """U on the equator at a place (theta, u, v).

    Attributes
    ----------
    turning, slope, curvature : float
        Theta, Theta', Theta''.
    radial : float
        lambda_rho.
    determinant : float
        Det DU.
    U : (float, float)
    U_slopes : ndarray (2, 3)
    turning_by, slope_by : (float, float)
        Derivatives of Theta and Theta' by u and v.
    """

    def __init__(self, family: SystemFamily, v: Array) -> None:
        theta, across, up = v.tolist()
        c, s = math.cos(theta), math.sin(theta)
        U, Uc, Us, Uu, Uv, Ucc, Ucs, Ucu, Ucv, Uss, Usu, Usv, *rest = family.jet(c, s, across, up)
        V, Vc, Vs, Vu, Vv, Vcc, Vcs, Vcu, Vcv, Vss, Vsu, Vsv = rest
        Ut, Vt = c * Us - s * Uc, c * Vs - s * Vc  # DU t
        self.turning, self.radial = c * V - s * U, c * U + s * V
        self.slope = c * Vt - s * Ut - self.radial
        twice_U, twice_V = (
            s * s * cc - 2.0 * s * c * cs + c * c * ss for cc, cs, ss in ((Ucc, Ucs, Uss), (Vcc, Vcs, Vss))
        )
        spin = c * (c * Vc + s * Vs) - s * (c * Uc + s * Us)  # t.DU n
        self.curvature = c * twice_V - s * twice_U - 2.0 * (c * Ut + s * Vt) - spin - self.turning
        self.determinant = Uc * Vs - Us * Vc
        self.U = U, V
        self.U_slopes = np.array([[Ut, Uu, Uv], [Vt, Vu, Vv]])
        self.turning_by = c * Vu - s * Uu, c * Vv - s * Uv
        self.slope_by = (
            c * (c * Vsu - s * Vcu) - s * (c * Usu - s * Ucu) - c * Uu - s * Vu,
            c * (c * Vsv - s * Vcv) - s * (c * Usv - s * Ucv) - c * Uv - s * Vv,
        )


def saddle_node(family: SystemFamily) -> Condition:
    """Theta = Theta' = 0."""

    def condition(v: Array) -> tuple[Array, Array]:
        at = EquatorEquations(family, v)
        return np.array([at.turning, at.slope]), np.array([[at.slope, *at.turning_by], [at.curvature, *at.slope_by]])

    return condition


def pitchfork(family: SystemFamily) -> Condition:
    """Theta' = Theta'' = 0: where a symmetry keeps Theta = 0 along the curve, Theta does not tell."""

    def condition(v: Array) -> tuple[Array, Array]:
        at = EquatorEquations(family, v)
        second = [
            (EquatorEquations(family, v + h).curvature - EquatorEquations(family, v - h).curvature)
            / (2.0 * DIFFERENCE_STEP)
            for h in DIFFERENCE_STEP * np.eye(3)
        ]
        return np.array([at.slope, at.curvature]), np.array([[at.curvature, *at.slope_by], second])

    return condition


def through_equator(family: SystemFamily) -> Condition:
    """U = 0 on the equator."""

    def condition(v: Array) -> tuple[Array, Array]:
        at = EquatorEquations(family, v)
        return np.array(at.U), at.U_slopes

    return condition


def equator_corner(family: SystemFamily) -> Condition:
    """U = 0 and Theta' = 0 on the equator."""

    def condition(v: Array) -> tuple[Array, Array]:
        at = EquatorEquations(family, v)
        return np.array([*at.U, at.slope]), np.vstack([at.U_slopes, (at.curvature, *at.slope_by)])

    return condition


class InteriorEquations:
    """U at a place (c, s, u, v) within the equator.

    Attributes
    ----------
    U : ndarray (2,)
    U_slopes : ndarray (2, 4)
    determinant : float
        Det DU.
    determinant_slopes : list of float (4,)
    """

    def __init__(self, family: SystemFamily, v: Array) -> None:
        c, s, across, up = v.tolist()
        U, Uc, Us, Uu, Uv, Ucc, Ucs, Ucu, Ucv, Uss, Usu, Usv, *rest = family.jet(c, s, across, up)
        V, Vc, Vs, Vu, Vv, Vcc, Vcs, Vcu, Vcv, Vss, Vsu, Vsv = rest
        self.U, self.U_slopes = np.array([U, V]), np.array([[Uc, Us, Uu, Uv], [Vc, Vs, Vu, Vv]])
        self.determinant = Uc * Vs - Us * Vc
        self._e, self._D = (c, s), (Uc, Us, Vc, Vs)
        # derivatives of the four entries of DU
        self._DD = (Ucc, Ucs, Ucu, Ucv), (Ucs, Uss, Usu, Usv), (Vcc, Vcs, Vcu, Vcv), (Vcs, Vss, Vsu, Vsv)

    @property
    def determinant_slopes(self) -> list[float]:
        """Derivatives of det DU."""
        (a, b, c, d), every = self._D, zip(*self._DD, strict=True)
        return [a * dd + d * da - b * dc - c * db for da, db, dc, dd in every]

    @property
    def larger_row(self) -> int:
        """The larger row of DU."""
        a, b, c, d = self._D
        return int(a * a + b * b < c * c + d * d)

    def along_null(self, row: int) -> float:
        """Return the derivative of det DU along the vector across a row of DU: where det DU = 0, its null vector."""
        across, up = self.determinant_slopes[:2]
        one, other = self._D[2 * row : 2 * row + 2]
        return up * one - across * other

    def along_range(self) -> tuple[float, list[float]]:
        """Return the product of U and the larger column of DU, and its derivatives."""
        (a, b, c, d), (U, V) = self._D, self.U.tolist()
        column = int(a * a + c * c < b * b + d * d)
        one, other = (b, d) if column else (a, c)
        rise, climb = self._DD[column], self._DD[2 + column]
        slopes = self.U_slopes.tolist()
        by = [one * p + other * q + U * r + V * t for p, q, r, t in zip(*slopes, rise, climb, strict=True)]
        return one * U + other * V, by

    def trace(self, bend: float) -> float:
        """Return T."""
        (x, y), (a, b, c, d) = self._e, self._D
        return a + d - bend * (x * x * a + x * y * (b + c) + y * y * d)

    def trace_slopes(self, bend: float, by_square: float, by_parameters: tuple[float, float]) -> list[float]:
        """Return the derivatives of T."""
        (x, y), (a, b, c, d) = self._e, self._D
        along = x * x * a + x * y * (b + c) + y * y * d
        out = [
            da + dd - bend * (x * x * da + x * y * (db + dc) + y * y * dd)
            for da, db, dc, dd in zip(*self._DD, strict=True)
        ]
        out[0] -= 2.0 * by_square * along * x + bend * (2.0 * x * a + y * (b + c))
        out[1] -= 2.0 * by_square * along * y + bend * (2.0 * y * d + x * (b + c))
        out[2] -= by_parameters[0] * along
        out[3] -= by_parameters[1] * along
        return out


def fold(family: SystemFamily) -> Condition:
    """U = 0 and det J = 0."""

    def condition(v: Array) -> tuple[Array, Array]:
        at = InteriorEquations(family, v)
        return np.append(at.U, at.determinant), np.vstack([at.U_slopes, at.determinant_slopes])

    return condition


def pitchfork_of_sets(family: SystemFamily) -> Condition:
    """U along the range of DU, det J, and the derivative of that along the null vector of DU.

    Where a symmetry keeps U = 0 along the curve, U and det J have no regular zero: the part of U across that range
    does not tell.
    """

    def condition(v: Array) -> tuple[Array, Array]:
        at = InteriorEquations(family, v)
        along, slopes = at.along_range()
        row = at.larger_row
        by = [
            (InteriorEquations(family, v + h).along_null(row) - InteriorEquations(family, v - h).along_null(row))
            / (2.0 * DIFFERENCE_STEP)
            for h in DIFFERENCE_STEP * np.eye(4)
        ]
        return np.array([along, at.determinant, at.along_null(row)]), np.array([slopes, at.determinant_slopes, by])

    return condition


def of_kind(family: SystemFamily, kind: SpecialKind) -> Condition:
    """U = 0, and tr J at the level of a row: T = 0, or T^2 = level^2 sigma det DU."""
    if not kind.level:

        def neutral(v: Array) -> tuple[Array, Array]:
            at, ratio = InteriorEquations(family, v), family.ratio(float(v[:2] @ v[:2]), v[2:])
            return np.append(at.U, at.trace(ratio.bend)), np.vstack([at.U_slopes, at.trace_slopes(*ratio)])

        return neutral
    square_level = kind.level**2

    def condition(v: Array) -> tuple[Array, Array]:
        square = float(v[:2] @ v[:2])
        at, ratio = InteriorEquations(family, v), family.ratio(square, v[2:])
        det, trace, sigma = at.determinant, at.trace(ratio.bend), 1.0 - ratio.bend * square
        rise = -2.0 * (ratio.by_square * square + ratio.bend)
        sigma_slopes = [rise * float(v[0]), rise * float(v[1]), *(-r * square for r in ratio.by_parameters)]
        slopes = [
            2.0 * trace * t - square_level * (sigma * d + det * g)
            for t, d, g in zip(at.trace_slopes(*ratio), at.determinant_slopes, sigma_slopes, strict=True)
        ]
        return np.append(at.U, kind.function(trace, sigma * det)), np.vstack([at.U_slopes, slopes])

    return condition
