"""The global sections of many e-linear systems at once, and a turn from each side by side in the lanes; see `section`.

Row i of every array is system i: what `Section` is for one of them.
"""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..layer_problem.border import CANCELS, to_all_digits
from ..psi.constructors import many
from ..psi.function import Psi
from .equator_pull import LEAST, LOST, SUNK
from .orbit import MOST_STEPS, gauss
from .section import INNER, LONGEST, SUNK_INWARD

Array = NDArray[np.float64]
Indices = NDArray[np.intp]

NODES = 4  # of a step: of its own order, 8; with more the means are the same
SIGNS = np.array([(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)])  # of the four rays, as in `section.rays`


def located(planes: Array) -> tuple[Array, Array]:
    """Find ``e_C = -A^-1 f`` (n, 2) and ``1 - |e_C|^2`` (n,) of (a, b, d, f1, f2) (n, 5), of any size.

    The complement is positive just where no theorem forbids cycles: a, d differ in sign, and C exists with det A > 0.
    """
    with np.errstate(all="ignore"):
        a, b, d, f1, f2 = np.ldexp(planes, -np.frexp(np.abs(planes).max(axis=1, keepdims=True))[1]).T
        det, n1, n2 = a * d + b * b, d * f1 + b * f2, a * f2 - b * f1
        gap = det * det - n1 * n1 - n2 * n2
        near = (np.abs(gap) < CANCELS * det * det) | (np.abs(det) < CANCELS * (np.abs(a * d) + b * b))
        if near.any():
            gap[near], det[near], n1[near], n2[near] = to_all_digits(*(v[near] for v in (a, -b, b, d, f1, f2)))
        room = (a * d < 0.0) & (det > 0.0)
        return np.stack([-n1 / det, -n2 / det], axis=1), np.where(room, gap / (det * det), -1.0)


@dataclass(frozen=True)
class Ways:
    """Turns of n systems as nodes of a quadrature, as `orbit.Path` has them for one; those of a system together.

    Attributes
    ----------
    first : Indices (n + 1,)
        Where the nodes of each begin; a step has NODES of them.
    whose : Indices (k,)
        The system of each node.
    h : ndarray (k/NODES,)
        Lengths of the steps in T.
    inner : ndarray (k, 3)
        States at the nodes.
    ends : ndarray (n, 3)
    """

    first: Indices
    whose: Indices
    h: Array
    inner: Array
    ends: Array


