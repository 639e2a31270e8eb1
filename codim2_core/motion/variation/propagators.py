"""Derivatives of a motion by its initial state and by numbers of its system: the linear equations Y' = J(t) Y.

They are solved for all steps at once, by collocation, halved where it matters.

A step of the motion is as long as the motion is smooth, and its variation may be less so: next to a straight slip
others turn. So each part of a step is solved whole and in halves, and halved again where the two differ.

Neighbours of a motion in an invariant line, where it comes to Sigma along a limit direction that repels angularly.

It is on the stable manifold of a half-saddle, ``rho' = -r rho``, ``theta' = t theta`` with r, t > 0. One at
a small angle d next to it turns away at ``rho ~ d^(r/t)``, goes along the equator to the next limit direction, on
either side, and is late, and elsewhere in z, by as much: with r > t no derivative is left of that.

The motion in the line *passes* if it leaves along the limit direction that is next on both sides, ``rho' = R rho``,
``theta' = -T theta``. Then what was d is ``d^(r T/(t R))`` once rho is what it was: with r T > t R it is forgotten
too, and (x, y) only says when it passes, as where all directions attract. For dry friction S in a line, against a
force f > S, r = f + S, t = T = f and R = f - S. If it *slides* on a critical set to which what comes along the next
directions goes as well, the angle is lost on Sigma.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...formulas.switches import jump_names
from ...numerics.dense import Dense
from ...numerics.radau import tableau
from ...portrait.approach_outcomes import outcome_towards
from ...portrait.layer_problem.problem import LayerProblem
from ...results.arrays import Array
from ...results.result import Result
from ...results.tables import html_table, paragraphs, table_number
from ...results.words import say
from ...systems.kinds import AnySystem
from ...systems.psi.constructors import constant
from ...systems.psi.function import Psi, smoothed_direction
from ..initial_value.field import Slopes, slopes_of


@dataclass(frozen=True, eq=False)
class Variation(Result):
    """Derivatives of a motion, the variational equation solved along it; arrays are read-only.

    In the limit eps -> 0 they go through arrival, sliding, crossing and exit at the equator by saltation matrices.
    Columns belong to the state at the start, then to `names`.

    Attributes
    ----------
    names : tuple of str
        Numbers of the system by which it is differentiated: q of them.
    times : ndarray (k,)
        Ends of the steps of the motion as far as its derivatives are known; all of them, unless `reason` says why not.
    propagators : ndarray (k - 1, n + q, n + q)
        Change of (state, names) at the end of each step by that at its beginning, with what happens at its end.
    error : ndarray (n, n + q)
        Estimate of the error of `last`: its change as the equation is solved in parts half as long. That of the motion
        itself is not in it.
    rate : ndarray (n,)
        Of the state at the last time.
    reason : str
        Why it is not known further; empty where all of it is known.
    within : ndarray (n, k) or None
        Basis of the changes that are not left out where it stays in an invariant line that repels; None elsewhere.
    """

    names: tuple[str, ...]
    times: Array = field(repr=False)
    propagators: Array = field(repr=False)
    error: Array = field(repr=False)
    rate: Array = field(repr=False)
    reason: str
    within: Array | None = field(default=None, repr=False)

    def _tables_(self) -> str:
        states = ["x", "y", *(f"z{i}" for i in range(1, len(self.rate) - 1))]
        head = (f"at t = {table_number(float(self.times[-1]))}", *(f"∂/∂{name}" for name in (*states, *self.names)))
        body = [(name, *map(table_number, row)) for name, row in zip(states, self.last.tolist(), strict=True)]
        return html_table(head, body) + paragraphs([self.reason] if self.reason else [])

    @cached_property
    def matrices(self) -> Array:
        """Derivatives of the state (k, n, n + q) at `times`: by the state at the start, and by `names`."""
        n, size = len(self.rate), self.propagators.shape[1]
        found = np.empty((len(self.times), n, size))
        product = np.eye(size)
        found[0] = product[:n]
        for k, step in enumerate(self.propagators, 1):
            product = step @ product
            found[k] = product[:n]
        found.flags.writeable = False
        return found

    @property
    def last(self) -> Array:
        """Derivatives of the last state, (n, n + q)."""
        return self.matrices[-1]

    def by(self, name: str) -> Array:
        """Return the derivative (k, n) of the state at `times` by one of `names`.

        Raises
        ------
        ValueError
            The motion was not differentiated by it.
        """
        if name not in self.names:
            raise ValueError(f"{name!r} is none of {self.names}; ask for variation({name!r}).")
        return self.matrices[:, :, len(self.rate) + self.names.index(name)]

    def through(self, normal: ArrayLike) -> tuple[Array, Array]:
        """Return the derivatives of when, and of where, the motion passes a section at the last time.

        Parameters
        ----------
        normal : (n,)
            Gradient by the state of the function that is zero on the section, such as that of a terminal `Event`.

        Returns
        -------
        time : ndarray (n + q,)
        place : ndarray (n, n + q)
            Of a Poincare map, where the motion starts on a section and ends on it.

        Raises
        ------
        ValueError
            The normal has another length, or the motion touches the section.
        """
        across = np.asarray(normal, float)
        if across.shape != self.rate.shape:
            raise ValueError(
                f"normal has shape {across.shape}; give {len(self.rate)} numbers, one for each of x, y, z."
            )
        speed = float(across @ self.rate)
        if speed == 0.0:
            raise ValueError("the motion touches the section at its last time; give one that it passes.")
        time = -(across @ self.last) / speed
        return time, self.last + np.outer(self.rate, time)

    @cached_property
    def exponents(self) -> Array:
        """Growth rates (n,) of the motion, largest first: over a long one, estimates of its Lyapunov exponents.

        Logarithms of the factors by which small parallelepipeds grow, by the time; -inf for directions that a motion
        in the limit eps -> 0 loses as it arrives at Sigma.
        """
        n = len(self.rate)
        Q, logs = np.eye(n), np.zeros(n)
        for step in self.propagators:
            Q, R = np.linalg.qr(step[:n, :n] @ Q)
            size = np.abs(np.diag(R))
            size[step[:n].any(axis=1).sum() :] = 0.0  # lost, and not what rounding leaves of it
            logs += np.log(size, out=np.full(n, -np.inf), where=size > 0.0)
        found = np.sort(logs / (self.times[-1] - self.times[0]))[::-1].copy()
        found.flags.writeable = False
        return found


Jacobian = Callable[[NDArray[np.intp], Array], Array]

DEEPEST = 24  # halvings of a step
DAMPED = 1e-8  # of what comes to a step: what is left of less is 0, whatever it is
AT_ONCE = 64  # parts whose stage equations are held at once


@dataclass(frozen=True, eq=False)
class Propagators:
    """Propagators of the steps of a motion: their action on small changes."""

    fine: Array  # (k, N, N) Change at the end of a step by that at its beginning; `coarse` with parts twice as long
    coarse: Array


def propagators(jacobian: Jacobian, lengths: Array, sizes: Array, rtol: float, before: Array) -> Propagators:
    """Solve Y' = J Y along each of k steps.

    Parts are compared by what they make of the changes that come to them: what an L-stable method damps, more or less
    than the equation does, is not worth a halving.

    Shapes: lengths (k,), sizes (k + 1, N), before (N, N).
    """
    if not len(lengths):
        return Propagators(*np.zeros((2, 0, *before.shape)))
    steps: NDArray[np.intp] = np.arange(len(lengths))
    low, high = np.zeros(len(lengths)), np.ones(len(lengths))
    whole = _solve_collocation(jacobian, lengths, steps, low, high)
    to_steps, size = np.empty_like(whole), np.empty(len(lengths))
    for k, step in enumerate(whole):
        least = DAMPED * np.abs(before / np.maximum(sizes[k], sizes[k + 1])[:, None]).max()
        to_steps[k], before = before, step @ before
        size[k] = max(np.abs(before / sizes[k + 1, :, None]).max(), least)
    coming = to_steps
    done: list[tuple[NDArray[np.intp], Array, Array, Array]] = []
    for depth in range(DEEPEST + 1):
        middle = 0.5 * (low + high)
        first = _solve_collocation(jacobian, lengths, steps, low, middle)
        second = _solve_collocation(jacobian, lengths, steps, middle, high)
        both = second @ first
        off = np.abs((both - whole) @ coming / sizes[steps + 1, :, None]).max(axis=(1, 2), initial=0.0)
        apart = (off > rtol * size[steps]) & (depth < DEEPEST)  # undefined: False
        done.append((steps[~apart], low[~apart], both[~apart], whole[~apart]))
        if not apart.any():
            break
        steps, low, middle, high = steps[apart], low[apart], middle[apart], high[apart]
        whole = _interleave_rows(first[apart], second[apart])
        steps, low, high = np.repeat(steps, 2), _interleave_rows(low, middle), _interleave_rows(middle, high)
        coming = _accumulate(to_steps, [(at, begin, two) for at, begin, two, _ in done], (steps, low, whole))
    fine = np.broadcast_to(np.eye(sizes.shape[1]), (len(lengths), *before.shape)).copy()
    coarse = fine.copy()
    at, begin, two, one = (np.concatenate(column) for column in zip(*done, strict=True))
    for part in np.lexsort((begin, at)):
        fine[at[part]] = two[part] @ fine[at[part]]
        coarse[at[part]] = one[part] @ coarse[at[part]]
    return Propagators(fine, coarse)


StepParts = tuple[NDArray[np.intp], Array, Array]


def _accumulate(to_steps: Array, done: list[StepParts], left: StepParts) -> Array:
    """Return what comes to the parts that are left, through all before them as well as they are known by now."""
    at, begin, matrices = (np.concatenate(column) for column in zip(*done, left, strict=True))
    first, found, product = len(at) - len(left[0]), np.empty_like(left[2]), {}
    order = np.lexsort((begin, at))
    for part in order[np.isin(at[order], left[0])].tolist():
        k = int(at[part])
        before = product.get(k, to_steps[k])
        if part >= first:
            found[part - first] = before
        product[k] = matrices[part] @ before
    return found


def _interleave_rows(first: Array, second: Array) -> Array:
    """Rows of two arrays, in turn."""
    return np.stack((first, second), axis=1).reshape(-1, *first.shape[1:])


def _solve_collocation(jacobian: Jacobian, lengths: Array, steps: NDArray[np.intp], low: Array, high: Array) -> Array:
    """Solve along parts of steps by Radau IIA, as the motion itself: L-stable, of order 9."""
    table = tableau()
    found = []
    for begin in range(0, len(steps), AT_ONCE):
        these = slice(begin, begin + AT_ONCE)
        span = (high - low)[these]
        J = jacobian(steps[these], low[these, None] + span[:, None] * table.nodes)
        k, s, N = J.shape[:3]
        h = lengths[steps[these]] * span
        blocks = -h[:, None, None, None, None] * np.einsum("ij,kjab->kiajb", table.A, J)
        stages = blocks.reshape(k, s * N, s * N) + np.eye(s * N)
        undefined = ~np.isfinite(stages).all(axis=(1, 2))
        stages[undefined] = np.eye(s * N)
        ends = np.linalg.solve(stages, np.broadcast_to(np.tile(np.eye(N), (s, 1)), (k, s * N, N)))[:, -N:]
        ends[undefined] = np.nan
        found.append(ends)
    return np.concatenate(found)


def states_along(motion: Dense, steps: NDArray[np.intp], u: Array) -> Array:
    """States (p s, n) of a motion at fractions (p, s) of steps (p,)."""
    powers = u[:, :, None] ** np.arange(1, motion.polynomials.shape[2] + 1)
    found = motion.states[steps, None] + np.einsum("pjd,psd->psj", motion.polynomials[steps], powers)
    return found.reshape(-1, motion.states.shape[1])


def pad_jacobians(slopes: Array, shape: tuple[int, ...]) -> Array:
    """J (p, s, N, N) of states and of numbers that stay what they are, from the rows of the states (p s, n, N)."""
    count, n, N = slopes.shape
    found = np.zeros((count, N, N))
    found[:, :n] = slopes
    return found.reshape(*shape, N, N)


def past_jumps(
    fine: Array, coarse: Array, times: Array, jumps: Mapping[float, bool], slopes: Slopes
) -> tuple[Array, Array, str]:
    """Pass the jumps of a load: what time alone decides changes nothing but what comes from a change of the clock.

    fine, coarse: The steps that are known; changes of a clock end at a jump, as columns of zeros; reason: Why no more
    are. Shapes: fine, coarse (k, N, N), times (k + 1,).
    """
    names = {name for name, _ in slopes.kept}
    for t, by_time in jumps.items():
        step = int(np.searchsorted(times[:-1], t, side="left"))
        if step >= len(fine):
            continue
        if not by_time or not names.isdisjoint(jump_names(slopes.rows)):
            return fine[:step], coarse[:step], say("variation at a jump", t=t)
        for i, row in enumerate(slopes.rows[2:]):
            if row.constant is not None:
                fine[step, :, 2 + i] = coarse[step, :, 2 + i] = 0.0
    return fine, coarse, ""


def chain_propagators(
    names: tuple[str, ...],
    times: Array,
    fine: Array,
    coarse: Array,
    rate: Array,
    reason: str = "",
    within: Array | None = None,
) -> Variation:
    """Make the result of the steps' propagators (k, N, N) at times (k + 1,), up to the first that is undefined."""
    undefined = np.flatnonzero(~np.isfinite(fine).all(axis=(1, 2)))
    if len(undefined):
        first = int(undefined[0])
        fine, coarse, times = fine[:first], coarse[:first], times[: first + 1]
        reason, rate = say("variation undefined", t=float(times[-1])), np.full(len(rate), np.nan)
    one, two = np.eye(fine.shape[1]), np.eye(fine.shape[1])
    with np.errstate(over="ignore", invalid="ignore"):
        for step, longer in zip(fine, coarse, strict=True):
            two, one = step @ two, longer @ one
        error = np.abs(two - one)[: len(rate)]
    times, steps = times.copy(), fine.copy()
    for array in (times, steps, error, rate, *([] if within is None else [within])):
        array.flags.writeable = False
    return Variation(names, times, steps, error, rate, reason, within)


