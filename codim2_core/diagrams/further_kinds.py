"""Special values of the kinds that part no names: by changes of sign of their test functions along the branches."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ..layer_problem.problem import LayerProblem
from ..layer_problem.vary import vary
from ..numerics.root_between import root_between
from ..psi.function import Psi
from ..special_kinds import SPECIAL_KINDS, SpecialKind
from .result import CriticalBranch, DirectionBranch, SpecialValue

__all__ = ["further_kinds"]


def further_kinds(
    system: Any, psi: Psi, along: str, z: ArrayLike, branches: Sequence[DirectionBranch | CriticalBranch]
) -> list[SpecialValue]:
    """Find the special values of the rows of `SPECIAL_KINDS` that part no names.

    Parameters
    ----------
    system, psi, along, z
        As of `bifurcation_diagram`.
    branches : sequence of DirectionBranch or CriticalBranch
    """
    found = []
    for kind in (one for one in SPECIAL_KINDS if not one.parts):
        for branch in branches:
            of, places, numbers = _test_numbers(branch)
            if of != kind.of:
                continue
            size, at_zero = kind.function(*numbers), kind.holds(*numbers)
            for i in np.flatnonzero((size[1:] * size[:-1] < 0.0) & at_zero[1:] & at_zero[:-1]).tolist():
                near = 0.5 * (places[i] + places[i + 1])

                def at(value: float, near: Array = near, kind: SpecialKind = kind) -> tuple[Array, float]:
                    there, psi_there, z_there = vary(system, psi, z, along, value)
                    p, *numbers = _nearest(LayerProblem(there.at(z_there), psi_there), kind.of, near)
                    return p, float(kind.function(*numbers))

                value = root_between(lambda v, at=at: at(v)[1], *branch.value[i : i + 2].tolist())
                p = at(value)[0]
                found.append(SpecialValue(kind.kind, value, (float(p[0]), float(p[1])), kind.says))
    return found


def _test_numbers(branch: DirectionBranch | CriticalBranch) -> tuple[str, Array, tuple[Array, Array]]:
    """Return what a branch is of, its places (k, 2) in the disc, and the two numbers of test functions."""
    if isinstance(branch, CriticalBranch):
        return "critical set", branch.p, (branch.trace, branch.determinant)
    return "limit direction", _on_circle(branch.theta), (branch.lambda_rho, branch.lambda_theta)


def _nearest(problem: LayerProblem, of: str, near: Array) -> tuple[Array, float, float]:
    """Return place and numbers of the critical set, or of the limit direction, nearest to a place."""
    if of == "critical set":
        C = min(problem.critical, key=lambda C: float(np.hypot(*(C.p - near))))
        return C.p, C.trace, C.determinant
    equator = problem.equator
    places = _on_circle(equator.theta)
    i = int(np.hypot(*(places - near).T).argmin())
    return places[i], float(equator.lambda_rho[i]), float(equator.lambda_theta[i])


def _on_circle(theta: Array) -> Array:
    return np.stack([np.cos(theta), np.sin(theta)], axis=-1)
