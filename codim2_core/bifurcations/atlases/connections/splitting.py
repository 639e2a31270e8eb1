"""By how much an unstable branch of one saddle and a stable one of another, or of the same, miss each other.

Two saddles A and B lie on opposite sides of the line half-way between them, which an orbit from A to B crosses; a loop
of one saddle goes round a critical set F that is none, and crosses the ray from F away from it. A cycle through the
equator goes round F as well (`cycles.heteroclinic_cycle`). The places where both
branches first cross have a signed distance. It is zero only if the branches are one orbit, and if this
crosses just once it is zero then: a connection that crosses several times is not seen.

Branches of saddles of the layer problem: followed over the plane of two parameters, and followed as orbits.

A saddle is a critical set, with two branches either way, or a half-saddle of the equator, with one (Theorem 3.1(b)):
its branch leaves up the hemisphere where both its eigenvalues are negative, and enters where both are positive.

An orbit that follows a branch of a critical set begins on its tangent, at a distance `START_DISTANCE`: its error
across the branch is the square of that, and fades; how far along it begins is but a matter of time.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ....numerics.arclength import newton
from ....portrait.cycles.heteroclinic_cycle import loop_gap
from ....portrait.cycles.ray_section import HeteroclinicArc, heteroclinic_arcs
from ....portrait.layer_problem.critical import CriticalSet, set_at
from ....portrait.layer_problem.eigendirections import to_disc
from ....portrait.layer_problem.problem import LayerProblem
from ....portrait.orbits.trajectories import Trajectories, continuation, trajectories
from ....results.arrays import Array
from ....systems.frozen import FrozenSystem
from ....systems.psi.function import Psi
from ...continuation.turns import correct_zero, e_at, hemisphere_place
from ...families.family import SystemFamily

RTOL, ROUGH_RTOL = 1e-12, 1e-7  # of branches, and of those that are drawn alone
START_DISTANCE = 1e-6  # in units of hypot(1, |x2|)
MAX_BRANCH_LENGTH, MAX_BRANCH_TIME = 5.0, 1e4  # how far they are followed, in the disc and in T of 1/max |U|
#: Of their lines: the first, but finer for what is small, of its size.
LINE_PIXEL, RELATIVE_PIXEL, MIN_PIXEL = 5e-4, 1e-3, 1e-8
SAME_SADDLE_DISTANCE = 1e-6  # in the disc: found twice
ANGLE_TOLERANCE = 3e-7  # last step of Newton's method for theta: its error is the square
MAX_SADDLE_SHIFT = 0.1  # the way to a saddle's next place


@dataclass(frozen=True, eq=False)
class Branch:
    """One branch of a saddle at one place of the plane."""

    at: FrozenSystem
    psi: Psi  # what it is a branch of
    backward: bool  # it enters the saddle
    p: Array  # (2,) The saddle, in the projected disc
    way: Array  # (2,) Unit tangent there, away from it; zero of a half-saddle, whose branch goes straight up
    start: Array  # (2,) Where the orbit begins that follows it from a critical set
    critical: CriticalSet | None
    theta: float  # of a half-saddle
    ratio: float  # of its eigenvalues: that by which orbits enter over that by which they leave

    @property
    def signature(self) -> Array:
        """Return four numbers (4,) by which branches differ."""
        return np.concatenate([self.p, self.way])

    def among(self, others: Sequence[Branch]) -> list[int]:
        """Return which of others, at a place nearby, belong to the same saddle, by its critical set or theta."""
        if not others:
            return []
        at = others[0].at
        if self.critical is None:
            theta = _zero_of_theta(at, self.theta)
            return [
                i
                for i, one in enumerate(others)
                if abs(math.remainder(one.theta - theta, 2.0 * math.pi)) < SAME_SADDLE_DISTANCE
            ]
        e = correct_zero(at, self.critical.e)
        sets = [one.critical for one in others]
        return (
            []
            if e is None
            else [i for i, C in enumerate(sets) if C is not None and math.dist(C.e, e) < SAME_SADDLE_DISTANCE]
        )

    def same_saddle(self, other: Branch) -> bool:
        """Whether both belong to one saddle, at one place of the plane."""
        return math.dist(self.p, other.p) < SAME_SADDLE_DISTANCE

    def followed(self, at: FrozenSystem, psi: Psi) -> Branch | None:
        """Return the same branch of another system nearby; None where its saddle is none any more."""
        if self.critical is None:
            return _half_saddle(at, psi, _zero_of_theta(at, self.theta), self.backward)
        e = correct_zero(at, self.critical.e)
        if e is None:
            return None
        C = set_at(at, psi, e)
        found = _branches_of(at, psi, C, self.backward) if C.kind == "saddle" else ()
        return max(found, key=lambda one: float(one.way @ self.way), default=None)

    def line(self, scale: float) -> tuple[Array, Array]:
        """Follow it as a line (m, 2) that can be drawn, of the size `scale`, with the time (m,) at each point."""
        # where an orbit rises from the equator depends on the tolerance: times must have one beginning
        found = _integrate_branches([self], RTOL if self.critical is None else ROUGH_RTOL, scale)
        return found.points[0], np.abs(found.times[0])

    def state(self, time: float) -> Array:
        """Follow it to a time, to all digits: (p, ebar)."""
        return np.array(_integrate_branches([self], RTOL, t_max=time).ends[0])


def lines_of(found: Sequence[Branch], scale: float) -> list[Array]:
    """Lines of some branches of one layer problem, as `Branch.line`."""
    out: list[Array] = [np.zeros((0, 2))] * len(found)
    for backward in (False, True):
        ours = [i for i, one in enumerate(found) if one.backward == backward]
        ours.sort(key=lambda i: found[i].critical is not None)  # as `_integrate_branches` has them
        if ours:
            for i, line in zip(
                ours, _integrate_branches([found[i] for i in ours], ROUGH_RTOL, scale).points, strict=True
            ):
                out[i] = line
    return out


def _integrate_branches(
    ours: Sequence[Branch], rtol: float, scale: float = 1.0, t_max: float | None = None
) -> Trajectories:
    """Follow branches of one layer problem, all leaving or all entering, half-saddles first."""
    one = ours[0]
    options: dict[str, Any] = {
        "rtol": rtol, "atol": 0.1 * rtol, "backward": one.backward, "length": MAX_BRANCH_LENGTH,
        "pixel": min(max(RELATIVE_PIXEL * scale, MIN_PIXEL), LINE_PIXEL),
        "t_max": MAX_BRANCH_TIME / one.at.speed if t_max is None else t_max,
        "samples": None if t_max is None else "ends",
    }  # fmt: skip
    thetas = [one.theta for one in ours if one.critical is None]
    starts = np.array([one.start for one in ours if one.critical is not None]).reshape(-1, 2)
    if not thetas:
        return trajectories(one.at, one.psi, starts, **options)
    return continuation(one.at, one.psi, thetas, more_starts=starts if len(starts) else None, **options)


def branches(problem: LayerProblem) -> list[Branch]:
    """All branches of the saddles of a layer problem, on the hemisphere."""
    found: list[Branch] = []
    for C in problem.critical:
        if C.kind == "saddle":
            found += [one for backward in (False, True) for one in _branches_of(problem.at, problem.psi, C, backward)]
    equator = problem.equator
    for i, theta in enumerate(equator.theta.tolist()):
        if equator.multiplicity[i] == 1 and not equator.radially_degenerate[i]:
            rim = _half_saddle(problem.at, problem.psi, theta, bool(equator.lambda_rho[i] > 0.0))
            found += [rim] if rim is not None else []
    return found


def _eigenvalue(C: CriticalSet, backward: bool) -> float:
    return float(C.eigenvalues.real[1 if backward else 0])


def _branches_of(at: FrozenSystem, psi: Psi, C: CriticalSet, backward: bool) -> list[Branch]:
    rows = C.jacobian - _eigenvalue(C, backward) * np.eye(2)
    row = rows[int(np.argmax(np.hypot(*rows.T)))]  # the eigenvector is across it
    vector = np.array([-row[1], row[0]]) / math.hypot(*row)
    tangent = np.array(to_disc(C.x2, (float(vector[0]), float(vector[1]))))
    out, into = C.eigenvalues.real.tolist()
    found = []
    for sign in (1.0, -1.0):
        x2 = C.x2 + sign * START_DISTANCE * math.hypot(1.0, *C.x2) * vector
        start = x2 / math.hypot(1.0, *x2)
        found.append(Branch(at, psi, backward, C.p, sign * tangent, start, C, math.nan, -into / out))
    return found


def _zero_of_theta(at: FrozenSystem, start: float) -> float:
    """Newton's method for Theta = 0; NaN if it is not found nearby."""

    def turning(v: Array) -> tuple[Array, Array]:
        e, t, U, D = _equator_saddle(at, float(v[0]))
        return np.array([t @ U]), np.array([[t @ D @ t - e @ U]])

    found = newton(turning, np.array([start]), MAX_SADDLE_SHIFT, ANGLE_TOLERANCE)
    return math.nan if found is None else float(found[0])


