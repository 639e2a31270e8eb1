"""Motions of a mechanism with several contacts, step by step; for eps > 0 as the regularised system."""

from __future__ import annotations

from dataclasses import dataclass
from dataclasses import field as made_with

import numpy as np

from ....numerics.radau import STEP_SAFETY, Step, TooManyStepsError, tableau, truncate_step
from ....results.arrays import Array
from ....results.words import say
from .collocation import Collocated, collocate
from .decision import Flags
from .field import ContactField, Law, Local, project_velocities
from .inspection import Inspection, Switch

FIRST_SHARE = 1e-3  # first step after an event, as a share of the span
SHORTEST_SHARE = 1e-15  # of the span: shorter steps are given up
HELD_SLIPS = 10.0  # in eps: a contact that slips less is held by friction
MOST_GROWTH, LEAST_GROWTH = 6.0, 0.2  # of a step


class NoFrictionError(Exception):
    """The bound mu N of a contact is not positive; the contact's number."""


@dataclass
class ContactRun:
    """A motion under way."""

    field: ContactField
    law: Law
    t: float
    Y: Array
    t_end: float
    rtol: float
    atol: float
    most: int
    max_step: float
    e: Array = made_with(init=False)  # (c, 2) At the state, which matters where a contact is about to slip
    sticks: Flags = made_with(init=False)  # (c,)
    rate: Array = made_with(init=False)  # (N,) Y' at the state
    departs: Flags = made_with(init=False)  # (c,) Contacts that begin to slip here, and have no slip yet
    curve: Array = made_with(init=False)  # (N,) Y'' where contacts begin to slip with no acceleration, else 0
    inspection: Inspection = made_with(init=False)
    speed: float = 0.0  # the largest velocity so far
    undecided: int = 0  # steps along which bounds decide nothing
    passed: int = 0  # switches
    steps: list[Step] = made_with(default_factory=list)
    starts: list[tuple[float, tuple[bool, ...], str]] = made_with(default_factory=list)  # the phases

    def run(self) -> None:
        """Go on to the end.

        Raises TooManyStepsError, NoFrictionError.
        """
        span = self.t_end - self.t
        h = self.first = FIRST_SHARE * span
        self._enter(self.field.on_branch(self.Y, np.concatenate([np.zeros(self.field.n), self.field.at(self.Y).rates])))
        self._begin()
        while self.t < self.t_end:
            if len(self.steps) + len(self.starts) + self.passed >= self.most or h < SHORTEST_SHARE * span:
                raise TooManyStepsError(say("contact steps", t=self.t))
            ends = self.t + h >= self.t_end
            h = self.t_end - self.t if ends else h
            h, ends = (bound, False) if (bound := min(self._longest(), self.max_step)) < h else (h, ends)
            found = collocate(
                self.field, self.law, self.t, self.Y, h, self.rate, self.e, self.sticks, self._guess(h), self.allowed
            )
            if found is None or self._turns(found):
                h *= 0.3
                continue
            factor = STEP_SAFETY * max(found.error, 1e-10) ** (-1.0 / 6.0)
            if found.error > 1.0:
                h *= max(LEAST_GROWTH, factor)
                continue
            here = self.field.at(self.Y)
            retry = self.inspection.retry(found.step, found.places, here, self._held(here), self.speed + self.atol)
            if retry is not None:
                h = retry
                continue
            self.undecided += self.inspection.was_undecided
            h *= min(MOST_GROWTH, max(LEAST_GROWTH, factor))
            h = self._accept(found, ends, self.inspection.switch(found.step), h)

    def _enter(self, field: ContactField) -> None:
        """Go on with a branch of the formulas."""
        self.field, self.inspection = field, Inspection(field, self.rtol)

    def _pass(self, step: Step, switch: Switch) -> float:
        """Go on up to a switch, and with the branch behind it; return the next step."""
        self.passed += 1
        self._take(truncate_step(step, switch.u), ends=False)
        before, rate = self.field.branch, self._slopes(self.field.at(self.Y))[1]
        self._enter(self.field.past_switch(switch.guard, self.Y, rate))
        self._resume()
        if self.field.returns_to(before, switch.guard, self.Y, self.rate):
            raise TooManyStepsError(say("load switches back"))
        return self.first

    @property
    def allowed(self) -> Array:
        """Error allowed in a step: of velocities by the largest, of positions by each."""
        v, q = self.Y[: self.field.n], self.Y[self.field.n :]
        most = max(self.speed, float(np.abs(v).max()))
        return self.atol + self.rtol * np.concatenate([np.full(len(v), most), np.abs(q)])

    def _begin(self) -> None:
        raise NotImplementedError

    def _longest(self) -> float:
        return np.inf

    def _turns(self, found: Collocated) -> bool:
        raise NotImplementedError

    def _accept(self, found: Collocated, ends: bool, switch: Switch | None, h: float) -> float:
        raise NotImplementedError

    def _resume(self) -> None:
        raise NotImplementedError

    def _held(self, here: Local) -> Flags:  # noqa: ARG002 (in the limit it is known)
        """Return which contacts friction holds."""
        return self.sticks

    def _take(self, step: Step, ends: bool) -> Local:
        """Take a step, without the slip that its error gives to contacts that stick; return what holds at its end."""
        if self.sticks.any():
            last = step.last.copy()
            last[: self.field.n] = project_velocities(self.field.at(last), last[: self.field.n], self.sticks)
            polynomial = step.polynomial.copy()
            polynomial[:, 0] += last - step.last
            step = step._replace(last=last, polynomial=polynomial)
        if step.h > 0.0:
            self.steps.append(step)
        self.t, self.Y = (self.t_end if ends else step.end), step.last
        self.speed = max(self.speed, float(np.abs(step.first[: self.field.n]).max()))
        return self._here()

    def _here(self) -> Local:
        """Return what holds at the state, where every contact has friction."""
        here = self.field.at(self.Y)
        if not (here.r > 0.0).all():
            raise NoFrictionError(int(np.argmin(here.r > 0.0)) + 1)
        return here

    def _guess(self, h: float) -> Array:
        """Return stages less Y: along Y', and along Y'' where contacts depart with no acceleration."""
        tau = tableau().nodes[:, None] * h
        return tau * self.rate + 0.5 * tau**2 * self.curve

    def _slopes(self, here: Local) -> tuple[Array, Array]:
        """Return e and Y' where no contact is about to slip."""
        e = np.where(self.sticks[:, None], 0.0, self.law.e(here.x))
        return e, self.field.rate(here, e, self.sticks)

    def _go_on(self, here: Local) -> None:
        """Set what holds at a state between events."""
        self.e, self.rate = self._slopes(here)
        self.departs, self.curve = np.zeros(len(here.r), bool), np.zeros(len(self.Y))


class RegularisedRun(ContactRun):
    """A motion for eps > 0."""

    def _held(self, here: Local) -> Flags:
        return np.hypot(*here.x.T) <= HELD_SLIPS * self.law.eps

    def _begin(self) -> None:
        self.sticks = np.zeros(self.field.count, bool)
        self._resume()

    def _turns(self, found: Collocated) -> bool:  # noqa: ARG002 (e may turn as it likes where |e| < 1)
        return False

    def _accept(self, found: Collocated, ends: bool, switch: Switch | None, h: float) -> float:
        if switch is not None:
            return self._pass(found.step, switch)
        self._go_on(self._take(found.step, ends))
        return h

    def _resume(self) -> None:
        self._go_on(self._here())
