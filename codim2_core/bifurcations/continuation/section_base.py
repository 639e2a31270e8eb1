"""A point inside cycles, for each value of the parameter: a critical set that is followed, or one that stays.

And the part of a span in which there may be cycles.
"""

from __future__ import annotations

import math
from bisect import bisect
from collections.abc import Callable, Sequence
from itertools import pairwise

import numpy as np

from ...numerics.curves.arclength import newton
from ...portrait.cycles.limit_cycles import excluding_theorem
from ...portrait.cycles.ray_section import HemispherePoint
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
