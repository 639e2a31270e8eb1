"""Folds of limit cycles over two parameters of any system."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import islice

import numpy as np

from ...arrays import Array, read_only
from ...families.family import SystemFamily
from ...words import say
from ..result import AtlasCurve, AtlasPoint
from .fold_seeds import FoldSeed, along_lines, seeds_beside_bautin
from .fold_tracing import CENTRE, FoldCurve, trace_fold

KIND = "fold of cycles"
GENERALISED_HOPF = "generalised Hopf"
ON_CURVE_DISTANCE = 0.03  # of the square: a curve passes a start, or ends at a point of codimension two, so near to it
MAX_POINT_SIZE = 0.02  # cycles that are all but a critical set
SAME_SIZE_RATIO = 0.15  # of the size of cycles


def cycle_curves(
    family: SystemFamily, curves: Sequence[AtlasCurve], points: Sequence[AtlasPoint]
) -> tuple[list[AtlasCurve], list[AtlasPoint]]:
    """Find folds of cycles, and the places where they could be followed no further.

    They are begun at generalised Hopf points, and at the folds on branches of cycles along two lines each way: one
    that meets none of these is missed.
    """
    born = [family.units(np.array(point.place)) for point in points if point.kind == GENERALISED_HOPF]
    found: list[FoldCurve] = []
    for place in born:
        if not any(_comes_to(one, place) for one in found):
            caught = (trace_fold(family, seed.start) for seed in seeds_beside_bautin(family, place))
            found += islice((one for one in caught if one is not None), 1)
    for seed in along_lines(family, curves):
        if not any(_passes_seed(one, seed) for one in found):
            one = trace_fold(family, seed.start)
            found += [one] if one is not None else []
    out, lost = [], []
    for one in found:
        plane, sizes, ends = _extend_to_births(one, born)
        places = np.full((len(plane), 2), math.nan)
        out.append(AtlasCurve(KIND, read_only(family.values(plane)), read_only(places), read_only(sizes)))
        for across, up in family.values(np.array(ends).reshape(-1, 2)).tolist():
            lost.append(AtlasPoint("undecided", (across, up), say("fold followed no further")))
    return out, lost


def _passes_seed(curve: FoldCurve, seed: FoldSeed) -> bool:
    near = _away(curve.plane, seed.start.v[1:]) < ON_CURVE_DISTANCE
    return bool((near & (np.abs(curve.sizes - seed.size) < SAME_SIZE_RATIO)).any())


def _comes_to(curve: FoldCurve, place: Array) -> bool:
    ends = [math.dist(curve.plane[i], place) for i in (0, -1) if curve.sizes[i] < MAX_POINT_SIZE]
    return min(ends, default=math.inf) < ON_CURVE_DISTANCE


def _away(plane: Array, place: Array) -> Array:
    return np.hypot(*(plane - place).T)


def _extend_to_births(one: FoldCurve, born: Sequence[Array]) -> tuple[Array, Array, list[Array]]:
    """Return a curve drawn on to the points where it is born, and its ends that are at none."""
    plane, sizes, lost = one.plane, one.sizes, []
    for end, i in zip(one.ends, (0, -1), strict=True):
        last, size = one.plane[i], one.sizes[i]
        near = min(born, key=lambda at, last=last: math.dist(at, last), default=None)
        if near is not None and size < MAX_POINT_SIZE and math.dist(near, last) < ON_CURVE_DISTANCE:
            plane = np.concatenate([near[None], plane] if i == 0 else [plane, near[None]])
            sizes = np.concatenate([[0.0], sizes] if i == 0 else [sizes, [0.0]])
        elif end in (CENTRE, "lost", "many"):
            lost.append(last)
    return plane, sizes, lost
