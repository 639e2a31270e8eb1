"""A ray from a point of the hemisphere to the equator, and which one crosses a cycle well."""

from __future__ import annotations

import math

import numpy as np

from ...results.arrays import Array
from ..layer_problem.problem import LayerProblem
from .ray_section import HemispherePoint, TurnSection, room

#: Ebar, and distance from the foot, below which a crossing is the worse the nearer it is to an end of the ray.
FREE_HEIGHT, FREE_DISTANCE = 0.05, 1e-4
CROSSING_SLACK = 0.05  # of a turn: what lies so shortly before a crossing is judged by its angle alone


class Ray(TurnSection):
    """The ray from a point in a given direction, with the map of first turns on it."""

    def __init__(self, problem: LayerProblem, foot: HemispherePoint, u: Array) -> None:
        self.problem, self.at, self.psi, self.critical, self.u = problem, problem.at, problem.psi, foot, u
        self.rate = problem.at.speed
        self.reach, self.other = room(foot, u)


def best_crossing(points: Array, foot: HemispherePoint) -> tuple[float, int]:
    """Find where a cycle crosses a ray from a point best: how well, and at which of its points.

    An orbit from there turns by 2 pi about the point just when it is back, and not sooner, if no earlier point of the
    cycle is as far round. It crosses well if that is so by far, if it crosses at a large angle, far from both ends.

    quality: Negative if the cycle does not go round the point once. Shapes: points (m, 2).
    """
    quality = crossing_qualities(points, foot)
    best = int(quality.argmax())
    return float(quality[best]), best


def crossing_qualities(points: Array, foot: HemispherePoint) -> Array:
    """Return how well a cycle crosses the ray from a point through each of its own points, see `best_crossing`.

    Shapes: points (m, 2), result (m - 1,).
    """
    away = points - foot.p
    angle = np.unwrap(np.arctan2(away[:, 1], away[:, 0]))
    turned = angle[-1] - angle[0]
    if abs(abs(turned) - 2.0 * math.pi) > 0.1:
        return np.full(len(points) - 1, -1.0)
    sense, count = math.copysign(1.0, turned), len(points) - 1
    angle = sense * angle[:-1]
    along = np.roll(points[:-1], -1, axis=0) - np.roll(points[:-1], 1, axis=0)
    sine = sense * (away[:-1, 0] * along[:, 1] - away[:-1, 1] * along[:, 0])
    sine = sine / np.maximum(np.hypot(*away[:-1].T) * np.hypot(*along.T), 1e-300)
    twice = np.concatenate([angle - 2.0 * math.pi, angle])  # the turn before, and this one
    highest = np.maximum.accumulate(twice)
    recent = max(1, int(CROSSING_SLACK * count))
    lead = angle - highest[count - recent : 2 * count - recent]
    height = np.sqrt(np.maximum(1.0 - (points[:-1] ** 2).sum(axis=1), 0.0))
    free = np.minimum(np.minimum(height / FREE_HEIGHT, np.hypot(*away[:-1].T) / FREE_DISTANCE), 1.0)
    return np.where(angle >= highest[count:], np.minimum(sine, lead) * free, -1.0)
