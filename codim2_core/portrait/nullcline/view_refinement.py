"""Nullclines as finely as they are seen: points where a part of the picture is looked at closely, and nowhere else."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...results.arrays import Array
from ...systems.frozen import FrozenSystem
from ...systems.psi.function import Psi
from .conics import ConicCurve
from .general_nullclines import Kind

PIXEL_TOLERANCE = 0.25  # of a pixel: a polyline stays within it of its curve
WINDOW_MARGIN = 0.5  # of the window, next to it: what a small pan shows
MAX_BRANCH_POINTS = 4000  # points of a branch
PASSES = 12  # each cuts a step in three
DIFFERENCE_STEP = 1e-6  # of differences of a component
NEWTON_STEPS = 3  # steps: a traced curve is known to 1e-5, and the last step squares what the gradient is off by


@dataclass(frozen=True, slots=True)
class Seen:
    """A part of the picture that is looked at closely: (left, right, bottom, top), and the size of a pixel there."""

    window: tuple[float, float, float, float]
    pixel: float

    def steps_in_view(self, points: Array) -> NDArray[np.bool_]:
        """Tell which steps between neighbouring points (n, 2) may be seen; (n - 1,)."""
        left, right, bottom, top = self.window
        x, y = WINDOW_MARGIN * (right - left), WINDOW_MARGIN * (top - bottom)
        low, high = np.minimum(points[:-1], points[1:]), np.maximum(points[:-1], points[1:])
        bulge = 0.3 * np.hypot(*(points[1:] - points[:-1]).T)[:, None]  # a step may bend out of its box
        inside = (high + bulge >= (left - x, bottom - y)) & (low - bulge <= (right + x, top + y))
        return inside.all(axis=1)


def to_picture(psi: Psi, e: Array) -> Array:
    """Return the points of the picture at points of the closed e-disc, to rounding."""
    if psi.record.identity:
        return e
    m = np.hypot(e[:, 0], e[:, 1])
    moves = (m > 0.0) & (m < 1.0 - 1e-15)
    zeta = np.asarray(psi.radius(np.where(moves, m, 0.5)), float)
    r = np.where(m < 1.0 - 1e-15, zeta / np.hypot(1.0, zeta), 1.0)
    return e * np.where(moves | (m >= 0.5), r / np.where(m > 0.0, m, 1.0), 1.0)[:, None]


def on_component(at: FrozenSystem, kind: Kind, inside: bool) -> Callable[[Array], Array]:
    """Return what brings points close to a traced curve onto it: Newton's method along the gradient."""

    def component(points: Array) -> Array:
        if inside:
            e, xy = points, None
        else:
            r = np.hypot(*points.T)[:, None]
            e, xy = points / r, points * (r - 1.0) / r
        U = at.U(e, xy)
        if kind in ("U1", "U2"):
            return U[:, int(kind[1]) - 1]
        c, s = e.T
        return c * U[:, 0] + s * U[:, 1] if kind == "rho" else c * U[:, 1] - s * U[:, 0]

    def correct_points(points: Array) -> Array:
        first = points
        for _ in range(NEWTON_STEPS):
            value = component(points)
            slopes = [
                (component(points + DIFFERENCE_STEP * v) - component(points - DIFFERENCE_STEP * v))
                / (2.0 * DIFFERENCE_STEP)
                for v in np.eye(2)
            ]
            gradient = np.stack(slopes, axis=-1)
            square = (gradient**2).sum(axis=1)
            step = gradient * np.divide(value, square, out=np.zeros_like(value), where=square > 0.0)[:, None]
            points = points - np.where(np.isfinite(step) & (np.abs(step) < 1e-3), step, 0.0)
        return np.where((np.hypot(*(points - first).T) < 1e-3)[:, None], points, first)

    return correct_points


def refine_curve(curve: ConicCurve, place: Callable[[Array], Array], t: Array, points: Array, seen: Seen) -> Array:
    """Return picture points along a curve of which t and points are a coarse sample, closer where they are seen.

    At most `MAX_BRANCH_POINTS`. Both ends stay. Shapes: t (n,), points (n, 2).
    """
    ends = points[0], points[-1]
    points = place(curve(t))
    points[0], points[-1] = ends
    open_ = np.ones(len(t) - 1, bool)  # steps that have not been looked at
    for _ in range(PASSES):
        cut = np.flatnonzero(open_ & seen.steps_in_view(points) & (np.diff(t) > 1e-15))
        if not len(cut) or len(t) + 2 * len(cut) > MAX_BRANCH_POINTS:
            break
        thirds = t[cut, None] + (t[cut + 1] - t[cut])[:, None] * (1.0 / 3.0, 2.0 / 3.0)
        between = place(curve(thirds.ravel())).reshape(-1, 2, 2)
        bent = _away(points[cut], points[cut + 1], between) > PIXEL_TOLERANCE * seen.pixel
        open_[cut] = bent
        steps = np.ones(len(t) - 1, np.intp)
        steps[cut[bent]] = 3
        at = np.concatenate([np.zeros(1, np.intp), np.cumsum(steps)])
        new = at[cut[bent], None] + (1, 2)
        old_t, old_points = t, points
        t, points = np.empty(at[-1] + 1), np.empty((at[-1] + 1, 2))
        t[at], points[at] = old_t, old_points
        t[new], points[new] = thirds[bent], between[bent]
        open_ = np.repeat(open_, steps)
    return points


def _away(start: Array, end: Array, between: Array) -> Array:
    """Return how far points (k, n, 2) lie from the chords of their steps, at most; (k,)."""
    along, off = end - start, between - start[:, None]
    length = np.hypot(along[:, 0], along[:, 1])
    across = np.abs(off[:, :, 0] * along[:, None, 1] - off[:, :, 1] * along[:, None, 0]).max(axis=1)
    whole = np.hypot(off[:, :, 0], off[:, :, 1]).max(axis=1)
    return np.where(length > 0.0, across / np.where(length > 0.0, length, 1.0), whole)
