"""Motions of the regularised system, eps > 0, through slip, entry, sliding and exit."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ..numerics.dense import Dense, StepArray, dense, gather_steps
from ..numerics.radau import BlowUpError, Step, TooManyStepsError
from ..results.arrays import Array
from ..results.words import say
from ..systems.kinds import AnySystem
from ..systems.psi.function import Psi
from .backward_run import Past
from .initial_value.events import Event, EventWatch, reverse_event
from .initial_value.field import Field, backwards, field
from .initial_value.functions import functions_of
from .initial_value.inspection import Inspection
from .initial_value.kernels.motion import UNDEFINED
from .initial_value.line import InvariantLine, invariant_line
from .initial_value.motion_steps import MotionSteps, rate_at
from .initial_value.slopes import smoothed_direction
from .passage import Passage
from .phases import phases_of
from .result import Simulation, SimulationStatus, simulation
from .variation.regularised import of_regularised


def simulate_segments(
    system: AnySystem, psi: Psi, starts: Array, times: Array, *, eps: float, rtol: float, atol: float, max_steps: int,
    max_step: float,
) -> tuple[Simulation, tuple[int, ...], Array]:  # fmt: skip
    """Follow a motion in segments, as multiple shooting does, each from a start of its own.

    run: From start to start, up to the first segment that ends before its time; cuts: Step ends at which segments
    begin, and the last; ends: Of the segments. Shapes: starts (k, 2 + m), times (k + 1,).
    """
    whole = (float(times[0]), float(times[-1]))
    asked = RegularisedRun(system, field(system), psi, eps, whole, rtol, atol, (), max_steps, max_step)
    runs: list[Simulation] = []
    for start, span in zip(starts, pairwise(times.tolist()), strict=True):
        runs.append(replace(asked, span=span).one(start))
        if runs[-1].status is not SimulationStatus.T_END:
            break
    motions = [run.motion for run in runs]
    following = [*(motion.states[0] for motion in motions[1:]), motions[-1].states[-1]]
    parts = [
        StepArray(m.states[0], m.times[:-1], m.lengths, np.vstack([m.states[1:-1], last]), m.polynomials)
        for m, last in zip(motions, following, strict=True)
    ]
    motion, status = dense(float(times[0]), starts[0], parts), runs[-1].status
    detail = runs[-1].reason.removeprefix(status.value).strip()
    run = asked.told(motion, status, detail, sum(run.evaluations for run in runs))
    cuts = np.cumsum([0, *(len(motion.lengths) for motion in motions)])
    return run, tuple(cuts.tolist()), np.array([motion.states[-1] for motion in motions])


@dataclass(frozen=True, eq=False)
class RegularisedRun:
    """Arguments common to all motions of one call: `system` names the phases, `formulas` are integrated."""

    system: AnySystem
    formulas: Field
    psi: Psi
    eps: float
    span: tuple[float, float]
    rtol: float
    atol: float
    events: tuple[Event, ...]
    max_steps: int
    max_step: float

    def runs(self, states: Array) -> tuple[Simulation, ...]:
        """Follow all motions; where the span goes back, as they run, as far as states say where they came from."""
        if self.span[0] < self.span[1]:
            return tuple(map(self.one, states))
        back = replace(
            self,
            formulas=backwards(self.formulas),
            span=(-self.span[0], -self.span[1]),
            events=tuple(map(reverse_event, self.events)),
        )
        pasts = (Past.from_run(back.one(state), self.system, self.psi, self.rtol, self.atol) for state in states)
        return tuple(self.told(*past) for past in pasts)

    def one(self, first: Array) -> Simulation:
        """Follow one motion step by step, from switch to switch of its formulas."""
        watch, parts = EventWatch(self.events, self.span, first), list[StepArray]()
        status: SimulationStatus = SimulationStatus.T_END
        detail: str = ""
        evaluations: int = 0
        undecided: int = 0
        jumps: dict[float, bool] = {}
        t: float = self.span[0]
        state: Array = first
        most: int = self.max_steps
        formulas: Field = self.formulas.on_branch(self.e(first), first.tolist())
        line: InvariantLine | None = invariant_line(formulas, state)
        turns: list[float] = []
        carried: NDArray[np.complex128] | None = None
        ended: StepArray | None = None
        while t < self.span[1] and status is SimulationStatus.T_END:
            rate = partial(rate_at, formulas, self.psi, self.eps, line)
            inspection = Inspection(formulas, self.psi, self.eps, line, self.rtol, self.atol / self.rtol)
            motion = MotionSteps(
                functions_of(formulas, self.psi), rate, self.eps, line, (t, self.span[1]), state, self.rtol,
                self.atol / self.rtol, most, longest=self.max_step, inspection=inspection,
            )  # fmt: skip
            passage = Passage(
                formulas, self.psi, self.eps, line, self.span[1], self.rtol, self.atol / self.rtol, carried
            )
            began, passed, carried = len(parts), None, None
            try:
                for part in motion.chunks():
                    passed = passage.pass_by(parts[began:], part, most)
                    kept = (part,)
                    if passed is not None:
                        kept = (passed.before, passed.steps)
                        carried = passed.logs
                        if passed.turn is not None:
                            turns.append(passed.turn)
                    for steps in kept:
                        ended = _cut_at_event(steps, watch, len(first))
                        parts.append(steps if ended is None else ended)
                        most -= len(steps.lengths)
                        if ended is not None:
                            status, detail = SimulationStatus.EVENT, watch.reason
                            break
                    if ended is None and passed is not None and passed.failed is not None:
                        raise passed.failed
                    if ended is not None or passed is not None:
                        break
            except TooManyStepsError as error:
                passed, (status, detail) = None, self.end(motion.code, error, first)
            evaluations, undecided = evaluations + motion.evaluations, undecided + inspection.undecided
            t, state = float(motion.clock[0]), motion.y.copy()
            if passed is not None:
                t, state = passed.t_end, passed.steps.ends[-1].copy()
                continue
            if motion.leaves_line:
                line = invariant_line(formulas, state, line)
                continue
            if motion.switch is None:
                break
            ahead = formulas.past_switch(motion.switch, self.e(state), state.tolist())
            if ahead is None:
                status, detail = SimulationStatus.NOT_UNIQUE, say("load switches back")
                break
            if formulas.branch.jumps[motion.switch]:
                jumps[t] = formulas.jumps_by_time(motion.switch)
            if not any(len(part.lengths) for part in parts[began:]):
                carried = passage.carried  # it switches at once, and the distance is still that
            formulas, line = ahead, invariant_line(ahead, state)
        if undecided:
            detail = f"{detail} {say('not bounded', count=undecided)}".strip()
        return self.told(
            dense(self.span[0], first, parts), status, detail, evaluations, watch.times, jumps, tuple(turns)
        )

    def e(self, state: Array) -> list[float]:
        """Return e_Psi (2,) of a state."""
        return smoothed_direction(self.psi, self.eps, state[None, :2])[0][0].tolist()

    def end(self, code: int, error: Exception | None, first: Array) -> tuple[SimulationStatus, str]:
        """Return how a motion from a state has ended, and what there is to say of it."""
        if code == UNDEFINED:
            rate = rate_at(self.formulas, self.psi, self.eps, None, first).tolist()
            raise ValueError(f"(U, W) is {rate} at state0 = {first.tolist()}; it must be finite there.")
        if error is None:
            return SimulationStatus.T_END, ""
        status = SimulationStatus.BLOW_UP if isinstance(error, BlowUpError) else SimulationStatus.STEP_LIMIT
        return status, str(error)

    def told(
        self,
        motion: Dense,
        status: SimulationStatus,
        detail: str,
        evaluations: int,
        events: Sequence[Sequence[float]] = (),
        jumps: Mapping[float, bool] | None = None,
        turns: tuple[float, ...] = (),
    ) -> Simulation:
        """Return the result, whose phases and derivatives are found when they are requested."""
        phases = partial(phases_of, self.system, self.psi, self.eps, motion, turns)
        variation = partial(of_regularised, self.system, self.psi, self.eps, motion, jumps or {})
        return simulation(
            motion, phases, variation, status, detail=detail, eps=self.eps, evaluations=evaluations, events=events
        )


def _cut_at_event(part: StepArray, watch: EventWatch, n: int) -> StepArray | None:
    """Return the steps of a part, of n variables, up to an event that ends the motion; None where there is none."""
    taken: list[Step] = []
    for step in part if watch.events else ():
        last = watch.step(step)
        taken.append(step if last is None else last)
        if last is not None:
            return gather_steps(taken, n)
    return None
