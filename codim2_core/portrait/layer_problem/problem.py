"""The layer problem at one z under one Psi: its equilibria, each found once, when it is requested."""

from __future__ import annotations

from collections.abc import Callable
from functools import update_wrapper
from typing import Any, Generic, TypeVar
from weakref import ref

from ...systems.frozen import FrozenSystem
from ...systems.psi.function import Psi
from .closed_equator import EquatorCycle, equator_cycle
from .critical import CriticalSet, sets_at
from .equator import EquatorEquilibria, equilibria_at
from .linearisation import Location, locate

Result = TypeVar("Result")


class CachedFunction(Generic[Result]):
    """A function of a layer problem that each problem computes once: called again, it returns what was found."""

    def __init__(self, compute: Callable[[LayerProblem], Result], layer: str, of_psi: bool) -> None:
        self.compute, self.layer, self.of_psi = compute, layer, of_psi
        update_wrapper(self, compute)

    def __call__(self, problem: LayerProblem) -> Result:
        """Return what was found in a problem, or find it."""
        return problem.found[self] if self in problem.found else problem.keep(self)


def found_once(
    layer: str = "", *, of_psi: bool = True
) -> Callable[[Callable[[LayerProblem], Result]], CachedFunction[Result]]:
    """Decorate a function of a layer problem, so that each problem keeps its result (`CachedFunction`)."""
    return lambda compute: CachedFunction(compute, layer, of_psi)


@found_once("location", of_psi=False)
def find_location(problem: LayerProblem) -> Location | None:
    """Decide where A e + f = 0, Theorem 4.1(a); None if U is not e-linear."""
    return None if problem.at.affine is None else locate(problem.at)


@found_once("equator", of_psi=False)
def find_equator(problem: LayerProblem) -> EquatorEquilibria:
    """Find the limit directions, (2.15)."""
    return equilibria_at(problem.at, problem.location).counted_from(problem.cut)


@found_once("equator_cycle", of_psi=False)
def find_equator_cycle(problem: LayerProblem) -> EquatorCycle | None:
    """Describe the equator as a closed orbit, Theorem 3.1(c); None where it has equilibria."""
    on = problem.equator
    return None if len(on) or on.all_directions else equator_cycle(problem.at)


@found_once("critical")
def find_critical(problem: LayerProblem) -> tuple[CriticalSet, ...]:
    """Find the critical sets, (3.22)."""
    return sets_at(problem.at, problem.psi, problem.location)


class LayerProblem:
    """The layer problem (3.26) of a frozen system under Psi, with what was found in it; Q1 is the first from `cut`."""

    def __init__(self, at: FrozenSystem, psi: Psi, cut: float = 0.0) -> None:
        self.at, self.psi, self.cut = at, psi, cut
        self.found: dict[CachedFunction[Any], Any] = {}
        self._others: dict[Psi, LayerProblem] = {}  # made from this one
        self._base = ref(self)  # no cycles: a problem that nobody holds is gone at once

    def __reduce__(self) -> tuple[Any, ...]:
        """Be pickled, and copied, by what it is a problem of: what has been found stays here."""
        return LayerProblem, (self.at, self.psi, self.cut)

    def keep(self, finding: CachedFunction[Result]) -> Result:
        """Return what was found in this problem, or find it and keep it."""
        base = self._base() or self
        if not finding.of_psi and base is not self:
            return base.keep(finding)
        if finding not in self.found:
            self.found[finding] = finding.compute(self)
        return self.found[finding]

    def give(self, finding: CachedFunction[Result], result: Result | None) -> LayerProblem:
        """Keep what is known already, unless it is None; return this problem."""
        if result is not None:
            self.found[finding] = result
        return self

    def with_psi(self, psi: Psi) -> LayerProblem:
        """Return the layer problem of the same system under another Psi; what Psi has no say in is shared."""
        base = self._base() or self
        if base is not self:
            return base.with_psi(psi)
        if psi == self.psi:
            return self
        if psi not in self._others:
            self._others[psi] = other = LayerProblem(self.at, psi, self.cut)
            other._base = ref(self)
        return self._others[psi]

    @property
    def location(self) -> Location | None:
        """Return the solution of A e + f = 0, Theorem 4.1(a); None if U is not e-linear."""
        return find_location(self)

    @property
    def equator(self) -> EquatorEquilibria:
        """The limit directions, (2.15)."""
        return find_equator(self)

    @property
    def equator_cycle(self) -> EquatorCycle | None:
        """The equator as a closed orbit, Theorem 3.1(c); None where it has equilibria."""
        return find_equator_cycle(self)

    @property
    def critical(self) -> tuple[CriticalSet, ...]:
        """The critical sets, (3.22)."""
        return find_critical(self)
