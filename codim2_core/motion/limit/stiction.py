"""Static friction above kinetic: a contact at rest holds while |e| <= S_0/S, the reach, and slips beyond it.

At rest friction is what the other forces ask for: e* with ``U(e*, 0, 0, z) = 0``, one where U = D (e - e*) is affine in
e. Kinetic friction alone holds it to the equator, |e*| = 1; beyond, e* is the same zero of the same formulas. What
follows where it lets go is known where friction takes energy from every slip, D + D^T negative definite, as
``D = -N mu J M^-1 J^T`` of one coefficient always is:

* Rest attracts however friction builds up: by a law e_Psi with slopes P, positive definite, the eigenvalues of D P are
  those of ``P^(1/2) D P^(1/2)``, whose symmetric part is negative definite too.
* It lets go in one direction. A limit direction is ``D (e - e*) = l e`` with l = lambda_rho, so
  ``e(l) = (D - l)^-1 D e*``, and ``d|e|^2/dl = 2 e.(D - l)^-1 e < 0``: |e| falls from |e*| > 1 at l = 0 to 0, and is 1
  for one l > 0. It attracts, since ``lambda_theta = t.D t - l < 0`` for t across.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ...portrait.layer_problem.equator import equator_equilibria
from ...results.arrays import Array
from ...results.words import say
from ...systems.arguments import short_repr
from ...systems.kinds import AnySystem
from ..initial_value.field import Field
from ..initial_value.line import InvariantLine
from ..initial_value.safe_steps import dissipation
from .sigma_decision import Decision


def checked_stiction(stiction: Any, formulas: Field) -> float:
    """Check the ratio of static to kinetic friction; where it is above 1, U must be affine in e."""
    try:
        reach = float(stiction)
    except (TypeError, ValueError):
        reach = math.nan
    if not 1.0 <= reach < math.inf:
        raise ValueError(
            f"stiction is {short_repr(stiction)}; give static over kinetic friction, a finite number from 1 on."
        )
    if reach > 1.0 and not all(formulas.is_affine[:2]):
        raise ValueError(
            f"stiction is {reach:g}, and U is not affine in e; leave stiction out, or give friction -N mu e with N and "
            "mu free of e."
        )
    return reach


def _rest(formulas: Field, line: InvariantLine | None, z: Array) -> tuple[Array, float] | None:
    """Return e* where friction is what rest asks for, and how much energy a slip loses; None where there is none."""
    if line is not None:
        slope = line.slope(0.0, z)
        return None if slope == 0.0 else (-line.radial_speed(0.0, z) / slope * line.n, -slope)
    D = formulas.jacobian(0.0, 0.0, 0.0, 0.0, z.tolist())[:2, :2]
    if np.linalg.det(D) == 0.0:
        return None
    U = np.array(formulas.value(0.0, 0.0, 0.0, 0.0, *z.tolist())[:2])
    rest: Array = np.asarray(-np.linalg.solve(D, U), np.float64)
    return rest, float(dissipation(D))


def hold(formulas: Field, line: InvariantLine | None, z: Array, reach: float) -> Decision | None:
    """Decide whether static friction holds a state on Sigma; None where it does not.

    Shapes: z (m,).
    """
    found = None if reach == 1.0 else _rest(formulas, line, z)
    if found is None or not math.hypot(*found[0].tolist()) < reach:
        return None
    e, loss = found
    if not loss > 0.0:
        return Decision("stop", say("static unknown"))
    return Decision("slide", say("static holds", share=math.hypot(*e.tolist()), reach=reach), e, onto="C")


def let_go(system: AnySystem, line: InvariantLine | None, e: Array, z: Array, reach: float) -> Decision:
    """Decide in which direction a contact slips that static friction holds no longer.

    Shapes: e (2,).
    """
    if line is None:
        equator = equator_equilibria(system, tuple(z.tolist()))
        theta = float(equator.theta[int(np.argmax(equator.lambda_rho))])
    else:
        theta = math.atan2(e[1], e[0])
    return Decision("leave", say("static gives way", reach=reach, theta=theta), theta=theta)
