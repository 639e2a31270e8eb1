"""The part of a span on which limit cycles can be: where C is on the hemisphere, which may be a narrow part."""

from __future__ import annotations

import math
from collections.abc import Callable

from ..numerics.root_between import root_between
from .branch_ends import values
from .parameter_family import ParameterFamily

NARROW_SHARE = 0.25  # of the span: a part narrower than this is looked at by itself
MARGIN_SHARE = 0.05  # of the part: how far it is looked beyond its ends
SCAN_STEPS, GOLDEN_SECTION = 48, 0.5 * (math.sqrt(5.0) - 1.0)


def admissible_interval(family: ParameterFamily, low: float, high: float) -> tuple[float, float]:
    """Return the part of a span on which cycles are to be looked for: the whole span where it is no narrow part.

    C with det A > 0 is on the hemisphere where |adj(A) f| < det A. Along f this margin is concave, so that its
    greatest value, and the ends of the part, are found however narrow the part is.

    Parameters
    ----------
    family : ParameterFamily
    low, high : float
    """

    def margin(value: float) -> float:
        if not family.bounds[0] <= value <= family.bounds[1]:
            return -math.inf
        a, b, d, f1, f2 = family.at(value)[0].plane
        return min(a * d + b * b - math.hypot(d * f1 + b * f2, a * f2 - b * f1), -a * d)

    places = values(low, high)
    found = [margin(v) for v in places]
    steps = range(len(places))
    for i in steps:
        before, after = max(i - 1, 0), min(i + 1, len(places) - 1)
        highest = found[before] <= found[i] >= found[after] and found[before] + found[after] < 2.0 * found[i]
        if highest and -math.inf < found[i] <= 0.0:
            places[i], found[i] = _greatest(margin, places[before], places[after])
    inside = [i for i in steps if found[i] > 0.0]
    if not inside:
        return low, high
    first, last = inside[0], inside[-1]
    start = root_between(margin, places[first - 1], places[first]) if first > 0 else low
    end = root_between(margin, places[last], places[last + 1]) if last < len(places) - 1 else high
    if end - start > NARROW_SHARE * (high - low):
        return low, high
    more = MARGIN_SHARE * (end - start)
    return max(start - more, low), min(end + more, high)


def _greatest(function: Callable[[float], float], low: float, high: float) -> tuple[float, float]:
    """Maximise a function by golden sections; return where and the value, at the latest where it is positive."""
    one, two = high - GOLDEN_SECTION * (high - low), low + GOLDEN_SECTION * (high - low)
    at_one, at_two = function(one), function(two)
    for _ in range(SCAN_STEPS):
        if max(at_one, at_two) > 0.0:
            break
        if at_one > at_two:
            high, two, at_two = two, one, at_one
            one = high - GOLDEN_SECTION * (high - low)
            at_one = function(one)
        else:
            low, one, at_one = one, two, at_two
            two = low + GOLDEN_SECTION * (high - low)
            at_two = function(two)
    return (one, at_one) if at_one > at_two else (two, at_two)
