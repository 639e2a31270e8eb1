"""Phases of a regularised motion: slip, slide, cross, by the set of the layer problem that its states follow.

A motion is in contact with Sigma while r = |(x, y)| is of order eps: there, and only there, |p| < 1 in the limit. If it
follows a critical set or cycle while in contact (see `followed_critical_set`), the phase is a slide, from the contact
on; a contact that follows nothing is a crossing. So, as eps goes to 0, the phases become those of the nonsmooth limit,
where contact takes no time.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from ..numerics.arclength import distance
from ..numerics.dense import Dense
from ..portrait.cycles.limit_cycles import limit_cycles
from ..results.arrays import Array
from ..results.words import say
from ..systems.kinds import AnySystem
from ..systems.psi.function import Psi
from .initial_value.field import Field, field
from .limit.sigma_decision import critical_name, decide_from_hemisphere
from .locations import OfState, TrackedSet, followed_critical_set, place_on_hemisphere
from .result import Phase

CONTACT_RADIUS = 20.0  # r in units of eps within which a motion is in contact with Sigma
FOLLOWING_RADIUS = 3.0  # and from which on what it follows then is said to begin: |p| < 0.95
MAX_HALVINGS = 45
PASSING = (
    35.0  # e-foldings: what does not attract, and is followed no longer than rounding takes to leave it, is passed
)
SAME_SET_DISTANCE = 0.1  # in e: two runs on one set, interrupted, whose e are no further apart
TURNS = 2.0  # round the middle of a stay at Sigma, from which on a limit cycle is searched for
ON_CYCLE = 0.04  # in p, in addition to eps: distance to a cycle that is followed
ASKED = 7  # states of a stay that are held against the limit cycles at their z


@dataclass(frozen=True)
class _Run:
    """Part of a motion, from step end `first` to `last`, on one set."""

    first: int
    last: int
    t_start: float
    t_end: float
    onto: str
    e: tuple[Array, Array] | None  # at both ends; None on a cycle
    attracts: tuple[bool, bool] = (True, True)  # also


@dataclass(frozen=True)
class _ReadMotion:
    """A motion that is read."""

    system: AnySystem
    psi: Psi
    eps: float
    motion: Dense
    formulas: Field
    turns: tuple[float, ...]  # when a set loses its stability that the motion then passes

    @property
    def times(self) -> Array:
        return self.motion.times

    @property
    def states(self) -> Array:
        return self.motion.states

    def is_near(self, state: Array) -> bool:
        return math.hypot(state[0], state[1]) <= CONTACT_RADIUS * self.eps

    def set_at(self, state: Array) -> TrackedSet | None:
        return followed_critical_set(self.formulas, self.psi, self.eps, state)

    def boundary(self, i: int, holds: Callable[[Array], bool]) -> float:
        """Time within the step from end i to end i + 1 at which `holds` changes."""
        before = holds(self.states[i])
        low, high = 0.0, 1.0
        for _ in range(MAX_HALVINGS):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if holds(self.motion.in_step(i, middle)) == before else (low, middle)
        return min(float(self.times[i] + high * self.motion.lengths[i]), float(self.times[i + 1]))

    def stays(self) -> Iterator[tuple[int, int]]:
        """Contacts, as first and last step end; returns from within a middle distance belong to the same contact."""
        r = np.hypot(self.states[:, 0], self.states[:, 1])
        middle = max(CONTACT_RADIUS * self.eps, math.sqrt(CONTACT_RADIUS * self.eps * float(r.max())))
        contact, i = r <= CONTACT_RADIUS * self.eps, 0
        within = r <= middle
        while i < len(r):
            if not contact[i]:
                i += 1
                continue
            last = end = i
            while end + 1 < len(r) and within[end + 1]:
                end += 1
                last = end if contact[end] else last
            # What is followed further out, close to the equator, belongs to the contact too.
            while last < end and self.set_at(self.states[last + 1]) is not None:
                last += 1
            first = i
            while first > 0 and within[first - 1] and self.set_at(self.states[first - 1]) is not None:
                first -= 1
            yield first, last
            i = end + 1

    def runs(self, first: int, last: int) -> list[_Run]:
        """Return the sets followed in one contact, in order."""
        found = [self.set_at(self.states[i]) for i in range(first, last + 1)]
        runs: list[_Run] = []
        i = 0
        while i < len(found):
            start = found[i]
            if start is None:
                i += 1
                continue
            begin = i
            while i + 1 < len(found) and self.goes_on(found[i], found[i + 1], first + i):
                i += 1
            end = found[i]
            assert end is not None
            run = self.on_set(first + begin, first + i, start, end)
            if self.is_followed(run, found[begin : i + 1]):
                runs.append(run)
            i += 1
        return _join_runs(self.with_cycles(first, last, runs))

    def goes_on(self, here: TrackedSet | None, there: TrackedSet | None, i: int) -> bool:
        """Whether two step ends in a row follow the same set."""
        if here is None or there is None:
            return False
        middle = self.set_at(self.motion.in_step(i, 0.5))
        if middle is None:
            return bool(np.hypot(*(here.e - there.e)) < SAME_SET_DISTANCE)
        return float(np.hypot(*(here.e - middle.e)) + np.hypot(*(there.e - middle.e))) < 3.0 * SAME_SET_DISTANCE

    def on_set(self, first: int, last: int, start: TrackedSet, end: TrackedSet) -> _Run:
        holds = lambda state: self.set_at(state) is not None
        t_start = self.boundary(first - 1, holds) if first > 0 and not holds(self.states[first - 1]) else None
        t_end = None
        if last + 1 < len(self.times):
            t_end = self.boundary(last, holds) if not holds(self.states[last + 1]) else float(self.times[last])
        return _Run(
            first,
            last,
            float(self.times[first]) if t_start is None else t_start,
            float(self.times[last]) if t_end is None else t_end,
            critical_name(self.system, self.psi, self.states[first, 2:], start.e),
            (start.e, end.e),
            (start.attracts, end.attracts),
        )

    def name_past(self, run: _Run, t: float) -> str:
        """Name a set past a time at which it meets others."""
        state = self.motion(min(t + 1e-3 * (run.t_end - t), run.t_end))
        here = self.set_at(state)
        return run.onto if here is None else critical_name(self.system, self.psi, state[2:], here.e)

    def is_followed(self, run: _Run, found: list[TrackedSet | None]) -> bool:
        """Whether it is more than passed: anything that attracts is followed once it is reached."""
        if any(one is not None and one.attracts for one in found):
            return True
        slowest = min(one.rate for one in found if one is not None)
        return (run.t_end - run.t_start) * slowest > PASSING * self.eps

    def with_cycles(self, first: int, last: int, runs: list[_Run]) -> list[_Run]:
        """Look for limit cycles where the motion turns between the runs on critical sets."""
        cuts = [first, *(i for run in runs for i in (run.first, run.last)), last]
        gaps = [(cuts[k], cuts[k + 1]) for k in range(0, len(cuts), 2)]
        found = [self.on_cycle(a, b) for a, b in gaps if b - a > 8]
        return sorted([*runs, *(run for run in found if run is not None)], key=lambda run: run.t_start)

    def on_cycle(self, first: int, last: int) -> _Run | None:
        """Return the limit cycle that the motion follows from one step end to another."""
        xy = self.states[first : last + 1, :2]
        if float(np.abs(self.turning_angle(xy))) < TURNS * math.tau:
            return None
        followed: list[tuple[int, str]] = []
        for i in np.unique(np.linspace(first, last, ASKED + 1)[1:].astype(int)).tolist():
            p = place_on_hemisphere(self.psi, self.eps, *self.states[i, :2].tolist())[1]
            cycles = limit_cycles(self.system, self.psi, tuple(self.states[i, 2:].tolist()))
            for k, cycle in enumerate(cycles):
                if cycle.stable and _distance(p, cycle.points) <= ON_CYCLE + CONTACT_RADIUS * self.eps:
                    followed.append((i, f"cycle {k + 1}"))
        if not followed:
            return None
        (begin, onto), (end, _) = followed[0], followed[-1]
        return _Run(begin, end, float(self.times[begin]), float(self.times[end]), onto, None)

    def turning_angle(self, xy: Array) -> float:
        """Angle through which a part of the motion turns about its middle."""
        about = xy - 0.5 * (xy.min(axis=0) + xy.max(axis=0))
        angle = np.unwrap(np.arctan2(about[:, 1], about[:, 0]))
        return float(angle[-1] - angle[0])

    def leads_to(self, state: Array) -> str | None:
        """Name of the set onto which the orbit of the layer problem through the state leads; None if it leaves."""
        p = place_on_hemisphere(self.psi, self.eps, float(state[0]), float(state[1]))[1]
        if not math.hypot(p[0], p[1]) < 1.0:
            return None
        try:
            verdict = decide_from_hemisphere(self.system, self.psi, state[2:], p[None])
        except ValueError:  # at the edge of where the formulas are defined
            return None
        return verdict.onto if verdict.kind in ("slide", "cycle") else None

    def phases(self) -> Iterator[Phase]:
        """All of them: between contacts the motion slips."""
        t, t_end = float(self.times[0]), float(self.times[-1])
        reason = say("starts outside")
        for first, last in self.stays():
            initial, final = first == 0, last + 1 == len(self.times)
            runs = self.runs(first, last)
            begins = t if initial else self.contact(first, last, runs)
            ends = t_end if final else max(self.boundary(last, self.is_near), runs[-1].t_end if runs else t)
            onto = self.leads_to(self.states[-1]) if final and (not runs or runs[-1].t_end < t_end) else None
            if onto is not None:
                if runs and runs[-1].onto == onto:
                    runs[-1] = replace(runs[-1], t_end=t_end)
                else:
                    runs.append(_Run(last, last, runs[-1].t_end if runs else begins, t_end, onto, None))
            if not runs:
                if initial:  # it leaves, whatever follows: as in the limit, where that takes no time
                    reason = say("starts, follows nothing")
                    continue
                yield Phase("slip", t, begins, reason)
                yield Phase("cross", begins, ends, say("passes", near=CONTACT_RADIUS))
                t, reason = ends, say("has left", near=CONTACT_RADIUS)
                continue
            if not initial:
                yield Phase("slip", t, begins, reason)
            starts = [begins, *(run.t_end for run in runs[:-1])]
            for k, (run, start) in enumerate(zip(runs, starts, strict=True)):
                why = _phase_reason(run, "goes on" if k else "starts, follows" if initial else "comes, follows")
                if initial and not k and not run.attracts[0] and not self.states[0, :2].any():
                    why = say("starts on a repelling set", onto=run.onto)
                onto = run.onto
                for turn in (turn for turn in self.turns if start < turn < run.t_end):
                    yield Phase("slide", start, turn, why, onto)
                    start, onto = turn, self.name_past(run, turn)
                    why = say("passed", onto=onto)
                yield Phase("slide", start, run.t_end, why, onto)
            t, reason = runs[-1].t_end, say("no longer follows", onto=runs[-1].onto)
        if t < t_end or t == float(self.times[0]) == t_end:
            yield Phase("slip", t, t_end, reason)

    def contact(self, first: int, last: int, runs: list[_Run]) -> float:
        """Return the time at which a contact, from one step end to another, begins."""
        close = lambda state: math.hypot(state[0], state[1]) <= FOLLOWING_RADIUS * self.eps
        for i in range(first, (runs[0].first if runs else last) + 1):
            if close(self.states[i]):
                return self.boundary(i - 1, close)
        if runs:
            return runs[0].t_start
        return self.boundary(first - 1, self.is_near)


def phases_of(system: AnySystem, psi: Psi, eps: float, motion: Dense, turns: tuple[float, ...]) -> tuple[Phase, ...]:
    """Cut a motion into consecutive phases, from the first to the last time."""
    reader = _ReadMotion(system, psi, eps, motion, field(system), turns)
    phases = list(reader.phases())
    return tuple(replace(one, _place=OfState(motion, psi, eps, one.t_start, one.t_end)) for one in phases)


def _phase_reason(run: _Run, how: str) -> str:
    onto = f"limit {run.onto}" if run.onto.startswith("cycle") else f"the critical set {run.onto}"
    return say(how, onto=onto)


def _join_runs(runs: list[_Run]) -> list[_Run]:
    """Join runs on one set that an excursion interrupts."""
    found: list[_Run] = []
    for run in runs:
        before = found[-1] if found else None
        if before is not None and before.onto == run.onto and _close(before, run):
            found[-1] = replace(
                before,
                last=run.last,
                t_end=run.t_end,
                e=(before.e[0], run.e[1]) if before.e and run.e else None,
                attracts=(before.attracts[0], run.attracts[1]),
            )
        else:
            found.append(run)
    return found


def _close(before: _Run, after: _Run) -> bool:
    if after.attracts[0] and not before.attracts[1]:  # it left one that repels, for another
        return False
    if after.first <= before.last + 1:
        return True
    return not (before.e and after.e) or float(np.hypot(*(before.e[1] - after.e[0]))) < SAME_SET_DISTANCE


def _distance(p: Array, points: Array) -> float:
    """Distance of a point to a closed polyline."""
    return float(distance(p, np.concatenate([points, points[:1]])))
