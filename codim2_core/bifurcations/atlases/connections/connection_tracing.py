"""A connection over the plane: followed both ways from a place where it is."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ....numerics.curves.arclength import StepBounds, feet, newton, square_edges, trace_curve, zero_between
from ....results.arrays import Array
from .connection_seeds import ConnectionSeed
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
