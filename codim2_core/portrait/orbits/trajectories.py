"""Trajectories of the layer problem on the projected hemisphere, and of the nonsmooth system outside.

Both are one field in (p_x, p_y, w), w = ebar on the hemisphere and rho outside, see `stepping.fields`; w enters only
as a factor, so that it keeps its relative accuracy however small it is. Time is T with dT = dt/rho.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from itertools import pairwise
from types import SimpleNamespace
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...results.arrays import Array
from ...results.result import ByValue
from ...systems.elinear import ELinear
from ...systems.frozen import FrozenSystem
from ...systems.kinds import AnySystem, takes_names
from ...systems.psi.function import Psi
from ..layer_problem.critical import CriticalSet
from ..layer_problem.equator import EquatorEquilibria
from .result import STATUSES, Status, Trajectories, append_continuations, concatenate
from .seeds import DEFAULT_MAX_STEPS, PIXEL, Stepping, checked_seeds, departures, stepping

MIN_DURATION = 40.0  # over the size of U: what is drawn in any case
MAX_DURATION = 1e9  # and at most: rates 1e-8 of the largest are 0 to differences (`stepping.polyline`)
ARRIVAL = 10.0  # over the slowest rate: e^-10 of the way is left, a hundredth of a pixel
STIFF = 60.0  # ratio of the rates at one equilibrium from which an explicit method is bound to the fast one for long


def is_stiff(equator: EquatorEquilibria, critical: tuple[CriticalSet, ...] = ()) -> bool:
    """Whether trajectories creep along a slow direction, at any equilibrium: another is `STIFF` times as fast."""
    rho, theta = abs(equator.lambda_rho), abs(equator.lambda_theta)
    if (np.maximum(rho, theta) > STIFF * np.minimum(rho, theta)).any():
        return True
    rates = [abs(C.eigenvalues.real) for C in critical if C.discriminant >= 0.0]
    return any(one.max() > STIFF * one.min() for one in rates)


def drawn_duration(at: FrozenSystem, equator: EquatorEquilibria, critical: tuple[CriticalSet, ...] = ()) -> float:
    """Longest time T of each half of a drawn trajectory."""
    size = at.size or 1.0
    rates = np.minimum(abs(equator.lambda_rho), abs(equator.lambda_theta)).tolist()
    for C in critical:
        if C.kind != "saddle":
            # J is in the time of kappa_2, and dT = ebar dtau
            height = 1.0 / math.hypot(1.0, float(C.x2[0]), float(C.x2[1]))
            rates.append(float(abs(C.eigenvalues.real).min()) / height)
    needed = ARRIVAL / min([rate for rate in rates if rate > 0.0], default=math.inf)
    return min(max(MIN_DURATION / size, needed), MAX_DURATION / size)


@dataclass(frozen=True, eq=False)
class Orbits(ByValue):
    """Orbits through seeds; all arrays are read-only and points run with increasing time."""

    backward: Trajectories  # the two halves; each starts at the seed, time T = 0
    forward: Trajectories

    def __len__(self) -> int:
        return len(self.forward)

    @cached_property
    def _order(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Places of all points in (backward.buffer, forward.buffer) laid end to end, and offsets (k + 1,)."""
        back, ahead = self.backward.offsets, self.forward.offsets
        before, after = back[1:] - back[:-1] - 1, ahead[1:] - ahead[:-1]  # the seed is drawn once
        counts = before + after
        offsets = np.zeros(len(counts) + 1, np.int64)
        counts.cumsum(out=offsets[1:])
        within = np.arange(offsets[-1]) - offsets[:-1].repeat(counts)
        past = within < before.repeat(counts)
        from_back = (back[1:] - 1).repeat(counts) - within
        from_ahead = (back[-1] + ahead[:-1] - before).repeat(counts) + within
        return np.where(past, from_back, from_ahead), offsets

    @property
    def offsets(self) -> NDArray[np.int64]:
        """Orbit i is ``buffer[offsets[i]:offsets[i + 1]]``; (k + 1,)."""
        return self._order[1]

    @cached_property
    def buffer(self) -> Array:
        """Picture points of all orbits, one after the other; (N, 2)."""
        points = np.concatenate([self.backward.buffer, self.forward.buffer])[self._order[0]]
        points.flags.writeable = False
        return points

    @cached_property
    def clock(self) -> Array:
        """The time T at each point, 0 at the seed; (N,)."""
        times = np.concatenate([self.backward.clock, self.forward.clock])[self._order[0]]
        times.flags.writeable = False
        return times

    @cached_property
    def points(self) -> list[Array]:
        """One (m, 2) array an orbit."""
        at = self.offsets.tolist()
        return [self.buffer[i:j] for i, j in pairwise(at)]

    @cached_property
    def times(self) -> list[Array]:
        """One (m,) array an orbit."""
        at = self.offsets.tolist()
        return [self.clock[i:j] for i, j in pairwise(at)]

    @property
    def status(self) -> tuple[Status, ...]:
        """Return the reason why each orbit ends, forward in time."""
        return self.forward.status

    @property
    def origin(self) -> tuple[Status, ...]:
        """Return the reason why each orbit ends, backward in time: its alpha limit set."""
        return self.backward.status


