"""Neighbours of a motion in an invariant line, where it comes to Sigma along a limit direction that repels angularly.

It is on the stable manifold of a half-saddle, ``rho' = -r rho``, ``theta' = t theta`` with r, t > 0. One at
a small angle d next to it turns away at ``rho ~ d^(r/t)``, goes along the equator to the next limit direction, on
either side, and is late, and elsewhere in z, by as much: with r > t no derivative is left of that.

The motion in the line *passes* if it leaves along the limit direction that is next on both sides, ``rho' = R rho``,
``theta' = -T theta``. Then what was d is ``d^(r T/(t R))`` once rho is what it was: with r T > t R it is forgotten
too, and (x, y) tells only when it passes, as where all directions attract. For dry friction S in a line, against a
force f > S, r = f + S, t = T = f and R = f - S. If it *slides* on a critical set to which what comes along the next
directions goes as well, the angle is lost on Sigma.
"""

from __future__ import annotations

import math

from ...portrait.approach_outcomes import outcome_towards
from ...portrait.layer_problem.problem import LayerProblem
from ...systems.kinds import AnySystem
from ...systems.psi.constructors import constant
from ...systems.psi.function import Psi

MARGIN = 1e-6  # relative, by which the rates must differ
ANGLE_MARGIN = 1e-6  # rad


def shrinks_across(
    system: AnySystem, psi: Psi | None, z: tuple[float, ...], arriving: float, leaving: float | None
) -> bool:
    """Whether of a small angle next to a motion nothing is left, to first order, once it has been on Sigma.

    Shapes: z (m,).
    """
    problem = LayerProblem(system.at(z), constant() if psi is None else psi)
    equator = problem.equator
    if not len(equator) or len(equator.arcs) or (equator.multiplicity != 1).any():
        return False
    gaps = [abs(math.remainder(theta - arriving, math.tau)) for theta in equator.theta.tolist()]
    i = min(range(len(gaps)), key=gaps.__getitem__)
    r, t = -float(equator.lambda_rho[i]), float(equator.lambda_theta[i])
    if gaps[i] > ANGLE_MARGIN or not (t > 0.0 and r > (1.0 + MARGIN) * t):
        return False
    neighbours = {(i + 1) % len(gaps), (i - 1) % len(gaps)}
    if leaving is not None:
        (k,) = neighbours if len(neighbours) == 1 else (i,)
        R, T = float(equator.lambda_rho[k]), -float(equator.lambda_theta[k])
        same = abs(math.remainder(float(equator.theta[k]) - leaving, math.tau)) < ANGLE_MARGIN
        return same and R > 0.0 and T > 0.0 and r * T > (1.0 + MARGIN) * t * R
    compare = None if psi is None else ()
    ways = [outcome_towards(problem, float(equator.theta[k]), compare) for k in neighbours]
    return all(way.verdict == "slide" and not way.depends_on_psi for way in ways) and len({w.onto for w in ways}) == 1
