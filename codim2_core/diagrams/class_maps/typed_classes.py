"""The classes of general systems over one or two parameters: one point after the other, each class numbered as met."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ...layer_problem.vary import vary
from ...psi.function import Psi
from ..sweep import UNDEFINED
from ..typed.state import State
from .classes import Array, Codes

__all__ = ["TypedClasses"]


class Portrait(NamedTuple):
    """What makes a class: all of it stays as it is between bifurcations of what stands still.

    Attributes
    ----------
    directions : tuple of (str, int)
        Kinds of limit directions (`EquatorEquilibria.kind`), and how many there are of each.
    arcs : int
        Arcs of limit directions; -1 where every direction is one.
    sets : tuple of str
        Kinds of the critical sets, in order.
    closed : int or None
        Sign of the exponent of a closed equator.
    """

    directions: tuple[tuple[str, int], ...]
    arcs: int
    sets: tuple[str, ...]
    closed: int | None

    @property
    def directed(self) -> int:
        """How many limit directions there are, but for arcs."""
        return sum(many for _, many in self.directions)

    @property
    def degree(self) -> int:
        """Sum of the indices of the critical sets: how often U turns along the equator."""
        return sum(-1 if kind == "saddle" else kind != "saddle-node" for kind in self.sets)

    def radial(self, word: str) -> int:
        """How many limit directions are radially so."""
        return sum(many for kind, many in self.directions if kind.startswith(f"radially {word}"))

    def of(self, ending: str) -> int:
        """How many critical sets are of a kind that ends, or begins, so."""
        return sum(kind.endswith(ending) or kind.startswith(ending) for kind in self.sets)


class TypedClasses:
    """Classes of any system over one or two parameters, see `classes.Named`.

    Parameters
    ----------
    system : System or Frozen
    psi : Psi
    z : (m,) floats
    names : sequence of str
        Of `layer_problem.vary.names`.
    """

    def __init__(self, system: Any, psi: Psi, z: Any, names: Sequence[str]) -> None:
        self.names = tuple("z1" if name == "z" else name for name in names)
        self.unproved = 0
        self._of = system, psi, z
        self._classes: list[Portrait] = []

    def decided(self, at: Array) -> Codes:
        """Classes at points, one after the other."""
        return np.array([self._decided(tuple(place)) for place in at.tolist()], np.int64)

    def _state(self, place: tuple[float, ...]) -> State:
        of = self._of
        for name, value in zip(self.names[:-1], place[:-1], strict=True):
            of = vary(*of, name, value)
        system, psi, z = of
        return State(system, psi, self.names[-1], place[-1], z)

    def _decided(self, place: tuple[float, ...]) -> int:
        try:
            state = self._state(place)
        except ValueError:  # U is not finite there
            return UNDEFINED
        portrait = Portrait(_directions(state), _arcs(state), _sets(state), state.part(2))
        self.unproved += not state.proven
        if portrait not in self._classes:
            self._classes.append(portrait)
        return self._classes.index(portrait)

    def happening(self, before: int, after: int) -> tuple[str, ...]:
        """Name what happens between two classes."""
        if before == after:
            return ()
        if UNDEFINED in (before, after):
            return ("undefined",)
        return _happening(self._classes[before], self._classes[after])

    def name(self, code: int) -> str:
        """Name a class, as `Classification.name` names e-linear portraits."""
        return "undefined" if code == UNDEFINED else _name(self._classes[code])


def _directions(state: State) -> tuple[tuple[str, int], ...]:
    kinds: Mapping[str, int] = state.part(0)
    return tuple(sorted(kinds.items()))


def _arcs(state: State) -> int:
    return -1 if state.equator.all_directions else len(state.equator.arcs)


def _sets(state: State) -> tuple[str, ...]:
    return tuple(sorted(C.kind for C in state.critical))


def _happening(one: Portrait, other: Portrait) -> tuple[str, ...]:
    found = []
    if one.directed != other.directed or one.arcs != other.arcs:
        found.append("saddle-node")
    if one.degree != other.degree:
        found.append("transcritical")
    elif len(one.sets) != len(other.sets):
        found.append("fold")
    elif one.sets != other.sets:
        if one.of("stable") != other.of("stable") or one.of("centre") != other.of("centre"):
            found.append("Hopf")
        if one.of("node") != other.of("node"):
            found.append("node-focus")
    if None not in (one.closed, other.closed) and one.closed != other.closed:
        found.append("neutral equator")
    if not found:
        found.append("transcritical" if one.radial("attracting") != other.radial("attracting") else "change")
    return tuple(found)


def _name(portrait: Portrait) -> str:
    directions = "∞" if portrait.arcs < 0 else str(portrait.directed)
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