class Sections:
    """Sections of n systems that may have cycles.

    Parameters
    ----------
    planes : ndarray (n, 5)
        (a, b, d, f1, f2).
    e, complement : ndarray (n, 2), (n,)
        As `located` finds them, the complement positive.
    psi : Psi
    own : ndarray (n,), optional
        The parameter of each one's Psi, a member of the family of `psi`.
    ray : int, or ndarray of int (n,)
        Which of the four rays.
    """

    def __init__(
        self, planes: Array, e: Array, complement: Array, psi: Psi, own: Array | None, ray: int | Indices
    ) -> None:
        self.psi, self.own, self.e = psi, own, e
        size = np.abs(planes).max(axis=1)
        self.rate = size * np.sqrt(((planes / size[:, None]) ** 2).sum(axis=1))
        self.plane = planes / self.rate[:, None]
        a, _, d = np.abs(self.plane[:, :3]).T
        self.u = SIGNS[ray] * np.sqrt(np.stack([d, a], axis=1) / (a + d)[:, None])
        along = (self.u * e).sum(axis=1)
        root = np.sqrt(along * along + complement)
        reach = np.where(along > 0.0, complement / (root + np.abs(along)), root - along)
        self.room = np.stack([reach, complement / reach], axis=1)  # `reach` and `other` of `section.rays`
        modulus = np.minimum(np.hypot(e[:, 0], e[:, 1]), 1.0)
        self.zeta = self.psi_at().radius(modulus, np.clip(complement, 1e-300, 1.0))
        self.x2 = (self.zeta / np.maximum(modulus, 1e-300))[:, None] * e
        self.factors = np.stack(self.psi_at().jacobian_factors(self.zeta), axis=1)  # of D e_Psi: radial, tangential
        radial, tangential = self.factors.T
        along = along / np.maximum(modulus, 1e-300)
        #: Distance from C in x2 of the innermost sample, to first order.
        self.inner = INNER * reach * (1.0 / tangential + along * along * (1.0 / radial - 1.0 / tangential))

    def __len__(self) -> int:
        return len(self.plane)

    def taken(self, rows: Indices) -> Sections:
        """Return some of them."""
        some = copy(self)
        for name in ("rate", "plane", "e", "u", "room", "zeta", "x2", "factors", "inner"):
            setattr(some, name, getattr(self, name)[rows])
        some.own = None if self.own is None else self.own[rows]
        return some

    @property
    def trace(self) -> Array:
        """Tr J at C (n,), in units of `rate`."""
        (a, _, d, *_), (radial, tangential) = self.plane.T, self.factors.T
        square = (self.x2 / np.maximum(self.zeta, 1e-300)[:, None]) ** 2
        return tangential * (a + d) + (radial - tangential) * (a * square[:, 0] + d * square[:, 1])

    def psi_at(self, rows: Indices | None = None) -> Psi:
        """Return Psi for arrays with an entry for each system, or for those of the given rows."""
        if self.own is None:
            return self.psi
        return many(self.psi, self.own if rows is None else self.own[rows])

    def starts(self, xi: Array) -> tuple[Array, Array]:
        """Find r, reach - r and ``1 - |e|^2`` (n, 3), and x2 (n, 2), at parameters (n,) of the sections."""
        reach, other = self.room.T
        r, rest = reach / (1.0 + np.exp(-xi)), reach / (1.0 + np.exp(xi))
        gap = rest * (r + other)
        e = self.e + r[:, None] * self.u
        modulus = np.minimum(np.hypot(e[:, 0], e[:, 1]), 1.0)
        zeta = self.psi_at().radius(modulus, np.clip(gap, 1e-300, 1.0))
        return np.stack([r, rest, gap], axis=1), (zeta / np.maximum(modulus, 1e-300))[:, None] * e

    def shared(self, backward: NDArray[np.bool_]) -> Array:
        """Parameters (n, SHARED) of the compiled field of each lane."""
        from ..stepping.numbers import PSI, SHARED

        found = np.zeros((len(self), SHARED))
        found[:, :5] = np.where(backward[:, None], -self.plane, self.plane)
        found[:, PSI] = self.psi.parameter if self.own is None else self.own
        return found

    @property
    def field(self) -> Any:
        """The compiled field of lanes with systems of their own."""
        from ..stepping.fields import field_of_each

        return field_of_each(self.psi, self.own is None)

    def turned(
        self, states: Array, rtol: float, backward: NDArray[np.bool_], limit: int = MOST_STEPS
    ) -> tuple[Indices, Ways | None]:
        """Follow one turn from states (n, 3); None where none returns within `limit` steps.

        Returns
        -------
        rows : Indices (k,)
            Of the systems whose turns return.
        ways : Ways
            Their turns.
        """
        from .return_map import RETURNED, reached, returns

        shared, field = self.shared(backward), self.field
        x2 = states[:, :2] / states[:, 2:]
        near = np.minimum(self.inner, np.hypot(*(x2 - self.x2).T))
        lost = np.minimum(SUNK, np.maximum(LOST, LEAST / np.maximum(LEAST, np.minimum(states[:, 2], 1.0))))
        sense = np.where(backward, -self.plane[:, 1], self.plane[:, 1])
        u, centre = np.ascontiguousarray(self.u), np.ascontiguousarray(self.x2)
        ends, _, codes, steps = returns(
            states, shared, field.address, u, centre, sense, SUNK_INWARD * near, lost, LONGEST, rtol, limit,
            len(self) * limit, False,
        )  # fmt: skip
        rows = np.flatnonzero(codes == RETURNED)
        if not len(rows):
            return rows, None
        whose = steps[:, 4].astype(np.intp)
        order = np.argsort(whose, kind="stable")
        order = order[codes[whose[order]] == RETURNED]
        h, whose = steps[order, 3], np.repeat(whose[order], NODES)
        nodes, _, _ = gauss(NODES)
        inner = reached(
            np.repeat(steps[order, :3], NODES, axis=0), np.outer(h, nodes).ravel(), shared, whose, field.address
        )
        first = np.append(np.searchsorted(whose, rows), len(whose))
        return rows, Ways(first, np.searchsorted(rows, whose), h, inner, ends[rows])
