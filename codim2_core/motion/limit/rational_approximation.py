"""Rational approximation of a function on an interval by AAA, by which it is continued into the complex plane.

Y. Nakatsukasa, O. Sete and L. N. Trefethen, "The AAA algorithm for rational approximation", SIAM J. Sci. Comput. 40,
A1494 (2018): barycentric, its support points chosen one after the other where the error is largest.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...results.arrays import Array, Complex

MAX_SUPPORT_POINTS = 40  # support points
MAX_DOUBLET_RESIDUE = 1e3  # in tolerances of |f| times the interval: poles of less are made by rounding


@dataclass(frozen=True, eq=False)
class RationalApproximation:
    """``sum w_j f_j/(t - t_j) / sum w_j/(t - t_j)``."""

    points: Array  # (k,) t_j, f_j and w_j
    values: Array
    weights: Array
    size: float  # largest |f|
    tolerance: float  # of size: how far it is from f where f was given

    def __call__(self, t: complex) -> complex:
        """Return the value at one place, infinite at a pole."""
        away = t - self.points
        if (away == 0.0).any():
            return complex(self.values[away == 0.0][0])
        share = self.weights / away
        whole = complex(share.sum())
        return complex(share @ self.values) / whole if whole else complex(math.inf)

    def zeros(self) -> Complex:
        """Return where it vanishes."""
        return self._roots(self.weights * self.values)

    def poles(self) -> Complex:
        """Return its poles, without those that rounding makes: pairs of a pole and a zero, of no residue."""
        found = self._roots(self.weights)
        away = found[:, None] - self.points
        residues = (self.weights * self.values / away).sum(axis=1) / -(self.weights / away**2).sum(axis=1)
        least = MAX_DOUBLET_RESIDUE * self.tolerance * self.size * float(np.ptp(self.points))
        return found[np.abs(residues) > least]

    def _roots(self, weights: Array) -> Complex:
        """Zeros of ``sum weights_j/(t - t_j)``: finite eigenvalues of an arrowhead pencil."""
        from scipy.linalg import eigvals  # imported late: it takes longer than all of this package

        k = len(self.points)
        arrow = np.diag(np.concatenate([[0.0], self.points]))
        arrow[0, 1:], arrow[1:, 0] = weights, 1.0
        found = np.asarray(eigvals(arrow, np.diag(np.concatenate([[0.0], np.ones(k)]))), complex)
        return found[np.isfinite(found)]


def approximate_rationally(t: Array, f: Array, tolerance: float) -> RationalApproximation | None:
    """Approximate f, given at t (n,), to a tolerance of its size; None where that takes too many points."""
    size = float(np.abs(f).max())
    chosen: list[int] = []
    approximation = np.full(len(f), f.mean())
    for _ in range(min(MAX_SUPPORT_POINTS, len(t) // 2)):
        chosen.append(int(np.argmax(np.abs(f - approximation))))
        rest = np.ones(len(t), bool)
        rest[chosen] = False
        cauchy = 1.0 / (t[rest, None] - t[chosen])
        loewner = (f[rest, None] - f[chosen]) * cauchy
        weights = np.linalg.svd(loewner, full_matrices=False)[2][-1]
        approximation = f.copy()
        approximation[rest] = cauchy @ (weights * f[chosen]) / (cauchy @ weights)
        if np.abs(f - approximation).max() <= tolerance * size:
            return RationalApproximation(t[chosen], f[chosen], weights, size, tolerance)
    return None
