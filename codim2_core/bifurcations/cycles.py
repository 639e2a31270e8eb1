"""Folds of limit cycles as curves in (f1, f2): where they begin and end, and what is special on them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..continuation.branches import CACHE_SIZE, BranchSearch
from ..continuation.continuation_points import ReturnMapPoint
from ..continuation.section_base import Problems
from ..cycles.ray_section import TurnSection
from ..layer_problem.problem import LayerProblem
from ..numerics.root_between import root_between
from ..psi.function import Psi
from ..systems.coefficients import Coefficients
from ..systems.elinear import ELinear
from ..words import say
from .curve import Array, BifurcationCurve, SpecialPoint, matrix, plain_point, read_only_lines
from .equator import coefficients_at, neutral_loop
from .fold_of_cycles import LOG_SIZE_SCALE, FoldEquations
from .geometry import Geometry
from .trace_curves import hopf

MIN_AMPLITUDE = 2e-3  # amplitude of a cycle that is all but C
HOPF_END_AMPLITUDE = 0.05  # amplitude below which a branch that breaks off beside a generalised Hopf point ends there
RAY_STARTS = 0.02, 0.006, 0.06  # of the reach: places on the section beside a generalised Hopf point that are tried
ON_CURVE_DISTANCE, SAME_POINT_DISTANCE = 0.08, 1e-9  # in A^-1 f: a curve passes; points are one
CORNER_RADIUS = 0.03  # in A^-1 f: a branch that breaks off this close to a corner ends there
LINE_SPAN, LINE_VALUES = (0.01, 0.995), 129  # part of a radius of it that is searched; values for Hopf points
SEED_LINES = 6  # across the disc of critical sets, on which folds are looked for
TOUCHING = say("fold ends, saddle-node")
CUSP = say("cusp of cycles")
RESONANT = say("fold ends, neutral loop")


def cycle_folds(system: ELinear | Coefficients, psi: Psi, z: ArrayLike = ()) -> BifurcationCurve:
    """Folds of limit cycles in (f1, f2): a stable and an unstable cycle meet and vanish (Section 4.3.3).

    Curves are begun at the generalised Hopf points of `hopf`, and at the folds found on some lines across the disc of
    critical sets; each is followed to both ends.

    Parameters
    ----------
    system : ELinear, or Coefficients
        Its f does not matter.
    psi : Psi
    z : (m,) floats

    Returns
    -------
    BifurcationCurve
        kind "fold of cycles". `values` holds the cycle's amplitude, the largest distance from C in the projected disc.
        `special` names the points where it turns back, "cusp of cycles", and how a branch ends other than at a
        generalised Hopf point: "resonant loop", "touching", "equator" or "undecided". Empty, with the
        reason in `sentence`, where none was found, or where ``|e_Psi|`` reaches 1 at a finite slip.

    Raises
    ------
    ValueError
        z does not fit the system, or psi is not a Psi.

    Examples
    --------
    >>> from codim2_core import bifurcations
    >>> len(bifurcations.cycle_folds("case1-cm4").branches)
    0
    """
    a, b, d = matrix(system, z)
    label = "sec:case3"
    curve = hopf(system, psi, z)
    if psi.saturation < math.inf or not curve.branches:
        sentence = curve.sentence if psi.saturation == math.inf else say("folds need R3")
        return BifurcationCurve("fold of cycles", "folds of cycles: none", label, (), sentence=sentence)
    points = [np.array(s.place) for s in curve.special if s.type == "generalised Hopf"]
    found = _FoldCurves(a, b, d, psi, points)
    found.from_hopf()
    found.from_lines()
    lines, sizes, special = found.result()
    name = "folds of cycles" if lines else "folds of cycles: none"
    sentence = say("two cycles meet") if lines else say("no fold of cycles", lines=SEED_LINES)
    return BifurcationCurve(
        "fold of cycles", name, label, read_only_lines(lines), tuple(special), read_only_lines(sizes), sentence
    )


class _Mark(NamedTuple):
    """A Hopf point on a line, as `continuation.branch_ends.MarkedValue`."""

    kind: str
    value: float
    place: tuple[float, float]


def _marks_along(problem: Problems) -> list[_Mark]:
    """Return the Hopf points along a line on which there is one critical set."""

    def trace(value: float) -> float:
        return problem(value).critical[0].trace

    values = np.linspace(*LINE_SPAN, LINE_VALUES).tolist()
    traces = [trace(v) for v in values]
    found = [
        root_between(trace, low, high)
        for (low, one), (high, two) in pairwise(zip(values, traces, strict=True))
        if (one < 0.0) != (two < 0.0)
    ]
    return [_Mark("Hopf", v, tuple(problem(v).critical[0].p.tolist())) for v in found]


@dataclass(frozen=True, eq=False)
class _FoldCurve:
    """A curve over e, and the generalised Hopf points at which it ends."""

    e: Array
    sizes: Array
    special: list[tuple[str, Array, str]]
    born: list[int]


class _FoldCurves:
    """Curves found so far over e; at -e there are the same."""

    def __init__(self, a: float, b: float, d: float, psi: Psi, points: list[Array]) -> None:
        self.plane, self.psi = (a, b, d), psi
        self.A = np.array([[a, -b], [b, d]])
        self.points = [self._e(f) for f in points]  # generalised Hopf points
        self.corners = [self._e(f) for f in map(Geometry(a, b, d).saddle_node_at, Geometry(a, b, d).touching)]
        self.found: list[_FoldCurve] = []
        self.missed: list[tuple[str, Array, str]] = []

    def _e(self, f: Sequence[float] | Array) -> Array:
        return np.asarray(-np.linalg.solve(self.A, f), float)

    def result(self) -> tuple[list[Array], list[Array], list[SpecialPoint]]:
        """Return lines in f, sizes of the cycles along them, and special points."""
        both = [(one, sign) for one in self.found for sign in (1.0, -1.0)]
        told = [*(point for one in self.found for point in one.special), *self.missed]
        special = [
            SpecialPoint(k, plain_point(-sign * self.A @ e), text) for k, e, text in told for sign in (1.0, -1.0)
        ]
        return [-sign * one.e @ self.A.T for one, sign in both], [one.sizes for one, _ in both], special

    def from_hopf(self) -> None:
        """Begin beside the generalised Hopf points to which no curve has come."""
        for k, e in enumerate(self.points):
            alike = self._born(e) | self._born(-e)
            if not any(alike & set(one.born) for one in self.found):
                starts = (self._follow(e, math.log(first)) for first in RAY_STARTS)
                if not any(starts) and k == min(alike):
                    self.missed.append(("undecided", e, say("fold not caught")))

    def from_lines(self) -> None:
        """Begin at the folds on some lines across the disc that no curve has passed."""
        for k in range(SEED_LINES):
            angle = math.pi * (k + 0.5) / SEED_LINES
            unit = np.array([math.cos(angle), math.sin(angle)])
            for u, turn in self._folds_along(unit):
                e = turn.value * unit
                if not any(_passes_cycle(one, sign * e, turn.amplitude) for one in self.found for sign in (1.0, -1.0)):
                    self._follow(e, turn.xi, u)

    def _folds_along(self, unit: Array) -> list[tuple[Array, ReturnMapPoint]]:
        """Find the folds on all branches of cycles along a radius of the disc, and the rays they are on."""

        @lru_cache(maxsize=CACHE_SIZE)
        def problem(value: float) -> LayerProblem:
            return LayerProblem(coefficients_at(*self.plane, -value * self.A @ unit), self.psi)

        search = BranchSearch(problem, "t", LINE_SPAN, LINE_SPAN, _marks_along(problem))
        search.run()
        every = [piece for pieces, *_ in search.found for piece in pieces]
        return [(piece.tracer.family.u, piece.trace.points[k].turn) for piece in every for k in piece.trace.folds]

    def _born(self, e: Array) -> set[int]:
        return {k for k, other in enumerate(self.points) if math.dist(e, other) < SAME_POINT_DISTANCE}

    def _follow(self, e: Array, xi: float, u: Array | None = None) -> bool:
        """Add the curve through a fold beside a place on a ray, for any that was lost on it; whether there is one."""
        if u is None:
            problem = LayerProblem(coefficients_at(*self.plane, -self.A @ e), self.psi)
            u = TurnSection(problem, problem.critical[0]).u
        folds = FoldEquations(self.A, self.psi, u)
        found = folds.trace(np.array([xi / LOG_SIZE_SCALE, *e]), self.corners)
        if found is None or len(found.points) < 3:
            return False
        cusps = folds.cusps(found.points)
        places = np.insert(found.points, [i + 1 for i, _ in cusps], np.reshape([v for _, v in cusps], (-1, 3)), axis=0)
        special = [("cusp of cycles", v[1:], CUSP) for _, v in cusps]
        turns = [folds.turn(v) for v in places]
        seen = [
            (v, one.turn) for v, one in zip(places, turns, strict=True) if one and one.turn.amplitude > MIN_AMPLITUDE
        ]
        if len(seen) < 2:
            return False
        places, cycles, born = np.array([v for v, _ in seen]), [cycle for _, cycle in seen], set()
        e, sizes = places[:, 1:], np.array([cycle.amplitude for cycle in cycles])
        for i, how in ((0, found.ends[0]), (len(places) - 1, found.ends[1])) if not found.closed else ():
            last, size, told = self._end(places[i, 1:], cycles[i].amplitude, cycles[i].height, how)
            e, sizes = np.insert(e, i and len(e), last, axis=0), np.insert(sizes, i and len(sizes), size)
            special += [told] if told is not None else []
            born |= self._born(last) | self._born(-last)
        self.found = [one for one in self.found if not born & set(one.born)]
        self.found.append(_FoldCurve(e, sizes, special, sorted(born)))
        return True

    def _end(
        self, e: Array, size: float, height: float, how: str
    ) -> tuple[Array, float, tuple[str, Array, str] | None]:
        """Place and size at the very end of a curve, and what is to be said about it."""
        other = min(self.points, key=lambda g: math.dist(g, e), default=None)
        if other is not None and (how == "C" or (math.dist(other, e) < CORNER_RADIUS and size < HOPF_END_AMPLITUDE)):
            return other, 0.0, None
        corner = min(self.corners, key=lambda g: math.dist(g, e))
        if math.dist(corner, e) < CORNER_RADIUS:
            return corner, size, ("touching", corner, TOUCHING)
        # towards a neutral loop the fold runs along the curve of loops, closer than any power
        f = neutral_loop(*self.plane, self.psi, -self.A @ e) if height < 0.1 else None
        if f is not None and math.dist(self._e(f), e) < 5.0 * CORNER_RADIUS:
            return self._e(f), size, ("resonant loop", self._e(f), RESONANT)
        if how == "equator":
            return e, size, ("equator", e, say("fold reaches the equator"))
        return e, size, ("undecided", e, say("fold followed no further"))


def _passes_cycle(one: _FoldCurve, e: Array, amplitude: float) -> bool:
    """Whether a curve passes near, with a cycle of about this size."""
    away = np.hypot(*(one.e - e).T)
    # of all that is near: the two arms beside a cusp all but coincide
    return bool(((away < ON_CURVE_DISTANCE) & (np.abs(one.sizes - amplitude) < 0.2)).any())
