"""The class of a portrait, all that stays as it is between bifurcations of the equilibria, over any parameters.

A class is a number, `UNDEFINED` where U has no value.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...portrait.layer_problem.problem import LayerProblem
from ...portrait.layer_problem.vary import check_varying, vary
from ...results.arrays import Array
from ...systems.kinds import as_elinear
from ...systems.psi.function import Psi
from .states import State

__all__ = ["UNDEFINED", "Classes", "classes_over"]

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
    """Return the classes of a system over some names.

    Raises ValueError: A name cannot be varied, a value is beyond what it may be, or z does not fit. Shapes: z (m,).
    """
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
