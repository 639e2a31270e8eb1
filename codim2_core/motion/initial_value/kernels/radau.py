"""One step of Radau IIA of order 9 for one motion (x, y, z): its coefficients are those of `numerics.radau`."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from ....formulas.jit import kernel, spliced_kernel
from ....numerics.radau import FAILED_SHRINKAGE, ITERATIONS, MAX_GROWTH, MAX_SHRINKAGE, STAGES, STEP_SAFETY, Tableau
from .rate import inward_bound, jacobian, rate, sizes, without_blur

MAX_EXTRAPOLATION = 4.0  # times the last step: how far its polynomial is continued


class StepArrays(NamedTuple):
    """Arrays that every step writes anew, and the polynomial of the last one."""

    S: Any
    rate: Any
    size: Any
    end_size: Any
    J: Any
    big: Any
    small: Any
    big_pivots: Any
    small_pivots: Any
    Z: Any
    rates: Any
    residual: Any
    trial: Any
    error: Any
    before: Any
    first: Any


@kernel
def work_on(S, n):
    """Return the arrays for a state of n components, with a workspace S that is there already."""
    N = STAGES * n
    return StepArrays(
        S, np.zeros(n), np.zeros(n), np.zeros(n), np.zeros((n, n)), np.zeros((N, N)), np.zeros((n, n)),
        np.zeros(N, np.int64), np.zeros(n, np.int64), np.zeros((STAGES, n)), np.zeros((STAGES, n)), np.zeros(N),
        np.zeros(n), np.zeros(n), np.zeros((n, STAGES)), np.zeros(n),
    )  # fmt: skip


@kernel
def tableau_of(numbers):
    """Return the tableau whose numbers follow one another."""
    square = STAGES * STAGES
    return Tableau(
        numbers[1 : STAGES + 1],
        numbers[STAGES + 1 : STAGES + 1 + square].copy().reshape((STAGES, STAGES)),
        numbers[0],
        numbers[STAGES + 1 + square : 2 * STAGES + 1 + square],
        numbers[2 * STAGES + 1 + square :].copy().reshape((STAGES, STAGES)),
    )


@kernel
def factor(A, pivots, n):
    """LU of A in place, with row exchanges; False if it is singular."""
    for k in range(n):
        p, largest = k, abs(A[k, k])
        for i in range(k + 1, n):
            if abs(A[i, k]) > largest:
                p, largest = i, abs(A[i, k])
        pivots[k] = p
        if not 0.0 < largest < math.inf:
            return False
        if p != k:
            for j in range(n):
                A[k, j], A[p, j] = A[p, j], A[k, j]
        inverse = 1.0 / A[k, k]
        for i in range(k + 1, n):
            share = A[i, k] * inverse
            A[i, k] = share
            if share != 0.0:
                for j in range(k + 1, n):
                    A[i, j] -= share * A[k, j]
    return True


@kernel
def solve(A, pivots, b, n):
    """Solve with the factors, in place."""
    for k in range(n):
        p = pivots[k]
        b[k], b[p] = b[p], b[k]
    for i in range(n):
        total = b[i]
        for j in range(i):
            total -= A[i, j] * b[j]
        b[i] = total
    for i in range(n - 1, -1, -1):
        total = b[i]
        for j in range(i + 1, n):
            total -= A[i, j] * b[j]
        b[i] = total / A[i, i]


@spliced_kernel
def guess(table, before, first, ratio, y, Z):
    """Continue the last step's polynomial into a step `ratio` times as long, if that is not too far; say whether."""
    nodes, guessed = table.nodes, ratio <= MAX_EXTRAPOLATION
    for a in range(STAGES):
        for i in range(len(y)):
            Z[a, i] = 0.0
            if guessed:
                u = 1.0 + ratio * nodes[a]
                total = 0.0
                for k in range(STAGES - 1, -1, -1):
                    total = (total + before[i, k]) * u
                Z[a, i] = total + (first[i] - y[i])
    return guessed


@spliced_kernel
def matrices(table, h, J, size, big, small):
    """Write I - h A x J in units of size, and the small matrix of the error estimate."""
    n, A, gamma = len(size), table.A, table.gamma
    for i in range(n):
        for j in range(n):
            scaled = h * J[i, j] * size[j] / size[i]
            small[i, j] = -gamma * scaled
            for a in range(STAGES):
                for b in range(STAGES):
                    big[a * n + i, b * n + j] = -A[a, b] * scaled
    for a in range(STAGES * n):
        big[a, a] += 1.0
    for i in range(n):
        small[i, i] += 1.0


@kernel
def _newton_verdict(change, last, iteration, enough):
    """After one iteration of Newton's method: 1 if it is enough, -1 if it will not do, 0 if it goes on."""
    if iteration > 0:
        theta = change / last if last > 0.0 else 0.0
        if change <= 100.0 * enough and theta > 0.3 and iteration > 3:
            return 1
        hopeless = theta ** (ITERATIONS - 1 - iteration) * change > enough * (1.0 - theta)
        if change > enough and (theta >= 1.0 or (iteration > 2 and hopeless)):
            return -1
        if theta < 1.0 and theta / (1.0 - theta) * change <= enough:
            return 1
    return 1 if change <= 1e-3 * enough else 0


@spliced_kernel
def solve_stages(motion, table, y, h, clock, work):
    """Solve for the stages Z by simplified Newton iterations; say whether they have converged."""
    n, A, S, big, pivots = motion.n, table.A, work.S, work.big, work.big_pivots
    Z, rates, residual, trial, size = work.Z, work.rates, work.residual, work.trial, work.size
    enough = max(1e-2 * motion.rtol, 1e-14)
    last = math.inf
    for iteration in range(ITERATIONS):
        for a in range(STAGES):
            for i in range(n):
                trial[i] = y[i] + Z[a, i]
            rate(motion, trial, S, rates[a])
        clock[3] += STAGES
        for a in range(STAGES):
            for i in range(n):
                total = 0.0
                for b in range(STAGES):
                    total += A[a, b] * rates[b, i]
                residual[a * n + i] = (h * total - Z[a, i]) / size[i]
        solve(big, pivots, residual, STAGES * n)
        change = 0.0
        for a in range(STAGES):
            first, second = without_blur(motion, y, h, residual[a * n], residual[a * n + 1], size[0])
            for i in range(n):
                own = first if i == 0 else second if i == 1 else residual[a * n + i]
                change = max(change, abs(own)) if own == own else math.inf
        if not change < math.inf:
            return False
        for a in range(STAGES):
            for i in range(n):
                Z[a, i] += residual[a * n + i] * size[i]
        verdict = _newton_verdict(change, last, iteration, enough)
        if verdict != 0:
            return verdict > 0
        last = change
    return False


CONTACT = 20.0  # times eps: so near, what looks like a way inward may be the rounding of a slide, eps times 1/rtol


@spliced_kernel
def _longest_step(motion, y, work, h):
    """Longest step: 0.9 of the way to Sigma, out of contact, and one time of growth; and the reach (Gershgorin)."""
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