def _equator_saddle(at: FrozenSystem, theta: float) -> tuple[Array, Array, Array, Array]:
    e, t = np.array([math.cos(theta), math.sin(theta)]), np.array([-math.sin(theta), math.cos(theta)])
    return e, t, at.U(e), at.DU(e)


def _half_saddle(at: FrozenSystem, psi: Psi, theta: float, backward: bool) -> Branch | None:
    if math.isnan(theta):
        return None
    e, t, U, D = _equator_saddle(at, theta)
    radial = float(e @ U)
    along = float(t @ D @ t) - radial
    if not (radial * along > 0.0 and (radial > 0.0) == backward):
        return None
    return Branch(at, psi, backward, e, np.zeros(2), e, None, theta, radial / along if backward else along / radial)


SAME_ANGLE = 1e-6  # between half-saddles found twice
MAX_CACHE_DISTANCE = 3e-3  # of the square: so far from where it is known a connection is kept
DIFFERENCE_STEP = 1e-6  # of the square
#: Of the way between two places, and of the square: so far derivatives serve.
SLOPE_SHARE, MAX_SLOPE_DISTANCE = 0.2, 1e-3
MAX_NEWTON, CROSSING_TOLERANCE = 5, 1e-8  # of the time of a crossing, in T of 1/max |U|


