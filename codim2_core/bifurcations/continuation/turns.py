"""Turns about a point of the layer problem, with their derivatives by place and parameter, for continuation of cycles.

The section is a ray ``p = p_0 + r u``, ``r = reach/(1 + exp(-xi))``, whose foot p_0 moves with the parameter mu while u
stays; both ends of a turn lie on it. With ``F = x2'`` and ``F x v = F1 v2 - F2 v1`` a deviation obeys

    F x delta(end) = exp(E) F x delta(0) + M,    E = int div dtau,    M = int exp(E(tau, end)) F x F_mu dtau

(Liouville's formula, Melnikov's integral).

A closed turn with its tangent is a point of a branch of cycles. The foot, a point inside cycles, is a critical set that
is followed, or a place that stays.
"""

from __future__ import annotations

import math
from bisect import bisect
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from ...numerics.arclength import newton
from ...portrait.cycles.limit_cycles import excluding_theorem
from ...portrait.cycles.periodic_orbit import STEP_NODES, gauss, path
from ...portrait.cycles.ray_section import HemispherePoint, Ray, room
from ...portrait.layer_problem.problem import LayerProblem
from ...results.arrays import Array
from ...systems.frozen import FrozenSystem
from ...systems.psi.function import Psi

Problems = Callable[[float], LayerProblem]

#: Of Newton's method for e: its last step (its error is the square), all of its way.
NEWTON_TOLERANCE, MAX_CORRECTION = 1e-9, 0.1
MAX_HALVINGS = 12  # of the way to a value at which it is not found at once: after these it is where it was last
MAX_RADIUS = 1.0 - 1e-9  # |e| of a critical set
NARROW_SHARE, MARGIN_SHARE = 0.25, 0.05  # of the span: a narrower part is searched alone; of the part, around it


class SectionBase:
    """The base point of a section, as a function of the parameter.

    A critical set is followed from where it is known; where it ceases to be one, its last place goes on. So the foot
    depends on the parameter alone, without a jump.
    """

    def __init__(self, problem: Problems, value: float, e: Array, critical: bool = True) -> None:
        self.problem, self.critical = problem, critical
        self._values, self._places = [value], [np.array(e, float)]
        self._found: dict[float, Array] = {}
        self._ends = (-math.inf, math.inf)  # it is no critical set beyond
        self._still = None if critical else hemisphere_place(problem(value).psi, self._places[0])

    def place(self, value: float) -> HemispherePoint:
        """Return the base point at a value."""
        return hemisphere_place(self.problem(value).psi, self.e(value)) if self._still is None else self._still

    def moved(self, value: float, values: tuple[float, float]) -> tuple[HemispherePoint, HemispherePoint]:
        """Return the base point at two values just next to one, to first order in their distance."""
        if self._still is not None:
            return self._still, self._still
        e, (low, high) = self.e(value), (self.problem(v) for v in values)
        slope = np.zeros(2)
        if self._ends[0] < value < self._ends[1]:
            D = self.problem(value).at.DU(e)
            det = D[0, 0] * D[1, 1] - D[0, 1] * D[1, 0]
            u, v = (high.at.U(e) - low.at.U(e)) / (values[1] - values[0])
            if det != 0.0:
                slope = np.array([D[0, 1] * v - D[1, 1] * u, D[1, 0] * u - D[0, 0] * v]) / det
        one, two = (hemisphere_place(p.psi, e + (v - value) * slope) for p, v in zip((low, high), values, strict=True))
        return one, two

    def e(self, value: float) -> Array:
        """(c, s) of the critical set at a value."""
        if value not in self._found:
            self._found[value] = self._track(min(max(value, self._ends[0]), self._ends[1]))
        return self._found[value]

    def _track(self, value: float) -> Array:
        i = bisect(self._values, value)
        k = min((k for k in (i - 1, i) if 0 <= k < len(self._values)), key=lambda k: abs(self._values[k] - value))
        here, e = self._values[k], self._places[k]
        step, tried = value - here, 0
        while here != value and tried < MAX_HALVINGS:
            there = value if abs(step) >= abs(value - here) else here + step
            found = correct_zero(self.problem(there).at, e)
            if found is None:
                step, tried = 0.5 * (there - here), tried + 1
            else:
                here, e = there, found
        if here != value:
            self._ends = (here, self._ends[1]) if value < here else (self._ends[0], here)
        where = bisect(self._values, here)
        if not where or self._values[where - 1] != here:
            self._values.insert(where, here)
            self._places.insert(where, e)
        return e


