"""Motions of the regularised system, eps > 0, through slip, entry, sliding and exit."""

from __future__ import annotations

import math
from functools import partial

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..numerics.dense import dense
from ..numerics.growth import BlowUpError, bounded
from ..numerics.radau import Problem, Step, TooManyStepsError, steps
from ..psi.function import Psi
from ..systems.kinds import AnySystem
from .events import Events, Watch, checked_events
from .field import field
from .line import invariant_line
from .phases import phases_of
from .problem import plane_problem
from .result import Simulation, SimulationStatus, simulation

__all__ = ["simulate"]

Array = NDArray[np.float64]

SMALLEST_EPS, LARGEST_EPS = 1e-14, 1e6
FIRST = 1e-2  # of rho/|U|: the first step tried
MAX_STEPS = 20_000


def checked_span(t_span: ArrayLike) -> tuple[float, float]:
    """Check (t_start, t_end): finite and increasing."""
    try:
        t_start, t_end = (float(t) for t in np.asarray(t_span, float))
    except (TypeError, ValueError) as error:
        raise ValueError(f"t_span is {t_span!r}; give two times (t_start, t_end).") from error
    if not (math.isfinite(t_start) and math.isfinite(t_end) and t_start < t_end):
        raise ValueError(f"t_span is ({t_start}, {t_end}); give finite times with t_start < t_end.")
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


def checked_tolerances(rtol: float, atol: float, max_steps: int) -> None:
    """Check tolerances and the step limit."""
    if not 1e-13 <= rtol <= 1e-2:
        raise ValueError(f"rtol is {rtol!r}; give a relative tolerance from 1e-13 to 0.01.")
    if not 0.0 < atol < math.inf:
        raise ValueError(f"atol is {atol!r}; give a positive absolute tolerance for z.")
    if not 1 <= max_steps <= 10**9:
        raise ValueError(f"max_steps is {max_steps!r}; give a number of steps from 1 to 1e9.")


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
) -> Simulation:
    """Follow one motion of the regularised system: eq:vf with e replaced by e_Psi, eq:ePsi.

    Parameters
    ----------
    system : ELinear, System, or one of them frozen at a z
    psi : Psi
    eps : float
        1e-14 <= eps <= 1e6.
    state0 : (2 + m,)
        (x, y, z1, ..., zm); x = y = 0 is allowed.
    t_span : (t_start, t_end)
        In the time t of eq:vf, increasing.
    rtol, atol : float
        Error allowed in a step: rtol rho for x and y, rho = sqrt(x^2 + y^2 + eps^2), and rtol |z| + atol for z.
        rtol from 1e-13 to 0.01.
    events : sequence of Event, or of callables (t, state) to float
        Their zeros are found in the dense output, also several in one step; an `Event` may be terminal.
    max_steps : int
        Steps tried before the motion is given up, with a status that says so.

    Returns
    -------
    Simulation
        Its phases are read off the motion when they are first asked for: "slide" where it follows a critical set or a
        limit cycle of the layer problem within O(eps). If it grows beyond bounds, or the step limit is reached, it
        holds what was followed till then.

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
    """
    if not SMALLEST_EPS <= eps <= LARGEST_EPS:
        raise ValueError(f"eps is {eps!r}; allowed is {SMALLEST_EPS:g} <= eps <= {LARGEST_EPS:g}.")
    t_start, t_end = checked_span(t_span)
    checked_tolerances(rtol, atol, max_steps)
    formulas = field(system)
    first = checked_state(state0, formulas.m)
    count = [0]
    line = invariant_line(formulas, first)
    problem = plane_problem(formulas, psi, float(eps), rtol, atol)
    problem = problem if line is None else line.projected(problem)
    rate = problem.F(first)
    if not np.isfinite(rate).all():
        raise ValueError(f"(U, W) is {rate.tolist()} at state0 = {first.tolist()}; it must be finite there.")
    watch = Watch(checked_events(events), t_start, first)
    taken, status, detail = _followed(_counting(problem, count), first, rate, (t_start, t_end), rtol, max_steps, watch)
    motion = dense(t_start, first, taken)
    phases = partial(phases_of, system, psi, float(eps), motion)
    return simulation(motion, phases, status, detail=detail, eps=float(eps), evaluations=count[0], events=watch.times)


def _counting(problem: Problem, count: list[int]) -> Problem:
    def F(state: Array) -> Array:
        count[0] += 1
        return problem.F(state)

    return Problem(F, problem.J, problem.scale, problem.limit)


def first_step(problem: Problem, state: Array, rate: Array) -> float:
    """Return a short first step: a small part of the time in which the state changes by its own size."""
    speed = float(np.max(np.abs(rate) / problem.scale(state)))
    return FIRST / speed if speed > 0.0 else math.inf


def _followed(
    problem: Problem, first: Array, rate: Array, span: tuple[float, float], rtol: float, max_steps: int, watch: Watch
) -> tuple[list[Step], SimulationStatus, str]:
    taken: list[Step] = []
    stepping = steps(problem, *span, first, rtol, first_step(problem, first, rate), max_steps)
    try:
        for step in bounded(problem, stepping):
            last = watch.step(step)
            taken.append(step if last is None else last)
            if last is not None:
                return taken, SimulationStatus.EVENT, ""
    except BlowUpError as error:
        return taken, SimulationStatus.BLOW_UP, str(error)
    except TooManyStepsError as error:
        return taken, SimulationStatus.STEP_LIMIT, str(error)
    return taken, SimulationStatus.T_END, ""
