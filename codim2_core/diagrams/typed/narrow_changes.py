"""The value at which equilibria change: by what goes smoothly through zero there, and by bisection."""

from __future__ import annotations

import math
from collections.abc import Callable

from ...special_kinds import SpecialKind, change_between
from .cancellation_zones import States
from .state import State

Measure = Callable[[State], float]

_MAX_SECANTS, _MAX_WIDENINGS = 10, 5  # steps towards a zero; times that it is enclosed ten times more widely
_ENCLOSURE_SHARE = (
    0.4  # of what is narrow enough: how far to either side of a zero it is looked whether the part changes
)


def narrow_change(state: States, left: State, right: State, part: int, narrow: float) -> float:
    """Find a value, within `narrow`, at which that part is no longer what it is at `left`.

    Where something goes smoothly through zero there, some secants come to it, and a look to either side shows that it
    is there; what is left is bisected.
    """
    bracket = _Bracket(state, left, right, part)
    measure = _measure(left, right, part)
    if measure is not None:
        expected = _zero(bracket, measure, narrow)
        reach = _ENCLOSURE_SHARE * narrow
        for _ in range(_MAX_WIDENINGS if expected is not None else 0):
            assert expected is not None
            bracket.look(expected - reach)
            bracket.look(expected + reach)
            if bracket.width <= max(narrow, 2.0 * reach):
                break
            reach *= 10.0
    while bracket.width > narrow:
        middle = 0.5 * (bracket.low.value + bracket.high.value)
        if not bracket.look(middle):
            break
    return 0.5 * (bracket.low.value + bracket.high.value)


class _Bracket:
    """Two states between which a part changes."""

    def __init__(self, state: States, low: State, high: State, part: int) -> None:
        self.state, self.low, self.high, self.part, self.here = state, low, high, part, low.part(part)

    @property
    def width(self) -> float:
        return self.high.value - self.low.value

    def look(self, value: float) -> State | None:
        """Draw the end in that is like the state at a value; None where that is not between the two."""
        if not self.low.value < value < self.high.value:
            return None
        there = self.state(value)
        if not self.low.value < there.value < self.high.value:
            return None  # a zone lies there in which nothing is told
        if there.part(self.part) == self.here:
            self.low = there
        else:
            self.high = there
        return there


def _zero(bracket: _Bracket, measure: Measure, narrow: float) -> float | None:
    """Follow secants of a measure to its zero between two states; None where they lead elsewhere."""
    x, y = (bracket.low.value, bracket.high.value), (measure(bracket.low), measure(bracket.high))
    for _ in range(_MAX_SECANTS):
        if not (math.isfinite(y[0]) and math.isfinite(y[1])) or y[0] == y[1]:
            return None
        value = x[1] - y[1] * (x[1] - x[0]) / (y[1] - y[0])
        if abs(value - x[1]) <= 0.1 * narrow:
            return value
        there = bracket.look(value)
        if there is None:
            return None
        x, y = (x[1], value), (y[1], measure(there))
    return x[1]


def _measure(left: State, right: State, part: int) -> Measure | None:
    """Return what goes through zero where that part changes, if as much stands still on either side; else None."""
    one, two = left.equator, right.equator
    if part == 0 and len(one) == len(two):
        for i, theta in enumerate(one.theta.tolist()):
            j = _nearest_direction(right, theta)
            if one.kind(i) != two.kind(j):
                middle = theta + 0.5 * math.remainder(float(two.theta[j]) - theta, 2.0 * math.pi)
                return _of_direction(middle, float(one.lambda_rho[i] * two.lambda_rho[j]) < 0.0)
    if part == 1 and len(left.critical) == len(right.critical):
        for C in left.critical:
            D = min(right.critical, key=lambda D, C=C: math.dist(C.p, D.p))
            if C.kind != D.kind:
                return _of_set(change_between(C.kind, D.kind), tuple((0.5 * (C.p + D.p)).tolist()))
    if part == 2 and left.exponent is not None and right.exponent is not None:
        return lambda state: math.nan if state.exponent is None else state.exponent
    return None


def _nearest_direction(state: State, theta: float) -> int:
    """Return the limit direction (from 0) nearest to an angle."""
    gaps = [abs(math.remainder(theta - other, 2.0 * math.pi)) for other in state.equator.theta.tolist()]
    return min(range(len(gaps)), key=gaps.__getitem__)


def _of_direction(theta: float, radial: bool) -> Measure:
    """Return lambda_rho or lambda_theta of the limit direction nearest to an angle."""

    def measure(state: State) -> float:
        equator = state.equator
        if not len(equator):
            return math.nan
        return float((equator.lambda_rho if radial else equator.lambda_theta)[_nearest_direction(state, theta)])

    return measure


def _of_set(change: SpecialKind, place: tuple[float, float]) -> Measure:
    """Return the test function of a change, of the critical set nearest to a place."""

    def measure(state: State) -> float:
        if not state.critical:
            return math.nan
        C = min(state.critical, key=lambda C: math.dist(C.p, place))
        return change.function(float(C.trace), float(C.determinant))

    return measure
