"""Motions of the regularised system, eps > 0, through slip, entry, sliding and exit."""

from __future__ import annotations

import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from importlib.util import resolve_name
from typing import TYPE_CHECKING, NoReturn, overload

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ..expressions.expression import Expression
from ..initial_value.events import Event, Events, EventWatch, checked_events, reverse_event
from ..initial_value.field import Field, backwards, field
from ..initial_value.line import invariant_line
from ..initial_value.problem import plane_problem
from ..numerics.dense import Dense, StepArray, dense, gather_steps
from ..numerics.growth import BlowUpError, until_blow_up
from ..numerics.radau import Problem, Step, TooManyStepsError, steps
from ..psi.function import Psi
from ..systems.kinds import AnySystem
from .argument_checks import checked_span, checked_states, checked_tolerances, with_time
from .backward_run import Past
from .phases import phases_of
from .result import Simulation, SimulationStatus, simulation
from .variation.regularised import of_regularised

if TYPE_CHECKING:
    from ..initial_value.compiled_motion import CompiledMotion

__all__ = ["simulate"]


_stepped: dict[tuple[Expression, ...], int] = {}  # steps in Python so far, by the formulas of a system

SMALLEST_EPS, LARGEST_EPS = 1e-14, 1e6
FIRST_STEP_SHARE = 1e-2  # of rho/|U|: the first step tried
MAX_STEPS = 20_000
PYTHON_STEPS = 400  # steps in Python, of all motions of a system: they take about as long as compiling its formulas
COUNTED_SYSTEMS = 64  # systems whose steps are counted
MANY_MOTIONS = 8  # motions at once for which that is not waited for


@overload
def simulate(  # pyright: ignore[reportOverlappingOverload] (rows are told from a row by their own entries)
    system: AnySystem,
    psi: Psi,
    eps: float,
    state0: Sequence[Sequence[float]],
    t_span: ArrayLike,
    *,
    rtol: float = ...,
    atol: float = ...,
    events: Events = ...,
    max_steps: int = ...,
) -> tuple[Simulation, ...]: ...


@overload
def simulate(
    system: AnySystem,
    psi: Psi,
    eps: float,
    state0: ArrayLike,
    t_span: ArrayLike,
    *,
    rtol: float = ...,
    atol: float = ...,
    events: Events = ...,
    max_steps: int = ...,
) -> Simulation: ...


def simulate(
    system: AnySystem,
    psi: Psi,
    eps: float,
    state0: ArrayLike,
    t_span: ArrayLike,
    *,
    rtol: float = 1e-8,
    atol: float = 1e-10,
    events: Events = (),
    max_steps: int = MAX_STEPS,
) -> Simulation | tuple[Simulation, ...]:
    """Follow one motion of the regularised system: eq:vf with e replaced by e_Psi, eq:ePsi.

    Parameters
    ----------
    system : ELinear, System, or one of them frozen at a z
    psi : Psi
    eps : float
        1e-14 <= eps <= 1e6.
    state0 : (2 + m,), or (k, 2 + m)
        (x, y, z1, ..., zm); x = y = 0 is allowed. Rows are as many motions, followed compiled on all cores.
    t_span : (t_start, t_end)
        In the time t of eq:vf. If it decreases, what is returned is the past of state0: the motion that begins at
        t_end, runs forward like any other, and comes to state0 at t_start.
    rtol, atol : float
        Error allowed in a step: rtol rho for x and y, rho = sqrt(x^2 + y^2 + eps^2), and rtol |z| + atol for z.
        rtol from 1e-13 to 0.01.
    events : sequence of Event, or of callables (t, state) to float
        Their zeros are found in the dense output, also several in one step; an `Event` may be terminal.
    max_steps : int
        Steps tried before the motion is given up, with a status that says so.

    Returns
    -------
    Simulation, or tuple of k Simulation
        Its phases are read off the motion when they are first asked for: "slide" where it follows a critical set or a
        limit cycle of the layer problem within O(eps). If it grows beyond bounds, or the step limit is reached, it
        holds what was followed till then. What slides forgets where it came from: a past begins where differences of
        rtol at state0 would have grown to a hundredth, and the status says so.

    Raises
    ------
    ValueError
        An argument is invalid, the field is not finite at state0, or an event does not return a finite number.

    Examples
    --------
    >>> from codim2_core import examples, psi
    >>> run = simulate(examples.ball_in_pool(K=0.0), psi.constant(), 1e-6, (1.0, 0.0, 1.0, 0.0), (0.0, 0.5))
    >>> [phase.kind for phase in run.phases]
    ['slip', 'slide']

    Where it came from:

    >>> past = simulate(examples.ball_in_pool(K=0.0), psi.constant(), 1e-6, (0.5, 0.0, 1.0, 0.0), (0.0, -0.1))
    >>> past.states[-1].tolist(), past.states[0].round(6).tolist()
    ([0.5, 0.0, 1.0, 0.0], [1.1867, 0.0, 1.1962, 0.0])
    """
    if not SMALLEST_EPS <= eps <= LARGEST_EPS:
        raise ValueError(f"eps is {eps!r}; allowed is {SMALLEST_EPS:g} <= eps <= {LARGEST_EPS:g}.")
    span = checked_span(t_span)
    checked_tolerances(rtol, atol, max_steps)
    asked = _RegularisedRun(system, field(system), psi, float(eps), span, rtol, atol, checked_events(events), max_steps)
    states = checked_states(with_time(state0, system, span[0]), asked.formulas.m)
    runs = asked.runs(states) if span[0] < span[1] else _pasts(asked, states)
    return runs[0] if np.ndim(state0) < 2 else runs


