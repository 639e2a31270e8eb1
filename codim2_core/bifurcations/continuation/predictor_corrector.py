"""The way along one branch of cycles: a window of points ahead, corrected side by side, that moves with the branch.

In every round the points in the window take one step of Newton's method. Those in front that are found are kept; those
that all but are found tell, with their tangents, where further ones are expected. Far points are only tried: one that
does not turn out well is looked for again when the branch has come nearer. Only where the next point fails the steps
become shorter. Near C and near the equator, where chi hardly changes with xi, a step is at most `MAX_LOG_Y` in xi.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import takewhile

from .continuation_points import ContinuationPoint, ContinuationPoints, TurnGuess
from .corrector import DIFFERENCE_STEP, MAX_LOG_Y, ArclengthCurve, BranchTracer, TurnSearch, distance
from .lockstep_searches import TurnRoutine, side_by_side
from .predictor import CurvePoint

MAX_STEP = 0.03  # the longest step
GROWTH, SHRINKAGE = 1.6, 0.4  # of steps
MIN_STEP = 1e-7  # below this the branch is said to end
PREDICTED_TOLERANCE = (
    1e-9  # product of the last two corrections, in steps, below which the last is made without another turn
)
#: Last correction, in steps: of a point that may be found, of one that tells where others are.
MAX_LAST_CORRECTION, MAX_LEARNT_CORRECTION = 0.2, 0.05
MIN_AMPLITUDE = 3e-3  # amplitude at which a branch has come to C
#: Chi, ebar at which it has come to the equator: all of it, or a part.
MAX_CHI, LOW_HEIGHT, MIN_HEIGHT = 0.999, 1e-3, 1e-7
BAND_HEIGHT, BAND_EXPONENT = 0.05, 1e-8  # ebar and exponent at which cycle and closed equator are indistinguishable
MIN_EXPONENT = 1e-6  # exponent of a cycle near the equator whose sign may be rounding's
#: Change of nu about a fold near the equator, where exponents tend to 0, and elsewhere.
EQUATOR_FOLD_CHANGE, FOLD_CHANGE = 1e-9, 1e-12
MAX_POINTS = 600  # points
MAX_PREDICTION_ERROR = 0.3  # distance of a point from its prediction, in steps, beyond which a step is too long
MIN_TANGENT_COSINE = 0.9  # cosine between successive tangents below which a step is too long
MAX_BATCH, PREDICTOR_POINTS = 16, 12  # points tried at once; last points that predictions know of
#: Turn of the tangent, and first correction in steps, that the next step is to have.
TARGET_TURN, TARGET_CORRECTION = 0.25, 0.15
MAX_HALVINGS = 8  # of an interval in which a fold is not found at once
EDGE_TOLERANCE = 1e-9  # of the span, by which a cycle may lie beyond it
KINKED_FOLD_CHANGE = 1e-7  # of the span, by which the value turns back on both sides of a fold found by bisection
FOLD_SLACK = 1e-3  # of a step: how far outside of it its fold may seem to be
LEAST_EXPONENT_RATIO = (
    0.5  # of the size of the exponent at a point: where it may be as small as that nearby, it is looked at
)


def trace_branch(tracer: BranchTracer, start: ContinuationPoint) -> TurnRoutine[ContinuationPoints]:
    """Follow a branch from a point along its tangent until it ends."""
    path = _BranchPath(tracer, start)
    while path.open:
        yield from path.go_on()
    return (yield from path.finished())


def _part(here: ContinuationPoint, there: ContinuationPoint, place: ContinuationPoint) -> float:
    """Return the share of the way from one point to another: 0 next to the first of them, 1 next to the second."""
    x, y = there.turn.chi - here.turn.chi, there.nu - here.nu
    square = x * x + y * y
    return ((place.turn.chi - here.turn.chi) * x + (place.nu - here.nu) * y) / square if square > 0.0 else -1.0


@dataclass(frozen=True)
class _PendingPoint:
    """A point in the window: its search, its distance from the one before, and where it was expected.

    `number` counts the points between it and the one from which it was predicted; `edge` says that it is looked for at
    an end of the span.
    """

    search: TurnSearch
    step: float
    number: int
    expected: CurvePoint
    edge: bool

    @property
    def sure(self) -> bool:
        """Whether what is known of it tells where others are."""
        return self.search.nearly(MAX_LEARNT_CORRECTION * self.step) is not None


class _BranchPath:
    """The points of one branch so far, and the window ahead of them.

    `near` holds the points of the window as far as they are known; `reason` is why the branch has ended, None while it
    has not.
    """

    def __init__(self, tracer: BranchTracer, start: ContinuationPoint) -> None:
        self.tracer, self.points = tracer, [start]
        self.window: list[_PendingPoint] = []
        self.near: list[ContinuationPoint] = []
        self.step, self.width = 0.25 * MAX_STEP, 2
        self.backward = start.turn.exponent > 0.0
        self.reason = self._at_once(start)

    @property
    def open(self) -> bool:
        """Whether the branch has not ended."""
        return self.reason is None and len(self.points) < MAX_POINTS

    def go_on(self) -> TurnRoutine[None]:
        """Let all that is in the window take one step of Newton's method, and keep what is found in front."""
        if not (self.window and (self.window[-1].edge or not self.near)):
            self._predict()
        open_ = [sought.search for sought in self.window if not sought.search.over]
        turns = yield self.tracer.question([search.guess for search in open_])
        for search, turn in zip(open_, turns, strict=True):
            search.told(turn)
        self._settle()

    def finished(self) -> TurnRoutine[ContinuationPoints]:
        """Put in the folds, where the exponent changes its sign."""
        yield from self._look_within()
        yield from self._look_between()
        signs = [point.turn.exponent > 0.0 for point in self.points]
        turned = [i for i in range(1, len(signs)) if signs[i] != signs[i - 1]]
        found = yield from side_by_side([self._fold(i) for i in turned])
        folds = dict(zip(turned, found, strict=True))
        points: list[ContinuationPoint] = []
        rows: list[int] = []
        for i, point in enumerate(self.points):
            fold = folds.get(i)
            if fold is not None and _bends(fold, self.points[max(i - 2, 0) : i], self.points[i : i + 2]):
                rows.append(len(points))
                points.append(fold)
            points.append(point)
        return ContinuationPoints(tuple(points), tuple(rows), self.reason or "stuck")

    def _look_within(self) -> TurnRoutine[None]:
        """Put in points within a step by whose tangents and ends the value turns back twice."""
        tried, i = 0, 1
        while i < len(self.points):
            one, two = self.points[i - 1 : i + 1]
            point = None
            if tried < MAX_HALVINGS and _turns_twice(one, two):
                first = max(i - 2, 0)
                lengths = ArclengthCurve(self.tracer, self.points[first : i + 2]).lengths
                point = yield from self._placed(first, i + 2, 0.5 * (lengths[i - 1 - first] + lengths[i - first]))
            if point is None or not 0.0 < _part(one, two, point) < 1.0:
                tried, i = 0, i + 1
                continue
            self.points.insert(i, point)
            tried += 1

    def _placed(self, first: int, end: int, length: float) -> TurnRoutine[ContinuationPoint | None]:
        """Find the point of the branch at a length of the course of some of its points."""
        place, near = ArclengthCurve(self.tracer, self.points[first:end]).between(length)
        guess = TurnGuess(place.xi, place.nu, self.tracer.across(near), near.turn.exponent > 0.0)
        closed = yield from self.tracer.corrected(guess)
        return None if closed is None else self.tracer.point(*closed, near.tangent)

    def _look_between(self) -> TurnRoutine[None]:
        """Put in points where the exponent may change its sign twice within a step: where it is least in size."""
        tried, i = 0, 1
        while i < len(self.points) - 1:
            around = self.points[i - 1 : i + 2]
            exponents = [point.turn.exponent for point in around]
            length = _least(ArclengthCurve(self.tracer, around).lengths, exponents)
            if length is None or tried == MAX_HALVINGS or _may_be_rounding(around[1]):
                tried, i = 0, i + 1
                continue
            first = max(i - 2, 0)
            before = ArclengthCurve(self.tracer, self.points[first:i]).lengths[-1]
            point = yield from self._placed(first, i + 3, before + length)
            part = -1.0 if point is None else _part(around[0], around[2], point)
            if point is None or not 0.0 < part < 1.0:
                tried, i = 0, i + 1
                continue
            after = part > _part(around[0], around[2], around[1])
            self.points.insert(i + after, point)
            if (point.turn.exponent > 0.0) != (exponents[1] > 0.0):
                tried, i = 0, i + 2
                continue
            tried += 1
            i += int(after) if abs(point.turn.exponent) < abs(exponents[1]) else int(not after)

    def _longest(self, point: ContinuationPoint, beyond: float) -> float:
        """Return the longest step so far beyond a point."""
        rise = abs(point.tangent[0])
        chi = point.turn.chi + beyond * point.tangent[0]
        if not 0.0 < chi < 1.0:
            chi = point.turn.chi
        return min(MAX_STEP, MAX_LOG_Y * chi * (1.0 - chi) / rise) if rise > 0.0 else MAX_STEP

    def _predict(self) -> None:
        """Expect points beyond those in the window, up to the end of the span."""
        sure = list(takewhile(lambda sought: sought.sure, self.window))
        points = [*self.points[-PREDICTOR_POINTS:], *self.near[: len(sure)]]
        last, waiting = points[-1], [sought.step for sought in self.window[len(sure) :]]
        steps, step = list(waiting), self.step
        if self.window:
            step = waiting[-1] if waiting else sure[-1].step * _growth(points[-2], last, sure[-1])
        for _ in range(self.width):
            steps.append(min(step, self._longest(last, sum(steps))))
            step = GROWTH * steps[-1]
        course, line, before = ArclengthCurve(self.tracer, points), self.tracer.across(last), last.nu
        for number, place in enumerate(course.ahead(steps)):
            nu = place.nu
            edge = not 0.0 < nu < 1.0
            if number >= len(waiting):
                guess = TurnGuess(place.xi, nu, line, self.backward)
                if edge:
                    end = 0.0 if nu < 0.5 else 1.0
                    place = course.ahead([*steps[:number], steps[number] * (end - before) / (nu - before)])[-1]
                    guess = TurnGuess(place.xi, end, (0.0, 1.0), self.backward)
                search = TurnSearch(self.tracer, guess, PREDICTED_TOLERANCE * steps[number] ** 2)
                self.window.append(_PendingPoint(search, steps[number], number, place, edge))
            if edge:
                return
            before = nu

    def _settle(self) -> None:
        """Take what is found in front, and leave in the window what may be found."""
        self.near = self._nearby()
        front = self.window[0] if self.window else None
        begun = front is not None and front.number == 0 and front.search.rounds == 1 and not front.search.over
        count = max(len(self.near), int(begun))
        tried, good = (sum(sought.search.rounds == 1 for sought in some) for some in (self.window, self.window[:count]))
        self.width = min(2 * tried, MAX_BATCH) if good == tried > 0 else good + 1
        del self.window[count:]
        if not count and (front is None or front.number == 0):
            self.step = SHRINKAGE * (self.step if front is None else front.step)
            if self.step < min(MIN_STEP, 1e-3 * self._longest(self.points[-1], 0.0)):
                self.reason = "stuck"
        while self.reason is None and self.window and self.window[0].search.found is not None:
            self._take(self.window.pop(0), self.near.pop(0))

    def _nearby(self) -> list[ContinuationPoint]:
        """Return the points in front of the window that are found, or nearly, each a good step after the one before."""
        found: list[ContinuationPoint] = []
        for sought in self.window:
            here, nearly = (
                found[-1] if found else self.points[-1],
                sought.search.nearly(MAX_LAST_CORRECTION * sought.step),
            )
            if nearly is None:
                break
            point = self.tracer.point(*nearly, here.tangent)
            if not _fits(here, point, sought):
                break
            found.append(point)
        return found

    def _take(self, sought: _PendingPoint, point: ContinuationPoint) -> None:
        """Add a point of the window to the branch."""
        here = self.points[-1]
        end = min(max(point.nu, 0.0), 1.0)
        if abs(point.nu - end) > EDGE_TOLERANCE:  # corrected beyond the span, where it was not expected
            guess = TurnGuess(point.turn.xi, end, (0.0, 1.0), self.backward)
            search = TurnSearch(self.tracer, guess, PREDICTED_TOLERANCE * sought.step**2)
            self.window, self.near = [_PendingPoint(search, sought.step, 0, sought.expected, True)], []
            return
        self.step = sought.step * _growth(here, point, sought)
        self.points.append(point)
        self.backward = self.tracer.backward(point.turn, self.backward)
        self.reason = "span" if sought.edge else self._over(here, point)

    def _over(self, here: ContinuationPoint, there: ContinuationPoint) -> str | None:
        """Return the reason why the branch ends with the step between two points, or None."""
        lowest = LOW_HEIGHT if there.turn.chi > MAX_CHI else MIN_HEIGHT
        if there.turn.amplitude < MIN_AMPLITUDE and there.tangent[0] < 0.0:
            return "C"
        if there.turn.height < lowest and there.turn.height < here.turn.height:
            return "equator"
        if len(self.points) > 8 and _has_come_round(self.points[0], here, there):
            self.points.append(self.points[0])
            return "closed"
        return self._at_once(there)

    @staticmethod
    def _at_once(point: ContinuationPoint) -> str | None:
        """Return the reason why a branch ends at a point, whatever was before it, or None."""
        if point.turn.height < BAND_HEIGHT and point.tangent[0] > 0.0 and abs(point.turn.exponent) < BAND_EXPONENT:
            return "equator"
        beyond = point.nu <= 0.0 if point.tangent[1] < 0.0 else point.nu >= 1.0
        return "span" if beyond else None

    def _fold(self, i: int) -> TurnRoutine[ContinuationPoint | None]:
        """Find the point between the i-th one and the one before at which the exponent is zero.

        By bisection alone where the exponent has a kink, as that of a cycle does which grazes a circle where Psi has.
        """
        around, k, middle = self.points[max(i - 2, 0) : i + 2], min(i, 2), None
        for halved in range(MAX_HALVINGS):
            here, there = around[k - 1], around[k]
            course = ArclengthCurve(self.tracer, around)
            place, near = course.between(course.neutral(k))
            nearby = DIFFERENCE_STEP * 0.2**halved  # where the exponent changes fast, smaller ones tell
            found = yield from self.tracer.fold(place.xi, place.nu, near, nearby)
            if found is not None and -FOLD_SLACK < _part(here, there, found) < 1.0 + FOLD_SLACK:
                return found
            if _may_be_rounding(here, there):
                return None
            place, near = course.between(0.5 * (course.lengths[k - 1] + course.lengths[k]))
            guess = TurnGuess(place.xi, place.nu, self.tracer.across(near), near.turn.exponent > 0.0)
            closed = yield from self.tracer.corrected(guess)
            if closed is None:
                return None
            middle = self.tracer.point(*closed, here.tangent)
            same = (middle.turn.exponent > 0.0) == (here.turn.exponent > 0.0)
            around, k = [middle, there] if same else [here, middle], 1
        sides = [point.nu - middle.nu for point in self.points[i - 1 : i + 1]] if middle is not None else [0.0, 0.0]
        return middle if sides[0] * sides[1] > 0.0 and min(map(abs, sides)) > KINKED_FOLD_CHANGE else None


