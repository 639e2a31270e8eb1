"""Motions of the regularised system, eps > 0, through slip, entry, sliding and exit.

The past of a state: integrated backwards, up to where it is no longer unique.

Backwards what attracts repels. Next to a set that a motion follows, differences grow by the rate of its attraction,
which is of order 1/eps while the state itself hardly moves; once they have grown from the tolerance to a hundredth,
what lies before is no past of the state but of its rounding.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from dataclasses import field as made_with
from functools import partial
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..numerics.dense import Dense, StepArray, dense, gather_steps
from ..numerics.hybrid import AtEventError, PhaseRun, StopError
from ..numerics.radau import Step, TooManyStepsError
from ..results.arrays import Array
from ..results.words import say
from ..systems.kinds import AnySystem
from ..systems.psi.function import Psi, smoothed_direction
from .initial_value.events import Event, EventWatch, reverse_event
from .initial_value.field import Field, backwards, field, slopes_of
from .initial_value.functions import functions_of
from .initial_value.kernels.motion import UNDEFINED
from .initial_value.line import InvariantLine, invariant_line
from .initial_value.motion_steps import Inspection, MotionSteps, rate_at
from .passage import Passage
from .phases import phases_of
from .result import Simulation, SimulationStatus, simulation
from .variation.propagators import of_regularised

AGREE = 1e-2  # of its size: as far as two states may differ that are still the same
FASTER = 4.0  # growth that is no faster than so many times the motion itself turns its state, as in a slip, is no loss


class Past(NamedTuple):
    """A motion that comes to a state, and why it is known no further back."""

    motion: Dense
    status: SimulationStatus
    detail: str
    evaluations: int
    events: tuple[tuple[float, ...], ...]

    @classmethod
    def from_run(cls, run: Simulation, system: AnySystem, psi: Psi, rtol: float, atol: float) -> Past:
        """Return the past from a motion that was followed backwards, in the time -t."""
        growth, most = _growth(run, system, psi, atol / rtol), math.log(AGREE / rtol)
        k = int(np.searchsorted(np.cumsum(growth), most, side="right"))
        if k == len(growth):
            return cls.upto(run, run.motion, "")
        return cls.upto(
            run, run.motion.upto(k + 1, (most - float(growth[:k].sum())) / float(growth[k])), "past forgotten"
        )

    @classmethod
    def upto(cls, run: Simulation, known: Dense, why: str) -> Past:
        """Return the past from the first part of a motion that was followed backwards."""
        motion = known.backwards()
        first = float(motion.times[0])
        events = tuple(tuple(t for t in (-times[::-1]).tolist() if t >= first) for times in run.events)
        if known.times[-1] == run.times[-1]:
            detail = run.reason.removeprefix(run.status.value).strip()
            return cls(motion, run.status, detail, run.evaluations, events)
        return cls(motion, SimulationStatus.FORGOTTEN, say(why, t=first), run.evaluations, events)


def _growth(run: Simulation, system: AnySystem, psi: Psi, floor: float) -> Array:
    """Return by what differences grow along each step beyond what the motion itself does, by Simpson's rule."""
    motion, slopes = run.motion, slopes_of(system)
    n, steps = motion.states.shape[1], range(len(motion.lengths))
    states = np.array([motion.in_step(i, u) for i in steps for u in (0.0, 0.5, 1.0)]).reshape(-1, n)
    e, De = smoothed_direction(psi, run.eps, states[:, :2])
    jacobians, sizes = -slopes.of_state(e, De, states), np.abs(states) + floor
    sizes[:, :2] = np.hypot(np.hypot(*states[:, :2].T), run.eps)[:, None]
    known = np.isfinite(jacobians).all(axis=(1, 2), keepdims=True)
    rates = np.linalg.eigvals(np.where(known, jacobians, 0.0)).real.max(axis=1, initial=0.0)
    own = FASTER * np.max(np.abs(slopes.rates(e, states)) / sizes, axis=1)
    return motion.lengths * (np.maximum(rates - own, 0.0).reshape(-1, 3) @ (1.0, 4.0, 1.0)) / 6.0


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
    run = asked.result(motion, status, detail, sum(run.evaluations for run in runs))
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
        return tuple(self.result(*past) for past in pasts)

    def one(self, first: Array) -> Simulation:
        """Follow one motion."""
        run = _Run(
            self.span[0], first, self.span[1], self.rtol, self.atol, self.max_steps, self.max_step,
            self, EventWatch(self.events, self.span, first),
        )  # fmt: skip
        motion, status, detail = run.outcome()
        return self.result(
            motion, SimulationStatus[status], detail, run.evaluations, run.watch.times, run.jumps, tuple(run.turns)
        )

    def e(self, state: Array) -> list[float]:
        """Return e_Psi (2,) of a state."""
        return smoothed_direction(self.psi, self.eps, state[None, :2])[0][0].tolist()

    def result(
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


@dataclass
class _Run(PhaseRun[Field]):
    """One motion under way: a phase is a branch of the formulas, a line, or a passage close to an invariant point."""

    asked: RegularisedRun
    watch: EventWatch
    line: InvariantLine | None = None
    evaluations: int = 0
    steps: list[StepArray] = made_with(default_factory=list)
    jumps: dict[float, bool] = made_with(default_factory=dict)
    turns: list[float] = made_with(default_factory=list)
    carried: NDArray[np.complex128] | None = None  # the distance to an invariant point, as logarithms

    @property
    def left(self) -> int:
        """Steps that may still be taken."""
        return self.most

    def parts(self) -> Sequence[StepArray]:
        """Return the steps taken."""
        return self.steps

    def first(self) -> Field:
        """Return the branch of the formulas at the start."""
        formulas = self.asked.formulas.on_branch(self.asked.e(self.state), self.state.tolist())
        self.line = invariant_line(formulas, self.state)
        return formulas

    def phase(self, decision: Field) -> Field | None:
        """Follow a branch of the formulas, and return what is followed next."""
        formulas, asked, floor = decision, self.asked, self.atol / self.rtol
        functions, rate = functions_of(formulas, asked.psi), partial(rate_at, formulas, asked.psi, asked.eps, self.line)
        inspection = Inspection(formulas, asked.psi, asked.eps, self.line, self.rtol, floor)
        options = {"longest": self.max_step, "inspection": inspection}
        span = (self.t, self.t_end)
        motion = MotionSteps(
            functions, rate, asked.eps, self.line, span, self.state, self.rtol, floor, self.most, **options
        )
        passage = Passage(formulas, asked.psi, asked.eps, self.line, self.t_end, self.rtol, floor, self.carried)
        began, passed, self.carried = len(self.steps), None, None
        try:
            for part in motion.chunks():
                passed = passage.pass_by(self.steps[began:], part, self.most)
                if passed is None:
                    self.take(part)
                    continue
                self.carried = passed.logs
                self.turns += [] if passed.turn is None else [passed.turn]
                self.take(passed.before)
                self.take(passed.steps)
                if passed.failed is not None:
                    raise passed.failed
                break
        except TooManyStepsError:
            if motion.code == UNDEFINED and not self.steps:
                found, first = rate_at(formulas, asked.psi, asked.eps, None, self.state).tolist(), self.state.tolist()
                raise ValueError(f"(U, W) is {found} at state0 = {first}; it must be finite there.") from None
            raise
        finally:
            self.evaluations += motion.evaluations
            self.undecided += inspection.undecided
        self.t, self.state = float(motion.clock[0]), motion.y.copy()
        if passed is not None:
            self.t, self.state = passed.t_end, passed.steps.ends[-1].copy()
            return formulas
        if motion.leaves_line:
            self.line = invariant_line(formulas, self.state, self.line)
            return formulas
        if motion.switch is None:
            return None
        ahead = formulas.past_switch(motion.switch, asked.e(self.state), self.state.tolist())
        if ahead is None:
            raise StopError(say("load switches back"))
        if formulas.branch.jumps[motion.switch]:
            self.jumps[self.t] = formulas.jumps_by_time(motion.switch)
        if not any(len(part.lengths) for part in self.steps[began:]):
            self.carried = passage.carried  # it switches at once, and the distance is still that
        self.line = invariant_line(ahead, self.state)
        return ahead

    def take(self, part: StepArray) -> None:
        """Take steps, up to a terminal event."""
        ended = _cut_at_event(part, self.watch, len(self.state))
        self.steps.append(part if ended is None else ended)
        self.most -= len(part.lengths)
        if ended is not None:
            raise AtEventError(self.watch.reason)


def _cut_at_event(part: StepArray, watch: EventWatch, n: int) -> StepArray | None:
    """Return the steps of a part, of n variables, up to an event that ends the motion; None where there is none."""
    taken: list[Step] = []
    for step in part if watch.events else ():
        last = watch.step(step)
        taken.append(step if last is None else last)
        if last is not None:
            return gather_steps(taken, n)
    return None
