"""Names of limit directions that follow by continuity while a system changes.

Q1, Q2, ... stand in order of theta, counted from a cut. A direction that passes the cut would change all names; so the
cut is moved away before it, to the middle of the gap between the last direction and the first.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from .equator import EquatorEquilibria


def cut_that_keeps_names(before: EquatorEquilibria, after: EquatorEquilibria, cut: float = 0.0) -> float:
    """Return the angle from which limit directions are counted after a change, so that each keeps its name.

    As many directions as before are matched with those, in order around, by the least sum of squared angles. Where
    some have met or appeared, the first one is that nearest to the first one before.

    0 where that names them so, else `cut` where that does, else the middle of a gap.
    """
    if not len(before) or not len(after):
        return cut
    theta = np.sort(after.theta)
    first = _first_index(before.theta, theta)
    for kept in (0.0, cut):
        if int(np.argmin(np.mod(theta - kept, math.tau))) == first:
            return kept
    gap = float(np.mod(theta[first] - theta[first - 1], math.tau)) or math.tau
    middle = float(np.mod(theta[first] - 0.5 * gap, math.tau))
    return round(middle, 2) if gap > 0.1 else middle  # short in a link


def _first_index(before: NDArray[np.float64], theta: NDArray[np.float64]) -> int:
    """Index in `theta`, increasing from 0, of the direction that is the first one before."""
    if len(before) != len(theta):
        return int(np.argmin(np.abs(_wrap_angle(theta - before[0]))))
    one = np.arange(len(theta))
    turned = theta[(one[:, None] + one) % len(theta)]  # row k begins with direction k
    return int((_wrap_angle(turned - before) ** 2).sum(axis=1).argmin())


def _wrap_angle(angle: NDArray[np.float64]) -> NDArray[np.float64]:
    """Angles in [-pi, pi)."""
    return np.mod(angle + math.pi, math.tau) - math.pi
