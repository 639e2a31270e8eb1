"""Prove how many limit cycles there are: by a theorem, or by a certificate that the independent checker accepts."""

from __future__ import annotations

import json
import math

import numpy as np

from ...arrays import Array
from ...layer_problem.problem import LayerProblem
from ...psi.kernel import VECTOR
from ...words import say
from .check import check, chords, loop_is_crossed
from .result import Proof, covers
from .search import LEAST_MARGIN, ScaledLayerProblem, best_function, loops, write_certificate

# Of Psi the degree, and weights (k, mu), in the order in which they are tried
ATTEMPTS = (
    (6, ((-1.0, 1.0),)),
    (10, ((-1.0, 1.5), (-1.0, 1.0), (-2.0, 1.0))),
    (14, ((-1.0, 1.5), (-1.0, 1.0), (-2.0, 1.0), (-0.5, 1.75))),
    (20, ((-1.0, 1.5), (-2.0, 1.0))),
)
NO_POINTS = np.zeros((0, 2))


def prove_count(problem: LayerProblem, cycles: list[Array], forbidden: str | None) -> Proof:
    """Prove that a layer problem has just these limit cycles, as far as that can be done.

    Parameters
    ----------
    problem : LayerProblem
    cycles : list of ndarray (m, 2)
        Closed polylines in the projected disc, from the inside to the outside.
    forbidden : str or None
        Why a theorem forbids cycles.
    """
    nothing = tuple(False for _ in cycles)
    if problem.at.affine is None:
        return Proof(False, nothing, say("proofs e-linear only"))
    if forbidden is not None:
        return Proof(True, (), forbidden)
    if not covers(problem.psi):
        return Proof(False, nothing, say("proof not for this Psi"))
    system, why = ScaledLayerProblem(problem), "proof finds no function"
    loop = _loop(problem, system, cycles) if cycles else NO_POINTS
    for degree, weights in ATTEMPTS:
        for k, mu in weights:
            margin, function = best_function(system, degree, k, mu)
            if margin < LEAST_MARGIN:
                continue
            certificate = write_certificate(problem, system, function, k, mu, loop)
            if check(certificate) == (len(cycles), True):
                return Proof(True, tuple(True for _ in cycles), say("proved by a certificate"), json.dumps(certificate))
            why = "proof refused"
    return Proof(False, nothing, say(why))


def _loop(problem: LayerProblem, system: ScaledLayerProblem, cycles: list[Array]) -> Array:
    """Return a polygon beyond the last cycle that all orbits cross to one side, if there are limit directions."""
    t = np.linspace(0.0, math.tau, 2001)
    e = np.array([np.cos(t), np.sin(t)])
    U = system.A @ e + system.f[:, None]
    turning = e[0] * U[1] - e[1] * U[0]
    if turning.min() * turning.max() > 0.0:
        return NO_POINTS
    cycle, stable = cycles[-1], (system.trace > 0.0) == (len(cycles) % 2 == 1)  # they are so in turn, from C on
    x = (cycle / np.sqrt(1.0 - (cycle**2).sum(axis=1))[:, None]).T
    s = (x**2).sum(axis=0)
    x = x / np.sqrt(s + problem.psi.kernel.value(VECTOR, s))
    numbers, lines = np.column_stack([system.A, system.f]), chords(problem.psi.family, problem.psi.parameter)
    center = -np.linalg.solve(system.A, system.f)
    for loop in loops(system, x.T, stable):
        if loop_is_crossed(loop, center, numbers, lines, 1 if stable else -1)[1]:
            return loop
    return NO_POINTS
