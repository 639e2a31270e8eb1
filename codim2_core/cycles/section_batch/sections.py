"""The global sections of many e-linear systems at once, and a turn from each in the lanes; see `global_section`.

Row i of every array is system i: what `Section` is for one of them.
"""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...arrays import Array
from ...psi.constructors import many
from ...psi.function import Psi
from ..global_section import MAX_TURN_TIME
from ..periodic_orbit import MOST_STEPS, gauss

Indices = NDArray[np.intp]

STEP_NODES = 4  # of a step: of its own order, 8; with more the means are the same
RAY_SIGNS = np.array([(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)])  # of the four rays, as in `section.rays`


def critical_points(planes: Array) -> tuple[Array, Array]:
    """Find ``e_C = -A^-1 f`` (n, 2) and ``1 - |e_C|^2`` (n,) of planes (n, 5): see `geometry.critical_points`."""
    from . import geometry

    return geometry.critical_points(np.ascontiguousarray(planes, float))


@dataclass(frozen=True)
class TurnQuadratures:
    """The turns of n systems as nodes of a quadrature, by system; `periodic_orbit.TurnQuadrature` is that of one.

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
        As `critical_points` finds them, the complement positive.
    psi : Psi
    own : ndarray (n,), optional
        The parameter of each one's Psi, a member of the family of `psi`.
    ray : int, or ndarray of int (n,)
        Which of the four rays.
    """

    def __init__(
        self, planes: Array, e: Array, complement: Array, psi: Psi, own: Array | None, ray: int | Indices
    ) -> None:
        from . import geometry

        self.psi, self.own, self.e = psi, own, e
        signs = RAY_SIGNS[np.broadcast_to(ray, len(planes))]
        planes = np.ascontiguousarray(planes)
        self.rate, self.plane, self.u, self.room, sides = geometry.rays(planes, e, complement, signs)
        self.zeta = self.psi_at().radius(sides[:, 0], np.clip(complement, 1e-300, 1.0))
        factors = self.psi_at().jacobian_factors(self.zeta)
        #: x2 of C; eigenvalues of D e_Psi there, radial and tangential; and the distance from it in x2 of the innermost
        #: sample, to first order.
        self.x2, self.factors, self.inner = geometry.linearise_at_critical(e, sides, self.room, self.zeta, *factors)

    def __len__(self) -> int:
        return len(self.plane)

    def select(self, rows: Indices) -> Sections:
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
        from . import geometry

        parts, e, modulus = geometry.section_points(self.e, self.u, self.room, xi)
        zeta = self.psi_at().radius(modulus, np.clip(parts[:, 2], 1e-300, 1.0))
        return parts, (zeta / np.maximum(modulus, 1e-300))[:, None] * e

    @property
    def field(self) -> Any:
        """The compiled field of lanes with systems of their own."""
        from ...stepping.fields import field_of_each

        return field_of_each(self.psi, self.own is None)

    def integrate_turns(
        self, states: Array, rtol: float | Array, backward: NDArray[np.bool_], limit: int = MOST_STEPS
    ) -> tuple[Indices, TurnQuadratures | None]:
        """Follow one turn from states (n, 3), to one rtol or each to its own (n,).

        None where none returns within `limit` steps.

        Returns
        -------
        rows : Indices (k,)
            Of the systems whose turns return.
        ways : TurnQuadratures
            Their turns.
        """
        from ...stepping.psi_gain import gain_parameters
        from ..global_section_kernel import returns
        from . import geometry

        field = self.field
        parameters, _kept = gain_parameters(
            self.psi, np.full(len(self), self.psi.parameter) if self.own is None else self.own
        )
        shared, sense, floor, sunk = geometry.lanes(self.plane, parameters, backward, states, self.x2, self.inner)
        ends, _, codes, steps = returns(
            states, shared, field.address, self.u, self.x2, sense, floor, sunk, MAX_TURN_TIME, np.atleast_1d(rtol),
            limit, len(self) * limit, False,
        )  # fmt: skip
        rows, first, h, whose, inner = geometry.collect_nodes(steps, codes, shared, gauss(STEP_NODES)[0], field.address)
        return rows, TurnQuadratures(first, whose, h, inner, ends[rows]) if len(rows) else None