@dataclass(frozen=True, eq=False)
class Section:
    """A line through a point, or a half of it."""

    origin: Array  # (2,)
    along: Array
    across: Array
    scale: float  # unit of length on it
    half: bool  # of a loop: the half ahead of the origin, on which the coordinate is a logarithm

    def side(self, points: Array) -> Array:
        """Signed distances (...) from it."""
        return np.asarray((points - self.origin) @ self.across)

    def coordinate(self, p: Array) -> float:
        """Return the place of a point on it."""
        at = float((p - self.origin) @ self.along) / self.scale
        return (math.log(at) if at > 0.0 else math.nan) if self.half else at

    def first(self, line: Array) -> tuple[int, float, bool] | None:
        """Return the first piece of a line that crosses it, at which part, and in which sense; None if none does."""
        side = self.side(line)
        rows = np.flatnonzero(side[1:] * side[:-1] < 0.0)
        part = side[rows] / (side[rows] - side[rows + 1])
        if self.half:
            met = line[rows] + part[:, None] * (line[rows + 1] - line[rows])
            ahead = (met - self.origin) @ self.along > 0.0
            rows, part = rows[ahead], part[ahead]
        return (int(rows[0]), float(part[0]), bool(side[rows[0]] < 0.0)) if len(rows) else None


@dataclass(frozen=True, eq=False)
class BranchPair:
    """A branch that leaves a saddle, one that enters one, and of a loop or cycle a critical set (c, s) within.

    A cycle through the equator turns about it in a sense (1 or -1), any other connection in none (0).
    """

    leaving: Branch
    entering: Branch
    foot: Array | None
    sense: int = 0

    def followed(self, at: FrozenSystem, psi: Psi) -> BranchPair | None:
        """Return the same of another system nearby; None where one of them is no more."""
        leaving, entering = self.leaving.followed(at, psi), self.entering.followed(at, psi)
        foot = None if self.foot is None else correct_zero(at, self.foot)
        if leaving is None or entering is None or (foot is None) != (self.foot is None):
            return None
        return BranchPair(leaving, entering, foot, self.sense)

    @cached_property
    def section(self) -> Section | None:
        """Return the line on which both are compared."""
        A, B = self.leaving.p, self.entering.p
        if self.foot is None:
            origin, way = 0.5 * (A + B), B - A
        else:
            origin = hemisphere_place(self.leaving.psi, self.foot).p
            way = origin - A
        scale = math.hypot(*way)
        if scale == 0.0:
            return None
        along = way / scale
        normal = np.array([-along[1], along[0]])
        half = self.foot is not None
        return Section(origin, along if half else normal, normal if half else along, scale, half)

    @property
    def gap(self) -> float:
        """By how much both miss each other, to the digits of the orbits; NaN where one does not cross."""
        section = self.section
        if self.sense:
            return self.cycle_gap(RTOL)
        if section is None:
            return math.nan
        out, back = _first_crossing(self.leaving, section), _first_crossing(self.entering, section)
        if out is None or back is None or out[1] != back[1]:
            return math.nan
        return section.coordinate(out[0]) - section.coordinate(back[0])

    def cycle_gap(self, rtol: float) -> float:
        """Return the gap of a cycle through the equator, bounded: NaN where there is no such cycle."""
        arc = next((one for one in cycle_arcs(self.leaving, self.entering) if one.sense == self.sense), None)
        if arc is None or self.foot is None:
            return math.nan
        at, psi = self.leaving.at, self.leaving.psi
        return math.atan(loop_gap(LayerProblem(at, psi), hemisphere_place(psi, self.foot), arc, rtol))

    @property
    def ratio(self) -> float:
        """Product of the ratios of both saddles, of a loop that of its saddle."""
        return (
            self.leaving.ratio if self.leaving.same_saddle(self.entering) else self.leaving.ratio * self.entering.ratio
        )


