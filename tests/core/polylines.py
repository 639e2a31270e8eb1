"""How far points are from lines that are drawn."""

import numpy as np


def away(points, line):
    """Distances of points (n, 2) from a polyline."""
    start, along = line[:-1], np.diff(line, axis=0)
    there = np.asarray(points)[:, None] - start
    part = np.clip((there * along).sum(axis=2) / np.maximum((along**2).sum(axis=1), 1e-300), 0.0, 1.0)
    return np.sqrt(((there - part[..., None] * along) ** 2).sum(axis=2)).min(axis=1)
