"""Linear equations Y' = J(t) Y along the steps of a motion: all steps at once, by collocation, halved where it matters.

A step of the motion is as long as the motion is smooth, and its variation may be less so: next to a straight slip
others turn. So each part of a step is solved whole and in halves, and halved again where the two differ.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...numerics.dense import Dense
from ...numerics.radau import tableau
from ...results.arrays import Array

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
