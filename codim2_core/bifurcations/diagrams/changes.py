"""Changes of equilibria along a parameter: candidates are held against the states on either side.

What differs between two states with no candidate between them, as at a kink of U, is bisected.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ...numerics.sign_changes import root_between
from .states import State, States

__all__ = ["SIDE_STEP", "Change", "changes_between", "look_near"]

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
    """Find the states on both sides of each of some values in order: nearer where another one is near.

    They are farther away where all is degenerate within rounding so near: what lies between is then left out.
    """
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
