"""The result of `branches`: equilibria along one parameter, limit cycles, and special points."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ...portrait.theorems.point_accuracy import PointAccuracy, point_accuracy
from ...results.arrays import Array
from ...results.paper import label_of
from ...results.result import Pictured, Result, Tabled
from ...results.tables import html_table, paragraphs, table_number
from ...results.words import say
from ...systems.kinds import AnySystem
from ...systems.psi.function import Psi
from ..continuation.branch_ends import MarkedValue
from ..continuation.branches import continue_cycles
from ..continuation.result import CycleBranches, CyclePoint


def cycle_branches(
    system: Any,
    psi: Psi,
    along: str,
    spans: Sequence[tuple[float, float]],
    z: tuple[float, ...],
    marked: Sequence[MarkedValue],
) -> CycleBranches:
    """Continue the limit cycles along one parameter."""
    parts = [continue_cycles(system, psi, along, span, z, marked) for span in spans]
    if len(parts) == 1:
        return parts[0]
    whole = spans[0][0], spans[-1][1]
    reason = f" {say('elsewhere')} ".join(dict.fromkeys(part.reason for part in parts))
    notes = tuple(note for part in parts for note in part.notes)
    return CycleBranches(along, whole, tuple(branch for part in parts for branch in part), reason, notes)


_COLUMNS = (
    "theta", "lambda_rho", "lambda_theta", "c", "s", "p_x", "p_y", "trace", "determinant", "period", "amplitude",
    "exponent",
)  # fmt: skip
#: Special points of branches of cycles that the equilibria have already, or that are none of the system's.
UNREPORTED_KINDS = ("Hopf", "span", "closed")


@dataclass(frozen=True, eq=False, slots=True)
class SpecialValue(Tabled):
    """A value of the parameter where something changes.

    Attributes
    ----------
    kind : str
        "saddle-node", "pitchfork", "cusp", "exchange of limit directions", "all directions", "transcritical",
        "touching the equator", "Hopf", "tr J = 0", "node-focus", "det A = 0", "line of equilibria" or
        "neutral equator"; for general systems also "fold of critical sets", "det J = 0" and "change of critical sets"
        (one comes or goes alone).
    value : float
    place : (float, float)
        In the projected disc; on its border for what happens on the equator. (0, 0) where it is nowhere in particular.
    sentence : str
        For people.
    number : float
        For "Hopf" the first Lyapunov coefficient (negative: a stable cycle is born), else 0.
    """

    _head_ = ("at", "value", "what happens")

    kind: str
    value: float
    place: tuple[float, float]
    sentence: str
    number: float = 0.0

    @property
    def label(self) -> str:
        """The paper's label."""
        return label_of(self.kind)

    def _row_(self) -> tuple[str, ...]:
        return self.kind, table_number(self.value), self.sentence


@dataclass(frozen=True, eq=False)
class DirectionBranch(Result):
    """A limit direction along a piece on which its stability does not change (4.9).

    Attributes
    ----------
    value : ndarray (k,)
        Increasing.
    theta : ndarray (k,)
        Continuous along the branch, so it may leave [0, 2 pi).
    lambda_rho, lambda_theta : ndarray (k,)
    kind : str
        Such as "radially attracting, angularly repelling", as `EquatorEquilibria.kind`.
    """

    value: Array = field(repr=False)
    theta: Array = field(repr=False)
    lambda_rho: Array = field(repr=False)
    lambda_theta: Array = field(repr=False)
    kind: str


@dataclass(frozen=True, eq=False)
class ClosedEquator(Result):
    """The equator as a closed orbit along a piece on which its stability does not change (Theorem 3.1(c)).

    Attributes
    ----------
    value : ndarray (k,)
    exponent : ndarray (k,)
        ln rho changes by this much in a turn.
    kind : str
        "attracting from outside", "repelling from outside" or "neutral".
    """

    value: Array = field(repr=False)
    exponent: Array = field(repr=False)
    kind: str


@dataclass(frozen=True, eq=False)
class CriticalBranch(Result):
    """A critical set along a piece on which its kind does not change (3.22).

    Attributes
    ----------
    value : ndarray (k,)
        Increasing.
    e, p : ndarray (k, 2)
        (c, s), and the place in the projected disc; |p| = 1 where it reaches the equator.
    trace, determinant : ndarray (k,)
        Of J.
    kind : str
        As `CriticalSet.kind`.
    """

    value: Array = field(repr=False)
    e: Array = field(repr=False)
    p: Array = field(repr=False)
    trace: Array = field(repr=False)
    determinant: Array = field(repr=False)
    kind: str

    @property
    def radius(self) -> Array:
        """|p|, (k,)."""
        return np.hypot(self.p[:, 0], self.p[:, 1])


