"""Marks that a question may ask for on the picture: their places in a scene, and how near an answer must come.

To add one is one entry of `MARKS`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from codim2_core.scene import Scene

Point = tuple[float, float]

#: As far from the place, in radii of the disc, a mark is right: twice the size of a fingertip on a phone's picture.
MARK_TOLERANCE = 0.2


def _critical_marks(*kinds: str) -> Callable[[Scene], list[Point]]:
    return lambda scene: [
        (float(C.p[0]), float(C.p[1])) for C in scene["critical"] if C.kind.startswith(kinds or ("",))
    ]


def _direction_marks(chosen: Callable[[Any], Any]) -> Callable[[Scene], list[Point]]:
    def places(scene: Scene) -> list[Point]:
        theta = scene["equator"].theta[chosen(scene["equator"])]
        return [(math.cos(angle), math.sin(angle)) for angle in theta]

    return places


#: What is marked: what it says (for authors), and where it is; by the name of the fact that counts it.
MARKS: dict[str, tuple[str, Callable[[Scene], list[Point]]]] = {
    "critical_sets": ("a critical set", _critical_marks()),
    "stable": ("a stable critical set", _critical_marks("stable")),
    "saddles": ("a saddle", _critical_marks("saddle")),
    "limit_directions": ("a limit direction", _direction_marks(lambda equator: np.full(len(equator.theta), True))),
    "arriving": ("a limit direction with λ_ρ < 0", _direction_marks(lambda equator: equator.lambda_rho < 0.0)),
    "leaving": ("a limit direction with λ_ρ > 0", _direction_marks(lambda equator: equator.lambda_rho > 0.0)),
    "along_an_open_set": (
        "a limit direction along which an open set of trajectories arrives",
        _direction_marks(lambda equator: (equator.lambda_rho < 0.0) & (equator.lambda_theta < 0.0)),
    ),
}
#: Those that lie on the equator: a mark next to it counts by its angle.
EQUATOR_MARKS = frozenset({"limit_directions", "arriving", "leaving", "along_an_open_set"})


def gap(what: str, scene: Scene, place: Point) -> float | None:
    """Return how far a mark is from the nearest place that was meant, in radii of the disc; None if there is none.

    Parameters
    ----------
    what : str
        A key of `MARKS`.
    scene : Scene
    place : tuple of float
        A point of the picture.
    """
    there = MARKS[what][1](scene)
    if not there:
        return None
    x, y = place
    radius = math.hypot(x, y)
    if what in EQUATOR_MARKS:  # the middle of the disc has no angle
        x, y = (x / radius, y / radius) if radius > MARK_TOLERANCE else (0.0, 0.0)
    return min(math.hypot(x - u, y - v) for u, v in there)