@dataclass(frozen=True, eq=False)
class _RegularisedRun:
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

    def runs(self, states: Array) -> tuple[Simulation, ...]:
        """Follow all motions."""
        if not self.events and (len(states) >= MANY_MOTIONS or _is_compiled(self.formulas)):
            return self.compiled(states)
        return tuple(self.one(first) for first in states)

    def one(self, first: Array) -> Simulation:
        """Follow one motion, in Python at first."""
        watch = EventWatch(self.events, self.span[0], first)
        parts, status, detail, count = _integrate_regularised(
            self.formulas, self.psi, self.eps, first, self.span, self.rtol, self.atol, self.max_steps, watch
        )
        return self.told(dense(self.span[0], first, parts), status, detail, count, watch.times)

    def told(
        self,
        motion: Dense,
        status: SimulationStatus,
        detail: str,
        evaluations: int,
        events: Sequence[Sequence[float]] = (),
    ) -> Simulation:
        """Return the result, whose phases and derivatives are found when they are asked for."""
        phases = partial(phases_of, self.system, self.psi, self.eps, self.rtol, motion)
        variation = partial(of_regularised, self.system, self.psi, self.eps, motion)
        return simulation(
            motion, phases, variation, status, detail=detail, eps=self.eps, evaluations=evaluations, events=events
        )

    def compiled(self, states: Array) -> tuple[Simulation, ...]:
        """Follow motions compiled from the start, in as few calls as there are cores."""
        from ..initial_value.compiled_motion import failure, integrate_compiled  # loads the compiler
        from ..initial_value.kernels.motion import UNDEFINED

        formulas, psi, eps, rtol, atol = self.formulas, self.psi, self.eps, self.rtol, self.atol
        lines = [invariant_line(formulas, first) for first in states]
        found, runs = (
            integrate_compiled(formulas, psi, eps, lines, states, self.span, rtol, atol / rtol, self.max_steps),
            [],
        )
        for one, line, first in zip(found, lines, states, strict=True):
            status, detail = SimulationStatus.T_END, ""
            if one.code == UNDEFINED:
                _refuse(plane_problem(formulas, psi, eps, 1.0, 1.0).F(first), first)
            if one.code:
                problem = plane_problem(formulas, psi, eps, rtol, atol, None if line is None else line.vector)
                error = failure(problem, one.code, one.t, one.motion.states[-1])
                status = SimulationStatus.BLOW_UP if isinstance(error, BlowUpError) else SimulationStatus.STEP_LIMIT
                detail = str(error)
            runs.append(self.told(one.motion, status, detail, one.evaluations))
        return tuple(runs)


def _pasts(asked: _RegularisedRun, states: Array) -> tuple[Simulation, ...]:
    """Follow motions backwards, and return them as they run, as far as their states tell where they came from."""
    back = replace(
        asked,
        formulas=backwards(asked.formulas),
        span=(-asked.span[0], -asked.span[1]),
        events=tuple(map(reverse_event, asked.events)),
    )
    problem = plane_problem(back.formulas, asked.psi, asked.eps, asked.rtol, asked.atol)
    pasts = [Past.from_run(run, problem, asked.rtol) for run in back.runs(states)]
    return tuple(asked.told(*past) for past in pasts)