def _fits(here: ContinuationPoint, there: ContinuationPoint, sought: _PendingPoint) -> bool:
    """Whether a point is the one that was looked for, a step after another."""
    (tc, tn), step, expected = here.tangent, sought.step, sought.expected
    onward = tc * (there.turn.chi - here.turn.chi) + tn * (there.nu - here.nu)
    least = 0.0 if sought.edge else MAX_PREDICTION_ERROR * step
    cosine = tc * there.tangent[0] + tn * there.tangent[1]
    missed = math.hypot(there.turn.chi - expected.chi, there.nu - expected.nu)
    return (
        missed < MAX_PREDICTION_ERROR * (sought.number + 1) * step
        and least < onward < 3.0 * step
        and cosine > MIN_TANGENT_COSINE
    )


def _growth(here: ContinuationPoint, there: ContinuationPoint, sought: _PendingPoint) -> float:
    """By what the next step may be longer, judged by the turn of the tangent and the last prediction."""
    cosine = here.tangent[0] * there.tangent[0] + here.tangent[1] * there.tangent[1]
    turn = math.acos(min(cosine, 1.0))
    off = sought.search.first / ((sought.number + 1) * sought.step)
    return max(min(GROWTH, TARGET_TURN / max(turn, 1e-9), (TARGET_CORRECTION / max(off, 1e-9)) ** 0.25), SHRINKAGE)


