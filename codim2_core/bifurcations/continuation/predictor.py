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
    lengths: Sequence[float], places: Sequence[CurvePoint], tangents: Sequence[CurvePoint], rate: float, step: float
) -> CurvePoint | None:
    """Predict the point a step after the last one, by it and one before; None where the section ends before."""
    last = len(lengths) - 1
    rows = [last, *(i for i in range(last - 1, -1, -1) if lengths[last] - lengths[i] > MIN_SPACING * step)][:2]
    near, along = ([column[i] for i in rows] for column in (places, tangents))
    return interpolate([lengths[i] for i in rows], near, along, rate, lengths[last] + step)


def interpolate(
    lengths: Sequence[float], places: Sequence[CurvePoint], tangents: Sequence[CurvePoint], rate: float, where: float
) -> CurvePoint | None:
    """Return the place at another length of the curve through some points; None beyond the section."""
    chi = places[0].chi
    # xi goes to infinity at C and at the equator: with chi there is what is left of it next to these two logarithms
    outer = 1.0 if chi < 0.5 else (1.0 / rate - 1.0 / chi) * (1.0 - chi)
    values, slopes = [], []
    for place, along in zip(places, tangents, strict=True):
        rest = place.xi - math.log(place.chi) + outer * math.log(1.0 - place.chi)
        by_rest = along.xi - (1.0 / place.chi + outer / (1.0 - place.chi)) * along.chi
        values.append((rest, place.chi, place.nu))
        slopes.append((by_rest, along.chi, along.nu))
    at = np.array(lengths) - lengths[0]
    rest, chi, nu = _hermite(at, np.array(values), np.array(slopes), where - lengths[0]).tolist()
    return CurvePoint(rest + math.log(chi) - outer * math.log(1.0 - chi), chi, nu) if 0.0 < chi < 1.0 else None


def _hermite(at: Array, values: Array, slopes: Array, where: float) -> Array:
    """Evaluate the polynomials of degree 2 m - 1 with values and slopes (m, q) at m places, by Newton's differences."""
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
    found = top[-1]
    for coefficient, place in zip(top[-2::-1], x[-2::-1], strict=True):
        found = coefficient + (where - place) * found
    return found
