"""The numbers that a compiled right-hand side reads, and the unit of time in which it runs.

An e-linear field reads ``[a, b, d, f1, f2, parameter of Psi]``. A general one reads a factor (one over the unit of
speed, negative backward in time), at GAIN the address of the gain of Psi, and its own numbers from OWN on.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..systems.coefficients import Coefficients
from ..systems.typed import MOST_NUMBERS

if TYPE_CHECKING:
    from ..psi.function import Psi
    from ..systems.typed import Frozen

FACTOR, PSI, GAIN, OWN = 0, 5, 6, 7
SHARED = OWN + MOST_NUMBERS + 1  # a multiple of 8


def rate(at: Coefficients | Frozen) -> float:
    """Return the speed that compiled fields count in, |(a, b, d, f1, f2)| or the largest |U|; 1 where all is zero."""
    if not isinstance(at, Coefficients):
        return at.size or 1.0
    size = max(map(abs, at.plane)) or 1.0
    return size * math.hypot(*(value / size for value in at.plane)) or 1.0


def numbers(at: Coefficients | Frozen, psi: Psi, backward: bool, gain: int = 0) -> NDArray[np.float64]:
    """Return the parameters (SHARED,) of a compiled field, scaled so that |U| is about 1.

    Parameters
    ----------
    at : Coefficients or Frozen
    psi : Psi
    backward : bool
        Against time.
    gain : int
        Address of the gain of Psi, which a general system's field calls.
    """
    sign, unit = -1.0 if backward else 1.0, rate(at)
    shared = np.zeros(SHARED)
    shared[PSI] = psi.parameter
    if isinstance(at, Coefficients):
        shared[:5] = [sign * (value / unit) for value in at.plane]
    else:
        shared[FACTOR], shared[GAIN] = sign / unit, float(gain)  # exact: addresses have fewer than 53 bits
        shared[OWN : OWN + len(at.numbers)] = at.numbers
    return shared
