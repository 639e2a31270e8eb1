"""Triangles of a ring about a cycle: between closed ways that all begin in one direction from its middle.

Each way goes once round the middle, so that places on two ways are joined in the order of their directions.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .fields import fields
from .flow import Flow

Array = NDArray[np.float64]


class Way(NamedTuple):
    """A closed way: places (n, 2), the last of them the first, and their directions (n,), which rise by a turn."""

    places: Array
    angles: Array


class Mesh(NamedTuple):
    """A ring as the certificate has it.

    Attributes
    ----------
    ways : list of Way
        From the inside to the outside.
    paths : list of list of int
        For each two neighbours, which of them goes on (0 the inner, 1 the outer), triangle by triangle.
    corners : ndarray (t, 3)
        Of each triangle, as indices into all places in turn, the last of each way left out.
    """

    ways: list[Way]
    paths: list[list[int]]
    corners: NDArray[np.intp]


def directions(flow: Flow, places: Array, middle: Array) -> Array | None:
    """Return the directions of places from the middle; None where they do not rise along the way, by a turn."""
    x, y = flow.frame @ (places - middle).T
    angles = np.unwrap(np.arctan2(y, x))
    rises = bool((np.diff(angles) > 0.0).all()) and abs(angles[-1] - angles[0] - math.tau) < 1e-6
    return angles if rises else None


def spread(flow: Flow, places: Array, angles: Array, count: int) -> Array:
    """Return directions that share out the length, the turning and the change of the divergence along a closed way."""
    step = np.diff(places, axis=0) @ flow.frame.T
    toward = np.arctan2(step[:, 1], step[:, 0])
    turn = np.abs(np.mod(np.diff(np.append(toward, toward[0])) + math.pi, math.tau) - math.pi)
    change = np.abs(np.diff(fields(flow.psi, flow.numbers, places)[1]))
    parts = [np.hypot(*step.T), 0.5 * (turn + np.roll(turn, 1)), change]
    share = np.concatenate([[0.0], np.cumsum(sum(part / max(float(part.sum()), 1e-300) for part in parts))])
    return np.interp(np.linspace(0.0, share[-1], count + 1), share, angles)


def closed(flow: Flow, places: Array, middle: Array, first: float) -> Way | None:
    """Return a closed way with its directions, that of its first place nearest to a given one."""
    angles = directions(flow, places, middle)
    return None if angles is None else Way(places, angles + math.tau * round((first - float(angles[0])) / math.tau))


def sampled(way: Way, at: Array) -> Way:
    """Return the places of a closed way in these directions."""
    angles = np.concatenate([way.angles[:-1] - math.tau, way.angles[:-1], way.angles + math.tau])
    places = np.concatenate([way.places[:-1], way.places[:-1], way.places])
    found = np.stack([np.interp(at, angles, places[:, 0]), np.interp(at, angles, places[:, 1])], axis=1)
    found[-1] = found[0]
    return Way(found, at)


def path(near: Array, far: Array) -> list[int]:
    """Return which of two ways goes on, from neighbour to neighbour: 0 the near one, 1 the far one."""
    behind = np.concatenate([near[1:], far[1:]])
    kind = np.concatenate([np.zeros(len(near) - 1, int), np.ones(len(far) - 1, int)])
    return kind[np.argsort(behind, kind="stable")].tolist()


def mesh(ways: list[Way]) -> Mesh:
    """Join ways by triangles."""
    starts = np.cumsum([0] + [len(way.places) - 1 for way in ways]).tolist()
    paths, corners = [], []
    for (near, far), (start, then) in zip(pairwise(ways), pairwise(starts), strict=False):
        paths.append(path(near.angles, far.angles))
        step = np.array(paths[-1])
        here, there = np.cumsum(1 - step) - (1 - step), np.cumsum(step) - step
        m, n = len(near.places) - 1, len(far.places) - 1
        third = np.where(step == 1, then + (there + 1) % n, start + (here + 1) % m)
        corners.append(np.stack([start + here % m, then + there % n, third], axis=1))
    return Mesh(ways, paths, np.concatenate(corners))