def cycle_arcs(leaving: Branch, entering: Branch) -> list[HeteroclinicArc]:
    """Arcs of the equator along which a cycle goes on from where a branch enters to where one leaves."""
    if leaving.critical is not None or entering.critical is not None:
        return []
    arcs = heteroclinic_arcs(LayerProblem(leaving.at, leaving.psi))
    return [
        arc for arc in arcs
        for gaps in [(arc.sink - leaving.theta, arc.source - entering.theta)]
        if max(abs(math.remainder(gap, math.tau)) for gap in gaps) < SAME_ANGLE
    ]  # fmt: skip


def roughly(section: Section, leaving: Array, entering: Array) -> float:
    """Return the splitting as lines tell it; NaN where they do not cross."""
    out, back = section.first(leaving), section.first(entering)
    if out is None or back is None or out[2] == back[2]:  # one is followed against time
        return math.nan
    places = [line[i] + part * (line[i + 1] - line[i]) for line, (i, part, _) in ((leaving, out), (entering, back))]
    return section.coordinate(places[0]) - section.coordinate(places[1])


class Splitting:
    """The splitting of one pair over the plane."""

    def __init__(self, family: SystemFamily, place: Array, pair: BranchPair) -> None:
        self.family = family
        self._known = [(np.array(place, float), pair)]
        self._slope = np.full(2, math.nan), np.zeros((1, 2)), 0.0  # where it was computed, and how far it serves

    def pair(self, place: Array) -> BranchPair | None:
        """Return the pair at a place; None where it is no more."""
        nearest = min(self._known, key=lambda one: math.dist(one[0], place))
        try:
            pair = nearest[1].followed(self.family.frozen(place), self.family.psi_at(place))
        except ValueError:  # beyond what is allowed
            return None
        if pair is not None and math.dist(nearest[0], place) > MAX_CACHE_DISTANCE:
            self._known.append((np.array(place), pair))
        return pair

    def gap(self, place: Array) -> float:
        """Return the signed distance, to the digits of the orbits; NaN where a branch does not cross."""
        pair = self.pair(place)
        return math.nan if pair is None else pair.gap

    def condition(self, place: Array) -> tuple[Array, Array]:
        """Return the splitting, with derivatives that tell the way and not the place."""
        here = self.gap(place)
        if not math.isfinite(here):
            return np.full(1, math.nan), np.full((1, 2), math.nan)
        where, slope, reach = self._slope
        if not math.dist(where, place) < reach:  # a step further: the corrections of one point share it
            rows = [(self.gap(place + way) - here) / DIFFERENCE_STEP for way in DIFFERENCE_STEP * np.eye(2)]
            slope, reach = np.array([rows]), min(SLOPE_SHARE * math.dist(where, place), MAX_SLOPE_DISTANCE)
            self._slope = place.copy(), slope, reach if math.isfinite(reach) else 0.0
        return np.array([here]), slope


def _first_crossing(branch: Branch, section: Section) -> tuple[Array, bool] | None:
    """Return where a branch first crosses a section, and in which sense as time goes on."""
    at, psi = branch.at, branch.psi
    line, times = branch.line(section.scale)
    first = section.first(line)
    if first is None:
        return None
    i, part, upwards = first
    state = branch.state(max(float(times[i] + part * (times[i + 1] - times[i])), 1e-300))
    for _ in range(MAX_NEWTON):
        rate = float(_layer_velocity(at, psi, state)[:2] @ section.across)
        step = -float(section.side(state[:2])) / rate if rate else math.inf
        if not abs(step) * at.speed < 1.0:
            return None
        state = _runge_kutta_step(at, psi, state, step)
        if abs(step) * at.speed < CROSSING_TOLERANCE:  # its error is the square
            return state[:2], upwards != branch.backward
    return None


def _layer_velocity(at: FrozenSystem, psi: Psi, state: Array) -> Array:
    """(p, ebar)' by T."""
    p, w = state[:2], float(state[2])
    U = at.U(e_at(psi, p / w))
    outward = float(p @ U)
    return np.append(U - p * outward, -w * outward)


def _runge_kutta_step(at: FrozenSystem, psi: Psi, y: Array, h: float) -> Array:
    """One step of the classical Runge-Kutta method."""
    a = _layer_velocity(at, psi, y)
    b = _layer_velocity(at, psi, y + 0.5 * h * a)
    c = _layer_velocity(at, psi, y + 0.5 * h * b)
    return np.asarray(y + h / 6.0 * (a + 2.0 * b + 2.0 * c + _layer_velocity(at, psi, y + h * c)))
