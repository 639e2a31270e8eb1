"""Predictor for curves of cycles: points ahead and in between, by some of its points and their tangents."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ...results.arrays import Array

MIN_SPACING = 0.25  # of a step: how far from one another they are, at least: a fold may lie next to one


class CurvePoint(NamedTuple):
    """A place of the curve, or its derivative by the length: xi and chi of `turns.ReturnMapPoint`, and nu."""

    xi: float
    chi: float
    nu: float


def predict(
    lengths: Sequence[float],
    places: Sequence[CurvePoint],
    tangents: Sequence[CurvePoint],
    rate: float,
    steps: Sequence[float],
    behind: int,
) -> list[CurvePoint]:
    """Predict points after the last one; fewer than requested where the section ends before."""
    rows = [len(lengths) - 1]
    for i in range(len(lengths) - 2, -1, -1):
        if len(rows) == behind:
            break
        if lengths[rows[-1]] - lengths[i] > MIN_SPACING * steps[0]:
            rows.append(i)
    at = [lengths[i] for i in rows]
    return interpolate(
        at, [places[i] for i in rows], [tangents[i] for i in rows], rate, (lengths[-1] + np.cumsum(steps)).tolist()
    )


def interpolate(
    lengths: Sequence[float],
    places: Sequence[CurvePoint],
    tangents: Sequence[CurvePoint],
    rate: float,
    where: Sequence[float],
) -> list[CurvePoint]:
    """Find the curve through some points at other lengths; as far as the section goes."""
    chi = places[0].chi
    # xi goes to infinity at C and at the equator: with chi there is what is left of it next to these two logarithms
    outer = 1.0 if chi < 0.5 else (1.0 / rate - 1.0 / chi) * (1.0 - chi)
    values, slopes = [], []
    for place, along in zip(places, tangents, strict=True):
        rest = place.xi - math.log(place.chi) + outer * math.log(1.0 - place.chi)
        by_rest = along.xi - (1.0 / place.chi + outer / (1.0 - place.chi)) * along.chi
        values.append((rest, place.chi, place.nu))
        slopes.append((by_rest, along.chi, along.nu))
    at, wanted = np.array(lengths) - lengths[0], np.array(where) - lengths[0]
    found = []
    for rest, chi, nu in _hermite(at, np.array(values), np.array(slopes), wanted).tolist():
        if not 0.0 < chi < 1.0:
            break
        found.append(CurvePoint(rest + math.log(chi) - outer * math.log(1.0 - chi), chi, nu))
    return found


def _hermite(at: Array, values: Array, slopes: Array, where: Array) -> Array:
    """Evaluate the polynomial of degree 2 m - 1 with given values and slopes at m places, by Newton's differences.

    Shapes: at (m,), values, slopes (m, q), where (k,).
    """
    x = np.repeat(at, 2)
    column = np.repeat(values, 2, axis=0)
    top = [column[0]]
    for order in range(1, len(x)):
        width = (x[order:] - x[:-order])[:, None]
        if order == 1:
            difference = np.diff(column, axis=0)
            difference[1::2] /= width[1::2]
            difference[::2] = slopes
            column = difference
        else:
            column = np.diff(column, axis=0) / width
        top.append(column[0])
    found = np.broadcast_to(top[-1], (len(where), values.shape[1]))
    for coefficient, place in zip(top[-2::-1], x[-2::-1], strict=True):
        found = coefficient + (where - place)[:, None] * found
    return found
