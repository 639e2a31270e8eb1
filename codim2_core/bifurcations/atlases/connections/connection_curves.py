"""Connections of saddles over two parameters of any system: loops, cycles through the equator, and all others.

Each is followed both ways from a seed: a sign change of the splitting along a line of the plane.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise

import numpy as np

from ....numerics.arclength import StepBounds, feet, newton, square_edges, trace_curve, zero_between
from ....numerics.sign_changes import root_between
from ....portrait.layer_problem.problem import LayerProblem
from ....results.arrays import Array, read_only
from ....results.words import say
from ...continuation.turns import correct_zero
from ...families.family import SystemFamily
from ..cycles.cycle_curves import marks
from ..result import AtlasCurve, AtlasPoint
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
    """Circles about saddle-nodes on the equator (2,), from which curves of heteroclinic cycles begin; curves (m, 2)."""
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


STEP_BOUNDS = StepBounds(0.04, 0.2, 250, close=1e-11, least=1e-5)
MAX_SEED_ERROR = 0.02  # of the square, that a seed may be off
#: Of the square: a seed lies on a curve; in the disc and in angle: of the same branch.
ON_CURVE_DISTANCE, SAME_BRANCH_DISTANCE = 4e-3, 0.05
NEUTRAL_LOG_RATIO = 1e-6  # |ln ratio| that is zero all along a curve


@dataclass(frozen=True, eq=False)
class ConnectionCurve:
    """A curve of connections."""

    splitting: Splitting
    plane: Array  # (m, 2) Places in the unit square
    pairs: list[BranchPair]  # at each
    ends: tuple[str, str]  # as those of `Traced`

    @property
    def ratios(self) -> Array:
        """Products of the saddles' ratios, (m,)."""
        return np.array([pair.ratio for pair in self.pairs])

    def passes(self, place: Array, pair: BranchPair) -> bool:
        """Whether a place lies on it: by its unstable branch."""
        away = feet(place, self.plane)[2]
        i = int(away.argmin())
        ways = [one.leaving.signature for one in self.pairs[i : i + 2]]
        near = np.array([np.abs(way - pair.leaving.signature).max() for way in ways]).min()
        return bool(away[i] < ON_CURVE_DISTANCE and near < SAME_BRANCH_DISTANCE + np.abs(ways[0] - ways[-1]).max())

    def neutral(self) -> list[Array]:
        """Places where the ratio passes through 1: none where it is 1 all along."""
        level = np.log(self.ratios)
        if not np.abs(level).max() > NEUTRAL_LOG_RATIO:
            return []

        def test(place: Array) -> float:
            pair = self.splitting.pair(place)
            return math.nan if pair is None else math.log(pair.ratio)

        rows = np.flatnonzero(level[1:] * level[:-1] < 0.0).tolist()
        return [zero_between(self.splitting.condition, test, self.plane[i], self.plane[i + 1]) for i in rows]


def trace_connection(seed: ConnectionSeed) -> ConnectionCurve | None:
    """Return the curve through a seed; None if it is not caught."""
    splitting = seed.splitting
    first = newton(splitting.condition, seed.place, MAX_SEED_ERROR)
    if first is None:
        return None
    found = trace_curve(splitting.condition, first, square_edges(2), STEP_BOUNDS)
    if found is None or len(found.points) < 2:
        return None
    pairs = [splitting.pair(place) for place in found.points]
    kept = [i for i, pair in enumerate(pairs) if pair is not None]
    return ConnectionCurve(splitting, found.points[kept], [pair for pair in pairs if pair is not None], found.ends)


LOOP, CYCLE, CONNECTION = KINDS = "homoclinic loop", "heteroclinic cycle", "saddle connection"
BOGDANOV_TAKENS, SADDLE_NODE_CORNER = "Bogdanov–Takens", "saddle-node on the equator"
#: Of the square: a loop ends at a Bogdanov-Takens point so near to it; in the disc, its size.
BOGDANOV_TAKENS_DISTANCE, MAX_LOOP_SIZE = 0.05, 0.3
CORNER_RADIUS = 0.015  # of the square: a cycle through the equator ends at a corner so near to it
CODIM_TWO_DISTANCE = 5e-3  # of the square: an end next to a curve of the equilibria
MAX_CURVES = 24  # curves


