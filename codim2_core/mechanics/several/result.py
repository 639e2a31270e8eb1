"""Results of a mechanism with several contacts: what its contacts do at a state, and a motion with its phases."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import Enum
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...arrays import Array
from ...numerics.dense import Dense
from ...results import Result, Tabled, column_rows, result_rows
from ...tables import paragraphs, table_number
from ...words import say


class ContactStatus(Enum):
    """The reason why a motion with several contacts ended; the value is the sentence shown."""

    T_END = say("end of span")
    NO_FRICTION = say("contact without friction")
    STEP_LIMIT = say("step limit")


def contact_names(which: NDArray[np.bool_]) -> str:
    """Return "contact 2", or "contacts 1, 2 and 3"."""
    *rest, last = (str(i + 1) for i in np.flatnonzero(which))
    return f"contacts {', '.join(rest)} and {last}" if rest else f"contact {last}"


@dataclass(frozen=True, eq=False)
class ContactPhase(Tabled):
    """A phase in which the same contacts stick.

    Attributes
    ----------
    t_start, t_end : float
    kinds : tuple of str
        For each contact "slip" or "stick".
    reason : str
        Why it began: a sentence.
    """

    _head_ = ("from t", "to t", "contacts", "why it began")

    t_start: float
    t_end: float
    kinds: tuple[str, ...]
    reason: str

    def _row_(self) -> tuple[str, ...]:
        return table_number(self.t_start), table_number(self.t_end), ", ".join(self.kinds), self.reason


@dataclass(frozen=True, eq=False)
class ContactMotion(Result):
    """A motion of a mechanism with several contacts; arrays are read-only.

    Attributes
    ----------
    names : tuple of str
        Velocities, then positions: the columns of `states`.
    phases : tuple of ContactPhase
        For eps > 0 a contact sticks while its slip is below 10 eps.
    status : ContactStatus
    reason : str
        The status, and what there is to say about it here.
    eps : float
        0 for the nonsmooth limit.
    """

    names: tuple[str, ...]
    motion: Dense = field(repr=False)
    phases: tuple[ContactPhase, ...]
    status: ContactStatus
    reason: str
    eps: float

    @property
    def times(self) -> Array:
        """Ends of the steps."""
        return self.motion.times

    @property
    def states(self) -> Array:
        """States there (k, N)."""
        return self.motion.states

    def dense(self, t: ArrayLike) -> Array:
        """Return states (..., N) at any times (...,) within the span.

        Raises
        ------
        ValueError
            A time is outside.
        """
        return self.motion(t)

    def _records(self) -> Iterator[dict[str, Any]]:
        starts = [phase.t_start for phase in self.phases]
        at = np.maximum(np.searchsorted(starts, self.times, side="right") - 1, 0)
        kinds = [", ".join(self.phases[i].kinds) for i in at]
        return column_rows({"t": self.times, **dict(zip(self.names, self.states.T, strict=True)), "contacts": kinds})

    def _tables_(self) -> str:
        return result_rows(self.phases) + paragraphs([self.reason])


@dataclass(frozen=True, eq=False)
class ContactDecision(Result):
    """Slip or stick at each contact of a mechanism at one state, eps -> 0.

    Attributes
    ----------
    kinds : tuple of str
        For each contact "slip" or "stick"; a contact at its set that begins to slip slips.
    e : ndarray (c, 2)
        For each contact the friction is ``-mu N J^T e``; inside the disc where it sticks: there e is its critical set.
    rates : ndarray (c, 2)
        How the slips move, (x, y)'.
    acceleration : ndarray (n,)
        v'.
    unique_e : bool
        Whether only these forces hold the contacts that stick: not where their Delassus matrix is singular.
    sentence : str
    """

    kinds: tuple[str, ...]
    e: Array
    rates: Array
    acceleration: Array
    unique_e: bool
    sentence: str