def _refuse(rate: Array, first: Array) -> NoReturn:
    """Say that the rate is not finite where a motion begins."""
    raise ValueError(f"(U, W) is {rate.tolist()} at state0 = {first.tolist()}; it must be finite there.")


def _count_evaluations(problem: Problem, count: list[int]) -> Problem:
    def F(state: Array) -> Array:
        count[0] += 1
        return problem.F(state)

    return Problem(F, problem.J, problem.scale, problem.limit)


def first_step(problem: Problem, state: Array, rate: Array) -> float:
    """Return a short first step: a small part of the time in which the state changes by its own size."""
    speed = float(np.max(np.abs(rate) / problem.scale(state)))
    return FIRST_STEP_SHARE / speed if speed > 0.0 else math.inf


def _integrate_regularised(
    formulas: Field,
    psi: Psi,
    eps: float,
    first: Array,
    span: tuple[float, float],
    rtol: float,
    atol: float,
    max_steps: int,
    watch: EventWatch,
) -> tuple[list[StepArray], SimulationStatus, str, int]:
    """Follow a motion: its steps, why it ended, and the evaluations it took."""
    line = invariant_line(formulas, first)
    problem = plane_problem(formulas, psi, eps, rtol, atol, None if line is None else line.vector)
    count = [0]
    problem = _count_evaluations(problem, count)
    rate = problem.F(first)
    if not np.isfinite(rate).all():
        _refuse(rate, first)
    taken: list[Step] = []
    parts: list[StepArray] = []
    t, state, h = span[0], first, first_step(problem, first, rate)
    motion: CompiledMotion | None = None
    patience = waited_for(formulas)
    status, detail = SimulationStatus.T_END, ""
    try:
        if patience > 0:
            for step in until_blow_up(problem, steps(problem, *span, first, rtol, h, max_steps)):
                last = watch.step(step)
                taken.append(step if last is None else last)
                if last is not None:
                    return [gather_steps(taken, len(first))], SimulationStatus.EVENT, "", count[0]
                if len(taken) == patience:
                    t, state, h = step.end, step.last, step.h
                    break
        if t < span[1] and len(taken) == max(0, patience):
            from ..initial_value.compiled_motion import (
                CompiledMotion,  # loads the compiler, which most motions do without
            )

            motion = CompiledMotion(
                problem, formulas, psi, eps, line, t, span[1], state, rtol, atol / rtol, h, max_steps - len(taken)
            )
            for part in motion.chunks():
                ended = _cut_at_event(part, watch, len(first))
                parts.append(part if ended is None else ended)
                if ended is not None:
                    status = SimulationStatus.EVENT
                    break
    except BlowUpError as error:
        status, detail = SimulationStatus.BLOW_UP, str(error)
    except TooManyStepsError as error:
        status, detail = SimulationStatus.STEP_LIMIT, str(error)
    finally:
        count_steps(formulas, len(taken))
    evaluations = count[0] + (0 if motion is None else motion.evaluations)
    return [gather_steps(taken, len(first)), *parts], status, detail, evaluations


def _cut_at_event(part: StepArray, watch: EventWatch, n: int) -> StepArray | None:
    """Return the steps of a part, of n variables, up to an event that ends the motion; None where there is none."""
    taken: list[Step] = []
    for step in part if watch.events else ():
        last = watch.step(step)
        taken.append(step if last is None else last)
        if last is not None:
            return gather_steps(taken, n)
    return None


def waited_for(formulas: Field) -> int:
    """Say how many steps in Python are still taken before a system's motions are followed compiled."""
    return 0 if _is_compiled(formulas) else max(0, PYTHON_STEPS - _stepped.get(formulas.rows, 0))


def count_steps(formulas: Field, steps: int) -> None:
    """Count steps in Python: a system that comes again is compiled once its motions together are a long one."""
    before = _stepped.pop(formulas.rows, 0)
    while len(_stepped) >= COUNTED_SYSTEMS:
        _stepped.pop(next(iter(_stepped)), None)
    _stepped[formulas.rows] = before + steps


def _is_compiled(formulas: Field) -> bool:
    """Whether the formulas are compiled already; none are before the compiler has been loaded."""
    module = sys.modules.get(resolve_name("..initial_value.compiled_motion", __package__))
    return module is not None and module.is_compiled(formulas)
