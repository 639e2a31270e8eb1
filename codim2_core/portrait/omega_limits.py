"""Omega limit sets of trajectories on the hemisphere: an equilibrium, a cycle, and the side of approach.

Predict limit sets of orbits about the one critical set from the limit cycles around it, without integrating them.

Limit cycles about one critical set lie one inside another. An orbit between two of them, or between the set and the
first, stays there and ends at one of both (Poincare and Bendixson: there is no other equilibrium on the hemisphere).
An orbit outside of them all may end at the equator: but once it has turned about the set and come nearer to it, it
winds inwards for good.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ..numerics.arclength import distance
from ..results.arrays import Array
from ..results.words import say
from ..systems.frozen import FrozenSystem
from ..systems.psi.function import Psi
from .cycles.limit_cycles import LimitCycles, closed_orbits, excluding_theorem, surrounds
from .cycles.ray_section import COARSE_RTOL, TurnSection
from .layer_problem.critical import CriticalSet
from .layer_problem.eigendirections import to_disc
from .layer_problem.equator import EquatorEquilibria
from .layer_problem.problem import LayerProblem, found_once
from .orbits.trajectories import Status, Trajectories, trajectories

ON_C = -1


def predicted_limit_sets(problem: LayerProblem, states: Array) -> list[int | None]:
    """Return to which cycle, from 0 inside, orbits of states (n, 3) go, or `ON_C`; None where it is not decided."""
    known, question = _predictions(problem), states.tobytes()
    if question not in known:
        known[question] = _predict(problem, np.ascontiguousarray(states))
    return known[question]


@found_once()
def _predictions(_: LayerProblem) -> dict[bytes, list[int | None]]:
    """Begin to note what has been said of a problem, by the states: the same are given again."""
    return {}


def _predict(problem: LayerProblem, states: Array) -> list[int | None]:
    undecided: list[int | None] = [None] * len(states)
    if len(problem.critical) != 1 or excluding_theorem(problem) is not None:
        return undecided
    found, (C,) = closed_orbits(problem), problem.critical
    cycles = found.cycles
    if found.notes or any(cycle.kind == "semistable" for cycle in cycles):
        return undecided
    inside = np.array([[surrounds(cycle.points, p) for cycle in cycles] for p in states[:, :2]], bool)
    around = inside.reshape(len(states), len(cycles)).sum(axis=1).tolist()
    # from within, each of these attracts what lies between it and the next one, or repels it
    attracts = [C.kind.startswith("stable"), *(cycle.stable for cycle in cycles)]
    if any(one == other for one, other in pairwise(attracts)):
        return undecided
    outer = [i for i, count in enumerate(around) if count == 0]
    inward = dict(zip(outer, _come_nearer(problem, states[outer]), strict=True)) if outer else {}
    led: list[int | None] = []
    for i, count in enumerate(around):
        within = len(cycles) - count  # of `attracts`: what it lies outside of
        onto = within if attracts[within] else within + 1
        led.append(onto - 1 if (count or (inward[i] and attracts[within])) else None)
    return led


def _come_nearer(problem: LayerProblem, states: Array) -> list[bool]:
    """Whether orbits, when they have turned about the critical set, are nearer to it on the ray through their start."""
    section = TurnSection(problem, problem.critical[0])
    ends, _, codes, _ = section.turn(states, COARSE_RTOL)
    away, after = (np.hypot(*(place[:, :2] - section.critical.p).T) for place in (states, ends))
    return ((codes == section.kernel[0].RETURNED) & (after < away)).tolist()


BRANCH_DURATION = 600.0  # length drawn of a branch that ends nowhere: T in units of 1/|(a, b, d, f1, f2)|, or 1/max |U|
RISE_DURATION = 8.0  # and of 1/|lambda_rho|: enough to rise from where the expansion at the equator ends
EXTENSION_FACTOR = 30.0  # and how many times longer it is followed to see where it ends
CAPTURE = 1e-6  # distance from an attractor at which a branch has reached it
ON_CYCLE = 1e-4  # distance to a limit cycle at which a branch has reached it
AT_CRITICAL = 1e-2  # distance beyond which an equilibrium that captures is none of the critical sets known
AT_SADDLE = 1e-4  # distance at which a branch that stopped nowhere else is at a saddle
NEUTRAL_SHARE = 1e-13  # of the largest eigenvalue on the equator
AT_NEUTRAL = 1e-2  # distance to a radially neutral Q, which is come to like 1/T, at which a branch is at it
MIN_RESOLVED_HEIGHT = 1e-7  # ebar of which a point of the disc says something: below it an orbit is not followed on
CONNECTION = say("into a saddle")
AT_NEUTRAL_Q = say("to a neutral direction")


@dataclass(frozen=True, eq=False)
class OmegaLimit:
    """The omega limit set of a trajectory: its label, the angle of arrival if it has one, and a sentence."""

    label: str
    angle: float | None
    sentence: str


def critical_label(critical: tuple[CriticalSet, ...], i: int) -> str:
    """Name critical set i (from 0): C where it is the only one, else C1, C2, ..."""
    return "C" if len(critical) == 1 else f"C{i + 1}"


def _nearest_critical(critical: tuple[CriticalSet, ...], p: Array, within: float) -> int | None:
    at = p.tolist()
    gaps = [math.dist(C.p, at) for C in critical]
    i = min(range(len(gaps)), key=gaps.__getitem__, default=0)
    return i if gaps and gaps[i] <= within else None


def nears_end(critical: tuple[CriticalSet, ...], p: Array, backward: bool) -> bool:
    """Whether an orbit is close to a critical set that attracts, or repels backward."""
    k = _nearest_critical(critical, p, AT_CRITICAL)
    return k is not None and critical[k].kind.startswith("unstable" if backward else "stable")


def _on_cycle(cycles: LimitCycles, p: Array, backward: bool) -> int | None:
    for i, cycle in enumerate(cycles):
        if cycle.kind != "semistable" and (cycle.kind == "unstable") != backward:
            continue
        if distance(p, cycle.points) < ON_CYCLE:
            return i
    return None


def _tangent_at(critical: CriticalSet, p: Array) -> float | None:
    """Angle from C of the eigendirection along which an orbit, now at p, comes to a node or saddle."""
    if critical.discriminant < 0.0:
        return None
    (x, y), best = (p - critical.p).tolist(), (-1.0, 0.0, 0.0)
    (j11, j12), (j21, j22) = critical.jacobian.tolist()
    for value in critical.eigenvalues.real.tolist():
        # the longer row of J - lambda has the eigenvector across it
        u, v = max((j11 - value, j12), (j21, j22 - value), key=lambda row: math.hypot(*row))
        if u == v == 0.0:
            return math.atan2(y, x)  # a star node: any direction
        u, v = to_disc(critical.x2, (-v, u))
        score = u * x + v * y
        towards = math.copysign(1.0, score)
        best = max(best, (abs(score), towards * u, towards * v), key=lambda one: one[0])
    return math.atan2(best[2], best[1])


def nearest(equator: EquatorEquilibria, angle: float) -> tuple[int, float]:
    """Return the limit direction (from 0) nearest to an angle, and the gap between them."""
    gaps = [abs(math.remainder(angle - t, 2.0 * math.pi)) for t in equator.theta.tolist()]
    i = min(range(len(gaps)), key=gaps.__getitem__)
    return i, gaps[i]


def omega_limits(
    at: FrozenSystem,
    psi: Psi,
    lines: Trajectories,
    equator: EquatorEquilibria,
    critical: tuple[CriticalSet, ...],
    cycles: Callable[[], LimitCycles],
    *,
    rtol: float = 1e-9,
    backward: bool = False,
    predict: Callable[[Array], list[int | None]] | None = None,
) -> list[OmegaLimit]:
    """Return the omega limit sets of trajectories on the hemisphere; those cut off by time are integrated on."""
    statuses, states = list(lines.status), np.array(lines.ends)
    found: list[OmegaLimit | None] = [None] * len(lines)
    length = drawn_time(at, equator)
    for more in (0.0, 1.0, EXTENSION_FACTOR):
        open_ = [i for i, s in enumerate(statuses) if s in (Status.T_MAX, Status.STEP_LIMIT) and found[i] is None]
        follow = [i for i in open_ if states[i, 2] > MIN_RESOLVED_HEIGHT] if more else []
        if follow:
            time, places = more * length, states[follow, :2]
            on = _integrate_to_time(at, psi, places, time, rtol, backward)
            for j, i in enumerate(follow):
                statuses[i], states[i] = on.status[j], on.ends[j]
        elif predict is not None:
            going = [i for i in open_ if not nears_end(critical, states[i, :2], backward)]
            labels = predict(states[going]) if going else []
            for i, onto in zip(going, labels, strict=True):
                found[i] = None if onto is None else _predicted_ending(critical, onto)
        for i in open_ if more else range(len(lines)):
            if found[i] is not None:
                continue
            p, w = states[i, :2], float(states[i, 2])
            angle = math.atan2(p[1], p[0])
            near, gap = nearest(equator, angle) if len(equator) else (0, math.inf)
            label = f"Q{near + 1}"
            k = _nearest_critical(critical, p, AT_CRITICAL if statuses[i] is Status.EQUILIBRIUM else AT_SADDLE)
            if statuses[i] is Status.EQUILIBRIUM and k is not None:
                found[i] = OmegaLimit(critical_label(critical, k), _tangent_at(critical[k], p), statuses[i].value)
            elif statuses[i] is Status.ARRIVED and len(equator):
                found[i] = OmegaLimit(label, float(equator.theta[near]), statuses[i].value)
            elif statuses[i] is Status.SPIRALLED:
                found[i] = OmegaLimit("equator", None, statuses[i].value)
            elif not more and nears_end(critical, p, backward):
                continue  # it is followed on before cycles, which cost more, are searched for
            elif (reached := _on_cycle(cycles(), p, backward)) is not None:
                found[i] = OmegaLimit(f"cycle {reached + 1}", None, say("onto a cycle"))
            elif w < AT_SADDLE and gap < AT_SADDLE and more:
                found[i] = OmegaLimit(label, float(equator.theta[near]), _stopping_reason(equator, near, w))
            elif more and max(w, gap) < AT_NEUTRAL and radially_neutral(equator, near):
                found[i] = OmegaLimit(label, float(equator.theta[near]), AT_NEUTRAL_Q)
            elif k is not None and critical[k].kind == "saddle" and more:
                found[i] = OmegaLimit(critical_label(critical, k), _tangent_at(critical[k], p), CONNECTION)
    return [
        e if e is not None else OmegaLimit("undecided", None, s.value) for e, s in zip(found, statuses, strict=True)
    ]


def _predicted_ending(critical: tuple[CriticalSet, ...], onto: int) -> OmegaLimit:
    if onto == ON_C:
        return OmegaLimit(critical_label(critical, 0), None, Status.EQUILIBRIUM.value)
    return OmegaLimit(f"cycle {onto + 1}", None, say("onto a cycle"))


def drawn_time(at: FrozenSystem, equator: EquatorEquilibria) -> float:
    """T in which a branch shows where it goes: long for |U|, and for the slowest way up from the equator."""
    unit = at.speed
    slow = np.abs(equator.lambda_rho[~equator.radially_degenerate])
    return BRANCH_DURATION / unit + (RISE_DURATION / max(float(slow.min()), 1e-4 * unit) if len(slow) else 0.0)


def _integrate_to_time(
    at: FrozenSystem, psi: Psi, places: Array, time: float, rtol: float, backward: bool
) -> Trajectories:
    return trajectories(
        at,
        psi,
        places,
        t_max=time,
        rtol=rtol,
        atol=0.1 * rtol,
        backward=backward,
        capture=CAPTURE,
        samples="ends",
        stiff=True,
    )


def _stopping_reason(equator: EquatorEquilibria, i: int, w: float) -> str:
    """Return the reason why an orbit that no attractor captured is at Q_{i+1}."""
    if equator.multiplicity[i] > 1 or radially_neutral(equator, i):
        return say("to a degenerate equilibrium")
    if half_saddle(equator, i) and w > 0.0:
        return CONNECTION
    return Status.ARRIVED.value


def radially_neutral(equator: EquatorEquilibria, i: int) -> bool:
    """Whether lambda_rho of Q_{i+1} is zero, or too near zero for doubles to tell its sign again."""
    return radially_neutral_ones(equator)[i]


def radially_neutral_ones(equator: EquatorEquilibria) -> list[bool]:
    """`radially_neutral` of all limit directions; in floats, for there are few, and NumPy's calls would cost more."""
    rho = equator.lambda_rho.tolist()
    least = NEUTRAL_SHARE * max(map(abs, (*rho, *equator.lambda_theta.tolist())), default=0.0)
    return [zero or abs(r) <= least for r, zero in zip(rho, equator.radially_degenerate.tolist(), strict=True)]


def half_saddle(equator: EquatorEquilibria, i: int) -> bool:
    """Whether Q_{i+1} has one branch on the hemisphere that bounds sectors: a half-saddle, or a multiple zero."""
    if radially_neutral(equator, i):
        return False
    multiplicity, radial = int(equator.multiplicity[i]), float(equator.lambda_rho[i])
    if multiplicity == 1:
        return float(equator.lambda_theta[i]) * radial > 0.0
    if multiplicity % 2 == 0:
        return True
    return angular_sign(equator, i) * radial > 0.0


def angular_sign(equator: EquatorEquilibria, i: int) -> int:
    """Sign of dTheta/dtheta at Q_{i+1}; at a zero of odd multiplicity, of Theta beyond it; 0 at an even one."""
    if equator.multiplicity[i] % 2 == 0:
        return 0
    if equator.beyond:
        return equator.beyond[i]
    sign, count = 1, len(equator)
    for step in range(count):  # the signs alternate between zeros of odd multiplicity
        j = (i + step) % count
        if equator.multiplicity[j] == 1:
            return sign * (1 if equator.lambda_theta[j] > 0.0 else -1)
        sign *= -1 if equator.multiplicity[j] % 2 else 1
    return 0
