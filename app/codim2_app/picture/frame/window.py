"""The visible part of the picture: the scene is sampled there, as finely as the screen shows it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from codim2_core.scene import Scene

from ..draw.packing import Rectangle
from ..draw.theme import HALF_VIEW, MAX_HALF_VIEW, NEAREST, PICTURE_REACH

MOVING_PIXEL = 1 / 180  # of the whole picture, while something moves
WINDOW_ORBIT_LENGTH = 9.0  # of each half of an orbit in the whole picture
WINDOW_MARGIN = 0.25  # of its size, around a window: what a small pan shows at once


@dataclass(frozen=True)
class Window:
    """A rectangle of the picture, and the size of a pixel in it."""

    rectangle: Rectangle
    pixel: float

    @classmethod
    def read(cls, value: Any) -> Window | None:
        """Return the window of a request, [left, right, bottom, top, pixel]; None where it asks for the whole picture.

        What cannot be used is no window: a browser cannot ask for more than the tools of the plot allow.
        """
        if not isinstance(value, (list, tuple)) or len(value) != 5:
            return None
        try:
            left, right, bottom, top, pixel = map(float, value)
        except (TypeError, ValueError, OverflowError):
            return None
        sizes = right - left, top - bottom
        far = max(map(abs, (left, right, bottom, top)))
        if not (
            math.isfinite(pixel)
            and all(1.9 * NEAREST <= size <= 2.1 * MAX_HALF_VIEW for size in sizes)
            and far <= 3 * MAX_HALF_VIEW
        ):
            return None
        return cls((left, right, bottom, top), min(max(pixel, sizes[0] / 4000), sizes[0] / 100))

    @property
    def with_margin(self) -> Rectangle:
        """The rectangle with its margin."""
        left, right, bottom, top = self.rectangle
        x, y = WINDOW_MARGIN * (right - left), WINDOW_MARGIN * (top - bottom)
        return left - x, right + x, bottom - y, top + y

    def clip_curves(
        self, offsets: NDArray[np.int64], points: NDArray[np.float64]
    ) -> tuple[NDArray[Any], NDArray[Any], NDArray[np.int64]]:
        """Return the parts of curves that may be seen, as offsets and points, and which curve each is a part of."""
        if len(points) < 2:
            return offsets, points, np.arange(len(offsets) - 1)
        left, right, bottom, top = self.with_margin
        low, high = np.minimum(points[:-1], points[1:]), np.maximum(points[:-1], points[1:])
        seen = np.logical_and.reduce((high >= (left, bottom)) & (low <= (right, top)), axis=1)
        joints = offsets[1:-1] - 1
        seen[joints[(joints >= 0) & (joints < len(seen))]] = False
        edges = np.flatnonzero(np.diff(np.concatenate([[False], seen, [False]]).astype(np.int8)))
        begins, ends = edges[::2], edges[1::2] + 1  # a run of steps has one point more
        sizes = ends - begins
        cut = np.concatenate([[0], np.cumsum(sizes)])
        of = np.searchsorted(offsets, begins, side="right") - 1
        return cut, points[np.repeat(begins - cut[:-1], sizes) + np.arange(cut[-1])], of


def inputs(window: Window | None, rest: bool) -> dict[str, Any]:
    """Return the inputs of the scene for what is seen; what moves is drawn as finely as the whole picture is."""
    if window is None:
        return {"view": PICTURE_REACH, "pixel": MOVING_PIXEL, "window": None, "length": WINDOW_ORBIT_LENGTH}
    left, right, bottom, top = window.rectangle
    reach = max(PICTURE_REACH, 1.02 * math.hypot(max(-left, right), max(-bottom, top)))
    pixel = window.pixel * MOVING_PIXEL * 350 / HALF_VIEW
    return {
        "view": reach,
        "pixel": pixel if rest else max(MOVING_PIXEL, pixel),
        "window": window.rectangle,
        "length": WINDOW_ORBIT_LENGTH * reach / PICTURE_REACH,
    }


def resample_for_window(scene: Scene, window: Window | None, rest: bool) -> Scene:
    """Return the scene sampled where and as finely as it is seen."""
    wanted = inputs(window, rest)
    changes = {name: value for name, value in wanted.items() if getattr(scene, name) != value}
    return scene.evolve(**changes) if changes else scene
