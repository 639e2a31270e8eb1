"""Motions of the nonsmooth system, eps -> 0: slip, arrival at Sigma, sliding or crossing, exit; by events."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from dataclasses import field as made_with
from functools import partial

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..cycles.limit_cycles import limit_cycles
from ..initial_value.events import Events, Watch, checked_events
from ..initial_value.field import Field, field
from ..initial_value.line import Line, invariant_line
from ..initial_value.problem import plane_problem
from ..numerics.dense import Dense, dense, gathered
from ..numerics.growth import BlowUpError
from ..numerics.radau import Problem, Step, TooManyStepsError
from ..psi import constructors
from ..psi.function import Psi
from ..systems.kinds import AnySystem
from .decide import Verdict, arriving, critical_name, from_hemisphere, starting
from .followed import in_disc
from .places import Ascent, Leaving, OfState, OnCycle, OnSet, Place
from .regularised import MAX_STEPS, checked_span, checked_state, checked_tolerances
from .result import Phase, Simulation, SimulationStatus, simulation
from .slide import slide
from .slide_on_cycle import slide_on_cycle
from .slip import leave, slip

__all__ = ["simulate_nonsmooth"]

Array = NDArray[np.float64]

ON_SIGMA = 1e-200  # rho below which a state is on Sigma
CLOSER = 1e-4  # a trajectory that turns before Sigma is followed this much closer, and asked again
AROUND = 16  # points of a cycle that has ended, from which orbits are followed
PAST = 1e-6  # of the time ahead: how far past a Hopf bifurcation its cycle is looked for


class _Stop(Exception):
    """The limit is not unique, or not known; the message says why."""


class _AtEventError(Exception):
    """A terminal event."""


@dataclass(frozen=True)
class _Part:
    """A phase whose motion is under way: made a `Phase` when all of it is known."""

    phase: Phase
    times: list[float]
    ascent: Ascent | None
    e: Sequence[Array] = ()  # at `times`, while it slides
    p: Sequence[Array] = ()  # also, while it slides on a cycle of a general system
    theta: float | None = None  # in which a crossing leaves

    def placed(self, course: _Course, motion: Dense) -> Phase:
        phase, times = self.phase, np.array(self.times)
        e, p = (np.array(column[: len(times)]) for column in (self.e, self.p))
        times = times[: len(e)] if len(e) else times
        where: Place
        if self.theta is not None:
            where = Leaving(self.theta)
        elif phase.kind != "slide":
            where = OfState(motion, None, 0.0, phase.t_start, phase.t_end)
        elif len(p):
            where = OnCycle(times, e, p)
        else:
            where = OnSet(course.system, course.own, motion, times, e)
        return replace(phase, _place=where, _ascent=self.ascent)


@dataclass
class _Course:
    """A motion under way."""

    system: AnySystem
    psi: Psi | None
    formulas: Field
    problem: Problem
    line: Line | None
    watch: Watch
    t: float
    state: Array
    t_end: float
    rtol: float
    atol: float
    most: int
    taken: list[Step] = made_with(default_factory=list)
    parts: list[_Part] = made_with(default_factory=list)
    ascent: Ascent | None = None  # of the phase to come

    @property
    def own(self) -> Psi:
        return constructors.constant() if self.psi is None else self.psi

    @property
    def left(self) -> int:
        return self.most - len(self.taken) - len(self.parts)

    def add(
        self,
        kind: str,
        taken: list[Step],
        reason: str,
        onto: str | None = None,
        e: Sequence[Array] = (),
        p: Sequence[Array] = (),
    ) -> None:
        """Add a phase, as far as no terminal event stops it."""
        start, kept, stopped = self.t, list[Step](), False
        for step in taken:
            last = self.watch.step(step)
            kept.append(step if last is None else last)
            if last is not None:
                stopped = True
                break
        times = [start, *(step.end for step in kept)]
        if kept:
            self.taken += kept
            self.t, self.state = max(kept[-1].end, start), kept[-1].last
        self.parts.append(_Part(Phase(kind, start, self.t, reason, onto), times, self.ascent, e, p))
        self.ascent = None
        if stopped:
            raise _AtEventError

    def run(self) -> None:
        on = not self.state[:2].any()
        verdict = self.first() if on else self.slip([], "The motion starts outside Σ.")
        while verdict is not None and self.t < self.t_end:
            if self.left <= 0:
                raise TooManyStepsError
            if verdict.kind == "stop":
                raise _Stop(verdict.reason)
            verdict = self.leave(verdict) if verdict.kind == "leave" else self.slide(verdict)

    def first(self) -> Verdict:
        """Decide what follows from a start on Sigma."""
        if self.line is not None:
            return self.in_line(0.0, "The motion starts at Σ, in an invariant line.")
        verdict = starting(self.system, self.psi, self.state[2:])
        if self.psi is not None:
            self.ascent = Ascent(self.system, self.psi, self.state[2:].copy(), start=np.zeros(2))
        return self.at_border(verdict) if verdict.kind == "border" else verdict

    def in_line(self, q: float, reason: str) -> Verdict:
        """Decide what follows on Sigma in an invariant line, where the layer problem is that of one variable."""
        assert self.line is not None
        z, n = self.state[2:], self.line.n
        onward = self.line.onward(q, z)
        if onward is None:
            if self.line.slope(q, z) >= 0.0:
                return Verdict("stop", f"{reason} It rests on a critical set that repels along the line.")
            onward = q
        self.ascent = Ascent(self.system, self.own, z, along=(in_disc(self.own, q * n), in_disc(self.own, onward * n)))
        if abs(onward) < 1.0:
            e = onward * n
            onto = critical_name(self.system, self.own, z, e)
            return Verdict("slide", f"{reason} Along it comes the critical set {onto}: sliding.", e, onto=onto)
        theta = math.atan2(*(onward * n)[::-1].tolist())
        reason = f"{reason} Along it there is no critical set: crossing, it leaves along θ = {theta:.4g}."
        return Verdict("leave", reason, theta=theta)

    def slip(self, begun: list[Step], reason: str) -> Verdict | None:
        """Slip, and decide what follows at Sigma."""
        taken, t, state = list(begun), self.t, self.state
        if begun:
            t, state = begun[-1].end, begun[-1].last
        largest = 0.0
        while True:
            part = slip(self.problem, t, state, self.t_end, self.rtol, self.left, largest)
            if part.theta is None:
                self.add("slip", taken + part.taken, reason)
                if part.stopped is not None:
                    raise part.stopped
                return None
            if self.line is not None:
                self.add("slip", taken + part.taken, reason)
                q = float(self.line.n @ [math.cos(part.theta), math.sin(part.theta)])
                return self.crossed(self.in_line(math.copysign(1.0, q), "Arrives at Σ in an invariant line."))
            z = part.taken[-1].last[2:]
            verdict = arriving(self.system, self.psi, z, part.theta)
            if verdict.kind != "away":
                self.add("slip", taken + part.taken, reason)
                self.ascent = Ascent(self.system, self.own, z, part.theta)
                return self.crossed(verdict)
            # It will turn away from Sigma: go on from where it was close, and look again from closer.
            taken += part.taken[:-1]
            t, state = taken[-1].end, taken[-1].last
            largest = math.hypot(state[0], state[1]) * CLOSER

    def crossed(self, verdict: Verdict) -> Verdict:
        """Name the crossing, where what follows an arrival is to leave."""
        if verdict.kind == "leave":
            phase = Phase("cross", self.t, self.t, verdict.reason)
            self.parts.append(_Part(phase, [self.t], self.ascent, theta=verdict.theta))
            self.ascent = None
        return verdict

    def leave(self, verdict: Verdict) -> Verdict | None:
        assert verdict.theta is not None
        first = leave(self.formulas, verdict.theta, self.t, self.state[2:], self.t_end, self.line)
        if isinstance(first, str):
            raise _Stop(f"{verdict.reason} But {first}")
        crossed = bool(self.parts) and self.parts[-1].phase.kind == "cross"
        reason = f"Leaves Σ along θ = {verdict.theta:.4g}." if crossed else verdict.reason
        return self.slip([first], reason)

    def slide(self, verdict: Verdict) -> Verdict | None:
        assert verdict.e is not None
        on_cycle = verdict.kind == "cycle"
        if on_cycle and self.system.typed is not None:
            return self.slide_on_cycle(verdict)
        lives = self.has_cycle if on_cycle else None
        part = slide(
            self.formulas,
            self.own,
            verdict.e,
            self.t,
            self.state[2:],
            self.t_end,
            rtol=self.rtol,
            atol=self.atol,
            most=self.left,
            lives=lives,
            line=self.line,
        )
        self.add("slide", part.taken, verdict.reason, verdict.onto, part.places)
        if part.stopped is not None:
            raise part.stopped
        C = "C" if on_cycle else verdict.onto
        if part.end == "time":
            return None
        if part.end == "equator":
            theta = math.atan2(part.e[1], part.e[0])
            reason = f"{C} reaches the equator (fig:transcrit) and sliding ends: slips away along θ = {theta:.4g}."
            return Verdict("leave", reason, theta=theta)
        if part.end == "fold" and self.line is not None:
            return self.past_fold_in_line(self.line, part.e, C)
        if part.end == "fold":
            return self.past_fold(part.e, C)
        if part.end == "cycle":
            return self.past_cycle(self.ahead(part.e, PAST))
        if on_cycle:
            return Verdict("slide", f"The limit cycle shrinks onto {C} (Hopf): sliding on {C}.", part.e, onto=C)
        return self.past_hopf(part.e, C)

    def slide_on_cycle(self, verdict: Verdict) -> Verdict | None:
        """Slide on a limit cycle of a general system."""
        assert verdict.onto is not None
        index, z = int(verdict.onto.split()[1]) - 1, self.state[2:]
        if not len(z):
            raise _Stop(f"{verdict.reason} There is no z to follow (m = 0).")
        part = slide_on_cycle(self.system, self.own, index, self.t, z, self.t_end, self.left)
        self.add("slide", part.taken, verdict.reason, verdict.onto, part.e, part.p)
        if part.lives:
            return None
        if not part.taken:
            return Verdict("stop", "The limit cycle ends at once: where orbits go from it is not known.")
        return self.past_cycle(self.state[2:] + 10.0 * (self.state[2:] - part.taken[-1].first[2:]))

    def ahead(self, e: Array, part: float) -> Array:
        """Return z a small part of the time ahead, along the slow flow at e."""
        z = self.state[2:]
        flow = self.formulas.value(float(e[0]), float(e[1]), 0.0, 0.0, *z.tolist())[2:]
        return z + part * (self.t_end - self.t) * np.array(flow)

    def past_fold_in_line(self, line: Line, e: Array, C: str | None) -> Verdict:
        """C has met another critical set in the line: the layer problem leads on from there, just past the fold."""
        here, q = self.state.copy(), float(line.n @ e)
        self.state[2:] = self.ahead(e, PAST)
        verdict = self.in_line(q, f"{C} ends in a fold.")
        self.state = here
        return verdict

    def past_fold(self, e: Array, C: str | None) -> Verdict:
        """C has met another critical set and both are gone: follow the orbit that leaves the place."""
        reason = f"{C} ends in a fold (det J = 0)."
        point = in_disc(self.own, e)[None]
        self.ascent = Ascent(self.system, self.own, self.ahead(e, PAST), start=point[0])
        # Just past the fold orbits take long to leave the place; a little further they are followed to their end.
        for further in (1.0, 1e2, 3e3):
            verdict = self.onward(reason, self.ahead(e, further * PAST), point)
            if verdict.kind != "stop":
                break
        return verdict

    def past_cycle(self, ahead: Array) -> Verdict:
        """Follow orbits from all around a cycle that has ended."""
        reason = "The limit cycle ends."
        last = [cycle for cycle in limit_cycles(self.system, self.own, tuple(self.state[2:].tolist())) if cycle.stable]
        if len(last) != 1:
            return Verdict("stop", f"{reason} Where orbits go from it was not found.")
        points = last[0].points
        verdict = self.onward(reason, ahead, points[:: max(1, len(points) // AROUND)])
        if verdict.kind == "cycle":  # it comes and goes within the resolution of the search
            return Verdict("stop", f"{reason} Where orbits go from it is not decided within resolution.")
        return verdict

    def onward(self, reason: str, z: Array, points: Array) -> Verdict:
        """Follow orbits of the layer problem from where an attractor was."""
        try:
            verdict = from_hemisphere(self.system, self.own, z, points)
        except ValueError as error:  # at the edge of where the formulas are defined
            return Verdict("stop", f"{reason} {error}")
        if self.psi is None and verdict.kind != "stop":
            return Verdict("stop", f"{reason} Where orbits go from there may depend on Ψ: give psi.")
        return replace(verdict, reason=f"{reason} {verdict.reason}")

    def has_cycle(self, z: Array) -> bool:
        return any(cycle.stable for cycle in limit_cycles(self.system, self.own, tuple(z.tolist())))

    def past_hopf(self, e: Array, C: str | None) -> Verdict:
        """C has lost its stability to the fast flow: slide on the cycle born there, if it is stable."""
        if any(self.has_cycle(self.ahead(e, part)) for part in (PAST, 100.0 * PAST)):
            if self.system.typed is not None:
                reason = f"{C} loses its stability (Hopf) to a stable limit cycle: after what delay is left to ε."
                return Verdict("stop", reason)
            reason = (
                f"{C} loses its stability (Hopf) to a stable limit cycle: sliding, with z' averaged over the cycle, "
                "which is that on C (prop:LC)."
            )
            return Verdict("cycle", reason, e, onto="cycle 1")
        given = "" if self.psi is not None else " (for Ψ = 1; none was given)"
        return Verdict("stop", f"{C} loses its stability (Hopf){given}, and no stable limit cycle takes over.")

    def at_border(self, verdict: Verdict) -> Verdict:
        """Start where the critical set lies on the equator: it moves in, or lambda_rho becomes positive."""
        assert verdict.theta is not None
        first = leave(self.formulas, verdict.theta, self.t, self.state[2:], self.t_end)
        if isinstance(first, str):
            return Verdict("slide", f"{verdict.reason} It moves inwards: sliding.", verdict.e, onto="C")
        return Verdict("leave", f"{verdict.reason} It moves out: slips.", theta=verdict.theta)


def simulate_nonsmooth(
    system: AnySystem,
    state0: ArrayLike,
    t_span: ArrayLike,
    psi: Psi | None = None,
    *,
    rtol: float = 1e-10,
    atol: float = 1e-12,
    events: Events = (),
    max_steps: int = MAX_STEPS,
) -> Simulation:
    """Follow one motion of eq:vf itself, as the limit eps -> 0 of the regularised system.

    Outside Sigma the system slips; it arrives at Sigma in finite time along a limit direction; the orbit that continues
    it on the hemisphere decides what follows (thm:geneps0(b), sec:geneps1): sliding on the critical set that it comes
    to, with its slow flow, or crossing. Sliding ends where the critical set does.

    The regularised motion differs from it by O(eps), as long as it does not leave Sigma. Leaving along a limit
    direction, also after a crossing, it differs by O(eps^min(1, |lambda_theta|/lambda_rho)), outside an invariant line;
    after an exit through the equator (fig:transcrit) by O(eps^(2 q/(1 + 2 q))) where Psi ~ s^(1 - q/2): 4/5 for
    Psi = 1, near 1 for one that falls exponentially. See `agreement.limit_order`.

    Parameters
    ----------
    system : ELinear, System, or one of them frozen at a z
    state0 : (2 + m,)
        (x, y, z1, ..., zm). On Sigma x = y = 0 is p = 0 for every eps: the orbit of the layer problem through it
        decides. Without psi: slides if one critical set attracts, else leaves along the one way out.
    t_span : (t_start, t_end)
        Increasing.
    psi : Psi, optional
        The regularisation of which this is the limit. Left out, the motion stops where it would matter.
    rtol, atol : float
        Error allowed in a step: rtol rho for x and y, rtol |z| + atol for z. rtol from 1e-13 to 0.01.
    events : sequence of Event, or of callables (t, state) to float
        As in `simulate`. An event that is zero over a while, as x is while sliding, counts where it becomes zero.
    max_steps : int
        Steps and phases before the motion is given up, with a status that says so.

    Returns
    -------
    Simulation
        Its status is NOT_UNIQUE, with a reason, where the limit is not unique or not known; the motion ends there.

    Raises
    ------
    ValueError
        An argument is invalid.

    Examples
    --------
    >>> from codim2_core import examples
    >>> run = simulate_nonsmooth(examples.ball_in_pool(K=0.0, mu=0.25, g=8.0), (1.0, 0.0, 1.0, 0.0), (0.0, 1.0))
    >>> [(phase.kind, round(phase.t_end, 9)) for phase in run.phases]
    [('slip', 0.142857143), ('slide', 1.0)]
    """
    t_start, t_end = checked_span(t_span)
    checked_tolerances(rtol, atol, max_steps)
    formulas = field(system)
    first = checked_state(state0, formulas.m)
    if math.hypot(first[0], first[1]) < ON_SIGMA:
        first[:2] = 0.0
    count = [0]
    value = formulas.value

    def counted(*arguments: float) -> tuple[float, ...]:
        count[0] += 1
        return value(*arguments)

    formulas = Field(formulas.m, formulas.rows, counted, formulas.slope)
    line = invariant_line(formulas, first)
    problem = plane_problem(formulas, None, 0.0, rtol, atol)
    problem = problem if line is None else line.projected(problem)
    watch = Watch(checked_events(events), t_start, first)
    course = _Course(system, psi, formulas, problem, line, watch, t_start, first, t_end, rtol, atol, max_steps)
    status, detail = SimulationStatus.T_END, ""
    try:
        course.run()
    except _AtEventError:
        status = SimulationStatus.EVENT
    except _Stop as stop:
        status, detail = SimulationStatus.NOT_UNIQUE, str(stop)
    except BlowUpError as error:
        status, detail = SimulationStatus.BLOW_UP, str(error)
    except TooManyStepsError as error:
        status, detail = SimulationStatus.STEP_LIMIT, str(error)
    motion = dense(t_start, first, [gathered(course.taken, len(first))])
    phases = partial(tuple, [part.placed(course, motion) for part in course.parts])
    return simulation(motion, phases, status, detail=detail, evaluations=count[0], events=watch.times)
