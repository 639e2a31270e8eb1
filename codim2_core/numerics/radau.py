"""Radau IIA of order 9 (five stages) for ``Y' = F(Y)``: one implicit method for slip, entry, sliding and exit.

Near Sigma the vector field of eq:vf changes over distances of eps (or of rho itself in the nonsmooth system), while z
moves over distances of 1: stiff while sliding, and smooth while slipping. The method is L-stable, so that steps are as
long as the solution is smooth. Its polynomial through the stages is the dense output.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ..arrays import Array

STAGES = 5
ITERATIONS = 10  # of Newton's method in one step
STEP_SAFETY, MAX_SHRINKAGE, MAX_GROWTH, FAILED_SHRINKAGE = 0.9, 0.2, 8.0, 0.3
CAREFUL, GROWTH_AFTER_FAILURE = 6, 1.2  # so many steps after Newton's method failed, a step grows by so much at most


class Tableau(NamedTuple):
    """Coefficients of the method.

    Attributes
    ----------
    nodes : ndarray (5,)
    A : ndarray (5, 5)
    gamma : float
        Inverse of the real eigenvalue of A^-1.
    error : ndarray (5,)
        Weights of the stage increments Z in the error estimate ``gamma h F(Y0) + error . Z``, of order 5.
    fit : ndarray (5, 5)
        From Z to the coefficients of u, ..., u^5 of the polynomial through Y0 and the stages.
    """

    nodes: Array
    A: Array
    gamma: float
    error: Array
    fit: Array


@lru_cache(maxsize=1)
def tableau() -> Tableau:
    """Coefficients, from the zeros of the Jacobi polynomial P_4^(1,0)."""
    k = np.arange(STAGES)
    # the zeros are the eigenvalues of the matrix of the polynomials' recurrence (Golub and Welsch 1969)
    beside = np.diag(np.sqrt(k[1:-1] * (k[1:-1] + 1.0)) / (2.0 * k[1:-1] + 1.0), 1)
    zeros = np.linalg.eigvalsh(np.diag(-1.0 / ((2.0 * k[:-1] + 1.0) * (2.0 * k[:-1] + 3.0))) + beside + beside.T)
    nodes = np.append(0.5 * (zeros + 1.0), 1.0)
    powers = nodes[:, None] ** k
    A = np.asarray(np.linalg.solve(powers.T, (nodes[:, None] ** (k + 1) / (k + 1)).T).T, float)
    inverse = np.linalg.inv(A)
    values = np.asarray(np.linalg.eigvals(inverse), np.complex128)
    gamma = 1.0 / float(values[np.argmin(np.abs(values.imag))].real)
    target = 1.0 / (k + 1.0)
    target[0] -= gamma
    embedded = np.linalg.solve(powers.T, target)
    fit = np.linalg.inv(powers * nodes[:, None])
    return Tableau(nodes, A, gamma, (embedded - A[-1]) @ inverse, fit)


class Step(NamedTuple):
    """One step: ``Y(start + u h) = first + polynomial . (u, ..., u^d)``, 0 <= u <= 1; d is 5 for this method."""

    start: float
    h: float
    first: Array
    last: Array
    polynomial: Array

    @property
    def end(self) -> float:
        """Time at the end of the step."""
        return self.start + self.h

    def at(self, u: float) -> Array:
        """State at the fraction u of the step."""
        return self.first + self.polynomial @ (u ** np.arange(1, self.polynomial.shape[1] + 1))


def truncate_step(step: Step, u: float) -> Step:
    """Return the first part of a step, up to its fraction u."""
    powers = u ** np.arange(1, step.polynomial.shape[1] + 1)
    return Step(step.start, u * step.h, step.first, step.at(u), step.polynomial * powers)


@dataclass(frozen=True)
class Problem:
    """An initial value problem.

    Attributes
    ----------
    F : callable
        State (n,) to its rate (n,); NaN where undefined: the step is then tried shorter.
    J : callable
        State to the Jacobian (n, n).
    scale : callable
        State to the size (n,) by which errors are measured; times rtol it is the error allowed in a step.
    limit : callable
        (state, rate, Jacobian) to the longest step allowed from there.
    """

    F: Callable[[Array], Array]
    J: Callable[[Array], Array]
    scale: Callable[[Array], Array]
    limit: Callable[[Array, Array, Array], float]


class TooManyStepsError(Exception):
    """The step limit is reached."""


class StepsTooShortError(TooManyStepsError):
    """Steps became shorter than the shortest allowed: the solution ends, or its formulas are undefined from here on."""


def steps(
    problem: Problem,
    t_start: float,
    t_end: float,
    first: Array,
    rtol: float,
    h: float,
    most: int,
    shortest: float = 1e-290,
) -> Iterator[Step]:
    """Step from t_start to t_end; the field does not depend on time.

    Parameters
    ----------
    problem : Problem
    t_start, t_end : float
    first : ndarray (n,)
    rtol : float
    h : float
        First step to try.
    most : int
        Steps tried before `TooManyStepsError`.
    shortest : float
        A shorter step raises `StepsTooShortError`.

    Yields
    ------
    Step
    """
    y, t, lost = first, t_start, 0.0
    previous: Step | None = None
    eager, careful, tried = False, 0, 0
    here = _linearise(problem, y)
    while (remaining := (t_end - t) - lost) > 0.0:
        h = min(h, here.bound)
        if h >= 0.99 * remaining:
            h = remaining
        elif h > 0.5 * remaining:
            h = 0.5 * remaining
        tried += 1
        if tried > most:
            raise TooManyStepsError
        if not h > shortest:
            raise StepsTooShortError
        found, factor = _attempt(problem, here, y, h, previous, rtol, refine=not eager)
        if found is None:
            previous = None  # a prediction may have misled
            h, eager = h * factor, False
            careful = CAREFUL if factor == FAILED_SHRINKAGE else careful
            continue
        Z, polynomial = found
        step = Step(t, h, y, y + Z[-1], polynomial)
        yield step
        # Compensated: close to Sigma steps are far shorter than the spacing of doubles at t.
        total = h + lost
        ahead = t + total
        lost = total - (ahead - t)
        t, y, previous = ahead, step.last, step
        here = _linearise(problem, y)
        most_growth = 1.0 if not eager and tried > 1 else GROWTH_AFTER_FAILURE if careful else MAX_GROWTH
        h, eager, careful = h * min(factor, most_growth), True, max(careful - 1, 0)


@dataclass(frozen=True)
class _Linearised:
    """A state's rate, size, Jacobian in units of size, and the longest step allowed from it."""

    rate: Array
    size: Array
    jacobian: Array
    bound: float


