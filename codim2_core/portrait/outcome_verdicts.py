"""Verdicts on orbits of the layer problem by their omega limit sets: slide, cross, or undecided."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from ..results.arrays import Array
from ..results.words import say, written_label, written_number
from .cycles.limit_cycles import cycles_of, reason_for_none
from .layer_problem.problem import LayerProblem
from .omega_limits import (
    CAPTURE,
    CONNECTION,
    MIN_RESOLVED_HEIGHT,
    OmegaLimit,
    critical_label,
    drawn_time,
    nears_end,
    omega_limits,
    predicted_limit_sets,
    radially_neutral,
    radially_neutral_ones,
)
from .orbits.result import Status, Trajectories
from .orbits.seeds import DEFAULT_MAX_STEPS, departures, stepping
from .orbits.trajectories import integrate_explicitly


def states_at(points: Array) -> Array:
    """States (k, 3) of points (k, 2) of the hemisphere."""
    from .stepping.layout import states_of

    return states_of(np.array(points, order="C"))[0]


class OutcomeVerdict(NamedTuple):
    """The verdict on some orbits, with the fields of `outcome.Outcome`."""

    verdict: str
    onto: str | None = None
    leaving: float | None = None
    slow_flow: Array | None = None
    reason: str = ""
    why: str = ""


RTOL = 1e-8
# Steps after which samples of the return map are asked where orbits go: about a critical set that repels they are not
# bound for it, and what comes to the equator had done so within 119 steps (5300 orbits of 150 random systems).
EARLY_STEP_LIMIT, UNSTABLE_STEP_LIMIT = 700, 128
START_FAN_RADIUS = 0.02  # radius, in (theta, ebar), of the half circle of starts around a Q that many orbits leave
ARRIVAL_ANGLES = np.radians([15.0, 45.0, 75.0, 105.0, 135.0, 165.0])
OUTER_ANGLES = ARRIVAL_ANGLES[
    [0, -1]
]  # where these two end apart, the others need not be followed to see that there is more than one end


def omega_limits_of(problem: LayerProblem, lines: Trajectories) -> list[OmegaLimit]:
    """Return the omega limit sets of trajectories of a layer problem."""
    return omega_limits(
        problem.at,
        problem.psi,
        lines,
        problem.equator,
        problem.critical,
        lambda: cycles_of(problem),
        rtol=RTOL,
        predict=partial(predicted_limit_sets, problem) if problem.at.as_given is not None else None,
    )


def orbits_to_end(problem: LayerProblem, states: Array) -> Trajectories:
    """Follow states (k, 3) of the hemisphere until they have ended, or samples tell where orbits round C will end."""
    hemisphere = np.full(len(states), -1.0)
    time = drawn_time(problem.at, problem.equator)
    options = stepping(time, RTOL, 0.1 * RTOL, capture=CAPTURE, samples="ends", step_limit=_early_limit(problem))
    lines = integrate_explicitly(problem.at, problem.psi, states, hemisphere, options)
    if problem.at.as_given is None:
        return lines
    cut = [
        i
        for i, status in enumerate(lines.status)
        if status is Status.STEP_LIMIT
        and not (
            lines.ends[i, 2] > MIN_RESOLVED_HEIGHT and nears_end(problem.critical, lines.ends[i, :2], backward=False)
        )
    ]
    if not cut or None not in predicted_limit_sets(problem, lines.ends[cut]):
        return lines
    whole = replace(options, step_limit=DEFAULT_MAX_STEPS)
    return integrate_explicitly(problem.at, problem.psi, states, hemisphere, whole)


def _early_limit(problem: LayerProblem) -> int:
    """Return the number of steps after which samples may tell where orbits will end; of all where none are asked."""
    if problem.at.as_given is None:
        return DEFAULT_MAX_STEPS
    critical = problem.critical
    unstable = bool(critical) and all(C.kind.startswith("unstable") for C in critical)
    return UNSTABLE_STEP_LIMIT if unstable else EARLY_STEP_LIMIT


def _ending_label(end: OmegaLimit) -> str:
    if end.label != "undecided":
        return written_label(end.label)
    return "an equilibrium that is not isolated" if end.sentence == Status.EQUILIBRIUM.value else "no end found"


def judge(problem: LayerProblem, found: Sequence[OmegaLimit], many: str) -> OutcomeVerdict:
    """Judge trajectories that end so."""
    if len({end.label for end in found}) > 1:
        where = ", ".join(dict.fromkeys(_ending_label(end) for end in found))
        return OutcomeVerdict("undecided", reason=say("several ends", many=many, labels=where), why="several")
    end = found[0]
    label = end.label
    if end.sentence == CONNECTION:
        return OutcomeVerdict("undecided", reason=say("saddle ahead", label=written_label(label)), why="several")
    if label.startswith("Q") and radially_neutral(problem.equator, int(label[1:]) - 1):
        return OutcomeVerdict("undecided", reason=say("neutral ahead", label=written_label(label)), why="neutral")
    for i, C in enumerate(problem.critical):
        if label == critical_label(problem.critical, i):
            return OutcomeVerdict(
                "slide", label, None, C.slow_flow, say("slides", label=written_label(label), kind=C.kind)
            )
    if label.startswith("cycle"):
        reason = say("slides on a cycle" if problem.at.normal_form is None else "slides around")
        return OutcomeVerdict("cycle", label, reason=reason)
    if label.startswith("Q"):
        theta = written_number(end.angle) if end.angle is not None else "?"
        return OutcomeVerdict("cross", label, end.angle, None, say("crosses", theta=theta, label=written_label(label)))
    if label == "equator":
        return OutcomeVerdict("cross", label, reason=say("crosses spiralling"))
    if end.sentence == Status.EQUILIBRIUM.value:
        return OutcomeVerdict("undecided", reason=say("rest ahead"), why="neutral")
    return OutcomeVerdict("undecided", reason=say("unfollowed"), why="unfollowed")


def add_slow_flow(problem: LayerProblem, judged: OutcomeVerdict) -> OutcomeVerdict:
    """Add the slow flow on a cycle, which takes following the cycle: only where it is shown."""
    if judged.verdict != "cycle" or judged.onto is None or judged.slow_flow is not None:
        return judged
    cycles, k = cycles_of(problem), int(judged.onto.split()[1]) - 1
    # one that does not close in the steps allowed is foretold, and is not among them
    return judged._replace(slow_flow=cycles[k].slow_flow) if k < len(cycles) else judged


def _all_end_on_C(problem: LayerProblem) -> bool:
    """Whether no orbit that leaves the equator can end but on the one critical set, which is stable.

    Where a theorem forbids limit cycles (`reason_for_none`), it ends at equilibria or a graphic of orbits between them,
    Poincare and Bendixson; and where lambda_rho < 0 at all Q no orbit of the open hemisphere comes to one.
    """
    equator, critical, form = problem.equator, problem.critical, problem.at.normal_form
    if form is None or len(critical) != 1 or not critical[0].kind.startswith("stable"):
        return False
    down = all(rate < 0.0 for rate in equator.lambda_rho.tolist()) and not any(radially_neutral_ones(equator))
    return down and not len(equator.arcs) and reason_for_none(form, critical, problem.location) is not None


def _wide(problem: LayerProblem, which: Sequence[int]) -> list[int]:
    """Limit directions that a whole family of orbits leaves."""
    equator = problem.equator
    return [i for i in which if not (equator.multiplicity[i] == 1 and equator.lambda_theta[i] < 0.0)]


def _points_around(problem: LayerProblem, wide: Sequence[int], angles: Array = ARRIVAL_ANGLES) -> Array:
    """Points around limit directions, at some angles from the equator."""
    theta, height = (
        problem.equator.theta[list(wide)][:, None] + START_FAN_RADIUS * np.cos(angles),
        START_FAN_RADIUS * np.sin(angles),
    )
    around = np.sqrt(1.0 - height**2)[:, None] * np.stack([np.cos(theta), np.sin(theta)], axis=-1)
    return around.reshape(-1, 2)


def judge_arrivals(problem: LayerProblem, which: Sequence[int], angles: Array = ARRIVAL_ANGLES) -> list[OutcomeVerdict]:
    """Judge what arrives at some limit directions (from 0), where lambda_rho < 0: all orbits side by side."""
    if not which:
        return []
    if _all_end_on_C(problem):
        C = problem.critical[0]
        return [
            OutcomeVerdict("slide", "C", None, C.slow_flow, say("slides", label=written_label("C"), kind=C.kind))
        ] * len(which)
    wide, count = _wide(problem, which), len(angles)
    states = departures(problem.at, problem.psi, problem.equator.theta[list(which)], RTOL, backward=False)
    if wide:
        states = np.concatenate([states, states_at(_points_around(problem, wide, angles))])
    found = omega_limits_of(problem, orbits_to_end(problem, states))
    mains, neighbours = found[: len(which)], found[len(which) :]
    fans = {i: neighbours[k * count : (k + 1) * count] for k, i in enumerate(wide)}
    judged = []
    for i, main in zip(which, mains, strict=True):
        fan = fans.get(i, [])
        if fan and count < len(ARRIVAL_ANGLES) and len({main.label, *(end.label for end in fan)}) == 1:
            fan = omega_limits_of(problem, orbits_to_end(problem, states_at(_points_around(problem, [i]))))
        judged.append(judge(problem, [main, *fan], "A whole family of orbits leaves Q" if i in fans else ""))
    return judged


def judge_equator_spirals(
    problem: LayerProblem, many: str = "Orbits leave the closed equator at all angles"
) -> OutcomeVerdict:
    """Judge what leaves the equator at all angles."""
    angle = 2.0 * math.pi * np.arange(8) / 8.0
    ring = 0.9995 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return judge(problem, omega_limits_of(problem, orbits_to_end(problem, states_at(ring))), many)
