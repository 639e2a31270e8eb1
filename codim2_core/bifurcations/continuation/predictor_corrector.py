"""The way along one branch of cycles: predict a step ahead, correct, and choose the next step by how well that went.

Near C and near the equator, where chi hardly changes with xi, a step is at most `MAX_LOG_Y` in xi.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from .corrector import DIFFERENCE_STEP, MAX_LOG_Y, ArclengthCurve, BranchTracer, ClosedTurn, CurvePoint, distance
from .turns import ContinuationPoint, ContinuationPoints, TurnGuess

MAX_STEP = 0.03  # the longest step
GROWTH, SHRINKAGE = 1.6, 0.4  # of steps
MIN_STEP = 1e-7  # below this the branch is said to end
PREDICTED_TOLERANCE = (
    1e-9  # product of the last two corrections, in steps, below which the last is made without another turn
)
MIN_AMPLITUDE = 3e-3  # amplitude at which a branch has come to C
#: Chi, ebar at which it has come to the equator: all of it, or a part.
MAX_CHI, LOW_HEIGHT, MIN_HEIGHT = 0.999, 1e-3, 1e-7
LARGE_EXPONENT = 10.0  # a cycle that comes to the closed equator has a smaller one: beyond it low cycles go on
BAND_HEIGHT, BAND_EXPONENT = 0.05, 1e-8  # ebar and exponent at which cycle and closed equator are indistinguishable
MIN_EXPONENT = 1e-6  # exponent of a cycle near the equator whose sign may be rounding's
#: Change of nu about a fold near the equator, where exponents tend to 0, and elsewhere.
EQUATOR_FOLD_CHANGE, FOLD_CHANGE = 1e-9, 1e-12
MAX_POINTS = 600  # points
MAX_PREDICTION_ERROR = 0.3  # distance of a point from its prediction, in steps, beyond which a step is too long
MIN_TANGENT_COSINE = 0.9  # cosine between successive tangents below which a step is too long
PREDICTOR_POINTS = 12  # last points that predictions know of
#: Turn of the tangent, and first correction in steps, that the next step is to have.
TARGET_TURN, TARGET_CORRECTION = 0.25, 0.15
MAX_HALVINGS = 8  # of an interval in which a fold is not found at once
EDGE_TOLERANCE = 1e-9  # of the span, by which a cycle may lie beyond it
KINKED_FOLD_CHANGE = 1e-7  # of the span, by which the value turns back on both sides of a fold found by bisection
FOLD_SLACK = 1e-3  # of a step: how far outside of it its fold may seem to be
LEAST_EXPONENT_RATIO = (
    0.5  # of the size of the exponent at a point: where it may be as small as that nearby, it is looked at
)


def trace_branch(
    tracer: BranchTracer, start: ContinuationPoint, first_step: float = 0.25 * MAX_STEP
) -> ContinuationPoints:
    """Follow a branch from a point along its tangent until it ends."""
    path = _BranchPath(tracer, start, first_step)
    while path.open:
        path.go_on()
    return path.finished()


def _part(here: ContinuationPoint, there: ContinuationPoint, place: ContinuationPoint) -> float:
    """Return the share of the way from one point to another: 0 next to the first of them, 1 next to the second."""
    x, y = there.turn.chi - here.turn.chi, there.nu - here.nu
    square = x * x + y * y
    return ((place.turn.chi - here.turn.chi) * x + (place.nu - here.nu) * y) / square if square > 0.0 else -1.0


class _BranchPath:
    """The points of one branch so far; `reason` is why it has ended, None while it has not.

    `failed` says that the last step did: the next one is no longer than that which succeeds.
    """

    def __init__(self, tracer: BranchTracer, start: ContinuationPoint, first_step: float) -> None:
        self.tracer, self.points = tracer, [start]
        self.step, self.failed = first_step, False
        self.backward = start.turn.exponent > 0.0
        self.reason = self._at_once(start)

    @property
    def open(self) -> bool:
        """Whether the branch has not ended."""
        return self.reason is None and len(self.points) < MAX_POINTS

    def go_on(self) -> None:
        """Take a step, or make it shorter."""
        here = self.points[-1]
        step = min(self.step, self._longest(here))
        course = ArclengthCurve(self.tracer, self.points[-PREDICTOR_POINTS:])
        place = course.ahead(step)
        end = None if place is None else _end_beyond(place.nu, 0.0)
        if place is not None and end is not None:
            place = course.ahead(step * (end - here.nu) / (place.nu - here.nu))
        there = None if place is None else self._corrected(place, step, end)
        if there is None:
            self.step, self.failed = SHRINKAGE * step, True
            if self.step < min(MIN_STEP, 1e-3 * self._longest(here)):
                self.reason = "stuck"
            return
        closed, point = there
        self.step = step * min(_growth(here, point, closed.first / step), 1.0 if self.failed else GROWTH)
        self.failed = False
        self.points.append(point)
        self.backward = self.tracer.backward(point.turn, self.backward)
        self.reason = "span" if point.nu in (0.0, 1.0) else self._over(here, point)

    def _corrected(
        self, place: CurvePoint, step: float, end: float | None
    ) -> tuple[ClosedTurn, ContinuationPoint] | None:
        """Find the point of the branch next to a predicted place, or at an end of the span; None if it is not there."""
        here = self.points[-1]
        nu, along = (place.nu, self.tracer.across(here)) if end is None else (end, (0.0, 1.0))
        closed = self.tracer.closed(TurnGuess(place.xi, nu, along, self.backward), PREDICTED_TOLERANCE * step**2)
        if closed is None:
            return None
        if end is None and (beyond := _end_beyond(closed.nu, EDGE_TOLERANCE)) is not None:
            return self._corrected(place, step, beyond)
        point = self.tracer.point(closed, here.tangent)
        return (closed, point) if _fits(here, point, step, place, end) else None

    def finished(self) -> ContinuationPoints:
        """Put in the folds, where the exponent changes its sign."""
        self._look_within()
        self._look_between()
        signs = [point.turn.exponent > 0.0 for point in self.points]
        turned = [i for i in range(1, len(signs)) if signs[i] != signs[i - 1]]
        folds = {i: self._fold(i) for i in turned}
        points: list[ContinuationPoint] = []
        rows: list[int] = []
        for i, point in enumerate(self.points):
            fold = folds.get(i)
            if fold is not None and _bends(fold, self.points[max(i - 2, 0) : i], self.points[i : i + 2]):
                rows.append(len(points))
                points.append(fold)
            points.append(point)
        return ContinuationPoints(tuple(points), tuple(rows), self.reason or "stuck")

    def _look_within(self) -> None:
        """Put in points within a step by whose tangents and ends the value turns back twice."""
        tried, i = 0, 1
        while i < len(self.points):
            one, two = self.points[i - 1 : i + 1]
            point = None
            if tried < MAX_HALVINGS and _turns_twice(one, two):
                first = max(i - 2, 0)
                lengths = ArclengthCurve(self.tracer, self.points[first : i + 2]).lengths
                point = self._placed(first, i + 2, 0.5 * (lengths[i - 1 - first] + lengths[i - first]))
            if point is None or not 0.0 < _part(one, two, point) < 1.0:
                tried, i = 0, i + 1
                continue
            self.points.insert(i, point)
            tried += 1

    def _placed(self, first: int, end: int, length: float) -> ContinuationPoint | None:
        """Find the point of the branch at a length of the course of some of its points."""
        place, near = ArclengthCurve(self.tracer, self.points[first:end]).between(length)
        guess = TurnGuess(place.xi, place.nu, self.tracer.across(near), near.turn.exponent > 0.0)
        closed = self.tracer.closed(guess)
        return None if closed is None else self.tracer.point(closed, near.tangent)

    def _look_between(self) -> None:
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
            point = self._placed(first, i + 3, before + length)
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

    @staticmethod
    def _longest(point: ContinuationPoint) -> float:
        """Return the longest step from a point."""
        rise, chi = abs(point.tangent[0]), point.turn.chi
        return min(MAX_STEP, MAX_LOG_Y * chi * (1.0 - chi) / rise) if rise > 0.0 else MAX_STEP

    def _over(self, here: ContinuationPoint, there: ContinuationPoint) -> str | None:
        """Return the reason why the branch ends with the step between two points, or None."""
        whole = there.turn.chi > MAX_CHI and abs(there.turn.exponent) < LARGE_EXPONENT
        lowest = LOW_HEIGHT if whole else MIN_HEIGHT
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

    def _fold(self, i: int) -> ContinuationPoint | None:
        """Find the point between the i-th one and the one before where the exponent is zero; by bisection at a kink."""
        around, k, middle = self.points[max(i - 2, 0) : i + 2], min(i, 2), None
        for halved in range(MAX_HALVINGS):
            here, there = around[k - 1], around[k]
            course = ArclengthCurve(self.tracer, around)
            place, near = course.between(course.neutral(k))
            nearby = DIFFERENCE_STEP * 0.2**halved  # where the exponent changes fast, smaller ones tell
            found = self.tracer.fold(place.xi, place.nu, near, nearby)
            if found is not None and -FOLD_SLACK < _part(here, there, found) < 1.0 + FOLD_SLACK:
                return found
            if _may_be_rounding(here, there):
                return None
            place, near = course.between(0.5 * (course.lengths[k - 1] + course.lengths[k]))
            guess = TurnGuess(place.xi, place.nu, self.tracer.across(near), near.turn.exponent > 0.0)
            closed = self.tracer.closed(guess)
            if closed is None:
                return None
            middle = self.tracer.point(closed, here.tangent)
            same = (middle.turn.exponent > 0.0) == (here.turn.exponent > 0.0)
            around, k = [middle, there] if same else [here, middle], 1
        sides = [point.nu - middle.nu for point in self.points[i - 1 : i + 1]] if middle is not None else [0.0, 0.0]
        return middle if sides[0] * sides[1] > 0.0 and min(map(abs, sides)) > KINKED_FOLD_CHANGE else None


def _end_beyond(nu: float, slack: float) -> float | None:
    """Return the end of the span beyond which nu lies, if it does."""
    return 0.0 if nu <= -slack else 1.0 if nu >= 1.0 + slack else None


def _fits(
    here: ContinuationPoint, there: ContinuationPoint, step: float, expected: CurvePoint, end: float | None
) -> bool:
    """Whether a point is the one that was expected, a step after another."""
    (tc, tn), least = here.tangent, 0.0 if end is not None else MAX_PREDICTION_ERROR * step
    onward = tc * (there.turn.chi - here.turn.chi) + tn * (there.nu - here.nu)
    cosine = tc * there.tangent[0] + tn * there.tangent[1]
    missed = math.hypot(there.turn.chi - expected.chi, there.nu - expected.nu)
    return missed < MAX_PREDICTION_ERROR * step and least < onward < 3.0 * step and cosine > MIN_TANGENT_COSINE


def _growth(here: ContinuationPoint, there: ContinuationPoint, correction: float) -> float:
    """By what the next step may be longer: by the turn of the tangent, and the first correction in steps."""
    cosine = here.tangent[0] * there.tangent[0] + here.tangent[1] * there.tangent[1]
    turn = math.acos(min(cosine, 1.0))
    return max(
        min(GROWTH, TARGET_TURN / max(turn, 1e-9), (TARGET_CORRECTION / max(correction, 1e-9)) ** 0.25), SHRINKAGE
    )


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
