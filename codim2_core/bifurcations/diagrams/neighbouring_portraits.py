"""Portraits on either side of a degenerate setting, along one parameter."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from numpy.typing import ArrayLike

from ...portrait.classify import portrait_name
from ...portrait.layer_problem.problem import LayerProblem
from ...portrait.layer_problem.vary import names, value_of, vary
from ...systems.psi.function import Psi

SIDE_STEP = 1e-6  # of the value or of 1: far beyond rounding, far below what can be seen


@dataclass(frozen=True, slots=True)
class NeighbouringPortraits:
    """The portraits on both sides of a setting."""

    name: str  # what is varied
    below: str  # names of the portraits where it is a little smaller and larger; "" beyond the end of what is allowed
    above: str


def sides(system: Any, psi: Psi, z: ArrayLike = (), name: str = "") -> NeighbouringPortraits | None:
    """Return the names of the portraits a little below and a little above the present value of one thing.

    None if nothing can be varied. Shapes: z (m,).
    """
    known = names(system, psi, z)
    if name not in known:
        name = next((one for one in known if one != "n"), "")
    if not name:
        return None
    value = value_of(system, psi, z, name)
    step = SIDE_STEP * max(1.0, abs(value))
    found = []
    for moved in (value - step, value + step):
        try:
            other, family, place = vary(system, psi, z, name, moved)
            found.append(portrait_name(LayerProblem(other.at(place), family)).name)
        except ValueError:  # the end of what is allowed
            found.append("")
    return NeighbouringPortraits(name, *found)