DRAWN = 0.25  # of a pixel: how far a polyline may be from its curve
# Steps of a stiff problem before those of its trajectories that are still under way are followed implicitly, and then.
# A step of either costs about as much; one implicit step does for any number that stability would ask for. What is
# longer than the disc is wide by then, or would be at its last pace in as much time again, goes round and round, and
# does not creep.
EXPLICIT, IMPLICIT, ROUND_FACTOR = 300, 1.0 / 3.0, 2.5  # IMPLICIT: of the step limit

FARTHEST_PLACES = (
    1e6  # from Sigma, of a seed whose line is drawn: to a quarter of a pixel an arc has points without end beyond
)

GENERAL, CREEPING = "general", "creeping"
# What has run: families of Psi for e-linear systems, GENERAL for any other; and the implicit kernels.
_warm: set[str] = set()


@lru_cache(maxsize=1)
def _kernels() -> SimpleNamespace:
    """Load the compiled parts on first use: compiling, or loading from the disk cache, starts with their first call."""
    from ..stepping import lanes, layout, right_hand_side, rosenbrock

    return SimpleNamespace(
        integrate=lanes.integrate,
        creep=rosenbrock.creep,
        problem=right_hand_side.problem,
        is_compiled=right_hand_side.is_compiled,
        states_of=layout.states_of,
    )


@takes_names
def trajectories(
    system: AnySystem,
    psi: Psi,
    seeds: ArrayLike,
    z: ArrayLike = (),
    *,
    t_max: float = 8.0,
    rtol: float = 1e-6,
    atol: float = 1e-8,
    backward: bool = False,
    view: float = 2.0,
    pixel: float = PIXEL,
    capture: float | None = None,
    samples: Literal["ends"] | None = None,
    length: float = math.inf,
    step_limit: int = DEFAULT_MAX_STEPS,
    stiff: bool = False,
) -> Trajectories:
    """Follow trajectories from points of the picture: (3.26) on the hemisphere, (2.12) outside.

    Parameters
    ----------
    system : ELinear or System, or either frozen at a z
        A System costs one small compilation, whatever Psi, z and its parameters are.
    psi : Psi
    seeds : (k, 2)
        Points of the picture: |p| < 1 on the hemisphere, |p| = 1 + rho outside, |p| = 1 on the equator, which is
        followed exactly. They may be mixed.
    z : (m,) floats
    t_max : float
        Longest time T (dT = dt/rho) along a trajectory.
    rtol, atol : float
        Tolerances of p on the unit sphere; those of w = ebar or rho are relative. rtol in [1e-14, 0.1].
    backward : bool
        Follow against time; `times` then decrease from 0.
    view : float
        Outside, a trajectory ends where |p_x| or |p_y| of its picture point reaches view. (One that bulges out and
        back between two steps goes on.)
    pixel : float
        A pixel in picture units: lines stay within a quarter of it from the curve, with as few points as that takes.
    capture : float, optional
        Arc on the sphere (outside: distance in (theta, rho)) from an attracting equilibrium at which a trajectory
        ends. Default rtol + atol. Saddles, centres and slow passages end nothing.
    samples : "ends" or None
        "ends" returns only the first and the last point of each trajectory.
    length : float
        Length of the drawn line, in picture units, at which a trajectory ends; a cycle is drawn a few times over
        and not for ever.
    step_limit : int
        Steps tried before a trajectory is given up, with a status that says so.
    stiff : bool
        Trajectories that are still under way after some steps are followed by an implicit method, which is not bound
        to the fastest rate where they creep along a slow direction.

    Returns
    -------
    Trajectories

    Raises
    ------
    ValueError
        An argument is invalid; the message says which, and what is allowed.

    Examples
    --------
    One comes to the critical set, the other from outside to Sigma, along the limit direction Q2:

    >>> from codim2_core import trajectories
    >>> found = trajectories("case1-cm4", seeds=[(0.3, 0.4), (1.5, 0.2)], t_max=40.0)
    >>> [line[-1].round(4).tolist() for line in found.points]
    [[-0.25, 0.0], [-0.5, 0.866]]
    """
    options = stepping(t_max, rtol, atol, backward, view, pixel, capture, samples, length, step_limit, stiff)
    at = system.at(z)
    points = seeds if isinstance(seeds, np.ndarray) and seeds.dtype == np.float64 else checked_seeds(seeds)
    if points.ndim != 2 or points.shape[1] != 2:
        points = checked_seeds(seeds)
    states, signs, largest = _kernels().states_of(np.array(points, order="C"))  # one compilation, read-only or not
    if math.isnan(largest):
        checked_seeds(seeds)  # says which
    if largest > FARTHEST_PLACES and options.samples is None:
        far = np.flatnonzero(np.abs(points).max(axis=1) > FARTHEST_PLACES)
        raise ValueError(
            f"seed {far[0]} is {tuple(points[far[0]].tolist())}; give points at most {FARTHEST_PLACES:g} away, "
            'or samples="ends".'
        )
    return _integrate(at, psi, states, signs, options)


