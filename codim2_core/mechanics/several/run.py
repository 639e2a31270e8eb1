"""Motions of a mechanism with several contacts: in the limit by events, for eps > 0 as the regularised system.

In the limit each contact slips, e = x/|x|, or sticks, x = 0, and `decision` says what follows where one arrives at its
set or the force that holds it comes to its bound. A contact arrives as its slip falls below `ARRIVED` of all slips,
along a line: its time is that of the nearest approach to 0, and the velocities are projected onto its set.
"""

from __future__ import annotations

from dataclasses import dataclass
from dataclasses import field as made_with

import numpy as np

from ...arrays import Array
from ...numerics.radau import STEP_SAFETY, Step, TooManyStepsError, tableau, truncate_step
from ...words import say
from .collocation import Collocated, collocate
from .decision import AT_BOUND, Decided, Flags, decide_contacts
from .field import ContactField, Law, Local, held_rates, project_velocities
from .result import contact_names

FIRST_SHARE = 1e-3  # first step after an event, as a share of the span
SHORTEST_SHARE = 1e-15  # of the span: shorter steps are given up
MOST_GROWTH, LEAST_GROWTH = 6.0, 0.2  # of a step
TO_ZERO = 0.9  # of the way to 0 that a slip may go in a step
TURN = 0.5  # cosine of how far e may turn from stage to stage
ARRIVED = 1e-9  # a slip that falls and is smaller is at its set; in units of velocities
TOGETHER = 1e4  # slips so many times larger may arrive in the same moment
AHEAD = (1e-3, 1e-2, 1e-1, 1.0)  # of a first step: how far ahead it is looked at what departs
HALVINGS = 50
MARGIN_SAMPLES = 65  # places in a step at which the polynomial through margins is asked
STICKING_SHARE = 1 / 64  # of the span: longest step while a contact sticks


class NoFrictionError(Exception):
    """The bound mu N of a contact is not positive; the contact's number."""


@dataclass
class ContactRun:
    """A motion under way.

    Attributes
    ----------
    e : ndarray (c, 2)
        At the state, which matters where a contact is about to slip.
    sticks : ndarray (c,)
    rate : ndarray (N,)
        Y' at the state.
    departs : ndarray (c,)
        Contacts that begin to slip here, and have no slip yet.
    jerk : ndarray (n,)
        What v'' gains as contacts begin to slip with no acceleration.
    speed : float
        The largest velocity so far.
    starts : list of (t, sticks, sentence)
        The phases.
    """

    field: ContactField
    law: Law
    t: float
    Y: Array
    t_end: float
    rtol: float
    atol: float
    most: int
    e: Array = made_with(init=False)
    sticks: Flags = made_with(init=False)
    rate: Array = made_with(init=False)
    departs: Flags = made_with(init=False)
    jerk: Array = made_with(init=False)
    speed: float = 0.0
    steps: list[Step] = made_with(default_factory=list)
    starts: list[tuple[float, tuple[bool, ...], str]] = made_with(default_factory=list)

    def run(self) -> None:
        """Go on to the end.

        Raises
        ------
        TooManyStepsError, NoFrictionError
        """
        span = self.t_end - self.t
        h = self.first = FIRST_SHARE * span
        self._begin()
        while self.t < self.t_end:
            if len(self.steps) + len(self.starts) >= self.most or h < SHORTEST_SHARE * span:
                raise TooManyStepsError(say("contact steps", t=self.t))
            ends = self.t + h >= self.t_end
            h = self.t_end - self.t if ends else h
            h, ends = (bound, False) if (bound := self._longest()) < h else (h, ends)
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
            h = self._accept(found, ends, h * min(MOST_GROWTH, max(LEAST_GROWTH, factor)))

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

    def _accept(self, found: Collocated, ends: bool, h: float) -> float:
        raise NotImplementedError

    def _take(self, step: Step, ends: bool) -> Local:
        """Take a step, and return what holds at its end."""
        if step.h > 0.0:
            self.steps.append(step)
        self.t, self.Y = (self.t_end if ends else step.end), step.last
        self.speed = max(self.speed, float(np.abs(step.first[: self.field.n]).max()))
        here = self.field.at(self.Y)
        if not (here.r > 0.0).all():
            raise NoFrictionError(int(np.argmin(here.r > 0.0)) + 1)
        return here

    def _guess(self, h: float) -> Array:
        """Return stages less Y: along Y', and along v'' where contacts depart with no acceleration."""
        tau = tableau().nodes[:, None] * h
        Z = tau * self.rate
        Z[:, : self.field.n] += 0.5 * tau**2 * self.jerk
        return Z

    def _go_on(self, here: Local) -> None:
        """Set what holds at a state between events."""
        self.e = np.where(self.sticks[:, None], 0.0, self.law.e(here.x))
        self.rate = self.field.rate(here, self.e, self.sticks)
        self.departs, self.jerk = np.zeros(len(here.r), bool), np.zeros(self.field.n)


