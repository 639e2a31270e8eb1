"""The numbers that a compiled right-hand side reads, and the unit of time in which it runs.

An e-linear field reads ``[a, b, d, f1, f2, parameter of Psi]``. A general one reads a factor (one over the unit of
speed, negative backward in time), at FORMULAS the address of its packed formulas, and at GAIN that of the gain of Psi
(so does an e-linear one whose lanes have a Psi of their own). A typed Psi has the address of its own packed formula in
the place of a parameter.
"""

from __future__ import annotations

import numpy as np

from ...results.arrays import Array
from ...systems.frozen import FrozenSystem

FACTOR, PSI, GAIN, FORMULAS, SHARED_SIZE = 0, 5, 6, 7, 8


def field_numbers(at: FrozenSystem, parameter: float, backward: bool, gain: int = 0, formulas: int = 0) -> Array:
    """Return the parameters (SHARED_SIZE,) of a compiled field, scaled so that |U| is about 1."""
    sign, unit = -1.0 if backward else 1.0, at.speed
    shared = np.zeros(SHARED_SIZE)
    shared[PSI:] = parameter, gain, formulas  # exact: addresses have fewer than 53 bits
    if at.as_given is None:
        shared[FACTOR] = sign / unit
    else:
        shared[:PSI] = [sign * (value / unit) for value in at.as_given.plane]
    return shared