def _integrate(at: FrozenSystem, psi: Psi, states: Array, signs: Array, options: Stepping) -> Trajectories:
    if len(states) == 0:
        return concatenate([])
    if not options.stiff:
        return integrate_explicitly(at, psi, states, signs, options)
    found = integrate_explicitly(at, psi, states, signs, replace(options, step_limit=min(EXPLICIT, options.step_limit)))
    which, spent, drawn, pace = _under_way(found)
    creeping = (drawn < ROUND_FACTOR) & (pace * spent < ROUND_FACTOR)
    if options.step_limit > EXPLICIT and creeping.any():
        which, spent, drawn = which[creeping], spent[creeping], drawn[creeping]
        rest = _integrate_implicitly(at, psi, found.ends[which], signs[which], spent, drawn, options)
        found = append_continuations(found, which, rest)
        which, spent, drawn, _ = _under_way(found)
    more = options.step_limit - EXPLICIT - (int(IMPLICIT * options.step_limit) if creeping.any() else 0)
    if not len(which) or more <= 0:
        return found
    last = replace(
        options, t_max=max(options.t_max - spent.min(), 1e-300), length=max(options.length - drawn.max(), 1e-9),
        step_limit=more,
    )  # fmt: skip
    return append_continuations(found, which, integrate_explicitly(at, psi, found.ends[which], signs[which], last))


def _under_way(found: Trajectories) -> tuple[NDArray[np.int64], Array, Array, Array]:
    """Return the trajectories that came to the step limit: indices, times, lengths, and last speeds."""
    which = np.flatnonzero(found.codes == STATUSES.index(Status.STEP_LIMIT))
    lines, times = found.points, found.times
    spent = np.array([abs(times[i][-1]) for i in which])
    drawn = np.array([np.hypot(*np.diff(lines[i], axis=0).T).sum() for i in which])
    last = [(math.dist(lines[i][-2], lines[i][-1]), abs(times[i][-1] - times[i][-2])) for i in which]
    return which, spent, drawn, np.array([way / max(time, 1e-300) for way, time in last])


def integrate_explicitly(at: FrozenSystem, psi: Psi, states: Array, signs: Array, options: Stepping) -> Trajectories:
    """Follow trajectories explicitly."""
    kernels = _kernels()
    # Time in units of 1/|U| makes step sizes, speeds and capture independent of the scale of U.
    problem, unit = kernels.problem(at, psi, options.backward), at.speed
    buffer, clock, offsets, ends, codes, evaluations = kernels.integrate(
        states,
        signs,
        problem.shared,
        problem.address,
        min(float(options.t_max) * unit, 1e300),
        float(options.rtol),
        float(options.atol),
        int(options.step_limit),
        options.reach,
        float(options.view),
        0.0 if options.samples == "ends" else DRAWN * float(options.pixel),
        float(options.length),
    )
    clock *= (-1.0 if options.backward else 1.0) / unit
    _warm.add(GENERAL if at.as_given is None else psi.family)
    return Trajectories(buffer, clock, offsets, ends, codes, int(evaluations))


