"""The classes of general systems over one or two parameters: one point after the other, each class numbered as met."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from ...layer_problem.vary import varied
from ...psi.function import Psi
from ..sweep import UNDEFINED
from ..typed.state import State
from .classes import UNKNOWN, Array, Codes

__all__ = ["Samples", "TypedClasses"]


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


@dataclass(frozen=True, eq=False)
class Samples:
    """Points at which classes were computed.

    Attributes
    ----------
    classes : tuple of Portrait
        By number.
    places : tuple of (float, float)
    codes : tuple of int
    unproved : frozenset of int
        Points, by position, at which it is not proved that nothing is missed.
    """

    classes: tuple[Portrait, ...]
    places: tuple[tuple[float, ...], ...]
    codes: tuple[int, ...]
    unproved: frozenset[int]


class TypedClasses:
    """Classes of any system over one or two parameters, see `classes.Classes`.

    Parameters
    ----------
    system : System or Frozen
    psi : Psi
    z : (m,) floats
    names : sequence of str
        Of `layer_problem.vary.names`.
    known : Samples, optional
        Of an earlier one with the same arguments: they are not computed again.
    """

    most_cells = 4_000

    def __init__(self, system: Any, psi: Psi, z: Any, names: Sequence[str], known: Samples | None = None) -> None:
        self.names = tuple("z1" if name == "z" else name for name in names)
        self._of = system, psi, z
        self._classes: list[Portrait] = list(known.classes) if known else []
        self._numbers: dict[Portrait, int] = {portrait: i for i, portrait in enumerate(self._classes)}
        self._unproved: set[tuple[float, ...]] = {known.places[i] for i in known.unproved} if known else set()
        self._known: dict[tuple[float, ...], int] = dict(zip(known.places, known.codes, strict=True)) if known else {}

    @property
    def samples(self) -> Samples:
        """All that was computed for `decided`."""
        unproved = frozenset(i for i, place in enumerate(self._known) if place in self._unproved)
        return Samples(tuple(self._classes), tuple(self._known), tuple(self._known.values()), unproved)

    def decided(self, at: Array) -> tuple[Codes, Array]:
        """Classes, and no functions: the products of all that may come to zero cost more than the classes."""
        return np.array([self._decided(tuple(place)) for place in at.tolist()], np.int64), np.zeros((0, len(at)))

    def beside(self, at: Array, before: Codes, after: Codes) -> Codes:
        """`before` where the class is that, else `UNKNOWN`: only what is not the same in `after` is looked at."""
        rows = zip(at.tolist(), before.tolist(), after.tolist(), strict=True)
        return np.array([here if self._still(tuple(place), here, then) else UNKNOWN for place, here, then in rows])

    def _state(self, place: tuple[float, ...]) -> State:
        of = self._of
        for name, value in zip(self.names[:-1], place[:-1], strict=True):
            of = varied(*of, name, value)
        system, psi, z = of
        return State(system, psi, self.names[-1], place[-1], z)

    def _decided(self, place: tuple[float, ...]) -> int:
        if place not in self._known:
            try:
                state = self._state(place)
            except ValueError:  # U is not finite there
                self._known[place] = UNDEFINED
            else:
                portrait = Portrait(*(part(state) for part in _PARTS))
                if portrait not in self._numbers:
                    self._numbers[portrait] = len(self._classes)
                    self._classes.append(portrait)
                self._known[place] = self._numbers[portrait]
                if not state.proven:
                    self._unproved.add(place)
        return self._known[place]

    def _still(self, place: tuple[float, ...], before: int, after: int) -> bool:
        """Whether the class is `before` in all that `after` has otherwise."""
        try:
            state = self._state(place)
        except ValueError:
            return before == UNDEFINED
        if UNDEFINED in (before, after):
            return before != UNDEFINED
        rows = zip(_PARTS, self._classes[before], self._classes[after], strict=True)
        return all(part(state) == here for part, here, then in rows if here != then)

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


def _closed(state: State) -> int | None:
    return state.part(2)


_PARTS: tuple[Callable[[State], Any], ...] = (_directions, _arcs, _sets, _closed)  # of a `Portrait`, in its order


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
