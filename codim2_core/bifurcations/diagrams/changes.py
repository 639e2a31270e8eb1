"""Changes of equilibria along a parameter: candidates are held against the states on either side.

Candidates are zeros of all test functions, found from the states known so far. What differs between two states with no
candidate between them, as at a kink of U, is bisected.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ...numerics.sign_changes import root_between
from ...results.arrays import Array
from ...results.special_kinds import DETERMINANT, SPECIAL_KINDS, SpecialKind
from ..families import special_points
from ..families.family import SystemFamily
from .states import State, States

ANGLES, NET_SIDE = 128, 25
RESIDUALS = np.array([1e-11, 1e-9, 1e-6])[:, None]  # of |U|: of Theta and its derivatives, where more than two vanish
SAME_VALUE, SAME_PLACE = 1e-12, 1e-5  # of the span, and of angles and places in e: of one point
MAX_BLUR = 1e-5  # of the span: how far Newton's method may stop before a multiple zero


@dataclass(frozen=True, eq=False)
class Candidate:
    """A zero of a test function."""

    what: str | SpecialKind  # "meeting", "triple", "crossing", "equator", "fold", or a row of `SPECIAL_KINDS`
    u: float  # the parameter's value, from 0 to 1 along the span
    y: Array  # (n,) (theta, u) or (c, s, u)
    regular: bool  # the zero is simple


def candidates(family: SystemFamily, states: Sequence[State], starts: Iterable[Array], reach: float) -> list[Candidate]:
    """Solve for all bifurcations of equilibria from the equilibria of some states, and from two further arrays.

    Shapes: starts (2, k).
    """
    extrema, slow = starts
    directions, sets = _starting_points(family, states)
    solve = special_points.solve
    found: list[Candidate] = []

    def add(what: str | SpecialKind, equations: special_points.Equations, start: Array) -> None:
        points = solve(equations, start, reach)
        y = points.y
        kept = (y[-1] >= 0.0) & (y[-1] <= 1.0) & ((what == "equator") | (len(y) < 3) | (y[0] ** 2 + y[1] ** 2 < 1.0))
        if what in ("crossing", "triple"):  # more equations than unknowns
            orders = 2 + (what == "triple")
            kept &= (np.abs(special_points.triple_meeting(family)(y))[:orders] <= RESIDUALS[:orders]).all(axis=0)
        for y, regular in zip(points.y.T[kept], points.regular[kept].tolist(), strict=True):
            found.append(Candidate(what, float(y[-1]), y, regular))

    add("crossing", special_points.crossing(family), extrema)
    add("triple", special_points.triple_meeting(family), extrema)
    add("meeting", special_points.meeting(family), extrema)
    rim = np.concatenate([np.cos(directions[:1]), np.sin(directions[:1]), directions[1:]])
    add("equator", special_points.reaching_equator(family), np.concatenate([sets, rim], axis=1))
    if not family.affine:
        add("fold", special_points.folding(family), np.concatenate([sets, slow], axis=1))
    for kind in SPECIAL_KINDS:
        if kind is not DETERMINANT:
            add(kind, special_points.kind_equations(family, kind), sets)
    return merge(found)


def merge(found: Sequence[Candidate]) -> list[Candidate]:
    """Return each point once, in order; of what Newton's method is blurred about, only the point itself."""
    kept: list[Candidate] = []
    for one in sorted(found, key=lambda one: (not one.regular, one.what not in ("crossing", "triple"))):
        for other in kept:
            apart = abs(one.u - other.u)
            if len(one.y) != len(other.y):
                continue
            away = float(np.abs(_place_in_disc(one.y) - _place_in_disc(other.y)).max())
            same = (one.what is other.what or one.what == other.what) and apart <= SAME_VALUE and away <= SAME_PLACE
            blurred = not one.regular or other.what in ("crossing", "triple")
            if same or (blurred and apart <= MAX_BLUR and away <= 1e3 * SAME_PLACE):
                break
        else:
            kept.append(one)
    return sorted(kept, key=lambda one: one.u)


def portrait_place(family: SystemFamily, y: Array, angle: float) -> tuple[float, float]:
    """Return the place in the projected disc of (theta, u) or (c, s, u), in axes at an angle from the family's."""
    if len(y) == 2:
        place = complex(math.cos(y[0]), math.sin(y[0]))
    else:
        modulus = math.hypot(y[0], y[1])
        zeta = float(family.psi_at(y[2:]).radius(min(modulus, 1.0), max((1.0 - modulus) * (1.0 + modulus), 1e-300)))
        place = complex(y[0], y[1]) * (zeta / math.hypot(1.0, zeta) / modulus if modulus else 0.0)
    place *= complex(math.cos(angle), math.sin(angle))
    return place.real, place.imag


def _place_in_disc(y: Array) -> Array:
    return np.array([np.cos(y[0]), np.sin(y[0])]) if len(y) == 2 else y[:2]


def _starting_points(family: SystemFamily, states: Sequence[State]) -> tuple[Array, Array]:
    """Return the limit directions (2, k) and critical sets (3, k) of some states, in the axes of the family."""
    directions, sets = [np.zeros((2, 0))], [np.zeros((3, 0))]
    for state in states:
        u = family.unit(state.value)
        angle = state.turn if family.turns else 0.0
        theta = state.equator.theta - angle
        directions.append(np.stack([theta, np.full(len(theta), u)]))
        for C in state.critical:
            c, s = np.cos(angle), np.sin(angle)
            sets.append(np.array([[c * C.e[0] + s * C.e[1]], [c * C.e[1] - s * C.e[0]], [u]]))
    return np.concatenate(directions, axis=1), np.concatenate(sets, axis=1)


