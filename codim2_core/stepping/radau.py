"""Radau IIA of order 9 for one motion (x, y, z), compiled: the method of `numerics.radau`, step by step the same.

The right-hand side enters by address, as in `layout`: a function of (c, s, x, y, z1, ...) that writes U and W, one
that writes their derivatives by all of these, and the gain of Psi at one place. What `numerics.radau` writes in
arrays stands here in plain loops over numbers.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from .layout import call_field

STAGES, ITERATIONS = 5, 10
SAFETY, SHRINK, GROW, FAILED = 0.9, 0.2, 8.0, 0.3
CAREFUL, GROWTH_AFTER_FAILURE = 6, 1.2
INWARD = 0.9
DIFFERENCE = 1e-5

# Workspace of the right-hand side: the gain's arguments, the field's, its value, its slopes.
RADIUS, GAIN, ARGUMENTS, VALUE, SLOPES = 0, 4, 8, 8 + 32, 8 + 64

FINISHED, LIMIT, SHORT, FULL, BLOWN_UP = 0, 1, 2, 3, 4
LARGEST, GROWN = 1e200, 8.0  # as in `numerics.growth`
FARTHEST = 4.0  # times the last step: how far its polynomial is continued

# What `control` holds.
NEXT, REFINED, WARY, LEFT, TRIED, EXTENT = range(6)


@njit(cache=True, nogil=True, error_model="numpy")
def _rate(y, n, eps, line, fields, S, P, out):
    """Write the rate (U, W) at a state; in an invariant line, kept in it."""
    x1, x2 = y[0], y[1]
    if line[2] > 0.0:
        along = line[0] * x1 + line[1] * x2
        x1, x2 = along * line[0], along * line[1]
    S[RADIUS], S[RADIUS + 1] = x1 * x1 + x2 * x2, eps
    call_field(fields[2], S, RADIUS, GAIN, P)
    gain = S[GAIN]
    S[ARGUMENTS], S[ARGUMENTS + 1], S[ARGUMENTS + 2], S[ARGUMENTS + 3] = gain * x1, gain * x2, x1, x2
    for i in range(2, n):
        S[ARGUMENTS + 2 + i] = y[i]
    call_field(fields[0], S, ARGUMENTS, VALUE, P)
    for i in range(n):
        out[i] = S[VALUE + i]
    if line[2] > 0.0:
        along = line[0] * out[0] + line[1] * out[1]
        out[0], out[1] = along * line[0], along * line[1]


@njit(cache=True, nogil=True, error_model="numpy")
def _modulus(r, eps, fields, S, P):
    """|e_Psi| at distance r, odd in r."""
    S[RADIUS], S[RADIUS + 1] = r * r, eps
    call_field(fields[2], S, RADIUS, GAIN, P)
    return r * S[GAIN]


@njit(cache=True, nogil=True, error_model="numpy")
def _jacobian(y, n, eps, fields, S, P, J):
    """Write the Jacobian of the rate at a state, right after its rate: S holds the arguments.

    The derivative of |e_Psi| by r is a central difference: Newton's method is a simplified one, and asks no more.
    """
    r = math.hypot(y[0], y[1])
    S[RADIUS], S[RADIUS + 1] = r * r, eps
    call_field(fields[2], S, RADIUS, GAIN, P)
    tangential = S[GAIN]
    h = DIFFERENCE * math.hypot(r, eps)
    radial = (_modulus(r + h, eps, fields, S, P) - _modulus(r - h, eps, fields, S, P)) / (2.0 * h)
    n1, n2 = (y[0] / r, y[1] / r) if r > 0.0 else (1.0, 0.0)
    spread = radial - tangential
    d11, d12, d22 = tangential + spread * n1 * n1, spread * n1 * n2, tangential + spread * n2 * n2
    call_field(fields[1], S, ARGUMENTS, SLOPES, P)
    width = n + 2
    for i in range(n):
        row = SLOPES + i * width
        J[i, 0] = S[row + 2] + S[row] * d11 + S[row + 1] * d12
        J[i, 1] = S[row + 3] + S[row] * d12 + S[row + 1] * d22
        for j in range(2, n):
            J[i, j] = S[row + 2 + j]
        for j in range(n):
            if not math.isfinite(J[i, j]):
                J[i, j] = 0.0


@njit(cache=True, nogil=True, error_model="numpy")
def _factor(A, pivots, n):
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
            factor = A[i, k] * inverse
            A[i, k] = factor
            if factor != 0.0:
                for j in range(k + 1, n):
                    A[i, j] -= factor * A[k, j]
    return True


@njit(cache=True, nogil=True, error_model="numpy")
def _solve(A, pivots, b, n):
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


@njit(cache=True, nogil=True, error_model="numpy")
def _bound(y, rate, n, eps, J, h):
    """Longest step: 0.9 of the way to Sigma, and one time of growth, which a longer step would damp.

    The eigenvalues are asked for only if a step h could be too long for them.
    """
    inward = -(y[0] * rate[0] + y[1] * rate[1])
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


@njit(cache=True, nogil=True, error_model="numpy")
def _sizes(y, n, eps, floor, size):
    for i in range(2, n):
        size[i] = abs(y[i]) + floor
    size[0] = size[1] = math.sqrt(y[0] * y[0] + y[1] * y[1] + eps * eps)


@njit(cache=True, nogil=True, error_model="numpy")
def _guess(before, first, ratio, nodes, y, n, Z):
    """Continue the last step's polynomial into a step `ratio` times as long, if that is not too far; say whether."""
    guessed = ratio <= FARTHEST
    for a in range(STAGES):
        for i in range(n):
            Z[a, i] = 0.0
            if guessed:
                u = 1.0 + ratio * nodes[a]
                total = 0.0
                for k in range(STAGES - 1, -1, -1):
                    total = (total + before[i, k]) * u
                Z[a, i] = total + (first[i] - y[i])
    return guessed


