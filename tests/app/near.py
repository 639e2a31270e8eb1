"""How far points are from curves."""

import numpy as np


def gaps(points, curves):
    """The distance of each point from the nearest of some polylines."""
    best = np.full(len(points), np.inf)
    for curve in map(np.asarray, curves):
        if len(curve) > 1:
            start, step = curve[:-1], np.diff(curve, axis=0)
            offset = np.asarray(points)[:, None] - start
            along = np.clip((offset * step).sum(axis=2) / np.maximum((step**2).sum(axis=1), 1e-300), 0.0, 1.0)
            best = np.minimum(best, np.hypot(*np.moveaxis(offset - along[..., None] * step, 2, 0)).min(axis=1))
    return best
