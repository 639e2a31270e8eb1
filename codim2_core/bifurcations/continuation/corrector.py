"""Closed turns of a family by Newton's method, and what a branch of cycles is at one: its tangent, its folds.

The curve lies in the plane (chi, nu): chi in [0, 1) is the place on a ray, in shares of its reach, and
``nu = (value - low)/(high - low)``. A fold is an ordinary point of the curve; it is where the Floquet exponent changes
sign.

The predictor gives points ahead and in between, by some points of the branch and their tangents.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import accumulate, pairwise
from typing import NamedTuple

import numpy as np

from ...numerics.sign_changes import root_through
from ...results.arrays import Array
from .turns import ContinuationPoint, ReturnMapPoint, TurnGuess, VariedRay

MIN_SPACING = 0.25  # of a step: how far from one another they are, at least: a fold may lie next to one


class CurvePoint(NamedTuple):
    """A place of the curve, or its derivative by the length: xi and chi of `turns.ReturnMapPoint`, and nu."""

    xi: float
    chi: float
    nu: float


def predict(
    lengths: Sequence[float], places: Sequence[CurvePoint], tangents: Sequence[CurvePoint], rate: float, step: float
) -> CurvePoint | None:
    """Predict the point a step after the last one, by it and one before; None where the section ends before."""
    last = len(lengths) - 1
    rows = [last, *(i for i in range(last - 1, -1, -1) if lengths[last] - lengths[i] > MIN_SPACING * step)][:2]
    near, along = ([column[i] for i in rows] for column in (places, tangents))
    return interpolate([lengths[i] for i in rows], near, along, rate, lengths[last] + step)


def interpolate(
    lengths: Sequence[float], places: Sequence[CurvePoint], tangents: Sequence[CurvePoint], rate: float, where: float
) -> CurvePoint | None:
    """Return the place at another length of the curve through some points; None beyond the section."""
    chi = places[0].chi
    # xi goes to infinity at C and at the equator: with chi there is what is left of it next to these two logarithms
    outer = 1.0 if chi < 0.5 else (1.0 / rate - 1.0 / chi) * (1.0 - chi)
    values, slopes = [], []
    for place, along in zip(places, tangents, strict=True):
        rest = place.xi - math.log(place.chi) + outer * math.log(1.0 - place.chi)
        by_rest = along.xi - (1.0 / place.chi + outer / (1.0 - place.chi)) * along.chi
        values.append((rest, place.chi, place.nu))
        slopes.append((by_rest, along.chi, along.nu))
    at = np.array(lengths) - lengths[0]
    rest, chi, nu = _hermite(at, np.array(values), np.array(slopes), where - lengths[0]).tolist()
    return CurvePoint(rest + math.log(chi) - outer * math.log(1.0 - chi), chi, nu) if 0.0 < chi < 1.0 else None


def _hermite(at: Array, values: Array, slopes: Array, where: float) -> Array:
    """Evaluate the polynomials of degree 2 m - 1 with values and slopes (m, q) at m places, by Newton's differences."""
    x = np.repeat(at, 2)
    column = np.repeat(values, 2, axis=0)
    top = [column[0]]
    for order in range(1, len(x)):
        width = (x[order:] - x[:-order])[:, None]
        if order == 1:
            difference = np.diff(column, axis=0)
            difference[1::2] /= width[1::2]
            difference[::2] = slopes
            column = difference
        else:
            column = np.diff(column, axis=0) / width
        top.append(column[0])
    found = top[-1]
    for coefficient, place in zip(top[-2::-1], x[-2::-1], strict=True):
        found = coefficient + (where - place) * found
    return found


MAX_LOG_Y = 1.0  # in ln y
MAX_ROUNDS = 7  # of Newton's method
NEWTON_TOLERANCE, FOLD_TOLERANCE = 1e-9, 1e-11  # the last correction in chi, nu and, near C, a tenth of xi; at a fold
NEUTRAL_EXPONENT = 2e-10  # exponent of a fold
DIFFERENCE_STEP = 1e-5  # in xi rate and nu: for the derivatives of the exponent
MAX_SHIFT_CHANGE = 1e-3  # of the shift, by that difference in nu at most


