"""Lines of the plane on which every direction is a limit direction: there nothing that is zero along a curve tells.

Such a line is an edge on which friction is gone (mu = 0), or a value of one parameter at which U has no part across e.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...numerics.sign_changes import root_between
from ...results.arrays import Array
from ..families.family import SystemFamily

#: Of directions, and places along a line, that have no symmetry.
PROBE_ANGLES = 2.0 * np.pi * (np.arange(7) + 0.37) / 7.0
LINE_SAMPLES = np.array([0.031, 0.217, 0.431, 0.677, 0.913])
SPAN_STEPS = 24  # steps in which such a value is looked for; between them it is where Theta changes its sign everywhere
ZERO_SHARE = 1e-11  # of the largest, |Theta| and |U| that count as zero
ON_LINE_DISTANCE = 1e-6  # of the ranges: what is as near as this to a line lies on it


class DegenerateLine(NamedTuple):
    """A degenerate line."""

    axis: int  # 0: one value across, 1: one value up
    at: float  # that value, in the unit square
    still: bool  # u is zero there

    @property
    def points(self) -> Array:
        """Its ends, (2, 2)."""
        ends = np.array([[0.0, 0.0], [1.0, 1.0]])
        ends[:, self.axis] = self.at
        return ends

    def holds(self, plane: Array, reach: float = ON_LINE_DISTANCE) -> NDArray[np.bool_]:
        """Whether places (..., 2) of the square lie on it."""
        return np.asarray(np.abs(plane[..., self.axis] - self.at) <= reach)


def degenerate_lines(family: SystemFamily) -> tuple[DegenerateLine, ...]:
    """All degenerate lines; none where the whole plane is degenerate."""
    return tuple(line for axis in (0, 1) for line in _lines_along(family, axis))


def drop_touching(cells: Array, lines: Sequence[DegenerateLine], half: float) -> Array:
    """Leave out cells (k, n), of so wide a half, that touch one of some lines."""
    for line in lines:
        cells = cells[~line.holds(cells[:, -2:], half + ON_LINE_DISTANCE)]
    return cells


def _lines_along(family: SystemFamily, axis: int) -> list[DegenerateLine]:
    def speeds(t: float) -> tuple[Array, Array]:
        """Theta and lambda_rho, of all angles and places along the line."""
        place = np.full((2, len(LINE_SAMPLES)), t)
        place[1 - axis] = LINE_SAMPLES
        c, s = np.cos(PROBE_ANGLES)[:, None], np.sin(PROBE_ANGLES)[:, None]
        U, V = family.speed_on_net(c, s, *place)
        return (c * V - s * U).ravel(), (c * U + s * V).ravel()

    side = np.linspace(0.0, 1.0, SPAN_STEPS + 1).tolist()
    every = np.array([speeds(t) for t in side])  # (SPAN_STEPS + 1, 2, many)
    turning, size = every[:, 0], float(np.abs(np.nan_to_num(every, posinf=0.0, neginf=0.0)).max())
    flat = np.all(np.abs(turning) <= ZERO_SHARE * size, axis=1).tolist()
    if all(flat):
        return []
    places = [t for t, zero in zip(side, flat, strict=True) if zero]
    turned = (np.sign(turning[1:]) * np.sign(turning[:-1]) < 0.0).all(axis=1)
    for i in np.flatnonzero(turned).tolist():
        at = root_between(lambda t: float(speeds(t)[0][0]), side[i], side[i + 1], 1e-15)
        if (np.abs(speeds(at)[0]) <= ZERO_SHARE * size).all():
            places.append(at)
    return [DegenerateLine(axis, t, bool((np.abs(speeds(t)[1]) <= ZERO_SHARE * size).all())) for t in sorted(places)]
