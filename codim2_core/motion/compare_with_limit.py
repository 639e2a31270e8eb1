"""Compare a regularised motion with its limit eps -> 0: their phases, and the order in eps."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..portrait.layer_problem.equator import equator_equilibria
from ..results.words import say
from ..systems.kinds import AnySystem
from ..systems.psi.function import Psi
from .initial_value.field import field
from .initial_value.line import invariant_line
from .result import Phase, Simulation

NEUTRAL_RATIO = 1e-6  # lambda_rho in units of |lambda_theta|: an exit through the equator (Figure 19)
FAR_OUT = 1e6  # zeta at which the power with which Psi falls is read off
_VERB = {"slip": "slips", "slide": "slides", "cross": "crosses Σ"}


@dataclass(frozen=True)
class Agreement:
    """Agreement of a motion for eps > 0 with the limit."""

    same: bool  # whether they have the same phases, on the same sets, as far as both were followed
    order: float  # they differ by O(eps^order) at a fixed time: see `limit_order`
    sentence: str


def limit_order(system: AnySystem, psi: Psi, limit: Simulation) -> float:
    """Order in eps with which the regularised motion tends to its limit.

    It is 1, but lower if the motion leaves Sigma: along a limit direction, the orbits of the hemisphere come to the
    direction as eps^(|lambda_theta|/lambda_rho), so that the order is at most that ratio; through the equator
    (Figure 19) it is ``2 q/(1 + 2 q)`` where ``Psi ~ s^(1 - q/2)``: 4/5 for Psi = 1, near 1 for one that falls
    exponentially. In an invariant line there is no direction to come to, and only the exit through the equator counts.

    In (0, 1].
    """
    order = 1.0
    in_line = invariant_line(field(system), limit.states[0]) is not None
    for phase in limit.phases:
        if phase.kind != "slip" or limit.dense(phase.t_start)[:2].any():
            continue
        e = phase.e(phase.t_start)
        equator = equator_equilibria(system, limit.dense(phase.t_start)[2:])
        if not len(equator):
            continue
        distance = np.abs(np.exp(1j * equator.theta) - complex(*e.tolist()))
        i = int(np.argmin(distance))
        radial, angular = float(equator.lambda_rho[i]), float(equator.lambda_theta[i])
        if radial > NEUTRAL_RATIO * abs(angular):
            if angular < 0.0 and not in_line:
                order = min(order, -angular / radial)
        elif psi.saturation == math.inf:  # else U is that of the limit down to |(x, y)| of order eps
            power = 2.0 + 2.0 * float(psi.steepness(FAR_OUT))
            order = min(order, 2.0 * power / (1.0 + 2.0 * power))
    return order


def agreement(system: AnySystem, psi: Psi, run: Simulation, limit: Simulation) -> Agreement:
    """Compare the phases of a regularised motion with those of its limit."""
    order = limit_order(system, psi, limit)
    end = min(float(run.times[-1]), float(limit.times[-1]))
    own, other = (_until(phases, end) for phases in (run.phases, limit.phases))
    for k in range(max(len(own), len(other))):
        a, b = (phases[k] if k < len(phases) else None for phases in (own, other))
        if a is None or b is None or (a.kind, a.onto) != (b.kind, b.onto):
            t = min(phase.t_start for phase in (a, b) if phase is not None)
            words = [f"{_words(phase)}" for phase in (a, b)]
            sentence = say("phases differ", eps=run.eps, t=t, here=words[0], there=words[1])
            return Agreement(False, order, sentence)
    return Agreement(True, order, say("phases agree") if order == 1.0 else say("phases agree, less", order=order))


def _until(phases: tuple[Phase, ...], end: float) -> list[Phase]:
    """Phases that begin before a time, or at it as a crossing does, which takes none."""
    return [phase for phase in phases if phase.t_start < end or (phase.kind == "cross" and phase.t_start <= end)]


def _words(phase: Phase | None) -> str:
    if phase is None:
        return "goes on as before"
    return _VERB[phase.kind] + (f" on {phase.onto}" if phase.onto else "")