@dataclass(frozen=True, eq=False)
class Branches(Pictured):
    """Branches along one parameter, and their special points.

    Attributes
    ----------
    system : ELinear, System, Coefficients or Frozen
    psi : Psi
    z : tuple of float
    along : str
        The parameter.
    span : (float, float)
    limit_directions : tuple of DirectionBranch
    closed : tuple of ClosedEquator
        Where there are no limit directions.
    critical : tuple of CriticalBranch
    standing : tuple of SpecialValue
        Special points of the equilibria, by increasing value.
    gaps : tuple of (float, float)
        Where the coefficients are not finite.
    cycles : CycleBranches
        Branches of limit cycles; none, with the reason, before they were looked for.
    """

    system: AnySystem
    psi: Psi
    z: tuple[float, ...]
    along: str
    span: tuple[float, float]
    limit_directions: tuple[DirectionBranch, ...]
    closed: tuple[ClosedEquator, ...]
    critical: tuple[CriticalBranch, ...]
    standing: tuple[SpecialValue, ...]
    gaps: tuple[tuple[float, float], ...]
    cycles: CycleBranches

    @property
    def special(self) -> tuple[SpecialValue | CyclePoint, ...]:
        """All special points, of the equilibria and of limit cycles, by increasing value; Hopf points once."""
        of_cycles = [one for branch in self.cycles for one in branch.special if one.kind not in UNREPORTED_KINDS]
        return tuple(sorted([*self.standing, *of_cycles], key=lambda one: one.value))

    @property
    def accuracy(self) -> tuple[PointAccuracy, ...]:
        """Residual, normal-form coefficient and condition of special points of the equilibria, where these are defined.

        Returns
        -------
        tuple of PointAccuracy
            In the order of `standing`.
        """
        scale = self.span[1] - self.span[0]
        of = self.system, self.psi, self.z, self.along, scale
        found = (point_accuracy(one, *of) for one in self.standing)
        return tuple(one for one in found if one is not None)

    @property
    def notes(self) -> tuple[str, ...]:
        """Return notes on what was not decided, and where nothing is defined."""
        return (*(say("gap", name=self.along, low=low, high=high) for low, high in self.gaps), *self.cycles.notes)

    def with_cycles(self) -> Branches:
        """Return the same with branches of limit cycles, which take longer."""
        from .result import cycle_branches  # here: it loads the compiler

        ends = [self.span[0], *(v for gap in self.gaps for v in gap), self.span[1]]
        spans = [part for part in zip(ends[::2], ends[1::2], strict=True) if part[0] < part[1]]
        return replace(self, cycles=cycle_branches(self.system, self.psi, self.along, spans, self.z, self.standing))

    def _records(self) -> Iterator[dict[str, Any]]:
        """Return a row for each point of each branch: which branch, the parameter's value, what is there."""
        for i, way in enumerate(self.limit_directions):
            more = {"theta": way.theta, "lambda_rho": way.lambda_rho, "lambda_theta": way.lambda_theta}
            yield from self._each("limit direction", i, way.value, way.kind, more)
        for i, orbit in enumerate(self.closed):
            yield from self._each("closed equator", i, orbit.value, orbit.kind, {"exponent": orbit.exponent})
        for i, C in enumerate(self.critical):
            more = {"c": C.e[:, 0], "s": C.e[:, 1], "p_x": C.p[:, 0], "p_y": C.p[:, 1]}
            more |= {"trace": C.trace, "determinant": C.determinant}
            yield from self._each("critical set", i, C.value, C.kind, more)
        for i, cycle in enumerate(self.cycles):
            more = {"p_x": cycle.section[:, 0], "p_y": cycle.section[:, 1], "period": cycle.period}
            more |= {"amplitude": cycle.amplitude, "exponent": cycle.exponent}
            for kind, row in zip(cycle.stable, self._each("limit cycle", i, cycle.value, "", more), strict=True):
                yield {**row, "kind": "stable" if kind else "unstable"}
        for i, one in enumerate(self.special):
            yield from self._each("special point", i, np.array([one.value]), one.kind, {})

    def _each(self, what: str, i: int, value: Array, kind: str, more: dict[str, Array]) -> Iterator[dict[str, Any]]:
        columns = [v.tolist() for v in more.values()]
        for at, *row in zip(value.tolist(), *columns, strict=True):
            given = dict(zip(more, row, strict=True))
            yield {
                "what": what, "branch": i, self.along: at, "kind": kind, **{k: given.get(k) for k in _COLUMNS}
            }  # fmt: skip

    def _tables_(self) -> str:
        special = html_table(
            ("at", self.along, "what happens"), [(*one._row_()[:2], one.sentence) for one in self.special]
        )
        return special + paragraphs([self.cycles.reason, *self.notes])
