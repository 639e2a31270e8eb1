"""Motions of the nonsmooth system, eps -> 0: slip, arrival at Sigma, sliding or crossing, exit; by events."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ..results.arrays import Array
from ..results.words import say
from ..systems.kinds import AnySystem
from ..systems.psi.function import Psi
from .backward_run import Past
from .initial_value.events import Event, EventWatch, reverse_event
from .initial_value.field import Field, backwards_system, field
from .initial_value.line import invariant_line
from .limit.hybrid_run import HybridRun
from .locations import OfState
from .result import Phase, Simulation, SimulationStatus, simulation
from .variation.nonsmooth import of_nonsmooth

ON_SIGMA = 1e-200  # rho below which a state is on Sigma


@dataclass(frozen=True, eq=False)
class NonsmoothRun:
    """Arguments common to all motions of one call."""

    system: AnySystem
    psi: Psi | None
    formulas: Field
    events: tuple[Event, ...]
    span: tuple[float, float]
    rtol: float
    atol: float
    max_steps: int
    max_step: float
    stiction: float

    def runs(self, states: Array) -> tuple[Simulation, ...]:
        """Follow all motions; where the span goes back, until they are on Sigma."""
        for first in states:
            if math.hypot(first[0], first[1]) < ON_SIGMA:
                first[:2] = 0.0
        return tuple(map(self.one if self.span[0] < self.span[1] else self._past, states))

    def one(self, first: Array) -> Simulation:
        """Follow one motion phase by phase."""
        t_start, t_end = self.span
        watch = EventWatch(self.events, self.span, first)
        course = HybridRun(
            t_start, first, t_end, self.rtol, self.atol, self.max_steps, self.max_step,
            self.system, self.psi, self.formulas, None, watch, self.stiction,
        )  # fmt: skip
        r = math.hypot(*first[:2].tolist())
        course.enter_branch(first[:2] / r if r > 0.0 else first[:2], first, t_start)
        motion, status, detail = course.outcome()
        phases = partial(tuple, [part.placed(self.system, course.own, motion) for part in course.phases])
        variation = partial(of_nonsmooth, self.system, self.psi, motion, phases, course.line, course.jumps)
        return simulation(
            motion,
            phases,
            variation,
            SimulationStatus[status],
            detail=detail,
            evaluations=course.evaluations,
            events=watch.times,
        )

    def _past(self, last: Array) -> Simulation:
        """Follow a motion backwards until it is on Sigma, where motions meet, and return it as it runs."""
        if not last[:2].any():
            raise ValueError(
                f"state0 is {last.tolist()}, on Sigma, where motions meet: give a state off it to ask for its past."
            )
        t_start, t_end = self.span
        system = backwards_system(self.system)
        back = replace(
            self, system=system, formulas=field(system), span=(-t_start, -t_end), stiction=1.0,
            events=tuple(map(reverse_event, self.events)),
        ).one(last)  # fmt: skip
        arrives = len(back.phases) > 1
        steps = len(back.times) - 1
        if arrives:
            steps = int(np.searchsorted(back.times, back.phases[0].t_end, side="right")) - 1
        past = Past.upto(back, back.motion.upto(steps), "has left Sigma")
        motion, first = past.motion, float(past.motion.times[0])
        slip = Phase("slip", first, t_start, say("past on Sigma" if arrives else "starts outside"))
        phases = (slip.with_place(OfState(motion, None, 0.0, first, t_start), None),)
        variation = partial(
            of_nonsmooth, self.system, self.psi, motion, lambda: phases, invariant_line(self.formulas, last), {}
        )
        return simulation(
            motion, lambda: phases, variation, past.status,
            detail=past.detail, evaluations=past.evaluations, events=past.events,
        )  # fmt: skip
