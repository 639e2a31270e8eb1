"""Motions of a mechanism with several contacts, phase by phase: in the limit eps -> 0, and regularised.

In the limit each contact slips, e = x/|x|, or sticks, x = 0, and `decision` says what follows where one arrives at its
set or the force that holds it comes to its bound. A contact arrives as its slip falls below `ARRIVED` of all slips,
along a line: its time is that of the nearest approach to 0, and the velocities are projected onto its set.
"""

from __future__ import annotations

from dataclasses import dataclass
from dataclasses import field as made_with

import numpy as np

from ....numerics.hybrid import PhaseRun
from ....numerics.radau import STEP_SAFETY, MotionEndError, Step, tableau, truncate_step
from ....results.arrays import Array
from ....results.words import say
from .collocation import Collocated, Inspection, Switch, collocate
from .decision import AT_BOUND, Decided, Flags, decide_contacts
from .field import ContactField, Law, Local, held_rank, held_rates, project_velocities
from .result import contact_names

FIRST_SHARE = 1e-3  # first step after an event, as a share of the span
SHORTEST_SHARE = 1e-15  # of the span: shorter steps are given up
HELD_SLIPS = 10.0  # in eps: a contact that slips less is held by friction
MOST_GROWTH, LEAST_GROWTH = 6.0, 0.2  # of a step

NO_SLIP = 1e-14  # of the largest velocity so far: a slip that rounding leaves, whose direction says nothing
TO_ZERO = 0.9  # of the way to 0 that a slip may go in a step
TURN = 0.5  # cosine of how far e may turn from stage to stage
ARRIVED = 1e-9  # a slip that falls and is smaller is at its set; in units of velocities
TOGETHER = 1e4  # slips so many times larger may arrive in the same moment
AHEAD = (1e-3, 1e-2, 1e-1, 1.0)  # of a first step: how far ahead it is looked at what departs
HALVINGS = 50
MARGIN_SAMPLES = 65  # places in a step at which the polynomial through margins is asked


class NoFrictionError(MotionEndError):
    """The bound mu N of a contact is not positive."""

    status = "NO_FRICTION"


@dataclass
class ContactRun(PhaseRun[float]):
    """A motion under way; what is decided is the first step of what follows."""

    field: ContactField
    law: Law
    e: Array = made_with(init=False)  # (c, 2) At the state, which matters where a contact is about to slip
    sticks: Flags = made_with(init=False)  # (c,)
    rate: Array = made_with(init=False)  # (N,) The rate of the state
    departs: Flags = made_with(init=False)  # (c,) Contacts that begin to slip here, and have no slip yet
    curve: Array = made_with(init=False)  # (N,) Its second rate where contacts begin to slip with no acceleration, or 0
    inspection: Inspection = made_with(init=False)
    speed: float = 0.0  # the largest velocity so far
    passed: int = 0  # switches

    def __post_init__(self) -> None:
        self.span = self.t_end - self.t
        self.first_step = FIRST_SHARE * self.span

    @property
    def left(self) -> int:
        """Steps, phases and switches that may still be taken."""
        return super().left - self.passed

    def first(self) -> float:
        """Enter the branch of the formulas ahead of the start."""
        here = self.field.at(self.state)
        self._enter(self.field.on_branch(self.state, np.concatenate([np.zeros(self.field.n), here.rates])))
        return self.first_step

    def phase(self, decision: float) -> float | None:
        """Follow a phase by steps, from the first one on, until a guard vanishes; return the first step of the next."""
        h = decision
        while self.t < self.t_end:
            if self.left <= 0 or h < SHORTEST_SHARE * self.span:
                self.give_up()
            ends = self.t + h >= self.t_end
            h = self.t_end - self.t if ends else h
            h, ends = (bound, False) if (bound := min(self._longest(), self.max_step)) < h else (h, ends)
            found = collocate(
                self.field, self.law, self.t, self.state, h, self.rate, self.e, self.sticks, self._guess(h),
                self.allowed,
            )  # fmt: skip
            if found is None or self._turns(found):
                h *= 0.3
                continue
            factor = STEP_SAFETY * max(found.error, 1e-10) ** (-1.0 / 6.0)
            if found.error > 1.0:
                h *= max(LEAST_GROWTH, factor)
                continue
            here = self.field.at(self.state)
            retry = self.inspection.retry(found.step, found.places, here, self._held(here), self.speed + self.atol)
            if retry is not None:
                h = retry
                continue
            self.undecided += self.inspection.was_undecided
            h *= min(MOST_GROWTH, max(LEAST_GROWTH, factor))
            if self._accept(found, ends, self.inspection.switch(found.step)):
                return self.first_step
        return None

    def _enter(self, field: ContactField) -> None:
        """Go on with a branch of the formulas."""
        self.field, self.inspection = field, Inspection(field, self.rtol, self.atol)

    def _pass(self, step: Step, switch: Switch) -> None:
        """Go on up to a switch, and with the branch behind it."""
        self.passed += 1
        self._take(truncate_step(step, switch.u), ends=False)
        before, rate = self.field.branch, self._slopes(self.field.at(self.state))[1]
        self._enter(self.field.past_switch(switch.guard, self.state, rate))
        self._resume()
        if self.field.returns_to(before, switch.guard, self.state, self.rate):
            raise MotionEndError(say("load switches back"))

    @property
    def allowed(self) -> Array:
        """Error allowed in a step: of velocities by the largest, of positions by each."""
        v, q = self.state[: self.field.n], self.state[self.field.n :]
        most = max(self.speed, float(np.abs(v).max()))
        return self.atol + self.rtol * np.concatenate([np.full(len(v), most), np.abs(q)])

    def _longest(self) -> float:
        return np.inf

    def _turns(self, found: Collocated) -> bool:
        raise NotImplementedError

    def _accept(self, found: Collocated, ends: bool, switch: Switch | None) -> bool:
        """Take a step, up to a guard that vanishes in it, and decide there; return whether there is one."""
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
            self.taken.append(step)
        self.t, self.state = (self.t_end if ends else step.end), step.last
        self.speed = max(self.speed, float(np.abs(step.first[: self.field.n]).max()))
        return self._here()

    def _here(self) -> Local:
        """Return what holds at the state, where every contact has friction."""
        here = self.field.at(self.state)
        if not (here.r > 0.0).all():
            raise NoFrictionError(say("contact, mu N", which=int(np.argmin(here.r > 0.0)) + 1))
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
        self.departs, self.curve = np.zeros(len(here.r), bool), np.zeros(len(self.state))


