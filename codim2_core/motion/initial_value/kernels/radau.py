"""One step of Radau IIA of order 9 for one motion (x, y, z): its coefficients are those of `numerics.radau`."""

from __future__ import annotations

import math

import numpy as np

from ....formulas.jit import spliced_kernel
from ....numerics.radau import FAILED_SHRINKAGE, MAX_GROWTH, MAX_SHRINKAGE, STAGES, STEP_SAFETY
from .rate import inward_bound, jacobian, rate, sizes, without_blur
from .stages import factor, guess, matrices, solve, solve_stages

CONTACT = 20.0  # times eps: so near, what looks like a way inward may be the rounding of a slide, eps times 1/rtol


@spliced_kernel
def _longest_step(motion, y, work, h):
    """Longest step: 0.9 of the way to Sigma, and one time of growth, which a longer step would damp; and the reach.

    In contact with Sigma there is no way left to jump over.

    The reach is that of Gershgorin's circles, in units of size: h times it is about how stiff a step is. The
    eigenvalues are requested only if a step h could be too long for them.
    """
    n, J, size = motion.n, work.J, work.size
    away = y[0] * y[0] + y[1] * y[1] > (CONTACT * motion.eps) ** 2
    bound = inward_bound(motion, y, work.rate) if away else math.inf
    right, reach = 0.0, 0.0
    for i in range(n):
        total, scaled = J[i, i], abs(J[i, i])
        for j in range(n):
            if j != i:
                total += abs(J[i, j])
                scaled += abs(J[i, j]) * size[j] / size[i]
        right, reach = max(right, total), max(reach, scaled)
    if right * min(h, bound) > 1.0:
        growth = np.linalg.eigvals(J[:n, :n].astype(np.complex128)).real.max()
        if growth > 0.0:
            bound = min(bound, 1.0 / growth)
    return bound, reach


@spliced_kernel
def linearise(motion, y, wanted, clock, work):
    """Write a state's rate, Jacobian and size; return the longest step allowed from it, and the reach."""
    rate(motion, y, work.S, work.rate)
    jacobian(motion, y, work.S, work.J)
    clock[3] += 1.0
    sizes(motion, y, work.size)
    return _longest_step(motion, y, work, wanted)


@spliced_kernel
def _error(motion, table, y, h, rates, work):
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
    first, second = without_blur(motion, y, h, error[0], error[1], size[0])
    for i in range(n):
        own = first if i == 0 else second if i == 1 else error[i]
        norm = max(norm, abs(own) * size[i] / min(size[i], end_size[i]) / rtol)
        norm = norm if own == own else math.inf
    return norm


@spliced_kernel
def _error_norm(motion, table, y, h, refine, clock, work):
    """Norm of the error of a step whose stages are known; a stiff component's is too large: filter it once more."""
    n, trial = motion.n, work.trial
    for i in range(n):
        trial[i] = y[i] + work.Z[STAGES - 1, i]
    sizes(motion, trial, work.end_size)
    norm = _error(motion, table, y, h, work.rate, work)
    if norm > 1.0 and refine:
        for i in range(n):
            trial[i] = y[i] + work.size[i] * work.error[i]
        rate(motion, trial, work.S, work.rates[0])
        clock[3] += 1.0
        norm = min(norm, _error(motion, table, y, h, work.rates[0], work))
    return norm


@spliced_kernel
def attempt(motion, table, y, h, before_h, refine, clock, work):
    """Try one step: whether it is accepted, and the factor to the next step."""
    n = motion.n
    matrices(table, h, work.J, work.size, work.big, work.small)
    ratio = h / before_h if before_h > 0.0 else math.inf
    guessed = guess(table, work.before, work.first, ratio, y, work.Z)
    if not (factor(work.big, work.big_pivots, STAGES * n) and factor(work.small, work.small_pivots, n)):
        return False, FAILED_SHRINKAGE
    if not solve_stages(motion, table, y, h, clock, work):
        return False, 1.0 if guessed else FAILED_SHRINKAGE
    norm = _error_norm(motion, table, y, h, refine, clock, work)
    if not norm < math.inf:
        return False, MAX_SHRINKAGE
    change = min(max(STEP_SAFETY * max(norm, 1e-12) ** (-1.0 / (STAGES + 1)), MAX_SHRINKAGE), MAX_GROWTH)
    return (True, change) if norm <= 1.0 else (False, min(change, 0.8))


@spliced_kernel
def keep(table, y, work, polynomial, end):
    """Move the state over a step that is accepted, and keep its polynomial, of degree 5."""
    fit, Z, first, before = table.fit, work.Z, work.first, work.before
    for i in range(len(y)):
        first[i] = y[i]
        for k in range(STAGES):
            total = 0.0
            for a in range(STAGES):
                total += fit[k, a] * Z[a, i]
            before[i, k] = total
            polynomial[i, k] = total
        for k in range(STAGES, polynomial.shape[1]):
            polynomial[i, k] = 0.0
        y[i] += Z[STAGES - 1, i]
        end[i] = y[i]
