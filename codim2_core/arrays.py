"""Arrays of numbers, as results hold them."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


def read_only(array: Array) -> Array:
    """Return an array that cannot be written to any more."""
    array.flags.writeable = False
    return array
