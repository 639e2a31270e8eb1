"""The class of a portrait, all that stays as it is between bifurcations of the equilibria, over any parameters.

A class is a number, `UNDEFINED` where U has no value.

`class_line` is what an atlas is where there is no second parameter. `NeighbouringPortraits` are those on either side of
a degenerate setting.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...portrait.classify import portrait_name
from ...portrait.layer_problem.problem import LayerProblem
from ...portrait.layer_problem.vary import check_varying, names, value_of, vary
from ...results.arrays import Array
from ...results.result import Tabled
from ...results.tables import table_number
from ...systems.kinds import as_elinear
from ...systems.psi.function import Psi
from .equilibrium_branches import equilibrium_branches
from .states import State

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

    They end at the special values of `branches`; in between, the class is computed once.

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


Codes = NDArray[np.int64]

UNDEFINED = -1  # U has no value there


class PortraitClass(NamedTuple):
    """The class of a portrait."""

    # kinds of limit directions (`EquatorEquilibria.kind`), and how many there are of each
    directions: tuple[tuple[str, int], ...]
    arcs: int  # arcs of limit directions; -1 where every direction is one
    sets: tuple[str, ...]  # kinds of the critical sets, in order
    closed: int | None  # sign of the exponent of a closed equator

    def radial(self, word: str) -> int:
        """Return the number of limit directions that are radially so."""
        return sum(many for kind, many in self.directions if kind.startswith(f"radially {word}"))


class Classes:
    """Classes of a system over some of its parameters, numbered as they are met."""

    def __init__(self, system: Any, psi: Psi, z: Any, names: Sequence[str]) -> None:
        self.unproved = 0
        self._names, self._of = names, (system, psi, z)
        self._classes: list[PortraitClass] = []
        self._plain = as_elinear(system) is not None

    def decided(self, at: Array) -> Codes:
        """Return classes at points (k, n)."""
        return np.array([self._decided(place) for place in at.tolist()], np.int64)

    def _decided(self, place: list[float]) -> int:
        try:
            of = self._of
            for name, value in zip(self._names, place, strict=True):
                of = vary(*of, name, value)
            system, psi, z = of
            state = State(LayerProblem(system.at(z), psi), place[-1])
        except ValueError:  # U is not finite there
            return UNDEFINED
        arcs = -1 if state.equator.all_directions else len(state.equator.arcs)
        sets = tuple(sorted(C.kind for C in state.critical))
        portrait = PortraitClass(tuple(sorted(state.parts[0].items())), arcs, sets, state.parts[2])
        if self._plain:  # name and kind of the critical set say all
            portrait = PortraitClass((("", len(state.equator)),) if len(state.equator) else (), arcs, sets, None)
        self.unproved += not state.proven
        if portrait not in self._classes:
            self._classes.append(portrait)
        return self._classes.index(portrait)

    def name(self, code: int) -> str:
        """Name a class, as `Classification.name` names e-linear portraits."""
        if code == UNDEFINED:
            return "undefined"
        return _name(self._classes[code])


def classes_over(
    system: Any, psi: Psi, z: ArrayLike, varying: Sequence[str], spans: Sequence[Sequence[float]]
) -> Classes:
    """Return the classes of a system over some names."""
    return Classes(system, psi, z, check_varying(system, psi, z, varying, spans))


def _name(portrait: PortraitClass) -> str:
    directions = "∞" if portrait.arcs < 0 else str(sum(many for _, many in portrait.directions))
    kinds = Counter(portrait.sets)
    counted = [kind if many == 1 else f"{many} {_several(kind)}" for kind, many in kinds.items()]
    head = "NCM" if not portrait.sets else "CM" if len(portrait.sets) == 1 else f"{len(portrait.sets)}CM"
    name = ", ".join([f"{head}{directions}", *counted])
    arriving, leaving = portrait.radial("attracting"), portrait.radial("repelling")
    if portrait.closed is not None:
        way = {-1: "attracts", 0: "is neutral", 1: "repels"}[portrait.closed]
        return f"{name}; the equator {way}"
    if portrait.arcs > 0:
        name = f"{name}; {portrait.arcs} arc{'s' if portrait.arcs > 1 else ''}"
    words = [f"{arriving} arrive{'s' if arriving == 1 else ''}"] if arriving else []
    words += [f"{leaving} leave{'s' if leaving == 1 else ''}"] if leaving else []
    return f"{name}; {', '.join(words)}" if words else name


def _several(kind: str) -> str:
    for one, many in (("focus", "foci"), ("centre", "centres")):
        if one in kind:
            return kind.replace(one, many)
    return kind if kind == "degenerate" else f"{kind}s"
