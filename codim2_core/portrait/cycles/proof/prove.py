"""Look for a certificate of a portrait that the independent checker accepts."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev

from ....results.arrays import Array
from ....results.words import say
from ....systems.psi.families.record import VECTOR
from ...layer_problem.problem import LayerProblem
from .check import Field, check, chords, loop_is_crossed
from .result import FoundCycle, Proof, covers
from .search import LEAST_MARGIN, ScaledLayerProblem, best_function, loops


def write_certificate(
    problem: LayerProblem, system: ScaledLayerProblem, function: Array, k: float, mu: float, loop: Array
) -> dict[str, Any]:
    """Write a certificate: numbers as they were given, not rounded."""
    order, ways = _ways(system.starts, function)
    return {
        **write_head(problem, system, order),
        "starts": [system.starts[i].tolist() for i in order],
        "ways": ways,
        "weight": [k, mu],
        "chart": system.chart.tolist(),
        "function": function.tolist(),
        "loop": loop.tolist(),
    }


def write_head(problem: LayerProblem, system: ScaledLayerProblem, order: Sequence[int]) -> dict[str, Any]:
    """Write a certificate of a portrait with no critical set that a closed orbit may surround."""
    rows = [
        [[U.get((i, j), 0) for j in range(system.degree + 1 - i)] for i in range(system.degree + 1)]
        for U in system.given
    ]
    return {
        "U": [[[float(v) if float(v) == v else str(v) for v in row] for row in U] for U in rows],
        "psi": [problem.psi.family, problem.psi.parameter],
        "critical": [system.critical[i].tolist() for i in order],
    }


def _ways(starts: list[Array], function: Array) -> tuple[list[int], list[int | list[int]]]:
    """Return the critical sets in order, and from each a way to the edge or to one before, with few changes of sign."""
    edge = np.arange(-8, 9)
    ends = np.array([(p, q) for p in edge for q in edge if max(abs(p), abs(q)) == 8])
    order: list[int] = []
    ways: list[int | list[int]] = []

    def changes(start: Array, to: Array) -> Any:
        t = np.linspace(0.0, 1.0, 201)[:, None]
        x, y = start[:, None, None] * (1.0 - t) + to.T[:, None, :] * t
        signs = chebyshev.chebval2d(x, y, function) > 0.0
        return (signs[1:] != signs[:-1]).sum(axis=0)

    left = dict(enumerate(starts))
    while left:
        best = {}
        for i, start in left.items():
            to = [*ends / 8.0, *(starts[j] for j in order)]
            seen = changes(start, np.array(to))
            k = int(seen.argmin())
            best[i] = int(seen[k]), ends[k].tolist() if k < len(ends) else k - len(ends)
        i = min(best, key=lambda i: best[i][0])
        order.append(i)
        ways.append(best[i][1])
        del left[i]
    return order, ways


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
