"""Name the beginning or end of a branch of cycles.

`build_branch` makes the public branch from its points: folds and ends, as arrays.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Protocol

import numpy as np

from ...numerics.sign_changes import root_between
from ...portrait.cycles.heteroclinic_cycle import loop_gap
from ...portrait.cycles.ray_section import heteroclinic_arcs
from ...portrait.layer_problem.problem import LayerProblem
from ...results.arrays import Array
from ...results.words import say
from .result import CycleBranch, CyclePoint
from .turns import Problems, ReturnMapPoint, SectionBase

#: Of one point: value, period, amplitude, exponent, and where the cycle crosses its section.
PointRow = tuple[float, float, float, float, float, float]


def point_row(turn: ReturnMapPoint) -> PointRow:
    """Return the row of a closed turn."""
    return turn.value, turn.period, turn.amplitude, turn.exponent, *turn.p


def build_branch(
    name: str, rows: Sequence[PointRow], folds: Sequence[ReturnMapPoint], start: CyclePoint, end: CyclePoint
) -> CycleBranch:
    """Make a branch of its rows in order, limits at ends that are no cycles among them."""
    table = np.array(rows)
    points = []
    for t in folds:
        text = say("branch folds", name=name, value=t.value)
        points.append(CyclePoint("fold of cycles", t.value, t.period, t.amplitude, text))
    exponent = np.ascontiguousarray(table[:, 3])
    columns: dict[str, Any] = {
        "value": table[:, 0],
        "period": table[:, 1],
        "amplitude": table[:, 2],
        "exponent": exponent,
        "multiplier": np.exp(np.clip(exponent, -700.0, 700.0)),
        "stable": exponent < 0.0,
        "section": table[:, 4:6],
    }
    for key, array in columns.items():
        columns[key] = np.ascontiguousarray(array)
        columns[key].flags.writeable = False
    return CycleBranch(start=start, end=end, folds=tuple(points), **columns)


#: Distance from a saddle, and ebar, at which a cycle that nears it all the time is all but a loop.
LOOP_DISTANCE, EQUATOR_HEIGHT = 0.03, 0.03
LOOP_THROUGH_EQUATOR = "heteroclinic cycle through the equator"
PERIOD_GROWTH = 1.05  # times the period before: what goes to a loop becomes slower
#: Of the span: how far from the last cycle a loop may be, and what is special.
LIMIT_TOLERANCE, MAX_END_DISTANCE = 1e-4, 0.1
LIMIT_PERIOD_GROWTH = 1.5  # times the period before: cycles that tell the value to which those of growing periods tend
RATE_BOUNDS = 0.05, 20.0  # with which powers of the period the values come to it
SADDLE_NODE_DISTANCE = 2.0  # times the way to it: there a saddle-node, to which they come more slowly, may be the end
SAME_SLOPE = 0.1  # relative: slopes of the logarithm of the period that are one
MAX_LIMIT_DISTANCE = 10.0  # times the way of the last cycles: how far from the last one is what they come to


SINGULAR, SINGULAR_DISTANCE = ("det A = 0", "line of equilibria"), 0.02  # of the span: from the last cycle
LEAST_LOOP_STEP, MAX_LOOP_STEP = 1e-11, 0.02  # of the span: steps in which a loop is looked for
LOOP_STEP_GROWTH = 3.0
SAME_VALUE_SHARE = 1e-9  # of the span: within it are the values of cycles of different periods at a loop
CANDIDATE_POINTS = 12  # the last cycles, of which one is compared
BAND_EXPONENT = 1e-10  # of the smallest cycle followed: it is one of a band


class MarkedValue(Protocol):
    """A special value of the equilibria, as `diagrams` finds them."""

    @property
    def kind(self) -> str:
        """Return the kind of the bifurcation."""
        ...

    @property
    def value(self) -> float:
        """Return the value of the parameter."""
        ...

    @property
    def place(self) -> tuple[float, float]:
        """In the projected disc."""
        ...


@dataclass(frozen=True)
class LastCycles:
    """The last cycles of a branch: the turn, the states along it, an earlier one, and those that slow down to it."""

    turn: ReturnMapPoint
    states: Array
    before: ReturnMapPoint
    earlier: Array
    slower: Sequence[ReturnMapPoint]


@dataclass(frozen=True)
class BranchEnd:
    """An end: what it is, and the limit of the branch there where that is no cycle."""

    point: CyclePoint
    limit: PointRow | None = None


def hopf_end(name: str, value: float, problem: LayerProblem, place: Sequence[float], exponent: float) -> BranchEnd:
    """Name the end at a Hopf point of the critical set next to a place, with the exponent of the cycle next to it."""
    C = min(problem.critical, key=lambda C: math.dist(C.p, place))
    period = 2.0 * math.pi / math.sqrt(C.determinant)
    key = "born, stable" if exponent < 0.0 else "born, unstable"
    sentence = say("born, in a band" if abs(exponent) < BAND_EXPONENT else key, name=name, value=value)
    x, y = C.p.tolist()
    return BranchEnd(CyclePoint("Hopf", value, period, 0.0, sentence), (value, period, 0.0, 0.0, x, y))


def equator_end(
    name: str, turn: ReturnMapPoint, marked: Sequence[MarkedValue], width: float, centre: SectionBase
) -> BranchEnd | None:
    """Name the end at the closed equator, where its exponent changes its sign; None if that is not nearby."""
    near = [
        m.value for m in marked if m.kind == "neutral equator" and abs(m.value - turn.value) < MAX_END_DISTANCE * width
    ]
    if not near:
        return None
    value = min(near, key=lambda v: abs(v - turn.value))
    away = 1.0 + math.hypot(*centre.place(value).p)
    point = CyclePoint("equator", value, math.inf, away, say("becomes the equator", name=name, value=value))
    return BranchEnd(point, (value, math.inf, away, 0.0, *turn.p))


def singular_end(
    name: str, turn: ReturnMapPoint, marked: Sequence[MarkedValue], way: float, width: float
) -> BranchEnd | None:
    """Name the end at a value with det A = 0 close ahead, with a line of equilibria through the cycle; or None."""
    singular = [m.value for m in marked if m.kind in SINGULAR]
    near = [v for v in singular if 0.0 <= (v - turn.value) * math.copysign(1.0, way) < SINGULAR_DISTANCE * width]
    if not near:
        return None
    value = min(near, key=lambda v: abs(v - turn.value))
    point = CyclePoint("det A = 0", value, math.inf, math.nan, say("meets a line", name=name, value=value))
    return BranchEnd(point, (value, math.inf, turn.amplitude, math.copysign(math.inf, turn.exponent), *turn.p))


def at_one_value(turns: Sequence[ReturnMapPoint], width: float) -> bool:
    """Whether cycles are at one value, within what continuation can tell."""
    values = [turn.value for turn in turns]
    return max(values) - min(values) < SAME_VALUE_SHARE * width


def at_loop(turns: Sequence[ReturnMapPoint], width: float) -> bool:
    """Whether the last cycles differ in their periods, but no longer in their values: another ray shows no more."""
    slow, quick = (choose(turns[-CANDIDATE_POINTS:], key=lambda turn: turn.period) for choose in (max, min))
    return slow.period > PERIOD_GROWTH * quick.period and at_one_value((slow, quick), width)


def slow_sequence(turns: Sequence[ReturnMapPoint]) -> list[ReturnMapPoint]:
    """Return the last cycle, and up to two before it of much shorter periods."""
    three = [turns[-1]]
    for turn in reversed(turns[:-1]):
        if (
            len(three) < 3 and 0.0 < LIMIT_PERIOD_GROWTH * turn.period < three[-1].period
        ):  # one carried too far may be negative
            three.append(turn)
    return three


def limit_value(slower: Sequence[ReturnMapPoint], slowness: Callable[[float], float] = math.log) -> float | None:
    """Extrapolate the values of three cycles whose periods grow, as v + C exp(-r slowness(period)); None if not."""
    if len(slower) < 3:
        return None
    last, middle, first = slower
    way = middle.value - last.value
    if not (ratio := (first.value - middle.value) / way if way else 0.0) > 0.0:
        return None
    one, two = (slowness(last.period) - slowness(turn.period) for turn in (first, middle))

    def miss(r: float) -> float:
        return 1.0 - math.exp(r * (two - one)) - ratio * (math.exp(r * (two - one)) - math.exp(-r * one))

    if miss(RATE_BOUNDS[0]) * miss(RATE_BOUNDS[1]) > 0.0:
        return None
    power = root_between(miss, *RATE_BOUNDS) * two
    return last.value + way * math.exp(-power) / math.expm1(-power)


def slow_down_at(slower: Sequence[ReturnMapPoint], value: float) -> bool:
    """Whether the periods of three cycles grow as exp(c/sqrt(distance from a value)), as at a saddle-node there."""
    if len(slower) < 3:
        return False
    rows = [(abs(turn.value - value) ** -0.5, math.log(turn.period)) for turn in slower if turn.value != value]
    slopes = [(y - v) / (x - u) if x != u else math.nan for (x, y), (u, v) in pairwise(rows)]
    return len(slopes) == 2 and slopes[0] > 0.0 and abs(slopes[1] - slopes[0]) < SAME_SLOPE * slopes[0]


def loop_end(
    name: str, last: LastCycles, problem: LayerProblem, marked: Sequence[MarkedValue], width: float
) -> BranchEnd | None:
    """Name the end at a loop of saddles, which cycles near ever more slowly; None if they do not."""
    turn = last.turn
    if turn.period < PERIOD_GROWTH * last.before.period:
        return None
    far_first = sorted(marked, key=lambda m: -abs(m.value - turn.value))
    ahead = {m.kind: m for m in far_first if _lies_ahead(m, last, width)}  # the nearest of each kind
    fold, meeting = ahead.get("fold of critical sets"), ahead.get("saddle-node")
    if fold is not None and min(_gaps([fold.place], last.states)) < LOOP_DISTANCE:
        return _make_end(
            "saddle-node on the cycle", say("meets two sets", name=name, value=fold.value), turn, fold.value
        )
    sunk, settled = _comes_to_equator(last), abs(turn.value - last.before.value) < LIMIT_TOLERANCE * width
    limit = limit_value(last.slower)
    value = turn.value if limit is None else limit
    reached = meeting is not None and (
        abs(meeting.value - turn.value) < SADDLE_NODE_DISTANCE * abs(value - turn.value)
        or slow_down_at(last.slower, meeting.value)
    )
    if sunk and meeting is not None and (reached or not settled):
        sentence = say("meets a saddle-node", name=name, value=meeting.value)
        return _make_end("saddle-node on the equator", sentence, turn, meeting.value)
    near_limit = settled or 0.0 < abs(turn.value - value) < LIMIT_TOLERANCE * width
    saddles = [C.p for C in problem.critical if C.kind == "saddle"]
    # What cycles of growing periods tend to holds an equilibrium: one on the equator where there is no saddle within.
    coming_down = sunk or (not saddles and turn.height < last.before.height)
    if coming_down and len(problem.equator) and near_limit:
        return loop_branch_end(name, turn, value)
    pairs = zip(_gaps(saddles, last.states), _gaps(saddles, last.earlier), strict=True)
    near = sum(now < LOOP_DISTANCE and now < before for now, before in pairs)
    if near and near_limit:
        kind = "homoclinic" if near == 1 else "heteroclinic"
        limit = limit_value(last.slower, lambda period: period / turn.period)  # the rate is a saddle's exponent
        at = turn.value if settled or limit is None else limit
        return _make_end(f"{kind} cycle", say(f"becomes {kind}", name=name, value=at), turn, at)
    return None


def loop_branch_end(name: str, turn: ReturnMapPoint, value: float) -> BranchEnd:
    """Name the end at a loop through the equator, which closes at a value."""
    how = "attracting" if turn.exponent < 0.0 else "repelling"
    return _make_end(LOOP_THROUGH_EQUATOR, say("becomes a loop", how=how, name=name, value=value), turn, value)


def loop_value(
    problem: Problems, centre: SectionBase, last: ReturnMapPoint, states: Array, estimate: float, width: float
) -> float | None:
    """Find the value at which the loop through the equator closes that the last cycle of a branch comes to.

    None where the branches of its half-saddles are not seen to meet. Shapes: states (k, 3).
    """
    low = states[int(states[:, 2].argmin()), :2]
    theta = np.array([math.atan2(low[1], low[0])])
    arc = next((one for one in heteroclinic_arcs(problem(last.value)) if one.spans(theta)[0]), None)
    if arc is None:
        return None

    def gap(value: float) -> float:
        there = problem(value)
        found = min((one for one in heteroclinic_arcs(there) if one.sense == arc.sense), key=arc.distance, default=None)
        return math.nan if found is None else math.atan(loop_gap(there, centre.place(value), found))

    here, way = gap(last.value), estimate - last.value
    step = max(abs(way), LEAST_LOOP_STEP * width)
    while step < MAX_LOOP_STEP * width:
        for there in (last.value + math.copysign(step, way), last.value - math.copysign(step, way)):
            try:
                if gap(there) * here < 0.0:
                    return root_between(gap, *sorted((last.value, there)))
            except ValueError:  # beyond what is allowed
                continue
        step *= LOOP_STEP_GROWTH
    return None


def _comes_to_equator(last: LastCycles) -> bool:
    """Whether cycles come down to the equator."""
    return last.turn.height < EQUATOR_HEIGHT and last.turn.height < last.before.height


def _lies_ahead(mark: MarkedValue, last: LastCycles, width: float) -> bool:
    """Whether a special value lies ahead, and the last cycles come to it: a loop is where their values accumulate."""
    way = last.turn.value - last.before.value
    ahead = (mark.value - last.turn.value) * math.copysign(1.0, way)
    return 0.0 <= ahead < min(MAX_END_DISTANCE * width, MAX_LIMIT_DISTANCE * abs(way))


def _make_end(kind: str, sentence: str, turn: ReturnMapPoint, value: float) -> BranchEnd:
    point = CyclePoint(kind, value, math.inf, turn.amplitude, sentence)
    return BranchEnd(point, (value, math.inf, turn.amplitude, math.copysign(math.inf, turn.exponent), *turn.p))


def _gaps(places: Sequence[Sequence[float]] | Sequence[Array], states: Array) -> list[float]:
    """Smallest distances in the disc of places from a cycle."""
    return [float(np.hypot(*(states[:, :2] - p).T).min()) for p in places]