def _linearise(problem: Problem, y: Array) -> _Linearised:
    with np.errstate(all="ignore"):
        rate, jacobian, size = problem.F(y), problem.J(y), problem.scale(y)
        bound = problem.limit(y, rate, jacobian)
        return _Linearised(rate, size, jacobian * size[None, :] / size[:, None], bound)


def _attempt(
    problem: Problem, here: _Linearised, y: Array, h: float, previous: Step | None, rtol: float, refine: bool
) -> tuple[tuple[Array, Array] | None, float]:
    """Try one step: (stage increments and polynomial, or None if it fails), and the factor to the next step."""
    table, n, size = tableau(), len(y), here.size
    with np.errstate(all="ignore"):
        scaled = h * here.jacobian
        kron = (table.A[:, None, :, None] * scaled[None, :, None, :]).reshape(n * STAGES, n * STAGES)
        guess = np.zeros((STAGES, n)) if previous is None else _predict_stages(previous, h, y, table.nodes)
        try:
            inverse = np.asarray(np.linalg.inv(np.eye(n * STAGES) - kron), float)
            damping = np.linalg.inv(np.eye(n) - table.gamma * scaled)
        except np.linalg.LinAlgError:
            return None, FAILED_SHRINKAGE
        Z = _solve_stages(problem.F, y, h, guess, inverse, size, rtol, table)
        if Z is None:
            return None, 1.0 if guess.any() else FAILED_SHRINKAGE
        small = np.minimum(size, problem.scale(y + Z[-1]))
        error = damping @ ((table.gamma * h * here.rate + table.error @ Z) / size)
        norm = float(np.max(np.abs(error) * size / small)) / rtol
        if norm > 1.0 and refine:  # the estimate of a stiff component is too large: filter it once more
            error = damping @ ((table.gamma * h * problem.F(y + size * error) + table.error @ Z) / size)
            again = float(np.max(np.abs(error) * size / small)) / rtol
            norm = min(norm, again) if again == again else norm
    if not norm < math.inf:
        return None, MAX_SHRINKAGE
    factor = min(max(STEP_SAFETY * max(norm, 1e-12) ** (-1.0 / (STAGES + 1)), MAX_SHRINKAGE), MAX_GROWTH)
    if norm > 1.0:
        return None, min(factor, 0.8)
    return (Z, (table.fit @ Z).T), factor


def _predict_stages(previous: Step, h: float, y: Array, nodes: Array) -> Array:
    """Stage increments that the last step's polynomial predicts."""
    ratio = h / previous.h
    if ratio > 4.0:
        return np.zeros((STAGES, len(y)))
    u = 1.0 + ratio * nodes
    ahead = (u[:, None] ** np.arange(1, STAGES + 1)) @ previous.polynomial.T
    return ahead + (previous.first - y)


def _solve_stages(
    F: Callable[[Array], Array],
    y: Array,
    h: float,
    Z: Array,
    inverse: Array,
    size: Array,
    rtol: float,
    table: Tableau,
) -> Array | None:
    """Stage increments by simplified Newton, or None if it does not converge."""
    enough = max(1e-2 * rtol, 1e-14)
    before, theta = math.inf, 1.0
    for iteration in range(ITERATIONS):
        rates = np.array([F(y + increment) for increment in Z])
        change = (inverse @ (((h * (table.A @ rates)) - Z) / size).ravel()).reshape(Z.shape)
        change_size = float(np.max(np.abs(change)))
        if not change_size < math.inf:
            return None
        Z = Z + change * size
        if iteration:
            theta = change_size / before if before > 0.0 else 0.0
            stalled = change_size <= 100.0 * enough and theta > 0.3 and iteration > 3
            if stalled:
                return Z
            hopeless = theta ** (ITERATIONS - 1 - iteration) * change_size > enough * (1.0 - theta)
            if change_size > enough and (theta >= 1.0 or (iteration > 2 and hopeless)):
                return None
            if theta < 1.0 and theta / (1.0 - theta) * change_size <= enough:
                return Z
        if change_size <= 1e-3 * enough:
            return Z
        before = change_size
    return None
