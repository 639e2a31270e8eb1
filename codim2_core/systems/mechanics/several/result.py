"""Results of a mechanism with several contacts: what its contacts do at a state, and a motion with its phases."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....numerics.dense import DenseMotion
from ....results.arrays import Array
from ....results.result import Result, Tabled, result_rows
from ....results.tables import paragraphs, table_number
from ....results.words import say


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
class ContactMotion(DenseMotion):
    """A motion of a mechanism with several contacts; arrays are read-only.

    Attributes
    ----------
    times : ndarray (k,)
        Those that were requested; else the ends of the steps.
    states : ndarray (k, N)
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
    phases: tuple[ContactPhase, ...]
    status: ContactStatus
    reason: str
    eps: float

    def _columns(self, when: Array, states: Array) -> dict[str, Any]:
        starts = [phase.t_start for phase in self.phases]
        at = np.maximum(np.searchsorted(starts, when, side="right") - 1, 0)
        kinds = [", ".join(self.phases[i].kinds) for i in at]
        return {"t": when, **dict(zip(self.names, states.T, strict=True)), "contacts": kinds}

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