def _integrate_implicitly(
    at: FrozenSystem, psi: Psi, states: Array, signs: Array, spent: Array, drawn: Array, options: Stepping
) -> Trajectories:
    """Follow trajectories implicitly, after a time that each has `spent` and a length that is `drawn`."""
    kernels = _kernels()
    problem, unit = kernels.problem(at, psi, options.backward), at.speed
    buffer, clock, offsets, ends, codes, evaluations = kernels.creep(
        states,
        signs,
        np.clip((options.t_max - spent) * unit, 1e-12, 1e300),
        np.maximum(options.length - drawn, 0.0),
        problem.shared,
        problem.address,
        float(options.rtol),
        float(options.atol),
        max(1, int(IMPLICIT * options.step_limit)),
        options.reach,
        float(options.view),
        0.0 if options.samples == "ends" else DRAWN * float(options.pixel),
    )
    clock *= (-1.0 if options.backward else 1.0) / unit
    _warm.add(CREEPING)
    return Trajectories(buffer, clock, offsets, ends, codes, int(evaluations))


def warm(psi: Psi | None = None) -> None:
    """Compile, or load from the disk cache, all that trajectories of e-linear systems with this Psi need."""
    from ...systems.psi.constructors import constant

    psi = constant() if psi is None else psi
    elinear, seeds = ELinear(-1.0, 0.5, -1.0, (0.1, 0.0)), np.array([(0.5, 0.0), (1.5, 0.0)])
    trajectories(elinear, psi, seeds)
    trajectories(ELinear(-1.0, 0.5, -1e4, (0.1, 0.0)), psi, seeds, t_max=1e6, stiff=True)
    trajectories(elinear, psi, checked_seeds(seeds))  # read-only arrays are another type to Numba


def is_warm(psi: Psi | None = None, at: FrozenSystem | None = None) -> bool:
    """Whether trajectories (with this Psi, of such a system) run at once, without compiling or loading."""
    kernels = _kernels()
    if CREEPING not in _warm or not all(getattr(one, "signatures", True) for one in (kernels.integrate, kernels.creep)):
        return False  # or they run as Python
    if psi is None:
        return True
    kind = GENERAL if at is not None and at.as_given is None else psi.family
    return kind in _warm and kernels.is_compiled(psi)


def continuation(
    system: AnySystem,
    psi: Psi,
    theta: ArrayLike,
    z: ArrayLike = (),
    *,
    t_max: float = 8.0,
    rtol: float = 1e-6,
    atol: float = 1e-8,
    backward: bool = False,
    view: float = 2.0,
    pixel: float = PIXEL,
    capture: float | None = None,
    samples: Literal["ends"] | None = None,
    length: float = math.inf,
    step_limit: int = DEFAULT_MAX_STEPS,
    stiff: bool = False,
    more_starts: Array | None = None,
) -> Trajectories:
    """Continue trajectories that arrive at limit directions up the hemisphere, Figure 7, Theorem 3.1(b).

    Where lambda_rho < 0 the equilibrium Q of the equator has one invariant direction up the hemisphere, with rate
    -lambda_rho > 0 (backward: where lambda_rho > 0). The orbit that leaves along it is followed from Q itself, from
    a local expansion whose error is below the tolerance.

    Each starts less than 1e-6 (in |p|) above the equator, at theta; after these come those from `more_starts`. Raises
    ValueError: A direction is not a limit direction, or no trajectory of the nonsmooth system arrives along it.
    Shapes: theta (k,).
    """
    options = stepping(t_max, rtol, atol, backward, view, pixel, capture, samples, length, step_limit, stiff)
    at = system.at(z)
    states = departures(at, psi, theta, rtol, backward)
    if more_starts is not None:
        states = np.concatenate([states, _kernels().states_of(np.array(more_starts, order="C"))[0]])
    return _integrate(at, psi, states, np.full(len(states), -1.0), options)
