"""Radau IIA of order 9 for one motion (x, y, z), compiled: the method of `numerics.radau`, step by step the same.

What `numerics.radau` writes in arrays stands here, and in `compiled_stages`, in plain loops over numbers.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from ..numerics.radau import CAREFUL, FAILED, GROW, GROWTH_AFTER_FAILURE, SAFETY, SHRINK, STAGES
from .compiled_rate import jacobian, rate
from .compiled_stages import factor, guess, matrices, solve, solved, workspace

INWARD = 0.9
FINISHED, LIMIT, SHORT, FULL, BLOWN_UP = 0, 1, 2, 3, 4
LARGEST, GROWN = 1e200, 8.0  # as in `numerics.growth`

# What `control` holds.
NEXT, REFINED, WARY, LEFT, TRIED, EXTENT = range(6)


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _bound(motion, y, work, h):
    """Longest step: 0.9 of the way to Sigma, and one time of growth, which a longer step would damp.

    The eigenvalues are asked for only if a step h could be too long for them.
    """
    n, J, eps = motion.n, work.J, motion.eps
    inward = -(y[0] * work.rate[0] + y[1] * work.rate[1])
    bound = INWARD * (y[0] * y[0] + y[1] * y[1] + eps * eps) / inward if inward > 0.0 else math.inf
    reach = 0.0  # of Gershgorin's circles to the right
    for i in range(n):
        total = J[i, i]
        for j in range(n):
            total += abs(J[i, j]) if j != i else 0.0
        reach = max(reach, total)
    if reach * min(h, bound) > 1.0:
        growth = np.linalg.eigvals(J[:n, :n].astype(np.complex128)).real.max()
        if growth > 0.0:
            bound = min(bound, 1.0 / growth)
    return bound


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _sizes(motion, y, size):
    for i in range(2, motion.n):
        size[i] = abs(y[i]) + motion.floor
    size[0] = size[1] = math.sqrt(y[0] * y[0] + y[1] * y[1] + motion.eps * motion.eps)


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _linearised(motion, y, wanted, clock, work):
    """Write a state's rate, Jacobian and size; return the longest step allowed from it."""
    rate(motion, y, work.S, work.rate)
    jacobian(motion, y, work.S, work.J)
    clock[3] += 1.0
    _sizes(motion, y, work.size)
    return _bound(motion, y, work, wanted)


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _error(motion, table, h, rates, work):
    """Write the estimated error in units of size, from a rate where the step begins; return its norm, 1 for rtol."""
    n, gamma, weights, rtol = motion.n, table.gamma, table.error, motion.rtol
    error, size, end_size, Z = work.error, work.size, work.end_size, work.Z
    for i in range(n):
        total = gamma * h * rates[i]
        for a in range(STAGES):
            total += weights[a] * Z[a, i]
        error[i] = total / size[i]
    solve(work.small, work.small_pivots, error, n)
    norm = 0.0
    for i in range(n):
        norm = max(norm, abs(error[i]) * size[i] / min(size[i], end_size[i]) / rtol)
        norm = norm if error[i] == error[i] else math.inf
    return norm


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _estimated(motion, table, y, h, refine, clock, work):
    """Norm of the error of a step whose stages are known; a stiff component's is too large: filter it once more."""
    n, trial = motion.n, work.trial
    for i in range(n):
        trial[i] = y[i] + work.Z[STAGES - 1, i]
    _sizes(motion, trial, work.end_size)
    norm = _error(motion, table, h, work.rate, work)
    if norm > 1.0 and refine:
        for i in range(n):
            trial[i] = y[i] + work.size[i] * work.error[i]
        rate(motion, trial, work.S, work.rates[0])
        clock[3] += 1.0
        norm = min(norm, _error(motion, table, h, work.rates[0], work))
    return norm


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _attempt(motion, table, y, h, before_h, refine, clock, work):
    """Try one step: whether it is accepted, and the factor to the next step."""
    n = motion.n
    matrices(table, h, work.J, work.size, work.big, work.small)
    ratio = h / before_h if before_h > 0.0 else math.inf
    guessed = guess(table, work.before, work.first, ratio, y, work.Z)
    if not (factor(work.big, work.big_pivots, STAGES * n) and factor(work.small, work.small_pivots, n)):
        return False, FAILED
    if not solved(motion, table, y, h, clock, work):
        return False, 1.0 if guessed else FAILED
    norm = _estimated(motion, table, y, h, refine, clock, work)
    if not norm < math.inf:
        return False, SHRINK
    change = min(max(SAFETY * max(norm, 1e-12) ** (-1.0 / (STAGES + 1)), SHRINK), GROW)
    return (True, change) if norm <= 1.0 else (False, min(change, 0.8))


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _keep(table, y, work, polynomial, end):
    """Move the state over a step that is accepted, and keep its polynomial."""
    fit, Z, first, before = table.fit, work.Z, work.first, work.before
    for i in range(len(y)):
        first[i] = y[i]
        for k in range(STAGES):
            total = 0.0
            for a in range(STAGES):
                total += fit[k, a] * Z[a, i]
            before[i, k] = total
            polynomial[i, k] = total
        y[i] += Z[STAGES - 1, i]
        end[i] = y[i]


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _go_on(clock, control, h, y):
    """Let the time go on, with what its rounding loses; say whether the state has blown up."""
    total = h + clock[1]
    ahead = clock[0] + total
    clock[1] = total - (ahead - clock[0])
    extent = 0.0
    for i in range(len(y)):
        extent = max(extent, abs(y[i]))
    if ahead > clock[0]:
        control[EXTENT] = max(control[EXTENT], extent)
    clock[0] = ahead
    return extent > LARGEST or extent > GROWN * control[EXTENT]


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _length(wanted, bound, remaining):
    """Length of the next step: no longer than its bound, and with no sliver left at the end."""
    h = min(wanted, bound)
    if h >= 0.99 * remaining:
        return remaining
    return 0.5 * remaining if h > 0.5 * remaining else h


