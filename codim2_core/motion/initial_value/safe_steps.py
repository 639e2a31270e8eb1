"""Steps of a slide along which it surely does not end: told for many at once, so that few have to be looked at closely.

What turns negative where a slide ends is taken at five points of each step, and bounded between them by the polynomial
through these, as `events.monotone_fractions` does.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...results.arrays import Array
from ...systems.psi.function import Psi
from .events import chebyshev_coefficients

SAFE_DEGREE = 4
LEFT_OUT = 8.0
FOLD_MARGIN = 1e-8  # det D_e U, or what turns with it in a line, in units of its entries: a smaller one counts as zero
SAFE_NODES = 0.5 - 0.5 * np.cos(math.pi * np.arange(SAFE_DEGREE + 1) / SAFE_DEGREE)
COEFFICIENTS = np.array([chebyshev_coefficients(row) for row in np.eye(SAFE_DEGREE + 1)])


def _stays_positive(values: Array) -> NDArray[np.bool_]:
    """Whether a gauge with these values (k, 5) is positive all along each of k steps.

    The polynomial is at least its mean less all its other coefficients; what it leaves out is less than a few times its
    last two, as the gauge is smooth along a step that has been accepted.
    """
    of = values @ COEFFICIENTS
    sizes = np.abs(of[:, 1:])
    return of[:, 0] > sizes.sum(axis=1) + LEFT_OUT * sizes[:, -2:].sum(axis=1)  # not for NaN


def dissipation(D: Array) -> Array:
    """Return the least rate (...) at which friction takes energy from slips: of -(D + D^T)/2, D = D_e U (..., 2, 2)."""
    a, d, b = D[..., 0, 0], D[..., 1, 1], 0.5 * (D[..., 0, 1] + D[..., 1, 0])
    return -0.5 * (a + d) - np.hypot(0.5 * (a - d), b)


@dataclass(frozen=True)
class StepRequirements:
    """Requirements on the steps of a slide."""

    psi: Psi
    sign: float  # of det D_e U where the slide begins
    n: Array | None  # (2,) Along the invariant line that the motion stays in
    reach: float = 1.0  # |e| up to which it slides: above 1 at rest by static friction, while D_e U is dissipative

    def steps(self, e: Array, D: Array) -> list[bool]:
        """Tell for k steps, with e (k, 5, 2) and D_e U (k, 5, 2, 2) at their `SAFE_NODES`."""
        r = np.hypot(e[..., 0], e[..., 1])
        gap = (1.0 - r) * (1.0 + r)
        safe = _stays_positive((self.reach - r) * (self.reach + r))
        margin = FOLD_MARGIN * np.abs(D).max(axis=(2, 3))
        if self.n is not None:
            return (safe & _stays_positive(-np.einsum("i,kdij,j->kd", self.n, D, self.n) - margin)).tolist()
        margin *= margin / FOLD_MARGIN
        safe &= _stays_positive(self.sign * (D[..., 0, 0] * D[..., 1, 1] - D[..., 0, 1] * D[..., 1, 0]) - margin)
        if self.reach > 1.0:
            return (safe & _stays_positive(dissipation(D))).tolist()
        if not safe.any():
            return safe.tolist()
        n = np.where(r[..., None] > 0.0, e / np.where(r > 0.0, r, 1.0)[..., None], (1.0, 0.0))
        radial = np.einsum("kdi,kdij,kdj->kd", n, D, n)
        across = D[..., 0, 0] + D[..., 1, 1] - radial
        stable = _stays_positive(-radial) & _stays_positive(
            -across
        )  # tr J is a sum of both, each times a positive number
        if not stable[safe].all():
            ratio, inside = np.ones_like(r), (r > 0.0) & (gap > 0.0)
            along, tangential = self.psi.jacobian_factors(self.psi.radius(np.minimum(r[inside], 1.0), gap[inside]))
            ratio[inside] = along / tangential
            stable |= _stays_positive(-(across + ratio * radial))
        return (safe & stable).tolist()
