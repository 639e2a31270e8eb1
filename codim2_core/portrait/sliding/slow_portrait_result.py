"""Along Sigma, as a result: branches of critical sets, special points, and the intervals between them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from ...results.arrays import Array
from ...results.result import Pictured, Result, Tabled, result_rows
from ...results.tables import point, table_number


@dataclass(frozen=True, eq=False, slots=True)
class SlowBranch(Result):
    """One critical set followed along z.

    Attributes
    ----------
    z : ndarray (k,)
        Values of the slow variable that is varied.
    e, p : ndarray (k, 2)
        Its place, and that in the projected disc.
    flow : ndarray (k, m)
        z' on it, (2.29).
    kind : str
        As `CriticalSet.kind`; it is the same along the branch.
    """

    z: Array = field(repr=False)
    e: Array = field(repr=False)
    p: Array = field(repr=False)
    flow: Array = field(repr=False)
    kind: str

    @property
    def stable(self) -> bool:
        """Whether the layer problem attracts to it."""
        return self.kind.startswith("stable")


@dataclass(frozen=True, eq=False, slots=True)
class SlowPoint(Tabled):
    """A value of z at which something happens.

    Attributes
    ----------
    kind : str
        "equator" (a critical set passes through the equator, Figure 19), "fold", "Hopf", "node-focus", or
        "equilibrium" of the slow flow.
    z : float
    e : (c, s)
    flow : tuple of m floats
        z' there, on the critical set to which it happens.
    stable : bool or None
        Of an equilibrium: whether the slow flow attracts to it.
    sentence : str
    """

    _head_ = ("at", "z", "e", "slow flow z′", "what happens")

    kind: str
    z: float
    e: tuple[float, float]
    flow: tuple[float, ...]
    stable: bool | None
    sentence: str

    def _row_(self) -> tuple[str, ...]:
        return self.kind, table_number(self.z), point(self.e), point(self.flow), self.sentence


@dataclass(frozen=True, eq=False, slots=True)
class SlowInterval(Tabled):
    """An interval of z: kind "sliding", "unstable" or "crossing"."""

    _head_ = ("from z", "to z", "kind", "what happens")

    low: float
    high: float
    kind: str
    sentence: str

    def _row_(self) -> tuple[str, ...]:
        return table_number(self.low), table_number(self.high), self.kind, self.sentence


@dataclass(frozen=True, eq=False, slots=True)
class SlowPortrait(Pictured):
    """The slow flow on Sigma along one slow variable, made by `slow_portrait`."""

    branches: tuple[SlowBranch, ...]
    points: tuple[SlowPoint, ...]
    intervals: tuple[SlowInterval, ...]

    def _records(self) -> Iterator[dict[str, Any]]:
        for i, one in enumerate(self.branches):
            for z, e, flow in zip(one.z.tolist(), one.e.tolist(), one.flow.tolist(), strict=True):
                flows = {f"flow_{k + 1}": value for k, value in enumerate(flow)}
                yield {"branch": i, "kind": one.kind, "z": z, "c": e[0], "s": e[1], **flows}

    def _tables_(self) -> str:
        return result_rows(self.intervals) + result_rows(self.points)