RTOL = 1e-10  # how far a part of a step and its halves may differ


def of_regularised(
    system: AnySystem, psi: Psi, eps: float, motion: Dense, jumps: Mapping[float, bool], names: Sequence[str]
) -> Variation:
    """Differentiate a motion by its start, and by numbers of its system."""
    slopes, states = slopes_of(system, names), motion.states

    def jacobian(steps: NDArray[np.intp], u: Array) -> Array:
        at = states_along(motion, steps, u)
        return pad_jacobians(slopes.of_state(*smoothed_direction(psi, eps, at[:, :2]), at), u.shape)

    rho = np.hypot(np.hypot(*states[:, :2].T), eps)
    sizes = np.ones((len(states), states.shape[1] + len(names)))
    sizes[:, :2] = rho[:, None]
    found = propagators(jacobian, motion.lengths, sizes, RTOL, np.diag(sizes[0]))
    rate = slopes.rates(smoothed_direction(psi, eps, states[-1:, :2])[0], states[-1:])[0]
    fine, coarse, reason = past_jumps(found.fine, found.coarse, motion.times, jumps, slopes)
    return chain_propagators(tuple(names), motion.times[: len(fine) + 1], fine, coarse, rate, reason)


MARGIN = 1e-6  # relative, by which the rates must differ
ANGLE_MARGIN = 1e-6  # rad


