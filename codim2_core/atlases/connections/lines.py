"""Where connections are begun: changes of sign of the splitting along lines of the plane."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ...continuation.typed.foot import corrected
from ...layer_problem.problem import LayerProblem
from ...numerics.root_between import root_between
from ..family import Family
from ..result import AtlasCurve
from .saddles import Branch, branches, lines_of
from .splitting import Pair, Splitting, roughly

Array = NDArray[np.float64]
Known = Callable[[Array, Pair], bool]
Places = tuple[int, int, int | None]  # of a branch that leaves, one that enters, and what a loop goes round

ACROSS = (0.0871, 0.2871, 0.4871, 0.7137, 0.9137)  # of the square: lines across and up,
SAMPLES = 31  # and places on each
BESIDE = (0.02, 0.05, 0.1)  # of the square: from a Bogdanov-Takens point along the Hopf curve, where lines leave it
BEYOND, BETWEEN = 4.0, 25  # times the way from the fold to the Hopf curve, and places on such a line
NARROW, ZERO = 1e-7, 1e-6  # part of a step; what the splitting is less than at a zero that is none but a jump
SAME = 1e-6  # in the disc, of a saddle found twice


@dataclass(frozen=True, eq=False)
class Seed:
    """A zero of a splitting."""

    splitting: Splitting
    place: Array
    pair: Pair


@dataclass(frozen=True, eq=False)
class Sample:
    """What a place of a line has."""

    place: Array
    problem: LayerProblem

    @cached_property
    def branches(self) -> list[Branch]:
        """Of all saddles."""
        return branches(self.problem)

    @cached_property
    def lines(self) -> list[Array]:
        """Of each branch."""
        return lines_of(self.branches)

    @cached_property
    def feet(self) -> list[Array]:
        """Critical sets (c, s) that a loop may go round."""
        return [np.asarray(C.e) for C in self.problem.critical if C.kind != "saddle"]

    def pairs(self) -> Iterator[Places]:
        """All pairs of branches, a loop once with each critical set that it may go round."""
        for i, leaving in enumerate(self.branches):
            for j, entering in enumerate(self.branches):
                if leaving.backward or not entering.backward:
                    continue
                if not leaving.same_saddle(entering):
                    yield i, j, None
                elif leaving.critical is not None:
                    yield from ((i, j, k) for k in range(len(self.feet)))

    def pair(self, places: Places) -> Pair:
        """Return a pair by its places in the lists."""
        i, j, k = places
        return Pair(self.branches[i], self.branches[j], None if k is None else self.feet[k])

    def rough(self, places: Places) -> float:
        """Return the splitting of a pair by drawn lines; NaN where they do not cross."""
        section = self.pair(places).section
        return math.nan if section is None else roughly(section, self.lines[places[0]], self.lines[places[1]])

    def followed(self, here: Sample) -> tuple[dict[int, int], dict[int, int]]:
        """Which branches and which feet of a place nearby are those of this one."""
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
            e = corrected(here.problem.at, foot)
            for j, other in enumerate(here.feet):
                if e is not None and math.dist(e, other) < SAME:
                    feet[i] = j
        return branches_, feet


def sample(family: Family, place: Array) -> Sample | None:
    """Return what a place has; None where U or Psi has no value."""
    try:
        return Sample(place, LayerProblem(family.frozen(place), family.psi_at(place)))
    except ValueError:
        return None


def straight() -> list[Array]:
    """Lines across and up the square, each (SAMPLES, 2)."""
    t = np.linspace(0.0, 1.0, SAMPLES)
    return [np.stack([t, np.full_like(t, at)][::order], axis=1) for order in (1, -1) for at in ACROSS]


def beside(family: Family, takens: Sequence[Array], curves: Sequence[AtlasCurve]) -> list[Array]:
    """Short lines that leave folds of critical sets through the Hopf curve, beside Bogdanov-Takens points.

    In the normal form x' = y, y' = p + q x + x^2 - x y the fold is p = q^2/4, Hopf p = 0, and the loop
    p = -6 q^2/25 + ...: from the fold it lies nearly twice as far as the Hopf curve.
    """
    folds = [family.units(one.points) for one in curves if one.kind == "fold of critical sets"]
    hopfs = [family.units(one.points) for one in curves if one.kind == "Hopf"]
    found = []
    for place in takens:
        for hopf in hopfs:
            away = np.hypot(*(hopf - place).T)
            if away.min() > BESIDE[0]:
                continue
            for reach in BESIDE:
                H = hopf[int(np.abs(away - reach).argmin())]
                G = min((_nearest(fold, H) for fold in folds), key=lambda one, H=H: math.dist(one, H), default=None)
                if G is not None and 0.0 < math.dist(G, H) < reach < 2.0 * float(away.max()):
                    found.append(G + np.linspace(0.0, BEYOND, BETWEEN)[1:, None] * (H - G))
    return found


def _nearest(line: Array, place: Array) -> Array:
    start, along = line[:-1], np.diff(line, axis=0)
    part = np.clip(((place - start) * along).sum(axis=1) / np.maximum((along**2).sum(axis=1), 1e-300), 0.0, 1.0)
    met = start + part[:, None] * along
    return np.asarray(met[int(np.hypot(*(met - place).T).argmin())])


def seeds(family: Family, line: Array, known: Known) -> Iterator[Seed]:
    """Zeros of splittings along one line, without those that are known."""
    before: Sample | None = None
    for place in line:
        here = sample(family, place) if 0.0 <= place.min() <= place.max() <= 1.0 else None
        if before is not None and here is not None:
            yield from _between(family, before, here, known)
        before = here


def _between(family: Family, before: Sample, here: Sample, known: Known) -> Iterator[Seed]:
    branches_, feet = before.followed(here)
    for places in before.pairs():
        i, j, k = places
        first = before.rough(places)
        if not math.isfinite(first) or i not in branches_ or j not in branches_ or (k is not None and k not in feet):
            continue
        last = here.rough((branches_[i], branches_[j], None if k is None else feet[k]))
        if not first * last < 0.0:
            continue
        pair = before.pair(places)
        splitting, way = Splitting(family, before.place, pair), here.place - before.place
        if known(before.place + first / (first - last) * way, pair):
            continue
        part = root_between(lambda t, s=splitting, way=way: s.gap(before.place + t * way), 0.0, 1.0, NARROW)
        place = before.place + part * way
        found = splitting.pair(place)
        if found is not None and abs(splitting.gap(place)) < ZERO and not known(place, found):
            yield Seed(splitting, place, found)
