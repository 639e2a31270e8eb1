"""Saddle connections: an unstable branch of one saddle that coincides with a stable one of another."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..numerics.curves.polyline import distance
from ..results.arrays import Array
from ..results.words import say
from .separatrix import Separatrix


def _gap(one: Array, other: Array) -> float:
    """Distance of the middle of `other`, by arc length, from the polyline `one`."""
    length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(other, axis=0).T))])
    at = np.array([np.interp(0.5 * length[-1], length, other[:, k]) for k in range(2)])
    return float(distance(at, one))


def gaps_between(branches: list[Separatrix]) -> dict[tuple[int, int], float]:
    """Distances between each unstable branch and each stable one of another saddle, by their places in the list."""
    gaps = {}
    for i, leaving in enumerate(branches):
        for j, entering in enumerate(branches):
            if leaving.direction != "unstable" or entering.direction != "stable" or leaving.origin == entering.origin:
                continue
            gaps[i, j] = min(_gap(leaving.points, entering.points), _gap(entering.points, leaving.points))
    return gaps


def name_connections(
    branches: list[Separatrix], gaps: dict[tuple[int, int], float], tolerance: float
) -> list[Separatrix]:
    """Name saddle connections: an unstable branch that coincides with a stable one of another saddle."""
    out = list(branches)
    for (i, j), gap in gaps.items():
        if gap <= tolerance:
            leaving, entering = branches[i].origin, branches[j].origin
            sentence = say("saddle connection", leaving=leaving, entering=entering, gap=gap)
            out[i] = replace(out[i], end=entering, connection=True, gap=gap, status=sentence)
            out[j] = replace(out[j], end=leaving, connection=True, gap=gap, status=sentence)
            continue
        for k in (i, j):
            known = out[k].gap
            if known is None or gap < known:
                out[k] = replace(out[k], gap=gap)
    return out
