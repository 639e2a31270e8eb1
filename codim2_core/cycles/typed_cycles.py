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

import numpy as np

from ..curves.polyline import distance
from ..layer_problem.critical import CriticalSet
from ..psi.function import Psi
from ..systems.frozen import FrozenSystem
from ..words import say
from .displacement_sampling import NEAR_FOLD, UNRESOLVED, Samples, count_sentence, near_fold, zeros
from .global_section import FINE_RTOL, FixedPoint
from .periodic_orbit import Orbit, orbit
from .ray_section import Array, TurnSection

PERIOD_ANNULUS_EXPONENT = 1e-9  # |ln multiplier| at which a closed orbit is one of a band
CLOSURE_DISTANCE = 1e-7  # distance on the sphere between start and end at which an orbit is closed
SAME_CYCLE_DISTANCE = 1e-5  # distance in the disc between cycles found twice
ON_CYCLE_DISTANCE = 1e-7  # distance in the disc from a cycle of a fixed point that belongs to it
MIN_JUMP_WIDTH = 1e-7  # width at which looking closer at a jump ends
MOST_ROUNDS = 40  # of narrowing one place
SMOOTH = 1e-6  # displacement left at a fixed point that is none but a jump
MOST_FEET = 12

PERIOD_ANNULUS_NOTE = say("band counted")
NO_CRITICAL_SET = say("no set to surround")
ONLY_SADDLES = say("only saddles")


def find(
    at: FrozenSystem, psi: Psi, critical: tuple[CriticalSet, ...]
) -> tuple[list[tuple[FixedPoint, Orbit, int]], str, tuple[str, ...]]:
    """Search for limit cycles.

    Parameters
    ----------
    at : Frozen
    psi : Psi
    critical : tuple of CriticalSet
        Of the same system.

    Returns
    -------
    cycles : list of (FixedPoint, Orbit, sense)
        sense is +1 anticlockwise, -1 clockwise.
    reason : str
        Why there is none, or how those there are were found.
    notes : tuple of str
    """
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
        section = TurnSection(at, psi, C, critical)
        crossings, said = _search_ray(section)
        notes += said
        for crossing in crossings:
            if any(_lies_on_cycle(section, crossing, other) for _, other, _ in found):
                continue
            closed = orbit(section, crossing)
            if closed is None or closed.closure > CLOSURE_DISTANCE:
                notes.append(say("turn not closed"))
            elif abs(closed.divergence) < PERIOD_ANNULUS_EXPONENT and not crossing.touching:
                notes.append(PERIOD_ANNULUS_NOTE)
            elif not any(_is_same_orbit(closed, other) for _, other, _ in found):
                found.append((crossing, closed, _sense(closed.points)))
    names = "the critical set" if len(critical) == 1 else "the critical sets that are no saddles"
    return found, count_sentence(len(found), "turn", about=names), tuple(dict.fromkeys(notes))


def _search_ray(section: TurnSection) -> tuple[list[FixedPoint], list[str]]:
    """Find fixed points on one ray, innermost first, and what is nearly degenerate."""
    notes: list[str] = []
    out: list[FixedPoint] = []
    for backward in (False, True):
        samples = Samples(section, section.grid(), backward)
        finite = np.isfinite(samples.shift)
        if not backward and finite.sum() >= 8 and not samples.shift[finite].any():
            return [], [PERIOD_ANNULUS_NOTE]
        if not samples.resolve(_displacement_ends, MIN_JUMP_WIDTH):
            notes.append(UNRESOLVED)
        xi, shift = samples.xi, samples.shift
        if not backward:
            if np.isnan(shift).any():
                notes.append(say("not all followed"))
            C = section.critical
            if np.isfinite(shift[0]) and C.discriminant < 0.0 and shift[0] * C.trace < 0.0:
                notes.append(say("too small, about a set"))
        changes, touching, band = zeros(samples.q, shift, samples.noise)
        if band:
            notes.append(PERIOD_ANNULUS_NOTE)
        if not backward:
            gap = near_fold(samples.q, shift, samples.noise)
            if gap < NEAR_FOLD:
                notes.append(say("near a fold", gap=gap))
            out += [FixedPoint(float(xi[i]), touching=True) for i in touching]
        for i, j in changes:
            if shift[i] > 0.0 and np.isfinite(shift[[i, j]]).all():  # attracting
                out += [
                    FixedPoint(at, backward)
                    for at in _narrow_fixed_points(section, float(xi[i]), float(xi[j]), backward)
                ]
    return sorted(out, key=lambda crossing: crossing.xi), notes


def _brackets(shift: Array) -> list[int]:
    """Places i where the displacement changes sign downwards, from an attracting cycle, between samples i and i + 1."""
    finite = np.isfinite(shift[1:]) & np.isfinite(shift[:-1])
    return np.flatnonzero(finite & (shift[:-1] > 0.0) & (shift[1:] <= 0.0)).tolist()


def _displacement_ends(xi: Array, shift: Array) -> list[int]:
    """Places i where the displacement ends between samples i and i + 1."""
    finite = np.isfinite(shift)
    return np.flatnonzero((finite[1:] != finite[:-1]) & (np.diff(xi) > MIN_JUMP_WIDTH)).tolist()


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
        return False  # the other of a pair beside a fold
    gaps = np.hypot(*(one.points[:1] - other.points).T)
    spacing = np.hypot(*np.diff(other.points, axis=0).T).max()
    return bool(gaps.min() < SAME_CYCLE_DISTANCE + spacing)
