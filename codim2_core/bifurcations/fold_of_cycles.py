"""Folds of limit cycles over e = -A^-1 f: where the return map has a double fixed point.

A place is v = (x, e), x one on a ray from C, its xi over `LOG_SIZE_SCALE`. A fold closes, and its exponent is zero.
In e everything is of size 1, however narrow the ellipse |A^-1 f| = 1 is.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from ..continuation.section_base import hemisphere_place
from ..continuation.turns import TurnOrbit, difference, turn
from ..curves.arclength import CurveEdge, StepBounds, TracedLine, point_across, trace_curve, zero_between
from ..curves.newton import newton
from ..cycles.ray import Ray
from ..layer_problem.problem import LayerProblem
from ..psi.function import Psi
from .curve import Array
from .equator import coefficients_at

LOG_SIZE_SCALE = 20.0  # xi of x: what is seen of a fold is not wider in x than in e
STEP_BOUNDS = StepBounds(0.08, 0.4, 120, close=1e-9, enough=1e-7, least=3e-5)
# x at which cycles have come to C, and to the equator
MIN_LOG_SIZE, MAX_LOG_SIZE = math.log(6e-3) / LOG_SIZE_SCALE, 9.0 / LOG_SIZE_SCALE
PARAMETER_STEP = 1e-6  # of the distance of e from the unit circle, for derivatives of the shift
CORNER_DISTANCE = 3e-3  # in e: a curve need not be followed closer to a corner
DIFFERENCE_STEPS = np.diag(
    [1e-5, 1e-8, 1e-8]
)  # for derivatives of the exponent: it may change within a small part of e
MIN_EXPONENT_CHANGE = 1e-9  # a difference of exponents that may be rounding's
MAX_SEED_ERROR = 0.3  # in (x, e), that a start may be off
CUSP_TOLERANCE = 1e-7  # of a step: to which a cusp is found, and the square of it in e
MAX_XI = 690.0


class FoldEquations:
    """Turns on one ray from C for one matrix and Psi, at all f.

    Parameters
    ----------
    A : ndarray (2, 2)
        In the normal form.
    psi : Psi
    u : ndarray (2,)
        Direction of the ray.
    """

    def __init__(self, A: Array, psi: Psi, u: Array) -> None:
        self.A, self.psi, self.u = A, psi, u

    def problem(self, e: Array) -> LayerProblem:
        """Return the layer problem whose critical set has (c, s) = e."""
        (a, _), (b, d) = self.A.tolist()
        return LayerProblem(coefficients_at(a, b, d, -self.A @ e), self.psi)

    def turn(self, v: Array) -> TurnOrbit | None:
        """Follow the turn from a place (3,); None where it does not return."""
        xi, e = LOG_SIZE_SCALE * float(v[0]), v[1:]
        if not (e @ e < 1.0 and abs(xi) < MAX_XI):
            return None
        foot, beside = hemisphere_place(self.psi, e), []
        h = PARAMETER_STEP * (1.0 - math.hypot(*e))
        for way in h * np.eye(2):
            ends = self.problem(e - way), self.problem(e + way)
            feet = hemisphere_place(self.psi, e - way), hemisphere_place(self.psi, e + way)
            beside.append(difference(ends, feet, 2.0 * h, self.u))
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            return turn(Ray(self.problem(e), foot, self.u), xi, math.nan, beside, foot, backward=False)

    def exponent(self, v: Array) -> float:
        """Return the exponent of a turn; NaN where it does not return."""
        found = self.turn(v)
        return math.nan if found is None else found.turn.exponent

    def condition(self, v: Array) -> tuple[Array, Array]:
        """Return shift and exponent, both zero on a fold, with derivatives that tell the way."""
        found = self.turn(v)
        if found is None:
            return np.full(2, math.nan), np.full((2, 3), math.nan)
        here = np.array([found.turn.shift, found.turn.exponent])
        by_v = np.array([LOG_SIZE_SCALE * found.turn.by_xi, *found.by_values])
        rise = [(self.exponent(v + way) - here[1]) / way.sum() for way in DIFFERENCE_STEPS]
        return here, np.stack([by_v, np.array(rise)])

    def bend(self, v: Array) -> float:
        """Second derivative of the return map, up to a factor: zero at a cusp, where three cycles are one."""
        return self.exponent(v + DIFFERENCE_STEPS[0]) - self.exponent(v - DIFFERENCE_STEPS[0])

    def trace(self, start: Array, corners: Sequence[Array]) -> TracedLine | None:
        """Trace the curve through a fold beside a place (3,), up to corners (2,) in e; None if there is none."""
        first = point_across(
            self.condition, start, np.eye(3)[0], MAX_SEED_ERROR
        )  # with x both vanish all along Hopf curves
        return None if first is None else trace_curve(self.condition, first, _corner_edges(corners), STEP_BOUNDS)

    def cusps(self, points: Array) -> list[tuple[int, Array]]:
        """Find the cusps on a curve (m, 3): the point after which each comes, and its place.

        Where one step has passed two of them, it has led back in e.
        """
        bends = np.array([self.bend(v) for v in points])
        sure = np.flatnonzero(np.abs(bends) > MIN_EXPONENT_CHANGE)
        rows, signs, steps, found = sure.tolist(), bends[sure] < 0.0, np.diff(points[sure, 1:], axis=0), []
        for k, (i, j) in enumerate(pairwise(rows)):
            part = [(points[i], signs[k]), (points[j], signs[k + 1])]
            if 0 < k < len(steps) - 1 and max(steps[k] @ steps[k - 1], steps[k] @ steps[k + 1]) < 0.0:
                middle = newton(self.condition, 0.5 * (points[i] + points[j]), MAX_SEED_ERROR)
                part[1:1] = [] if middle is None else [(middle, self.bend(middle) < 0.0)]
            for (here, before), (there, after) in pairwise(part):
                if before != after:
                    found.append((i, zero_between(self.condition, self.bend, here, there, CUSP_TOLERANCE)))
        return found


def _corner_edges(corners: Sequence[Array]) -> list[CurveEdge]:
    unit = np.eye(3)

    def corner_distance(v: Array, corner: Array) -> tuple[float, Array]:
        away = v[1:] - corner
        gap = math.hypot(*away)
        return CORNER_DISTANCE - gap, np.array([0.0, *(-away / max(gap, 1e-300))])

    return [
        CurveEdge("C", lambda v: (MIN_LOG_SIZE - float(v[0]), -unit[0])),
        CurveEdge("equator", lambda v: (float(v[0]) - MAX_LOG_SIZE, unit[0])),
        *(CurveEdge("corner", lambda v, corner=corner: corner_distance(v, corner)) for corner in corners),
    ]
