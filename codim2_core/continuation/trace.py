"""Pseudo-arclength continuation of one branch of cycles in (place on the section, parameter).

The curve lies in the plane (chi, nu): chi = y/(1 + y) in [0, 1), ``y = u.(x2 - C)`` on the section, and
``nu = (value - low)/(high - low)``. Near C and near the equator, where chi hardly changes with xi, a step is at most
`FARTHEST` in xi. A fold is an ordinary point of the curve; it is where the Floquet exponent changes sign.

Several points ahead are predicted at once, and corrected side by side in the lanes of the stepping; those up to the
first that is refused are kept.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from .ahead import Place, ahead
from .points import Guess, Point, Trace
from .turns import Turn
from .varied_system import Asking, Question, VariedSystem

STEP = 0.03  # the longest step
SMALLEST = 1e-7  # below this the branch is said to end
FARTHEST = 1.0  # in ln y
ROUNDS = 7  # of Newton's method
CLOSE, CLOSER = 1e-9, 1e-11  # the last correction, and at a fold
CARRY = 1e-8  # product of the last two corrections, in steps
NEUTRAL = 2e-10  # exponent of a fold
SMALL = 3e-3  # amplitude at which a branch has come to C
LARGE, LOW, LOWEST = 0.999, 1e-3, 1e-7  # chi, ebar at which it has come to the equator: all of it, or a part
LEVEL, DEAD = 0.05, 1e-8  # ebar and exponent at which cycle and closed equator cannot be told apart
BENT, ROUNDING = 1e-9, 1e-12  # change of nu about a fold near the equator, where exponents tend to 0, and elsewhere
BESIDE = 1e-4  # of the span: so close to its end a branch that breaks off is followed to it
MOST = 600  # points
MISSED = 0.3  # distance of a point from its prediction, in steps, beyond which a step is too long
TURNED = 0.95  # cosine between successive tangents below which a step is too long
AHEAD, MEMORY = 8, 12  # points predicted at once; last points that predictions know of
NEARBY = 1e-5  # in xi rate and nu: for the derivatives of the exponent


class Tracer:
    """Continuation in one family over a span of values.

    Parameters
    ----------
    family : VariedSystem
    low, high : float
    """

    def __init__(self, family: VariedSystem, low: float, high: float) -> None:
        self.family, self.low, self.width = family, low, high - low

    def question(self, guesses: Sequence[Guess]) -> Question:
        """Ask for one turn from each."""
        values = [self.low + g.nu * self.width if -700.0 < g.xi < 690.0 else math.nan for g in guesses]
        return Question(self.family, [g.xi for g in guesses], values, [g.backward for g in guesses])

    def corrected(self, guess: Guess) -> Asking[tuple[Turn, float] | None]:
        """Find the closed turn by one guess, see `all_corrected`."""
        return (yield from self.all_corrected([guess]))[0]

    def all_corrected(
        self, guesses: Sequence[Guess], close: float = CLOSE, carry: float = 0.0
    ) -> Asking[list[tuple[Turn, float] | None]]:
        """Newton's method for closed turns, side by side.

        Parameters
        ----------
        guesses : sequence of Guess
        close : float
            The last correction, in chi, nu and a tenth of xi.
        carry : float
            Product of the last two corrections below which the last is made without another turn.

        Returns
        -------
        list of (Turn, nu), or None
        """
        searches = [Search(self, guess, close, carry) for guess in guesses]
        for _ in range(ROUNDS):
            open_ = [search for search in searches if not search.over]
            if not open_:
                break
            followed = yield self.question([search.guess for search in open_])
            for search, turn in zip(open_, followed, strict=True):
                search.told(turn)
        return [search.found for search in searches]

    def extrapolated(self, one: Turn, two: Turn, xi: float, nu: float) -> Turn:
        """Carry what is measured on a turn linearly along the line of Newton's steps to their end."""
        value = self.low + nu * self.width
        x1, n1 = two.rate * (two.xi - one.xi), (two.value - one.value) / self.width
        x2, n2 = two.rate * (xi - two.xi), (value - two.value) / self.width
        part = (x1 * x2 + n1 * n2) / (x1 * x1 + n1 * n1)

        def carried(name: str) -> float:
            return getattr(two, name) + part * (getattr(two, name) - getattr(one, name))

        p = (two.p[0] + part * (two.p[0] - one.p[0]), two.p[1] + part * (two.p[1] - one.p[1]))
        names = ("by_xi", "by_value", "exponent", "period", "amplitude", "height", "rate", "drift", "chi")
        return Turn(xi=xi, value=value, shift=0.0, p=p, **{name: carried(name) for name in names})

    @staticmethod
    def backward(turn: Turn, before: bool) -> bool:
        """In which direction of time errors fade; unchanged near a fold."""
        return turn.exponent > 0.0 if abs(turn.exponent) > 1.0 else before

    def point(self, turn: Turn, nu: float, towards: tuple[float, float]) -> Point:
        """Give a closed turn the tangent that makes an acute angle with `towards` (chi, nu)."""
        tc, tn = turn.by_value * self.width - turn.by_xi * turn.drift / turn.rate * self.width, -turn.by_xi / turn.rate
        length = math.hypot(tc, tn)
        sign = math.copysign(1.0 / length, tc * towards[0] + tn * towards[1])
        return Point(turn, nu, (sign * tc, sign * tn))

    def trace(self, start: Point) -> Asking[Trace]:
        """Follow the branch from a point along its tangent until it ends.

        Parameters
        ----------
        start : Point
        """
        path = _Path(self, start)
        while path.reason is None and len(path.points) < MOST:
            yield from path.go_on()
        reason = path.reason or "stuck"
        last = path.points[-1]
        if reason == "stuck" and min(last.nu, 1.0 - last.nu) < BESIDE:
            # beyond the span the parameter may not be allowed, so that no step leads there
            nu = float(round(last.nu))
            found = yield from self.corrected(Guess(last.turn.xi, nu, (0.0, 1.0), path.backward))
            if found is not None:
                path.points.append(self.point(found[0], nu, last.tangent))
                reason = "span"
        return Trace(tuple(path.points), tuple(path.folds), reason)

    def along(self, point: Point) -> Place:
        """Tangent of a point as the derivative of its place."""
        tc, tn = point.tangent
        return Place((tc - point.turn.drift * self.width * tn) / point.turn.rate, tc, (tn,))

    def across(self, point: Point) -> tuple[float, float]:
        """Covector by (xi, nu) of the lengths along the tangent of a point."""
        tc, tn = point.tangent
        return point.turn.rate * tc, tn + point.turn.drift * self.width * tc

    def fold(self, here: Point, there: Point) -> Asking[Point | None]:
        """Find the point between two where the exponent is zero: Newton's method for a closed turn of exponent 0."""
        part = here.turn.exponent / (here.turn.exponent - there.turn.exponent)
        xi, nu = (one + part * (two - one) for one, two in ((here.turn.xi, there.turn.xi), (here.nu, there.nu)))
        near = here if part < 0.5 else there
        last, tangent = math.inf, near.tangent
        for _ in range(ROUNDS):
            h, k = NEARBY / near.turn.rate, NEARBY
            places = ((xi, nu), (xi + h, nu), (xi, nu + k))
            turn, *beside = yield self.question([Guess(*place, (0.0, 0.0), backward=False) for place in places])
            if turn is None or beside[0] is None or beside[1] is None:
                return None
            gx, gn = turn.by_xi, turn.by_value * self.width
            ex, en = (beside[0].exponent - turn.exponent) / h, (beside[1].exponent - turn.exponent) / k
            det = gx * en - gn * ex
            if det == 0.0 or not math.isfinite(det):
                return None
            dx, dn = (gn * turn.exponent - en * turn.shift) / det, (ex * turn.shift - gx * turn.exponent) / det
            size = max(abs(turn.rate * dx), abs(dn))
            if size > 2.0 * last or abs(dx) * turn.rate > FARTHEST * turn.chi * (1.0 - turn.chi):
                return None
            xi, nu, last = xi + dx, nu + dn, size
            if size <= CLOSER or (size <= CLOSE and abs(turn.exponent) < NEUTRAL):
                found = self.point(replace(turn, xi=xi, value=self.low + nu * self.width), nu, tangent)
                between = max(_distance(here, found), _distance(found, there)) <= 1.5 * _distance(here, there)
                return found if between else None
        return None

    def edge(self, here: Point, there: Point, backward: bool) -> Asking[Point | None]:
        """Find the point between two whose value is an end of the span."""
        nu = 0.0 if there.nu < 0.0 else 1.0
        part = (nu - here.nu) / (there.nu - here.nu)
        xi = here.turn.xi + part * (there.turn.xi - here.turn.xi)
        found = yield from self.corrected(Guess(xi, nu, (0.0, 1.0), backward))
        return None if found is None else self.point(found[0], nu, here.tangent)


