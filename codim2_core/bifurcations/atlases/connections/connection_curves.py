"""Connections of saddles over two parameters of any system: loops, cycles through the equator, and all others.

A connection over the plane: followed both ways from a place where it is.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ....numerics.curves.arclength import StepBounds, feet, newton, square_edges, trace_curve, zero_between
from ....results.arrays import Array, read_only
from ....results.words import say
from ...families.family import SystemFamily
from ..result import AtlasCurve, AtlasPoint
from .connection_seeds import (
    EQUILIBRIUM_KINDS,
    ConnectionSearch,
    ConnectionSeed,
    lines_near_takens,
    rings_about_corners,
    straight,
)
from .splitting import BranchPair, Splitting

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
        """Whether a place lies on it: the unstable branch tells of which connection."""
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
    """Find connections, the points of codimension two on them, and kinds of which some may be missing.

    These were seen and not followed, or not looked for where there are too many saddles.
    """
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
    out, told = [], []
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
                told.append(_end_point(family, one.plane[i], kind, curves))
        numbers = ratios if kind != CONNECTION else np.zeros(0)
        out.append(AtlasCurve(kind, read_only(family.values(plane)), read_only(places), read_only(numbers)))
        if kind != CONNECTION:
            told += [_point(family, "neutral loop", at, say("neutral connection", kind=kind)) for at in one.neutral()]
    lost = [_connection_kind(seed.pair) for seed in missed if not is_known(seed.place, seed.pair)]
    return out, told, tuple(dict.fromkeys([*lost, *(KINDS if search.crowded else ())]))


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
