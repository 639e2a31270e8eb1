"""The result of a search for a periodic motion."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from itertools import combinations
from typing import Any

import numpy as np

from ...results.arrays import Array, Complex
from ...results.result import Pictured, Tabled, column_rows, result_rows
from ...results.tables import html_table, paragraphs, table_number
from ...results.words import say
from ..result import Simulation


class PeriodicStatus(Enum):
    """The outcome of a search; the reason of a result says it in a sentence."""

    FOUND = "found"
    NOT_ISOLATED = "not isolated"
    NO_CONVERGENCE = "no convergence"
    NO_DERIVATIVE = "no derivative"
    MOTION_ENDS = "motion ends"
    STANDS_STILL = "stands still"


@dataclass(frozen=True, eq=False)
class PeriodicMotion(Pictured):
    """A motion that repeats itself, or what a search for one has come to; arrays are read-only.

    Attributes
    ----------
    status : PeriodicStatus
        FOUND; NOT_ISOLATED, found with a multiplier +1; else why none was found.
    reason : str
        The same in sentences, with what says that it is stable or not.
    run : Simulation
        The motion over one period, from t = 0; the last that was tried if none was found.
    period : float
    forced : bool
        Whether the period was given by a clock, a slow variable that moves at a constant rate.
    advance : ndarray (m,)
        How far each slow variable is on after a period.
    multipliers : ndarray (q,) of complex
        Floquet multipliers, largest first: of a forced motion by all but its clocks, of others by all but a shift in
        time, whose multiplier is 1. In the limit eps -> 0 those lost at Sigma are exactly 0; across an invariant line
        that repels there are none. Empty where none was found.
    multiplier_errors : ndarray (q,)
        Estimates: how far they move as the motion is followed more closely, and what the error of its derivatives does.
    stability : str
        "stable", "unstable" or "undecided".
    residual : float
        How far the end is from the start, in units of the motion's size.
    error : ndarray (2 + m,)
        Estimate of the error of the start: how far it moves as the motion is followed more closely.
    period_error : float
        The same of the period; 0 of one that is given.
    """

    status: PeriodicStatus
    reason: str
    run: Simulation = field(repr=False)
    period: float
    forced: bool
    advance: Array
    multipliers: Complex
    multiplier_errors: Array
    stability: str
    residual: float
    error: Array
    period_error: float

    @property
    def state0(self) -> Array:
        """Its start (2 + m,)."""
        return self.run.states[0]

    @property
    def found(self) -> bool:
        """Whether it repeats itself."""
        return self.status in (PeriodicStatus.FOUND, PeriodicStatus.NOT_ISOLATED)

    @property
    def success(self) -> bool:
        """The same, by the name that SciPy's results have for it."""
        return self.found

    @property
    def message(self) -> str:
        """The reason, by that name."""
        return self.reason

    def _tables_(self) -> str:
        rows = [
            (table_number(one.real), table_number(one.imag), table_number(abs(one)), f"{error:.1e}")
            for one, error in zip(self.multipliers.tolist(), self.multiplier_errors.tolist(), strict=True)
        ]
        head = ("multiplier", "imaginary part", "modulus", "error")
        return html_table(head, rows) + paragraphs([self.reason])


REAL = 1e-6  # imaginary part of a multiplier on the unit circle, up to which a pair is a pair of real ones


@dataclass(frozen=True, eq=False)
class ResponseRow:
    """One motion of a curve."""

    value: float
    period: float
    state: Array  # (2 + m,) Its start
    swings: Array  # (2 + m,) Half of what lies between the extremes
    multipliers: Complex  # (q,)
    phases: tuple[str, ...]  # kinds of its phases, in order
    onward: float  # by how much the parameter goes on from the motion before it


@dataclass(frozen=True, eq=False)
class ResponsePoint(Tabled):
    """A special point of a response curve.

    Attributes
    ----------
    kind : str
        "fold", "branch point", "period doubling", "Neimark-Sacker", or "phases change": a stick or a passage of Sigma
        begins or ends.
    value, period : float
    sentence : str
    """

    _head_ = ("at", "value", "period", "what happens")

    kind: str
    value: float
    period: float
    sentence: str

    def _row_(self) -> tuple[str, ...]:
        return self.kind, table_number(self.value), table_number(self.period), self.sentence


def _product_of_pairs(values: Complex) -> float:
    return float(np.prod([1.0 - one * other for one, other in combinations(values.tolist(), 2)]).real)


#: What goes through zero there, of the multipliers without the trivial one.
KINDS_OF_CHANGE: Mapping[str, Callable[[Complex], float]] = {
    "fold": lambda values: float(np.prod(values - 1.0).real),
    "period doubling": lambda values: float(np.prod(values + 1.0).real),
    "Neimark-Sacker": _product_of_pairs,
}