class Search:
    """One of the searches of `Tracer.all_corrected`: its guess after the turns that it was told of."""

    def __init__(self, tracer: Tracer, guess: Guess, close: float, carry: float) -> None:
        self.tracer, self.guess, self.close, self.carry = tracer, guess, close, carry
        self.found: tuple[Turn, float] | None = None
        self.over = False
        self.last, self.before = math.inf, None

    def told(self, turn: Turn | None) -> None:
        """Take a step of Newton's method from the turn that was followed at the guess."""
        self.over = True
        if turn is None:
            return
        guess, width = self.guess, self.tracer.width
        gx, gn = turn.by_xi, turn.by_value * width
        det = gx * guess.along[1] - gn * guess.along[0]
        if det == 0.0 or not math.isfinite(det):
            return
        dx, dn = -turn.shift * guess.along[1] / det, turn.shift * guess.along[0] / det
        size = max(abs(turn.rate * dx), abs(dn), 0.1 * abs(dx) if turn.chi < 0.1 else 0.0)
        xi, nu = guess.xi + dx, guess.nu + dn
        if size <= self.close:
            self.found = replace(turn, xi=xi, value=self.tracer.low + nu * width), nu
        elif self.before is not None and size * self.last <= self.carry:
            self.found = self.tracer.extrapolated(self.before, turn, xi, nu), nu
        elif size <= 2.0 * self.last and abs(dx) * turn.rate <= FARTHEST * turn.chi * (1.0 - turn.chi):
            self.last, self.before, self.over = size, turn, False
            self.guess = Guess(xi, nu, guess.along, self.tracer.backward(turn, guess.backward))


