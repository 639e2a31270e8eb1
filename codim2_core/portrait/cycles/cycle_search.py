"""Limit cycles of the layer problem of any system, by the first turn of orbits about its critical sets.

A closed orbit surrounds critical sets whose indices add up to 1, so at least one that is no saddle. From each of these
a ray runs to the equator. The angle about its foot grows by 2 pi along a closed orbit around it, so the orbit has a
point on the ray from which it has first turned by 2 pi exactly when it is back: a fixed point of the map that takes a
point of the ray to where its orbit is after its first turn. Conversely, every fixed point is a closed orbit.

The map is sampled, forward and backward in time, until its samples resolve it (`displacement_sampling`), apart
from where it jumps (on an orbit that meets a saddle) or ends. That is no proof that none is missed, and the result says
so.
"""

from __future__ import annotations

import math

import numpy as np

from ...numerics.curves.arclength import distance
from ...numerics.sign_changes import root_through
from ...results.words import say
from ..layer_problem.problem import LayerProblem
from .displacement_sampling import NEAR_FOLD, NEAR_LOOP, UNRESOLVED, Samples, near_fold, zeros
from .periodic_orbit import Orbit, orbit
from .ray_section import FINE_RTOL, INNER_RADIUS, Array, FixedPoint, TurnSection

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
