"""Motions of the nonsmooth system, eps -> 0: slip, arrival at Sigma, sliding or crossing, exit; by events."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import overload

import numpy as np
from numpy.typing import ArrayLike

from ..arguments import checked_times
from ..arrays import Array
from ..initial_value.events import Event, Events, EventWatch, checked_events, reverse_event
from ..initial_value.field import Field, backwards_system, field
from ..initial_value.line import invariant_line
from ..numerics.dense import dense, gather_steps
from ..numerics.radau import BlowUpError, TooManyStepsError
from ..psi.function import Psi
from ..systems.kinds import AnySystem
from ..words import say
from .argument_checks import checked_span, checked_states, checked_tolerances, with_time
from .backward_run import Past
from .limit.hybrid_run import AtEventError, HybridRun, StopError
from .limit.stiction import checked_stiction
from .locations import OfState
from .regularised import MAX_STEPS
from .result import Phase, Simulation, SimulationStatus, simulation
from .variation.nonsmooth import of_nonsmooth

__all__ = ["simulate_nonsmooth"]


ON_SIGMA = 1e-200  # rho below which a state is on Sigma


@overload
def simulate_nonsmooth(  # pyright: ignore[reportOverlappingOverload] (rows are told from a row by their own entries)
    system: AnySystem,
    state0: Sequence[Sequence[float]],
    t_span: ArrayLike,
    psi: Psi | None = ...,
    *,
    rtol: float = ...,
    atol: float = ...,
    events: Events = ...,
    times: ArrayLike | None = ...,
    stiction: float = ...,
    max_steps: int = ...,
    max_step: float = ...,
) -> tuple[Simulation, ...]: ...


@overload
def simulate_nonsmooth(
    system: AnySystem,
    state0: ArrayLike,
    t_span: ArrayLike,
    psi: Psi | None = ...,
    *,
    rtol: float = ...,
    atol: float = ...,
    events: Events = ...,
    times: ArrayLike | None = ...,
    stiction: float = ...,
    max_steps: int = ...,
    max_step: float = ...,
) -> Simulation: ...


def simulate_nonsmooth(
    system: AnySystem,
    state0: ArrayLike,
    t_span: ArrayLike,
    psi: Psi | None = None,
    *,
    rtol: float = 1e-10,
    atol: float = 1e-12,
    events: Events = (),
    times: ArrayLike | None = None,
    stiction: float = 1.0,
    max_steps: int = MAX_STEPS,
    max_step: float = math.inf,
) -> Simulation | tuple[Simulation, ...]:
    """Follow one motion of (2.7) itself, as the limit eps -> 0 of the regularised system.

    Outside Sigma the system slips; it arrives at Sigma in finite time along a limit direction; the orbit that continues
    it on the hemisphere decides what follows (Theorem 3.1(b), Section 3.2): sliding on the critical set that it comes
    to, with its slow flow, or crossing. Sliding ends where the critical set does: it leaves folds, but stops at those
    where the slow flow turns too and terms of order eps decide (`limit.fold_classification`). Where the set only
    becomes unstable (Hopf), the motion stays near it until it has been repelled as much as it was attracted, or to
    the buffer point before (`limit.delay`): in analytic formulas, as long as nothing disturbs it. The rounding of
    `simulate` does, once eps is below 1/36 of what the attraction adds up to.

    The regularised motion differs from it by O(eps), as long as it does not leave Sigma. Leaving along a limit
    direction, also after a crossing, it differs by O(eps^min(1, |lambda_theta|/lambda_rho)), outside an invariant line;
    after an exit through the equator (Figure 19) by O(eps^(2 q/(1 + 2 q))) where Psi ~ s^(1 - q/2): 4/5 for
    Psi = 1, near 1 for one that falls exponentially. See `compare_with_limit.limit_order`.

    Parameters
    ----------
    system : ELinear, System, or one of them frozen at a z
    state0 : (2 + m,), or (k, 2 + m)
        (x, y, z1, ..., zm). On Sigma x = y = 0 is p = 0 for every eps: the orbit of the layer problem through it
        decides. Without psi: slides if one critical set attracts, else leaves along the one way out. Rows are as many
        motions.
    t_span : (t_start, t_end)
        If it decreases, what is returned is the past of state0, which lies off Sigma: the slip that comes to state0 at
        t_start. It begins at t_end, or where it left Sigma: what was before that is not unique.
    psi : Psi, optional
        The regularisation of which this is the limit. Left out, the motion stops where it would matter.
    rtol, atol : float
        Error allowed in a step: rtol rho for x and y, rtol |z| + atol for z. rtol from 1e-13 to 0.01.
    events : sequence of Event, or of callables (t, state) to float
        As in `simulate`. An event that is zero over a while, as x is while sliding, counts where it becomes zero.
    times : (k,) floats, optional
        Within the span: those of the result, as far as the motion comes; left out, the ends of the steps.
    stiction : float
        Static over kinetic friction, S_0/S: above 1, a contact at rest holds while the friction that rest needs is at
        most that many times the kinetic one, |e| <= S_0/S, whatever Psi is, and then slips in the one direction that
        there is (`limit.stiction`). So it also sticks where it would pass Sigma with |e| < S_0/S. U must be affine in
        e; where friction feeds a slip (D_e U plus its transpose is not negative definite) what follows is not known.
    max_steps : int
        Steps and phases before the motion is given up, with a status that says so.
    max_step : float
        The longest step, as in SciPy.

    Returns
    -------
    Simulation, or tuple of k Simulation
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

    A block of mass 1 on a spring of stiffness 1 and a belt of speed 0.3; kinetic friction 0.5, static friction 0.75.
    It sticks until the spring pulls with 0.75, and slips for 2 (pi - arctan(0.25/0.3)):

    >>> from codim2_core import System
    >>> block = System(U=("-z1 - 0.5*c", "-s"), W=("x + 0.3",))
    >>> run = simulate_nonsmooth(block, (0.0, 0.0, 0.0), (0.0, 8.0), stiction=1.5)
    >>> [(phase.kind, round(phase.t_end - phase.t_start, 9)) for phase in run.phases]
    [('slide', 2.5), ('slip', 4.893708755), ('slide', 0.606291245)]
    """
    t_start, t_end = checked_span(t_span)
    when = checked_times(times, (t_start, t_end))
    checked_tolerances(rtol, atol, max_steps, max_step)
    formulas = field(system)
    reach = checked_stiction(stiction, formulas)
    watched = checked_events(events)
    states = checked_states(with_time(state0, system, t_start), formulas.m)
    for first in states:
        if math.hypot(first[0], first[1]) < ON_SIGMA:
            first[:2] = 0.0
    asked = _NonsmoothRun(system, psi, formulas, watched, (t_start, t_end), rtol, atol, max_steps, max_step, reach)
    if t_end < t_start:
        runs: Iterable[Simulation] = (_past(asked, first) for first in states)
    else:
        runs = map(asked.one, states)
    found = tuple(run.sample(when) for run in runs)
    return found[0] if np.ndim(state0) < 2 else found


@dataclass(frozen=True, eq=False)
class _NonsmoothRun:
    """Arguments common to all motions of one call."""

    system: AnySystem
    psi: Psi | None
    formulas: Field
    watched: tuple[Event, ...]
    span: tuple[float, float]
    rtol: float
    atol: float
    max_steps: int
    max_step: float
    stiction: float

    def one(self, first: Array) -> Simulation:
        """Follow one motion phase by phase."""
        t_start, t_end = self.span
        watch = EventWatch(self.watched, self.span, first)
        course = HybridRun(
            self.system, self.psi, self.formulas, None, watch, t_start, first, t_end, self.rtol, self.atol,
            self.max_steps, self.max_step, self.stiction,
        )  # fmt: skip
        r = math.hypot(*first[:2].tolist())
        course.enter_branch(first[:2] / r if r > 0.0 else first[:2], first, t_start)
        status, detail = SimulationStatus.T_END, ""
        try:
            course.run()
        except AtEventError:
            status, detail = SimulationStatus.EVENT, watch.reason
        except StopError as stop:
            status, detail = SimulationStatus.NOT_UNIQUE, str(stop)
        except BlowUpError as error:
            status, detail = SimulationStatus.BLOW_UP, str(error)
        except TooManyStepsError as error:
            status, detail = SimulationStatus.STEP_LIMIT, str(error)
        if course.undecided:
            detail = f"{detail} {say('not bounded', count=course.undecided)}".strip()
        motion = dense(t_start, first, [gather_steps(course.taken, len(first))])
        phases = partial(tuple, [part.placed(self.system, course.own, motion) for part in course.parts])
        variation = partial(of_nonsmooth, self.system, self.psi, motion, phases, course.line, course.jumps)
        return simulation(
            motion, phases, variation, status, detail=detail, evaluations=course.evaluations, events=watch.times
        )


def _past(asked: _NonsmoothRun, last: Array) -> Simulation:
    """Follow a motion backwards until it is on Sigma, where motions meet, and tell it forwards."""
    if not last[:2].any():
        raise ValueError(
            f"state0 is {last.tolist()}, on Sigma, where motions meet: give a state off it to ask for its past."
        )
    t_start, t_end = asked.span
    back = simulate_nonsmooth(
        backwards_system(asked.system), last, (-t_start, -t_end), asked.psi, rtol=asked.rtol, atol=asked.atol,
        events=tuple(map(reverse_event, asked.watched)), max_steps=asked.max_steps, max_step=asked.max_step,
    )  # fmt: skip
    arrives = len(back.phases) > 1
    steps = int(np.searchsorted(back.times, back.phases[0].t_end, side="right")) - 1 if arrives else len(back.times) - 1
    past = Past.upto(back, back.motion.upto(steps), "has left Sigma")
    motion, first = past.motion, float(past.motion.times[0])
    slip = Phase("slip", first, t_start, say("past on Sigma" if arrives else "starts outside"))
    phases = (slip.with_place(OfState(motion, None, 0.0, first, t_start), None),)
    variation = partial(
        of_nonsmooth, asked.system, asked.psi, motion, lambda: phases, invariant_line(asked.formulas, last), {}
    )
    return simulation(
        motion, lambda: phases, variation, past.status,
        detail=past.detail, evaluations=past.evaluations, events=past.events,
    )  # fmt: skip
