"""Sliding in the limit eps -> 0: the slow flow on a critical set that is followed in z, and where that ends.

On ``U((c, s), 0, 0, z) = 0``, ``z' = W((c, s), 0, 0, z)``, (4.17). The set is continued as a `SlowManifold`.

Sliding on a limit cycle of the layer problem: z' is the mean of W over the cycle.

In the e-linear system that is the slow flow on the critical set inside (Proposition 4.2), see `slide`. Here it is
read off the cycle itself, found anew at every z that the method asks for.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache, partial
from typing import NamedTuple

import numpy as np

from ...numerics.radau import STAGES, Step, StepsTooShortError, TooManyStepsError, truncate_step
from ...numerics.sign_changes import root_between
from ...portrait.cycles.limit_cycles import LimitCycle, limit_cycles
from ...results.arrays import Array
from ...systems.kinds import AnySystem
from ...systems.psi.function import Psi
from ..initial_value.events import DEGREES, monotone_fractions
from ..initial_value.field import Field
from ..initial_value.kernels.motion import FIRST_STEP_SHARE
from ..initial_value.kernels.rate import ROUNDING
from ..initial_value.line import InvariantLine
from ..initial_value.motion_steps import Inspection, MotionSteps
from ..initial_value.slow_manifold import SlowManifold, complement, determinant, trace
from ..initial_value.slow_steps import (
    FOLD_MARGIN,
    SAFE_NODES,
    SLOW_STEPS_PER_CALL,
    SlowSteps,
    StepRequirements,
    dissipation,
    steps_of_z,
)

MIN_STEP = 1e-14  # of the time in which z changes by its own size: steps that short mean that the set ends here
EQUATOR_GAP = 1e-5  # 1 - |e|^2 at which an end is taken for the equator
HELD_EXCESS = 64.0 * ROUNDING  # of a force at the bound of friction: as much more is rounding, and is held
AT_FOLD = 1e-3  # |det D_e U|, in units of its entries squared, at which it is taken for a fold
TINY = 1e-300
SHORTEST_PART = 1e-13  # of a step: a set that is not followed so far has gone
LEAST_PART = 1.0 / 64.0  # of a step, in which a set that has moved far is followed to a place within it
GAUGE_DEGREES = (4, *DEGREES)  # of the polynomials that a gauge is taken for along a step: most are far from zero
NEAR_HOPF = 1e-2  # |tr J| in units of D_e U, below which a stable cycle may be too small to be found


@dataclass(frozen=True)
class Slide:
    """A slide."""

    taken: list[Step]  # of the whole state, with x = y = 0
    # "time", "switch" (of the formulas), "equator" (or the reach of static friction), "fold", "hopf", "cycle" (the
    # limit cycle it slides on is there no longer), "feeds" (static friction takes no longer energy from every
    # slip), or "given up"
    end: str
    e: Array  # (2,) Critical set at the end
    places: list[Array]  # (2,) The critical set at the beginning, and at the end of each step
    evaluations: int = 0
    stopped: TooManyStepsError | None = None  # why it was given up; also where W is undefined from some z on
    p: Sequence[Array] = ()  # (2,) On a cycle of a general system, whose means `places` are: the means of p
    switch: int | None = None  # which one
    undecided: int = 0  # steps that could not be bounded
    leaves_line: bool = False  # a load pushes it out of its invariant line


def own_time(z: Array, rate: Array, floor: float) -> float:
    """Return the time in which z changes by its own size, |z| + floor; infinite where it does not change."""
    speed = float(np.max(np.abs(rate) / (np.abs(z) + floor)))
    return 1.0 / speed if speed > 0.0 else math.inf


def slide(
    field: Field,
    psi: Psi,
    e: Array,
    t: float,
    z: Array,
    t_end: float,
    *,
    rtol: float,
    atol: float,
    most: int,
    lives: Callable[[Array], bool] | None = None,
    line: InvariantLine | None = None,
    delayed: bool = False,
    resting: bool = False,
    reach: float = 1.0,
    max_step: float = math.inf,
) -> Slide:
    """Follow the slow flow from e (2,), z (m,), until the critical set reaches the equator, folds or turns unstable."""
    if not len(z):
        return Slide([Step(t, t_end - t, np.zeros(2), np.zeros(2), np.zeros((2, STAGES)))], "time", e, [e, e])
    manifold = SlowManifold(field, e, z)
    gauges = _gauges(manifold, psi, on_cycle=lives is not None, line=line, reach=reach)
    if delayed:
        del gauges["hopf"]

    def alive(z: Array) -> bool:
        if lives is None or lives(z):
            return True
        e = manifold.at(z)
        return e is not None and abs(trace(manifold, psi, e, z)) < NEAR_HOPF * float(
            np.abs(manifold.slopes(e, z)[:2, :2]).max()
        )

    floor = atol / rtol
    pace = own_time(z, np.array(field.value(*manifold.e.tolist(), 0.0, 0.0, *z.tolist())[2:]), floor)
    h, shortest = FIRST_STEP_SHARE * pace, MIN_STEP * min(pace, t_end - t)
    inspection = Inspection(field, None, 0.0, line, rtol, floor, slide=True, at=manifold.e if resting else None)
    if resting:
        (c, s), slope = e.tolist(), partial(field.jacobian, *e.tolist(), 0.0, 0.0)
        rate = lambda z: np.array(field.value(c, s, 0.0, 0.0, *z)[2:])
        options = {"h": h, "least": shortest, "longest": max_step, "inspection": inspection}
        motion = steps_of_z(rate, lambda z: slope(z)[2:, 4:], (t, t_end), z, rtol, floor, most, **options)
        ahead = _steps_of_rest(e, motion)
    else:
        options = {"h": h, "least": shortest, "longest": max_step, "inspection": inspection}
        motion = SlowSteps(field, manifold.e, line, (t, t_end), z, rtol, floor, most, **options)
        sign, n = math.copysign(1.0, determinant(manifold, manifold.e, z)), None if line is None else line.n
        ahead = _steps_of_set(manifold, motion, StepRequirements(psi, sign, n, reach) if lives is None else None)
    taken: list[Step] = []
    places = [manifold.e]

    def ended(end: str, e: Array, stopped: TooManyStepsError | None = None) -> Slide:
        return Slide(
            taken, end, e, places, motion.evaluations, stopped, (), motion.switch, inspection.undecided,
            motion.leaves_line,
        )  # fmt: skip

    try:
        for step, after, is_safe in ahead:
            found: list[tuple[float, str]] = (
                [] if is_safe else _end_fractions(manifold, gauges, step, places[-1], after)
            )
            if not is_safe and gauges["fold"](after, step.last[2:]) < FOLD_MARGIN:
                found.append((1.0, "fold"))  # where the slow flow vanishes at the fold, it never gets past it
            if not alive(step.last[2:]):
                found.append((last_fraction(alive, step, 20), "cycle"))
            if found:
                u, name = min(found)
                taken.append(truncate_step(step, u))
                end = manifold.at(taken[-1].last[2:])
                places.append(after if end is None else end)
                return ended(name, places[-1])
            taken.append(step)
            places.append(after)
    except StepsTooShortError as error:
        if taken and t_end - taken[-1].end <= shortest:  # the rounding of t_end is left
            return ended("time", places[-1])
        end = _end_reason(manifold, reach)
        return ended(end, manifold.e, error if end == "given up" else None)
    except TooManyStepsError as error:
        return ended("given up", places[-1], error)
    return ended("time" if motion.switch is None and not motion.leaves_line else "switch", places[-1])


class _Ahead(NamedTuple):
    """A step, e at its end, and whether it is known that no end lies within it."""

    step: Step
    e: Array
    is_safe: bool


def _steps_of_rest(e: Array, motion: MotionSteps) -> Iterator[_Ahead]:
    for part in motion.chunks():
        for step in part:
            yield _Ahead(step, e, True)


def _steps_of_set(manifold: SlowManifold, motion: SlowSteps, safe: StepRequirements | None) -> Iterator[_Ahead]:
    """Take the steps of a slide; the manifold is moved to where an end may be near."""
    z = manifold.z
    try:
        for part in motion.chunks(SLOW_STEPS_PER_CALL):
            if not len(part.starts):
                continue
            e, D = motion.sets(part, SAFE_NODES)
            known = [False] * len(e) if safe is None else safe.steps(e, D)
            for array in (part.first, part.ends.T, part.polynomials.swapaxes(0, 1)):
                array[:2] = 0.0  # of a state on Sigma
            for step, before, after, is_safe in zip(part, e[:, 0], e[:, -1], known, strict=True):
                if not is_safe:
                    manifold.begin(before, step.first[2:])
                yield _Ahead(step, after, is_safe)
                z = step.last[2:]
    except StepsTooShortError:
        manifold.begin(motion.y[:2].copy(), z)
        raise


def _end_fractions(
    manifold: SlowManifold, gauges: dict[str, Callable[[Array, Array], float]], step: Step, before: Array, after: Array
) -> list[tuple[float, str]]:
    """Fractions of a step at which the slide ends, and how."""
    place = cache(partial(_critical_set_at, manifold, step))
    found: list[tuple[float, str]] = []
    for name, gauge in gauges.items():
        u = _first_negative(gauge, place, gauge(before, step.first[2:]), gauge(after, step.last[2:]))
        if u is not None:
            found.append((u, name))
    lost = _lost(manifold, step, before, after)
    if lost is not None and all(lost[0] < u for u, _ in found):
        manifold.begin(lost[1].e, lost[1].z)
        return [(lost[0], "fold")]
    return found


def _lost(manifold: SlowManifold, step: Step, before: Array, after: Array) -> tuple[float, SlowManifold] | None:
    """Return up to which fraction of a step the set is there that it begins on, and that; None if to its end."""
    last, first = (SlowManifold(manifold.field, e, at[2:]) for e, at in ((after, step.last), (before, step.first)))
    u, there = _track_slow_manifold(first, step, 1.0, SHORTEST_PART, last)
    return None if there is last else (u, there)


def _track_slow_manifold(
    here: SlowManifold, step: Step, to: float, least: float, last: SlowManifold | None = None
) -> tuple[float, SlowManifold]:
    """Follow a set to a fraction of a step, in parts not below the least one, or as far as it is there."""
    u, part = 0.0, to
    while part > least:
        at = min(u + part, to)
        ahead = last if at == to and last is not None else _search_slow_manifold(here, step.at(at)[2:])
        if ahead is not None and here.joined(ahead):
            if at == to:
                return at, ahead
            here, u, part = ahead, at, 4.0 * part
        part *= 0.5
    return u, here


def _search_slow_manifold(here: SlowManifold, z: Array) -> SlowManifold | None:
    """Search the set at another z, close to one that is known."""
    e = here.at(z)
    return None if e is None else SlowManifold(here.field, e, z)


def _gauges(
    manifold: SlowManifold, psi: Psi, on_cycle: bool, line: InvariantLine | None, reach: float
) -> dict[str, Callable[[Array, Array], float]]:
    """Return what turns negative, as functions of e and z, where the sliding ends, by the name of the end."""
    (j11, j12), (j21, j22) = manifold.slopes(manifold.e, manifold.z)[:2, :2].tolist()
    det, squares = j11 * j22 - j12 * j21, j11 * j11 + j12 * j12 + j21 * j21 + j22 * j22
    bound = reach * (1.0 + HELD_EXCESS * min(squares / max(abs(det), TINY), 1.0 / HELD_EXCESS**0.5))
    found: dict[str, Callable[[Array, Array], float]] = {
        "equator": lambda e, z: complement(e, bound),  # noqa: ARG005 (all gauges are called alike)
    }
    if line is not None:
        n = line.n
        return {**found, "fold": lambda e, z: -float(n @ _unit_slopes(manifold, e, z) @ n)}
    sign = math.copysign(1.0, determinant(manifold, manifold.e, manifold.z))
    turn = -1.0 if on_cycle else 1.0  # around a stable cycle C is unstable: tr J > 0
    found["fold"] = lambda e, z: sign * float(np.linalg.det(_unit_slopes(manifold, e, z)))
    if reach > 1.0:
        return {**found, "feeds": lambda e, z: float(dissipation(_unit_slopes(manifold, e, z)))}
    return {**found, "hopf": lambda e, z: -turn * trace(manifold, psi, e, z)}


def _unit_slopes(manifold: SlowManifold, e: Array, z: Array) -> Array:
    """Return D_e U in units of its largest entry."""
    D = manifold.slopes(e, z)[:2, :2]
    return D / max(float(np.abs(D).max()), TINY)


def _end_reason(manifold: SlowManifold, reach: float) -> str:
    """Say what ends the set where steps become too short to go on."""
    if complement(manifold.e, reach) < EQUATOR_GAP:
        return "equator"
    det = float(np.linalg.det(_unit_slopes(manifold, manifold.e, manifold.z)))
    return "fold" if abs(det) < AT_FOLD else "given up"


def _critical_set_at(manifold: SlowManifold, step: Step, u: float) -> tuple[Array | None, Array]:
    """Return the critical set, None where there is none, and z at a fraction of a step."""
    z = step.at(u)[2:]
    e = manifold.at(z)
    if e is None:
        at, there = _track_slow_manifold(SlowManifold(manifold.field, manifold.e, manifold.z), step, u, LEAST_PART * u)
        return (there.e if at == u else None), z
    return e, z


def _first_negative(
    gauge: Callable[[Array, Array], float],
    place: Callable[[float], tuple[Array | None, Array]],
    start: float,
    end: float,
) -> float | None:
    """Fraction of a step at which a gauge first turns negative, whatever it is at its end; None if it does not."""

    def value(u: float, missing: float = math.nan) -> float:
        if u in (0.0, 1.0):  # near a fold the search may find there the other set
            return start if u == 0.0 else end
        e, z = place(u)
        return missing if e is None else gauge(e, z)

    positive = None
    for u, at in zip(*monotone_fractions(value, start, end, GAUGE_DEGREES), strict=True):
        if at > 0.0:
            positive = u
        elif at < 0.0 and positive is not None:
            return root_between(lambda part: value(part, -1.0), positive, u, 1e-15)
    return 0.0 if start <= 0.0 and end < 0.0 else None  # began on the border itself, and stays outside


def last_fraction(holds: Callable[[Array], bool], step: Step, halvings: int) -> float:
    """Return the last fraction of a step, to so many halvings, at which something holds of z."""
    low, high = 0.0, 1.0
    for _ in range(halvings):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if holds(step.at(middle)[2:]) else (low, middle)
    return low


CYCLE_RTOL, CYCLE_ATOL = 1e-6, 1e-8  # no better than the cycles themselves are known
CYCLE_DIFFERENCE_STEP = 1e-4
#: Of the time in which z changes by its own size: the first step; steps so short that the cycle ends.
FIRST_CYCLE_STEP, MIN_CYCLE_STEP = 0.05, 1e-6
OTHER_CYCLE_DISTANCE = 0.2  # in the disc: a cycle whose middle has moved further is another


def slide_on_cycle(
    system: AnySystem, psi: Psi, index: int, t: float, z: Array, t_end: float, most: int
) -> Slide | None:
    """Follow the averaged slow flow of a general system from z (m,); None if no such cycle is found there."""
    means: list[tuple[Array, Array]] = []
    m, there = len(z), limit_cycles(system, psi, tuple(z.tolist()))
    if index >= len(there):
        return None
    first = there[index]
    middle = _centroid(first)

    def near(at: Array) -> LimitCycle | None:
        """Return the stable cycle at another z that is nearest to the last one, if it may be the same."""
        stable = [cycle for cycle in limit_cycles(system, psi, tuple(at.tolist())) if cycle.stable]
        cycle = min(stable, key=lambda cycle: math.dist(_centroid(cycle), middle), default=None)
        return None if cycle is None or math.dist(_centroid(cycle), middle) > OTHER_CYCLE_DISTANCE else cycle

    def rate(at: Array) -> Array:
        cycle = near(at) if np.isfinite(at).all() else None
        return np.full(m, math.nan) if cycle is None else np.array(cycle.slow_flow)

    def note(at: Array) -> None:
        nonlocal middle
        cycle = near(at)
        if cycle is not None:
            middle = _centroid(cycle)
            means.append(_means(system, psi, at, cycle))

    def slopes(at: Array) -> Array:
        note(at)  # once where a step begins
        here, columns = rate(at), []
        for i, h in enumerate(CYCLE_DIFFERENCE_STEP * (1.0 + np.abs(at))):
            columns.append((rate(at + h * (np.arange(m) == i)) - here) / h)
        return np.nan_to_num(np.stack(columns, axis=-1))

    floor = CYCLE_ATOL / CYCLE_RTOL
    pace = min(t_end - t, own_time(z, np.array(first.slow_flow), floor))
    motion = steps_of_z(
        rate, slopes, (t, t_end), z, CYCLE_RTOL, floor, most,
        h=FIRST_CYCLE_STEP * pace, least=MIN_CYCLE_STEP * pace, implicit=True,
    )  # fmt: skip
    taken, end = list[Step](), "time"
    try:
        for part in motion.chunks(most):
            taken += part
        note(motion.y[2:])
    except TooManyStepsError:
        end = "cycle"
    e, p = ([own[k] for own in means] for k in range(2))
    return Slide(taken, end, e[-1] if e else np.array(middle), e, motion.evaluations, p=p)


def _centroid(cycle: LimitCycle) -> tuple[float, float]:
    x, y = cycle.points.mean(axis=0).tolist()
    return x, y


def _means(system: AnySystem, psi: Psi, z: Array, cycle: LimitCycle) -> tuple[Array, Array]:
    """Means of e and of p over a cycle in the time of kappa_2, by the trapezoidal rule over its points."""
    p = cycle.points
    r2 = (p * p).sum(axis=1)
    height = np.sqrt(np.maximum(1.0 - r2, 1e-300))
    x2 = p / height[:, None]
    zeta = np.hypot(*x2.T)
    e = x2 * (psi.modulus(zeta) / np.maximum(zeta, 1e-300))[:, None]
    speed = np.hypot(*system.at(tuple(z.tolist())).U(e).T)
    distance = np.hypot(*(np.roll(x2, -1, axis=0) - x2).T)
    time = distance / np.maximum(speed + np.roll(speed, -1), 1e-300)  # in a unit of its own, as weights are its parts
    weight = 0.5 * (time + np.roll(time, 1)) / time.sum()
    return weight @ e, weight @ p