def connection_curves(
    family: SystemFamily, curves: Sequence[AtlasCurve], points: Sequence[AtlasPoint]
) -> tuple[list[AtlasCurve], list[AtlasPoint], tuple[str, ...]]:
    """Find connections, the points of codimension two on them, and kinds of which some may be missing."""
    takens = [family.units(np.array(point.place)) for point in points if point.kind == BOGDANOV_TAKENS]
    found: list[ConnectionCurve] = []
    missed: list[ConnectionSeed] = []

    def is_known(place: Array, pair: BranchPair) -> bool:
        return any(one.passes(place, pair) for one in found)

    search = ConnectionSearch(family, is_known)
    corners = [family.units(np.array(point.place)) for point in points if point.kind == SADDLE_NODE_CORNER]
    borders = [family.units(one.points) for one in curves if one.kind in ("saddle-node", "transcritical")]
    some = [corner for corner in corners if not (family.symmetric and corner[1] < 0.5)]
    lines = [*lines_near_takens(family, takens, curves), *rings_about_corners(some, borders)]
    for line in [*lines, *straight(family, curves)]:
        for seed in search.along(line):
            one = trace_connection(seed) if seed.settled and len(found) < MAX_CURVES else None
            if one is None:
                missed.append(seed)
            else:
                found.append(one)
    out, marks = [], []
    for one in found:
        kinds = [_connection_kind(pair) for pair in one.pairs]
        kind = kinds[0] if len(set(kinds)) == 1 else CONNECTION
        plane, places, ratios = one.plane, np.array([pair.leaving.p for pair in one.pairs]), one.ratios
        for end, i in zip(one.ends, (0, -1), strict=True):
            born = _birth_point(one, takens, i) if kind == LOOP else None
            if born is not None:
                order = 1 if i else -1
                plane = np.concatenate([plane[::order], born[0][None]])[::order]
                places = np.concatenate([places[::order], born[1][None]])[::order]
                ratios = np.append(ratios[::order], 1.0)[::order]
            elif (corner := _corner(one.plane[i], corners) if kind == CYCLE else None) is not None:
                order = 1 if i else -1
                plane = np.concatenate([plane[::order], corner[None]])[::order]
                places, ratios = (np.concatenate([row[::order], row[i][None]])[::order] for row in (places, ratios))
            elif end in ("lost", "many"):
                marks.append(_end_point(family, one.plane[i], kind, curves))
        numbers = ratios if kind != CONNECTION else np.zeros(0)
        out.append(AtlasCurve(kind, read_only(family.values(plane)), read_only(places), read_only(numbers)))
        if kind != CONNECTION:
            marks += [_point(family, "neutral loop", at, say("neutral connection", kind=kind)) for at in one.neutral()]
    lost = [_connection_kind(seed.pair) for seed in missed if not is_known(seed.place, seed.pair)]
    return out, marks, tuple(dict.fromkeys([*lost, *(KINDS if search.crowded else ())]))


def _connection_kind(pair: BranchPair) -> str:
    """Name a connection: a cycle is one of two half-saddles that an arc of the equator joins the other way."""
    if pair.leaving.same_saddle(pair.entering):
        return LOOP
    return CYCLE if pair.sense else CONNECTION


def _corner(last: Array, corners: Sequence[Array]) -> Array | None:
    """Return the saddle-node on the equator at which a curve of cycles ends."""
    near = min(corners, key=lambda at: math.dist(at, last), default=None)
    return near if near is not None and math.dist(near, last) < CORNER_RADIUS else None


def _birth_point(one: ConnectionCurve, takens: Sequence[Array], i: int) -> tuple[Array, Array] | None:
    """Return the Bogdanov-Takens point at which a curve of loops ends, and about where the loop shrinks to."""
    pair = one.pairs[i]
    section = pair.section
    near = min(takens, key=lambda at: math.dist(at, one.plane[i]), default=None)
    if (
        near is None
        or section is None
        or section.scale > MAX_LOOP_SIZE
        or math.dist(near, one.plane[i]) > BOGDANOV_TAKENS_DISTANCE
    ):
        return None
    return near, 0.5 * (section.origin + pair.leaving.p)


def _end_point(family: SystemFamily, place: Array, kind: str, curves: Sequence[AtlasCurve]) -> AtlasPoint:
    """Say where a curve could be followed no further, and next to what."""
    gaps = {
        one.kind: float(np.hypot(*(family.units(one.points) - place).T).min())
        for one in curves if one.kind in EQUILIBRIUM_KINDS
    }  # fmt: skip
    near = min(gaps, key=lambda name: gaps[name], default="")
    if near and gaps[near] < CODIM_TWO_DISTANCE:
        return _point(family, "undecided", place, say("connection ends near", kind=kind, near=near))
    return _point(family, "undecided", place, say("connection followed no further", kind=kind))


def _point(family: SystemFamily, kind: str, place: Array, sentence: str) -> AtlasPoint:
    across, up = family.values(place).tolist()
    return AtlasPoint(kind, (across, up), sentence)
