"""The course of a nonsmooth motion: it slips, arrives at Sigma, slides or crosses, and leaves, phase after phase."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from dataclasses import field as made_with
from typing import Any

import numpy as np

from ...formulas.arrays import path_program
from ...numerics.along import zeros_along
from ...numerics.hybrid import AtEventError, PhaseRun, StopError
from ...numerics.radau import Step
from ...portrait.cycles.limit_cycles import limit_cycles
from ...portrait.layer_problem.equator import equator_equilibria
from ...results.arrays import Array
from ...results.words import say
from ...systems.kinds import AnySystem
from ...systems.psi import constructors
from ...systems.psi.function import Psi
from ..initial_value.events import EventWatch
from ..initial_value.field import Field
from ..initial_value.line import InvariantLine, invariant_line
from ..locations import Ascent, in_disc
from ..result import Phase
from .delay import REST_CHANGE, NotAnalyticError, cut_at_delayed_exit, departure_point, exit_circle
from .fold_classification import Fold, classify_fold
from .pending_phase import PendingDelay, PendingPhase
from .sigma_decision import (
    Decision,
    critical_name,
    decide_arrival,
    decide_border,
    decide_from_hemisphere,
    decide_start,
    hold,
    let_go,
)
from .slide import Slide, slide, slide_on_cycle
from .slip import leave, slip

CLOSER_FACTOR = 1e-4  # a trajectory that turns before Sigma is followed this much closer, and asked again
SAME_DIRECTION = 1e-12  # 1 - cos: directions that differ by a rounding of either
CYCLE_POINTS = 16  # points of a cycle that has ended, from which orbits are followed
PAST = 1e-6  # of the time ahead, or of the slide behind: how far past its end it is looked at what follows


@dataclass
class HybridRun(PhaseRun[Decision]):
    """A motion in the limit under way; the layer problem decides what follows."""

    system: AnySystem
    psi: Psi | None
    formulas: Field
    line: InvariantLine | None
    watch: EventWatch
    stiction: float = 1.0
    jumps: dict[float, bool] = made_with(default_factory=dict)  # times of jumps, and whether time alone decides them
    evaluations: int = 0
    ascent: Ascent | None = None  # of the phase to come
    leaving: Array | None = None  # points of the disc by which the set is left that is slid on, where they are known

    @property
    def own(self) -> Psi:
        """Psi, or Psi = 1 where none is given."""
        return constructors.constant() if self.psi is None else self.psi

    def enter_branch(self, e: Array, state: Array, t: float, switch: int | None = None) -> None:
        """Enter the branch of the formulas ahead, without a switch another line; StopError if it leads back."""
        left = self.line
        if self.formulas.switches or switch is not None:
            at = e.tolist(), state.tolist()
            ahead = self.formulas.on_branch(*at) if switch is None else self.formulas.past_switch(switch, *at)
            if ahead is None:
                raise StopError(say("load switches back"))
            if switch is not None and self.formulas.branch.jumps[switch]:
                self.jumps[t] = self.formulas.jumps_by_time(switch)
            self.formulas, self.system, left = ahead, ahead.system, None
        self.line = invariant_line(self.formulas, state, left)

    def add(
        self,
        kind: str,
        taken: list[Step],
        reason: str,
        onto: str | None = None,
        e: Sequence[Array] = (),
        p: Sequence[Array] = (),
        delaying: PendingDelay | None = None,
    ) -> None:
        """Add a phase, as far as no terminal event stops it."""
        start, kept, stopped = self.t, taken, False
        for i, step in enumerate(taken if self.watch.events else ()):
            last = self.watch.step(step)
            if last is not None:
                kept, stopped = [*taken[:i], last], True
                break
        times = [start, *(step.end for step in kept)] if len(e) else []
        if kept:
            self.taken += kept
            # Rounding may put the end of a step before that of the last: times never decrease, here as in `dense`.
            self.t, self.state = max(start, *(step.end for step in kept)), kept[-1].last
        delaying = replace(delaying, way=None) if stopped and delaying is not None else delaying
        phase = Phase(kind, start, self.t, reason, onto)
        self.phases.append(PendingPhase(phase, times, self.ascent, e, p, delaying=delaying))
        self.ascent = None
        if stopped:
            raise AtEventError(self.watch.reason)

    def phase(self, decision: Decision) -> Decision | None:
        """Follow what was decided, and decide what follows."""
        if decision.kind == "stop":
            raise StopError(decision.reason)
        return self.leave(decision) if decision.kind == "leave" else self.slide(decision)

    def first(self) -> Decision | None:
        """Decide what follows from a start, or slip where it is outside Sigma."""
        if self.state[:2].any():
            return self.slip([], say("starts outside"))
        if self.psi is not None and self.formulas.rests and not self.attracts_at_rest():
            return self.stay()
        if self.line is not None:
            return self.in_line(0.0, say("starts in a line"))
        held = hold(self.formulas, None, self.state[2:], self.stiction)
        if held is not None:
            return held
        decision = decide_start(self.system, self.psi, self.state[2:])
        if self.psi is not None:
            self.ascent = Ascent(self.system, self.psi, self.state[2:].copy(), start=np.zeros(2))
        return self.at_border(decision) if decision.kind == "border" else decision

    def stay(self) -> Decision | None:
        """Stay at x = y = 0, which is invariant and does not attract: as the motion does for every eps."""
        onto = critical_name(self.system, self.own, self.state[2:], np.zeros(2))
        part = self.slid(np.zeros(2), delayed=True, resting=True)
        return self.follow(part, say("starts on a repelling set", onto=onto), onto)

    def attracts_at_rest(self) -> bool:
        """Whether e = 0, a critical set for every z, attracts in the layer problem: whatever Psi is, as D e_Psi ~ 1."""
        slopes = self.formulas.jacobian(0.0, 0.0, 0.0, 0.0, self.state[2:].tolist())[:2, :2]
        return bool((np.linalg.eigvals(slopes).real < 0.0).all())

    def in_line(self, q: float, reason: str) -> Decision:
        """Decide what follows on Sigma in an invariant line, where the layer problem is that of one variable."""
        assert self.line is not None
        z, n = self.state[2:], self.line.n
        held = hold(self.formulas, self.line, z, self.stiction)
        if held is not None:
            return replace(held, reason=f"{reason} {held.reason}")
        onward = self.line.onward(q, z)
        if onward is None:
            if self.line.slope(q, z) >= 0.0:
                return Decision("stop", f"{reason} {say('rests on a repelling set')}")
            onward = q
        self.ascent = Ascent(self.system, self.own, z, along=(in_disc(self.own, q * n), in_disc(self.own, onward * n)))
        if abs(onward) < 1.0:
            e = onward * n
            onto = critical_name(self.system, self.own, z, e)
            return Decision("slide", f"{reason} {say('slides in a line', onto=onto)}", e, onto=onto)
        theta = math.atan2(*(onward * n)[::-1].tolist())
        if self.on_equator(theta, z):
            return self.at_border(Decision("border", f"{reason} {say('on the equator')}", onward * n, theta, "C"))
        reason = f"{reason} {say('crosses in a line', theta=theta)}"
        return Decision("leave", reason, theta=theta)

    def slip(self, begun: list[Step], reason: str) -> Decision | None:
        """Slip, and decide what follows at Sigma."""
        taken, t, state = list(begun), self.t, self.state
        if begun:
            t, state = begun[-1].end, begun[-1].last
        largest = 0.0
        options: dict[str, Any] = {"rtol": self.rtol, "atol": self.atol, "max_step": self.max_step}
        while True:
            most = self.left - len(taken)
            part = slip(self.formulas, self.line, (t, self.t_end), state, most=most, largest=largest, **options)
            self.evaluations += part.evaluations
            self.undecided += part.undecided
            if part.switch is not None or part.leaves_line:
                taken += part.taken
                t, state = (taken[-1].end, taken[-1].last) if taken else (t, state)
                try:
                    self.enter_branch(state[:2] / math.hypot(*state[:2].tolist()), state, t, part.switch)
                except StopError:
                    self.add("slip", taken, reason)
                    raise
                continue
            if part.theta is None:
                self.add("slip", taken + part.taken, reason)
                if part.stopped is not None:
                    raise part.stopped
                return None
            if self.line is not None:
                self.add("slip", taken + part.taken, reason)
                q = float(self.line.n @ [math.cos(part.theta), math.sin(part.theta)])
                return self.crossed(self.in_line(math.copysign(1.0, q), say("arrives in a line")))
            z = part.taken[-1].last[2:]
            decision = decide_arrival(self.system, self.psi, z, part.theta)
            if decision.kind != "away":
                self.add("slip", taken + part.taken, reason)
                held = hold(self.formulas, None, z, self.stiction)
                if held is not None:
                    return held
                self.ascent = Ascent(self.system, self.own, z, part.theta)
                return self.crossed(decision)
            # It will turn away from Sigma: go on from where it was close, and look again from closer.
            taken += part.taken[:-1]
            t, state = taken[-1].end, taken[-1].last
            largest = math.hypot(state[0], state[1]) * CLOSER_FACTOR

    def crossed(self, decision: Decision) -> Decision:
        """Name the crossing, where what follows an arrival is to leave."""
        if decision.kind == "leave":
            phase = Phase("cross", self.t, self.t, decision.reason)
            self.phases.append(PendingPhase(phase, [self.t], self.ascent, theta=decision.theta))
            self.ascent = None
        return decision

    def leave(self, decision: Decision) -> Decision | None:
        """Leave Sigma, and slip."""
        assert decision.theta is not None
        first = leave(self.formulas, decision.theta, self.t, self.state[2:], self.t_end, self.line)
        if isinstance(first, str):
            raise StopError(f"{decision.reason} {first}")
        crossed = bool(self.phases) and self.phases[-1].phase.kind == "cross"
        reason = say("leaves", theta=decision.theta) if crossed else decision.reason
        return self.slip([first], reason)

    def slide(self, decision: Decision) -> Decision | None:
        """Slide, and decide what follows where that ends."""
        assert decision.e is not None
        on_cycle = decision.kind == "cycle"
        if on_cycle and not all(self.formulas.is_affine):  # else Proposition 4.2 holds
            return self.slide_on_cycle(decision)
        lives = self.has_cycle if on_cycle else None
        part = self.slid(decision.e, lives=lives, line=self.line)
        # At a kink, or where a load pushes it out of a line, it slides on.
        while part.end == "switch" and (part.switch is None or not self.formulas.branch.jumps[part.switch]):
            last = part.taken[-1]
            self.enter_branch(part.e, last.last, last.end, part.switch)
            ahead = self.slid(part.e, last.end, last.last[2:], lives=lives, line=self.line)
            taken, places = [*part.taken, *ahead.taken], [*part.places, *ahead.places[1:]]
            part = replace(ahead, taken=taken, places=places)
        return self.follow(part, decision.reason, decision.onto, on_cycle)

    def slid(self, e: Array, t: float | None = None, z: Array | None = None, **how: Any) -> Slide:
        """Follow the slow flow from the critical set at e, from now on, or from t and z."""
        t, z = (self.t, self.state[2:]) if t is None or z is None else (t, z)
        options = {"rtol": self.rtol, "atol": self.atol, "most": self.left, "reach": self.stiction}
        options["max_step"] = self.max_step
        part = slide(self.formulas, self.own, e, t, z, self.t_end, **options, **how)
        self.evaluations += part.evaluations
        self.undecided += part.undecided
        return part

    def follow(
        self, part: Slide, reason: str, onto: str | None, on_cycle: bool = False, delaying: PendingDelay | None = None
    ) -> Decision | None:
        """Add a slide, and decide what follows where it has ended, as its end says."""
        self.add("slide", part.taken, reason, onto, part.places, delaying=delaying)
        if part.stopped is not None:
            raise part.stopped
        C = "C" if on_cycle else onto
        if part.end == "time":
            return None
        if part.end == "switch":
            return self.past_switch(part)
        if part.end == "left":
            return self.left_set(part.e, say("Hopf, left", C=C))
        if part.end == "feeds":
            return Decision("stop", say("static unknown"))
        if part.end == "equator" and self.stiction > 1.0:
            return let_go(self.system, self.line, part.e, self.state[2:], self.stiction)
        if part.end == "equator":
            theta = math.atan2(part.e[1], part.e[0])
            reason = say("ends at the equator", C=C, theta=theta)
            return Decision("leave", reason, theta=theta)
        if part.end == "fold":
            at = classify_fold(
                self.formulas, part.e, self.state[2:], C, "fold" if self.line is None else "fold in a line"
            )
            if at.exchange:
                return self.past_loss(part.e, C, at.exchange, at.reason)
            return Decision("stop", at.reason) if at.left_to_eps else self.past_fold(part.e, at)
        if part.end == "cycle":
            return self.past_cycle(self.ahead(part.e, PAST))
        if on_cycle:
            return Decision("slide", say("cycle shrinks", C=C), part.e, onto=C)
        return self.past_loss(part.e, C)

    def past_switch(self, part: Slide) -> Decision:
        """Decide anew what follows from the place of the set, where the formulas have switched."""
        assert part.switch is not None
        jumps = self.formulas.branch.jumps[part.switch]
        self.enter_branch(part.e, self.state, self.t, part.switch)
        if jumps:
            return self.onward_from(part, say("load jumps"))
        # What a load that sets in continuously does to a set that repels is seen a little later.
        here, self.state = self.state, np.concatenate([self.state[:2], self.ahead(part.e, PAST)])
        decision = self.onward_from(part, say("load sets in"))
        self.state = here
        return decision

    def onward_from(self, part: Slide, reason: str) -> Decision:
        """Decide what follows on Sigma from the place of a set."""
        if self.line is not None:
            return self.in_line(float(self.line.n @ part.e), reason)
        held = hold(self.formulas, None, self.state[2:], self.stiction)
        if held is not None:
            return replace(held, reason=f"{reason} {held.reason}")
        if self.psi is None:
            decision = decide_start(self.system, None, self.state[2:])
            return replace(decision, reason=f"{reason} {decision.reason}")
        start = in_disc(self.own, part.e)
        self.ascent = Ascent(self.system, self.psi, self.state[2:].copy(), start=start)
        decision = self.onward(reason, self.state[2:], start[None])
        border = decide_border(self.system, self.state[2:]) if decision.kind == "stop" else None
        return decision if border is None else self.at_border(replace(border, reason=f"{reason} {border.reason}"))

    def slide_on_cycle(self, decision: Decision) -> Decision | None:
        """Slide on a limit cycle of a general system."""
        assert decision.onto is not None
        index, z = int(decision.onto.split()[1]) - 1, self.state[2:]
        if not len(z):
            raise StopError(f"{decision.reason} {say('no z to follow')}")
        part = slide_on_cycle(self.system, self.own, index, self.t, z, self.t_end, self.left)
        if part is None or self.switches_within(part.taken):
            why = "cycle not seen" if part is None else "load switches on a cycle"
            raise StopError(f"{decision.reason} {say(why)}")
        self.evaluations += part.evaluations
        self.add("slide", part.taken, decision.reason, decision.onto, part.places, part.p)
        if part.end == "time":
            return None
        if not part.taken:
            return Decision("stop", say("cycle ends at once"))
        return self.past_cycle(self.state[2:] + 10.0 * (self.state[2:] - part.taken[-1].first[2:]))

    def switches_within(self, taken: Sequence[Step]) -> bool:
        """Whether the formulas switch within steps on Sigma."""
        guards, found = self.formulas.branch.guards, np.empty((1, 2))
        if not guards:
            return False
        program = path_program(guards)
        for step in taken:
            path = np.zeros((2 + len(step.first), 1 + step.polynomial.shape[1]))
            path[2:, 0], path[2:, 1:] = step.first, step.polynomial
            if any(zeros_along(*program.arrays, path, g, True, found) for g in range(len(guards))):
                return True
        return False

    def ahead(self, e: Array, part: float, beyond: Array | None = None) -> Array:
        """Return z a small part of the time ahead, or of the slide that has ended, along the slow flow at e."""
        z, slid = self.state[2:], self.t - self.phases[-1].phase.t_start
        flow = np.array(self.formulas.value(float(e[0]), float(e[1]), 0.0, 0.0, *z.tolist())[2:])
        way = flow if beyond is None else np.linalg.norm(flow) * beyond
        return z + part * min(self.t_end - self.t, slid or math.inf) * way

    def past_fold(self, e: Array, at: Fold) -> Decision:
        """C has met another critical set and both are gone: follow the orbit that leaves the place."""
        past = self.ahead(e, PAST, at.beyond)
        if self.line is not None:
            here, self.state = self.state, np.concatenate([self.state[:2], past])
            decision = self.in_line(float(self.line.n @ e), at.reason)
            self.state = here
            return decision
        point = in_disc(self.own, e)[None]
        self.ascent = Ascent(self.system, self.own, past, start=point[0])
        # Just past the fold orbits take long to leave the place; a little further they are followed to their end.
        for further in (1.0, 1e2, 3e3):
            decision = self.onward(at.reason, self.ahead(e, further * PAST, at.beyond), point)
            if decision.kind != "stop":
                break
        return decision

    def past_cycle(self, ahead: Array) -> Decision:
        """Follow orbits from all around a cycle that has ended."""
        reason = say("cycle ends")
        last = [cycle for cycle in limit_cycles(self.system, self.own, tuple(self.state[2:].tolist())) if cycle.stable]
        if len(last) != 1:
            return Decision("stop", f"{reason} {say('cycle ends, not found')}")
        points = last[0].points
        decision = self.onward(reason, ahead, points[:: max(1, len(points) // CYCLE_POINTS)])
        if decision.kind == "cycle":  # it comes and goes within the resolution of the search
            return Decision("stop", f"{reason} {say('cycle ends, not decided')}")
        return decision

    def onward(self, reason: str, z: Array, points: Array) -> Decision:
        """Follow orbits of the layer problem from where an attractor was."""
        try:
            decision = decide_from_hemisphere(self.system, self.own, z, points)
        except ValueError as error:  # at the edge of where the formulas are defined
            return Decision("stop", f"{reason} {error}")
        if self.psi is None and decision.kind != "stop":
            return Decision("stop", f"{reason} {say('onward depends')}")
        return replace(decision, reason=f"{reason} {decision.reason}")

    def has_cycle(self, z: Array) -> bool:
        """Whether the layer problem at z has a stable limit cycle."""
        return any(cycle.stable for cycle in limit_cycles(self.system, self.own, tuple(z.tolist())))

    def past_loss(self, e: Array, C: str | None, how: str = "Hopf", met: str = "") -> Decision | None:
        """C has lost its stability to the fast flow: slide on it for as long as the loss is delayed.

        Where it has exchanged it with other sets, as `met` says, that is if it does not move: it is then a slow
        manifold for every eps. One that moves is none, and terms of order eps part the sets.
        """
        resting = how != "Hopf"
        if self.psi is None:
            return Decision("stop", say("Hopf depends", C=C, how=how))
        before = self.phases[-1]
        if resting and np.ptp(before.e, axis=0).max() > REST_CHANGE:
            return Decision("stop", f"{met} {say('exchange, moving', C=C)}")
        taken = self.taken[len(self.taken) + 1 - len(before.times) :]
        part = self.slid(e, delayed=True, resting=resting)
        if resting and part.taken:  # its name is another past the sets that it has met
            C = critical_name(self.system, self.psi, part.taken[0].at(0.5)[2:], e)
        try:
            # A kink within its past is one of the whole formulas, not of their branch.
            on = cut_at_delayed_exit(self.formulas.whole or self.formulas, self.psi, (taken, before.e), part, C, how)
        except NotAnalyticError:
            return Decision("stop", say("Hopf, not analytic", C=C, how=how))
        if resting and before.ascent is not None:
            z = [taken[0].first[2:], *(step.last[2:] for step in (*taken, *on.part.taken))]
            self.leaving = departure_point(self.formulas, self.psi, e, z, before.ascent.path())
        return self.follow(on.part, on.reason, C, delaying=PendingDelay(before.times[0], on.way, how))

    def left_set(self, e: Array, reason: str) -> Decision:
        """C, which repels, is left: to the side on which the motion came, or all around where none is known."""
        points, self.leaving = self.leaving, None
        if self.line is None or points is None:
            return self.onward(reason, self.state[2:], exit_circle(self.own, e) if points is None else points)
        away = points[0] - in_disc(self.own, e)
        return self.in_line(float(self.line.n @ (e + away)), reason)

    def on_equator(self, theta: float, z: Array) -> bool:
        """Tell whether a critical set lies on the equator in a direction: lambda_rho is 0 there."""
        equator = equator_equilibria(self.system, z)
        there = np.cos(equator.theta[equator.radially_degenerate] - theta)
        return bool((there > 1.0 - SAME_DIRECTION).any())

    def at_border(self, decision: Decision) -> Decision:
        """Start where the critical set lies on the equator: it moves in, or lambda_rho becomes positive."""
        assert decision.theta is not None
        first = leave(self.formulas, decision.theta, self.t, self.state[2:], self.t_end, self.line)
        if isinstance(first, str):
            return Decision("slide", f"{decision.reason} {say('border moves in')}", decision.e, onto="C")
        return Decision("leave", f"{decision.reason} {say('border moves out')}", theta=decision.theta)