def correct_zero(system: FrozenSystem, start: Array) -> Array | None:
    """Newton's method for U = 0 from a place (c, s) nearby; None if it is not found."""
    e = newton(lambda e: (system.U(e), system.DU(e)), start, MAX_CORRECTION, NEWTON_TOLERANCE)
    return e if e is not None and math.hypot(*e) < MAX_RADIUS else None


def hemisphere_place(psi: Psi, e: Array) -> HemispherePoint:
    """Return the point of the hemisphere where e_Psi = e."""
    modulus = math.hypot(*e)
    zeta = float(psi.radius(modulus, (1.0 - modulus) * (1.0 + modulus)))
    x2 = e * (zeta / max(modulus, 1e-300))
    return HemispherePoint(x2 / math.hypot(1.0, zeta), x2)


def e_at(psi: Psi, x2: Array) -> Array:
    """Return (c, s) = e_Psi at a point x2: the inverse of `hemisphere_place`."""
    zeta = math.hypot(*x2)
    return np.asarray(x2 / max(zeta, 1e-300) * float(psi.modulus(zeta)))


def searched_part(problem: Problems, span: tuple[float, float], marked: Sequence[float]) -> tuple[float, float]:
    """Return the part of a span on which there may be cycles, if it is a narrow one: else the whole span."""
    low, high = span
    edges = sorted({low, high, *(value for value in marked if low < value < high)})
    inside = [(one, two) for one, two in pairwise(edges) if _may_have_cycles(problem(0.5 * (one + two)))]
    if not inside or inside[-1][1] - inside[0][0] > NARROW_SHARE * (high - low):
        return span
    margin = MARGIN_SHARE * (inside[-1][1] - inside[0][0])
    return max(low, inside[0][0] - margin), min(high, inside[-1][1] + margin)


def _may_have_cycles(problem: LayerProblem) -> bool:
    """Whether there is a critical set that a cycle may surround, and no theorem that forbids it."""
    return any(C.kind != "saddle" for C in problem.critical) and excluding_theorem(problem) is None


@dataclass(frozen=True)
class ReturnMapPoint:
    """One turn from a ray, at parameter value `value`; times in tau."""

    xi: float  # where on the section, and the parameter's value
    value: float
    shift: float  # xi after the turn minus before it; zero on a cycle
    by_xi: float  # derivatives of `shift`, at fixed value and at fixed xi
    by_value: float
    exponent: float  # ln of the Floquet multiplier
    period: float
    amplitude: float  # largest ``|p - p_C|`` on it in the projected disc
    height: float  # smallest ebar on it: how near to the equator it comes
    rate: float  # d chi/d xi
    chi: float  # the place on the section, in [0, 1): r over the reach
    p: tuple[float, float]  # where it crosses the section, in the projected disc


@dataclass(frozen=True)
class ContinuationPoint:
    """A point of a branch: a turn that closes, its nu, and the unit tangent (chi, nu)."""

    turn: ReturnMapPoint
    nu: float
    tangent: tuple[float, float]

    def xi(self, chi: float) -> float:
        """Find the xi of a chi nearby."""
        here = self.turn
        chi = min(max(chi, 0.05 * here.chi), 1.0 - 0.05 * (1.0 - here.chi))
        return here.xi + math.log(chi / (1.0 - chi)) - math.log(here.chi / (1.0 - here.chi))


@dataclass(frozen=True)
class TurnGuess:
    """A guess of a closed turn, on the line through (xi, nu) across the covector `along` (xi, nu)."""

    xi: float
    nu: float
    along: tuple[float, float]
    backward: bool


@dataclass(frozen=True)
class ContinuationPoints:
    """Points in order, folds among them by index, and why it stopped: "C", "equator", "span", "closed" or "stuck"."""

    points: tuple[ContinuationPoint, ...]
    folds: tuple[int, ...]
    reason: str