@njit(cache=True, nogil=True, error_model="numpy")
def _matrices(A, gamma, h, J, size, n, big, small):
    """Write I - h A x J in units of size, and the small matrix of the error estimate."""
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


@njit(cache=True, nogil=True, error_model="numpy")
def _converged(change, last, iteration, enough):
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


@njit(cache=True, nogil=True, error_model="numpy")
def _stages(fields, P, S, y, clock, n, eps, line, A, h, size, enough, big, pivots, Z, rates, residual, trial):
    """Solve for the stages Z by simplified Newton iterations; say whether they have converged."""
    last = math.inf
    for iteration in range(ITERATIONS):
        for a in range(STAGES):
            for i in range(n):
                trial[i] = y[i] + Z[a, i]
            _rate(trial, n, eps, line, fields, S, P, rates[a])
        clock[3] += STAGES
        for a in range(STAGES):
            for i in range(n):
                total = 0.0
                for b in range(STAGES):
                    total += A[a, b] * rates[b, i]
                residual[a * n + i] = (h * total - Z[a, i]) / size[i]
        _solve(big, pivots, residual, STAGES * n)
        change = 0.0
        for a in range(STAGES * n):
            change = max(change, abs(residual[a])) if residual[a] == residual[a] else math.inf
        if not change < math.inf:
            return False
        for a in range(STAGES):
            for i in range(n):
                Z[a, i] += residual[a * n + i] * size[i]
        told = _converged(change, last, iteration, enough)
        if told != 0:
            return told > 0
        last = change
    return False


@njit(cache=True, nogil=True, error_model="numpy")
def _error(rate, h, gamma, weights, Z, n, size, end_size, rtol, small, pivots, error):
    """Write the estimated error in units of size, from a rate where the step begins; return its norm, 1 for rtol."""
    for i in range(n):
        total = gamma * h * rate[i]
        for a in range(STAGES):
            total += weights[a] * Z[a, i]
        error[i] = total / size[i]
    _solve(small, pivots, error, n)
    norm = 0.0
    for i in range(n):
        norm = max(norm, abs(error[i]) * size[i] / min(size[i], end_size[i]) / rtol)
        norm = norm if error[i] == error[i] else math.inf
    return norm


@njit(cache=True, nogil=True, error_model="numpy")
def _keep(fit, Z, y, n, first, before, polynomial, end):
    """Move the state over a step that is accepted, and keep its polynomial."""
    for i in range(n):
        first[i] = y[i]
        for k in range(STAGES):
            total = 0.0
            for a in range(STAGES):
                total += fit[k, a] * Z[a, i]
            before[i, k] = total
            polynomial[i, k] = total
        y[i] += Z[STAGES - 1, i]
        end[i] = y[i]


@njit(cache=True, nogil=True, error_model="numpy")
def _go_on(clock, control, h, y, n):
    """Let the time go on, with what its rounding loses; say whether the state has blown up."""
    total = h + clock[1]
    ahead = clock[0] + total
    clock[1] = total - (ahead - clock[0])
    extent = 0.0
    for i in range(n):
        extent = max(extent, abs(y[i]))
    if ahead > clock[0]:
        control[EXTENT] = max(control[EXTENT], extent)
    clock[0] = ahead
    return extent > LARGEST or extent > GROWN * control[EXTENT]


