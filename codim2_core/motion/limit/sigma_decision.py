"""Decide what follows on Sigma in the limit eps -> 0, by the hemisphere: Section 3.2.

Static friction above kinetic: a contact at rest holds while |e| <= S_0/S, the reach, and slips beyond it.

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
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import wraps
from typing import Any

import numpy as np

from ...formulas.expression import Expression
from ...formulas.tape import compact
from ...portrait.approach_outcomes import outcome_towards
from ...portrait.cycles.limit_cycles import limit_cycles
from ...portrait.layer_problem.critical import CriticalSet, critical_sets
from ...portrait.layer_problem.equator import EquatorEquilibria, equator_equilibria
from ...portrait.layer_problem.problem import LayerProblem
from ...portrait.outcome_verdicts import judge, omega_limits_of, orbits_to_end, states_at
from ...results.arrays import Array
from ...results.words import say
from ...systems.arguments import short_repr
from ...systems.frozen import FrozenSystem
from ...systems.kinds import AnySystem
from ...systems.psi.constructors import comparison_families, constant
from ...systems.psi.function import Psi
from ..initial_value.field import Field
from ..initial_value.line import InvariantLine
from ..initial_value.slow_steps import dissipation

_RADII, _ANGLES = np.linspace(0.0, 1.0, 17), np.linspace(0.0, 2.0 * np.pi, 257)
_NET = {"c": np.outer(_RADII, np.cos(_ANGLES)), "s": np.outer(_RADII, np.sin(_ANGLES))}


def has_pole(at: FrozenSystem) -> bool:
    """Whether a divisor in U changes its sign on a net over the disc |e| <= 1, or vanishes at a place of the net."""
    values = {"x": 0.0, "y": 0.0, **_NET}
    for row in at.rows()[:2]:
        for op, *args in row.tape:
            if op == "/":
                divisor = Expression(compact(list(row.tape), args[1])).evaluate(values)
                if not (divisor.min() > 0.0 or divisor.max() < 0.0):
                    return True
    return False


ORIGIN_TOLERANCE = 1e-12  # |p| of a critical set that x = y = 0 lies on
ORBITS_AROUND = 8  # orbits from around such a set that does not attract
START_DISTANCE = 1e-3  # from it, at which they start


@dataclass(frozen=True)
class Decision:
    """The decision at one state on Sigma."""

    kind: str  # "slide", "cycle", "leave", "away" (the trajectory turns before it reaches Sigma), or "stop"
    reason: str
    e: Array | None = None  # (2,) Critical set to slide on (for "cycle": the one inside)
    theta: float | None = None  # direction in which to leave
    onto: str | None = None


def _name_poles(decide: Callable[..., Decision]) -> Callable[..., Decision]:
    """Say that U has a pole on the hemisphere where that is why nothing can be decided."""

    @wraps(decide)
    def named(system: AnySystem, psi: Psi | None, z: Array, *more: Any) -> Decision:
        try:
            decision = decide(system, psi, z, *more)
        except ValueError:
            if not has_pole(system.at(tuple(z.tolist()))):
                raise
            return Decision("stop", say("pole on the hemisphere"))
        if decision.kind == "stop" and has_pole(system.at(tuple(z.tolist()))):
            return Decision("stop", say("pole on the hemisphere"))
        return decision

    return named


@_name_poles
def decide_arrival(system: AnySystem, psi: Psi | None, z: Array, theta: float) -> Decision:
    """Decide what becomes of a trajectory that arrives at Sigma, at z (m,), at angle theta."""
    own = LayerProblem(system.at(tuple(z.tolist())), constant() if psi is None else psi)
    outcome = outcome_towards(own, theta, None if psi is None else ())
    if psi is None and outcome.depends_on_psi:
        return Decision("stop", say("arrival depends", theta=theta))
    if outcome.verdict == "misses":
        return Decision("away", outcome.reason)
    return _decision_of_outcome(own, outcome.verdict, outcome.onto, outcome.leaving, outcome.reason)


@_name_poles
def decide_from_hemisphere(system: AnySystem, psi: Psi, z: Array, points: Array) -> Decision:
    """Decide what becomes of orbits of the layer problem at z (m,) from points (k, 2) of the hemisphere."""
    hemisphere = LayerProblem(system.at(tuple(z.tolist())), psi)
    found = omega_limits_of(hemisphere, orbits_to_end(hemisphere, states_at(points)))
    verdict, onto, leaving, _, reason, _ = judge(hemisphere, found, "Orbits go on from there")
    return _decision_of_outcome(hemisphere, verdict, onto, leaving, reason)


def critical_name(system: AnySystem, psi: Psi, z: Array, e: Array) -> str:
    """Name of the critical set at e: "C", or "C1", ... in the order of `critical_sets` where there are several."""
    sets = critical_sets(system, psi, tuple(z.tolist()))
    if len(sets) < 2:
        return "C"
    return f"C{1 + min(range(len(sets)), key=lambda k: float(np.hypot(*(sets[k].e - e))))}"


def _decision_of_outcome(
    problem: LayerProblem, verdict: str, onto: str | None, leaving: float | None, reason: str
) -> Decision:
    """Turn what approach outcomes say into what the course does next."""
    if verdict == "slide":
        chosen = problem.critical[_index(onto)]
        if not _stable(chosen):
            return Decision("stop", f"{reason} {say('saddle reached', onto=onto, kind=chosen.kind)}")
        return Decision("slide", reason, chosen.e, onto=onto)
    if verdict == "cycle":
        return Decision("cycle", reason, problem.critical[0].e, onto=onto)
    if verdict == "cross" and leaving is not None:
        return Decision("leave", reason, theta=leaving)
    if verdict == "cross":
        return Decision("stop", f"{reason} {say('spiral phase')}")
    return Decision("stop", reason)


def _index(label: str | None) -> int:
    digits = "".join(filter(str.isdigit, label or ""))
    return int(digits) - 1 if digits else 0


def decide_from_origin(system: AnySystem, psi: Psi, z: Array) -> Decision:
    """Decide what follows from a state on Sigma, x = y = 0: for every eps the orbit of the layer problem from p = 0."""
    at = tuple(z.tolist())
    sets = critical_sets(system, psi, at)
    middle = [i for i, C in enumerate(sets) if math.hypot(*C.p.tolist()) <= ORIGIN_TOLERANCE]
    if middle:
        i = middle[0]
        onto = "C" if len(sets) == 1 else f"C{i + 1}"
        if _stable(sets[i]):
            return Decision("slide", say("middle is stable", kind=sets[i].kind, onto=onto), sets[i].e, onto=onto)
        angle = math.tau * np.arange(ORBITS_AROUND) / ORBITS_AROUND
        ring = START_DISTANCE * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        decision = decide_from_hemisphere(system, psi, z, ring)
        return replace(decision, reason=f"{say('middle is a set', onto=onto)} {decision.reason}")
    border = None if any(_stable(C) for C in sets) else decide_border(system, z)
    if border is not None:
        return border
    decision = decide_from_hemisphere(system, psi, z, np.zeros((1, 2)))
    return replace(decision, reason=f"{say('middle')} {decision.reason}")


@_name_poles
def decide_start(system: AnySystem, psi: Psi | None, z: Array) -> Decision:
    """Decide what follows from a state on Sigma, when nothing is known of how it came there.

    If psi is given, by the orbit of the layer problem through p = 0. Otherwise sliding if there is one attractor on
    the open hemisphere; with none, the one way out; else stop.
    """
    if psi is not None:
        return decide_from_origin(system, psi, z)
    at = tuple(z.tolist())
    asked = comparison_families()
    stable = [tuple(i for i, C in enumerate(critical_sets(system, own, at)) if _stable(C)) for own in asked]
    if any(choice != stable[0] for choice in stable):
        return Decision("stop", say("stability depends"))
    own = asked[0]
    sets = critical_sets(system, own, at)
    if len(stable[0]) > 1:
        return Decision("stop", say("several to slide on", count=len(stable[0])))
    if len(stable[0]) == 1:
        i = stable[0][0]
        onto = "C" if len(sets) == 1 else f"C{i + 1}"
        reason = f"{say('one to slide on', onto=onto)} {_also(system, at)}".strip()
        return Decision("slide", reason, sets[i].e, onto=onto)
    cycles = [(i, cycle) for i, cycle in enumerate(limit_cycles(system, own, at)) if cycle.stable]
    if cycles:
        return Decision("stop", say("cycles to slide on"))
    border, equator = decide_border(system, z), equator_equilibria(system, at)
    if border is not None:
        return border
    ways = _ways_out(equator)
    if len(ways) == 1:
        theta = float(equator.theta[ways[0]])
        return Decision("leave", say("one way out", theta=theta, Q=f"Q{ways[0] + 1}"), theta=theta)
    return Decision("stop", say("several ways out", count=len(ways)) if len(ways) else say("no way out"))


def decide_border(system: AnySystem, z: Array) -> Decision | None:
    """Return what is known where the one critical set lies on the equator; None where none does, or several."""
    equator = equator_equilibria(system, tuple(z.tolist()))
    border = np.flatnonzero(equator.radially_degenerate)
    if len(border) != 1:
        return None
    theta = float(equator.theta[border[0]])
    return Decision("border", say("on the equator"), _unit(theta), theta, "C")


def _ways_out(equator: EquatorEquilibria) -> list[int]:
    return np.flatnonzero((equator.lambda_rho > 0.0) & (equator.lambda_theta < 0.0)).tolist()


def _also(system: AnySystem, at: tuple[float, ...]) -> str:
    ways = _ways_out(equator_equilibria(system, at))
    if not len(ways):
        return ""
    return say("other ways", which=", ".join(f"Q{i + 1}" for i in ways))


def _unit(theta: float) -> Array:
    return np.array([math.cos(theta), math.sin(theta)])


def _stable(critical: CriticalSet) -> bool:
    return critical.kind.startswith("stable")


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
    """Decide whether static friction holds a state on Sigma at z (m,); None where it does not."""
    found = None if reach == 1.0 else _rest(formulas, line, z)
    if found is None or not math.hypot(*found[0].tolist()) < reach:
        return None
    e, loss = found
    if not loss > 0.0:
        return Decision("stop", say("static unknown"))
    return Decision("slide", say("static holds", share=math.hypot(*e.tolist()), reach=reach), e, onto="C")


def let_go(system: AnySystem, line: InvariantLine | None, e: Array, z: Array, reach: float) -> Decision:
    """Decide in which direction a contact slips that static friction holds no longer at e (2,)."""
    if line is None:
        equator = equator_equilibria(system, tuple(z.tolist()))
        theta = float(equator.theta[int(np.argmax(equator.lambda_rho))])
    else:
        theta = math.atan2(e[1], e[0])
    return Decision("leave", say("static gives way", reach=reach, theta=theta), theta=theta)
