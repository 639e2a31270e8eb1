"""Turns about a point of the hemisphere over the plane of two parameters.

A place is v = (x, u, v): x the place on a ray from that point to the equator, ``ln(r/(reach - r))`` over
`LOG_SIZE_SCALE`, and both parameters in the unit square. A cycle closes where `shift` is zero, and is a fold where
its exponent is, too.
"""

from __future__ import annotations

import math
from copy import copy

import numpy as np

from ....portrait.cycles.ray_section import HemispherePoint, Ray
from ....portrait.layer_problem.problem import LayerProblem
from ....results.arrays import Array
from ....systems.frozen import FrozenSystem
from ...continuation.section_base import correct_zero, hemisphere_place
from ...continuation.turns import FiniteDifference, TurnOrbit, difference, turn
from ...families.family import SystemFamily

LOG_SIZE_SCALE = 20.0  # of x: steps along curves are as long in it as in the unit square
PARAMETER_STEP = 1e-6  # of the square, and of the foot's distance from the equator, for derivatives of the shift
DIFFERENCE_STEPS = np.diag([1e-5, 1e-8, 1e-8])  # for those of the exponent: it may change within a small part of it
MAX_RAY_COORDINATE = 57.0  # |x|
MAX_CACHE_DISTANCE = 0.01  # of the square: so far from where it is known the critical set is kept


class EncirclingTurns:
    """Turns about a critical set that is followed over the plane, or about a point that stays."""

    def __init__(
        self,
        family: SystemFamily,
        place: Array,
        e: Array,
        u: Array,
        critical: bool = True,
        centre: EncirclingTurns | None = None,
    ) -> None:
        self.family, self.u, self.centre = family, u, centre
        self._known = [(np.array(place, float), np.array(e, float))]
        self._still = None if critical else hemisphere_place(family.psi_at(place), self._known[0][1])

    def towards(self, u: Array) -> EncirclingTurns:
        """Return the same in another direction."""
        turned = copy(self)
        turned.u = u
        return turned

    def ray(self, place: Array) -> Ray | None:
        """Return the ray at a place of the square; None where there is none."""
        try:
            at = self.family.frozen(place)
        except ValueError:  # beyond what is allowed
            return None
        psi = self.family.psi_at(place)
        foot = self._still or self._followed(at, place)
        return None if foot is None else Ray(LayerProblem(at, psi), foot, self.u)

    def _followed(self, at: FrozenSystem, place: Array) -> HemispherePoint | None:
        nearest = min(self._known, key=lambda one: math.dist(one[0], place))
        e = correct_zero(at, nearest[1])
        if e is None:
            return None
        if math.dist(nearest[0], place) > MAX_CACHE_DISTANCE:
            self._known.append((place.copy(), e))
        return hemisphere_place(self.family.psi_at(place), e)

    def turn(self, v: Array, slopes: bool = False) -> TurnOrbit | None:
        """Follow one turn, with derivatives of its shift by both parameters if asked; None if it does not return."""
        ray = self.ray(v[1:]) if abs(v[0]) < MAX_RAY_COORDINATE else None
        if ray is None:
            return None
        outer = None if self.centre is None else self.centre.ray(v[1:])
        middle = ray.critical if outer is None else outer.critical
        differences = self._differences(ray, v[1:]) if slopes else []
        if differences is None:
            return None
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            return turn(ray, LOG_SIZE_SCALE * float(v[0]), math.nan, differences, middle, False)

    def _differences(self, ray: Ray, place: Array) -> list[FiniteDifference] | None:
        """Compare the problem on both sides of a place, along each axis."""
        step = PARAMETER_STEP * (1.0 - float(ray.psi.modulus(math.hypot(*ray.critical.x2))))
        found = []
        for way in step * np.eye(2):
            low, high = self.ray(place - way), self.ray(place + way)
            if low is None or high is None:
                return None
            ends, feet = (low.problem, high.problem), (low.critical, high.critical)
            found.append(difference(ends, feet, 2.0 * step, self.u))
        return found

    def exponent(self, v: Array) -> float:
        """Return the exponent of a turn; NaN where it does not return."""
        found = self.turn(v)
        return math.nan if found is None else found.turn.exponent

    def fold(self, v: Array) -> tuple[Array, Array]:
        """Return shift and exponent, both zero on a fold, with derivatives that tell the way; NaN without a turn."""
        found = self.turn(v, slopes=True)
        if found is None:
            return np.full(2, math.nan), np.full((2, 3), math.nan)
        here = np.array([found.turn.shift, found.turn.exponent])
        by_v = [LOG_SIZE_SCALE * found.turn.by_xi, *found.by_values]
        rise = [(self.exponent(v + way) - here[1]) / way.sum() for way in DIFFERENCE_STEPS]
        return here, np.array([by_v, rise])

    def bend(self, v: Array) -> float:
        """Second derivative of the return map, up to a factor: zero at a cusp, where three cycles are one."""
        return self.exponent(v + DIFFERENCE_STEPS[0]) - self.exponent(v - DIFFERENCE_STEPS[0])