@njit(cache=True, nogil=True, error_model="numpy")
def follow(motion, table, y, clock, control, starts, lengths, ends, polynomials):
    """Step until the time is over, the steps are used up, or the arrays are full.

    Parameters
    ----------
    motion : Motion
    table : numerics.radau.Tableau
    y : (n,)
        The state, which moves on.
    clock : (4,)
        Time, what its rounding lost, the end of the time, evaluations so far.
    control : (6,)
        NEXT: the next step. REFINED: 1 where its error may be estimated anew. WARY: careful steps left. LEFT: steps
        left to try. TRIED: how many were. EXTENT: the largest size of the state so far.
    starts, lengths (k,), ends (k, n), polynomials (k, n, 5)
        Filled with steps.

    Returns
    -------
    (int, int)
        Why it stopped, and how many steps were filled in.
    """
    work = workspace(motion.n)
    filled, fresh, bound, before_h = 0, True, math.inf, 0.0
    while clock[2] - clock[0] - clock[1] > 0.0:
        if fresh:
            bound = _linearised(motion, y, control[NEXT], clock, work)
        if filled == len(starts):
            return FULL, filled
        h = _length(control[NEXT], bound, clock[2] - clock[0] - clock[1])
        control[LEFT] -= 1.0
        control[TRIED] += 1.0
        if control[LEFT] < 0.0:
            return LIMIT, filled
        if not h > 1e-290:
            return SHORT, filled
        fresh, change = _attempt(motion, table, y, h, before_h, control[REFINED] > 0.0, clock, work)
        if not fresh:
            before_h = 0.0  # a prediction may have misled
            control[NEXT], control[REFINED] = h * change, 1.0
            if change == FAILED:
                control[WARY] = CAREFUL
            continue
        starts[filled], lengths[filled] = clock[0], h
        _keep(table, y, work, polynomials[filled], ends[filled])
        before_h = h
        filled += 1
        if _go_on(clock, control, h, y):
            return BLOWN_UP, filled - 1
        most = GROW
        if control[REFINED] > 0.0 and control[TRIED] > 1.0:
            most = 1.0
        elif control[WARY] > 0.0:
            most = GROWTH_AFTER_FAILURE
        control[NEXT], control[REFINED], control[WARY] = h * min(change, most), 0.0, max(control[WARY] - 1.0, 0.0)
    return FINISHED, filled
