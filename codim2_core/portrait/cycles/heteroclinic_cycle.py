"""Heteroclinic cycles through the equator: where limit cycles die when the equator has equilibria.

A loop is an arc of the equator (`heteroclinic_arcs`), from P to Q, and an orbit from Q to P over the hemisphere.
On a ray that ends on the equator outside the arc, the first crossing of Q's branch and the last one of P's branch tell
how far they miss each other.
"""

from __future__ import annotations

import math

import numpy as np

from ...results.arrays import Array
from ..layer_problem.critical import CriticalSet
from ..layer_problem.problem import LayerProblem
from ..orbits.seeds import departures
from .ray_section import MAX_STEPS, HemispherePoint, HeteroclinicArc, Ray, TurnSection

RTOL = 1e-12
LOOP_STEPS = 8 * MAX_STEPS  # orbits past two half-saddles take longer than a turn


def loop_gap(
    problem: LayerProblem, foot: HemispherePoint | CriticalSet, arc: HeteroclinicArc, rtol: float = RTOL
) -> float:
    """Return the `splitting` of a loop about a point, on the ray to the middle of the equator outside its arc."""
    return splitting(Ray(problem, HemispherePoint(foot.p, foot.x2), ray_outside(foot, arc)), arc, rtol)


def splitting(section: TurnSection, arc: HeteroclinicArc, rtol: float = RTOL) -> float:
    """By how much the branches of Q and P miss each other on a ray, in its coordinate ``ln(r/(reach - r))``.

    Negative where the branch of Q passes inside that of P, and so spirals inwards; positive where it goes to the
    equator. Infinite where one of them does not reach the ray. NaN where the sign is not decided either.
    """
    out, back = (_first_crossing(section, arc, rtol, backward) for backward in (False, True))
    return math.nan if math.isinf(out) and math.isinf(back) else out - back


def ray_outside(foot: HemispherePoint | CriticalSet, arc: HeteroclinicArc) -> Array:
    """Return the direction (2,) of the ray that ends in the middle of the equator outside an arc."""
    width = (arc.sense * (arc.sink - arc.source)) % math.tau
    middle = arc.sink + arc.sense * 0.5 * (math.tau - width)
    away = np.array([math.cos(middle), math.sin(middle)]) - foot.p
    return away / math.hypot(*away)


def _first_crossing(section: TurnSection, arc: HeteroclinicArc, rtol: float, backward: bool) -> float:
    """Return where the branch of Q, or that of P backward in time, first crosses the ray."""
    module, _ = section.kernel
    state = departures(section.at, section.psi, [arc.source if backward else arc.sink], rtol, backward)
    sense = -arc.sense if backward else arc.sense
    x, y = state[0, :2] - section.critical.p
    turned = math.atan2(section.u[1], section.u[0]) - math.atan2(y, x)
    goal = np.array([(sense * turned) % math.tau])
    ends, _, codes, _ = section.turn(state, rtol, backward, goal=goal, sense=sense, limit=LOOP_STEPS)
    lost = {module.TO_CRITICAL_SET: -math.inf, module.OUTWARD: math.inf, module.NO_RETURN_YET: math.nan}
    return lost.get(int(codes[0]), float(section.coordinate(ends)[0]))
