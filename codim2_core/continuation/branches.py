"""Branches of limit cycles along one parameter: from where they are born, through folds, to where they end.

A cycle is a fixed point of the return map of `cycles`; `turns` has its derivatives and
`corrector` follows it. Branches are begun at every Hopf point and at every end on the equator
(`branch_ends`), and at every cycle that is seen at one of several values and that no branch has yet passed: so
closed branches between two folds are found too.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from itertools import chain
from typing import cast

import numpy as np
from numpy.typing import ArrayLike

from ..cycles.fixed_point_search import find_fixed_points, sample_return_map, search
from ..cycles.limit_cycles import reason_for_none
from ..layer_problem.critical import critical_sets
from ..layer_problem.vary import limits, vary
from ..psi.function import Psi
from ..systems.coefficients import Coefficients
from ..systems.kinds import AnySystem
from ..words import say
from .branch_arrays import PointRow, build_branch, point_row
from .branch_ends import BranchEnd, at_equator, at_singular, equator_ends, hopf_ends, loop_ends, values
from .continuation_points import ContinuationPoints, TurnGuess, points_at_value, reversed_trace
from .corrector import BranchTracer
from .existence_interval import admissible_interval
from .lockstep_searches import run_batched
from .parameter_family import AffineCoefficients, ParameterFamily, TurnRoutine, reversible, run_batch, side_by_side
from .predictor_corrector import BAND_HEIGHT, all_traced, trace_branch
from .result import CycleBranch, CycleBranches, CyclePoint
from .turns import ReturnMapPoint

__all__ = ["CycleBranch", "CycleBranches", "CyclePoint", "continue_cycles"]

START_SHARE = 1e-3  # of the reach: where branches start at C
# |x2| where they start at the equator: where 1 - |e|^2 comes to the second of these, as folds may lie far out
START_HEIGHTS, MIN_HEIGHT_SQUARED = np.array([5.0, 10.0, 20.0, 50.0, 100.0, 300.0, 1000.0, 3000.0]), 1e-24
PLANE = ("a", "b", "d", "f1", "f2")
CENSUS_VALUES = 9  # values at which all cycles are looked for

#: A branch: its points, its start and end, and what these are if they are no cycles.
Entry = tuple[ContinuationPoints, CyclePoint, CyclePoint, BranchEnd | None, BranchEnd | None]

AVOIDED_DISTANCE, SAME_CHI = (
    0.1,
    1e-6,
)  # distances in chi: a branch does not pass near a cycle; a cycle is that of the branch


def continue_cycles(
    system: AnySystem, psi: Psi, name: str, span: tuple[float, float], z: ArrayLike = (), axes: float = 0.0
) -> CycleBranches:
    """Continue the limit cycles of the layer problem eq:LP along one parameter (sec:case3).

    Branches are begun at Hopf points, at ends on the equator and at the cycles seen at some values: one that begins at
    none of these and lies between those values is not seen.

    Parameters
    ----------
    system : ELinear, or Coefficients
    psi : Psi
    name : str
        What varies: a, b, d, f1, f2, a parameter of the system, z1, z2, ..., or n of a Hill Psi:
        see `layer_problem.vary.names`.
    span : (low, high)
    z : (m,) floats
    axes : float
        Of an `ELinear.from_matrix`: of its rotations into the normal form, by angles half a turn apart, the one by the
        angle nearest to this is taken, and places are told in these axes. By `rotation` itself if it is left out.

    Returns
    -------
    CycleBranches

    Raises
    ------
    ValueError
        The span is not an interval, nothing variable has this name, a value is not allowed, or the system is not
        e-linear.
    """
    try:
        low, high = (float(v) for v in span)
    except (TypeError, ValueError) as error:
        raise ValueError(f"span is {span!r}; give two numbers (low, high).") from error
    if not (math.isfinite(low) and math.isfinite(high) and low < high):
        raise ValueError(f"span is {span!r}; give finite numbers low < high.")

    if system.typed is not None or psi.saturation < math.inf:
        raise ValueError("continue_cycles is for e-linear systems and Psi > 0 (R3); branches continues the others.")
    straight = None
    if name in PLANE and name in system.variable and not getattr(system, "given_matrix", None):
        # nothing else varies: coefficients are checked and evaluated once
        system, z = (coefficients := cast("Coefficients", system.at(z))), ()
        slope = np.eye(len(PLANE))[PLANE.index(name)]
        straight = AffineCoefficients((1.0 - slope) * coefficients.plane, slope, psi)
    elif name not in system.variable and psi.record.parameter is not None and name == psi.record.parameter.name:
        system, z = cast("Coefficients", system.at(z)), ()  # only Psi varies

    def inside(value: float) -> tuple[Coefficients, Psi]:
        changed, family_psi, place = vary(system, psi, z, name, value)
        return changed.at(place).by_rotation_near(axes), family_psi

    def at(value: float) -> tuple[Coefficients, Psi]:
        try:
            return inside(value)
        except ValueError:
            if low <= value <= high:
                raise
            return inside(min(max(value, low), high))  # a look beyond the span, where the system ends

    for value in (low, high):
        at(value)
    bounds = limits(system, psi, name)
    part = admissible_interval(ParameterFamily(at, high - low, bounds, straight), low, high)
    family = ParameterFamily(at, part[1] - part[0], bounds, straight)
    allowed = family.allowed(values(*part))
    if all(reversible(at(v)[0]) for v in allowed):
        settings = (at(float(v)) for v in values(low, high))
        reasons = dict.fromkeys(reason_for_none(q, critical_sets(q, member)) for q, member in settings)
        sentence = f" {say('elsewhere')} ".join(r for r in reasons if r)
        return CycleBranches(name, (low, high), (), sentence or say("no cycle on the span"))
    middle = allowed[len(allowed) // 2]
    family.ray = family.section(middle).ray
    (found,) = run_batched([_BranchSearch(family, name, part, (low, high)).run()], run_batch)
    return found


def folds_along(lines: Sequence[AffineCoefficients], low: float, high: float) -> list[list[tuple[int, ReturnMapPoint]]]:
    """Find the folds on all branches of cycles along each of several lines.

    Parameters
    ----------
    lines : sequence of AffineCoefficients
    low, high : float

    Returns
    -------
    list of list of (int, Turn)
        The ray of each section, and the turn.
    """
    searches = []
    for line in lines:
        family = ParameterFamily(partial(_system_on, line), high - low, straight=line)
        allowed = family.allowed(values(low, high))
        if not all(reversible(family.at(v)[0]) for v in allowed):
            family.ray = family.section(allowed[len(allowed) // 2]).ray
            searches.append(_BranchSearch(family, "t", (low, high), (low, high)))
        else:
            searches.append(None)
    run_batched([search.run() for search in searches if search is not None], run_batch)
    return [
        []
        if search is None
        else [(cast("int", search.family.ray), trace.points[i].turn) for trace, *_ in search.found for i in trace.folds]
        for search in searches
    ]


def _system_on(line: AffineCoefficients, value: float) -> tuple[Coefficients, Psi]:
    a, b, d, f1, f2 = (line.origin + value * line.slope).tolist()
    return Coefficients(a, b, d, f1, f2, np.zeros((0, 2)), np.zeros(0)), line.psi


class _BranchSearch:
    """One call of `continue_cycles`."""

    def __init__(
        self, family: ParameterFamily, name: str, part: tuple[float, float], span: tuple[float, float]
    ) -> None:
        self.family, self.name, self.span = family, name, span
        low, high = self.low, self.high = part
        self.tracer = BranchTracer(family, low, high)
        self.hopf = hopf_ends(family, low, high)
        self.closed = equator_ends(family, low, high)
        self.loops = loop_ends(family, low, high)
        self.used: set[int] = set()
        self.found: list[Entry] = []
        centres = {end.value for end in self.hopf if reversible(family.at(end.value)[0])}
        self.notes = [say("band at one value", name=name, value=v) for v in sorted(centres)]
        self.hopf = [end for end in self.hopf if end.value not in centres]
        self.closed = [end for end in self.closed if not reversible(family.at(end.value)[0])]

    def run(self) -> TurnRoutine[CycleBranches]:
        yield from self._from_ends()
        yield from self._columns()
        branches = tuple(self._branch(*entry) for entry in self.found)
        missed = [e for e in self.loops if id(e) not in self.used]
        self.notes += [say("loop without a cycle", name=self.name, value=e.value) for e in missed]
        kind = "no branch" if not branches else "one branch" if len(branches) == 1 else "branches"
        span = {"name": self.name, "low": self.span[0], "high": self.span[1]}
        reason = say(kind, **span, count=len(branches) or CENSUS_VALUES)
        return CycleBranches(self.name, self.span, branches, reason, tuple(self.notes))

    def _nu(self, value: float) -> float:
        return (value - self.low) / (self.high - self.low)

    def _from_ends(self) -> TurnRoutine[None]:
        """Begin where cycles are smallest or largest, at all such ends side by side."""
        ends = [*self.hopf, *self.closed]
        towards = [1.0 if end.kind == "Hopf" else -1.0 for end in ends]
        firsts = yield from side_by_side([self._first(e, t) for e, t in zip(ends, towards, strict=True)])
        caught = [i for i, first in enumerate(firsts) if first is not None and -1e-12 <= first[1] <= 1.0 + 1e-12]
        starts = [
            self.tracer.point(*cast("tuple[ReturnMapPoint, float]", firsts[i]), (towards[i], 0.0)) for i in caught
        ]
        followed = yield from all_traced(self.tracer, starts)
        traces = dict(zip(caught, followed, strict=True))
        for i, end in enumerate(ends):
            if id(end) in self.used:
                continue
            self.used.add(id(end))
            if found := traces.get(i):
                trace, other = found
                if other is None:
                    self._keep(trace, self._special(end), end)
                else:
                    last = ends[caught[other]]
                    self.used.add(id(last))
                    self.found.append((trace, self._special(end), self._special(last), end, last))
            elif firsts[i] is None:
                self.notes.append(say("birth not caught", kind=end.kind, name=self.name, value=end.value))

    def _first(self, end: BranchEnd, towards: float) -> TurnRoutine[tuple[ReturnMapPoint, float] | None]:
        """Find the first cycle of a branch: the parameter is what is solved for."""
        xi, first = math.log(START_SHARE), None
        if end.kind != "Hopf":
            section = self.family.section(end.value)
            outside = int((section.psi.complement(START_HEIGHTS) > MIN_HEIGHT_SQUARED).sum())
            xi = float(section.xi_at_radius(START_HEIGHTS[[min(outside, len(START_HEIGHTS) - 1)]])[0])
        for start in (xi, xi - 0.4 * towards * abs(xi)):
            first = first or (
                yield from self.tracer.corrected(TurnGuess(start, self._nu(end.value), (1.0, 0.0), backward=False))
            )
        return first

    def _columns(self) -> TurnRoutine[None]:
        """Begin at each cycle that no branch has passed."""
        guesses = [guess for value in values(self.low, self.high, CENSUS_VALUES) for guess in self._unexplained(value)]
        corrected = yield from side_by_side([self.tracer.corrected(guess) for guess in guesses])
        firsts, passed = [first for first in corrected if first is not None], len(self.found)
        known = yield from side_by_side([self._known(first, self.found) for first in firsts])
        for first, old in zip(firsts, known, strict=True):
            if old or (yield from self._known(first, self.found[passed:])):
                continue
            point = self.tracer.point(*first, (1.0, 0.0))
            trace = yield from trace_branch(self.tracer, point)
            if trace.reason == "closed":
                special = CyclePoint(
                    "closed", point.turn.value, point.turn.period, point.turn.amplitude, say("branch closed")
                )
                self.found.append((trace, special, special, None, None))
                continue
            turned = (-point.tangent[0], -point.tangent[1])
            other = yield from trace_branch(self.tracer, self.tracer.point(*first, turned))
            start, end = self._end(other)
            back = reversed_trace(other)
            joined = ContinuationPoints(
                back.points[:-1] + trace.points,
                back.folds + tuple(i + len(back.points) - 1 for i in trace.folds),
                trace.reason,
            )
            self._keep(joined, start, end)

    def _unexplained(self, value: float) -> list[TurnGuess]:
        """Guess the cycles at a value, if there are others than those of the branches."""
        if not self.family.allows(value):
            return []
        problem = self.family.problem(value)
        if reason_for_none(self.family.at(value)[0], problem.critical, problem.location) is not None:
            return []
        samples, nu = sample_return_map(self.family.section(value)), self._nu(value)
        expected = sorted(
            guess.xi for trace, *_ in self.found for _, guess in points_at_value(trace, nu, self.tracer.width)
        )
        places = [(samples.xi[i], samples.xi[j]) for i, j in samples.changes]
        explained = samples.certain == len(expected) and all(
            low < xi < high for xi, (low, high) in zip(expected, places, strict=False)
        )
        crossings = find_fixed_points(samples, samples.certain) if explained else search(samples)[0]
        return [TurnGuess(crossing.xi, nu, (0.0, 1.0), crossing.repelling) for crossing in crossings]

    def _known(self, first: tuple[ReturnMapPoint, float], entries: Sequence[Entry]) -> TurnRoutine[bool]:
        """Whether a branch passes a cycle: its own at this value is computed where that is not plain."""
        turn, nu = first
        for chi, guess in chain.from_iterable(points_at_value(trace, nu, self.tracer.width) for trace, *_ in entries):
            if abs(chi - turn.chi) > AVOIDED_DISTANCE:
                continue
            found = yield from self.tracer.corrected(guess)
            if found is not None and abs(found[0].chi - turn.chi) < SAME_CHI:
                return True
        return False

    def _keep(self, trace: ContinuationPoints, start: CyclePoint, first: BranchEnd | None) -> None:
        special, last = self._end(trace)
        self.found.append((trace, start, special, first, last))

    def _end(self, trace: ContinuationPoints) -> tuple[CyclePoint, BranchEnd | None]:
        """Name the end of a trace."""
        last = trace.points[-1]
        turn, end = last.turn, None
        if trace.reason == "C":
            end = min(self.hopf, key=lambda e: abs(e.value - turn.value), default=None)
        elif trace.reason in ("equator", "stuck"):
            direction, width = math.copysign(1.0, last.tangent[1]), self.high - self.low
            reach = width if trace.reason == "equator" else width * (0.02 if turn.height < BAND_HEIGHT else 1e-4)
            end = at_equator(self.family, turn.value, direction, width, self.closed + self.loops, reach)
            if trace.reason == "stuck" and end is None:
                end = at_singular(self.family, turn.value, direction, width)
        if end is not None:
            self.used.add(id(end))
            if end.kind not in ("Hopf", "equator"):
                end = replace(end, amplitude=turn.amplitude)  # that of the last cycle: the limit's is not known
            return self._special(end), end
        kind = "span" if trace.reason == "span" else "undecided"
        sentence = say("end of the branch span", name=self.name, value=turn.value) if kind == "span" else (
            say("followed no further", name=self.name, value=turn.value)
        )  # fmt: skip
        if kind == "undecided":
            self.notes.append(sentence)
        return CyclePoint(kind, turn.value, turn.period, turn.amplitude, sentence), None

    def _special(self, end: BranchEnd) -> CyclePoint:
        at: dict[str, object] = {"name": self.name, "value": end.value}
        if end.kind == "Hopf":
            text = say("born, supercritical" if end.measure < 0.0 else "born, subcritical", number=end.measure, **at)
        elif end.kind == "equator":
            text = say("becomes the equator", **at)
        elif end.kind == "det A = 0":
            text = say("meets a line", **at)
        elif end.kind == "saddle-node on the equator":
            text = say("meets a saddle-node", **at)
        else:
            text = say("becomes a loop", how="attracting" if end.measure > 1.0 else "repelling", **at)
        return CyclePoint(end.kind, end.value, end.period, end.amplitude, text)

    def _branch(
        self,
        trace: ContinuationPoints,
        start: CyclePoint,
        end: CyclePoint,
        first: BranchEnd | None,
        last: BranchEnd | None,
    ) -> CycleBranch:
        """Put in the limits at ends that are no cycles."""
        rows = [point_row(point.turn) for point in trace.points]
        if first is not None:
            rows.insert(0, self._limit(first, rows[0]))
        if last is not None:
            rows.append(self._limit(last, rows[-1]))
        return build_branch(self.name, rows, [trace.points[i].turn for i in trace.folds], start, end)

    def _limit(self, end: BranchEnd, beside: PointRow) -> PointRow:
        """Row of the arrays at an end that is no cycle: C, or a loop on the equator."""
        found = self.family.problem(end.value).critical
        x, y = found[0].p.tolist() if end.kind == "Hopf" and found else beside[4:6]
        exponent = 0.0 if end.kind in ("Hopf", "equator") else math.copysign(math.inf, beside[3])
        return (end.value, end.period, end.amplitude, exponent, x, y)
