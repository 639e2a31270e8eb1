"""Limit cycles of the layer problem of any system, by the first turn of orbits about its critical sets.

A closed orbit surrounds critical sets whose indices add up to 1, so at least one that is no saddle. From each of these
a ray runs to the equator. The angle about its foot grows by 2 pi along a closed orbit around it, so the orbit has a
point on the ray from which it has first turned by 2 pi exactly when it is back: a fixed point of the map that takes a
point of the ray to where its orbit is after its first turn. Conversely, every fixed point is a closed orbit.

The map is sampled, forward and backward in time, until its samples resolve it (`Samples`), apart from where it jumps
(on an orbit that meets a saddle) or ends. That is no proof that none is missed, and the result says so.

The displacement of the map is smooth where orbits return. On an interval between two samples it is approximated by the
cubic through the four samples about it (Newton's divided differences: spacing need not be even), and the fourth divided
difference bounds how far it may be from that cubic. An interval is resolved when the cubic, wherever in that band the
displacement lies, has the zeros that the signs at its two ends ask for and no other: none, or one. So an extremum is
judged by slope and curvature, and not by the heights of samples that may lie far from it.

What is hidden in a part that four samples on either side do not show at all is not found: this is no proof.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ...numerics.arclength import distance
from ...numerics.sign_changes import root_through
from ...results.arrays import Array
from ...results.words import say
from ..layer_problem.problem import LayerProblem
from .periodic_orbit import Orbit, orbit
from .ray_section import COARSE_RTOL, FINE_RTOL, INNER_RADIUS, FixedPoint, TurnSection

COARSE_NOISE, FINE_NOISE = 1e-8, 1e-11  # of a displacement at COARSE and FINE
ERROR_SAFETY = 8.0  # times the estimated error of the cubic
INTERVAL_PARTS = 16  # of an interval, where its cubic is evaluated
BATCH, FEWEST = 32, 3  # samples in a round, at least in one interval: lanes step side by side
NARROWEST, NARROWEST_STEEP = 2e-6, 1e-12  # widths in xi below which an interval is left as it is: flat, and steep
UNRESOLVED = say("too steep")
PERIOD_ANNULUS_WIDTH = 0.05  # width in q of an interval of fixed points that is no fold
STEEP = 1e-3  # change of the displacement
MAX_SAMPLES, MAX_ROUNDS = 900, 24  # samples in all; rounds
MAX_UNDECIDED_SHARE = 0.25  # share of undecided samples at which looking closer is in vain
NEAR_FOLD = 1e-6  # displacement at an extremum: a pair of cycles there is not changes from none with certainty
NEAR_LOOP = 1e-3  # displacement of the last orbit that returns: a loop is near
STRIDES = 1, 3, 8, 20  # of samples that are compared
RISE = 10.0  # times its noise, by which a sample differs from another
# Next to a loop errors grow along a turn. The noise there is how far two tolerances are apart, at the samples within
# reach. It is measured for displacements below the first number; beyond so many times the noise they differ from zero.
MAY_BE_NOISE, NOISE_REACH, NOISE_MULTIPLE = 1e-6, 4, 4.0
OTHER_RTOL = 4.0 * FINE_RTOL
_INSIDE = np.linspace(0.0, 1.0, INTERVAL_PARTS + 1)


def differences(q: Array, shift: Array) -> Array:
    """Fourth divided differences (n - 4,) of samples in order."""
    d = shift
    for k in range(1, 5):
        d = np.diff(d) / (q[k:] - q[:-k])
    return d


def cubics(q: Array, shift: Array) -> tuple[Array, Array]:
    """Approximate one run of samples between its samples."""
    n = len(q)
    first = np.clip(np.arange(n - 1) - 1, 0, n - 4)  # of the four samples
    x = q[:-1, None] + np.diff(q)[:, None] * _INSIDE
    values = np.zeros_like(x)
    product = np.ones_like(x)
    column = shift.copy()
    for k in range(4):
        values += column[first][:, None] * product
        product = product * (x - q[first + k][:, None])
        if k < 3:
            column = np.diff(column) / (q[k + 1 :] - q[: n - k - 1])
    fourth = np.abs(differences(q, shift))
    # the largest over five samples that hold the interval's four, or three of them
    near = np.max([fourth[np.clip(first + k, 0, n - 5)] for k in (-2, -1, 0, 1)], axis=0)
    return values, near[:, None] * np.abs(product)


def unresolved_intervals(q: Array, shift: Array, noise: Array) -> list[int]:
    """Find the intervals i, between samples i and i + 1 of n, on which zeros may be hidden."""
    out: list[int] = []
    finite = np.isfinite(shift)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], finite, [False]]).astype(np.int8)))
    for low, high in zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True):
        if high - low < 5:
            out += range(low, high - 1)
            continue
        part = slice(low, high)
        values, error = cubics(q[part], shift[part])
        # between its places a cubic leaves the line through them by an eighth of its second difference at most
        bend = np.abs(np.diff(values, 2)).max(axis=1, keepdims=True) / 8.0
        doubt = ERROR_SAFETY * error + bend + np.maximum(noise[part][:-1], noise[part][1:])[:, None]
        hidden = _doubtful(values, doubt)
        # where few samples show a dip, its depth is known no better than to the height it fell from
        size = np.abs(shift[part])
        dip = (size[1:-1] <= np.minimum(size[:-2], size[2:])) & (2.0 * size[1:-1] < np.maximum(size[:-2], size[2:]))
        dip &= (shift[part][:-2] < 0.0) == (shift[part][2:] < 0.0)
        hidden[:-1] |= dip
        hidden[1:] |= dip
        out += (np.flatnonzero(hidden) + low).tolist()
    return out


def _doubtful(values: Array, doubt: Array) -> NDArray[np.bool_]:
    """Whether rows of values, known within a doubt, may have other zeros than the signs of their ends ask for."""
    values = values * np.where(values[:, :1] < 0.0, -1.0, 1.0)  # from positive
    same = values[:, -1] > 0.0
    reached = values <= doubt  # may have crossed zero here
    back = values >= -doubt  # and may be on the first side here
    # after a place where it may have crossed, one where it may be back
    again = np.logical_or.accumulate(reached, axis=1)[:, :-1] & back[:, 1:]
    return np.where(same, reached.any(axis=1), again.any(axis=1))


def zeros(q: Array, shift: Array, noise: Array) -> tuple[list[tuple[int, int]], list[tuple[int, int]], bool]:
    """Return where the displacement changes sign, where it touches zero, and whether a band of it is zero."""
    decided = np.flatnonzero(np.abs(shift) > noise)
    inward = shift[decided] < 0.0
    changes, touching, band = [], [], False
    unlike = (inward[1:] != inward[:-1]) | (np.diff(decided) > 1)  # else there is nothing between the two
    for k in np.flatnonzero(unlike).tolist():
        i, j = decided[k : k + 2].tolist()
        if q[j - 1] - q[i + 1] > PERIOD_ANNULUS_WIDTH:
            band = True
        elif (shift[i] < 0.0) != (shift[j] < 0.0):
            changes.append((i, j))
        elif j > i + 1 and np.isfinite(shift[i : j + 1]).all():
            touching.append((i, j))
    return changes, touching, band


class Samples:
    """Samples of one return map, in order along the section; some of them at the fine tolerance."""

    def __init__(self, section: TurnSection, xi: Array, backward: bool = False) -> None:
        self.section, self.backward = section, backward
        self.xi, self.q = xi, section.states(xi)[1]
        self.shift = section.displacement(xi, COARSE_RTOL, backward)
        self.fine = np.zeros(len(xi), bool)

    @property
    def noise(self) -> Array:
        """Return the uncertainty of the displacement; near the critical set it is that of the distance from it."""
        return np.where(self.fine, FINE_NOISE, COARSE_NOISE) * (1.0 + np.exp(-self.q))

    def refine(self, xi: Array, also: NDArray[np.bool_], rtol: float = FINE_RTOL) -> None:
        """Add samples, by default at the fine tolerance, and repeat those marked that are not fine yet."""
        also = also & ~self.fine
        every = np.concatenate([xi, self.xi[also]])
        q = self.section.states(every)[1]
        shift = self.section.displacement(every, rtol, self.backward)
        self.shift[also] = shift[len(xi) :]
        self.fine = self.fine | also
        order = np.argsort(np.concatenate([self.xi, xi]), kind="stable")
        self.xi = np.concatenate([self.xi, xi])[order]
        self.q = np.concatenate([self.q, q[: len(xi)]])[order]
        self.shift = np.concatenate([self.shift, shift[: len(xi)]])[order]
        self.fine = np.concatenate([self.fine, np.full(len(xi), rtol == FINE_RTOL)])[order]

    def resolve(self, ends: Callable[[Array, Array], list[int]], steepest: float = NARROWEST_STEEP) -> bool:
        """Sample closer until every interval is resolved; whether that came about."""
        for _ in range(MAX_ROUNDS):
            doubtful = [
                i for i in unresolved_intervals(self.q, self.shift, self.noise) if not self._narrow(i, steepest)
            ]
            stencil = np.zeros(len(self.xi), bool)
            for i in doubtful:
                stencil[max(i - 1, 0) : i + 3] = True
            open_ = sorted({*doubtful, *ends(self.xi, self.shift)})
            if not open_:
                return True
            if len(self.xi) > MAX_SAMPLES or np.isnan(self.shift).mean() > MAX_UNDECIDED_SHARE:
                return False
            each = max(BATCH // len(open_), FEWEST)
            part = np.arange(1, each + 1) / (each + 1)
            left, right = self.xi[open_], self.xi[np.array(open_) + 1]
            # where the displacement ends, a first look is for its sign, which is plain unless a loop is near
            small = np.abs(self.shift[open_ + [i + 1 for i in open_]]) < NEAR_LOOP
            rtol = FINE_RTOL if doubtful or small.any() else COARSE_RTOL
            self.refine((left[:, None] + (right - left)[:, None] * part).ravel(), stencil, rtol)
        return False

    def rises(self, pairs: list[tuple[int, int]]) -> NDArray[np.bool_]:
        """Whether both displacements of each pair of samples are above the noise measured around them."""
        near = [np.arange(max(i - NOISE_REACH, 0), min(j + NOISE_REACH + 1, len(self.xi))) for i, j in pairs]
        least = np.array([np.abs(self.shift[[i, j]]).min() for i, j in pairs])
        small = np.flatnonzero(least < MAY_BE_NOISE)
        if not len(small):
            return np.ones(len(pairs), bool)
        at = np.unique(np.concatenate([near[k] for k in small]))
        apart = np.zeros(len(self.xi))
        again = self.section.displacement(self.xi[at], OTHER_RTOL, self.backward, noise=0.0)
        both = np.isfinite(again) & np.isfinite(self.shift[at])
        apart[at[both]] = np.abs(again[both] - self.shift[at[both]])
        noise = np.array([apart[places].max() for places in near])
        return least > NOISE_MULTIPLE * noise

    def _narrow(self, i: int, steepest: float) -> bool:
        """Whether an interval is as narrow as makes sense: steep, a jump may still differ from a slope."""
        steep = abs(self.shift[i + 1] - self.shift[i]) > STEEP
        width = self.xi[i + 1] - self.xi[i]
        return bool(width < (NARROWEST if not steep else steepest * max(1.0, abs(self.xi[i]))))


def _least_extremum(q: Array, shift: Array, noise: Array) -> float:
    """Return the smallest size of the extrema of three neighbouring samples, by their parabola; inf without any."""
    left, right = np.diff(shift)[:-1], np.diff(shift)[1:]
    at = np.flatnonzero((left * right <= 0.0) & (np.maximum(abs(left), abs(right)) > RISE * noise[1:-1]))
    u, v = q[at] - q[at + 1], q[at + 2] - q[at + 1]
    first, second = -left[at] / u, right[at] / v
    bend, slope = (second - first) / (v - u), (first * v - second * u) / (v - u)
    turned = slope * slope / (4.0 * bend)  # first and second differ, or both were zero, and so the rise
    return float(abs(shift[at + 1] - turned).min(initial=math.inf))


def near_fold(q: Array, shift: Array, noise: Array) -> float:
    """Return the smallest size of the displacement at one of its extrema, to within its noise; inf if it has none."""
    finite = np.concatenate([[False], np.isfinite(shift), [False]]).astype(np.int8)
    ends = np.flatnonzero(np.diff(finite)).tolist()
    runs = [slice(*run, k) for run in zip(ends[::2], ends[1::2], strict=True) for k in STRIDES]
    least = min((_least_extremum(q[run], shift[run], noise[run]) for run in runs), default=math.inf)
    flat = np.concatenate([[False], np.abs(shift) <= RISE * noise, [False]]).astype(np.int8)
    edges = np.flatnonzero(np.diff(flat))
    for low, high in zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True):
        neighbours = shift[[low - 1, high]] if low > 0 and high < len(shift) else np.zeros(1)
        if np.isfinite(neighbours).all() and neighbours.min() * neighbours.max() > 0.0:
            least = min(least, float(np.abs(shift[low:high]).max()))
    return least


PERIOD_ANNULUS_EXPONENT = 1e-9  # |ln multiplier| at which a closed orbit is one of a band
CLOSURE_DISTANCE = 1e-7  # distance on the sphere between start and end at which an orbit is closed
SAME_CYCLE_DISTANCE = 1e-5  # distance in the disc between cycles found twice
ON_CYCLE_DISTANCE = 1e-7  # distance in the disc from a cycle of a fixed point that belongs to it
MIN_JUMP_WIDTH, LEAST_JUMP_WIDTH = 1e-7, 1e-12  # width at which looking closer at a jump ends, and near a loop
MOST_ROUNDS = 40  # of narrowing one place
SMOOTH = 1e-6  # displacement left at a fixed point that is none but a jump
MOST_FEET = 12
FINE_SPACING, AGREED = 0.02, 1e-10  # spacing of the samples about a fixed point; how far two interpolants may differ
FOLD_NOISE = 1e-9  # noise with which a fold can be decided: not so near C that all displacements are small
# Where the expansion at a critical set is measured, in INNER_RADIUS; the smallest cycle it shows, in shares of the
# reach; the displacement to first order from which it has digits, and from which no cycle can be so small.
MEASURED, MIN_CYCLE_RADIUS, MIN_NEWBORN, MAX_NEWBORN = np.array([2.0, 8.0]), 1e-8, 1e-13, 1e-3

PERIOD_ANNULUS_NOTE = say("band counted")
NO_CRITICAL_SET = say("no set to surround")
ONLY_SADDLES = say("only saddles")


def search_cycles(problem: LayerProblem) -> tuple[list[tuple[FixedPoint, Orbit, int]], str, tuple[str, ...]]:
    """Search for limit cycles; sense is +1 anticlockwise, -1 clockwise; `reason` says how they were found."""
    critical = problem.critical
    if not critical:
        return [], NO_CRITICAL_SET, ()
    feet = [C for C in critical if C.kind != "saddle"]
    if not feet:
        return [], ONLY_SADDLES, ()
    found: list[tuple[FixedPoint, Orbit, int]] = []
    notes: list[str] = []
    if len(feet) > MOST_FEET:
        notes.append(say("searched about some", searched=MOST_FEET, count=len(feet)))
        feet = sorted(feet, key=lambda C: C.discriminant)[:MOST_FEET]  # where orbits turn fastest
    for C in feet:
        section = TurnSection(problem, C)
        crossings, said = _search_ray(section)
        notes += said
        for crossing in crossings:
            if any(_lies_on_cycle(section, crossing, other) for _, other, _ in found):
                continue
            closed = orbit(section, crossing)
            if closed is None or closed.closure > CLOSURE_DISTANCE:
                notes.append(say("turn not closed"))
            elif abs(closed.divergence) < PERIOD_ANNULUS_EXPONENT and not (crossing.touching or crossing.born):
                notes.append(PERIOD_ANNULUS_NOTE)
            elif not any(_is_same_orbit(closed, other) for _, other, _ in found):
                found.append((crossing, closed, _sense(closed.points)))
    names = "the critical set" if len(critical) == 1 else "the critical sets that are no saddles"
    kind = "no cycle" if not found else "one cycle" if len(found) == 1 else "cycles"
    return found, say(f"{kind}, turn", count=len(found), about=names), tuple(dict.fromkeys(notes))


def _search_ray(section: TurnSection) -> tuple[list[FixedPoint], list[str]]:
    """Find fixed points on one ray, innermost first, and what is nearly degenerate."""
    first, newborn, notes = _near_hopf(section)
    out = [] if newborn is None else [newborn]
    grid = section.grid()
    grid = grid[grid > first]
    for backward in (False, True):
        samples = Samples(section, grid, backward)
        finite = np.isfinite(samples.shift)
        if not backward and newborn is None and finite.sum() >= 8 and not samples.shift[finite].any():
            return [], [PERIOD_ANNULUS_NOTE]
        if not samples.resolve(_displacement_ends, MIN_JUMP_WIDTH):
            notes.append(UNRESOLVED)
        xi, shift = samples.xi, samples.shift
        if not backward:
            if np.isnan(shift).any():
                notes.append(say("not all followed"))
            C = section.critical
            if first < math.log(INNER_RADIUS) and C.discriminant < 0.0 and shift[0] * C.trace < 0.0 and finite[0]:
                notes.append(say("too small, about a set"))
            last = shift[:-1][np.isfinite(shift[:-1]) & (shift[1:] == np.inf)].tolist()
            notes += [say("near a loop", gap=y) for y in last if 0.0 < abs(y) < NEAR_LOOP]
        changes, touching, band = zeros(samples.q, shift, samples.noise)
        places = [*changes, *touching]
        rises = samples.rises(places)
        plain = [place for place, seen in zip(places, rises, strict=True) if seen]
        if band:
            notes.append(PERIOD_ANNULUS_NOTE)
        elif len(plain) < len(places):
            notes.append(UNRESOLVED)
        if not backward:
            gap = near_fold(samples.q, shift, samples.noise)
            if gap < NEAR_FOLD and len(plain) == len(places):
                notes.append(say("near a fold", gap=gap))
            folds = [i + 1 + int(np.argmin(np.abs(shift[i + 1 : j]))) for i, j in touching if (i, j) in plain]
            out += [FixedPoint(float(xi[i]), touching=True) for i in folds if samples.noise[i] < FOLD_NOISE]
        for i, j in changes:
            if (i, j) not in plain:
                continue
            if shift[i] > 0.0 and np.isfinite(shift[[i, j]]).all():  # attracting
                at = _interpolate_fixed_point(section, samples, i, j, backward)
                found = _narrow_fixed_points(section, float(xi[i]), float(xi[j]), backward) if at is None else [at]
                out += [FixedPoint(at, backward) for at in found]
    return sorted(out, key=lambda crossing: crossing.xi), notes


def _near_hopf(section: TurnSection) -> tuple[float, FixedPoint | None, list[str]]:
    """Place the cycle next to a critical set of small trace: ``displacement = 2 pi mu/omega + c r^2``.

    Its first term is exact; c is measured well outside the cycle, where rounding (1e-16/r) does not matter yet.

    xi: So far there is no other one; -inf where the expansion says nothing; notes: That there is one below
    `MIN_CYCLE_RADIUS`, where the trace of J has lost its digits.
    """
    C = section.critical
    linear = 2.0 * math.pi * C.trace / math.sqrt(-C.discriminant) if C.discriminant < 0.0 else 0.0
    if not MIN_NEWBORN < abs(linear) < MAX_NEWBORN:
        return -math.inf, None, []
    for scale in MEASURED * INNER_RADIUS:
        r = scale * np.array([1.0, 2.0, 4.0])
        parts = (section.displacement(np.log(r / (1.0 - r)), FINE_RTOL, noise=0.0) - linear) / r**2
        if not np.isfinite(parts).all():
            continue
        square = float(parts @ (8.0, -6.0, 1.0)) / 3.0  # takes out the next two powers of r
        size = math.sqrt(abs(linear / square)) if square else math.inf
        if not size < scale:
            continue
        if square * linear > 0.0:
            return math.log(scale), None, []
        if size < MIN_CYCLE_RADIUS:
            return math.log(scale), None, [say("too small, about a set")]
        return math.log(scale), FixedPoint(math.log(size / (1.0 - size)), square > 0.0, born=True), []
    return -math.inf, None, []


def _one_way(y: Array) -> bool:
    """Whether displacements are finite, and all rise or all fall from one sample to the next."""
    if not np.isfinite(y).all():
        return False
    steps = np.diff(y)
    return bool((steps > 0.0).all() or (steps < 0.0).all())


def _interpolate_fixed_point(section: TurnSection, samples: Samples, i: int, j: int, backward: bool) -> float | None:
    """Find the fixed point between two samples by six others about the zero of the cubic through those around."""
    near = slice(max(i - 1, 0), j + 2)
    x, y = samples.xi[near], samples.shift[near]
    if not _one_way(y):
        return None
    low, high, guess = float(samples.xi[i]), float(samples.xi[j]), root_through(x, y)
    if not low < guess < high:
        return None
    x = guess + min(FINE_SPACING, 0.1 * (high - low)) * np.array([-2.5, -1.5, -0.5, 0.5, 1.5, 2.5])
    y = section.displacement(x, FINE_RTOL, backward)
    if not _one_way(y) or y[0] * y[-1] > 0.0:
        return None
    found = root_through(x, y)
    return found if abs(found - root_through(x[1:-1], y[1:-1])) < AGREED else None


def _brackets(shift: Array) -> list[int]:
    """Places i where the displacement changes sign downwards, from an attracting cycle, between samples i and i + 1."""
    finite = np.isfinite(shift[1:]) & np.isfinite(shift[:-1])
    return np.flatnonzero(finite & (shift[:-1] > 0.0) & (shift[1:] <= 0.0)).tolist()


def _displacement_ends(xi: Array, shift: Array) -> list[int]:
    """Places i where the displacement ends between samples i and i + 1: closer where it is small, near a loop."""
    finite = np.isfinite(shift)
    last = np.where(finite[1:], shift[1:], shift[:-1])
    least = np.where(np.abs(last) < NEAR_LOOP, LEAST_JUMP_WIDTH * np.maximum(1.0, np.abs(xi[1:])), MIN_JUMP_WIDTH)
    beyond = np.where(finite[1:], shift[:-1], shift[1:])
    # to -inf, onto the critical set, it goes continuously
    jumps = (finite[1:] != finite[:-1]) & np.isinf(beyond) & ~((beyond < 0.0) & (last < 0.0))
    return np.flatnonzero(jumps & (np.diff(xi) > least)).tolist()


def _narrow_fixed_points(section: TurnSection, low: float, high: float, backward: bool) -> list[float]:
    """Find the fixed points between two samples, apart from jumps of the displacement through zero."""
    found: list[float] = []
    width = high - low  # the two tolerances need not agree on where it is: look a little beyond
    open_ = [(low - 0.5 * width, high + 0.5 * width)]
    for _ in range(MOST_ROUNDS):
        if not open_:
            break
        low, high = open_.pop()
        xi = np.linspace(low, high, 32)
        shift = section.displacement(xi, FINE_RTOL, backward)
        for i in _brackets(shift):
            left, right = float(shift[i]), float(shift[i + 1])
            if right == 0.0:
                found.append(float(xi[i + 1]))
            elif xi[i + 1] - xi[i] > 1e-13 * max(1.0, abs(high)):
                open_.append((float(xi[i]), float(xi[i + 1])))
            elif left - right < SMOOTH:
                found.append(float(xi[i] + (xi[i + 1] - xi[i]) * left / (left - right)))
    return found


def _lies_on_cycle(section: TurnSection, crossing: FixedPoint, other: Orbit) -> bool:
    """Whether a fixed point lies on a cycle that is known."""
    p = section.states(np.array([crossing.xi]))[0][0, :2]
    return bool(distance(p, other.points) < ON_CYCLE_DISTANCE)


def _sense(points: Array) -> int:
    x, y = points[:-1].T
    return 1 if float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) > 0.0 else -1


def _is_same_orbit(one: Orbit, other: Orbit) -> bool:
    if abs(one.period - other.period) > 1e-6 * one.period:
        return False
    if abs(one.divergence - other.divergence) > 1e-9 + 1e-3 * abs(one.divergence):
        return False  # the other of a pair next to a fold
    gaps = np.hypot(*(one.points[:1] - other.points).T)
    spacing = np.hypot(*np.diff(other.points, axis=0).T).max()
    return bool(gaps.min() < SAME_CYCLE_DISTANCE + spacing)
