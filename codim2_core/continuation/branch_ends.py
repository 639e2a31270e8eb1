"""Find where branches of limit cycles can begin and end: roots along the parameter.

On the closed hemisphere a cycle of the e-linear layer problem can only shrink to C (Hopf), meet another (fold), or
reach the equator: the closed equator where its exponent changes sign, a loop through two half-saddles
(`cycles.heteroclinic_cycle`), or such a loop through a saddle-node of the equator.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ..arrays import Array
from ..cycles.heteroclinic_cycle import HeteroclinicCycle, gaps, heteroclinic_cycles
from ..layer_problem.closed_equator import exponents as closed_exponents
from ..layer_problem.closed_equator import slowest_turn
from ..layer_problem.equator import equator_cycle, number_of_directions
from ..layer_problem.lyapunov import first_lyapunov
from ..layer_problem.problem import LayerProblem, found_once
from ..numerics.root_between import root_between, vertex_through
from .parameter_family import ParameterFamily

END_SAMPLES = 129  # values at which traces and exponents are looked at
GAP_VALUES = 9  # and gaps of loops
MIN_THETA_SHARE = 1e-6  # of the coefficients: by how much Theta may seem to vanish on an equator that is closed
GAP_TOLERANCE = 1e-7  # tolerance for the sign of a gap
NEAR_BORDER = (1e-10, 1e-8, 1e-6)  # of a distance between samples: how far from where a function ceases to be defined
MAX_END_DISTANCE = 0.1  # of the span: how far beyond the last cycle its end is looked for


@dataclass(frozen=True)
class BranchEnd:
    """A value of the parameter at which a cycle is born or dies.

    Attributes
    ----------
    kind : str
        "Hopf", "equator", "heteroclinic cycle through the equator", "saddle-node on the equator" or "det A = 0".
    value : float
    period, amplitude : float
        Limits of those of the cycle.
    measure : float
        First Lyapunov coefficient; ratio of the loop; 0 for the rest.
    """

    kind: str
    value: float
    period: float
    amplitude: float
    measure: float = 0.0


def values(low: float, high: float, count: int = END_SAMPLES) -> list[float]:
    """Values of the parameter at which a family is looked at, ends included."""
    return [low + (high - low) * i / (count - 1) for i in range(count)]


def hopf_ends(family: ParameterFamily, low: float, high: float) -> list[BranchEnd]:
    """All Hopf points: tr J = 0 < det J.

    Parameters
    ----------
    family : ParameterFamily
    low, high : float
    """

    def traces(places: list[float]) -> Array:
        out, placed = np.full(len(places), math.nan), family.placed(places)
        if placed is not None:
            out[placed.rows] = placed.sections(0).trace
        return out

    ends = []
    for value in _roots(traces, family.room, values(low, high)):
        coefficients, psi = family.at(value)
        (C,) = family.problem(value).critical
        number = float(first_lyapunov(coefficients.A, psi, C.x2[None, :])[0])
        ends.append(BranchEnd("Hopf", value, 2.0 * math.pi / math.sqrt(C.determinant), 0.0, number))
    return ends


def equator_ends(family: ParameterFamily, low: float, high: float) -> list[BranchEnd]:
    """All values at which the closed equator has the exponent zero.

    Parameters
    ----------
    family : ParameterFamily
    low, high : float
    """

    def exponents(places: list[float]) -> Array:
        out, placed = np.full(len(places), math.nan), family.placed(places)
        if placed is not None:
            # elsewhere there are equilibria on it, without asking further
            closed = np.flatnonzero(slowest_turn(placed.planes) > -MIN_THETA_SHARE)
            quick = np.arctan(closed_exponents(placed.planes[closed])) if len(closed) > 1 else np.full(1, math.nan)
            for i, found in zip(closed.tolist(), quick.tolist(), strict=False):
                row = placed.rows[i]
                out[row] = exponent(places[row]) if math.isnan(found) else found  # None is NaN
        return out

    def turning(value: float) -> float:
        return float(slowest_turn(family.planes([value]))[0])

    exponent = _exponent(family)
    return [_equator_end(family, "equator", value) for value in _roots(exponents, turning, values(low, high))]


def _exponent(family: ParameterFamily) -> Callable[[float], float | None]:
    def exponent(value: float) -> float | None:
        found = equator_cycle(family.at(value)[0]) if family.allows(value) else None
        return None if found is None else math.atan(found.exponent)

    return exponent


def _zero_exponent_near(
    family: ParameterFamily, value: float, direction: float, width: float, ahead: float | None
) -> BranchEnd | None:
    """Find the zero of the closed equator's exponent nearest to a value, ahead of it or just behind."""
    exponent = _exponent(family)
    here = exponent(value)
    for k in range(1, 11):
        for sign in (1.0, -1.0) if k < 8 else (1.0,):
            there = value + sign * direction * width * 10.0 ** (0.8 * (k - 11.0)) * MAX_END_DISTANCE
            if ahead is not None and sign > 0.0 and (there - ahead) * direction > 0.0:
                there = ahead
            after = exponent(there)
            if here is not None and after is not None and here * after <= 0.0:
                place = root_between(lambda v: exponent(v) or 0.0, min(value, there), max(value, there))
                return _equator_end(family, "equator", place)
    return None


