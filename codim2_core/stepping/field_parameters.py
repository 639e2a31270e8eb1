"""The numbers that a compiled right-hand side reads, and the unit of time in which it runs.

An e-linear field reads ``[a, b, d, f1, f2, parameter of Psi]``. A general one reads a factor (one over the unit of
speed, negative backward in time), at GAIN the address of the gain of Psi (so does an e-linear one whose lanes have a
Psi of their own), and its own numbers from OWN_NUMBERS on.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..systems.frozen import FrozenSystem
from ..systems.typed_formulas import MOST_NUMBERS

if TYPE_CHECKING:
    from ..psi.function import Psi

FACTOR, PSI, GAIN, OWN_NUMBERS = 0, 5, 6, 7
SHARED_SIZE = OWN_NUMBERS + MOST_NUMBERS + 1  # a multiple of 8


def field_numbers(at: FrozenSystem, psi: Psi, backward: bool, gain: int = 0) -> NDArray[np.float64]:
    """Return the parameters (SHARED_SIZE,) of a compiled field, scaled so that |U| is about 1.

    Parameters
    ----------
    at : Coefficients or Frozen
    psi : Psi
    backward : bool
        Against time.
    gain : int
        Address of the gain of Psi, of a field that calls it.
    """
    sign, unit = -1.0 if backward else 1.0, at.speed
    shared = np.zeros(SHARED_SIZE)
    shared[PSI], shared[GAIN] = psi.parameter, float(gain)  # exact: addresses have fewer than 53 bits
    if at.typed is None:
        shared[:5] = [sign * (value / unit) for value in at.numbers]
    else:
        shared[FACTOR] = sign / unit
        shared[OWN_NUMBERS : OWN_NUMBERS + len(at.numbers)] = at.numbers
    return shared
