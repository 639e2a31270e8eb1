"""Radau IIA of order 9 (five stages) for ``Y' = F(Y)``: one implicit method for slip, entry, sliding and exit.

Near Sigma the vector field of (2.7) changes over distances of eps (or of rho itself in the nonsmooth system), while z
moves over distances of 1: stiff while sliding, and smooth while slipping. The method is L-stable, so that steps are as
long as the solution is smooth. Its polynomial through the stages is the dense output.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ..results.arrays import Array
from ..results.words import say

GROWTH_STEPS = 100.0  # of the shortest: what grows by its own size within these has no later time
RATE = 1e-12  # of the time: what grows by its own size in less ends there
STAGES = 5
ITERATIONS = 10  # of Newton's method in one step
STEP_SAFETY, MAX_SHRINKAGE, MAX_GROWTH, FAILED_SHRINKAGE = 0.9, 0.2, 8.0, 0.3
CAREFUL, GROWTH_AFTER_FAILURE = 6, 1.2  # so many steps after Newton's method failed, a step grows by so much at most


class Tableau(NamedTuple):
    """Coefficients of the method."""

    nodes: Array  # (5,)
    A: Array  # (5, 5)
    gamma: float  # inverse of the real eigenvalue of A^-1
    # (5,) Weights of the stage increments Z in the error estimate ``gamma h F(Y0) + error . Z``, of order 5
    error: Array
    fit: Array  # (5, 5) From Z to the coefficients of u, ..., u^5 of the polynomial through Y0 and the stages


@lru_cache(maxsize=1)
def tableau() -> Tableau:
    """Coefficients, from the zeros of the Jacobi polynomial P_4^(1,0)."""
    k = np.arange(STAGES)
    # the zeros are the eigenvalues of the matrix of the polynomials' recurrence (Golub and Welsch 1969)
    off_diagonal = np.diag(np.sqrt(k[1:-1] * (k[1:-1] + 1.0)) / (2.0 * k[1:-1] + 1.0), 1)
    zeros = np.linalg.eigvalsh(
        np.diag(-1.0 / ((2.0 * k[:-1] + 1.0) * (2.0 * k[:-1] + 3.0))) + off_diagonal + off_diagonal.T
    )
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


class MotionEndError(Exception):
    """A motion ends before its time; the message says why."""

    status = "STEP_LIMIT"  # the name of how


class TooManyStepsError(MotionEndError):
    """The step limit is reached."""


class StepsTooShortError(TooManyStepsError):
    """Steps became shorter than the shortest allowed: the solution ends, or its formulas are undefined from here on."""


class BlowUpError(TooManyStepsError):
    """The motion grows beyond all bounds; the message says near which time."""

    status = "BLOW_UP"


def too_short(state: Array, rate: Array, t: float, shortest: float = 0.0) -> TooManyStepsError:
    """Say why steps became too short at a state: it blows up, or its formulas end."""
    if (np.abs(rate) * max(RATE * abs(t), GROWTH_STEPS * shortest) > 1.0 + np.abs(state)).any():
        return BlowUpError(say("blow-up time", t=t))
    return StepsTooShortError(say("undefined from", t=t))