def _equator_end(family: ParameterFamily, kind: str, value: float, measure: float = 0.0) -> BranchEnd:
    found = family.problem(value).critical
    away = 1.0 + float(np.hypot(*found[0].p)) if found else 2.0
    return BranchEnd(kind, value, math.inf, away, measure)


def loop_ends(family: ParameterFamily, low: float, high: float) -> list[BranchEnd]:
    """All values found at which a loop closes: gaps that change sign between `GAP_VALUES` values.

    Parameters
    ----------
    family : ParameterFamily
    low, high : float
    """
    columns = values(low, high, GAP_VALUES)
    arcs = [_arcs(family, v) for v in columns]
    pairs = [
        (i, loop, _nearest_loop(arcs[i + 1], loop)) for i in range(len(columns) - 1) for loop in arcs[i] if arcs[i + 1]
    ]
    asked = list(dict.fromkeys(place for i, loop, after in pairs for place in ((i, loop), (i + 1, after))))
    found = gaps([(*family.at(columns[i]), loop) for i, loop in asked], GAP_TOLERANCE)
    sign = dict(zip(asked, found, strict=True))
    ends = []
    for i, loop, after in pairs:
        if sign[i, loop] * sign[i + 1, after] < 0.0:
            end = loop_end(family, columns[i], columns[i + 1], loop)
            if end is not None:
                ends.append(end)
    return ends


def loop_end(family: ParameterFamily, low: float, high: float, loop: HeteroclinicCycle) -> BranchEnd | None:
    """Find the value between two at which a loop closes, or None if the gap is not seen to change sign.

    Parameters
    ----------
    family : ParameterFamily
    low, high : float
    loop : Loop
        At, or near, one of them.
    """

    def miss(value: float) -> float:
        return _splittings(family, [(value, loop)])[0]

    at_low, at_high = _splittings(family, [(low, loop), (high, loop)])
    if not at_low * at_high < 0.0:
        return None
    value = root_between(miss, low, high)
    arcs = _arcs(family, value)
    if not arcs or abs(miss(value)) > 1e-6:
        return None
    return _equator_end(family, "heteroclinic cycle through the equator", value, _nearest_loop(arcs, loop).ratio)


def _splittings(family: ParameterFamily, asked: Sequence[tuple[float, HeteroclinicCycle]]) -> list[float]:
    """Find the arc tangents of gaps of the loops nearest to given ones, on their rays; NaN where there is none."""
    found = [_arcs(family, value) for value, _ in asked]
    there = [i for i, arcs in enumerate(found) if arcs]
    ask = [(*family.at(asked[i][0]), _nearest_loop(found[i], asked[i][1], asked[i][1].ray)) for i in there]
    out = dict(zip(there, map(math.atan, gaps(ask)), strict=True))
    return [out.get(i, math.nan) for i in range(len(asked))]


def _arcs(family: ParameterFamily, value: float) -> tuple[HeteroclinicCycle, ...]:
    return _loops_of(family.problem(value)) if family.allows(value) else ()


@found_once()
def _loops_of(problem: LayerProblem) -> tuple[HeteroclinicCycle, ...]:
    coefficients = problem.at.normal_form
    return () if coefficients is None else heteroclinic_cycles(coefficients)


def _nearest_loop(
    arcs: tuple[HeteroclinicCycle, ...], loop: HeteroclinicCycle, ray: int | None = None
) -> HeteroclinicCycle:
    def distance(other: HeteroclinicCycle) -> float:
        return abs(math.remainder(other.sink - loop.sink, 2.0 * math.pi)) + abs(
            math.remainder(other.source - loop.source, 2.0 * math.pi)
        )

    found = min(arcs, key=distance)
    return found if ray is None else HeteroclinicCycle(found.source, found.sink, found.ratio, ray)


def at_equator(
    family: ParameterFamily, value: float, direction: float, width: float, known: list[BranchEnd], reach: float
) -> BranchEnd | None:
    """Name the end of a branch that has come to the equator near a value.

    Parameters
    ----------
    family : ParameterFamily
    value : float
        Of the last cycle.
    direction : float
        +1 or -1: the sense in which the value moved.
    width : float
        Length of the span.
    known : list of BranchEnd
        Those on the equator found before.
    reach : float
        How far from the value an end can be.

    Returns
    -------
    BranchEnd, or None
        None if no end explains it.
    """
    nearest = min((end for end in known), key=lambda end: abs(end.value - value), default=None)
    if nearest is not None and abs(nearest.value - value) < 1e-4 * width:
        return nearest
    found = _equator_near(family, value, direction, width, known, reach)
    return found if found is not None and abs(found.value - value) <= reach else None


