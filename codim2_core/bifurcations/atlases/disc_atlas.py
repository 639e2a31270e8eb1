"""An atlas over the disc of critical sets, and what of it lies within the ranges that were requested."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ...numerics.arclength import distance
from ...results.arrays import Array, read_only
from ..families.disc import borders
from ..families.family import SystemFamily
from .result import AtlasCurve, AtlasPoint

IMAGE_DISTANCE = 2e-3  # of the square: a curve whose points all lie so near to another is the same
SAME_IMAGE_DISTANCE = 1e-5  # of the square: likewise of points
DISC_MARGIN = 0.02  # of the width of an ellipse: how far the plane is looked at beyond it


def family_around_disc(chart: SystemFamily) -> SystemFamily:
    """Return the family over a rectangle around the ellipse of a chart of `disc_family`."""
    line = chart.values(borders(chart)[1][:, 1:])
    low, high = line.min(axis=0), line.max(axis=0)
    margin = DISC_MARGIN * (high - low)
    spans = zip((low - margin).tolist(), (high + margin).tolist(), strict=True)
    return replace(chart, slant=None, ranges=tuple(spans))


def length_of(line: Array) -> float:
    """Return the length of a line (m, 2)."""
    return float(np.hypot(*np.diff(line, axis=0).T).sum())


def is_covered(plane: Array, line: Array) -> bool:
    """Whether a curve (k, 2) all but lies on another one (m, 2)."""
    few = plane[np.linspace(0, len(plane) - 1, 9).astype(int)]
    return bool((distance(few, line) < IMAGE_DISTANCE).all())


def curves_with_images(chart: SystemFamily, curves: Sequence[AtlasCurve]) -> list[AtlasCurve]:
    """Return curves over a symmetric family with their mirror images, each once."""
    middle = chart.values(np.full(2, 0.5))
    images = [
        AtlasCurve(one.kind, read_only(2.0 * middle - one.points), read_only(-one.places), one.numbers)
        for one in curves
    ]
    kept: list[tuple[AtlasCurve, Array]] = []
    both = [(one, chart.units(one.points)) for one in (*curves, *images)]
    for one, plane in sorted(both, key=lambda pair: -length_of(pair[1])):
        if not any(one.kind == other.kind and is_covered(plane, line) for other, line in kept):
            kept.append((one, plane))
    return [one for one, _ in kept]


def points_with_images(chart: SystemFamily, points: Sequence[AtlasPoint]) -> list[AtlasPoint]:
    """Return points over a symmetric family with their mirror images, each once."""
    kept: list[AtlasPoint] = []
    for one in points:
        for place in (chart.units(np.array(one.place)), 1.0 - chart.units(np.array(one.place))):
            if not any(
                one.kind == other.kind and math.dist(place, chart.units(np.array(other.place))) < SAME_IMAGE_DISTANCE
                for other in kept
            ):
                kept.append(replace(one, place=tuple(chart.values(place).tolist())))
    return kept


def is_in_range(family: SystemFamily, values: Array) -> bool:
    """Whether values of the parameters lie in the ranges of a family."""
    place = family.units(values)
    return bool(place.min() >= 0.0 and place.max() <= 1.0)


def clip_curve(one: AtlasCurve, family: SystemFamily) -> list[AtlasCurve]:
    """Return the parts of a curve within the ranges of a family, cut where its chords cross the border."""
    place = family.units(one.points)
    rows = [np.column_stack([one.points, one.places, one.numbers if len(one.numbers) else np.zeros(len(place))])]
    for axis in (0, 1):
        for level, sign in ((0.0, 1.0), (1.0, -1.0)):
            rows = [
                part for row in rows for part in _parts_above(row, sign * (family.units(row[:, :2])[:, axis] - level))
            ]
    return [
        AtlasCurve(one.kind, read_only(row[:, :2]), read_only(row[:, 2:4]),
                   read_only(row[:, 4] if len(one.numbers) else np.zeros(0)))
        for row in rows
    ]  # fmt: skip


def _parts_above(row: Array, height: Array) -> list[Array]:
    """Return the parts of a line (m, n) along which heights (m,) at its points are not negative."""
    inside = height >= 0.0
    found = []
    edges = np.flatnonzero(np.diff(np.concatenate([[False], inside, [False]]).astype(int))).reshape(-1, 2)
    for i, j in edges.tolist():
        part = [*row[i:j]]
        if i > 0:
            part.insert(0, row[i - 1] + height[i - 1] / (height[i - 1] - height[i]) * (row[i] - row[i - 1]))
        if j < len(row):
            part.append(row[j - 1] + height[j - 1] / (height[j - 1] - height[j]) * (row[j] - row[j - 1]))
        if len(part) > 1:
            found.append(np.array(part))
    return found
