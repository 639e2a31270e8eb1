"""A connection over the plane: followed both ways from a place where it is."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...curves.arclength import Steps, square_edges, trace_curve, zero_between
from ...curves.newton import newton
from ...curves.polyline import feet
from .lines import Seed
from .splitting import Pair, Splitting

Array = NDArray[np.float64]

STEPS = Steps(0.04, 0.2, 250, close=1e-9, least=1e-5)
REACH = 0.02  # of the square, that a seed may be off
ON, ALIKE = 4e-3, 0.05  # of the square: a seed lies on a curve; in the disc and in angle: of the same branch
NEUTRAL = 1e-6  # |ln ratio| that is zero all along a curve


@dataclass(frozen=True, eq=False)
class Curve:
    """A curve of connections.

    Attributes
    ----------
    splitting : Splitting
    plane : ndarray (m, 2)
        Places in the unit square.
    pairs : list of Pair
        At each.
    ends : (str, str)
        As those of `Traced`.
    """

    splitting: Splitting
    plane: Array
    pairs: list[Pair]
    ends: tuple[str, str]

    @property
    def ratios(self) -> Array:
        """Products of the saddles' ratios, (m,)."""
        return np.array([pair.ratio for pair in self.pairs])

    def passes(self, place: Array, pair: Pair) -> bool:
        """Whether a place lies on it: the unstable branch tells of which connection."""
        away = feet(place, self.plane)[2]
        i = int(away.argmin())
        ways = [one.leaving.signature for one in self.pairs[i : i + 2]]
        near = np.array([np.abs(way - pair.leaving.signature).max() for way in ways]).min()
        return bool(away[i] < ON and near < ALIKE + np.abs(ways[0] - ways[-1]).max())

    def neutral(self) -> list[Array]:
        """Places where the ratio passes through 1: none where it is 1 all along."""
        level = np.log(self.ratios)
        if not np.abs(level).max() > NEUTRAL:
            return []

        def test(place: Array) -> float:
            pair = self.splitting.pair(place)
            return math.nan if pair is None else math.log(pair.ratio)

        rows = np.flatnonzero(level[1:] * level[:-1] < 0.0).tolist()
        return [zero_between(self.splitting.condition, test, self.plane[i], self.plane[i + 1]) for i in rows]


def trace_connection(seed: Seed) -> Curve | None:
    """Return the curve through a seed; None if it is not caught."""
    splitting = seed.splitting
    first = newton(splitting.condition, seed.place, REACH)
    if first is None:
        return None
    found = trace_curve(splitting.condition, first, square_edges(2), STEPS)
    if found is None or len(found.points) < 2:
        return None
    pairs = [splitting.pair(place) for place in found.points]
    kept = [i for i, pair in enumerate(pairs) if pair is not None]
    return Curve(splitting, found.points[kept], [pair for pair in pairs if pair is not None], found.ends)
