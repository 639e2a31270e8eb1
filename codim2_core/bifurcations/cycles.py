"""Folds of limit cycles as curves in (f1, f2): where they begin and end, and what is special on them."""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np

from ..continuation.branches import folds_along
from ..continuation.varied_system import Straight
from ..psi.function import Psi
from ..words import say
from .curve import Array, BifurcationCurve, SpecialPoint, frozen, matrix, place
from .equator import neutral_loop
from .fold import Fold, FoldGuess, null_vector
from .fold_of_cycles import OUTWARD, SMALL, STEP, Asking, Folds
from .geometry import Geometry
from .trace import hopf

SMALLER = 0.05  # amplitude below which a branch that breaks off beside a generalised Hopf point ends there
FIRST = 0.02  # chi of the first point beside a generalised Hopf point
ARRIVED, FLAT = 2e-3, 0.02  # in A^-1 f, ebar: a branch need not be followed closer to where it ends
NEAR = 0.03  # in A^-1 f: a branch that breaks off this close to a corner ends there
LINES = 6  # across the disc of critical sets, on which folds are looked for
TOUCHING = say("fold ends, saddle-node")
CUSP = say("cusp of cycles")
RESONANT = say("fold ends, neutral loop")


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
    found.from_hopf()
    found.from_lines()
    name = "folds of cycles" if found.branches else "folds of cycles: none"
    sentence = say("two cycles meet") if found.branches else say("no fold of cycles", lines=LINES)
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
    def corners(self) -> list[Array]:
        """Where the saddle-node curve touches the ellipse, in (f1, f2)."""
        return [np.array(Geometry(*self.plane).saddle_node_at(t)) for t in self.touching]

    def near(self, f: Array, g: Array) -> float:
        """Distance in A^-1 f."""
        return float(np.hypot(*np.linalg.solve(self.A, f - g)))

    def from_hopf(self) -> None:
        """Begin beside the generalised Hopf points, of each pair at f and -f one, all side by side."""
        starts: list[Array] = []
        for f in self.points:
            if not any(self.near(sign * f, g) < 1e-6 for g in starts for sign in (1.0, -1.0)):
                starts.append(f)
        ways = Folds(*self.plane, self.psi).together([self._beside(f) for f in starts])
        for f, way in zip(starts, ways, strict=True):
            if any(self.near(f, g) < 1e-6 for g in self.used):
                continue  # a curve has ended there
            self.used += [f, -f]
            if way is None:
                text = say("fold not caught")
                self.special += [SpecialPoint("undecided", place(sign * f), text) for sign in (1.0, -1.0)]
                continue
            tail, special = self._end(*way)
            self._add([(f, 0.0), *self._rows(way[0]), *tail], special + self._cusps(way[0]))

    def _beside(self, f: Array) -> Asking[tuple[list[Fold], str] | None]:
        """Follow the curve that begins at a generalised Hopf point, from a given place on the section."""
        folds = Folds(*self.plane, self.psi)
        e = np.asarray(-np.linalg.solve(self.A, f), float)
        folds.settle(e)
        for first in (FIRST, 0.3 * FIRST, 3.0 * FIRST):
            found = yield from folds.corrected(FoldGuess(math.log(first), e, OUTWARD))
            if found is not None:
                return (yield from folds.followed(found, null_vector(found.jacobian, OUTWARD), self._arrived))
        return None

    def from_lines(self) -> None:
        """Begin at the folds on some lines across the disc that no curve has passed."""
        angles = [math.pi * (k + 0.5) / LINES for k in range(LINES)]
        units = [np.array([math.cos(angle), math.sin(angle)]) for angle in angles]
        origin = np.array([*self.plane, 0.0, 0.0])
        lines = [Straight(origin, np.array([0.0, 0.0, 0.0, *(-self.A @ unit)]), self.psi) for unit in units]
        for unit, turns in zip(units, folds_along(lines, 0.01, 0.995), strict=True):
            for turn in turns:
                if self._passed(-self.A @ (turn.value * unit), turn.amplitude):
                    continue
                folds = [Folds(*self.plane, self.psi) for _ in range(2)]
                for one in folds:
                    one.settle(turn.value * unit)
                (ready,) = folds[0].together([folds[0].placed(turn, unit)])
                if ready is None:
                    continue
                tangent = null_vector(ready.jacobian, OUTWARD)
                (states, how), (back, how_back) = folds[0].together(
                    [own.followed(ready, t, self._arrived) for own, t in zip(folds, (tangent, -tangent), strict=True)]
                )
                tail, special = self._end(states, how)
                special += self._cusps(states)
                if how == "closed":
                    self._add([*self._rows(states), self._rows(states)[0]], special)
                    continue
                head, more = self._end(back, how_back)
                special += more + self._cusps(back)
                self._add([*head[::-1], *self._rows(back)[:0:-1], *self._rows(states), *tail], special)

    def _passed(self, f: Array, amplitude: float) -> bool:
        """Whether a curve passes near, with a cycle of about this size."""
        for line, sizes in zip(self.branches, self.sizes, strict=True):
            away = np.hypot(*np.linalg.solve(self.A, (line - f).T))
            # of all that is near: the two arms beside a cusp all but coincide
            if ((away < 2.0 * STEP) & (np.abs(sizes - amplitude) < 0.2)).any():
                return True
        return False

    def _arrived(self, fold: Fold) -> bool:
        """Whether a fold has come to a corner, to C, or to the equator, all but a distance that is not seen."""
        f, size = self._rows([fold])[0]
        if any(self.near(g, f) < ARRIVED for g in self.corners):
            return True
        if size < 3.0 * SMALL and any(self.near(g, f) < ARRIVED for g in self.points):
            return True
        return fold.turn.height < FLAT and neutral_loop(*self.plane, self.psi, f) is not None

    def _cusps(self, states: list[Fold]) -> list[SpecialPoint]:
        return [SpecialPoint("cusp of cycles", place(-self.A @ s.e), CUSP) for s in states if s.cusp]

    def _rows(self, states: list[Fold]) -> list[tuple[Array, float]]:
        return [(-self.A @ s.e, s.turn.amplitude) for s in states]

    def _add(self, rows: list[tuple[Array, float]], special: list[SpecialPoint]) -> None:
        line, sizes = np.array([f for f, _ in rows]), np.array([size for _, size in rows])
        for sign in (1.0, -1.0):
            self.branches.append(sign * line)
            self.sizes.append(sizes)
            self.special += [SpecialPoint(s.type, place(sign * np.array(s.place)), s.sentence) for s in special]

    def _end(self, states: list[Fold], how: str) -> tuple[list[tuple[Array, float]], list[SpecialPoint]]:
        """Rows to add at the end of a curve, and what is to be said about it."""
        f, size = self._rows(states[-1:])[0]
        if how == "closed":
            return [], []
        other = min(self.points, key=lambda g: self.near(g, f), default=None)
        if other is not None and (how == "C" or (self.near(other, f) < NEAR and size < SMALLER)):
            self.used += [other, -other]
            return [(other, 0.0)], []
        for g in self.corners:
            if self.near(g, f) < NEAR:
                return [(g, size)], [SpecialPoint("touching", place(g), TOUCHING)]
        if states[-1].turn.height < 0.1:
            # towards a neutral loop the fold runs along the curve of loops, closer than any power
            g = neutral_loop(*self.plane, self.psi, f)
            if g is not None and self.near(g, f) < 5.0 * NEAR:
                return [(g, size)], [SpecialPoint("resonant loop", place(g), RESONANT)]
        if how == "equator":
            return [], [SpecialPoint("equator", place(f), say("fold reaches the equator"))]
        text = say("fold followed no further")
        return [], [SpecialPoint("undecided", place(f), text)]
