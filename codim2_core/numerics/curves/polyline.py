"""Distances of points from polylines."""

from __future__ import annotations

import numpy as np

from ...results.arrays import Array


def feet(points: Array, line: Array) -> tuple[Array, Array, Array]:
    """Find the nearest place to points (..., n) on each piece of a polyline (m, n).

    parts: Of the piece: 0 at its start, 1 at its end; gaps: Distances.
    """
    start, along = line[:-1], np.diff(line, axis=0)
    away = points[..., None, :] - start
    parts = np.clip((away * along).sum(axis=-1) / np.maximum((along**2).sum(axis=1), 1e-300), 0.0, 1.0)
    shares = parts[..., None] * along
    return parts, start + shares, np.sqrt(((away - shares) ** 2).sum(axis=-1))


def distance(points: Array, line: Array) -> Array:
    """Return the distances of points (..., n) from a polyline (m, n)."""
    return feet(points, line)[2].min(axis=-1)
