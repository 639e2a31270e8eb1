"""Seeds of curves that the net has missed, from places whose portrait is not that of their region."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..diagrams.class_maps.families import classes_over
from ..layer_problem.critical import critical_sets
from .family import Family

Array = NDArray[np.float64]

MAX_PLACES = 8  # from which curves are looked for
LONGEST_WAY = 0.5  # of the ranges, along each axis
HALVINGS = 24
ANGLES = 720
MAX_SEEDS = 12  # of each kind at a place


class Seeds(NamedTuple):
    """Places at which curves are begun: (theta, u, v) on the equator, (c, s, u, v) within it."""

    equator: tuple[Array, ...]
    within: tuple[Array, ...]


NO_SEEDS = Seeds((), ())


def seeds_beside(family: Family, places: Sequence[tuple[float, float]]) -> Seeds:
    """Return seeds near places (values of the parameters) at which the portrait is not that of the region around.

    Along each axis the place nearest to one of them is looked for at which the class changes.
    """
    classes = classes_over(family.system, family.psi, family.z, family.names, family.ranges)

    def class_at(u: Array) -> int:
        return int(classes.decided(family.values(u)[None])[0])

    equator: list[Array] = []
    within: list[Array] = []
    for place in places[:MAX_PLACES]:
        start = family.units(np.array(place))
        own = class_at(start)
        for way in (*np.eye(2), *-np.eye(2)):
            length = 1e-3
            while length < LONGEST_WAY and _in_square(start + length * way) and class_at(start + length * way) == own:
                length *= 2.0
            if not (length < LONGEST_WAY and _in_square(start + length * way)):
                continue
            low, high = 0.0, length
            for _ in range(HALVINGS):
                middle = 0.5 * (low + high)
                low, high = (middle, high) if class_at(start + middle * way) == own else (low, middle)
            equator += _on_equator(family, start + high * way)
            for at in (low, high):
                within += _critical_sets(family, start + at * way)
    return Seeds(tuple(equator), tuple(within))


def _in_square(u: Array) -> bool:
    return bool((u >= 0.0).all() and (u <= 1.0).all())


def _on_equator(family: Family, u: Array) -> list[Array]:
    """Angles at which Theta, or U, is locally least in size, the least first."""
    theta = 2.0 * math.pi * np.arange(ANGLES) / ANGLES
    c, s = np.cos(theta), np.sin(theta)
    U, V = family.speed_on_net(c, s, *(np.full(ANGLES, v) for v in u.tolist()))
    found: list[Array] = []
    for size in (np.abs(c * V - s * U), np.hypot(U, V)):
        least = np.flatnonzero((size <= np.roll(size, 1)) & (size < np.roll(size, -1)))
        found += [np.array([theta[i], *u]) for i in least[np.argsort(size[least])][:MAX_SEEDS]]
    return found


def _critical_sets(family: Family, u: Array) -> list[Array]:
    system, psi, z = family.at(u)
    sets = sorted(critical_sets(system, psi, z), key=lambda C: abs(C.determinant))
    return [np.array([*C.e, *u]) for C in sets[:MAX_SEEDS]]
