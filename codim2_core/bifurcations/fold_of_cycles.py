"""Folds of limit cycles over e = -A^-1 f: where the return map has a double fixed point.

A place is v = (x, e), x one on the section's ray, where x and its xi are zero together. A fold closes, and its exponent
is zero. In e everything is of size 1, however narrow the ellipse |A^-1 f| = 1 is.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from ..continuation.turn_columns import BY_XI, EXPONENT, PARAMETERS, SHIFT
from ..continuation.turns import integrate_turns
from ..curves.arclength import CurveEdge, StepBounds, TracedLine, point_across, trace_curve, zero_between
from ..curves.newton import newton
from ..cycles.global_section import Section
from ..cycles.section_batch.sections import Sections
from .curve import Array

LOG_SIZE_SCALE = 20.0  # d xi/d x within: what is seen of a fold is not wider in x than in e
STEP_BOUNDS = StepBounds(0.08, 0.4, 120, close=1e-9, enough=1e-7, least=3e-5)
MIN_LOG_SIZE, MAX_LOG_SIZE = math.log(6e-3) / LOG_SIZE_SCALE, 1.2  # x at which cycles have come to C, to the equator,
MAX_ZETA = 100.0  # where zeta is this
CORNER_DISTANCE = 3e-3  # in e: a curve need not be followed closer to a corner
DIFFERENCE_STEPS = np.diag(
    [1e-5, 1e-8, 1e-8]
)  # for derivatives of the exponent: it may change within a small part of e
MIN_EXPONENT_CHANGE = 1e-9  # a difference of exponents that may be rounding's
MAX_SEED_ERROR = 0.3  # in (x, e), that a start may be off
CUSP_TOLERANCE = 1e-7  # of a step: to which a cusp is found, and the square of it in e
MAX_XI = 690.0


class FoldEquations:
    """Turns on one ray for one a, b, d and Psi, at all f.

    Parameters
    ----------
    section : Section
        At one f: that at another is on the ray of the same signs.
    """

    def __init__(self, section: Section) -> None:
        self.section, self.A = section, section.matrix
        outer = min(float(section.xi_at_radius(np.array([MAX_ZETA]))[0]), MAX_XI)
        self.widening = max(outer - LOG_SIZE_SCALE * MAX_LOG_SIZE, 0.0) / MAX_LOG_SIZE**2

    def x(self, xi: float) -> float:
        """Return x of a place on the ray."""
        w = 4.0 * self.widening * max(xi, 0.0) / LOG_SIZE_SCALE**2
        return 2.0 * xi / (LOG_SIZE_SCALE * (1.0 + math.sqrt(1.0 + w)))

    def turns(self, places: Array) -> Array:
        """Measure turns from places (k, 3), in `continuation.turn_columns`; NaN where one does not return."""
        out = np.full((len(places), PARAMETERS + 4), math.nan)
        xi = (LOG_SIZE_SCALE + self.widening * np.maximum(places[:, 0], 0.0)) * places[:, 0]
        complement = 1.0 - (places[:, 1:] ** 2).sum(axis=1)
        there = np.flatnonzero((complement > 0.0) & (np.abs(xi) < MAX_XI))
        if len(there):
            e, n = places[there, 1:], len(there)
            planes = np.column_stack([np.tile(self.section.plane[:3], (n, 1)), -e @ self.A.T])
            changes = np.zeros((2, n, 5))
            changes[:, :, 3:] = -self.A.T[:, None]
            sections = Sections(planes, e, complement[there], self.section.psi, None, np.full(n, self.section.ray))
            found = integrate_turns(sections, xi[there], np.zeros(n, bool), changes)
            out[there[found.rows]] = found.numbers
        return out

    def condition(self, v: Array) -> tuple[Array, Array]:
        """Return shift and exponent, both zero on a fold, with derivatives that tell the way."""
        numbers = self.turns(v + np.vstack([np.zeros(3), DIFFERENCE_STEPS]))
        here, exponent = numbers[0], numbers[:, EXPONENT]
        by_x = (LOG_SIZE_SCALE + 2.0 * self.widening * max(v[0], 0.0)) * here[BY_XI]
        by_v = np.concatenate([[by_x], here[PARAMETERS : PARAMETERS + 2]])
        return here[[SHIFT, EXPONENT]], np.stack([by_v, (exponent[1:] - exponent[0]) / np.diag(DIFFERENCE_STEPS)])

    def bends(self, places: Array) -> Array:
        """Second derivatives of the return map, up to a factor: zero at a cusp, where three cycles are one."""
        beside = np.concatenate([places + DIFFERENCE_STEPS[0], places - DIFFERENCE_STEPS[0]])
        after, before = self.turns(beside)[:, EXPONENT].reshape(2, -1)
        return after - before

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
        bends = self.bends(points)
        sure = np.flatnonzero(np.abs(bends) > MIN_EXPONENT_CHANGE)
        rows, signs, steps, found = sure.tolist(), bends[sure] < 0.0, np.diff(points[sure, 1:], axis=0), []
        for k, (i, j) in enumerate(pairwise(rows)):
            part = [(points[i], signs[k]), (points[j], signs[k + 1])]
            if 0 < k < len(steps) - 1 and max(steps[k] @ steps[k - 1], steps[k] @ steps[k + 1]) < 0.0:
                middle = newton(self.condition, 0.5 * (points[i] + points[j]), MAX_SEED_ERROR)
                part[1:1] = [] if middle is None else [(middle, self._bend(middle) < 0.0)]
            for (here, before), (there, after) in pairwise(part):
                if before != after:
                    found.append((i, zero_between(self.condition, self._bend, here, there, CUSP_TOLERANCE)))
        return found

    def _bend(self, v: Array) -> float:
        return float(self.bends(v[None])[0])


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