class _Path:
    """One call of `Tracer.trace`: points so far, where they lie along the branch, and how it goes on.

    `reason` is why the branch has ended, None while it has not.
    """

    def __init__(self, tracer: Tracer, start: Point) -> None:
        self.tracer, self.points, self.length = tracer, [start], [0.0]
        self.folds: list[int] = []
        self.step, self.ahead = 0.25 * STEP, 1
        self.backward = start.turn.exponent > 0.0
        self.reason: str | None = None

    def go_on(self) -> Asking[None]:
        """Take several steps, as many as turn out well; or make them shorter."""
        here = self.points[-1]
        if here.turn.height < LEVEL and here.tangent[0] > 0.0 and abs(here.turn.exponent) < DEAD:
            self.reason = "equator"
            return
        far = abs(here.tangent[0]) / (here.turn.chi * (1.0 - here.turn.chi))
        longest = min(STEP, FARTHEST / far if far > 0.0 else STEP)
        step = self.step = min(self.step, longest)
        steps = [min(step * 1.6**k, longest) for k in range(self.ahead)]
        taken = 0
        for number, found in enumerate((yield from self._found(steps))):
            if found is None or not self._fits(*found, steps[number], number):
                break
            if not (yield from self._take(found[0])):
                break
            taken += 1
            if self.reason is not None:
                return
        if not taken:
            self.step, self.ahead = 0.4 * step, 1
            if self.step < min(SMALLEST, 1e-3 * longest):
                self.reason = "stuck"
            return
        whole = taken == len(steps)
        self.step, self.ahead = 1.6 * steps[taken - 1], min(2 * self.ahead, AHEAD) if whole else max(taken, 1)

    def _found(self, steps: list[float]) -> Asking[list[tuple[Point, float, float] | None]]:
        """Points after so many steps from one another, each with the chi and nu predicted for it."""
        tracer, here = self.tracer, self.points[-1]
        rows = range(max(len(self.points) - MEMORY, 0), len(self.points))
        places = [Place(p.turn.xi, p.turn.chi, (p.nu,)) for p in (self.points[i] for i in rows)]
        tangents = [tracer.along(self.points[i]) for i in rows]
        predicted = ahead([self.length[i] for i in rows], places, tangents, here.turn.rate, steps)
        line = tracer.across(here)
        guesses = [Guess(place.xi, place.parameters[0], line, self.backward) for place in predicted]
        found = yield from tracer.all_corrected(guesses, carry=CARRY * steps[0] ** 2)
        return [
            None if closed is None else (tracer.point(*closed, here.tangent), place.chi, place.parameters[0])
            for closed, place in zip(found, predicted, strict=True)
        ]

    def _fits(self, point: Point, chi: float, nu: float, step: float, number: int) -> bool:
        """Whether a point is the one that was looked for, a step after the last."""
        here = self.points[-1]
        tc, tn = here.tangent
        ahead = tc * (point.turn.chi - here.turn.chi) + tn * (point.nu - here.nu)
        cosine = tc * point.tangent[0] + tn * point.tangent[1]
        missed = math.hypot(point.turn.chi - chi, point.nu - nu)
        return missed < MISSED * (number + 1) * step and MISSED * step < ahead < 3.0 * step and cosine > TURNED

    def _take(self, found: Point) -> Asking[bool]:
        """Add a point, and a fold before it; False where the step to it was too long."""
        here = self.points[-1]
        if (found.turn.exponent > 0.0) != (here.turn.exponent > 0.0):
            fold = yield from self.tracer.fold(here, found)
            if fold is None and found.turn.height > LEVEL:
                return False
            bent = 0.0 if fold is None else max(abs(fold.nu - here.nu), abs(fold.nu - found.nu))
            if fold is not None and bent > (BENT if fold.turn.height < LEVEL else ROUNDING):
                self.folds.append(len(self.points))
                self._add(fold)
        if not 0.0 <= found.nu <= 1.0:
            edge = yield from self.tracer.edge(self.points[-1], found, self.backward)
            if edge is not None:
                self.points.append(edge)
            self.reason = "span"
            return True
        self._add(found)
        self.backward = self.tracer.backward(found.turn, self.backward)
        start, lowest = self.points[0], LOW if found.turn.chi > LARGE else LOWEST
        if found.turn.amplitude < SMALL and found.tangent[0] < 0.0:
            self.reason = "C"
        elif found.turn.height < lowest and found.turn.height < here.turn.height:
            self.reason = "equator"
        elif len(self.points) > 8 and _round(start, here, found):
            self.points.append(start)
            self.reason = "closed"
        return True

    def _add(self, point: Point) -> None:
        self.length.append(self.length[-1] + _distance(self.points[-1], point))
        self.points.append(point)


def _round(start: Point, here: Point, there: Point) -> bool:
    """Whether a step has passed the start in the start's direction."""
    ux, un = here.turn.chi - start.turn.chi, here.nu - start.nu
    vx, vn = there.turn.chi - start.turn.chi, there.nu - start.nu
    tc, tn = start.tangent
    near = max(_distance(here, start), _distance(there, start))
    return ux * tc + un * tn < 0.0 <= vx * tc + vn * tn and near < 2.0 * STEP


def _distance(one: Point, other: Point) -> float:
    return math.hypot(other.turn.chi - one.turn.chi, other.nu - one.nu)