def reversed_trace(trace: ContinuationPoints) -> ContinuationPoints:
    """Return the same points in the opposite order, tangents turned; `reason` is dropped."""
    points = tuple(replace(p, tangent=(-p.tangent[0], -p.tangent[1])) for p in reversed(trace.points))
    last = len(points) - 1
    return ContinuationPoints(points, tuple(sorted(last - i for i in trace.folds)), "")


def points_at_value(trace: ContinuationPoints, nu: float) -> list[tuple[float, TurnGuess]]:
    """Return the chi at which a branch passes nu, between its points, and guesses of its cycles there."""
    found = []
    for one, two in pairwise(trace.points):
        low, high = sorted((one.nu, two.nu))
        if low - 1e-9 <= nu <= high + 1e-9:
            part = (nu - one.nu) / (two.nu - one.nu) if two.nu != one.nu else 0.5
            chi, near = one.turn.chi + part * (two.turn.chi - one.turn.chi), one if part < 0.5 else two
            guess = TurnGuess(near.xi(chi), nu, (0.0, 1.0), near.turn.exponent > 0.0)
            found.append((chi, guess))
    return found


RTOL = 1e-12  # of one turn
MAX_EXPONENT = 600.0
DIFFERENCE_STEP = 1e-5  # of the span, of the differences for derivatives: they tell the way, not the place


@dataclass(frozen=True)
class FiniteDifference:
    """The problem at two values next to one, how these differ, and how the ray moves between them."""

    low: LayerProblem
    high: LayerProblem
    width: float
    moved: Array  # d p_0/d mu
    widened: float  # d reach/d mu


@dataclass(frozen=True)
class TurnOrbit:
    """A turn, the states along it (k, 3), derivatives of its shift by each parameter, and the exponent `left` (k,)."""

    turn: ReturnMapPoint
    states: Array
    by_values: tuple[float, ...]
    left: Array


def turn(
    ray: Ray, xi: float, value: float, differences: Sequence[FiniteDifference], centre: HemispherePoint, backward: bool
) -> TurnOrbit | None:
    """Follow one turn from a place on a ray; None if it does not return."""
    start, _ = ray.states(np.array([xi]))
    way = path(ray, start[0], RTOL, backward)
    if way is None:
        return None
    sign = -1.0 if backward else 1.0
    _, weights, matrix = gauss()
    e, D = _regularised_direction(ray.psi, np.concatenate([way.inner, start, way.end[None]]))
    F = sign * ray.field(e)
    J = ray.derivative(e[:-2]) @ D[:-2]
    rates = (sign * (J[:, 0, 0] + J[:, 1, 1]) / way.inner[:, 2]).reshape(-1, STEP_NODES)
    whole = way.h * (rates @ weights)
    exponent = float(whole.sum())
    if not abs(exponent) < MAX_EXPONENT:
        return None
    past = np.concatenate([[0.0], np.cumsum(whole)[:-1]])
    left = exponent - past[:, None] - way.h[:, None] * (rates @ matrix.T)
    growth = np.exp(np.minimum(left.ravel(), MAX_EXPONENT))
    multiplier = math.exp(exponent)

    def cross_with_change(k: int, state: Array, v: Array) -> float:
        """Cross F with the change of x2 that the change v of p makes."""
        p, h = state[:2], float(state[2])
        return float(_cross(F[k], (v + p * (p @ v) / (h * h)) / h))

    begin, end = start[0], way.end
    chi, r = 1.0 / (1.0 + math.exp(-xi)), ray.reach / (1.0 + math.exp(-xi))
    last = float((end[:2] - ray.critical.p) @ ray.u)
    rest = float(end[2]) ** 2 / (last + ray.other)
    across = cross_with_change(-1, end, ray.u)
    if not (last > 0.0 and rest > 0.0 and across != 0.0):
        return None
    steep = 1.0 / last + 1.0 / rest
    by_r = multiplier * cross_with_change(-2, begin, ray.u) / across
    by_values = []
    for varied in differences:
        melnikov = float(way.weight @ (growth * _cross(sign * F[:-2], _change(way.inner, varied) / ray.rate)))
        came = multiplier * cross_with_change(-2, begin, varied.moved + chi * varied.widened * ray.u) + melnikov
        by_values.append(steep * (came - cross_with_change(-1, end, varied.moved)) / across - varied.widened / rest)
    found = ReturnMapPoint(
        xi=xi, value=value, shift=math.log(last / rest) - xi,
        by_xi=steep * by_r * r * (1.0 - chi) - 1.0, by_value=by_values[0] if by_values else math.nan,
        exponent=sign * exponent, period=float(way.weight.sum()) / ray.rate,
        amplitude=_farthest(way.inner[:, :2], centre.p), height=float(way.inner[:, 2].min()),
        rate=chi * (1.0 - chi), chi=chi, p=(float(begin[0]), float(begin[1])),
    )  # fmt: skip
    return TurnOrbit(found, way.inner, tuple(by_values), left.ravel())


