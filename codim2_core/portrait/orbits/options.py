"""The eleven options of an integration of trajectories, checked once."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

PIXEL = 1.0 / 180.0
LEAST_PIXEL = 1e-10  # a line within a quarter of it has some 1e5 points
DEFAULT_MAX_STEPS = 10_000


@dataclass(frozen=True)
class Stepping:
    """Options of `trajectories` and `continuation`, which say what each means."""

    t_max: float = 8.0
    rtol: float = 1e-6
    atol: float = 1e-8
    backward: bool = False
    view: float = 2.0
    pixel: float = PIXEL
    capture: float | None = None
    samples: Literal["ends"] | None = None
    length: float = math.inf
    step_limit: int = DEFAULT_MAX_STEPS
    stiff: bool = False

    def __post_init__(self) -> None:
        _check_positive(self.t_max, "t_max", "give a finite positive time; backward=True follows trajectories backward")
        _check_positive(self.rtol, "rtol", "give a relative tolerance from 1e-14 to 0.1", 1e-14, 0.1)
        _check_positive(self.atol, "atol", "give an absolute tolerance from 1e-15 to 0.1", 1e-15, 0.1)
        _check_positive(self.view, "view", "give the finite half-width of the view, greater than 1 (the equator)", 1.0)
        _check_positive(
            self.pixel, "pixel", "give the size of a pixel in picture units, from 1e-10 to 1", LEAST_PIXEL, 1.0
        )
        if self.capture is not None:
            _check_positive(self.capture, "capture", "give a distance from an attractor, up to 0.1; or None", high=0.1)
        if not self.length > 0.0:
            raise ValueError(f"length is {self.length!r}; give a positive length in picture units, or leave it out.")
        if self.samples not in (None, "ends"):
            raise ValueError(f'samples is {self.samples!r}; give None for drawn lines or "ends" for the two ends.')
        if not 1 <= int(self.step_limit) <= 10**9:
            raise ValueError(f"step_limit is {self.step_limit!r}; give a number of steps from 1 to 1e9.")

    @property
    def reach(self) -> float:
        """Distance from an attracting equilibrium at which a trajectory ends."""
        return min(self.rtol + self.atol, 0.1) if self.capture is None else float(self.capture)


#: The same, made once: those of a picture are the same from frame to frame.
stepping = lru_cache(maxsize=64)(Stepping)


def _check_positive(value: float, what: str, remedy: str, low: float = 0.0, high: float = math.inf) -> None:
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = math.nan
    if not (math.isfinite(number) and low <= number <= high and number > 0.0):
        raise ValueError(f"{what} is {value!r}; {remedy}.")
