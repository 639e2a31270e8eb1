"""The result of a search for a periodic motion."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum

from ...results.arrays import Array, Complex
from ...results.result import Pictured
from ...results.tables import html_table, paragraphs, table_number
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
