"""By how much an unstable branch of one saddle and a stable one of another, or of the same, miss each other.

Two saddles A and B lie on opposite sides of the line half-way between them, which an orbit from A to B crosses; a loop
of one saddle goes round a critical set F that is none, and crosses the ray from F away from it. A cycle through the
equator goes round F as well (`cycles.heteroclinic_cycle`). The places where both
branches first cross have a signed distance. It is zero only if the branches are one orbit, and if this
crosses just once it is zero then: a connection that crosses several times is not seen.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ....portrait.cycles.heteroclinic_cycle import loop_gap
from ....portrait.cycles.ray_section import HeteroclinicArc, heteroclinic_arcs
from ....portrait.layer_problem.problem import LayerProblem
from ....results.arrays import Array
from ....systems.frozen import FrozenSystem
from ....systems.psi.function import Psi
from ...continuation.section_base import correct_zero, e_at, hemisphere_place
from ...families.family import SystemFamily
from .saddles import RTOL, Branch

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
