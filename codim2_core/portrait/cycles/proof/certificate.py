"""A certificate as it is written: numbers, and ways along which a function of Dulac and Cherkas keeps its sign."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev

from ....results.arrays import Array
from ...layer_problem.problem import LayerProblem
from .search import ScaledLayerProblem


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
