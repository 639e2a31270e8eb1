"""A mechanism's system in one call."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ..elinear import ELinear
from ..typed import System
from .formula_reading import Given, GivenMatrix, GivenRow
from .mechanism import Mechanism


def contact(
    M: GivenMatrix, J: GivenMatrix, force: GivenRow, mu: Given | GivenMatrix, normal: Given | GivenRow,
    velocities: Sequence[str], slow: Sequence[str] = (), rates: Mapping[str, Given] | tuple[()] = (),
    surface: GivenRow = (0.0, 0.0), parameters: Mapping[str, float] | tuple[()] = (),
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
