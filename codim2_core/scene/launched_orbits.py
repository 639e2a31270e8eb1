"""Orbits that somebody launches: each drawn both ways through its seed, with words for where it goes and comes from."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ..portrait.approach_outcomes import Outcome, outcomes_of
from ..portrait.cycles.limit_cycles import cycles_of
from ..portrait.layer_problem.critical import CriticalSet
from ..portrait.layer_problem.hemisphere import outside_flow
from ..portrait.layer_problem.problem import LayerProblem, found_once
from ..portrait.omega_limits import (
    AT_SADDLE,
    CAPTURE,
    OmegaLimit,
    critical_label,
    drawn_time,
    nearest,
    omega_limits,
    radially_neutral_ones,
)
from ..portrait.orbits.result import Status, Trajectories
from ..portrait.orbits.seeds import ring, structured_seeds, window_seeds
from ..portrait.orbits.trajectories import Orbits, concatenate, continuation, drawn_duration, is_stiff, trajectories
from ..results.arrays import Array
from ..results.result import Pictured
from ..results.tables import html_table, point
from ..results.words import say
from ..systems.frozen import FrozenSystem
from ..systems.kinds import AnySystem
from ..systems.psi import constructors
from ..systems.psi.function import Psi


class SceneSetting(Protocol):
    """The checked parameters of a `Scene`, of which each layer reads some, and its layer problem."""

    system: AnySystem
    psi: Psi
    z: tuple[float, ...]
    seeds: NDArray[np.float64] | None
    count: int
    launch: NDArray[np.float64]
    t_max: float | None
    length: float
    rtol: float
    atol: float
    view: float
    pixel: float
    window: tuple[float, float, float, float] | None
    cut: float
    coefficients: FrozenSystem
    problem: LayerProblem


SEED_RADIUS = 0.05  # radius of the seeds around an unstable critical set
MAX_HALF_STEPS = 780  # of half a drawn orbit: one that goes round a weak focus for longer is not waited for
DRAWN_CAPTURE = 0.25  # of a pixel: where a drawn trajectory ends, so near its equilibrium that nobody can see the rest


def seeds_of(setting: SceneSetting, outside: bool) -> np.ndarray:
    """Seeds on the hemisphere, or outside: those that are given, or the usual ones and more in the window."""
    if setting.seeds is not None:
        return _sides(setting.seeds)[outside]
    seeds = _structured_seeds(setting.count, setting.view)[outside]
    if setting.window is None:
        return seeds
    return np.concatenate([seeds, _sides(window_seeds(setting.count // 2, setting.window))[outside]])


def _sides(seeds: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the seeds on the hemisphere, and those outside or on the equator."""
    outside = np.hypot(seeds[:, 0], seeds[:, 1]) >= 1.0
    return seeds[~outside], seeds[outside]


@lru_cache(maxsize=32)
def _structured_seeds(count: int, view: float) -> tuple[np.ndarray, np.ndarray]:
    return _sides(structured_seeds(count, view))


@found_once()
def _pace(problem: LayerProblem) -> tuple[float, bool]:
    """Return for how long orbits are followed, and whether they creep, on the hemisphere."""
    return drawn_duration(problem.at, problem.equator, problem.critical), is_stiff(problem.equator, problem.critical)


@found_once(of_psi=False)
def _pace_outside(problem: LayerProblem) -> tuple[float, bool]:
    """Return the same outside, where critical sets have no say."""
    return drawn_duration(problem.at, problem.equator), is_stiff(problem.equator)


def _stepping_options(setting: SceneSetting, outside: bool = False) -> dict[str, Any]:
    duration, stiff = (_pace_outside if outside else _pace)(setting.problem)
    return {
        "t_max": duration if setting.t_max is None else setting.t_max,
        "length": setting.length,
        "rtol": setting.rtol,
        "atol": setting.atol,
        "view": setting.view,
        "pixel": setting.pixel,
        "capture": DRAWN_CAPTURE * setting.pixel,
        "step_limit": MAX_HALF_STEPS,
        "stiff": stiff,
    }


def orbit_starts(setting: SceneSetting, outside: bool) -> np.ndarray:
    """Return the starting points of drawn orbits: the seeds, and points around what they would not leave."""
    seeds = seeds_of(setting, outside)
    if outside or setting.seeds is not None or not setting.count:
        return seeds
    # What leaves an unstable critical set (to a limit cycle, in Case III) starts nearer to it than any fixed seed.
    unstable = [C for C in setting.problem.critical if C.kind.startswith(("unstable", "centre"))]
    rings = [C.p + ring(SEED_RADIUS, 6) for C in unstable]
    return np.concatenate([seeds, *(r for r in rings if np.hypot(r[:, 0], r[:, 1]).max() < 1.0)])


def orbits(setting: SceneSetting, outside: bool) -> Orbits:
    """Whole orbits through the seeds, on the hemisphere or outside."""
    seeds, options = orbit_starts(setting, outside), _stepping_options(setting, outside)
    # Outside, e is the direction itself: Psi has no say, and Psi = 1 is cheapest.
    psi = constructors.constant() if outside else setting.psi
    backward, forward = [
        trajectories(setting.coefficients, psi, seeds, backward=back, **options) for back in (True, False)
    ]
    return Orbits(backward, forward)


