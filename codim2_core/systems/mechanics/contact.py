"""A mechanism's system in one call."""

from __future__ import annotations

from typing import Any

from ..elinear import ELinear
from ..typed import System
from .mechanism import Mechanism


def contact(
    M: Any, J: Any, force: Any, mu: Any, normal: Any, velocities: Any, slow: Any = (), rates: Any = (),
    surface: Any = (0.0, 0.0), parameters: Any = (),
) -> ELinear | System:  # fmt: skip
    """Return the system of a mechanism with dry friction at one point of contact: that of a `Mechanism`.

    Parameters
    ----------
    M, J, force, mu, normal, velocities, slow, rates, surface, parameters
        As for `Mechanism`.

    Returns
    -------
    ELinear or System
        ELinear where U and W are linear in e and the matrix has the normal form; z1, z2, ... are `slow`, in its order.

    Raises
    ------
    ValueError
        As for `Mechanism`.

    Examples
    --------
    A block on the ground, 2 kg, pulled with 9 N:

    >>> block = contact(((2, 0), (0, 2)), ((1, 0), (0, 1)), ("F", 0), "mu", "2*g", ("vx", "vy"),
    ...                 parameters={"F": 9.0, "mu": 0.5, "g": 9.81})
    >>> block.at().f.tolist(), block.at().a
    ([4.5, 0.0], -4.905)
    """
    return Mechanism(M, J, force, mu, normal, velocities, slow, rates, surface, parameters).system
