"""One fold of limit cycles, and the curve through it: where the return map has a double fixed point.

With the place xi on the section as a third unknown, the curve solves ``shift = 0, exponent = 0`` (`continuation.turn`).
It is followed by pseudo-arclength in (chi, A^-1 f), which is of size 1 however narrow the ellipse |A^-1 f| = 1 is.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from ..continuation.turn import Turn, VariedSystem
from ..cycles.section import Section
from ..layer_problem.critical import critical_sets
from ..psi.function import Psi
from ..systems.coefficients import Coefficients
from .curve import Array
from .equator import coefficients_at

X, Y = np.eye(2)
STEP, SHORTEST = 0.04, 1e-4
MOST, MOST_TURNS = 400, 4000
ROUNDS = 8
CLOSE = 1e-9
DIFFERENCE = 1e-5  # for derivatives of the exponent
SMALL, LOW = 3e-3, 1e-4  # amplitude, ebar: the cycle has come to C, to the equator
OUTWARD = np.array([1.0, 0.0, 0.0])
CUSP_ROUNDS = 24


@dataclass(frozen=True)
class Fold:
    """A fold, or a cusp: place on the section, e = -A^-1 f, its turn, and the Jacobian (2, 3) by (chi, e)."""

    xi: float
    e: Array
    turn: Turn
    jacobian: Array
    cusp: bool = False

    @property
    def bend(self) -> float:
        """Second derivative of the return map, up to a factor: zero at a cusp, where three cycles are one."""
        return float(self.jacobian[1, 0])


class Folds:
    """Folds for one a, b, d and Psi."""

    def __init__(self, a: float, b: float, d: float, psi: Psi) -> None:
        self.a, self.b, self.d, self.psi = a, b, d, psi
        self.A = np.array([[a, -b], [b, d]])
        self.ray: int | None = None
        self.turns = 0

    def settle(self, e: Array) -> None:
        """Choose the ray of the section for a curve that begins at e."""
        coefficients = coefficients_at(self.a, self.b, self.d, -self.A @ e)
        self.ray = Section(coefficients, self.psi, critical_sets(coefficients, self.psi)[0]).ray

    def placed(self, turn: Turn, unit: Array) -> Fold | None:
        """Put a fold found on a line along `unit` on this section, which may be on another ray."""
        e = turn.value * unit
        coefficients = coefficients_at(self.a, self.b, self.d, -self.A @ e)
        section = Section(coefficients, self.psi, critical_sets(coefficients, self.psi)[0], self.ray)
        start = np.array([[*turn.p, math.sqrt(max(1.0 - turn.p[0] ** 2 - turn.p[1] ** 2, 0.0))]])
        ends, _, codes, _ = section.turn(start, 1e-12, elsewhere=True)
        if codes[0] != 0:
            return None
        x2 = ends[0, :2] / ends[0, 2]
        zeta = float(np.hypot(*x2))
        away = float(np.hypot(*(x2 / zeta * self.psi.modulus(zeta) - section.e)))
        xi = math.log(away / max(section.reach - away, 1e-300))
        return self.corrected(xi, e, OUTWARD)

    def turn(self, xi: float, e: Array, axis: int = 0) -> Turn | None:
        """Follow one turn; its derivative by the parameter is that by e[axis]."""
        unit = (X, Y)[axis]

        def at(value: float) -> tuple[Coefficients, Psi]:
            return coefficients_at(self.a, self.b, self.d, -self.A @ (e + value * unit)), self.psi

        family = VariedSystem(at, 1.0)
        family.ray = self.ray
        self.turns += 1
        return family.turn(xi, 0.0) if -700.0 < xi < 690.0 else None

    def state(self, xi: float, e: Array) -> Fold | None:
        """Evaluate with all derivatives: those of the exponent by differences."""
        turns = [self.turn(xi, e, axis) for axis in (0, 1)]
        h = DIFFERENCE
        moved = [self.turn(xi + h, e), self.turn(xi, e + h * X), self.turn(xi, e + h * Y)]
        if any(t is None for t in turns + moved):
            return None
        one, two = turns
        assert one is not None
        assert two is not None
        rise = np.array([(t.exponent - one.exponent) / h for t in moved if t is not None])
        jacobian = np.array([[one.by_xi, one.by_value, two.by_value], rise])
        jacobian[:, 0] /= one.rate
        return Fold(xi, e, one, jacobian)

    def corrected(self, xi: float, e: Array, row: Array) -> Fold | None:
        """Newton's method with the Jacobian of the first place on the plane through it across `row` (3,)."""
        state = self.state(xi, e)
        if state is None:
            return None
        matrix3 = np.vstack([state.jacobian, row])
        if abs(np.linalg.det(matrix3)) < 1e-12:
            return None
        turn, last = state.turn, math.inf
        for _ in range(ROUNDS):
            change = -np.linalg.solve(matrix3, [turn.shift, turn.exponent, 0.0])
            size = float(np.abs(change).max())
            if size > 2.0 * last or size > 0.3:
                return None
            xi, e = xi + change[0] / turn.rate, e + change[1:]
            if size < CLOSE:
                return Fold(xi, e, turn, state.jacobian)
            after = self.turn(xi, e)
            if after is None:
                return None
            turn, last = after, size
        return None

    def followed(self, start: Fold, tangent: Array) -> tuple[list[Fold], str]:
        """Follow the curve from a fold along a tangent (3,) until it ends; how it ends."""
        states, step = [start], 0.25 * STEP
        while len(states) < MOST and self.turns < MOST_TURNS:
            here = states[-1]
            reach = min(STEP, 0.5 * min(here.turn.chi, 1.0 - here.turn.chi) / max(abs(tangent[0]), 1e-9))
            step = min(step, max(reach, 1e-3 * STEP))
            found = self.corrected(here.xi + step * tangent[0] / here.turn.rate, here.e + step * tangent[1:], tangent)
            turned = tangent if found is None else null_vector(found.jacobian, tangent)
            if found is None or float(turned @ tangent) < 0.9:
                step *= 0.4
                if step < SHORTEST * min(1.0, reach / STEP):
                    return states, "stuck"
                continue
            states.append(found)
            tangent = turned
            if found.turn.amplitude < SMALL and tangent[0] < 0.0:
                return states, "C"
            if found.turn.height < LOW and found.turn.height < here.turn.height:
                return states, "equator"
            if len(states) > 8 and self._near(found, start) < 0.7 * step:
                return states, "closed"
            step *= 1.5
        return states, "stuck"

    def with_cusps(self, states: list[Fold]) -> list[Fold]:
        """Put in the cusps of a curve: where the second derivative of the return map changes its sign along it."""
        out = states[:1]
        for here, there in pairwise(states):
            found = self._cusp(here, there) if (here.bend < 0.0) != (there.bend < 0.0) else None
            out += [there] if found is None else [found, there]
        return out

    def _cusp(self, here: Fold, there: Fold) -> Fold | None:
        """Find the cusp between two folds: the secant rule along chi, in which the curve is smooth there."""
        low, high = here, there
        best: Fold | None = None
        for _ in range(CUSP_ROUNDS):
            rise = there.turn.chi - here.turn.chi
            if rise == 0.0 or low.bend == high.bend:
                return None
            part = min(max(low.bend / (low.bend - high.bend), 0.02), 0.98)
            xi, e = low.xi + part * (high.xi - low.xi), low.e + part * (high.e - low.e)
            found = self.corrected(xi, e, OUTWARD)
            exact = None if found is None else self.state(found.xi, found.e)
            if exact is None:
                return best
            best = replace(exact, cusp=True)
            if abs(best.bend) < 1e-7 * (abs(here.bend) + abs(there.bend)) or abs(high.xi - low.xi) < 1e-9:
                break
            low, high = (best, high) if (best.bend < 0.0) == (low.bend < 0.0) else (low, best)
        return best

    @staticmethod
    def _near(one: Fold, two: Fold) -> float:
        return math.hypot(one.turn.chi - two.turn.chi, *(one.e - two.e))


def null_vector(jacobian: Array, towards: Array) -> Array:
    """Find the unit vector (3,) that a Jacobian (2, 3) takes to zero, at an acute angle to `towards`."""
    v = np.cross(jacobian[0], jacobian[1])
    v = v / np.linalg.norm(v)
    return v if float(v @ towards) > 0.0 else -v