class ClosedTurn(NamedTuple):
    """A turn that closes, its nu, and the first correction of the guess that led to it."""

    turn: ReturnMapPoint
    nu: float
    first: float


class BranchTracer:
    """Continuation in one family over a span of values."""

    def __init__(self, family: VariedRay, low: float, high: float) -> None:
        self.family, self.low, self.width = family, low, high - low

    def followed(self, guess: TurnGuess) -> ReturnMapPoint | None:
        """Follow one turn from a guess."""
        if not -700.0 < guess.xi < 690.0:
            return None
        course = self.family.course(guess.xi, self.low + guess.nu * self.width, guess.backward)
        return None if course is None else course.turn

    def closed(self, guess: TurnGuess, carry: float = 0.0) -> ClosedTurn | None:
        """Find the closed turn by one guess, by Newton's method.

        A last correction is made without another turn if its product with the one before is at most `carry`.
        """
        before: ReturnMapPoint | None = None
        first = last = math.inf
        for _ in range(MAX_ROUNDS):
            turn = self.followed(guess)
            if turn is None or not turn.rate > 0.0:  # so near to an end of the section that chi no longer changes
                return None
            gx, gn = turn.by_xi, turn.by_value * self.width
            det = gx * guess.along[1] - gn * guess.along[0]
            if det == 0.0 or not math.isfinite(det):
                return None
            dx, dn = -turn.shift * guess.along[1] / det, turn.shift * guess.along[0] / det
            size = max(abs(turn.rate * dx), abs(dn), 0.1 * abs(dx) if turn.chi < 0.1 else 0.0)
            first = size if before is None else first
            xi, nu = guess.xi + dx, guess.nu + dn
            if before is not None and (size <= NEWTON_TOLERANCE or size * last <= carry):
                return ClosedTurn(self.extrapolated(before, turn, xi, nu), nu, first)
            if size <= NEWTON_TOLERANCE:
                return ClosedTurn(replace(turn, xi=xi, value=self.low + nu * self.width), nu, first)
            if size > 2.0 * last or abs(dx) * turn.rate > MAX_LOG_Y * turn.chi * (1.0 - turn.chi):
                return None
            last, before = size, turn
            guess = TurnGuess(xi, nu, guess.along, self.backward(turn, guess.backward))
        return None

    def extrapolated(self, one: ReturnMapPoint, two: ReturnMapPoint, xi: float, nu: float) -> ReturnMapPoint:
        """Carry what is measured on a turn linearly along the line of Newton's steps to their end."""
        value = self.low + nu * self.width
        x1, n1 = two.rate * (two.xi - one.xi), (two.value - one.value) / self.width
        x2, n2 = two.rate * (xi - two.xi), (value - two.value) / self.width
        part = (x1 * x2 + n1 * n2) / (x1 * x1 + n1 * n1)

        def carried(name: str) -> float:
            return getattr(two, name) + part * (getattr(two, name) - getattr(one, name))

        p = (two.p[0] + part * (two.p[0] - one.p[0]), two.p[1] + part * (two.p[1] - one.p[1]))
        names = ("by_xi", "by_value", "exponent", "period", "amplitude", "height", "rate", "chi")
        return ReturnMapPoint(xi=xi, value=value, shift=0.0, p=p, **{name: carried(name) for name in names})

    @staticmethod
    def backward(turn: ReturnMapPoint, before: bool) -> bool:
        """In which direction of time errors fade; unchanged near a fold."""
        return turn.exponent > 0.0 if abs(turn.exponent) > 1.0 else before

    def point(self, closed: ClosedTurn, towards: tuple[float, float]) -> ContinuationPoint:
        """Give a closed turn the tangent that makes an acute angle with `towards` (chi, nu)."""
        turn = closed.turn
        tc, tn = turn.by_value * self.width, -turn.by_xi / turn.rate
        length = math.hypot(tc, tn)
        sign = math.copysign(1.0 / length, tc * towards[0] + tn * towards[1])
        return ContinuationPoint(turn, closed.nu, (sign * tc, sign * tn))

    def along(self, point: ContinuationPoint) -> CurvePoint:
        """Tangent of a point as the derivative of its place."""
        tc, tn = point.tangent
        return CurvePoint(tc / point.turn.rate, tc, tn)

    def across(self, point: ContinuationPoint) -> tuple[float, float]:
        """Covector by (xi, nu) of the lengths along the tangent of a point."""
        tc, tn = point.tangent
        return point.turn.rate * tc, tn

    def fold(
        self, xi: float, nu: float, near: ContinuationPoint, nearby: float = DIFFERENCE_STEP
    ) -> ContinuationPoint | None:
        """Find the point about (xi, nu) where the exponent is zero, by Newton's method with differences of `nearby`."""
        last = math.inf
        k = min(nearby, MAX_SHIFT_CHANGE / max(abs(near.turn.by_value) * self.width, 1e-300))
        for _ in range(MAX_ROUNDS):
            h = nearby / near.turn.rate
            places = ((xi, nu), (xi + h, nu), (xi, nu + k))
            turn, *shifted = (self.followed(TurnGuess(*place, (0.0, 0.0), backward=False)) for place in places)
            if turn is None or shifted[0] is None or shifted[1] is None:
                return None
            gx, gn = turn.by_xi, turn.by_value * self.width
            ex, en = (shifted[0].exponent - turn.exponent) / h, (shifted[1].exponent - turn.exponent) / k
            det = gx * en - gn * ex
            if det == 0.0 or not math.isfinite(det):
                return None
            dx, dn = (gn * turn.exponent - en * turn.shift) / det, (ex * turn.shift - gx * turn.exponent) / det
            size = max(abs(turn.rate * dx), abs(dn))
            if size > 2.0 * last or abs(dx) * turn.rate > MAX_LOG_Y * turn.chi * (1.0 - turn.chi):
                return None
            xi, nu, last = xi + dx, nu + dn, size
            if size <= FOLD_TOLERANCE or (size <= NEWTON_TOLERANCE and abs(turn.exponent) < NEUTRAL_EXPONENT):
                return self.point(
                    ClosedTurn(replace(turn, xi=xi, value=self.low + nu * self.width), nu, size), near.tangent
                )
        return None


