"""A motion phase by phase: a smooth field is followed until a guard ends it, and what follows is decided there.

A phase is which contacts are held at their sets, the field that is smooth while they are, and its guards: a force at
the bound of friction, an arrival, a set that is lost, a switch of the formulas. What follows where one vanishes is
decided by the layer problem of one contact, or by Gauss's principle for several; for eps > 0 only formulas switch.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Generic, TypeVar

from ..results.arrays import Array
from ..results.words import say
from .dense import Dense, StepArray, dense, gather_steps
from .radau import MotionEndError, Step, TooManyStepsError

Decided = TypeVar("Decided")


class StopError(MotionEndError):
    """The limit is not unique, or not known, from here on."""

    status = "NOT_UNIQUE"


class AtEventError(MotionEndError):
    """A terminal event."""

    status = "EVENT"


@dataclass
class PhaseRun(Generic[Decided]):
    """A motion under way."""

    t: float
    state: Array
    t_end: float
    rtol: float
    atol: float
    most: int  # steps and phases
    max_step: float
    undecided: int = field(default=0, init=False)  # steps that could not be bounded
    taken: list[Step] = field(default_factory=list, init=False)
    phases: list[Any] = field(default_factory=list, init=False)

    @property
    def left(self) -> int:
        """Steps and phases that may still be taken."""
        return self.most - len(self.taken) - len(self.phases)

    def first(self) -> Decided | None:
        """Decide what follows from the start; None at the end of the time."""
        raise NotImplementedError

    def phase(self, decision: Decided) -> Decided | None:
        """Follow the phase that was decided until a guard ends it, and decide what follows."""
        raise NotImplementedError

    def parts(self) -> Sequence[StepArray]:
        """Return the steps taken."""
        return [gather_steps(self.taken, len(self.state))]

    def give_up(self) -> None:
        """Raise TooManyStepsError."""
        raise TooManyStepsError(say("last time", t=self.t))

    def outcome(self) -> tuple[Dense, str, str]:
        """Follow the motion to its end: the motion, the name of its status, and what there is to say of it."""
        t_start, start, status, detail = self.t, self.state, "T_END", ""
        try:
            decision = self.first()
            while decision is not None and self.t < self.t_end:
                if self.left <= 0:
                    self.give_up()
                decision = self.phase(decision)
        except MotionEndError as end:
            status, detail = end.status, str(end)
        if self.undecided:
            detail = f"{detail} {say('not bounded', count=self.undecided)}".strip()
        return dense(t_start, start, self.parts()), status, detail
