"""Sliding: the slow flow along a critical set."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .critical import locate
from .systems import Coefficients, ELinear


def sliding_flow(system: ELinear | Coefficients, z: ArrayLike = ()) -> NDArray[np.float64] | None:
    """Z' along the critical set, eq:linslowflow: ``-B A^-1 f + g``, the Filippov convention, whatever Psi is.

    It is also the mean of z' over a limit cycle of the layer problem (prop:LC).

    Parameters
    ----------
    system : ELinear, or Coefficients
    z : (m,) floats

    Returns
    -------
    ndarray (m,), or None
        None where there is no critical set: nothing slides there.
    """
    coefficients = system.at(z)
    location = locate(coefficients)
    if location.e is None:
        return None
    flow = coefficients.W(location.e)
    flow.flags.writeable = False
    return flow