def distance(one: ContinuationPoint, other: ContinuationPoint) -> float:
    """Return how far two points are apart in (chi, nu)."""
    return math.hypot(other.turn.chi - one.turn.chi, other.nu - one.nu)


class ArclengthCurve:
    """Some points of a branch as a curve by its length."""

    def __init__(self, tracer: BranchTracer, points: list[ContinuationPoint]) -> None:
        self.points = points
        self.lengths = [*accumulate((distance(one, two) for one, two in pairwise(points)), initial=0.0)]
        self.places = [CurvePoint(point.turn.xi, point.turn.chi, point.nu) for point in points]
        self.tangents = [tracer.along(point) for point in points]

    def ahead(self, step: float) -> CurvePoint | None:
        """Predict the point a step after the last one; None beyond the section."""
        return predict(self.lengths, self.places, self.tangents, self.points[-1].turn.rate, step)

    def between(self, length: float) -> tuple[CurvePoint, ContinuationPoint]:
        """Interpolate; also return the nearest point."""
        rows = sorted(range(len(self.points)), key=lambda i: abs(self.lengths[i] - length))
        lengths, near = [self.lengths[i] for i in rows], self.points[rows[0]]
        places, tangents = ([column[i] for i in rows] for column in (self.places, self.tangents))
        return interpolate(lengths, places, tangents, near.turn.rate, length) or places[0], near

    def neutral(self, k: int) -> float:
        """Find where the exponent is zero between the points k - 1 and k: by all of them, if it only rises or falls."""
        exponents = [point.turn.exponent for point in self.points]
        low, high = self.lengths[k - 1], self.lengths[k]
        rises = [two > one for one, two in pairwise(exponents)]
        if all(rises) or not any(rises):
            found = root_through(self.lengths, exponents)
            if low < found < high:
                return found
        return low + (high - low) * exponents[k - 1] / (exponents[k - 1] - exponents[k])
