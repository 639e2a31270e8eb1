"""Sliding in the limit eps -> 0: the slow flow on a critical set that is followed in z, and where that ends.

On ``U((c, s), 0, 0, z) = 0``, ``z' = W((c, s), 0, 0, z)``, eq:linslowflow. The set is continued by Newton's method,
with its exact derivative ``D_z e = -(D_e U)^-1 D_z U``.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial

import numpy as np
from numpy.typing import NDArray

from ..initial_value.events import DEGREES, turns
from ..initial_value.field import Field
from ..initial_value.line import Line
from ..initial_value.problem import growth_bound
from ..numerics.growth import bounded
from ..numerics.radau import STAGES, Problem, Step, StepsTooShortError, TooManyStepsError, steps
from ..psi.function import Psi
from .followed import solved

Array = NDArray[np.float64]

NEWTON = 20
SHORTEST = 1e-14  # of the time span: steps that short mean that the set ends here
AT_EQUATOR = 1e-5  # 1 - |e|^2 at which an end is taken for the equator
AT_FOLD = 1e-3  # |det D_e U|, in units of its entries squared, at which it is taken for a fold
INSIDE = (4, *DEGREES)  # of the polynomials that a gauge is taken for along a step: most are far from zero
NEAR_HOPF = 1e-2  # |tr J| in units of D_e U, below which a stable cycle may be too small to be found


class Sheet:
    """A critical set as a function of z, continued from the last state that was accepted.

    Parameters
    ----------
    field : Field
    e : ndarray (2,)
        On the set at z.
    z : ndarray (m,)
    """

    def __init__(self, field: Field, e: Array, z: Array) -> None:
        self.field = field
        self.e, self.z, self.slope = np.array(e, float), np.array(z, float), np.zeros((2, len(z)))
        self.move(z)

    def slopes(self, e: Array, z: Array) -> Array:
        """``D (U, W)`` by (c, s, x, y, z) on the set."""
        return self.field.jacobian(float(e[0]), float(e[1]), 0.0, 0.0, z.tolist())

    def at(self, z: Array) -> Array | None:
        """Return e at z, or None where the set is not found."""
        return solved(self.field, self.e + self.slope @ (z - self.z), z, far=1.0, most=NEWTON)

    def move(self, z: Array) -> None:
        """Continue from z from now on."""
        e = self.at(z)
        if e is not None:
            D = self.slopes(e, z)
            self.e, self.z = e, np.array(z)
            self.slope = -np.linalg.solve(D[:2, :2], D[:2, 4:])

    def problem(self, floor: float) -> Problem:
        """Return the slow flow as an initial value problem in z; errors are measured by |z| + floor."""

        def F(z: Array) -> Array:
            e = self.at(z)
            if e is None:
                return np.full(len(z), math.nan)
            return np.array(self.field.value(float(e[0]), float(e[1]), 0.0, 0.0, *z.tolist())[2:])

        def J(z: Array) -> Array:
            self.move(z)
            D = self.slopes(self.e, self.z)
            return D[2:, 4:] + D[2:, :2] @ self.slope

        def limit(z: Array, rate: Array, jacobian: Array) -> float:  # noqa: ARG001 (the form of Problem.limit)
            return growth_bound(jacobian)

        return Problem(F, J, lambda z: np.abs(z) + floor, limit)


def complement(e: Array) -> float:
    """``1 - |e|^2``."""
    r = math.hypot(e[0], e[1])
    return (1.0 - r) * (1.0 + r)


def determinant(sheet: Sheet, e: Array, z: Array) -> float:
    """Det of D_e U: the sign of det J."""
    return float(np.linalg.det(sheet.slopes(e, z)[:2, :2]))


def trace(sheet: Sheet, psi: Psi, e: Array, z: Array) -> float:
    """Tr J in units of the tangential eigenvalue of D e_Psi, which is positive: it has the sign of tr J."""
    D = sheet.slopes(e, z)[:2, :2]
    r, gap = math.hypot(e[0], e[1]), complement(e)
    if r == 0.0 or gap <= 0.0:  # the two eigenvalues of D e_Psi are equal in the centre; radial/tangential is 0 outside
        ratio, n = (1.0 if r == 0.0 else 0.0), e / (r or 1.0)
    else:
        radial, tangential = psi.jacobian_factors(psi.radius(min(r, 1.0), gap))
        ratio, n = radial / tangential, e / r
    return float(np.trace(D) + (ratio - 1.0) * (n @ D @ n))


@dataclass(frozen=True)
class Slide:
    """A slide.

    Attributes
    ----------
    taken : list of Step
        Of the whole state, with x = y = 0.
    end : str
        "time", "equator", "fold", "hopf", "cycle" (the limit cycle it slides on is there no longer), or "given up".
    e : ndarray (2,)
        Critical set at the end.
    places : list of ndarray (2,)
        The critical set at the beginning, and at the end of each step.
    stopped : TooManyStepsError or None
        Why it was given up; also where W is undefined from some z on.
    """

    taken: list[Step]
    end: str
    e: Array
    places: list[Array]
    stopped: TooManyStepsError | None = None


def slide(
    field: Field,
    psi: Psi,
    e: Array,
    t: float,
    z: Array,
    t_end: float,
    *,
    rtol: float,
    atol: float,
    most: int,
    lives: Callable[[Array], bool] | None = None,
    line: Line | None = None,
) -> Slide:
    """Follow the slow flow until the critical set reaches the equator, folds, or changes stability.

    Parameters
    ----------
    field : Field
    psi : Psi
    e : ndarray (2,)
        Critical set at z.
    t, t_end : float
    z : ndarray (m,)
    rtol, atol : float
    most : int
        Steps.
    lives : callable, optional
        For sliding on a limit cycle: whether it is still there at z.
    line : Line, optional
        The invariant line that the motion stays in, stable across it or not.
    """
    if not len(z):
        return Slide([Step(t, t_end - t, np.zeros(2), np.zeros(2), np.zeros((2, STAGES)))], "time", e, [e, e])
    sheet = Sheet(field, e, z)
    gauges = _gauges(sheet, psi, on_cycle=lives is not None, line=line)

    def alive(z: Array) -> bool:
        if lives is None or lives(z):
            return True
        e = sheet.at(z)
        return e is not None and abs(trace(sheet, psi, e, z)) < NEAR_HOPF * float(
            np.abs(sheet.slopes(e, z)[:2, :2]).max()
        )

    problem = sheet.problem(atol / rtol)
    rate = problem.F(z)
    h = 1e-2 / float(np.max(np.abs(rate) / problem.scale(z))) if rate.any() else math.inf
    taken: list[Step] = []
    places = [sheet.e]
    before = {name: gauge(sheet.e, z) for name, gauge in gauges.items()}
    span = t_end - t
    try:
        for step in bounded(problem, steps(problem, t, t_end, z, rtol, h, most, SHORTEST * span), SHORTEST * span):
            after = sheet.at(step.last)
            if after is None:
                raise StepsTooShortError
            found: list[tuple[float, str]] = []
            place = cache(partial(_place, sheet, step))
            for name, gauge in gauges.items():
                start, before[name] = before[name], gauge(after, step.last)
                u = _first(gauge, place, start, before[name])
                if u is not None:
                    found.append((u, name))
            if not alive(step.last):
                found.append((_last_alive(alive, step), "cycle"))
            if found:
                u, name = min(found)
                last = step.at(u)
                taken.append(_whole(step, u))
                end = sheet.at(last)
                places.append(after if end is None else end)
                return Slide(taken, name, places[-1], places)
            taken.append(_whole(step, 1.0))
            places.append(after)
    except StepsTooShortError as error:
        end = _end(sheet)
        return Slide(taken, end, sheet.e, places, error if end == "given up" else None)
    except TooManyStepsError as error:
        return Slide(taken, "given up", sheet.e, places, error)
    return Slide(taken, "time", sheet.e, places)


def _gauges(sheet: Sheet, psi: Psi, on_cycle: bool, line: Line | None) -> dict[str, Callable[[Array, Array], float]]:
    """Return what turns negative, as functions of e and z, where the sliding ends, by the name of the end."""
    found: dict[str, Callable[[Array, Array], float]] = {
        "equator": lambda e, z: complement(e),  # noqa: ARG005 (all gauges are called alike)
    }
    if line is not None:
        n = line.n
        return {**found, "fold": lambda e, z: -float(n @ sheet.slopes(e, z)[:2, :2] @ n)}
    sign = math.copysign(1.0, determinant(sheet, sheet.e, sheet.z))
    turn = -1.0 if on_cycle else 1.0  # around a stable cycle C is unstable: tr J > 0
    return {
        **found,
        "fold": lambda e, z: sign * determinant(sheet, e, z),
        "hopf": lambda e, z: -turn * trace(sheet, psi, e, z),
    }


def _end(sheet: Sheet) -> str:
    """Say what ends the set where steps become too short to go on."""
    if complement(sheet.e) < AT_EQUATOR:
        return "equator"
    size = float(np.abs(sheet.slopes(sheet.e, sheet.z)[:2, :2]).max())
    return "fold" if abs(determinant(sheet, sheet.e, sheet.z)) < AT_FOLD * size**2 else "given up"


def _place(sheet: Sheet, step: Step, u: float) -> tuple[Array | None, Array]:
    """Return the critical set, None where there is none, and z at a fraction of a step."""
    z = step.at(u)
    return sheet.at(z), z


def _first(
    gauge: Callable[[Array, Array], float],
    place: Callable[[float], tuple[Array | None, Array]],
    start: float,
    end: float,
) -> float | None:
    """Fraction of a step at which a gauge first turns negative, whatever it is at its end; None if it does not."""

    def value(u: float, missing: float = math.nan) -> float:
        e, z = place(u)
        return missing if e is None else gauge(e, z)

    positive = None
    for u, at in zip(*turns(value, start, end, INSIDE), strict=True):
        if at > 0.0:
            positive = u
        elif at < 0.0 and positive is not None:
            from scipy.optimize import root_scalar  # imported late: it takes longer than all of this package

            return float(root_scalar(value, args=(-1.0,), bracket=(positive, u), xtol=1e-15).root)
    return 0.0 if start <= 0.0 and end < 0.0 else None  # began on the border itself, and stays outside


def _last_alive(alive: Callable[[Array], bool], step: Step) -> float:
    low, high = 0.0, 1.0
    for _ in range(20):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if alive(step.at(middle)) else (low, middle)
    return low


def _whole(step: Step, u: float) -> Step:
    """Return the part of a step in z up to its fraction u, as a step of the whole state on Sigma."""
    polynomial = np.zeros((2 + len(step.first), STAGES))
    polynomial[2:] = step.polynomial * u ** np.arange(1, STAGES + 1)
    last = step.last if u == 1.0 else step.at(u)
    still = np.zeros(2)
    first, last = np.concatenate([still, step.first]), np.concatenate([still, last])
    return Step(step.start, u * step.h, first, last, polynomial)
