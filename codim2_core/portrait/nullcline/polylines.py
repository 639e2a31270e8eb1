"""Curves of the e-disc as polylines of the picture: Psi moves their points along their radius."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache
from itertools import pairwise

import numpy as np

from ...results.arrays import Array
from ...systems.psi.function import Psi
from .conics import Arc, ConicCurve, Straight
from .general_nullclines import Traced
from .view_refinement import Seen, refine_curve, to_picture

Exactly = Callable[[Array], Array]

MAX_COARSE_POINTS = 65  # most points of a branch
PASSES = 8  # of redistribution; each resolves tighter bends, smooth branches need none or one
SAG = 0.2 / 180.0  # in picture units: a polyline stays within 0.25 px of its curve at 180 px a unit
# Clustered at both ends, where a nullcline leaves the origin and where Psi bends it into the equator.
_CHEBYSHEV_GRID = 0.5 - 0.5 * np.cos(np.linspace(0.0, math.pi, MAX_COARSE_POINTS))


@lru_cache(maxsize=16)
def _radial_table(psi: Psi) -> tuple[Array, Array]:
    """|e_Psi| over an even grid of |p|, whose inverse places a curve of the e-disc in the picture.

    Between neighbours |p| moves by 1/2000, so reading the table backwards is off by less than a tenth of a pixel.
    """
    r = np.linspace(0.0, 1.0, 2001)
    inner = r[:-1]
    modulus = np.append(psi.modulus(inner / np.sqrt((1.0 - inner) * (1.0 + inner))), 1.0)
    return modulus, r


def _onto_disc(psi: Psi, e: Array) -> Array:
    """Picture points of points of the closed e-disc: Psi moves them along their radius."""
    if psi.record.identity:
        return e  # |p| = |e| for Psi = 1
    m = np.hypot(e[:, 0], e[:, 1])
    # Rounded to |e| = 1 means on the equator: exp(-s) gets there in doubles already at |p| = 0.984.
    r = np.where(m < 1.0 - 1e-15, np.interp(m, *_radial_table(psi)), 1.0)
    factor = np.divide(r, m, out=np.ones_like(m), where=m > 0.0)
    return e * factor[:, None]


def picture_points(curve: ConicCurve, psi: Psi, seen: Seen | None = None, exactly: Exactly | None = None) -> Array:
    """Picture points along a curve of the e-disc, spread so that no segment sags by more than SAG.

    At most POINTS, or for a traced curve so many for each half turn, and for a conic between its tips; closer where
    the curve is `seen`. `exactly` brings points of a traced curve onto what it was traced for.
    """
    if isinstance(curve, Straight) and (psi.record.identity or curve.is_diameter):
        return _onto_disc(psi, np.array([curve.start, curve.end]))  # Psi moves points along their radius
    if isinstance(curve, Traced) and curve.straight:
        return picture_points(Straight(tuple(curve.points[0]), tuple(curve.points[-1])), psi, seen)
    t, points = _sample_curve(curve, psi)
    if seen is None or not seen.steps_in_view(points).any():
        return points
    onto = exactly or (lambda e: e)
    return refine_curve(curve, lambda e: to_picture(psi, onto(e)), t, points, seen)


def _sample_curve(curve: ConicCurve, psi: Psi) -> tuple[Array, Array]:
    """Parameters along a curve, and its picture points there."""
    if isinstance(curve, Arc) and not psi.record.identity:
        knots = [0.0, *curve.tips(), 1.0]
        parts = [_spread(curve, psi, low + (high - low) * _CHEBYSHEV_GRID) for low, high in pairwise(knots)]
        first, *others = parts
        return (
            np.concatenate([first[0], *(t[1:] for t, _ in others)]),
            np.concatenate([first[1], *(points[1:] for _, points in others)]),
        )
    count = (
        MAX_COARSE_POINTS * max(1, math.ceil(curve.total_turning / math.pi))
        if isinstance(curve, Traced)
        else MAX_COARSE_POINTS
    )
    return _spread(curve, psi, _CHEBYSHEV_GRID if count == MAX_COARSE_POINTS else np.linspace(0.0, 1.0, count))


def _spread(curve: ConicCurve, psi: Psi, t: Array) -> tuple[Array, Array]:
    """Parameters and picture points along a curve from t[0] to t[-1], as many as of t, moved to where it bends."""
    count = len(t)
    points = _onto_disc(psi, curve(t))
    for _ in range(PASSES):
        step = points[1:] - points[:-1]
        length = np.hypot(step[:, 0], step[:, 1])
        cross = step[1:, 0] * step[:-1, 1] - step[1:, 1] * step[:-1, 0]
        bend = np.abs(np.arctan2(cross, step[1:, 0] * step[:-1, 0] + step[1:, 1] * step[:-1, 1]))
        sag = np.zeros_like(length)  # of each segment: an eighth of its length times the turn at its ends
        sag[1:] = bend
        sag[:-1] = np.maximum(sag[:-1], bend)
        sag *= 0.125 * length
        if sag.max() < 0.5 * SAG:
            break
        share = np.sqrt(sag / sag.max()) + 0.1 * length / length.max() + 1e-3
        measure = np.concatenate([[0.0], np.cumsum(share)])
        t = np.interp(np.linspace(0.0, measure[-1], count), measure, t)
        points = _onto_disc(psi, curve(t))
    return t, points
