"""Heteroclinic cycles through the equator: where limit cycles of the layer problem die when the equator has equilibria.

There is at most one critical set (thm:lineps1), and a cycle surrounds it, so the saddles on a loop are half-saddles of
the equator (thm:geneps0(b)). A loop goes along the equator from P to the neighbour Q, with Theta of the sign of b
between them, and back to P over the hemisphere:

    P:  lambda_rho > 0, lambda_theta > 0 (orbits come down to it);    Q:  lambda_rho < 0, lambda_theta < 0.

The arc of the equator is always there; the orbit from Q to P is a connection of codimension one. On a ray of
`search` that ends on the equator outside the arc, the first crossing of Q's branch and the last one of P's
branch tell how far they miss each other.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..layer_problem.critical import critical_sets
from ..layer_problem.equator import equator_equilibria
from ..layer_problem.location import locate
from ..orbits.departures import departures
from ..psi.function import Psi
from ..systems.coefficients import Coefficients
from .section import Section, rays

RTOL = 1e-12
TURN = 2.0 * math.pi


@dataclass(frozen=True)
class Loop:
    """The arc of the equator of a possible loop.

    Attributes
    ----------
    source, sink : float
        Angles of P and Q.
    ratio : float
        Product of both saddles' ratios of the eigenvalue entered by to that left by: above 1 the loop attracts.
    ray : int
        The ray on which the gap is measured.
    """

    source: float
    sink: float
    ratio: float
    ray: int


def loops(coefficients: Coefficients) -> tuple[Loop, ...]:
    """Arcs of the equator from a half-saddle that orbits enter to one that they leave, in the sense of b.

    Parameters
    ----------
    coefficients : Coefficients
        With a d < 0 < det A and a critical set.
    """
    equator = equator_equilibria(coefficients)
    count, sense = len(equator), 1 if coefficients.b > 0.0 else -1
    location = locate(coefficients)
    if location.e is None or (equator.multiplicity > 1).any():
        return ()
    found = rays(coefficients.a, coefficients.d, location.e, location.complement)
    ends = [math.atan2(location.e[1] + reach * u[1], location.e[0] + reach * u[0]) for reach, _, u in found]
    arcs = []
    for j in range(count):
        i = (j + sense) % count
        rho, theta = equator.lambda_rho, equator.lambda_theta
        if not (rho[j] > 0.0 and theta[j] > 0.0 and rho[i] < 0.0):  # theta[i] < 0 then: simple zeros alternate
            continue
        P, Q = float(equator.theta[j]), float(equator.theta[i])
        width = (sense * (Q - P)) % TURN
        outside = [k for k in range(4) if (sense * (ends[k] - P)) % TURN > width]
        if outside:
            ratio = float(rho[j] / theta[j] * theta[i] / rho[i])
            arcs.append(Loop(P, Q, ratio, max(outside, key=lambda k: found[k][0])))
    return tuple(arcs)


def gap(coefficients: Coefficients, psi: Psi, loop: Loop, rtol: float = RTOL) -> float:
    """By how much the branches of Q and P miss each other on the loop's ray, in ``ln u.(x2 - C)``.

    Parameters
    ----------
    coefficients : Coefficients
    psi : Psi
    loop : Loop
        Of the same coefficients.
    rtol : float

    Returns
    -------
    float
        Negative where the branch of Q passes inside that of P, and so spirals inwards; positive where it goes to the
        equator. Infinite where one of them does not reach the ray. NaN where the sign is not decided either.
    """
    section = Section(coefficients, psi, critical_sets(coefficients, psi)[0], loop.ray)
    places = []
    for angle, backward in ((loop.sink, False), (loop.source, True)):
        start = departures(coefficients, psi, [angle], rtol, backward)
        ends, _, codes, _ = section.turn(start, rtol, backward, elsewhere=True)
        module, _ = section.kernel
        values = {module.INWARD: -math.inf, module.OUTWARD: math.inf, module.UNDECIDED: math.nan}
        places.append(values.get(int(codes[0]), float(section.coordinate(ends)[0])))
    leaving, entering = places
    if math.isinf(leaving) and math.isinf(entering):
        return math.nan
    return float(np.float64(leaving) - np.float64(entering))