def _may_be_rounding(*points: ContinuationPoint) -> bool:
    """Whether the sign of an exponent may be rounding's."""
    return all(point.turn.height < BAND_HEIGHT and abs(point.turn.exponent) < MIN_EXPONENT for point in points)


def _least(lengths: Sequence[float], exponents: Sequence[float]) -> float | None:
    """Return where a parabola through three exponents of one sign is least in size, if it is much less there."""
    x0, x1, x2 = lengths
    e0, e1, e2 = (abs(exponent) for exponent in exponents)
    if not (exponents[0] > 0.0) == (exponents[1] > 0.0) == (exponents[2] > 0.0) or e1 > min(e0, e2):
        return None
    first, second = (e1 - e0) / (x1 - x0), (e2 - e1) / (x2 - x1)
    bend = (second - first) / (x2 - x0)
    if not bend > 0.0:
        return None
    x = 0.5 * (x0 + x1) - 0.5 * first / bend
    least = e0 + (x - x0) * (first + bend * (x - x1))
    return x if least < LEAST_EXPONENT_RATIO * e1 and abs(x - x1) > 1e-3 * min(x1 - x0, x2 - x1) else None


def _bends(fold: ContinuationPoint, before: Sequence[ContinuationPoint], after: Sequence[ContinuationPoint]) -> bool:
    """Whether the branch turns back at a fold between points: by more than rounding, near the equator on both sides.

    Of two points on a side the nearer one may be all but the fold.
    """
    bent = sorted(max(abs(fold.nu - point.nu) for point in side) for side in (before, after))
    return bent[0] > EQUATOR_FOLD_CHANGE if fold.turn.height < BAND_HEIGHT else bent[1] > FOLD_CHANGE


def _turns_twice(one: ContinuationPoint, two: ContinuationPoint) -> bool:
    """Whether the value turns back and again between two points: by the cubic through them with their tangents."""
    step, (_, first), (_, last) = distance(one, two), one.tangent, two.tangent
    if (one.turn.exponent > 0.0) != (two.turn.exponent > 0.0) or first * last <= 0.0:
        return False
    rise = (two.nu - one.nu) * math.copysign(1.0, first)
    expected = step * (abs(first) + abs(last))
    return expected > EQUATOR_FOLD_CHANGE and rise < expected / 6.0


def _has_come_round(start: ContinuationPoint, here: ContinuationPoint, there: ContinuationPoint) -> bool:
    """Whether a step has passed the start in the start's direction."""
    ux, un = here.turn.chi - start.turn.chi, here.nu - start.nu
    vx, vn = there.turn.chi - start.turn.chi, there.nu - start.nu
    tc, tn = start.tangent
    near = max(distance(here, start), distance(there, start))
    return ux * tc + un * tn < 0.0 <= vx * tc + vn * tn and near < 2.0 * MAX_STEP
