"""Hermite's interpolation, and extrapolation, of a curve by points and their slopes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def hermite(at: Array, values: Array, slopes: Array, where: Array) -> Array:
    """Evaluate the polynomial of degree 2 m - 1 with given values and slopes at m places, by Newton's differences.

    Parameters
    ----------
    at : ndarray (m,)
        The places, all different.
    values, slopes : ndarray (m, q)
    where : ndarray (k,)
        Where it is wanted.

    Returns
    -------
    ndarray (k, q)
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