@njit(cache=True, nogil=True, error_model="numpy")
def follow(
    fields,
    P,
    y,
    clock,
    control,
    n,
    eps,
    line,
    rtol,
    floor,
    A,
    nodes,
    gamma,
    weights,
    fit,
    starts,
    lengths,
    ends,
    polynomials,
):
    """Step until the time is over, the steps are used up, or the arrays are full.

    Parameters
    ----------
    fields : int64 (3,)
        Addresses: value, slopes, gain.
    P : float64
        Parameters of all three.
    y : (n,)
        The state, which moves on.
    clock : (4,)
        Time, what its rounding lost, the end of the time, evaluations so far.
    control : (6,)
        NEXT: the next step. REFINED: 1 where its error may be estimated anew. WARY: careful steps left. LEFT: steps
        left to try. TRIED: how many were. EXTENT: the largest size of the state so far.
    n, eps, rtol, floor
        As in `numerics.radau`, floor = atol/rtol.
    line : (3,)
        The invariant line that is kept to, and 1; or 0 in the last place.
    A, nodes, gamma, weights, fit
        The tableau.
    starts, lengths (k,), ends (k, n), polynomials (k, n, 5)
        Filled with steps.

    Returns
    -------
    (int, int)
        Why it stopped, and how many steps were filled in.
    """
    S = np.zeros(SLOPES + 8 * 12)
    rate, size, end_size, J = np.zeros(n), np.zeros(n), np.zeros(n), np.zeros((n, n))
    N = STAGES * n
    big, small = np.zeros((N, N)), np.zeros((n, n))
    big_pivots, small_pivots = np.zeros(N, np.int64), np.zeros(n, np.int64)
    Z, rates, residual = np.zeros((STAGES, n)), np.zeros((STAGES, n)), np.zeros(N)
    trial, error, filtered = np.zeros(n), np.zeros(n), np.zeros(n)
    before, first, before_h = np.zeros((n, STAGES)), np.zeros(n), 0.0  # the last step
    enough = max(1e-2 * rtol, 1e-14)
    filled = 0
    fresh = True
    bound = math.inf
    while clock[2] - clock[0] - clock[1] > 0.0:
        if fresh:
            _rate(y, n, eps, line, fields, S, P, rate)
            _jacobian(y, n, eps, fields, S, P, J)
            clock[3] += 1.0
            _sizes(y, n, eps, floor, size)
            bound = _bound(y, rate, n, eps, J, control[NEXT])
            fresh = False
        if filled == len(starts):
            return FULL, filled
        remaining = clock[2] - clock[0] - clock[1]
        h = min(control[NEXT], bound)
        if h >= 0.99 * remaining:
            h = remaining
        elif h > 0.5 * remaining:
            h = 0.5 * remaining
        control[LEFT] -= 1.0
        control[TRIED] += 1.0
        if control[LEFT] < 0.0:
            return LIMIT, filled
        if not h > 1e-290:
            return SHORT, filled
        _matrices(A, gamma, h, J, size, n, big, small)
        guessed = _guess(before, first, h / before_h if before_h > 0.0 else math.inf, nodes, y, n, Z)
        factor = FAILED
        accepted = False
        if _factor(big, big_pivots, N) and _factor(small, small_pivots, n):
            solved = _stages(
                fields, P, S, y, clock, n, eps, line, A, h, size, enough, big, big_pivots, Z, rates, residual, trial
            )
            factor = 1.0 if guessed else FAILED
            if solved:
                for i in range(n):
                    trial[i] = y[i] + Z[STAGES - 1, i]
                _sizes(trial, n, eps, floor, end_size)
                norm = _error(rate, h, gamma, weights, Z, n, size, end_size, rtol, small, small_pivots, error)
                if norm > 1.0 and control[REFINED] > 0.0:
                    for i in range(n):
                        trial[i] = y[i] + size[i] * error[i]
                    _rate(trial, n, eps, line, fields, S, P, filtered)
                    clock[3] += 1.0
                    again = _error(filtered, h, gamma, weights, Z, n, size, end_size, rtol, small, small_pivots, error)
                    norm = min(norm, again)
                if not norm < math.inf:
                    factor = SHRINK
                else:
                    factor = min(max(SAFETY * max(norm, 1e-12) ** (-1.0 / (STAGES + 1)), SHRINK), GROW)
                    accepted = norm <= 1.0
                    if not accepted:
                        factor = min(factor, 0.8)
        if not accepted:
            before_h = 0.0
            control[NEXT] = h * factor
            if factor == FAILED:
                control[WARY] = CAREFUL
            control[REFINED] = 1.0
            continue
        starts[filled], lengths[filled] = clock[0], h
        _keep(fit, Z, y, n, first, before, polynomials[filled], ends[filled])
        before_h = h
        filled += 1
        if _go_on(clock, control, h, y, n):
            return BLOWN_UP, filled - 1
        most = GROW
        if control[REFINED] > 0.0 and control[TRIED] > 1.0:
            most = 1.0
        elif control[WARY] > 0.0:
            most = GROWTH_AFTER_FAILURE
        control[NEXT], control[REFINED], control[WARY] = h * min(factor, most), 0.0, max(control[WARY] - 1.0, 0.0)
        fresh = True
    return FINISHED, filled
