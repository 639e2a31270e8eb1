"""Seeds of connection curves: sign changes of the splitting along lines of the plane."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise

import numpy as np

from ....numerics.curves.arclength import feet
from ....numerics.sign_changes import root_between
from ....portrait.layer_problem.problem import LayerProblem
from ....results.arrays import Array
from ...continuation.section_base import correct_zero
from ...families.family import SystemFamily
from ..cycles.cycle_curves import marks
from ..result import AtlasCurve
from .splitting import ROUGH_RTOL, Branch, BranchPair, Splitting, branches, cycle_arcs, lines_of, roughly

Known = Callable[[Array, BranchPair], bool]
BranchTriple = tuple[int, int, int | None]  # of a branch that leaves, one that enters, and what a loop goes round

LINE_OFFSETS = (0.0871, 0.2871, 0.4871, 0.7137, 0.9137)  # of the square: lines across and up,
LINE_SAMPLES = 31  # and places on each,
PIECE_SAMPLES = 0.02, 0.2, 0.4, 0.6, 0.8, 0.98  # of a piece between two curves,
MIN_PIECE_LENGTH = 1e-3  # and of the square, how long it is at least
EQUILIBRIUM_KINDS = (
    "fold of critical sets", "pitchfork of critical sets", "saddle-node", "pitchfork", "transcritical", "det A = 0",
)  # fmt: skip
#: Of the square: from a Bogdanov-Takens point along the Hopf curve, where lines leave it.
BOGDANOV_TAKENS_OFFSETS = 0.02, 0.05, 0.1
RING_RADII, RING_SAMPLES = (0.02, 0.08), 25  # of the square, about saddle-nodes on the equator; places on each
MAX_HOPF_MULTIPLE, HOPF_SAMPLES = 4.0, 25  # times the way from the fold to the Hopf curve, and places on such a line
MAX_BRANCHES = 40  # of the saddles at one place
UNRESOLVED_SPLITTING = 1e-3  # splitting as lines tell it, of which they do not tell the sign
#: Part of a step; what the splitting is less than at a zero that is none but a jump.
MIN_STEP_PART, MAX_ZERO_SPLITTING = 1e-7, 1e-6
SAME_SADDLE_DISTANCE = 1e-6  # in the disc, of a saddle found twice


@dataclass(frozen=True, eq=False)
class ConnectionSeed:
    """A zero of a splitting; not `settled` where lines show one and their orbits cannot be followed to all digits."""

    splitting: Splitting
    place: Array
    pair: BranchPair
    settled: bool = True


@dataclass(frozen=True, eq=False)
class LineSample:
    """A place on a line, with its saddles' branches; `known` are splittings that were computed."""

    place: Array
    problem: LayerProblem
    known: dict[BranchTriple, float] = field(default_factory=dict)

    @cached_property
    def branches(self) -> list[Branch]:
        """Return the branches of all saddles."""
        return branches(self.problem)

    @cached_property
    def lines(self) -> list[Array]:
        """Return the points of each branch."""
        sets = [C.p for C in self.problem.critical]
        apart = [math.dist(one, other) for i, one in enumerate(sets) for other in sets[:i]]
        return lines_of(self.branches, min(apart, default=1.0))

    @cached_property
    def feet(self) -> list[Array]:
        """Critical sets (c, s) that a loop may go round."""
        return [np.asarray(C.e) for C in self.problem.critical if C.kind != "saddle"]

    def pairs(self) -> Iterator[BranchTriple]:
        """All pairs of branches, a loop or cycle once with each critical set, and in each sense, that it may go round.

        The last number is three times the place of the set, and the sense (0, 1, or 2 for -1) in which a cycle turns.
        """
        for i, leaving in enumerate(self.branches):
            for j, entering in enumerate(self.branches):
                if leaving.backward or not entering.backward:
                    continue
                loop = leaving.same_saddle(entering)
                if not loop and not (self.feet and cycle_arcs(leaving, entering)):
                    yield i, j, None
                elif not loop:
                    senses = [one.sense % 3 for one in cycle_arcs(leaving, entering)]
                    yield from ((i, j, 3 * k + sense) for k in range(len(self.feet)) for sense in senses)
                elif leaving.critical is not None:
                    yield from ((i, j, 3 * k) for k in range(len(self.feet)))

    def pair(self, places: BranchTriple) -> BranchPair:
        """Return a pair by its places in the lists."""
        i, j, k = places
        if k is None:
            return BranchPair(self.branches[i], self.branches[j], None)
        return BranchPair(self.branches[i], self.branches[j], self.feet[k // 3], (0, 1, -1)[k % 3])

    def rough(self, places: BranchTriple) -> float:
        """Return the splitting of a pair, by drawn lines where these tell its sign; NaN where they do not cross."""
        if places not in self.known:
            pair = self.pair(places)
            if pair.sense:
                found = pair.cycle_gap(ROUGH_RTOL)
            elif pair.section is None:
                found = math.nan
            else:
                found = roughly(pair.section, self.lines[places[0]], self.lines[places[1]])
            self.known[places] = pair.gap if abs(found) < UNRESOLVED_SPLITTING else found
        return self.known[places]

    def followed(self, here: LineSample) -> tuple[dict[int, int], dict[int, int]]:
        """Match the branches and feet of a place nearby with those of this one."""
        branches_, feet = {}, {}
        among: dict[tuple[float, ...], list[int]] = {}  # of each saddle
        for i, one in enumerate(self.branches):
            saddle = tuple(one.p.tolist())
            if saddle not in among:
                among[saddle] = one.among(here.branches)
            ours = [j for j in among[saddle] if here.branches[j].backward == one.backward]
            if ours:
                branches_[i] = max(ours, key=lambda j, way=one.way: float(here.branches[j].way @ way))
        for i, foot in enumerate(self.feet):
            e = correct_zero(here.problem.at, foot)
            for j, other in enumerate(here.feet):
                if e is not None and math.dist(e, other) < SAME_SADDLE_DISTANCE:
                    feet[i] = j
        return branches_, feet


def sample(family: SystemFamily, place: Array) -> LineSample | None:
    """Return what a place has; None where U or Psi has no value."""
    try:
        return LineSample(place, LayerProblem(family.frozen(place), family.psi_at(place)))
    except ValueError:
        return None


def straight(family: SystemFamily, curves: Sequence[AtlasCurve]) -> list[Array]:
    """Lines across and up the square, with some places at least between any two curves on which saddles come or go."""
    ours = [one for one in curves if one.kind in EQUILIBRIUM_KINDS]
    found = []
    for axis in (0, 1):
        for at in LINE_OFFSETS[2 * family.symmetric :]:
            met = [0.0, *(mark.value for mark in marks(family, ours, axis, at)), 1.0]
            pieces = [
                low + np.array(PIECE_SAMPLES) * (high - low)
                for low, high in pairwise(met)
                if high - low > MIN_PIECE_LENGTH
            ]
            t = np.unique(np.concatenate([np.linspace(0.0, 1.0, LINE_SAMPLES), *pieces]))
            found.append(np.stack([t, np.full_like(t, at)][:: 1 - 2 * axis], axis=1))
    return found


def rings_about_corners(corners: Sequence[Array], curves: Sequence[Array]) -> list[Array]:
    """Circles about saddle-nodes on the equator, with some places between any two curves that they cross.

    From there curves of heteroclinic cycles begin. Shapes: corners (2,), curves (m, 2), all in the square.
    """
    found = []
    for corner in corners:
        for radius in RING_RADII:
            angles = [0.0, 2.0 * math.pi]
            for line in curves:
                away = line - corner
                level = np.hypot(*away.T) - radius
                for i in np.flatnonzero(level[1:] * level[:-1] < 0.0).tolist():
                    at = away[i] + level[i] / (level[i] - level[i + 1]) * (away[i + 1] - away[i])
                    angles.append(math.atan2(at[1], at[0]) % (2.0 * math.pi))
            pieces = [low + np.array(PIECE_SAMPLES) * (high - low) for low, high in pairwise(sorted(angles))]
            t = np.unique(np.concatenate([np.linspace(0.0, 2.0 * math.pi, RING_SAMPLES), *pieces]))
            found.append(corner + radius * np.stack([np.cos(t), np.sin(t)], axis=1))
    return found


def lines_near_takens(family: SystemFamily, takens: Sequence[Array], curves: Sequence[AtlasCurve]) -> list[Array]:
    """Short lines that leave folds of critical sets through the Hopf curve, next to Bogdanov-Takens points.

    In the normal form x' = y, y' = p + q x + x^2 - x y the fold is p = q^2/4, Hopf p = 0, and the loop
    p = -6 q^2/25 + ...: from the fold it lies nearly twice as far as the Hopf curve.
    """
    folds = [family.units(one.points) for one in curves if one.kind == "fold of critical sets"]
    hopfs = [family.units(one.points) for one in curves if one.kind == "Hopf"]
    found = []
    for place in takens:
        for hopf in hopfs:
            away = np.hypot(*(hopf - place).T)
            if away.min() > BOGDANOV_TAKENS_OFFSETS[0]:
                continue
            for reach in BOGDANOV_TAKENS_OFFSETS:
                H = hopf[int(np.abs(away - reach).argmin())]
                G = min(
                    (_nearest_vertex(fold, H) for fold in folds), key=lambda one, H=H: math.dist(one, H), default=None
                )
                if G is not None and 0.0 < math.dist(G, H) < reach < 2.0 * float(away.max()):
                    found.append(G + np.linspace(0.0, MAX_HOPF_MULTIPLE, HOPF_SAMPLES)[1:, None] * (H - G))
    return found


def _nearest_vertex(line: Array, place: Array) -> Array:
    _, met, gaps = feet(place, line)
    return np.asarray(met[int(gaps.argmin())])


class ConnectionSearch:
    """Changes of sign along lines."""

    def __init__(self, family: SystemFamily, known: Known) -> None:
        self.family, self.known, self.crowded = family, known, False

    def along(self, line: Array) -> Iterator[ConnectionSeed]:
        """Zeros of splittings along one line, without those that are known."""
        before: LineSample | None = None
        for place in line:
            here = sample(self.family, place) if 0.0 <= place.min() <= place.max() <= 1.0 else None
            if here is not None and len(here.branches) > MAX_BRANCHES:
                self.crowded, here = True, None
            if before is not None and here is not None:
                yield from self._between(before, here)
            before = here

    def _between(self, before: LineSample, here: LineSample) -> Iterator[ConnectionSeed]:
        branches_, feet = before.followed(here)
        for places in before.pairs():
            i, j, k = places
            if i not in branches_ or j not in branches_ or (k is not None and k // 3 not in feet):
                continue
            first = before.rough(places)
            if not math.isfinite(first):
                continue
            after = branches_[i], branches_[j], None if k is None else 3 * feet[k // 3] + k % 3
            last = here.rough(after)
            if not first * last < 0.0:
                continue
            pair = before.pair(places)
            splitting, way = Splitting(self.family, before.place, pair), here.place - before.place
            near = before.place + first / (first - last) * way
            if self.known(near, pair):
                continue
            if not math.isfinite(pair.gap * here.pair(after).gap):
                yield ConnectionSeed(splitting, near, pair, settled=False)
                continue
            part = root_between(lambda t, s=splitting, way=way: s.gap(before.place + t * way), 0.0, 1.0, MIN_STEP_PART)
            place = before.place + part * way
            found = splitting.pair(place)
            if found is not None and abs(splitting.gap(place)) < MAX_ZERO_SPLITTING and not self.known(place, found):
                yield ConnectionSeed(splitting, place, found)