def extrema_of_theta(family: SystemFamily, u: Array) -> Array:
    """Return places (2, k) near which Theta has an extremum, or nearly so, at each of some values (n,)."""
    theta = 2.0 * np.pi * (np.arange(ANGLES) + 0.37) / ANGLES
    places = np.stack(np.broadcast_arrays(theta, u[:, None]))
    slope = special_points.equator_numbers(family, places)[2]
    turns = (slope > 0.0) != (np.roll(slope, -1, axis=1) > 0.0)
    size = np.abs(slope)
    turns |= (size <= np.roll(size, 1, axis=1)) & (size < np.roll(size, -1, axis=1))
    row, at = np.nonzero(turns)
    return np.stack([theta[at], u[row]])


def least_speeds(family: SystemFamily, u: Array) -> Array:
    """Return places (3, k) of a net at which |U| has a minimum, at each of some values (n,)."""
    side = np.linspace(-1.0, 1.0, NET_SIDE)
    inside = np.hypot(side[:, None], side) < 1.0 + 2.0 / NET_SIDE
    speed = np.hypot(*family.speed_on_net(side[:, None], side, u[:, None, None]))
    padded = np.pad(speed, ((0, 0), (1, 1), (1, 1)), constant_values=np.inf)
    shifts = [(i, j) for i in range(3) for j in range(3) if (i, j) != (1, 1)]
    around: Callable[[int, int], Array] = lambda i, j: padded[:, i : i + NET_SIDE, j : j + NET_SIDE]
    least = np.logical_and.reduce([speed <= around(i, j) for i, j in shifts])
    row, i, j = np.nonzero(least & inside)
    return np.stack([side[i], side[j], u[row]])


SIDE_STEP = 1e-7  # of the span: where the two sides of a special value are looked at,
GAP_SHARE = 0.3  # or so much of the way to the next one,
SIDE_STEPS = SIDE_STEP * np.array([1.0, 10.0, 100.0])  # or farther away
NEARER_STEPS = (3e-11, 3e-10, 3e-9)  # of the span: nearer still, where nothing is degenerate there
MIN_WIDTH = 1e-12  # of the span: bisection ends
MAX_CHANGES = 10  # between two neighbouring states, nested


class Change(NamedTuple):
    """A value at which equilibria change, and the states on either side of it."""

    value: float
    before: State
    after: State


def look_near(states: States, values: Sequence[float]) -> None:
    """Find the states on both sides of each of some values in order; farther away where all is degenerate so near."""
    low, high = states.span
    stops = [-math.inf, *values, math.inf]
    for before, value, after in zip(stops, stops[1:], stops[2:], strict=False):
        most = min(GAP_SHARE * (value - before), GAP_SHARE * (after - value), value - low, high - value)
        for step in SIDE_STEPS * states.width:
            sides = [states(value + side * min(float(step), most)) for side in (-1.0, 1.0)]
            if all(state is not None and state.plain for state in sides):
                if step > SIDE_STEP * states.width:
                    states.leave_out(value - min(float(step), most), value + min(float(step), most))
                break


def changes_between(states: States, values: Sequence[float], low: float, high: float) -> list[Change]:
    """Find all changes between two values; `values` are candidates, next to which states are known."""
    while True:
        found: list[Change] = []
        for left, right in pairwise(states.between(low, high)):
            if left.difference(right) is None:
                continue
            there = [v for v in values if left.value < v < right.value]
            if len(there) == 1 and right.value - left.value <= 2.1 * SIDE_STEPS[-1] * states.width:
                found.append(Change(there[0], left, right))
            else:
                found += _bisected(states, left, right, MAX_CHANGES)
        rough = [states.leave_out_rounding(one.value) for one in found]
        if not any(rough):
            return found


def _bisected(states: States, left: State, right: State, deeper: int) -> Iterator[Change]:
    """Yield the changes between two states, in order."""
    part = left.difference(right)
    if part is None or not deeper:
        return
    value = _narrow(states, left, right, part)
    before, after = _state_near(states, left, value), _state_near(states, right, value)
    yield from _bisected(states, left, before, deeper - 1)
    yield Change(value, before, after)
    yield from _bisected(states, after, right, deeper - 1)


def _narrow(states: States, left: State, right: State, part: int) -> float:
    """Find a value at which a part of the state is no longer what it is at `left`."""
    if part == 2 and left.exponent is not None and right.exponent is not None:

        def exponent(value: float) -> float:
            state = states(value)
            return math.nan if state is None or state.exponent is None else state.exponent

        value = root_between(exponent, left.value, right.value)
        if abs(exponent(value)) < abs(left.exponent) and abs(exponent(value)) < abs(right.exponent):
            return value
    low, high = left.value, right.value
    while high - low > MIN_WIDTH * states.width:
        middle = states(0.5 * (low + high))
        if middle is None or middle.value in (low, high):
            break
        low, high = (middle.value, high) if middle.parts[part] == left.parts[part] else (low, middle.value)
    return 0.5 * (low + high)


def _state_near(states: States, far: State, value: float) -> State:
    """Return the state next to a special value, towards `far`: nearer where that differs, as one more lies between."""
    side = math.copysign(1.0, far.value - value)
    near = far
    if abs(far.value - value) > SIDE_STEP * states.width:
        near = states(value + side * SIDE_STEP * states.width) or far
    for distance in NEARER_STEPS:
        if distance * states.width >= abs(near.value - value):
            break
        nearer = states(value + side * distance * states.width)
        if nearer is None or not nearer.plain:
            continue
        if nearer.difference(near) is None:
            return near
        # what rounding makes of a multiple zero is not the same twice as far away
        twice = states(value + side * 2.0 * distance * states.width)
        if twice is not None and nearer.difference(twice) is None:
            return nearer
    return near