class RegularisedRun(ContactRun):
    """A motion for eps > 0."""

    def _held(self, here: Local) -> Flags:
        return np.hypot(*here.x.T) <= HELD_SLIPS * self.law.eps

    def first(self) -> float:
        """Begin; for eps > 0 there is nothing to decide."""
        h = super().first()
        self.sticks = np.zeros(self.field.count, bool)
        self._resume()
        return h

    def _turns(self, found: Collocated) -> bool:  # noqa: ARG002 (e may turn as it likes where |e| < 1)
        return False

    def _accept(self, found: Collocated, ends: bool, switch: Switch | None) -> bool:
        if switch is None:
            self._go_on(self._take(found.step, ends))
        else:
            self._pass(found.step, switch)
        return switch is not None

    def _resume(self) -> None:
        self._go_on(self._here())


@dataclass
class NonsmoothRun(ContactRun):
    """A motion in the limit."""

    # whether a force that holds has just come to its bound and is about to fall again: for a step it is not asked
    grazes: bool = False

    def first(self) -> float:
        """Decide which contacts stick at the start."""
        h = super().first()
        self.sticks = np.hypot(*self.field.at(self.state).x.T) == 0.0
        self._decide(self.sticks)
        self._note(say("contacts start"))
        return h

    def _note(self, reason: str) -> None:
        self.phases.append((self.t, tuple(self.sticks.tolist()), reason))

    def _longest(self) -> float:
        """Return how long a step may be, that no slip gets to 0 in it."""
        here = self.field.at(self.state)
        size = np.hypot(*here.x.T)
        change = ((here.J @ self.rate[: self.field.n] + here.k) * self.e).sum(axis=1)
        falls = ~self.sticks & ~self.departs & (change < 0.0)
        return float((TO_ZERO * size[falls] / -change[falls]).min(initial=np.inf))

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
        if held_rank(here, self.sticks) == 2 * len(force):
            return smallest
        if (np.hypot(*smallest.T) < 1.0 - AT_BOUND).all():
            return smallest
        found = decide_contacts(here.M, Q, here.J[self.sticks], here.k[self.sticks], here.r[self.sticks])
        return found.e if found.sticks.all() else np.where(found.sticks[:, None], found.e, 2.0 * found.e)

    def _accept(self, found: Collocated, ends: bool, switch: Switch | None) -> bool:
        last = 1.0 if switch is None else switch.u
        if self.sticks.any() and not self.grazes and (bound := self._bound(found, last)) is not None:
            self._take(truncate_step(found.step, bound), ends=False)
            self.grazes = not self._release(self.sticks)
            return True
        self.grazes = False
        if switch is not None:
            self._pass(found.step, switch)
            return True
        here = self._take(found.step, ends)
        self._go_on(here)
        arrived = self._arrived(here) if self.t < self.t_end else None
        if arrived is not None:
            self._arrive(arrived)
        return arrived is not None

    def _release(self, at_sets: Flags) -> bool:
        """Decide anew which contacts stick, and whether one lets go."""
        before = self.sticks
        self._decide(at_sets)
        free = before & ~self.sticks
        if free.any():
            self._note(say("contact departs", where=contact_names(free)))
        return bool(free.any())

    def _resume(self) -> None:
        self._release((self.sticks | self.departs) & (np.hypot(*self.field.at(self.state).x.T) <= self._near_set))

    def _bound(self, found: Collocated, last: float) -> float | None:
        """Return the fraction of a step, up to `last`, at which a force that holds comes to its bound; or None."""
        at = lambda u: self._margin(self.field.at(found.step.at(u)))
        nodes = np.array([0.0, *tableau().nodes])
        margins = np.array([self._margin(self.field.at(self.state)), *map(self._margin, found.stages)])
        fine = np.linspace(0.0, last, MARGIN_SAMPLES)
        least = float(fine[np.argmin(np.polynomial.Polynomial.fit(nodes, margins, len(nodes) - 1)(fine))])
        ends = [(least, at(least)), *([(last, at(last))] if last < 1.0 else [])]
        places = sorted([*zip(nodes[1:].tolist(), margins[1:].tolist(), strict=True), *ends])
        low = 0.0
        for high, margin in places:
            if high > last:
                return None
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
        falls = (((change * self.e).sum(axis=1) < 0.0) | (size <= NO_SLIP * self.speed)) & ~self.sticks
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

    def _arrive(self, found: tuple[Flags, float]) -> None:
        arrived, dt = found
        dt = min(max(dt, 0.0), self.t_end - self.t)
        last = self.state + dt * self.rate
        at_sets = arrived | self.sticks
        stopped = at_sets
        while stopped.any():  # whose rows depend on those of contacts that stop has stopped too
            at_sets = at_sets | stopped
            last[: self.field.n] = project_velocities(self.field.at(last), last[: self.field.n], at_sets)
            stopped = ~at_sets & (np.hypot(*self.field.at(last).x.T) <= self._near_set)
        arrived = at_sets & ~self.sticks
        self._take(Step(self.t, dt, self.state, last, (last - self.state)[:, None]), ends=self.t + dt >= self.t_end)
        before = self.sticks
        self._decide(at_sets)
        stays = bool(self.sticks[arrived].all())
        frees = bool((before & ~self.sticks).any())
        self._note(
            say("contact arrives" if stays and not frees else "contact arrives, slips", where=contact_names(arrived))
        )

    def _decide(self, at_sets: Flags) -> None:
        """Decide which of the contacts at their sets stick from here on, and where the others go."""
        here = self._here()
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

        A force that holds redundant contacts is found at its bound a little late, and v' goes on from where it is by
        then; or a little early, and the contacts stick until it is there. From there a contact i slips like
        ``a t^2 e_i`` with a > 0, along the force that held it: what v' gains grows like t, and so does what v' itself
        changes by, which Y'' says. Neither is known at one state alone: the e of contacts that slip turn meanwhile.
        """
        n = self.field.n
        for share in AHEAD:
            step = share * self.first_step
            soon, later = (self.field.at(self.state + k * step * self.rate) for k in (1.0, 2.0))
            ahead, next_ahead = self._decided(soon, at_sets), self._decided(later, at_sets)
            if ahead.is_at_bound or next_ahead.is_at_bound or (ahead.sticks != next_ahead.sticks).any():
                continue
            goes = found.sticks & ~ahead.sticks
            gain = ahead.u - self._slopes(soon)[1][:n]
            growth = (next_ahead.u - self._slopes(later)[1][:n] - gain) / step
            missed = gain - step * growth
            wait = -float(missed @ growth) / float(growth @ growth)
            if wait > 0.0:
                self._wait(min(wait, step, self.t_end - self.t))
            else:
                self.rate[:n] += missed
            self.curve = np.concatenate([next_ahead.u - ahead.u, later.rates - soon.rates]) / step
            e[at_sets] = np.where(goes[:, None], ahead.e, e[at_sets])
            self.sticks[at_sets] = found.sticks & ahead.sticks
            return

    def _wait(self, dt: float) -> None:
        """Go on for a moment with the contacts that stick."""
        last = self.state + dt * self.rate
        here = self._take(Step(self.t, dt, self.state, last, (last - self.state)[:, None]), ends=False)
        self.rate = self._slopes(here)[1]

    def _decided(self, here: Local, at_sets: Flags) -> Decided:
        Q = self._slip_force(here, np.where(at_sets[:, None], 0.0, self.law.e(here.x)), at_sets)
        return decide_contacts(here.M, Q, here.J[at_sets], here.k[at_sets], here.r[at_sets])
