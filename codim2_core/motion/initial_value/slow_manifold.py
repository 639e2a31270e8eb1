"""A critical set continued in z, by Newton's method with its exact derivative ``D_z e = -(D_e U)^-1 D_z U``."""

from __future__ import annotations

import math

import numpy as np

from ...results.arrays import Array
from ...systems.psi.function import Psi
from .field import Field

MAX_NEWTON, FURTHER = 12, 20  # iterations; and where there was a set a little before
MAX_CORRECTION = 0.6  # in e: no set is looked for if Newton's first step is longer
SAME_SET_DISTANCE = 1e-2  # in e: sets as near to each other are one


def solve_critical(
    field: Field, e: Array, z: Array, far: float = MAX_CORRECTION, most: int = MAX_NEWTON
) -> Array | None:
    """Critical set near e, by Newton's method; None where there is none near: a step is longer than `far`."""
    e, slow, before = np.array(e, float), z.tolist(), math.inf
    for _ in range(most):
        c, s = e.tolist()
        u, v = field.value(c, s, 0.0, 0.0, *slow)[:2]
        (j11, j12), (j21, j22) = field.jacobian(c, s, 0.0, 0.0, slow)[:2, :2].tolist()
        det = j11 * j22 - j12 * j21
        if det == 0.0 or det != det:
            return None
        change = np.array([j22 * u - j12 * v, j11 * v - j21 * u]) / det
        size = float(np.abs(change).max())
        if not size < far:
            return None
        e = e - change
        if size <= 1e-15 or (size <= 1e-11 and size >= 0.5 * before):
            return e
        before = size
    return None


class SlowManifold:
    """A critical set as a function of z, continued from the last state that was accepted."""

    def __init__(self, field: Field, e: Array, z: Array) -> None:
        self.field = field
        self.begin(np.array(e, float), np.array(z, float))

    def slopes(self, e: Array, z: Array) -> Array:
        """``D (U, W)`` by (c, s, x, y, z) on the set."""
        return self.field.jacobian(float(e[0]), float(e[1]), 0.0, 0.0, z.tolist())

    def at(self, z: Array) -> Array | None:
        """Return e at z, or None where the set is not found."""
        return solve_critical(self.field, self.e + self.slope @ (z - self.z), z, far=1.0, most=FURTHER)

    def joined(self, other: SlowManifold) -> bool:
        """Whether another one may be the same set: each is not far from where the slope of the other leads."""
        between = other.z - self.z
        leads = (self.slope @ between, other.slope @ between)
        far = other.e - self.e
        return all(np.abs(far - change).max() <= max(SAME_SET_DISTANCE, 0.5 * np.abs(change).max()) for change in leads)

    def move(self, z: Array) -> None:
        """Continue from z from now on."""
        e = self.at(z)
        if e is not None:
            D = self.slopes(e, z)
            self.e, self.z = e, np.array(z)
            (j11, j12), (j21, j22) = D[:2, :2].tolist()
            det = j11 * j22 - j12 * j21
            if det != 0.0:
                self.slope = np.array([[-j22, j12], [j21, -j11]]) / det @ D[:2, 4:]

    def begin(self, e: Array, z: Array) -> None:
        """Continue from e at z from now on."""
        self.e, self.z, self.slope = e, z, np.zeros((2, len(z)))
        self.move(z)


def complement(e: Array, reach: float = 1.0) -> float:
    """``1 - |e|^2``, or what is left to another reach."""
    r = math.hypot(e[0], e[1])
    return (reach - r) * (reach + r)


def determinant(sheet: SlowManifold, e: Array, z: Array) -> float:
    """Det of D_e U: the sign of det J."""
    (j11, j12), (j21, j22) = sheet.slopes(e, z)[:2, :2].tolist()
    return j11 * j22 - j12 * j21


def trace(sheet: SlowManifold, psi: Psi, e: Array, z: Array) -> float:
    """Tr J in units of the tangential eigenvalue of D e_Psi, which is positive: it has the sign of tr J."""
    D = sheet.slopes(e, z)[:2, :2]
    r, gap = math.hypot(e[0], e[1]), complement(e)
    if r == 0.0 or gap <= 0.0:  # the two eigenvalues of D e_Psi are equal in the centre; radial/tangential is 0 outside
        ratio, n = (1.0 if r == 0.0 else 0.0), e / (r or 1.0)
    else:
        radial, tangential = psi.jacobian_factors(psi.radius(min(r, 1.0), gap))
        ratio, n = radial / tangential, e / r
    return float(np.trace(D) + (ratio - 1.0) * (n @ D @ n))
