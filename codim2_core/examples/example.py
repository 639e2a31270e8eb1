"""What an example is: a system, its ranges, and where to start."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from ..systems.elinear import ELinear
from ..systems.typed import System

GRAVITY = 9.81  # m/s²


@dataclass(frozen=True, slots=True)
class Example:
    """One example as the explorer offers it.

    Attributes
    ----------
    key, title, label : str
        The function's name, what people call it, and the paper's label or the literature.
    sentence : str
        What there is to see.
    make : callable
        The function; its keyword arguments are the parameters.
    ranges : mapping of str to (low, high)
        In which each parameter is interesting.
    z : tuple of float
        Where to start.
    slow : tuple of (symbol, low, high)
        Each slow variable and its range.
    launch : tuple of float
        A state (x, y, z1, …, zm) from which a motion is worth following.
    t_end : float
        For how long.
    """

    key: str
    title: str
    label: str
    sentence: str
    make: Callable[..., ELinear | System]
    ranges: Mapping[str, tuple[float, float]]
    z: tuple[float, ...]
    slow: tuple[tuple[str, float, float], ...]
    launch: tuple[float, ...]
    t_end: float
