"""Folds of limit cycles as curves in (f1, f2): where the return map has a double fixed point.

With the place xi on the section as a third unknown, the curve solves ``shift = 0, exponent = 0`` (`continuation.turn`).
It is followed by pseudo-arclength in (chi, A^-1 f), which is of size 1 however narrow the ellipse |A^-1 f| = 1 is.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np

from ..continuation.branches import folds_along
from ..continuation.turn import Family, Turn
from ..cycles.section import Section
from ..layer_problem.critical import critical_sets
from ..psi.function import Psi
from ..systems.coefficients import Coefficients
from .curve import Array, BifurcationCurve, SpecialPoint, frozen, matrix, place
from .equator import coefficients_at, heteroclinic
from .geometry import Geometry
from .trace import hopf

STEP, SHORTEST = 0.04, 1e-4
MOST = 400
ROUNDS = 8
CLOSE = 1e-9
DIFFERENCE = 1e-5  # for derivatives of the exponent
SMALL, LOW = 3e-3, 1e-4  # amplitude, ebar: the cycle has come to C, to the equator
SMALLER = 0.05  # amplitude below which a branch that breaks off beside a generalised Hopf point ends there
FIRST = 0.02  # chi of the first point beside a generalised Hopf point
NEAR = 0.03  # in A^-1 f: a branch that breaks off this close to a corner ends there
MOST_TURNS = 4000
X, Y = np.eye(2)
OUTWARD = np.array([1.0, 0.0, 0.0])
LINES = 6  # across the disc of critical sets, on which folds are looked for
TOUCHING = "The fold ends where the critical set reaches the equator in a saddle-node of limit directions."
CUSP = "Three limit cycles meet in one: two folds of cycles end here in a cusp."
CUSP_ROUNDS = 24
RESONANT = "The fold ends where the loop through the equator is neutral."


@dataclass(frozen=True)
class _State:
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


class _Folds:
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

    def placed(self, turn: Turn, unit: Array) -> _State | None:
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

        family = Family(at, 1.0)
        family.ray = self.ray
        self.turns += 1
        return family.turn(xi, 0.0) if -700.0 < xi < 690.0 else None

    def state(self, xi: float, e: Array) -> _State | None:
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
        return _State(xi, e, one, jacobian)

    def corrected(self, xi: float, e: Array, row: Array) -> _State | None:
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
                return _State(xi, e, turn, state.jacobian)
            after = self.turn(xi, e)
            if after is None:
                return None
            turn, last = after, size
        return None

    def followed(self, start: _State, tangent: Array) -> tuple[list[_State], str]:
        """Follow the curve from a fold along a tangent (3,) until it ends; how it ends."""
        states, step = [start], 0.25 * STEP
        while len(states) < MOST and self.turns < MOST_TURNS:
            here = states[-1]
            reach = min(STEP, 0.5 * min(here.turn.chi, 1.0 - here.turn.chi) / max(abs(tangent[0]), 1e-9))
            step = min(step, max(reach, 1e-3 * STEP))
            found = self.corrected(here.xi + step * tangent[0] / here.turn.rate, here.e + step * tangent[1:], tangent)
            turned = tangent if found is None else _null(found.jacobian, tangent)
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

    def with_cusps(self, states: list[_State]) -> list[_State]:
        """Put in the cusps of a curve: where the second derivative of the return map changes its sign along it."""
        out = states[:1]
        for here, there in pairwise(states):
            found = self._cusp(here, there) if (here.bend < 0.0) != (there.bend < 0.0) else None
            out += [there] if found is None else [found, there]
        return out

    def _cusp(self, here: _State, there: _State) -> _State | None:
        """Find the cusp between two folds: the secant rule along chi, in which the curve is smooth there."""
        low, high = here, there
        best: _State | None = None
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
    def _near(one: _State, two: _State) -> float:
        return math.hypot(one.turn.chi - two.turn.chi, *(one.e - two.e))


def _null(jacobian: Array, towards: Array) -> Array:
    """Find the unit vector (3,) that a Jacobian (2, 3) takes to zero, at an acute angle to `towards`."""
    v = np.cross(jacobian[0], jacobian[1])
    v = v / np.linalg.norm(v)
    return v if float(v @ towards) > 0.0 else -v


def cycle_folds(a: float, b: float, d: float, psi: Psi) -> BifurcationCurve:
    """Folds of limit cycles in (f1, f2): a stable and an unstable cycle meet and vanish (sec:case3).

    Curves are begun at the generalised Hopf points of `hopf`, and at the folds found on some lines across the disc of
    critical sets; each is followed to both ends.

    Parameters
    ----------
    a, b, d : float
    psi : Psi

    Returns
    -------
    BifurcationCurve
        kind "fold of cycles". `values` holds the cycle's amplitude, the largest distance from C in the projected disc.
        `special` names the points where it turns back, "cusp of cycles", and how a branch ends other than at a
        generalised Hopf point: "resonant loop", "touching", "equator" or "undecided". Empty, with the
        reason in `sentence`, where none was found.

    Raises
    ------
    ValueError
        A coefficient is not a finite number, or psi is not a Psi.
    """
    a, b, d = matrix(a, b, d)
    label = "sec:case3"
    curve = hopf(a, b, d, psi)
    if not curve.branches:
        return BifurcationCurve("fold of cycles", "folds of cycles: none", label, (), sentence=curve.sentence)
    points = [np.array(s.place) for s in curve.special if s.type == "generalised Hopf"]
    found = _Curves(a, b, d, psi, points)
    for f in points:
        found.from_hopf(f)
    found.from_lines()
    name = "folds of cycles" if found.branches else "folds of cycles: none"
    sentence = (
        "Two limit cycles, one stable and one unstable, meet and vanish."
        if found.branches
        else f"No fold of cycles begins on the Hopf curve, and none was found on {LINES} lines across the disc of C."
    )
    return BifurcationCurve(
        "fold of cycles", name, label, frozen(found.branches), tuple(found.special), frozen(found.sizes), sentence
    )


class _Curves:
    """Curves found so far, with their mirror images at -f."""

    def __init__(self, a: float, b: float, d: float, psi: Psi, points: list[Array]) -> None:
        self.plane, self.psi, self.points = (a, b, d), psi, points
        self.A = np.array([[a, -b], [b, d]])
        self.branches: list[Array] = []
        self.sizes: list[Array] = []
        self.special: list[SpecialPoint] = []
        self.used: list[Array] = []

    @cached_property
    def touching(self) -> list[float]:
        """Angles where the saddle-node curve touches the ellipse."""
        return Geometry(*self.plane).touching

    @cached_property
    def resonant(self) -> tuple[SpecialPoint, ...]:
        """Find the neutral loops through the equator."""
        return heteroclinic(*self.plane, self.psi).special

    def near(self, f: Array, g: Array) -> float:
        """Distance in A^-1 f."""
        return float(np.hypot(*np.linalg.solve(self.A, f - g)))

    def from_hopf(self, f: Array) -> None:
        """Begin beside a generalised Hopf point, at a given place on the section."""
        if any(self.near(f, g) < 1e-6 for g in self.used):
            return
        self.used += [f, -f]
        folds = _Folds(*self.plane, self.psi)
        e = np.asarray(-np.linalg.solve(self.A, f), float)
        folds.settle(e)
        for first in (FIRST, 0.3 * FIRST, 3.0 * FIRST):
            found = folds.corrected(math.log(first), e, OUTWARD)
            if found is not None:
                states, how = folds.followed(found, _null(found.jacobian, OUTWARD))
                tail, special = self._end(states, how)
                states = folds.with_cusps(states)
                self._add([(f, 0.0), *self._rows(states), *tail], special + self._cusps(states))
                return
        text = "The fold that begins here was not caught."
        self.special += [SpecialPoint("undecided", place(sign * f), text) for sign in (1.0, -1.0)]

    def from_lines(self) -> None:
        """Begin at the folds on some lines across the disc that no curve has passed."""
        for k in range(LINES):
            angle = math.pi * (k + 0.5) / LINES
            unit = np.array([math.cos(angle), math.sin(angle)])

            def at(t: float, unit: Array = unit) -> tuple[Coefficients, Psi]:
                return coefficients_at(*self.plane, -self.A @ (t * unit)), self.psi

            for turn in folds_along(at, 0.01, 0.995):
                if self._passed(-self.A @ (turn.value * unit), turn.amplitude):
                    continue
                folds = _Folds(*self.plane, self.psi)
                folds.settle(turn.value * unit)
                ready = folds.placed(turn, unit)
                if ready is None:
                    continue
                tangent = _null(ready.jacobian, OUTWARD)
                states, how = folds.followed(ready, tangent)
                tail, special = self._end(states, how)
                states = folds.with_cusps(states)
                special += self._cusps(states)
                if how == "closed":
                    self._add([*self._rows(states), self._rows(states)[0]], special)
                    continue
                back, how = folds.followed(ready, -tangent)
                head, more = self._end(back, how)
                back = folds.with_cusps(back)
                special += more + self._cusps(back)
                self._add([*head[::-1], *self._rows(back)[:0:-1], *self._rows(states), *tail], special)

    def _passed(self, f: Array, amplitude: float) -> bool:
        """Whether a curve passes near, with a cycle of about this size."""
        for line, sizes in zip(self.branches, self.sizes, strict=True):
            away = np.hypot(*np.linalg.solve(self.A, (line - f).T))
            i = int(np.argmin(away))
            if away[i] < 2.0 * STEP and abs(sizes[i] - amplitude) < 0.2:
                return True
        return False

    def _cusps(self, states: list[_State]) -> list[SpecialPoint]:
        return [SpecialPoint("cusp of cycles", place(-self.A @ s.e), CUSP) for s in states if s.cusp]

    def _rows(self, states: list[_State]) -> list[tuple[Array, float]]:
        return [(-self.A @ s.e, s.turn.amplitude) for s in states]

    def _add(self, rows: list[tuple[Array, float]], special: list[SpecialPoint]) -> None:
        line, sizes = np.array([f for f, _ in rows]), np.array([size for _, size in rows])
        for sign in (1.0, -1.0):
            self.branches.append(sign * line)
            self.sizes.append(sizes)
            self.special += [SpecialPoint(s.type, place(sign * np.array(s.place)), s.sentence) for s in special]

    def _end(self, states: list[_State], how: str) -> tuple[list[tuple[Array, float]], list[SpecialPoint]]:
        """Rows to add at the end of a curve, and what is to be said about it."""
        f, size = self._rows(states[-1:])[0]
        if how == "closed":
            return [], []
        other = min(self.points, key=lambda g: self.near(g, f), default=None)
        if other is not None and (how == "C" or (self.near(other, f) < NEAR and size < SMALLER)):
            self.used += [other, -other]
            return [(other, 0.0)], []
        corners = [(np.array(Geometry(*self.plane).saddle_node_at(t)), "touching", TOUCHING) for t in self.touching]
        reach = NEAR
        if states[-1].turn.height < 0.1 and all(self.near(g, f) >= NEAR for g, *_ in corners):
            # towards a neutral loop the fold runs along the curve of loops, closer than any power
            corners, reach = [(np.array(s.place), "resonant loop", RESONANT) for s in self.resonant], 5.0 * NEAR
        for g, kind, text in corners:
            if self.near(g, f) < reach:
                return [(g, size)], [SpecialPoint(kind, place(g), text)]
        if how == "equator":
            return [], [SpecialPoint("equator", place(f), "The fold of cycles reaches the equator here.")]
        text = "The fold of cycles was followed to here and no further."
        return [], [SpecialPoint("undecided", place(f), text)]
