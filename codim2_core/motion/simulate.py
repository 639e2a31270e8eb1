"""Motions in time: of the regularised system, eps > 0, and of the nonsmooth system, its limit eps -> 0."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Concatenate, Protocol, cast, overload

import numpy as np
from numpy.typing import ArrayLike

from ..results.arrays import Array
from ..results.words import say
from ..systems.arguments import checked_times
from ..systems.kinds import AnySystem, P, PsiLike, SystemLike
from ..systems.psi.function import Psi
from .initial_value.events import Event, Events, EventWatch, checked_events, reverse_event
from .initial_value.field import Field, backwards_system, field
from .initial_value.line import invariant_line
from .limit.hybrid_run import HybridRun
from .limit.sigma_decision import checked_stiction
from .locations import OfState
from .regularised import Past, RegularisedRun
from .result import Phase, Simulation, SimulationStatus, simulation
from .variation.nonsmooth import of_nonsmooth

SMALLEST_EPS, LARGEST_EPS = 1e-14, 1e6
MAX_STEPS = 20_000


def checked_eps(eps: float | None, psi: Psi | None, stiction: float = 1.0) -> float:
    """Check eps: 0 or None for the limit, which alone may go without Psi, and alone knows stiction."""
    eps = eps or 0.0
    if eps != 0.0 and not SMALLEST_EPS <= eps <= LARGEST_EPS:
        raise ValueError(f"eps is {eps!r}; give 0 for the limit, or {SMALLEST_EPS:g} <= eps <= {LARGEST_EPS:g}.")
    if eps > 0.0 and psi is None:
        raise ValueError(f"psi is None and eps is {eps:g}; give the regularisation, or eps = 0 for the limit.")
    if eps > 0.0 and stiction > 1.0:
        raise ValueError(f"stiction is {stiction:g} and eps is {eps:g}; leave one out: it is known in the limit alone.")
    return float(eps)


def checked_span(t_span: ArrayLike) -> tuple[float, float]:
    """Check (t_start, t_end): finite and different."""
    try:
        t_start, t_end = (float(t) for t in np.asarray(t_span, float))
    except (TypeError, ValueError) as error:
        raise ValueError(f"t_span is {t_span!r}; give two times (t_start, t_end).") from error
    if not (math.isfinite(t_start) and math.isfinite(t_end) and t_start != t_end):
        raise ValueError(f"t_span is ({t_start}, {t_end}); give two different finite times.")
    return t_start, t_end


def checked_state(state0: ArrayLike, m: int) -> Array:
    """Check (x, y, z1, ..., zm): finite numbers."""
    try:
        state = np.array(state0, float)
    except (TypeError, ValueError) as error:
        raise ValueError(f"state0 is {state0!r}; give numbers (x, y, z1, ..., zm) with m = {m}.") from error
    if state.shape != (2 + m,):
        raise ValueError(f"state0 has shape {state.shape}; this system has m = {m}: give (x, y, z1, ..., zm).")
    if not np.isfinite(state).all():
        raise ValueError(f"state0 is {state.tolist()}; give finite numbers.")
    return state


def with_time(state0: ArrayLike, system: AnySystem, t: float) -> ArrayLike:
    """Give states of a system that reads t their last slow variable, the time, where they were given without it."""
    if not system.clock:
        return state0
    states = np.asarray(state0, object)
    if states.ndim not in (1, 2) or states.shape[states.ndim - 1] != 1 + system.m:
        return state0
    clocks = np.full((*states.shape[: states.ndim - 1], 1), t, object)
    return np.concatenate([states, clocks], axis=states.ndim - 1)


def checked_states(state0: ArrayLike, m: int) -> Array:
    """Check one state or several: (k, 2 + m)."""
    if np.ndim(np.asarray(state0, object)) < 2:
        return checked_state(state0, m)[None]
    try:
        states = np.array(state0, float)
    except (TypeError, ValueError) as error:
        raise ValueError(f"state0 is {state0!r}; give rows of numbers (x, y, z1, ..., zm) with m = {m}.") from error
    if states.ndim != 2 or states.shape[1] != 2 + m:
        raise ValueError(f"state0 has shape {states.shape}; this system has m = {m}: give (2 + m,) or (k, 2 + m).")
    if not np.isfinite(states).all():
        wrong = int(np.flatnonzero(~np.isfinite(states).all(axis=1))[0])
        raise ValueError(f"state0[{wrong}] is {states[wrong].tolist()}; give finite numbers.")
    return states


def checked_tolerances(rtol: float, atol: float, max_steps: int, max_step: float = math.inf) -> None:
    """Check tolerances, the step limit and the longest step."""
    if not 1e-13 <= rtol <= 1e-2:
        raise ValueError(f"rtol is {rtol!r}; give a relative tolerance from 1e-13 to 0.01.")
    if not 0.0 < atol < math.inf:
        raise ValueError(f"atol is {atol!r}; give a positive absolute tolerance for z.")
    if not 1 <= max_steps <= 10**9:
        raise ValueError(f"max_steps is {max_steps!r}; give a number of steps from 1 to 1e9.")
    if not (isinstance(max_step, int | float | np.number) and max_step > 0.0):
        raise ValueError(f"max_step is {max_step!r}; give a positive time, or leave it out.")


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


RTOL, RTOL_OF_LIMIT = 1e-8, 1e-10  # where none is given
ATOL_SHARE = 1e-2  # of rtol: atol, where none is given


StateRows = Sequence[Sequence[float] | Array]  # of as many states


class Simulate(Protocol[P]):
    """The type of `simulate`: it returns a motion, or as many as there are rows."""

    @overload
    def __call__(  # pyright: ignore[reportOverlappingOverload] (rows differ from a row by their entries)
        self, system: SystemLike, psi: PsiLike | None, state0: StateRows, *args: P.args, **kwargs: P.kwargs
    ) -> tuple[Simulation, ...]: ...
    @overload
    def __call__(
        self, system: SystemLike, psi: PsiLike | None, state0: ArrayLike, *args: P.args, **kwargs: P.kwargs
    ) -> Simulation: ...
    @overload
    def __call__(  # pyright: ignore[reportOverlappingOverload]
        self, system: SystemLike, state0: StateRows, *args: P.args, **kwargs: P.kwargs
    ) -> tuple[Simulation, ...]: ...
    @overload
    def __call__(self, system: SystemLike, state0: ArrayLike, *args: P.args, **kwargs: P.kwargs) -> Simulation: ...


class SimulateNonsmooth(Protocol[P]):
    """The type of `simulate_nonsmooth`."""

    @overload
    def __call__(  # pyright: ignore[reportOverlappingOverload]
        self, system: SystemLike, state0: StateRows, t_span: ArrayLike, psi: PsiLike | None = ...,
        *args: P.args, **kwargs: P.kwargs,
    ) -> tuple[Simulation, ...]: ...  # fmt: skip
    @overload
    def __call__(
        self, system: SystemLike, state0: ArrayLike, t_span: ArrayLike, psi: PsiLike | None = ...,
        *args: P.args, **kwargs: P.kwargs,
    ) -> Simulation: ...  # fmt: skip


def _simulate(function: Callable[Concatenate[AnySystem, Psi | None, ArrayLike, P], object]) -> Simulate[P]:
    return cast(Simulate[P], function)


def _simulate_nonsmooth(
    function: Callable[Concatenate[AnySystem, ArrayLike, ArrayLike, Psi | None, P], object],
) -> SimulateNonsmooth[P]:
    return cast(SimulateNonsmooth[P], function)


@_simulate
def simulate(
    system: AnySystem,
    psi: Psi | None,
    state0: ArrayLike,
    t_span: ArrayLike,
    *,
    eps: float,
    rtol: float | None = None,
    atol: float | None = None,
    events: Events = (),
    times: ArrayLike | None = None,
    stiction: float = 1.0,
    max_steps: int = MAX_STEPS,
    max_step: float = math.inf,
) -> Simulation | tuple[Simulation, ...]:
    """Follow one motion of the regularised system, (2.7) with e replaced by e_Psi (2.19), or of its limit eps -> 0.

    In the limit, eps = 0, the system slips outside Sigma; it arrives at Sigma in finite time along a limit direction;
    the orbit that continues it on the hemisphere decides what follows (Theorem 3.1(b), Section 3.2): sliding on the
    critical set that it comes to, with its slow flow, or crossing. Sliding ends where the critical set does: it leaves
    folds, but stops at those where the slow flow turns too and terms of order eps decide
    (`limit.fold_classification`). Where the set only becomes unstable (Hopf), the motion stays near it until it has
    been repelled as much as it was attracted, or to the buffer point before (`limit.delay`): in analytic formulas, as
    long as nothing disturbs it.

    The regularised motion differs from the limit by O(eps), as long as it does not leave Sigma. Leaving along a limit
    direction, also after a crossing, it differs by O(eps^min(1, |lambda_theta|/lambda_rho)), outside an invariant line;
    after an exit through the equator (Figure 19) by O(eps^(2 q/(1 + 2 q))) where Psi ~ s^(1 - q/2): 4/5 for
    Psi = 1, near 1 for one that falls exponentially. See `compare_with_limit.limit_order`.

    Parameters
    ----------
    system : ELinear, System, or one of them frozen at a z
    psi : Psi
        In the limit it may be left out, or None: the motion then stops where it would matter.
    state0 : (2 + m,), or (k, 2 + m)
        (x, y, z1, ..., zm). Rows are as many motions. x = y = 0 is allowed: it is p = 0 of the hemisphere for every
        eps, and the orbit of the layer problem through it decides. In the limit without psi, the motion slides if one
        critical set attracts, else it leaves along the one way out.
    t_span : (t_start, t_end)
        In the time t of (2.7). If it decreases, the past of state0 is returned: the motion that begins at t_end, runs
        forward like any other, and comes to state0 at t_start. In the limit it is the slip that comes to state0, which
        lies off Sigma: what was before it left Sigma is not unique.
    eps : float
        0, or 1e-14 <= eps <= 1e6.
    rtol, atol : float, optional
        Error allowed in a step: rtol rho for x and y, rho = sqrt(x^2 + y^2 + eps^2), and rtol |z| + atol for z.
        rtol from 1e-13 to 0.01; left out, 1e-8, in the limit 1e-10. atol, left out, is rtol/100.
    events : sequence of Event, or of callables (t, state) to float
        Their zeros are found in the dense output, also several in one step; an `Event` may be terminal. One that is
        zero over a while, as x is while sliding, counts where it becomes zero.
    times : (k,) floats, optional
        Within the span: those of the result, as far as the motion comes; left out, the ends of the steps.
    stiction : float
        In the limit, static over kinetic friction, S_0/S: above 1, a contact at rest holds while the friction that rest
        needs is at most that many times the kinetic one, |e| <= S_0/S, whatever Psi is, and then slips in the one
        direction that there is (`limit.sigma_decision`). So it also sticks where it would pass Sigma with |e| < S_0/S.
        U must be affine in e; where friction feeds a slip (D_e U plus its transpose is not negative definite) what
        follows is not known.
    max_steps : int
        Steps and phases before the motion is given up, with a status that says so.
    max_step : float
        The longest step, as in SciPy.

    Returns
    -------
    Simulation, or tuple of k Simulation
        Its phases are read off a regularised motion on first use: "slide" where it follows a critical set
        or a limit cycle of the layer problem within O(eps). In the limit its status is NOT_UNIQUE, with a reason, where
        the limit is not unique or not known; the motion ends there. If it grows beyond bounds, or the step limit is
        reached, it holds what was followed till then. What slides forgets where it came from: a past begins where
        differences of rtol at state0 would have grown to a hundredth, and the status says so.

    Raises
    ------
    ValueError
        An argument is invalid, the field is not finite at state0, or an event does not return a finite number.

    Examples
    --------
    >>> from codim2_core import System, examples, psi
    >>> ball = examples.ball_in_pool(K=0.0)
    >>> run = simulate(ball, psi.constant(), (1.0, 0.0, 1.0, 0.0), (0.0, 0.5), eps=1e-6)
    >>> [phase.kind for phase in run.phases]
    ['slip', 'slide']

    Where it came from:

    >>> past = simulate(ball, psi.constant(), (0.5, 0.0, 1.0, 0.0), (0.0, -0.1), eps=1e-6)
    >>> past.states[-1].tolist(), past.states[0].round(6).tolist()
    ([0.5, 0.0, 1.0, 0.0], [1.1867, 0.0, 1.1962, 0.0])

    The limit. A block of mass 1 on a spring of stiffness 1 and a belt of speed 0.3; kinetic friction 0.5, static
    friction 0.75. It sticks until the spring pulls with 0.75, and slips for 2 (pi - arctan(0.25/0.3)):

    >>> block = System(U=("-z1 - 0.5*c", "-s"), W=("x + 0.3",))
    >>> run = simulate(block, None, (0.0, 0.0, 0.0), (0.0, 8.0), eps=0, stiction=1.5)
    >>> [(phase.kind, round(phase.t_end - phase.t_start, 9)) for phase in run.phases]
    [('slide', 2.5), ('slip', 4.893708755), ('slide', 0.606291245)]
    """
    eps = checked_eps(eps, psi, stiction)
    rtol = (RTOL if eps > 0.0 else RTOL_OF_LIMIT) if rtol is None else rtol
    atol = ATOL_SHARE * rtol if atol is None else atol
    span = checked_span(t_span)
    when = checked_times(times, span)
    checked_tolerances(rtol, atol, max_steps, max_step)
    formulas, watched = field(system), checked_events(events)
    states = checked_states(with_time(state0, system, span[0]), formulas.m)
    if psi is not None and eps > 0.0:
        asked = RegularisedRun(system, formulas, psi, eps, span, rtol, atol, watched, max_steps, max_step)
    else:
        reach = checked_stiction(stiction, formulas)
        asked = NonsmoothRun(system, psi, formulas, watched, span, rtol, atol, max_steps, max_step, reach)
    runs = tuple(run.sample(when) for run in asked.runs(states))
    return runs[0] if np.ndim(state0) < 2 else runs


@_simulate_nonsmooth
def simulate_nonsmooth(
    system: AnySystem,
    state0: ArrayLike,
    t_span: ArrayLike,
    psi: Psi | None = None,
    *,
    rtol: float | None = None,
    atol: float | None = None,
    events: Events = (),
    times: ArrayLike | None = None,
    stiction: float = 1.0,
    max_steps: int = MAX_STEPS,
    max_step: float = math.inf,
) -> Simulation | tuple[Simulation, ...]:
    """Follow one motion of (2.7) itself, the limit: ``simulate(system, psi, state0, t_span, eps=0)``.

    Parameters
    ----------
    system, state0, t_span, psi, rtol, atol, events, times, stiction, max_steps, max_step
        As in `simulate`.

    Returns
    -------
    Simulation, or tuple of k Simulation

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
    return simulate(
        system, psi, state0, t_span, eps=0.0, rtol=rtol, atol=atol, events=events, times=times, stiction=stiction,
        max_steps=max_steps, max_step=max_step,
    )  # fmt: skip
