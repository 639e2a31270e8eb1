"""The classes along one parameter: what an atlas is where there is no second one.

`NeighbouringPortraits` are those on either side of a degenerate setting.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...portrait.classify import portrait_name
from ...portrait.layer_problem.problem import LayerProblem
from ...portrait.layer_problem.vary import names, value_of, vary
from ...results.result import Tabled
from ...results.tables import table_number
from ...systems.psi.function import Psi
from .classes import classes_over
from .equilibrium_branches import equilibrium_branches

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


__all__ = ["ClassInterval", "class_line"]

OFF_CENTRE = 0.4567  # of a stretch: in its middle symmetry likes to put something special
_SAME_VALUE_SHARE = 1e-9  # of the span: special values nearer to each other than this are one


@dataclass(frozen=True)
class ClassInterval(Tabled):
    """A stretch of a parameter on which the portrait has one class."""

    _head_ = ("portrait", "from", "to", "what happens there")

    name: str
    low: float
    high: float
    happening: tuple[str, ...]

    def _row_(self) -> tuple[str, ...]:
        return self.name, table_number(self.low), table_number(self.high), ", ".join(self.happening)


def class_line(system: Any, psi: Psi, name: str, span: Sequence[float], z: ArrayLike = ()) -> tuple[ClassInterval, ...]:
    """Stretches of equal class along one parameter (Section 4.4).

    They end at the special values of `bifurcation_diagram`; in between, the class is computed once.

    By rising values; neighbours differ. Raises ValueError: The name cannot be varied, the span is empty, or z does
    not fit. Shapes: z (m,).
    """
    found = equilibrium_branches(system, psi, name, span, z)
    low, high = found.span
    values = [one.value for one in found.special] + [v for gap in found.gaps for v in gap]
    ends = [low]
    for value in sorted(values):
        if value - ends[-1] > _SAME_VALUE_SHARE * (high - low) and high - value > _SAME_VALUE_SHARE * (high - low):
            ends.append(value)
    ends.append(high)
    classes = classes_over(system, psi, z, (name,), (found.span,))
    middles = np.array([[u + OFF_CENTRE * (v - u)] for u, v in pairwise(ends)])
    codes = classes.decided(middles).tolist()
    stretches: list[ClassInterval] = []
    start = low
    for i, (code, end) in enumerate(zip(codes, ends[1:], strict=True)):
        after = codes[i + 1] if i + 1 < len(codes) else None
        if after != code:
            near = {
                one.kind: None
                for one in found.special
                if abs(one.value - end) <= 2.0 * _SAME_VALUE_SHARE * (high - low)
            }
            what = () if after is None else tuple(near) or ("undefined",)
            stretches.append(ClassInterval(classes.name(code), start, end, what))
            start = end
    return tuple(stretches)
