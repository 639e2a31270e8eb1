"""Checks of the arguments of a motion: its span, its initial state, its tolerances."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from ..results.arrays import Array
from ..systems.kinds import AnySystem
from ..systems.psi.function import Psi

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
