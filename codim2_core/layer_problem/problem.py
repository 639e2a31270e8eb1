"""The layer problem at one z under one Psi: what stands still in it, each found once, when it is asked for."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Any, TypeVar
from weakref import ref

from ..psi.function import Psi
from ..systems.frozen import AtZ
from .closed_equator import EquatorCycle, equator_cycle
from .critical import CriticalSet, sets_at
from .equator import EquatorEquilibria, equilibria_at
from .location import Location, locate

Result = TypeVar("Result")


def find_location(problem: LayerProblem) -> Location | None:
    """Decide where A e + f = 0, thm:lineps1(a); None if U is not e-linear."""
    return None if problem.at.affine is None else locate(problem.at)


def find_equator(problem: LayerProblem) -> EquatorEquilibria:
    """Find the limit directions, eq:equator_equilibria."""
    return equilibria_at(problem.at, problem.location).counted_from(problem.cut)


def find_equator_cycle(problem: LayerProblem) -> EquatorCycle | None:
    """Describe the equator as a closed orbit, thm:geneps0(c); None where it has equilibria."""
    on = problem.equator
    return None if len(on) or on.all_directions else equator_cycle(problem.at)


def find_critical(problem: LayerProblem) -> tuple[CriticalSet, ...]:
    """Find the critical sets, eq:critical_set."""
    return sets_at(problem.at, problem.psi, problem.location)


FREE = frozenset({find_location, find_equator, find_equator_cycle})  # of Psi


class LayerProblem:
    """The layer problem eq:LP of a system frozen at z, under Psi.

    What a module above this one finds in it is kept here too, `keep`: whoever is given the problem finds nothing twice.

    Parameters
    ----------
    at : AtZ
    psi : Psi
    cut : float
        Angle from which limit directions are counted: Q1 is the first at or after it.

    Examples
    --------
    >>> from codim2_core import ELinear, psi
    >>> problem = LayerProblem(ELinear(-2, 0, -1, (-0.5, 0)).at(), psi.constant())
    >>> len(problem.equator), problem.equator_cycle, problem.critical[0].kind
    (4, None, 'stable node')
    """

    def __init__(self, at: AtZ, psi: Psi, cut: float = 0.0) -> None:
        self.at, self.psi, self.cut = at, psi, cut
        self._kept: dict[Hashable, Any] = {}
        self._others: dict[Psi, LayerProblem] = {}  # made from this one
        self._base = ref(self)  # no cycles: a problem that nobody holds is gone at once

    def __reduce__(self) -> tuple[Any, ...]:
        """Be pickled, and copied, by what it is a problem of: what has been found stays here."""
        return LayerProblem, (self.at, self.psi, self.cut)

    def keep(self, find: Callable[[LayerProblem], Result]) -> Result:
        """Return ``find(self)``, computed once; `find` is a function of a module, not made anew for each call."""
        base = self._base() or self
        if find in FREE and base is not self:
            return base.keep(find)
        if find not in self._kept:
            self._kept[find] = find(self)
        return self._kept[find]

    def give(self, find: Callable[[LayerProblem], Result], result: Result | None) -> LayerProblem:
        """Keep what is known already as the result of `find`, unless it is None; return this problem."""
        if result is not None:
            self._kept[find] = result
        return self

    def under(self, psi: Psi) -> LayerProblem:
        """Return the layer problem of the same system under another Psi; what Psi has no say in is shared."""
        base = self._base() or self
        if base is not self:
            return base.under(psi)
        if psi == self.psi:
            return self
        if psi not in self._others:
            self._others[psi] = other = LayerProblem(self.at, psi, self.cut)
            other._base = ref(self)
        return self._others[psi]

    @property
    def location(self) -> Location | None:
        """Where A e + f = 0, thm:lineps1(a); None if U is not e-linear."""
        return self.keep(find_location)

    @property
    def equator(self) -> EquatorEquilibria:
        """The limit directions, eq:equator_equilibria."""
        return self.keep(find_equator)

    @property
    def equator_cycle(self) -> EquatorCycle | None:
        """The equator as a closed orbit, thm:geneps0(c); None where it has equilibria."""
        return self.keep(find_equator_cycle)

    @property
    def critical(self) -> tuple[CriticalSet, ...]:
        """The critical sets, eq:critical_set."""
        return self.keep(find_critical)
