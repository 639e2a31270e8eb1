"""Arcs of the equator along which a heteroclinic cycle through the equator may go.

Such a loop goes along the equator from a half-saddle P to the next one, Q (Theorem 3.1(b)), and back to P over the
hemisphere:

    P:  lambda_rho > 0, lambda_theta > 0 (orbits come down to it);    Q:  lambda_rho < 0, lambda_theta < 0.

The arc is always there; the orbit from Q to P is a connection of codimension one, see `heteroclinic_cycle`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...results.arrays import Array
from ..layer_problem.problem import LayerProblem


@dataclass(frozen=True)
class HeteroclinicArc:
    """The arc of the equator of a possible loop."""

    source: float  # angles of P and Q
    sink: float
    sense: int  # +1 if Q follows P anticlockwise, else -1: the sense in which the loop turns
    # product of both saddles' ratios of the eigenvalue entered by to that left by: above 1 the loop attracts
    ratio: float

    def distance(self, other: HeteroclinicArc) -> float:
        """Return how far the ends of two arcs are apart."""
        gaps = (self.sink - other.sink, self.source - other.source)
        return sum(abs(math.remainder(gap, math.tau)) for gap in gaps)

    def spans(self, theta: Array) -> NDArray[np.bool_]:
        """Whether angles (k,) lie on it."""
        width = (self.sense * (self.sink - self.source)) % math.tau
        return (self.sense * (theta - self.source)) % math.tau < width


def heteroclinic_arcs(problem: LayerProblem) -> tuple[HeteroclinicArc, ...]:
    """Return the arcs from a half-saddle that orbits enter to the next one that they leave."""
    equator = problem.equator
    if (equator.multiplicity > 1).any():
        return ()
    angles, rho, theta = equator.theta.tolist(), equator.lambda_rho.tolist(), equator.lambda_theta.tolist()
    found = []
    for j in range(len(angles)):
        for sense in (1, -1):
            i = (j + sense) % len(angles)
            if rho[j] > 0.0 < theta[j] and rho[i] < 0.0 > theta[i]:
                ratio = rho[j] / theta[j] * theta[i] / rho[i]
                found.append(HeteroclinicArc(angles[j], angles[i], sense, ratio))
    return tuple(found)
