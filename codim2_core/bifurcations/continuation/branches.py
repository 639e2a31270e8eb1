"""Branches of limit cycles along one parameter, from where they are born or seen to where they end.

They are begun at the Hopf points of the equilibria, and at every cycle that is seen at one of several values and
that no branch has passed. Each is followed on a ray (`turns`) as long as cycles cross it well; then on another.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from ...portrait.cycles.limit_cycles import LimitCycle, closed_orbits, excluding_theorem
from ...portrait.cycles.ray_section import HemispherePoint, TurnSection, best_crossing, crossing_qualities, room
from ...portrait.layer_problem.problem import LayerProblem
from ...portrait.layer_problem.vary import limits, vary
from ...results.arrays import Array
from ...results.words import say
from ...systems.kinds import AnySystem
from ...systems.psi.function import Psi
from .branch_ends import (
    CANDIDATE_POINTS,
    LOOP_THROUGH_EQUATOR,
    PERIOD_GROWTH,
    SAME_VALUE_SHARE,
    BranchEnd,
    LastCycles,
    MarkedValue,
    PointRow,
    at_loop,
    at_one_value,
    build_branch,
    equator_end,
    hopf_end,
    loop_branch_end,
    loop_end,
    loop_value,
    point_row,
    singular_end,
    slow_sequence,
)
from .corrector import BranchTracer, ClosedTurn, distance
from .known_cycles import (
    KnownCycle,
    RayPiece,
    distance_along_ray,
    lies_beyond,
    line_of,
    passes,
    reverse_piece,
    some_cycles,
    split_at_homoclinic,
)
from .predictor_corrector import BAND_HEIGHT, trace_branch
from .result import CycleBranch, CycleBranches, CyclePoint
from .turns import (
    ContinuationPoint,
    ContinuationPoints,
    Problems,
    ReturnMapPoint,
    SectionBase,
    TurnGuess,
    VariedRay,
    e_at,
    searched_part,
)

START_SHARES, START_HEIGHT = (1e-3, 1e-4), 0.05  # of the reach: where branches start at a set; ebar, at the equator
CACHE_SIZE = 1024  # problems that are kept
CENSUS_VALUES = 9  # values at which all cycles are looked for
NARROWEST_PART, MOST_BETWEEN = 1e-3, 24  # of the span, between special values; of these parts
NEAR_SADDLE_NODE = 1.5e-3  # of the span
TOLD_DISTANCE = 3e-3  # in (chi, nu), in which lines tell the direction of a branch
RAY_GAIN = 1.3  # times as well another ray is crossed that is worth taking
JUMP, SHORTER = 1e-7, 0.1  # in (chi, nu), from branch to branch; of that, the next step
OTHER_PERIOD_SHARE = 0.01  # of the period: cycles that are not one by far
MAX_RAYS, FEW_POINTS = 12, 3  # of one branch; fewer points on a ray tell nothing
BAND_SPREAD = 0.5  # by which ebar differs between the cycles of a band
ROUNDING_HEIGHT = 1e-12  # ebar of a turn of which nothing but rounding is left
COMPARED_POINTS = 3  # before the last cycle: with those before these it is compared


def continue_cycles(
    system: AnySystem, psi: Psi, name: str, span: tuple[float, float], z: ArrayLike, marked: Sequence[MarkedValue]
) -> CycleBranches:
    """Continue the limit cycles of the layer problem (3.26) along one parameter (Section 4.3.3); z (m,)."""

    @lru_cache(maxsize=CACHE_SIZE)
    def problem(value: float) -> LayerProblem:
        changed, family_psi, place = vary(system, psi, z, name, value)
        return LayerProblem(changed.at(place), family_psi)

    part = searched_part(problem, span, [mark.value for mark in marked])
    return replace(BranchSearch(problem, name, part, limits(system, psi, name), marked).run(), span=span)


class BranchSearch:
    """One call of `continue_cycles`."""

    def __init__(
        self,
        problem: Problems,
        name: str,
        span: tuple[float, float],
        bounds: tuple[float, float],
        marked: Sequence[MarkedValue],
    ) -> None:
        self.problem, self.name, self.bounds, self.marked = problem, name, bounds, marked
        self.low, self.high = span
        self.width = self.high - self.low
        self.hopf = [m for m in marked if m.kind == "Hopf"]
        self.used: set[int] = set()
        self.found: list[tuple[list[RayPiece], BranchEnd, BranchEnd]] = []
        self.beyond: list[RayPiece] = []  # pieces after loops that were passed
        self.notes: list[str] = []

    def run(self) -> CycleBranches:
        """Find all branches."""
        for mark in self.hopf:
            if id(mark) not in self.used:
                self._from_hopf(mark)
        for mark in self.marked:
            if mark.kind == "neutral equator" and id(mark) not in self.used:
                self._from_equator(mark)
        for value in self._census():
            for cycle in self._seen(value):
                if not self._known(cycle, value):
                    self._from_cycle(cycle, value)
        branches = tuple(self._branch(*one) for one in self.found)
        span = {"name": self.name, "low": self.low, "high": self.high}
        kind = "no branch" if not branches else "one branch" if len(branches) == 1 else "branches"
        reason = say(kind, **span, count=len(branches) or CENSUS_VALUES)
        theorems = [] if branches else [excluding_theorem(self.problem(v)) for v in self._census()]
        if theorems and None not in theorems:
            reason = f" {say('elsewhere')} ".join(dict.fromkeys(one for one in theorems if one))
        return CycleBranches(self.name, (self.low, self.high), branches, reason, tuple(dict.fromkeys(self.notes)))

    def _census(self) -> list[float]:
        """Return the values at which cycles are searched: evenly spaced, between special values, next to saddle-nodes.

        Loops through a saddle-node of the equator may leave a cycle on a narrow part of the span.
        """
        even = np.linspace(self.low, self.high, CENSUS_VALUES).tolist()
        special = sorted({self.low, self.high, *(mark.value for mark in self.marked)})
        between = [0.5 * (one + two) for one, two in pairwise(special) if two - one > NARROWEST_PART * self.width]
        near_ends = [
            mark.value + side * NEAR_SADDLE_NODE * self.width
            for mark in self.marked
            for side in (-1.0, 1.0)
            if mark.kind == "saddle-node"
        ]
        values = (*even, *between[:MOST_BETWEEN], *(v for v in near_ends if self.low <= v <= self.high))
        return [v for v in values if self.bounds[0] <= v <= self.bounds[1]]

    def _nu(self, value: float) -> float:
        return (value - self.low) / self.width

    def _tracer(self, foot: SectionBase, centre: SectionBase, u: Array) -> BranchTracer:
        return BranchTracer(VariedRay(self.problem, self.width, self.bounds, foot, centre, u), self.low, self.high)

    def _from_hopf(self, mark: MarkedValue) -> None:
        """Begin where the cycle is smallest; the parameter is then what is solved for."""
        self.used.add(id(mark))
        critical = self.problem(mark.value).critical
        C = min(critical, key=lambda C: math.dist(C.p, mark.place), default=None)
        if C is None or C.determinant <= 0.0:
            return
        foot = SectionBase(self.problem, mark.value, C.e)
        tracer = self._tracer(foot, foot, TurnSection(self.problem(mark.value), C).u)
        first = None
        for share in START_SHARES:
            guess = TurnGuess(math.log(share), self._nu(mark.value), (1.0, 0.0), backward=False)
            first = first or tracer.closed(guess)
        if first is None:
            self.notes.append(say("birth not caught", kind="Hopf", name=self.name, value=mark.value))
        elif -1e-12 <= first.nu <= 1.0 + 1e-12:
            start = hopf_end(self.name, mark.value, self.problem(mark.value), mark.place, first.turn.exponent)
            self._keep(self._followed(tracer, tracer.point(first, (1.0, 0.0))), start)

    def _from_equator(self, mark: MarkedValue) -> None:
        """Begin where the cycle is largest, all but the closed equator."""
        critical = [C for C in self.problem(mark.value).critical if C.kind != "saddle"]
        for C in critical[:1]:
            foot = SectionBase(self.problem, mark.value, C.e)
            u = TurnSection(self.problem(mark.value), C).u
            reach, other = room(foot.place(mark.value), u)
            xi = math.log(reach * (reach + other)) - 2.0 * math.log(START_HEIGHT)
            tracer = self._tracer(foot, foot, u)
            for guess in (TurnGuess(xi, self._nu(mark.value), (1.0, 0.0), backward) for backward in (False, True)):
                first = tracer.closed(guess)
                if first is None or not 0.0 <= first.nu <= 1.0:
                    continue
                start = equator_end(self.name, first.turn, self.marked, self.width, foot)
                if start is not None and start.point.value == mark.value:  # a cycle of another branch may be met
                    self._keep(self._followed(tracer, tracer.point(first, (-1.0, 0.0))), start)
                    return
        self.notes.append(say("birth not caught", kind="equator", name=self.name, value=mark.value))

    def _seen(self, value: float) -> Sequence[LimitCycle]:
        return closed_orbits(self.problem(value)).cycles

    def _from_cycle(self, cycle: LimitCycle, value: float) -> None:
        """Begin at a cycle that was seen."""
        inside = self._feet(value, cycle.points)
        begun = self._on(value, cycle.points, inside, inside[0], cycle.multiplier > 1.0, (0.0, 1.0))
        if begun is None:
            self.notes.append(say("cycle not continued", name=self.name, value=value))
            return
        tracer, first = begun
        point = tracer.point(first, (1.0, 0.0))
        onward = self._followed(tracer, point)
        if self._is_known(onward):  # which was not seen next to a fold
            return
        if onward[-1].trace.reason == "closed":
            t = point.turn
            end = BranchEnd(CyclePoint("closed", t.value, t.period, t.amplitude, say("branch closed")))
            self.found.append((onward, end, end))
            return
        turned = tracer.point(first, (-point.tangent[0], -point.tangent[1]))
        back = self._followed(tracer, turned)
        if self._is_known(back):
            return
        start = self._end(back)
        self._keep([*(reverse_piece(piece) for piece in reversed(back)), *onward], start)

    def _feet(self, value: float, points: Array) -> list[SectionBase]:
        """Find points inside a cycle: critical sets that are no saddles, others, and its middle."""
        sets = sorted(self.problem(value).critical, key=lambda C: C.kind == "saddle")
        feet = [
            SectionBase(self.problem, value, C.e)
            for C in sets
            if best_crossing(points, HemispherePoint(C.p, C.x2))[0] > -1.0
        ]
        middle = points[:-1].mean(axis=0)
        x2 = middle / math.sqrt(1.0 - float(middle @ middle))
        return [*feet, SectionBase(self.problem, value, e_at(self.problem(value).psi, x2), critical=False)]

    def _on(
        self,
        value: float,
        points: Array,
        feet: Sequence[SectionBase],
        centre: SectionBase,
        backward: bool,
        along: tuple[float, float],
    ) -> tuple[BranchTracer, ClosedTurn] | None:
        """Find a cycle, known as a line, on the ray that it crosses best."""
        crossed = [(*best_crossing(points, foot.place(value)), foot) for foot in feet]
        for quality, index, foot in sorted(crossed, key=lambda one: -one[0]):
            if quality <= 0.0:
                break
            place = foot.place(value)
            away = points[index] - place.p
            r = math.hypot(*away)
            tracer = self._tracer(foot, centre, away / r)
            reach, _ = room(place, away / r)
            guess = TurnGuess(math.log(r / max(reach - r, 1e-300)), self._nu(value), along, backward)
            first = tracer.closed(guess)
            if first is not None:
                return tracer, first
        return None

    def _followed(self, tracer: BranchTracer, point: ContinuationPoint) -> list[RayPiece]:
        """Follow a branch from a point to its end, on as many rays as it takes."""
        return self._onward(self._before_loop(RayPiece(tracer, trace_branch(tracer, point))))

    def _before_loop(self, piece: RayPiece, step: float = 1.0) -> RayPiece:
        """Return a piece up to the first loop that it has passed; what lies beyond is another branch, for later.

        Where a step has led to another branch, and no loop is between them, shorter ones follow the first branch on.
        """
        cut = split_at_homoclinic(piece.tracer, piece.trace, self.problem)
        if cut is None:
            return piece
        before, after = cut
        self.beyond.append(RayPiece(piece.tracer, after))
        last, step = before.points[-1], SHORTER * min(step, distance(before.points[-1], after.points[0]))
        if step > JUMP:
            onward = trace_branch(piece.tracer, last, step)
            folds = tuple(len(before.points) - 1 + k for k in onward.folds)
            joined = ContinuationPoints((*before.points, *onward.points[1:]), before.folds + folds, onward.reason)
            return self._before_loop(RayPiece(piece.tracer, joined), step)
        return RayPiece(piece.tracer, before)

    def _onward(self, piece: RayPiece) -> list[RayPiece]:
        """Follow a branch on from the end of a piece; return all pieces."""
        pieces = [piece]
        while len(pieces) < MAX_RAYS:
            tracer, trace = pieces[-1].tracer, pieces[-1].trace
            stuck = (
                trace.reason == "stuck" and len(trace.points) >= FEW_POINTS and not at_loop(_turns(trace), self.width)
            )
            again = self._again(tracer, trace) if stuck else None
            if again is None:
                break
            further = RayPiece(again[0], trace_branch(*again))
            if self._retraces(further, pieces[-1]):  # near a loop rounding decides where a ray leads on
                there, back = again[1], (-again[1].tangent[0], -again[1].tangent[1])
                further = RayPiece(again[0], trace_branch(again[0], replace(there, tangent=back)))
            further = self._before_loop(further)
            if further.trace.reason == "stuck" and len(further.trace.points) < FEW_POINTS:
                break  # no further than the ray before
            pieces.append(further)
        return pieces

    def _again(self, tracer: BranchTracer, trace: ContinuationPoints) -> tuple[BranchTracer, ContinuationPoint] | None:
        """Find the last cycle on another ray that it crosses better; None if there is none."""
        last = trace.points[-1]
        far = (point for point in reversed(trace.points) if distance(point, last) > TOLD_DISTANCE)
        before = next(far, trace.points[0])  # the last steps before it is stuck are shorter than lines tell
        line, earlier = line_of(tracer, last.turn), line_of(tracer, before.turn)
        if line is None or earlier is None:
            return None
        family, value = tracer.family, last.turn.value
        here = float(crossing_qualities(line, family.foot.place(value))[0])
        feet = [family.foot, *self._feet(value, line)]
        if max(best_crossing(line, foot.place(value))[0] for foot in feet) < RAY_GAIN * here:
            return None
        fixed = (0.0, 1.0) if abs(last.tangent[1]) > 0.1 else (1.0, 0.0)
        found = self._on(value, line, feet, family.centre, last.turn.exponent > 0.0, fixed)
        if found is None:
            return None
        other, closed = found
        turn = closed.turn
        place, u = other.family.foot.place(before.turn.value), other.family.u
        r = distance_along_ray(earlier, place.p, u, turn.chi * room(place, u)[0])
        towards = (turn.chi - r / room(place, u)[0], closed.nu - before.nu)
        return other, other.point(closed, towards)

    def _band(self, pieces: list[RayPiece]) -> bool:
        """Whether closed orbits of all sizes were followed at one value, a band and no branch; then it is noted."""
        turns = [point.turn for piece in pieces for point in piece.trace.points if point.turn.height > ROUNDING_HEIGHT]
        if not turns:
            return False
        first, heights = turns[0].value, [turn.height for turn in turns]
        if not at_one_value(turns, self.width) or max(heights) - min(heights) < BAND_SPREAD:
            return False
        near = [mark for mark in self.marked if abs(mark.value - first) <= SAME_VALUE_SHARE * self.width]
        self.used.update(map(id, near))
        value = near[0].value if near else first
        self.notes.append(say("band at one value", name=self.name, value=value))
        return True

    def _keep(self, pieces: list[RayPiece], start: BranchEnd) -> None:
        """Keep a branch, and those beyond the loops that were passed on the way."""
        if not self._band(pieces):
            self.found.append((pieces, start, self._end(pieces)))
        while self.beyond:
            piece = self._before_loop(self.beyond.pop())
            if not self._is_known([piece]):
                onward = self._onward(piece)
                if not self._band(onward):
                    self.found.append((onward, self._end([reverse_piece(piece)]), self._end(onward)))

    def _end(self, pieces: list[RayPiece]) -> BranchEnd:
        """Name the end of a branch."""
        trace = pieces[-1].trace
        turn = trace.points[-1].turn
        if trace.reason == "span":
            text = say("end of the branch span", name=self.name, value=turn.value)
            return BranchEnd(CyclePoint("span", turn.value, turn.period, turn.amplitude, text))
        if trace.reason == "C" and self.hopf:
            mark = min(self.hopf, key=lambda m: abs(m.value - turn.value))
            self.used.add(id(mark))
            return hopf_end(self.name, mark.value, self.problem(mark.value), mark.place, turn.exponent)
        way = trace.points[-1].tangent[1]
        found = singular_end(self.name, turn, self.marked, way, self.width) if trace.reason == "stuck" else None
        if found is None and (trace.reason == "equator" or turn.height < BAND_HEIGHT):
            found = equator_end(self.name, turn, self.marked, self.width, pieces[-1].tracer.family.centre)
            near = [] if found is None else [m for m in self.marked if m.value == found.point.value]
            self.used.update(map(id, near))
        if found is None:
            found = self._loop(pieces[-1])
        if found is None and len(pieces) > 1 and at_one_value(_turns(trace), self.width):
            found = self._loop(pieces[-2])  # another ray has shown no more
        if found is None:
            text = say("followed no further", name=self.name, value=turn.value)
            self.notes.append(text)
            found = BranchEnd(CyclePoint("undecided", turn.value, turn.period, turn.amplitude, text))
        return found

    def _loop(self, piece: RayPiece) -> BranchEnd | None:
        """Name a loop that the last cycles of a branch come to."""
        turns = [point.turn for point in piece.trace.points if point.turn.height > ROUNDING_HEIGHT]
        # beyond the slowest of the last ones rounding decides
        for last in sorted(turns[-1 - CANDIDATE_POINTS :], key=lambda turn: -turn.period):
            end = turns.index(last)
            back = turns[: end + 1 - COMPARED_POINTS] or turns[:1]
            before = next((turn for turn in reversed(back) if PERIOD_GROWTH * turn.period < last.period), back[-1])
            states, earlier = (piece.tracer.family.course(t.xi, t.value, t.exponent > 0.0) for t in (last, before))
            if states is not None and earlier is not None:
                break
        else:
            return None
        last_cycles = LastCycles(last, states.states, before, earlier.states, slow_sequence(turns[: end + 1]))
        found = loop_end(self.name, last_cycles, self.problem(last.value), self.marked, self.width)
        if not (last.height < BAND_HEIGHT if found is None else found.point.kind == LOOP_THROUGH_EQUATOR):
            return found
        centre, estimate = piece.tracer.family.centre, last.value if found is None else found.point.value
        value = loop_value(self.problem, centre, last, states.states, estimate, self.width)
        return found if value is None else loop_branch_end(self.name, last, value)

    def _known(self, cycle: LimitCycle | KnownCycle, value: float) -> bool:
        """Whether a branch passes a cycle that was seen."""
        nu = self._nu(value)
        for pieces, start, end in self.found:
            outer = (pieces[0].trace.points[0].turn, start), (pieces[-1].trace.points[-1].turn, end)
            if any(lies_beyond(cycle, value, *one) for one in outer):
                return True
            if any(passes(piece, cycle, nu) for piece in pieces):
                return True
        return False

    def _is_known(self, pieces: Sequence[RayPiece]) -> bool:
        """Whether a branch passes cycles of these pieces."""
        return any(self._known(*some) for piece in pieces for some in some_cycles(piece))

    def _retraces(self, piece: RayPiece, before: RayPiece) -> bool:
        """Whether a piece leads back over the cycles of the one before it, not counting those at its end."""
        last = before.trace.points[-1].turn.period
        return any(
            abs(cycle.period - last) > OTHER_PERIOD_SHARE * last and passes(before, cycle, self._nu(value))
            for cycle, value in some_cycles(piece)
        )

    def _branch(self, pieces: list[RayPiece], start: BranchEnd, end: BranchEnd) -> CycleBranch:
        rows: list[PointRow] = [] if start.limit is None else [start.limit]
        folds: list[ReturnMapPoint] = []
        for i, piece in enumerate(pieces):
            rows += [point_row(point.turn) for point in piece.trace.points[1 if i else 0 :]]
            folds += [piece.trace.points[k].turn for k in piece.trace.folds]
        rows += [] if end.limit is None else [end.limit]
        return build_branch(self.name, rows, folds, start.point, end.point)


def _turns(trace: ContinuationPoints) -> list[ReturnMapPoint]:
    return [point.turn for point in trace.points]