def continuations(setting: SceneSetting) -> Trajectories:
    """Integrate up the hemisphere from each limit direction along which an open set of trajectories arrives."""
    equator = setting.problem.equator
    decided = ~np.array(radially_neutral_ones(equator), bool)  # where it is not, what rises does so for ever
    arriving = equator.theta[decided & (equator.lambda_rho < 0.0) & (equator.lambda_theta < 0.0)]
    return continuation(setting.coefficients, setting.psi, arriving, **_stepping_options(setting))


RTOL = 1e-9
MAX_WINDING_LENGTH = 40.0  # picture units drawn of an orbit that winds
EXTENSION_FACTOR = 30.0  # how many times longer than it is drawn an orbit is followed to see where it ends
CUT = (Status.LENGTH, Status.T_MAX)  # drawn lines that have not ended
LOST = 1e-9  # rho below which a drawn point |p| = 1 + rho does not tell it, and that takes no time to speak of


@dataclass(frozen=True)
class LimitSet:
    """The limit set of an orbit, forward or backward in time."""

    label: str  # "C" (or "C1", ...), "Q1", ..., "cycle 1", "equator", "away" (it leaves the view) or "undecided"
    onto: str | None  # for an orbit from outside that reaches Sigma: what it slides on, or leaves along, then
    # for an orbit from outside that reaches Sigma: the time t of (2.7) until then (before the seed: since then).
    # None where the line ends before, as it winds for too long
    after: float | None
    sentence: str


@dataclass(frozen=True, eq=False)
class LaunchedOrbits(Pictured):
    """Orbits through given points of the picture."""

    orbits: Orbits
    goes: tuple[LimitSet, ...]
    comes: tuple[LimitSet, ...]

    def _repr_svg_(self) -> str | None:
        return super()._repr_svg_() if self.goes else None

    def _tables_(self) -> str:
        starts = [point(line[0]) for line in self.orbits.forward.points]
        fates = [(go.sentence, come.sentence) for go, come in zip(self.goes, self.comes, strict=True)]
        found = [(start, *fate) for start, fate in zip(starts, fates, strict=True)]
        return html_table(("starts at", "goes", "comes"), found) or "<p>no orbit is launched</p>"

    def __len__(self) -> int:
        return len(self.goes)


NO_ORBITS = LaunchedOrbits(Orbits(concatenate([]), concatenate([])), (), ())


def launched_orbits(
    problem: LayerProblem, seeds: Array, *, view: float = 2.0, pixel: float = 1.0 / 180.0
) -> LaunchedOrbits:
    """Follow orbits through seeds (k, 2) of the picture, and say where they go and where they come from."""
    if not len(seeds):
        return NO_ORBITS
    at = problem.at
    time = drawn_time(at, problem.equator)
    back, ahead = (
        _integrate(problem, seeds, t_max=time, backward=back, view=view, pixel=pixel, length=MAX_WINDING_LENGTH)
        for back in (True, False)
    )
    inside = np.hypot(seeds[:, 0], seeds[:, 1]) < 1.0
    fates = []
    for line, backward in ((ahead, False), (back, True)):
        half = _orbits_to_end(problem, line, seeds, EXTENSION_FACTOR * time, view, backward)
        found: list[LimitSet | None] = [None] * len(seeds)
        within = np.flatnonzero(inside).tolist()
        for i, end in zip(within, _endings(problem, half, within, backward), strict=True):
            found[i] = _on_hemisphere(end, problem.critical, backward)
        for i in np.flatnonzero(~inside).tolist():
            arrived = line.status[i] not in CUT or line.ends[i, 2] < LOST
            found[i] = _outside(problem, half, i, _arrival_time(at, line, i) if arrived else None, backward)
        fates.append(tuple(fate for fate in found if fate is not None))
    return LaunchedOrbits(Orbits(back, ahead), *fates)


def _integrate(problem: LayerProblem, seeds: Array, **options: Any) -> Trajectories:
    return trajectories(problem.at, problem.psi, seeds, rtol=RTOL, atol=0.1 * RTOL, capture=CAPTURE, **options)


def _orbits_to_end(
    problem: LayerProblem, line: Trajectories, seeds: Array, time: float, view: float, backward: bool
) -> Trajectories:
    """Return the trajectories with the ends that those cut off would come to, were they drawn on."""
    cut = [i for i, status in enumerate(line.status) if status in CUT]
    if not cut:
        return line
    on = _integrate(problem, seeds[cut], t_max=time, backward=backward, view=view, samples="ends")
    ends, codes = line.ends.copy(), line.codes.copy()
    ends[cut], codes[cut] = on.ends, on.codes
    return Trajectories(line.buffer, line.clock, line.offsets, ends, codes)


