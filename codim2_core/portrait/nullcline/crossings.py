"""Find where the branches of one nullcline cross each other, or come so close that they seem to.

At a crossing the component and its gradient vanish. On a small circle around it the component changes sign once for
each half-branch; with 2 k of them, half-branch i goes straight on as i + k.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...formulas.arrays import Program
from ...numerics.fourier_zeros import series, zeros
from ...results.arrays import Array

RADIUS, MIN_RADIUS = 0.02, 1e-3  # of the circle, in units of the disc
CROSSING_DISTANCE = 1e-4  # branches that pass each other at this distance are drawn as crossing: a fiftieth of a pixel
CIRCLE_SAMPLES = 32  # on a circle
OBLIQUE = 0.35  # radians by which half-branches may miss going straight on, or leaving along the radius
MAX_CELLS = 300  # with more, the field is not smooth on the scale of the net
MAX_CROSSINGS = 64  # crossings
NEAR_BORDER = 1e-3


@dataclass(frozen=True, eq=False)
class Crossing:
    """Branches that cross."""

    circle: Array  # (3,) Middle and radius
    angles: Array  # (2 k,) Of the half-branches where they meet the circle, increasing

    def nearest(self, point: Array) -> int:
        """Index of the half-branch through a point on the circle."""
        angle = math.atan2(point[1] - self.circle[1], point[0] - self.circle[0])
        return int(np.abs(np.remainder(self.angles - angle + math.pi, 2.0 * math.pi) - math.pi).argmin())

    def opposite(self, i: int) -> int:
        """Index of the half-branch that goes straight on."""
        k = len(self.angles)
        return (i + k // 2) % k

    def start(self, i: int) -> Array:
        """Return the point on the circle where half-branch i leaves it, with the direction away from the middle."""
        u = np.array([math.cos(self.angles[i]), math.sin(self.angles[i])])
        return np.concatenate([self.circle[:2] + self.circle[2] * u, u])


def crossings(
    run: Program, kind: int, outside: bool, reach: float, nodes: Array, parts: Array, size: float
) -> list[Crossing]:
    """All crossings of one component.

    Shapes: nodes (n, m, 2), parts (3, n, m).
    """
    from .trace_nullcline import flat_cells, stationary  # on first use: it loads the compiler

    width = float(np.abs(nodes[1:, 1:] - nodes[:-1, :-1]).max())
    i, j = np.nonzero(flat_cells(parts, width))
    found: list[Crossing] = []
    if len(i) > MAX_CELLS:
        return found
    for middle in 0.5 * (nodes[i, j] + nodes[i + 1, j + 1]):
        if any(math.hypot(*(middle - other.circle[:2])) < 0.5 * width for other in found):
            continue
        ok, X, Y, value = stationary(*run.arrays, kind, outside, middle[0], middle[1], 2.0 * width)
        r = math.hypot(X, Y)
        away = min(r - 1.0, reach - r) if outside else 1.0 - r
        if not ok or abs(value) > 1e-5 * size or away < NEAR_BORDER:
            continue
        between = min((math.dist((X, Y), other.circle[:2]) for other in found), default=math.inf)
        if between < 1e-4:
            continue
        crossing = _crossing_at(run, kind, outside, X, Y, value, size, min(RADIUS, 0.7 * away, 0.4 * between))
        if crossing is not None:
            found.append(crossing)
            if len(found) >= MAX_CROSSINGS:
                break
    return found


_UNIT = np.stack(
    [
        np.cos(np.arange(CIRCLE_SAMPLES) * (2.0 * math.pi / CIRCLE_SAMPLES)),
        np.sin(np.arange(CIRCLE_SAMPLES) * (2.0 * math.pi / CIRCLE_SAMPLES)),
    ],
    axis=-1,
)


def _crossing_at(
    run: Program, kind: int, outside: bool, X: float, Y: float, value: float, size: float, r: float
) -> Crossing | None:
    """Return the crossing at a point where the gradient vanishes, or None if it is none."""
    from .trace_nullcline import sample

    while r >= MIN_RADIUS:
        ring = sample(*run.arrays, outside, np.array([X, Y]) + r * _UNIT)[kind, 0]
        f = series(ring, 2.0 * size)
        around = zeros(f) if f.resolved and not f.vanishes else None
        if around is not None and around.proven:
            angles = around.theta[around.multiplicity % 2 == 1]
            k = len(angles) // 2
            far = r * (abs(value) / float(np.abs(ring).max())) ** (1.0 / max(k, 2))
            if k < 2 or len(angles) % 2 or far > CROSSING_DISTANCE:
                return None
            miss = np.remainder(np.roll(angles, -k) - angles, 2.0 * math.pi) - math.pi
            if np.abs(miss).max() < OBLIQUE:
                return Crossing(np.array([X, Y, r]), angles)
        r *= 0.5
    return None
