"""Pseudo-arclength continuation of one branch of cycles in (place on the section, parameter).

The curve lies in the plane (chi, nu): chi = y/(1 + y) in [0, 1), ``y = u.(x2 - C)`` on the section, and
``nu = (value - low)/(high - low)``. Near C and near the equator, where chi hardly changes with xi, a step is at most
`FARTHEST` in xi. A fold is an ordinary point of the curve; it is where the Floquet exponent changes sign.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from .turn import Turn, VariedSystem

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


@dataclass(frozen=True)
class Point:
    """A point of a branch: a turn that closes, its nu, and the unit tangent (chi, nu)."""

    turn: Turn
    nu: float
    tangent: tuple[float, float]

    def xi(self, chi: float, change: float) -> float:
        """Find the xi of a chi nearby, where the value has changed: ln y is nearly linear in both."""
        here = self.turn
        chi = min(max(chi, 0.05 * here.chi), 1.0 - 0.05 * (1.0 - here.chi))
        logit = math.log(chi / (1.0 - chi)) - math.log(here.chi / (1.0 - here.chi))
        return here.xi + (logit * here.chi * (1.0 - here.chi) - here.drift * change) / here.rate


@dataclass(frozen=True)
class Trace:
    """Points in order, folds among them by index, and why it stopped: "C", "equator", "span", "closed" or "stuck"."""

    points: tuple[Point, ...]
    folds: tuple[int, ...]
    reason: str


class Tracer:
    """Continuation in one family over a span of values.

    Parameters
    ----------
    family : VariedSystem
    low, high : float
    """

    def __init__(self, family: VariedSystem, low: float, high: float) -> None:
        self.family, self.low, self.width = family, low, high - low

    def turn(self, xi: float, nu: float, backward: bool) -> Turn | None:
        """Follow one turn."""
        if not -700.0 < xi < 690.0:
            return None
        return self.family.turn(xi, self.low + nu * self.width, backward)

    def corrected(
        self,
        xi: float,
        nu: float,
        along: tuple[float, float],
        backward: bool,
        close: float = CLOSE,
        carry: float = 0.0,
    ) -> tuple[Turn, float] | None:
        """Newton's method for a closed turn on the line through (xi, nu) across the covector `along`.

        Parameters
        ----------
        xi, nu : float
        along : (float, float)
            ``along[0] dxi + along[1] dnu = 0`` on the line.
        backward : bool
        close : float
            The last correction, in chi, nu and a tenth of xi.
        carry : float
            Product of the last two corrections below which the last is made without another turn.

        Returns
        -------
        Turn, nu, or None
        """
        last, before = math.inf, None
        for _ in range(ROUNDS):
            turn = self.turn(xi, nu, backward)
            if turn is None:
                return None
            gx, gn = turn.by_xi, turn.by_value * self.width
            det = gx * along[1] - gn * along[0]
            if det == 0.0 or not math.isfinite(det):
                return None
            dx, dn = -turn.shift * along[1] / det, turn.shift * along[0] / det
            size = max(abs(turn.rate * dx), abs(dn), 0.1 * abs(dx) if turn.chi < 0.1 else 0.0)
            xi, nu = xi + dx, nu + dn
            if size <= close:
                return replace(turn, xi=xi, value=self.low + nu * self.width), nu
            if before is not None and size * last <= carry:
                return self._extrapolated(before, turn, xi, nu), nu
            if size > 2.0 * last or abs(dx) * turn.rate > FARTHEST * turn.chi * (1.0 - turn.chi):
                return None
            last, before = size, turn
            backward = self.backward(turn, backward)
        return None

    def _extrapolated(self, one: Turn, two: Turn, xi: float, nu: float) -> Turn:
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

    def trace(self, start: Point) -> Trace:
        """Follow the branch from a point along its tangent until it ends.

        Parameters
        ----------
        start : Point
        """
        points, folds = [start], []
        length, step = [0.0], 0.25 * STEP
        backward = start.turn.exponent > 0.0
        reason = "stuck"
        while len(points) < MOST:
            here = points[-1]
            far = abs(here.tangent[0]) / (here.turn.chi * (1.0 - here.turn.chi))
            longest = min(STEP, FARTHEST / far if far > 0.0 else STEP)
            step = min(step, longest)
            if here.turn.height < LEVEL and here.tangent[0] > 0.0 and abs(here.turn.exponent) < DEAD:
                reason = "equator"
                break
            found = self._step(points, length, step, backward)
            if found is None:
                step *= 0.4
                if step < min(SMALLEST, 1e-3 * longest):
                    break
                continue
            if (found.turn.exponent > 0.0) != (here.turn.exponent > 0.0):
                fold = self._fold(here, found)
                if fold is None and found.turn.height > LEVEL:
                    step *= 0.4
                    if step < SMALLEST:
                        break
                    continue
                bent = 0.0 if fold is None else max(abs(fold.nu - here.nu), abs(fold.nu - found.nu))
                if fold is not None and bent > (BENT if fold.turn.height < LEVEL else ROUNDING):
                    folds.append(len(points))
                    points.append(fold)
                    length.append(length[-1] + _distance(here, fold))
            if not 0.0 <= found.nu <= 1.0:
                edge = self._edge(points[-1], found, backward)
                if edge is not None:
                    points.append(edge)
                reason = "span"
                break
            points.append(found)
            length.append(length[-1] + _distance(points[-2], found))
            backward = self.backward(found.turn, backward)
            if found.turn.amplitude < SMALL and found.tangent[0] < 0.0:
                reason = "C"
                break
            lowest = LOW if found.turn.chi > LARGE else LOWEST
            if found.turn.height < lowest and found.turn.height < here.turn.height:
                reason = "equator"
                break
            if len(points) > 8 and self._round(start, here, found):
                points.append(start)
                reason = "closed"
                break
            step *= 1.6
        last = points[-1]
        if reason == "stuck" and min(last.nu, 1.0 - last.nu) < BESIDE:
            # beyond the span the parameter may not be allowed, so that no step leads there
            nu = float(round(last.nu))
            found_there = self.corrected(last.turn.xi, nu, (0.0, 1.0), backward)
            if found_there is not None:
                points.append(self.point(found_there[0], nu, last.tangent))
                reason = "span"
        return Trace(tuple(points), tuple(folds), reason)

    def _step(self, points: list[Point], length: list[float], step: float, backward: bool) -> Point | None:
        here = points[-1]
        tc, tn = here.tangent
        chi, nu = here.turn.chi + step * tc, here.nu + step * tn
        if len(points) > 1:
            back, h = points[-2], length[-1] - length[-2]
            s = step / h
            if 0.05 < s < 4.0:
                chi = _hermite(back.turn.chi, here.turn.chi, h * back.tangent[0], h * tc, s)
                nu = _hermite(back.nu, here.nu, h * back.tangent[1], h * tn, s)
        xi = here.xi(chi, (nu - here.nu) * self.width)
        found = self.corrected(xi, nu, self._across(here), backward, carry=CARRY * step * step)
        if found is None:
            return None
        point = self.point(*found, here.tangent)
        ahead = tc * (point.turn.chi - here.turn.chi) + tn * (point.nu - here.nu)
        cosine = tc * point.tangent[0] + tn * point.tangent[1]
        missed = math.hypot(point.turn.chi - chi, point.nu - nu)
        return point if missed < MISSED * step < ahead < 3.0 * step and cosine > TURNED else None

    def _across(self, point: Point) -> tuple[float, float]:
        """Covector by (xi, nu) of the lengths along the tangent of a point."""
        tc, tn = point.tangent
        return point.turn.rate * tc, tn + point.turn.drift * self.width * tc

    def _fold(self, here: Point, there: Point) -> Point | None:
        """Find the point between two where the exponent is zero: the secant rule, kept in the bracket."""
        along = self._across(here)

        def place(point: Point) -> float:
            return (point.turn.xi - here.turn.xi) * along[0] + (point.nu - here.nu) * along[1]

        low, high, near = here, there, here
        for _ in range(30):
            s0, s1, y0, y1 = place(low), place(high), low.turn.exponent, high.turn.exponent
            s = s0 - y0 * (s1 - s0) / (y1 - y0)
            margin = 0.01 * abs(s1 - s0)
            s = min(max(s, min(s0, s1) + margin), max(s0, s1) - margin)
            near = min((low, high), key=lambda point: abs(place(point) - s))
            nc, nn = near.tangent
            moved = (nc - near.turn.drift * self.width * nn) / near.turn.rate
            part = (s - place(near)) / (along[0] * moved + along[1] * nn)
            found = self.corrected(near.turn.xi + part * moved, near.nu + part * nn, along, False, CLOSER)
            if found is None:
                return None
            near = self.point(*found, near.tangent)
            if abs(near.turn.exponent) < NEUTRAL or abs(s1 - s0) < 1e-13:
                break
            if (near.turn.exponent > 0.0) == (y0 > 0.0):
                low = near
            else:
                high = near
        return near

    def _edge(self, here: Point, there: Point, backward: bool) -> Point | None:
        """Find the point between two whose value is an end of the span."""
        nu = 0.0 if there.nu < 0.0 else 1.0
        part = (nu - here.nu) / (there.nu - here.nu)
        xi = here.turn.xi + part * (there.turn.xi - here.turn.xi)
        found = self.corrected(xi, nu, (0.0, 1.0), backward)
        return None if found is None else self.point(found[0], nu, here.tangent)

    @staticmethod
    def _round(start: Point, here: Point, there: Point) -> bool:
        """Whether a step has passed the start in the start's direction."""
        ux, un = here.turn.chi - start.turn.chi, here.nu - start.nu
        vx, vn = there.turn.chi - start.turn.chi, there.nu - start.nu
        tc, tn = start.tangent
        near = max(_distance(here, start), _distance(there, start))
        return ux * tc + un * tn < 0.0 <= vx * tc + vn * tn and near < 2.0 * STEP


def _distance(one: Point, other: Point) -> float:
    return math.hypot(other.turn.chi - one.turn.chi, other.nu - one.nu)


def reversed_trace(trace: Trace) -> Trace:
    """Return the same points in the opposite order, tangents turned; `reason` is dropped."""
    points = tuple(replace(p, tangent=(-p.tangent[0], -p.tangent[1])) for p in reversed(trace.points))
    last = len(points) - 1
    return Trace(points, tuple(sorted(last - i for i in trace.folds)), "")


def _hermite(x0: float, x1: float, m0: float, m1: float, s: float) -> float:
    """Cubic with values x0, x1 and slopes m0, m1 at 0 and 1, at 1 + s."""
    t = 1.0 + s
    return (
        (1.0 + 2.0 * t) * (1.0 - t) ** 2 * x0 + t * (1.0 - t) ** 2 * m0 + t * t * (3.0 - 2.0 * t) * x1 - t * t * s * -m1
    )