def change_point(
    along: str, kind: str, row: ResponseRow, before: ResponseRow, after: ResponseRow, turns: bool = False
) -> ResponsePoint | None:
    """Return the point at a zero of a test function between two motions, if it is one; `turns`: the parameter does."""
    numbers = {"name": along, "value": row.value}
    if kind == "fold":
        kind, sentence = (
            ("fold", say("response folds", **numbers)) if turns else ("branch point", say("branches off", **numbers))
        )
    elif kind == "period doubling":
        sentence = say("doubles", **numbers)
    elif kind == "Neimark-Sacker":
        nearest = min(row.multipliers.tolist(), key=lambda one: abs(abs(one) - 1.0))
        if abs(nearest.imag) < REAL:  # a pair of real ones whose product is 1
            return None
        sentence = say("becomes a torus", **numbers)
    else:
        of = "slide" if after.phases.count("slide") != before.phases.count("slide") else "cross"
        below, above = sorted((before, after), key=lambda row: row.value)
        counts = {"below": below.phases.count(of), "above": above.phases.count(of)}
        sentence = say("sticks change" if of == "slide" else "passages change", **numbers, **counts)
    return ResponsePoint(kind, row.value, row.period, sentence)


@dataclass(frozen=True, eq=False)
class ResponseCurve(Pictured):
    """Periodic motions along one parameter, in order along their curve; arrays are read-only.

    Attributes
    ----------
    along : str
    span : (float, float)
    values, period : ndarray (k,)
        Of the parameter.
    state0 : ndarray (k, 2 + m)
        Their starts.
    amplitude : ndarray (k, m)
        Half of max - min of z1, ..., zm over a period.
    velocity_amplitude : ndarray (k, 2)
        The same of x and y.
    multipliers : ndarray (k, q) of complex
        As `PeriodicMotion.multipliers`.
    stable : ndarray (k,) of bool
        Whether all of them are inside the unit circle.
    phases : tuple of str
        Of each the kinds of its phases, such as "slip, slide".
    special : tuple of ResponsePoint
        In order along the curve.
    ends : (str, str)
        Of either end "span", "grows" (to a hundred times its first size), "lost" (it was followed no further), "many"
        (points were too many), or "closed".
    """

    along: str
    span: tuple[float, float]
    values: Array = field(repr=False)
    period: Array = field(repr=False)
    state0: Array = field(repr=False)
    amplitude: Array = field(repr=False)
    velocity_amplitude: Array = field(repr=False)
    multipliers: Complex = field(repr=False)
    stable: Array = field(repr=False)
    phases: tuple[str, ...] = field(repr=False)
    special: tuple[ResponsePoint, ...]
    ends: tuple[str, str]

    @classmethod
    def of(
        cls, along: str, span: tuple[float, float], rows: Sequence[ResponseRow],
        special: Sequence[ResponsePoint], ends: tuple[str, str],
    ) -> ResponseCurve:  # fmt: skip
        """Gather the motions of a curve."""
        most = max(len(row.multipliers) for row in rows)
        values = np.full((len(rows), most), np.nan, complex)
        for i, row in enumerate(rows):
            values[i, : len(row.multipliers)] = row.multipliers
        swings = np.array([row.swings for row in rows])
        arrays = (
            np.array([row.value for row in rows]), np.array([row.period for row in rows]),
            np.array([row.state for row in rows]), swings[:, 2:].copy(), swings[:, :2].copy(), values,
            np.array([bool((np.abs(row.multipliers) < 1.0).all()) for row in rows]),
        )  # fmt: skip
        for array in arrays:
            array.flags.writeable = False
        return cls(along, span, *arrays, tuple(", ".join(row.phases) for row in rows), tuple(special), ends)

    def __len__(self) -> int:
        return len(self.values)

    def crossings(self, value: float) -> int:
        """Return how many of its motions have a value of the parameter: how often the curve passes it."""
        side = self.values - value
        return int(np.count_nonzero(side[1:] * side[:-1] < 0.0) + np.count_nonzero(side == 0.0))

    def _records(self) -> Iterator[dict[str, Any]]:
        names = ["x", "y", *(f"z{i}" for i in range(1, self.state0.shape[1] - 1))]
        columns: dict[str, Any] = {self.along: self.values, "period": self.period, "stable": self.stable}
        swings = (*self.velocity_amplitude.T, *self.amplitude.T)
        columns |= {f"amplitude_{name}": row for name, row in zip(names, swings, strict=True)}
        columns |= {f"start_{name}": row for name, row in zip(names, self.state0.T, strict=True)}
        columns["largest_multiplier"] = np.nanmax(np.abs(self.multipliers), axis=1, initial=0.0)
        return column_rows(columns | {"phases": self.phases})

    def _tables_(self) -> str:
        summary = say(
            "response", name=self.along, low=float(self.values.min()), high=float(self.values.max()), count=len(self)
        )
        return result_rows(self.special) + paragraphs([summary])