class RegularisedRun(ContactRun):
    """A motion for eps > 0."""

    def _begin(self) -> None:
        here = self.field.at(self.Y)
        self.sticks = np.zeros(len(here.r), bool)
        self._go_on(here)

    def _turns(self, found: Collocated) -> bool:  # noqa: ARG002 (e may turn as it likes where |e| < 1)
        return False

    def _accept(self, found: Collocated, ends: bool, h: float) -> float:
        self._go_on(self._take(found.step, ends))
        return h


@dataclass
class NonsmoothRun(ContactRun):
    """A motion in the limit.

    Attributes
    ----------
    grazes : bool
        Whether a force that holds has just come to its bound and is about to fall again: for a step it is not asked.
    """

    grazes: bool = False

    def _begin(self) -> None:
        here = self.field.at(self.Y)
        self.sticks = np.hypot(*here.x.T) == 0.0
        self._decide(self.sticks)
        self._note(say("contacts start"))

    def _note(self, reason: str) -> None:
        self.starts.append((self.t, tuple(self.sticks.tolist()), reason))

    def _longest(self) -> float:
        """Return how long a step may be, that no slip gets to 0 in it."""
        here = self.field.at(self.Y)
        size = np.hypot(*here.x.T)
        change = ((here.J @ self.rate[: self.field.n] + here.k) * self.e).sum(axis=1)
        falls = ~self.sticks & ~self.departs & (change < 0.0)
        longest = STICKING_SHARE * (self.t_end - self.starts[0][0]) if self.sticks.any() else np.inf
        return float((TO_ZERO * size[falls] / -change[falls]).min(initial=longest))

    def _turns(self, found: Collocated) -> bool:
        out = ~self.sticks
        at = np.array([self.e, *(self.law.e(one.x) for one in found.stages)])[:, out]
        return bool(((at[1:] * at[:-1]).sum(axis=2) < TURN).any())

    def _margin(self, here: Local) -> float:
        """Return the least 1 - |e|^2 of contacts that stick; below 0 where they cannot."""
        if not self.sticks.any():
            return 1.0
        return float((1.0 - (self._holding(here) ** 2).sum(axis=1)).min())

    def _slip_force(self, here: Local, e: Array, at_sets: Flags) -> Array:
        """Return the applied force with the friction of the contacts that slip."""
        out = ~at_sets
        return here.Q - np.einsum("cin,ci->n", here.J[out], here.r[out, None] * e[out])

    def _holding(self, here: Local) -> Array:
        """Return e of the contacts that stick, |e| > 1 where they cannot."""
        e = np.where(self.sticks[:, None], 0.0, self.law.e(here.x))
        Q = self._slip_force(here, e, self.sticks)
        _, force = held_rates(here, self.sticks, Q)
        smallest = force / here.r[self.sticks, None]
        if len(force) * 2 <= self.field.n and not self._redundant(here):
            return smallest
        if (np.hypot(*smallest.T) < 1.0 - AT_BOUND).all():
            return smallest
        found = decide_contacts(here.M, Q, here.J[self.sticks], here.k[self.sticks], here.r[self.sticks])
        return found.e if found.sticks.all() else np.where(found.sticks[:, None], found.e, 2.0 * found.e)

    def _redundant(self, here: Local) -> bool:
        held = here.J[self.sticks].reshape(-1, self.field.n)
        return np.linalg.matrix_rank(held, 1e-10) < len(held)

    def _accept(self, found: Collocated, ends: bool, h: float) -> float:
        if self.sticks.any() and not self.grazes and (bound := self._bound(found)) is not None:
            self._take(truncate_step(found.step, bound), ends=False)
            before = self.sticks
            self._decide(before)
            free = before & ~self.sticks
            self.grazes = not free.any()
            if free.any():
                self._note(say("contact departs", where=contact_names(free)))
            return self.first
        self.grazes = False
        here = self._take(found.step, ends)
        self._go_on(here)
        if self.t < self.t_end and (arrived := self._arrived(here)) is not None:
            return self._arrive(arrived)
        return h

    def _bound(self, found: Collocated) -> float | None:
        """Return the fraction of a step at which a force that holds comes to its bound; None if none does.

        Asked are the stages, and the least of the polynomial through what they answer.
        """
        at = lambda u: self._margin(self.field.at(found.step.at(u)))
        nodes = np.array([0.0, *tableau().nodes])
        margins = np.array([self._margin(self.field.at(self.Y)), *map(self._margin, found.stages)])
        fine = np.linspace(0.0, 1.0, MARGIN_SAMPLES)
        least = float(fine[np.argmin(np.polynomial.Polynomial.fit(nodes, margins, len(nodes) - 1)(fine))])
        places = sorted([*zip(nodes[1:].tolist(), margins[1:].tolist(), strict=True), (least, at(least))])
        low = 0.0
        for high, margin in places:
            if high > 0.0 and margin < 0.0:
                break
            low = high
        else:
            return None
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if at(middle) >= 0.0 else (low, middle)
        return low

    def _arrived(self, here: Local) -> tuple[Flags, float] | None:
        """Return which contacts arrive at their sets, and in what time; None if none does."""
        change, size = here.J @ self.rate[: self.field.n] + here.k, np.hypot(*here.x.T)
        falls = ((change * self.e).sum(axis=1) < 0.0) & ~self.sticks
        near = self._near_set
        first = falls & (size <= near)
        if not first.any():
            return None
        ahead = lambda these: -float((here.x[these] * change[these]).sum() / (change[these] ** 2).sum())
        dt = ahead(first)
        left = np.hypot(*(here.x + dt * change).T)
        together = falls & (size <= TOGETHER * near) & (left <= 0.1 * size)
        return first | together, ahead(first | together)

    @property
    def _near_set(self) -> float:
        """Slip at which a contact that comes nearer is at its set."""
        return ARRIVED * self.speed + float(self.allowed[0])

    def _arrive(self, found: tuple[Flags, float]) -> float:
        arrived, dt = found
        dt = min(max(dt, 0.0), self.t_end - self.t)
        last = self.Y + dt * self.rate
        at_sets = arrived | self.sticks
        last[: self.field.n] = project_velocities(self.field.at(last), last[: self.field.n], at_sets)
        # whose rows depend on those of contacts that stop has stopped too
        arrived = arrived | (~at_sets & (np.hypot(*self.field.at(last).x.T) <= self._near_set))
        at_sets = arrived | self.sticks
        self._take(Step(self.t, dt, self.Y, last, (last - self.Y)[:, None]), ends=self.t + dt >= self.t_end)
        before = self.sticks
        self._decide(at_sets)
        stays = bool(self.sticks[arrived].all())
        frees = bool((before & ~self.sticks).any())
        self._note(
            say("contact arrives" if stays and not frees else "contact arrives, slips", where=contact_names(arrived))
        )
        return self.first

    def _decide(self, at_sets: Flags) -> None:
        """Decide which of the contacts at their sets stick from here on, and where the others go."""
        here = self.field.at(self.Y)
        if not (here.r > 0.0).all():
            raise NoFrictionError(int(np.argmin(here.r > 0.0)) + 1)
        self.sticks = at_sets.copy()
        self._go_on(here)
        e, found = self.e.copy(), self._decided(here, at_sets)
        e[at_sets] = np.where(found.sticks[:, None], 0.0, found.e)
        self.sticks[at_sets] = found.sticks
        self.rate = np.concatenate([found.u, here.rates])
        if found.is_at_bound:
            self._look_ahead(at_sets, found, e)
        self.e, self.departs = e, at_sets & ~self.sticks

    def _look_ahead(self, at_sets: Flags, found: Decided, e: Array) -> None:
        """Free the contacts that slip a moment later, so late that it is clear which do; their e are put into e.

        A force that holds redundant contacts is found at its bound a little late: v' goes on from where it is by then.
        """
        for share in AHEAD:
            step = share * self.first
            soon, later = (self.field.at(self.Y + k * step * self.rate) for k in (1.0, 2.0))
            ahead, next_ahead = self._decided(soon, at_sets), self._decided(later, at_sets)
            if ahead.is_at_bound or next_ahead.is_at_bound or (ahead.sticks != next_ahead.sticks).any():
                continue
            goes = found.sticks & ~ahead.sticks
            gain = ahead.u - self.field.rate(soon, e, self.sticks)[: self.field.n]
            next_gain = next_ahead.u - self.field.rate(later, e, self.sticks)[: self.field.n]
            self.jerk = (next_gain - gain) / step
            late = gain - step * self.jerk
            if late @ self.jerk > 0.0:
                self.rate[: self.field.n] += late
            e[at_sets] = np.where(goes[:, None], ahead.e, e[at_sets])
            self.sticks[at_sets] = found.sticks & ahead.sticks
            return

    def _decided(self, here: Local, at_sets: Flags) -> Decided:
        Q = self._slip_force(here, np.where(at_sets[:, None], 0.0, self.e), at_sets)
        return decide_contacts(here.M, Q, here.J[at_sets], here.k[at_sets], here.r[at_sets])