def _cross(v: Array, w: Array) -> Array:
    return v[..., 0] * w[..., 1] - v[..., 1] * w[..., 0]


def _regularised_direction(psi: Psi, states: Array) -> tuple[Array, Array]:
    """Compute e_Psi (n, 2) and its derivative by x2 (n, 2, 2) at states (n, 3)."""
    x2 = states[:, :2] / states[:, 2:]
    zeta = np.hypot(x2[:, 0], x2[:, 1])
    unit = x2 / np.maximum(zeta, 1e-300)[:, None]
    radial, tangential = psi.jacobian_factors(zeta)
    along = unit[:, :, None] * unit[:, None, :]
    return unit * psi.modulus(zeta)[:, None], (
        tangential[:, None, None] * np.eye(2) + (radial - tangential)[:, None, None] * along
    )


def _change(states: Array, varied: FiniteDifference) -> Array:
    """Differentiate U(e_Psi(x2)) (n, 2) by the parameter at fixed x2."""
    x2 = states[:, :2] / states[:, 2:]
    zeta = np.hypot(x2[:, 0], x2[:, 1])
    unit = x2 / np.maximum(zeta, 1e-300)[:, None]
    ends = (varied.low, varied.high)
    low, high = (one.at.U(unit * one.psi.modulus(zeta)[:, None]) for one in ends)
    return (high - low) / varied.width


def _farthest(points: Array, centre: Array) -> float:
    """Return the largest distance of points of a closed curve from a point, by a parabola about it."""
    away = np.hypot(*(points - centre).T)
    i = int(away.argmax())
    before, top, after = away[i - 1], away[i], away[(i + 1) % len(away)]
    bend = before - 2.0 * top + after
    return float(top if bend >= 0.0 else top - (after - before) ** 2 / (8.0 * bend))


class VariedRay:
    """A ray from a foot in a fixed direction, at each value of the parameter."""

    def __init__(
        self,
        problem: Callable[[float], LayerProblem],
        scale: float,
        bounds: tuple[float, float],
        foot: SectionBase,
        centre: SectionBase,
        u: Array,
    ) -> None:
        self.problem, self.scale, self.bounds, self.foot, self.centre, self.u = problem, scale, bounds, foot, centre, u

    def course(self, xi: float, value: float, backward: bool) -> TurnOrbit | None:
        """Follow one turn; None if it does not return, or the value is not allowed."""
        low, high = self.bounds
        if not (math.isfinite(xi) and low <= value <= high):
            return None
        before, after = max(value - DIFFERENCE_STEP * self.scale, low), min(value + DIFFERENCE_STEP * self.scale, high)
        try:
            ends = self.problem(before), self.problem(after)
            ray, centre = Ray(self.problem(value), self.foot.place(value), self.u), self.centre.place(value)
            feet = self.foot.moved(value, (before, after))
            with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
                return turn(ray, xi, value, [difference(ends, feet, after - before, self.u)], centre, backward)
        except ValueError:  # beyond the span, where the system ends
            return None


def difference(
    ends: tuple[LayerProblem, LayerProblem], feet: tuple[HemispherePoint, HemispherePoint], width: float, u: Array
) -> FiniteDifference:
    """Compare the problem, and the ray, at two values."""
    reaches = [room(foot, u)[0] for foot in feet]
    return FiniteDifference(*ends, width, (feet[1].p - feet[0].p) / width, (reaches[1] - reaches[0]) / width)
