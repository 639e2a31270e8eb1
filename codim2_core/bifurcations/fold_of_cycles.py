"""Folds of limit cycles, and the curve through one: where the return map has a double fixed point.

With the place xi on the section as a third unknown, the curve solves ``shift = 0, exponent = 0``
(`continuation.turns`). It is followed by pseudo-arclength in (chi, A^-1 f), which is of size 1 however narrow the
ellipse |A^-1 f| = 1 is. Several points ahead are predicted, and corrected side by side: each with its neighbours for
the exponent's derivatives.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Sequence
from dataclasses import replace
from typing import NamedTuple, TypeVar

import numpy as np

from ..continuation.ahead import Place, ahead
from ..continuation.asking import answered
from ..continuation.turns import LOOSE, RTOL, Turn, turns
from ..cycles.many.sections import Indices, Sections
from ..cycles.section import Section
from ..layer_problem.critical import critical_sets
from ..psi.function import Psi
from .curve import Array
from .equator import coefficients_at
from .fold import Fold, FoldGuess, carried, null_vector

STEP, SHORTEST = 0.04, 1e-4
MOST, MOST_TURNS = 400, 600  # points of a curve, and places that it may ask for
ROUNDS = 8
CLOSE = 1e-9
DIFFERENCE = 1e-5  # for derivatives of the exponent: on both sides, for near corners it bends sharply
NEARLY, CARRY = 1e-6, 1e-12  # a correction that may be the last without another turn, and what is then left
TELLS = 0.01  # of the correction before, which a loose turn began: over so much it tells how the numbers change
INMOST = -2.0  # xi below which the exponent is so small that a loose turn does not tell how it changes
SMALL, LOW = 3e-3, 1e-4  # amplitude, ebar: the cycle has come to C, to the equator
OUTWARD = np.array([1.0, 0.0, 0.0])
CUSP_ROUNDS = 24
LARGEST = 690.0  # |xi|
AHEAD, MEMORY, BEHIND = 8, 12, 3  # folds predicted at once; last folds that predictions know of, and use
TURNED = 0.9  # cosine between successive tangents below which a step is too long
MISSED = 0.3  # distance of a fold from its prediction, in steps, beyond which a step is too long
#: A place (xi, e) and those beside it, for differences of the exponent.
BESIDE = DIFFERENCE * np.vstack([np.zeros(3), np.eye(3), -np.eye(3)])


class Asked(NamedTuple):
    """Places (xi, e) on the section along a ray, whose turns are asked for with all derivatives.

    Each place has the rtol of its turn, and that of the turns beside it, for the derivatives of the exponent.
    """

    ray: int
    places: Sequence[tuple[float, Array]]
    rtols: Sequence[tuple[float, float]]


#: A search that asks for turns; see `continuation.asking`.
Found = TypeVar("Found")
Asking = Generator[Asked, "list[Fold | None]", Found]


class Folds:
    """Folds for one a, b, d and Psi: searches on one ray, which ask for turns, and their answers on all rays."""

    def __init__(self, a: float, b: float, d: float, psi: Psi) -> None:
        self.a, self.b, self.d, self.psi = a, b, d, psi
        self.A = np.array([[a, -b], [b, d]])
        self.ray = 0
        self.turns = 0

    def settle(self, e: Array) -> None:
        """Choose the ray of the section for a curve that begins at e."""
        coefficients = coefficients_at(self.a, self.b, self.d, -self.A @ e)
        self.ray = Section(coefficients, self.psi, critical_sets(coefficients, self.psi)[0]).ray

    def together(self, searches: Sequence[Asking[Found]]) -> list[Found]:
        """Run searches of such folds side by side, and return what each has found."""
        return answered(searches, self.answers)

    def placed(self, turn: Turn, unit: Array) -> Asking[Fold | None]:
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
        return (yield from self.corrected(FoldGuess(xi, e, OUTWARD)))

    def states(
        self, places: Sequence[tuple[float, Array]], rtols: Sequence[tuple[float, float]]
    ) -> Asking[list[Fold | None]]:
        """Ask for turns from places (xi, e), with all derivatives."""
        self.turns += len(places)
        return (yield Asked(self.ray, places, rtols))

    def answers(self, asked: list[Asked]) -> list[list[Fold | None]]:
        """Follow the turns that several searches ask for."""
        rays = np.concatenate([np.full(len(one.places), one.ray) for one in asked])
        rtols = np.array([(own, *[beside] * (len(BESIDE) - 1)) for one in asked for own, beside in one.rtols])
        found = iter(self._followed(rays, [place for one in asked for place in one.places], rtols.ravel()))
        return [[next(found) for _ in one.places] for one in asked]

    def _followed(self, rays: Indices, places: Sequence[tuple[float, Array]], rtols: Array) -> list[Fold | None]:
        """Follow turns from places (xi, e), with all derivatives: those of the exponent by differences."""
        centres = np.array([(xi, *e) for xi, e in places])
        every = (centres[:, None] + BESIDE).reshape(-1, 3)
        complement = 1.0 - every[:, 1] ** 2 - every[:, 2] ** 2
        allowed = np.flatnonzero((complement > 0.0) & (np.abs(every[:, 0]) < LARGEST))
        if not len(allowed):
            return [None] * len(places)
        xi, e = every[allowed, 0], every[allowed, 1:]
        planes = np.column_stack([np.tile((self.a, self.b, self.d), (len(e), 1)), -e @ self.A.T])
        changes = np.zeros((2, len(e), 5))
        changes[:, :, 3:] = -self.A.T[:, None]
        sections = Sections(planes, e, complement[allowed], self.psi, None, np.repeat(rays, len(BESIDE))[allowed])
        found = turns(sections, xi, np.zeros(len(e), bool), changes, rtol=rtols[allowed])
        each = found.each([0.0] * len(e))
        row_of = np.full(len(every), -1)
        row_of[allowed[found.rows]] = np.arange(len(found.rows))
        out: list[Fold | None] = []
        for centre, rows in zip(centres, row_of.reshape(-1, len(BESIDE)), strict=True):
            turn = each[found.rows[rows[0]]] if (rows >= 0).all() else None
            if turn is None:
                out.append(None)
                continue
            by_e, drift = found.parameters(rows[0])
            after, before = found.exponent[rows[1:]].reshape(2, 3)
            rise = (after - before) / (2.0 * DIFFERENCE)
            jacobian = np.array([[turn.by_xi, *by_e], rise])
            jacobian[:, 0] /= turn.rate
            jacobian[:, 1:] -= jacobian[:, :1] * drift  # at fixed chi, not xi
            out.append(Fold(float(centre[0]), centre[1:], turn, jacobian, drift))
        return out

    def corrected(self, guess: FoldGuess, closely: bool = False) -> Asking[Fold | None]:
        """Find the fold by one guess, see `all_corrected`."""
        (found,) = yield from self.all_corrected([guess], closely)
        return found

    def all_corrected(self, guesses: Sequence[FoldGuess], closely: bool = False) -> Asking[list[Fold | None]]:
        """Newton's method for folds one after another on a curve, side by side.

        None for those behind one that is not found, unless they were found before it was given up. The first turns are
        loose, and those for the exponent's derivatives, unless these are wanted `closely`.
        """
        found: list[Fold | None] = [None] * len(guesses)
        places = [(guess.xi, guess.e) for guess in guesses]
        before: list[tuple[Fold, Array, float] | None] = [None] * len(guesses)
        open_ = list(range(len(guesses)))
        own = [RTOL if closely else _loose(guess.xi) for guess in guesses]
        for _ in range(ROUNDS):
            if not open_:
                break
            rtols = [(own[i], RTOL if closely else _loose(places[i][0])) for i in open_]
            states, going = (yield from self.states([places[i] for i in open_], rtols)), []
            for i, state in zip(open_, states, strict=True):
                if state is None:
                    break
                matrix = np.vstack([state.jacobian, guesses[i].row])
                if abs(np.linalg.det(matrix)) < 1e-12:
                    break
                change = -np.asarray(np.linalg.solve(matrix, [state.turn.shift, state.turn.exponent, 0.0]), float)
                size = float(np.abs(change).max())
                xi, e = state.xi + state.xi_by(change), state.e + change[1:]
                one = before[i]
                last = math.inf if one is None else one[2]
                exact = own[i] == RTOL
                if exact and size < CLOSE:
                    found[i] = replace(state, xi=xi, e=e)
                elif exact and one is not None and _tell(size, last):
                    found[i] = carried(*one[:2], state, change, xi)
                elif size <= 2.0 * last and size <= 0.3:
                    places[i], before[i], own[i] = (xi, e), (state, change, size), RTOL
                    going.append(i)
                else:
                    break
            open_ = going
        return found

    def followed(self, start: Fold, tangent: Array, arrived: Callable[[Fold], bool]) -> Asking[tuple[list[Fold], str]]:
        """Follow the curve from a fold along a tangent (3,) until it ends; how it ends. Its cusps are put in.

        Where a step is too long, `arrived` says of the fold before it whether it has come to what ends the curve.
        """
        states, how = yield from self._way(start, tangent, arrived)
        return (yield from self._with_cusps(states)), how

    def _way(self, start: Fold, tangent: Array, arrived: Callable[[Fold], bool]) -> Asking[tuple[list[Fold], str]]:
        states, tangents, lengths = [start], [tangent], [0.0]
        step, count = 0.25 * STEP, 1
        while len(states) < MOST and self.turns < MOST_TURNS:
            here, tangent = states[-1], tangents[-1]
            reach = min(STEP, 0.5 * min(here.turn.chi, 1.0 - here.turn.chi) / max(abs(tangent[0]), 1e-9))
            longest = max(reach, 1e-3 * STEP)
            step = min(step, longest)
            steps = [min(step * 1.5**k, longest) for k in range(count)]
            taken = 0
            for predicted, found in (yield from self._ahead(states, tangents, lengths, steps)):
                here, tangent, step = states[-1], tangents[-1], steps[taken]
                turned = tangent if found is None else null_vector(found.jacobian, tangent)
                if found is None or float(turned @ tangent) < TURNED:
                    break
                along = float((found.place - here.place) @ tangent)
                missed = float(np.linalg.norm(found.place - predicted))
                if not (missed < MISSED * (taken + 1) * step and MISSED * step < along < 3.0 * step):
                    break
                taken += 1
                states.append(found)
                tangents.append(turned)
                lengths.append(lengths[-1] + self._near(here, found))
                if found.turn.amplitude < SMALL and turned[0] < 0.0:
                    return states, "C"
                if found.turn.height < LOW and found.turn.height < here.turn.height:
                    return states, "equator"
                if len(states) > 8 and self._near(found, start) < 0.7 * step:
                    return states, "closed"
            if taken:
                step = 1.5 * steps[taken - 1]
                count = min(2 * count, AHEAD) if taken == len(steps) else taken
                continue
            step, count = 0.4 * steps[0], 1
            if step < SHORTEST * min(1.0, reach / STEP) or arrived(states[-1]):
                return states, "stuck"
        return states, "stuck"

    def _ahead(
        self, states: list[Fold], tangents: list[Array], lengths: list[float], steps: list[float]
    ) -> Asking[list[tuple[Array, Fold | None]]]:
        """Folds after so many steps from one another, each with the (chi, e) predicted for it."""
        rows = slice(max(len(states) - MEMORY, 0), None)
        places = [Place(fold.xi, fold.turn.chi, tuple(fold.e.tolist())) for fold in states[rows]]
        along = [
            Place(fold.xi_by(t), float(t[0]), tuple(t[1:].tolist()))
            for fold, t in zip(states[rows], tangents[rows], strict=True)
        ]
        predicted = ahead(lengths[rows], places, along, states[-1].turn.rate, steps, BEHIND)
        guesses = [FoldGuess(p.xi, np.array(p.parameters), tangents[-1]) for p in predicted]
        found = yield from self.all_corrected(guesses)
        return [(np.array([p.chi, *p.parameters]), fold) for p, fold in zip(predicted, found, strict=True)]

    def _with_cusps(self, states: list[Fold]) -> Asking[list[Fold]]:
        """Put in the cusps of a curve: where the second derivative of the return map changes its sign along it."""
        out = states[:1]
        for there in states[1:]:
            middle = yield from self._between(out[-1], there)
            for after in (there,) if middle is None else (middle, there):
                here = out[-1]
                turned = (here.bend < 0.0) != (after.bend < 0.0)
                found = (yield from self._cusp(here, after)) if turned else None
                out += [after] if found is None else [found, after]
        return out

    def _between(self, here: Fold, there: Fold) -> Asking[Fold | None]:
        """Find the fold between two cusps that one step has passed, which has led back in e; None where it has not."""
        step = there.place - here.place
        leaving, arriving = (null_vector(fold.jacobian, step) for fold in (here, there))
        if (here.bend < 0.0) != (there.bend < 0.0) or not max(leaving[1:] @ step[1:], arriving[1:] @ step[1:]) < 0.0:
            return None
        found = yield from self.corrected(FoldGuess(0.5 * (here.xi + there.xi), 0.5 * (here.e + there.e), OUTWARD))
        return found if found is not None and (found.bend < 0.0) != (here.bend < 0.0) else None

    def _cusp(self, here: Fold, there: Fold) -> Asking[Fold | None]:
        """Find the cusp between two folds: the secant rule along chi, in which the curve is smooth there."""
        low, high = here, there
        best: Fold | None = None
        for _ in range(CUSP_ROUNDS):
            rise = there.turn.chi - here.turn.chi
            if rise == 0.0 or low.bend == high.bend:
                return None
            part = min(max(low.bend / (low.bend - high.bend), 0.02), 0.98)
            xi, e = low.xi + part * (high.xi - low.xi), low.e + part * (high.e - low.e)
            found = yield from self.corrected(FoldGuess(xi, e, OUTWARD), closely=True)
            if found is None:
                return best
            best = replace(found, cusp=True)
            if abs(best.bend) < 1e-7 * (abs(here.bend) + abs(there.bend)) or abs(high.xi - low.xi) < 1e-9:
                break
            low, high = (best, high) if (best.bend < 0.0) == (low.bend < 0.0) else (low, best)
        return best

    @staticmethod
    def _near(one: Fold, two: Fold) -> float:
        return math.hypot(one.turn.chi - two.turn.chi, *(one.e - two.e))


def _tell(size: float, last: float) -> bool:
    """Whether two turns tell what the fold is, after a correction of this size and the one before."""
    return size < min(NEARLY, TELLS * last) and size * (size / last) ** 2 < CARRY


def _loose(xi: float) -> float:
    """Rtol of a turn that only tells where others are."""
    return LOOSE if xi > INMOST else RTOL