def _equator_near(
    family: ParameterFamily, value: float, direction: float, width: float, known: list[BranchEnd], reach: float
) -> BranchEnd | None:
    """Find what becomes of cycles at the equator near a value: its exponent's zero, a loop, a saddle-node."""
    ahead = _saddle_node_ahead(family, value, direction, width)
    if equator_cycle(family.at(value)[0]) is not None:
        end = _zero_exponent_near(family, value, direction, width, ahead)
        if end is not None:
            return min((e for e in known if abs(e.value - end.value) < 1e-9 * width), key=id, default=end)
    arcs = _arcs(family, value)
    steps = [direction * width * 10.0 ** (k - 9.0) for k in range(1, 9)]
    steps = [step for step in steps if abs(step) <= 10.0 * reach]
    if ahead is not None:
        steps = [(1.0 - 1e-9) * (ahead - value) if abs(step) > abs(ahead - value) else step for step in steps]
    # on the other side there may be no loop at all
    tries = [(value + sign * step, loop) for step in steps for loop in arcs for sign in (1.0, -1.0)]
    sides = _splittings(family, [*((value, loop) for loop in arcs), *tries])
    here = dict(zip(arcs, sides, strict=False))
    for (there, loop), miss in zip(tries, sides[len(arcs) :], strict=True):
        if here[loop] * miss < 0.0:
            end = loop_end(family, min(value, there), max(value, there), loop)
            if end is not None:
                return end
    return None if ahead is None else _equator_end(family, "saddle-node on the equator", ahead)


def at_singular(family: ParameterFamily, value: float, direction: float, width: float) -> BranchEnd | None:
    """Find det A = 0 close ahead, with a whole line of equilibria through the cycle, or None."""

    def determinant(v: float) -> float:
        a, b, d = family.at(v)[0].plane[:3]
        return a * d + b * b

    far = value + 0.02 * direction * width
    if determinant(far) > 0.0:
        return None
    place = root_between(determinant, *sorted((value, far)))
    return BranchEnd("det A = 0", place, math.inf, math.nan)


def _saddle_node_ahead(family: ParameterFamily, value: float, direction: float, width: float) -> float | None:
    """Find the first value within `MAX_END_DISTANCE` ahead at which the number of limit directions changes."""
    count = number_of_directions(family.at(value)[0])
    near = value
    for k in range(1, 41):
        far = value + direction * width * MAX_END_DISTANCE * (k / 40.0) ** 3
        if number_of_directions(family.at(far)[0]) != count:
            for _ in range(60):
                middle = 0.5 * (near + far)
                if number_of_directions(family.at(middle)[0]) == count:
                    near = middle
                else:
                    far = middle
            return near
        near = far
    return None


def _roots(
    function: Callable[[list[float]], Array], margin: Callable[[float], float], places: list[float]
) -> list[float]:
    """Zeros of a function that may be undefined (NaN) in parts, by its changes of sign between the places.

    Where it comes near zero and turns back, the vertex of a parabola is asked too; where it begins or ends to be
    defined, `margin` changes its sign, and a place all but there: the function may change its own before.
    """
    found = function(places).tolist()
    more: list[tuple[float, float]] = []
    for (one, y1), (two, y2) in pairwise(zip(places, found, strict=True)):
        if math.isnan(y1) != math.isnan(y2):
            more += _at_border(function, margin, *((one, two) if math.isnan(y2) else (two, one)))
    vertices = [vertex_through(places[i - 1 : i + 2], found[i - 1 : i + 2]) for i in range(1, len(places) - 1)]
    asked = [v for v in vertices if v is not None]
    more += zip(asked, function(asked).tolist(), strict=True)
    line = sorted((v, y) for v, y in [*zip(places, found, strict=True), *more] if not math.isnan(y))
    gaps = [v for v, y in zip(places, found, strict=True) if math.isnan(y)]
    roots = []
    for (v0, y0), (v1, y1) in pairwise(line):
        if y0 == 0.0:
            roots.append(v0)
        elif y0 * y1 < 0.0 and not any(v0 < v < v1 for v in gaps):
            roots.append(root_between(lambda v: float(function([v])[0]), v0, v1))
    if line and line[-1][1] == 0.0:
        roots.append(line[-1][0])
    return roots


def _at_border(
    function: Callable[[list[float]], Array], margin: Callable[[float], float], inside: float, outside: float
) -> list[tuple[float, float]]:
    """Return a place, and the function there, all but where it ceases to be defined; none if there is none."""
    border = root_between(margin, inside, outside)
    for share in NEAR_BORDER:
        value = border + share * (inside - border)
        y = float(function([value])[0])
        if value != inside and not math.isnan(y):
            return [(value, y)]
    return []
