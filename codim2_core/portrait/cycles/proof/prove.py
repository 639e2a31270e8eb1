"""Look for a certificate of a portrait that the independent checker accepts."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from ....results.arrays import Array
from ....results.words import say
from ....systems.psi.kernel import VECTOR
from ...layer_problem.problem import LayerProblem
from .certificate import write_certificate, write_head
from .check import Field, check, chords, loop_is_crossed
from .result import FoundCycle, Proof, covers
from .search import LEAST_MARGIN, ScaledLayerProblem, best_function, loops

# Of Psi the degree, and weights (k, mu), in the order in which they are tried
ATTEMPTS = (
    (6, ((-1.0, 1.0),)),
    (10, ((-1.0, 1.5), (-1.0, 1.0), (-2.0, 1.0))),
    (14, ((-1.0, 1.5), (-1.0, 1.0), (-2.0, 1.0), (-0.5, 1.75))),
    (20, ((-1.0, 1.5), (-2.0, 1.0))),
)
NO_POINTS = np.zeros((0, 2))


def prove_layer_problem(problem: LayerProblem, cycles: Sequence[FoundCycle]) -> Proof:
    """Look for a certificate of a portrait: of its limit directions, critical sets and just these limit cycles."""
    nothing, given = tuple(False for _ in cycles), problem.at.polynomials
    if given is None:
        return Proof(False, nothing, say("proofs of polynomials only"))
    if not covers(problem.psi):
        return Proof(False, nothing, say("proof not for this Psi"))
    system, why = ScaledLayerProblem(problem, given, cycles), "proof finds no function"
    head = write_head(problem, system, range(len(system.critical)))
    found = check(head)
    if found["critical sets"] is None:
        return Proof(False, nothing, say("portrait degenerate"))
    shown = (
        None if found["limit directions"] is None else tuple(found["limit directions"]),
        tuple(found["critical sets"]),
    )
    if found["limit cycles"] == len(cycles):
        return Proof(True, (), say("nothing to surround"), json.dumps(head), *shown)
    if any(cycle.kind == "semistable" for cycle in cycles):  # such a function shows hyperbolic cycles only
        return Proof(False, nothing, say(why), None, *shown)
    for certificate in _certificates(problem, system, cycles):
        if check(certificate)["limit cycles"] == len(cycles):
            reason = say("proved by a certificate")
            return Proof(True, tuple(True for _ in cycles), reason, json.dumps(certificate), *shown)
        why = "proof refused"
    return Proof(False, nothing, say(why), None, *shown)


def _certificates(
    problem: LayerProblem, system: ScaledLayerProblem, cycles: Sequence[FoundCycle]
) -> Iterator[dict[str, Any]]:
    loop = _loop(problem, system, cycles) if cycles else NO_POINTS
    for degree, weights in ATTEMPTS:
        for k, mu in weights:
            margin, function = best_function(system, degree, k, mu)
            if margin >= LEAST_MARGIN:
                yield write_certificate(problem, system, function, k, mu, loop)


def _loop(problem: LayerProblem, system: ScaledLayerProblem, cycles: Sequence[FoundCycle]) -> Array:
    """Return a polygon beyond the last cycle that all orbits cross to one side, if there are limit directions."""
    t = np.linspace(0.0, math.tau, 2001)
    e = np.array([np.cos(t), np.sin(t)])
    U = system.field(e)
    turning = e[0] * U[1] - e[1] * U[0]
    if turning.min() * turning.max() > 0.0:
        return NO_POINTS
    cycle, stable = cycles[-1].points @ system.back.T, cycles[-1].stable
    x = (cycle / np.sqrt(1.0 - (cycle**2).sum(axis=1))[:, None]).T
    s = (x**2).sum(axis=0)
    x = x / np.sqrt(s + problem.psi.kernel.value(VECTOR, s))
    head = write_head(problem, system, ())
    field, lines = Field(head["U"]), chords(problem.psi.family, problem.psi.parameter)
    center = system.chart[:2, 2] / system.chart[2, 2]
    for loop in loops(system, x.T, stable):
        if loop_is_crossed(loop, center, field, lines, 1 if stable else -1)[1]:
            return loop
    return NO_POINTS