def shrinks_across(
    system: AnySystem, psi: Psi | None, z: tuple[float, ...], arriving: float, leaving: float | None
) -> bool:
    """Whether nothing is left, to first order, of a small angle next to a motion once it has been on Sigma."""
    problem = LayerProblem(system.at(z), constant() if psi is None else psi)
    equator = problem.equator
    if not len(equator) or len(equator.arcs) or (equator.multiplicity != 1).any():
        return False
    gaps = [abs(math.remainder(theta - arriving, math.tau)) for theta in equator.theta.tolist()]
    i = min(range(len(gaps)), key=gaps.__getitem__)
    r, t = -float(equator.lambda_rho[i]), float(equator.lambda_theta[i])
    if gaps[i] > ANGLE_MARGIN or not (t > 0.0 and r > (1.0 + MARGIN) * t):
        return False
    neighbours = {(i + 1) % len(gaps), (i - 1) % len(gaps)}
    if leaving is not None:
        (k,) = neighbours if len(neighbours) == 1 else (i,)
        R, T = float(equator.lambda_rho[k]), -float(equator.lambda_theta[k])
        same = abs(math.remainder(float(equator.theta[k]) - leaving, math.tau)) < ANGLE_MARGIN
        return same and R > 0.0 and T > 0.0 and r * T > (1.0 + MARGIN) * t * R
    compare = None if psi is None else ()
    ways = [outcome_towards(problem, float(equator.theta[k]), compare) for k in neighbours]
    return all(way.verdict == "slide" and not way.depends_on_psi for way in ways) and len({w.onto for w in ways}) == 1
