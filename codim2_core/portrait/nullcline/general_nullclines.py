"""Nullclines of a general system as branches: rho' = 0, theta' = 0, U1 = 0 and U2 = 0.

Branches begin at e = 0, at the zeros on the equator, which are known with proof, and at crossings
(`crossings`); they are followed (`trace_nullcline`) to where they end. What a net of the disc still shows as
sign changes belongs to closed loops. Where branches cross, each goes straight on. A loop smaller than a cell of the
net, and a curve that a component touches without a change of sign, are not found.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ...formulas.arrays import Program, program
from ...numerics.fourier_zeros import series, zeros
from ...results.arrays import Array
from ...systems.frozen import FrozenSystem
from ..layer_problem.equator_zeros import component_zeros, directions

# Find where the branches of one nullcline cross each other, or come so close that they seem to.
#
# At a crossing the component and its gradient vanish. On a small circle around it the component changes sign once for
# each half-branch; with 2 k of them, half-branch i goes straight on as i + k.
RADIUS, MIN_RADIUS = 0.02, 1e-3  # of the circle, in units of the disc
CROSSING_DISTANCE = 1e-4  # branches that pass each other at this distance are drawn as crossing: a fiftieth of a pixel
CIRCLE_SAMPLES = 32  # on a circle
OBLIQUE = 0.35  # radians by which half-branches may miss going straight on, or leaving along the radius
MAX_CELLS = 300  # with more, the field is not smooth on the scale of the net
MAX_CROSSINGS = 64  # crossings
NEAR_BORDER = 1e-3


@dataclass(frozen=True, eq=False)
class Crossing:
    """Branches that cross."""

    circle: Array  # (3,) Middle and radius
    angles: Array  # (2 k,) Of the half-branches where they meet the circle, increasing

    def nearest(self, point: Array) -> int:
        """Index of the half-branch through a point on the circle."""
        angle = math.atan2(point[1] - self.circle[1], point[0] - self.circle[0])
        return int(np.abs(np.remainder(self.angles - angle + math.pi, 2.0 * math.pi) - math.pi).argmin())

    def opposite(self, i: int) -> int:
        """Index of the half-branch that goes straight on."""
        k = len(self.angles)
        return (i + k // 2) % k

    def start(self, i: int) -> Array:
        """Return the point on the circle where half-branch i leaves it, with the direction away from the middle."""
        u = np.array([math.cos(self.angles[i]), math.sin(self.angles[i])])
        return np.concatenate([self.circle[:2] + self.circle[2] * u, u])


def crossings(
    run: Program, kind: int, outside: bool, reach: float, nodes: Array, parts: Array, size: float
) -> list[Crossing]:
    """All crossings of one component: nodes (n, m, 2), parts (3, n, m)."""
    from .trace_nullcline import flat_cells, stationary  # on first use: it loads the compiler

    width = float(np.abs(nodes[1:, 1:] - nodes[:-1, :-1]).max())
    i, j = np.nonzero(flat_cells(parts, width))
    found: list[Crossing] = []
    if len(i) > MAX_CELLS:
        return found
    for middle in 0.5 * (nodes[i, j] + nodes[i + 1, j + 1]):
        if any(math.hypot(*(middle - other.circle[:2])) < 0.5 * width for other in found):
            continue
        ok, X, Y, value = stationary(*run.arrays, kind, outside, middle[0], middle[1], 2.0 * width)
        r = math.hypot(X, Y)
        away = min(r - 1.0, reach - r) if outside else 1.0 - r
        if not ok or abs(value) > 1e-5 * size or away < NEAR_BORDER:
            continue
        between = min((math.dist((X, Y), other.circle[:2]) for other in found), default=math.inf)
        if between < 1e-4:
            continue
        crossing = _crossing_at(run, kind, outside, X, Y, value, size, min(RADIUS, 0.7 * away, 0.4 * between))
        if crossing is not None:
            found.append(crossing)
            if len(found) >= MAX_CROSSINGS:
                break
    return found


_UNIT = np.stack(
    [
        np.cos(np.arange(CIRCLE_SAMPLES) * (2.0 * math.pi / CIRCLE_SAMPLES)),
        np.sin(np.arange(CIRCLE_SAMPLES) * (2.0 * math.pi / CIRCLE_SAMPLES)),
    ],
    axis=-1,
)


def _crossing_at(
    run: Program, kind: int, outside: bool, X: float, Y: float, value: float, size: float, r: float
) -> Crossing | None:
    """Return the crossing at a point where the gradient vanishes, or None if it is none."""
    from .trace_nullcline import sample

    while r >= MIN_RADIUS:
        ring = sample(*run.arrays, outside, np.array([X, Y]) + r * _UNIT)[kind, 0]
        f = series(ring, 2.0 * size)
        around = zeros(f) if f.resolved and not f.vanishes else None
        if around is not None and around.proven:
            angles = around.theta[around.multiplicity % 2 == 1]
            k = len(angles) // 2
            far = r * (abs(value) / float(np.abs(ring).max())) ** (1.0 / max(k, 2))
            if k < 2 or len(angles) % 2 or far > CROSSING_DISTANCE:
                return None
            miss = np.remainder(np.roll(angles, -k) - angles, 2.0 * math.pi) - math.pi
            if np.abs(miss).max() < OBLIQUE:
                return Crossing(np.array([X, Y, r]), angles)
        r *= 0.5
    return None


Kind = Literal["rho", "theta", "U1", "U2"]
NULLCLINE_KINDS: tuple[Kind, ...] = ("rho", "theta", "U1", "U2")  # in the order of the numbers in `trace_nullcline`

NET_CELLS = 48  # of the net along a side
MOST_POINTS = 4000  # of a branch
ALL_POINTS = 30_000  # of the branches of one kind; a picture with more shows no curve any more
ZERO_COMPONENT = 1e-14  # of U: a component this small everywhere is zero, and has no nullcline
#: The net lies off centre: zeros on the axes would fall on its nodes.
NET_LEFT, BELOW, NET_SIDE = -1.0137, -1.0211, 2.047


@dataclass(frozen=True, eq=False, slots=True)
class Traced:
    """A branch as a curve."""

    points: Array  # (n, 2) Between neighbours a cubic with these ends is off by less than 1e-5
    tangents: Array

    @property
    def straight(self) -> bool:
        """Whether the branch is the segment between its ends, to rounding."""
        start, end = self.points[0], self.points[-1]
        along = end - start
        if not along.any():
            return False
        away = self.points - start
        sag = np.abs(away[:, 0] * along[1] - away[:, 1] * along[0])
        return bool(sag.max() <= 1e-12 * (along @ along))

    @property
    def total_turning(self) -> float:
        """Radians through which the tangent turns, without sign."""
        a, b = self.tangents[:-1], self.tangents[1:]
        cross = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
        return float(np.abs(np.arctan2(cross, (a * b).sum(axis=1))).sum())

    def __call__(self, t: Array) -> Array:
        """Points (k, 2) at parameters in [0, 1], which go with the length."""
        P, T = self.points, self.tangents
        length = np.hypot(*(P[1:] - P[:-1]).T)
        at = np.concatenate([[0.0], np.cumsum(length)])
        i = np.clip(np.searchsorted(at, t * at[-1], side="right") - 1, 0, len(length) - 1)
        h = length[i]
        u = (t * at[-1] - at[i]) / np.where(h == 0.0, 1.0, h)
        v = 1.0 - u
        weights = (v * v * (1.0 + 2.0 * u), u * u * (3.0 - 2.0 * u), h * u * v * v, -h * u * u * v)
        parts = (P[i], P[i + 1], T[i], T[i + 1])
        curve = sum(w[:, None] * part for w, part in zip(weights, parts, strict=True))
        # the ends exactly: they are zeros on the equator
        curve = np.where((t <= 0.0)[:, None], P[0], curve)
        return np.where((t >= 1.0)[:, None], P[-1], curve)


def inside_curves(at: FrozenSystem) -> list[tuple[Kind, Traced]]:
    """All branches in the closed e-disc."""
    nodes_c = NET_LEFT + NET_SIDE / NET_CELLS * np.arange(NET_CELLS + 1.0)
    nodes_s = BELOW + NET_SIDE / NET_CELLS * np.arange(NET_CELLS + 1.0)
    points = np.stack(np.meshgrid(nodes_c, nodes_s, indexing="ij"), axis=-1)
    return _trace_branches(at, points, (points**2).sum(axis=-1) < 1.0, nodes_c, nodes_s, 0.0)


def outside_curves(at: FrozenSystem, reach: float) -> list[tuple[Kind, Traced]]:
    """All branches outside, up to that distance from the middle: rays unless U reads x or y."""
    if not at.reads_position:
        rays: list[tuple[Kind, Traced]] = []
        for kind in NULLCLINE_KINDS:
            for u in directions(component_zeros(at.key, kind)[0]):
                rays.append((kind, Traced(np.stack([u, reach * u]), np.stack([u, u]))))  # noqa: PERF401 (type of kind)
        return rays
    radii = np.linspace(1.0, reach, NET_CELLS + 1)
    angles = 1e-3 + 2.0 * math.pi * np.arange(4 * NET_CELLS + 1) / (4 * NET_CELLS)
    points = radii[:, None, None] * directions(angles)
    return _trace_branches(at, points, np.ones(points.shape[:2], bool), radii, angles, reach)


def _trace_branches(
    at: FrozenSystem, points: Array, usable: NDArray[np.bool_], first: Array, second: Array, reach: float
) -> list[tuple[Kind, Traced]]:
    """Branches of all kinds, on a net of the inside (reach 0) or of the outside."""
    from .trace_nullcline import sample  # on first use: it loads the compiler

    run = program(at.key)
    parts = sample(*run.arrays, reach > 0.0, points.reshape(-1, 2)).reshape(4, 3, *points.shape[:2])
    nets = [_Net(values, usable, first, second) for values in parts[:, 0]]
    size = max(at.size, *(net.largest for net in nets))  # what reads x or y may vanish on Sigma, and not outside
    found: list[tuple[Kind, Traced]] = []
    for number, (kind, net) in enumerate(zip(NULLCLINE_KINDS, nets, strict=True)):
        if net.largest <= ZERO_COMPONENT * size:
            continue
        met = crossings(run, number, reach > 0.0, reach, points, parts[number], size)
        for branch in _Tracer(at.key, run, size, kind, net, reach, met).branches():
            found.append((kind, branch))  # noqa: PERF401 (a comprehension loses the type of kind)
    return found


_NEIGHBOURS = np.array([(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1)])


class _Net:
    """Cells of a net in which a component changes sign and that no branch has passed yet."""

    def __init__(self, values: Array, usable: NDArray[np.bool_], first: Array, second: Array) -> None:
        positive = (values > 0.0).astype(np.int8)
        corners = positive[:-1, :-1] + positive[1:, :-1] + positive[:-1, 1:] + positive[1:, 1:]
        usable = usable & np.isfinite(values)
        whole = usable[:-1, :-1] & usable[1:, :-1] & usable[:-1, 1:] & usable[1:, 1:]
        self.largest = float(np.abs(values[usable]).max(initial=0.0))
        self.open = (corners > 0) & (corners < 4) & whole
        self.first, self.second = first, second
        self.steps = np.array([first[1] - first[0], second[1] - second[0]])
        self.polar = len(second) > len(first)

    def _cell(self, points: Array) -> NDArray[np.int64]:
        if self.polar:
            angle = np.remainder(np.arctan2(points[:, 1], points[:, 0]) - self.second[0], 2.0 * math.pi)
            places = np.stack([np.hypot(*points.T) - self.first[0], angle], axis=-1)
        else:
            places = points - (self.first[0], self.second[0])
        return np.floor(places / self.steps).astype(np.int64)

    def close_along(self, branch: Traced) -> None:
        """Close the cells along a branch, and their neighbours: a step of the branch is no longer than a cell."""
        i, j = (self._cell(branch.points)[:, None, :] + _NEIGHBOURS).reshape(-1, 2).T
        if self.polar:
            j = j % self.open.shape[1]
        ok = (i >= 0) & (i < self.open.shape[0]) & (j >= 0) & (j < self.open.shape[1])
        self.open[i[ok], j[ok]] = False

    def seeds(self) -> Iterator[tuple[Array, float]]:
        """Middles of open cells, one after another, with the size of a cell; a cell that has been yielded is closed."""
        while True:
            left = np.argwhere(self.open)
            if not len(left):
                return
            i, j = left[0]
            self.open[i, j] = False
            first, second = self.first[i] + 0.5 * self.steps[0], self.second[j] + 0.5 * self.steps[1]
            if self.polar:
                yield first * directions(np.array([second]))[0], float(max(self.steps[0], first * self.steps[1]))
            else:
                yield np.array([first, second]), float(self.steps.max())


class _Tracer:
    """Traces the branches of one kind: from the equator, from crossings, then from what else the net shows."""

    def __init__(
        self, key: Hashable, run: Program, size: float, kind: Kind, net: _Net, reach: float, met: list[Crossing]
    ) -> None:
        self.run, self.size, self.kind, self.net, self.reach = run, size, NULLCLINE_KINDS.index(kind), net, reach
        self.outside = reach > 0.0
        angles, multiplicity = component_zeros(key, kind)
        self.ends = directions(angles[multiplicity % 2 == 1])
        self.waiting = np.ones(len(self.ends), bool)
        self.met = met
        self.circles = np.array([c.circle for c in met]).reshape(-1, 3)
        self.unseen = [np.ones(len(c.angles), bool) for c in met]
        self.found: list[Traced] = []

    def branches(self) -> list[Traced]:
        """All of them, but no more than make a picture."""
        if not self.outside and self.kind < 2:  # e.U and its like vanish at e = 0: a loop through it may be small
            start = self._project(np.zeros(2), 1e-6)
            if start is not None and not self._at_crossing(start):
                self._both_ways(start)
        for i, u in enumerate(self.ends):
            if not self.waiting[i] or self._enough():
                continue
            self.waiting[i] = False
            start = self._project(u, 0.01)
            if start is not None:
                start[:2] = u
                outwards = start[2] * u[0] + start[3] * u[1] > 0.0
                self._add(self._trace_curve(start if outwards == self.outside else _reverse_tangents(start))[0])
        for which, crossing in enumerate(self.met):
            for i in range(len(crossing.angles)):
                if self.unseen[which][i] and not self._enough():
                    self._trace_half_branch(which, i)
        for middle, cell in self.net.seeds():
            if self._enough():
                break
            start = self._project(middle, 2.0 * cell)
            if start is None:
                continue
            r = math.hypot(start[0], start[1])
            within = 1.0 <= r <= self.reach if self.outside else r <= 1.0
            if within and not self._at_crossing(start) and np.abs(start[:2] - middle).max() <= cell:
                self._both_ways(start)
        self._join()
        return self.found

    def _join(self) -> None:
        """Let ends meet that have come as near to each other as can be followed: where U vanishes to second order."""
        ends = np.array([branch.points[i] for branch in self.found for i in (0, -1)])
        border = np.abs(np.hypot(*ends.T) - 1.0) < 1e-12 if len(ends) else np.zeros(0, bool)
        for i in np.flatnonzero(~border).tolist():
            gaps = np.hypot(*(ends - ends[i]).T)
            gaps[i] = math.inf
            j = int(gaps.argmin())
            if not border[j] and 0.0 < gaps[j] < CROSSING_DISTANCE:
                ends[[i, j]] = 0.5 * (ends[i] + ends[j])
                for k in (i, j):
                    self.found[k // 2].points[-(k % 2)] = ends[k]

    def _enough(self) -> bool:
        return sum(len(branch.points) for branch in self.found) > ALL_POINTS

    def _at_crossing(self, start: Array) -> bool:
        away = np.hypot(self.circles[:, 0] - start[0], self.circles[:, 1] - start[1])
        return bool((away < self.circles[:, 2]).any())

    def _project(self, point: Array, reach: float) -> Array | None:
        """Return the point of the curve nearest to another, with its tangent."""
        from .trace_nullcline import settle

        ok, X, Y, tx, ty = settle(*self.run.arrays, self.kind, self.outside, point[0], point[1], reach, self.size)
        return np.array([X, Y, tx, ty]) if ok else None

    def _both_ways(self, start: Array) -> None:
        rows, closed = self._trace_curve(start)
        if not closed:
            back, _ = self._trace_curve(_reverse_tangents(start))
            rows = np.concatenate([_reverse_rows(back[1:]), rows])
        self._add(rows)

    def _trace_half_branch(self, which: int, i: int) -> None:
        """Trace the branch through a crossing along half-branch i."""
        j = self.met[which].opposite(i)
        self.unseen[which][[i, j]] = False
        start, other = self._exit_point(which, i), self._exit_point(which, j)
        if start is None or other is None:
            return
        rows, closed = self._trace_curve(start, (which, i))
        if not closed:
            rows = np.concatenate([_reverse_rows(self._trace_curve(other)[0]), rows])
        self._add(rows)

    def _exit_point(self, which: int, i: int) -> Array | None:
        """Return the point where half-branch i leaves the circle around a crossing, with its tangent."""
        crossing = self.met[which]
        guess = crossing.start(i)
        settled = self._project(guess[:2], 0.1 * crossing.circle[2])
        if settled is None:
            return None
        return settled if settled[2:] @ guess[2:] > 0.0 else _reverse_tangents(settled)

    def _add(self, rows: Array) -> None:
        if len(rows) > 1:
            branch = Traced(rows[:, :2].copy(), rows[:, 2:].copy())
            self.found.append(branch)
            self.net.close_along(branch)

    def _trace_curve(self, start: Array, origin: tuple[int, int] | None = None) -> tuple[Array, bool]:
        """Follow a curve from a half-branch of a crossing: points with tangents (n, 4), and whether it closed."""
        from .trace_nullcline import BORDER, CLOSED_CURVE, CROSSING, trace_nullcline

        pieces: list[Array] = []
        here, total = start, 0
        while True:
            out = np.empty((MOST_POINTS, 4))
            count, ending, which = trace_nullcline(
                *self.run.arrays, self.kind, self.outside, here, start, self.circles, self.reach, self.size, out
            )
            pieces.append(out[:count])
            total += count
            if ending == BORDER:
                self._end(out[count - 1])
            if ending != CROSSING or total > MOST_POINTS:
                return np.concatenate(pieces), ending == CLOSED_CURVE
            i = self.met[which].nearest(out[count - 1])
            j = self.met[which].opposite(i)
            if origin == (which, j):
                return np.concatenate([*pieces, start[None]]), True
            leaving = self._exit_point(which, j)
            if leaving is None or not self.unseen[which][j]:
                return np.concatenate(pieces), False
            self.unseen[which][[i, j]] = False
            here = leaving

    def _end(self, last: Array) -> None:
        """End a branch that has reached the equator exactly at the zero there."""
        if not len(self.ends) or abs(math.hypot(last[0], last[1]) - 1.0) > 1e-4:
            return
        distance = np.hypot(*(self.ends - last[:2]).T)
        nearest = int(np.argmin(distance))
        if distance[nearest] <= 1e-3:
            self.waiting[nearest] = False
            last[:2] = self.ends[nearest]


def _reverse_tangents(start: Array) -> Array:
    return start * (1.0, 1.0, -1.0, -1.0)


def _reverse_rows(rows: Array) -> Array:
    return _reverse_tangents(rows[::-1])