def _endings(problem: LayerProblem, lines: Trajectories, which: list[int], backward: bool) -> list[OmegaLimit]:
    """Return where some of the trajectories end; their last points say enough."""
    last = lines.offsets[1:][which] - 1
    ends = Trajectories(
        lines.buffer[last], lines.clock[last], np.arange(len(which) + 1), lines.ends[which], lines.codes[which]
    )
    return omega_limits(
        problem.at,
        problem.psi,
        ends,
        problem.equator,
        problem.critical,
        lambda: cycles_of(problem),
        rtol=RTOL,
        backward=backward,
    )


def _on_hemisphere(end: OmegaLimit, critical: tuple[CriticalSet, ...], backward: bool) -> LimitSet:
    label = end.label
    for i, C in enumerate(critical):
        if label == critical_label(critical, i):
            words = say("comes from a set" if backward else "tends to a set", label=label, kind=_a(C.kind))
            return LimitSet(label, None, None, words)
    if label.startswith("cycle"):
        return LimitSet(label, None, None, say("unwinds" if backward else "winds", label=label))
    if label.startswith("Q"):
        words = say("comes up" if backward else "comes down", label=label, theta=end.angle)
        return LimitSet(label, None, None, words)
    if label == "equator":
        words = say("spirals up" if backward else "spirals down")
        return LimitSet(label, None, None, words)
    return LimitSet("undecided", None, None, say("not followed", why=end.sentence))


def _outside(problem: LayerProblem, half: Trajectories, i: int, after: float | None, backward: bool) -> LimitSet:
    equator = problem.equator
    status = half.status[i]
    if status is Status.LEFT_VIEW:
        return LimitSet("away", None, None, say("comes from outside" if backward else "leaves the picture"))
    if status is Status.ON_EQUATOR:
        return LimitSet("equator", None, None, say("stays on the equator"))
    k, gap = nearest(equator, math.atan2(half.ends[i, 1], half.ends[i, 0])) if len(equator) else (0, math.inf)
    at_saddle = status in CUT and half.ends[i, 2] < AT_SADDLE and gap < AT_SADDLE  # saddles capture nothing
    if (status is Status.ARRIVED and len(equator)) or at_saddle:
        label, theta = f"Q{k + 1}", float(equator.theta[k])
    elif status is Status.SPIRALLED:
        k, label, theta = None, "equator", None
    else:
        return LimitSet("undecided", None, None, say("not followed", why=status.value))
    known: dict[str, object] = {"label": label, "theta": theta, "t": after}
    way = ("" if k is not None else ", in a spiral") + ("" if after is None else ", timed")
    if backward:
        return LimitSet(label, None, after, say("left" + way, **known))
    found = outcomes_of(problem)
    then, onto = _what_follows(found.whole if k is None or found.whole is not None else found.directions[k])
    return LimitSet(label, onto, after, f"{say('reached' + way, **known)} {then}")


def _what_follows(outcome: Outcome | None) -> tuple[str, str | None]:
    if outcome is None or outcome.verdict in ("undecided", "misses"):
        return say("then undecided"), None
    if outcome.verdict == "cross" and outcome.leaving is None:
        return say("then crosses, in a spiral"), outcome.onto
    if outcome.verdict == "cross":
        return say("then crosses", theta=outcome.leaving), outcome.onto
    onto = f"limit {outcome.onto}" if outcome.verdict == "cycle" else outcome.onto
    return say("then slides", onto=onto), outcome.onto


def _a(kind: str) -> str:
    return f"{'an' if kind[0] in 'aeiou' else 'a'} {kind}"


def _arrival_time(at: FrozenSystem, lines: Trajectories, i: int) -> float:
    """Return t = ∫ rho dT along a drawn line outside, to its arrival.

    Between drawn points rho changes almost exponentially in T, for which the integral is
    (rho2 - rho1) dT/log(rho2/rho1). A drawn rho = |p| - 1 below `LOST` has no digits left, and next to the ray of a
    saddle the next point drawn may be e^-100 away: from the last point before, what is left is rho/|lambda_rho|, to
    leading order, or in a spiral rho over the mean rate so far.
    """
    start, stop = lines.offsets[i], lines.offsets[i + 1]
    line, clock = lines.buffer[start:stop], np.abs(lines.clock[start:stop])
    rho = np.hypot(line[:, 0], line[:, 1]) - 1.0
    rho[-1] = lines.ends[i, 2]
    lost = np.flatnonzero(rho < LOST)
    known = slice(0, max(int(lost[0]), 1) if len(lost) else None)
    line, rho, clock = line[known], rho[known], clock[known]
    steps, ratio = np.diff(clock), np.log(rho[1:] / rho[:-1])
    flat = np.abs(ratio) < 1e-8
    mean = np.where(flat, 0.5 * (rho[1:] + rho[:-1]), np.diff(rho) / np.where(flat, 1.0, ratio))
    if lines.status[i] is Status.SPIRALLED:
        rate = math.log(rho[0] / rho[-1]) / float(clock[-1])
    else:
        rate = abs(float(outside_flow(at, math.atan2(line[-1, 1], line[-1, 0]))[0]))
    return float((mean * steps).sum() + (rho[-1] / rate if rate > 0.0 else 0.0))
