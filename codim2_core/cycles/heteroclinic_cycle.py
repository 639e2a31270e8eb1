"""Heteroclinic cycles through the equator: where limit cycles of the layer problem die when the equator has equilibria.

There is at most one critical set (thm:lineps1), and a cycle surrounds it, so the saddles on a loop are half-saddles of
the equator (thm:geneps0(b)). A loop goes along the equator from P to the neighbour Q, with Theta of the sign of b
between them, and back to P over the hemisphere:

    P:  lambda_rho > 0, lambda_theta > 0 (orbits come down to it);    Q:  lambda_rho < 0, lambda_theta < 0.

The arc of the equator is always there; the orbit from Q to P is a connection of codimension one. On a ray of
`global_section` that ends on the equator outside the arc, the first crossing of Q's branch and the last one of P's
branch tell how far they miss each other.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..layer_problem.critical import critical_sets
from ..layer_problem.equator import equator_equilibria
from ..layer_problem.location import locate
from ..orbits.departures import departures
from ..psi.function import Psi
from ..systems.coefficients import Coefficients
from .equator_pull import EQUATOR_CAPTURE_HEIGHT
from .global_section import INNER_CAPTURE_RATIO, MAX_STEPS, MAX_TURN_TIME, Array, Section, rays

RTOL = 1e-12


@dataclass(frozen=True)
class HeteroclinicCycle:
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


def heteroclinic_cycles(coefficients: Coefficients) -> tuple[HeteroclinicCycle, ...]:
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
        width = (sense * (Q - P)) % math.tau
        outside = [k for k in range(4) if (sense * (ends[k] - P)) % math.tau > width]
        if outside:
            ratio = float(rho[j] / theta[j] * theta[i] / rho[i])
            arcs.append(HeteroclinicCycle(P, Q, ratio, max(outside, key=lambda k: found[k][0])))
    return tuple(arcs)


def splitting(coefficients: Coefficients, psi: Psi, loop: HeteroclinicCycle, rtol: float = RTOL) -> float:
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
    return gaps([(coefficients, psi, loop)], rtol)[0]


def gaps(asked: Sequence[tuple[Coefficients, Psi, HeteroclinicCycle]], rtol: float = RTOL) -> list[float]:
    """Find the gaps of several systems side by side; see `splitting`.

    Parameters
    ----------
    asked : sequence of (Coefficients, Psi, Loop)
        The Psi are of one family.
    rtol : float
    """
    if not asked:
        return []
    sections = [Section(q, psi, critical_sets(q, psi)[0], loop.ray) for q, psi, loop in asked]
    leaving = _section_crossings(sections, asked, [loop.sink for *_, loop in asked], rtol, False)
    entering = _section_crossings(sections, asked, [loop.source for *_, loop in asked], rtol, True)
    return [
        math.nan if math.isinf(out) and math.isinf(back) else out - back
        for out, back in zip(leaving, entering, strict=True)
    ]


def _section_crossings(
    sections: Sequence[Section],
    asked: Sequence[tuple[Coefficients, Psi, HeteroclinicCycle]],
    angles: Sequence[float],
    rtol: float,
    backward: bool,
) -> list[float]:
    """Return where the branch of a limit direction first crosses its section, in each system."""
    starts = [departures(q, psi, [angle], rtol, backward) for (q, psi, _), angle in zip(asked, angles, strict=True)]
    module, _ = sections[0].kernel
    values = {module.TO_CRITICAL_SET: -math.inf, module.OUTWARD: math.inf, module.NO_RETURN_YET: math.nan}
    found = []
    for section, start, end, code in zip(
        sections, starts, *_follow_to_sections(sections, starts, rtol, backward), strict=True
    ):
        if code == module.OUTWARD:  # perhaps only for a while
            ends, _, codes, _ = section.turn(start, rtol, backward, elsewhere=True)
            end, code = ends[0], int(codes[0])
        found.append(values.get(code, float(section.coordinate(end[None])[0])))
    return found


def _follow_to_sections(
    sections: Sequence[Section], starts: Sequence[Array], rtol: float, backward: bool
) -> tuple[Array, list[int]]:
    """Follow an orbit to each section: where it ends, and the code of `global_section_kernel.returns`."""
    from ..stepping.fields import field_of_each

    psi = sections[0].psi
    states, count = np.concatenate(starts), len(sections)
    field = field_of_each(psi, all(section.psi.parameter == psi.parameter for section in sections))
    centres = np.array([section.critical.x2 for section in sections])
    away = np.hypot(*(states[:, :2] / states[:, 2:] - centres).T)
    near = INNER_CAPTURE_RATIO * np.minimum([section.inner for section in sections], away)
    sense = np.array([-section.plane[1] if backward else section.plane[1] for section in sections])
    ends, _, codes, _ = sections[0].kernel[0].returns(
        states, np.array([section.field_parameters(backward) for section in sections]), field.address,
        np.array([section.u for section in sections]), centres, sense, near, np.full(count, EQUATOR_CAPTURE_HEIGHT),
        MAX_TURN_TIME, np.array([rtol]), MAX_STEPS, 0, True,
    )  # fmt: skip
    return ends, codes.tolist()
