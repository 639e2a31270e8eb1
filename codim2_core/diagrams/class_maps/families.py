"""The classes of any family of systems: of e-linear ones at once, of others point by point."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...layer_problem.vary import limits, names
from ...psi.function import Psi
from ...systems.affine import as_elinear
from ..family import family
from .plane_classes import PlaneClasses
from .typed_classes import TypedClasses

__all__ = ["classes_over"]


def classes_over(
    system: Any,
    psi: Psi,
    z: ArrayLike,
    varying: Sequence[str],
    spans: Sequence[Sequence[float]],
) -> PlaneClasses | TypedClasses:
    """Return the classes of a system over some names.

    Parameters
    ----------
    system : ELinear, System, Coefficients or Frozen
    psi : Psi
    z : (m,) floats
    varying : sequence of str
        Different ones of `layer_problem.vary.names`.
    spans : sequence of (low, high)

    Raises
    ------
    ValueError
        A name cannot be varied, a value is beyond what it may be, or z does not fit.
    """
    linear = as_elinear(system)
    if linear is not None:
        found = family(linear, psi, z, *varying, spans=spans)
        return PlaneClasses.over(found, tuple((float(low), float(high)) for low, high in spans))
    varying = ["z1" if name == "z" else name for name in varying]
    there = names(system, psi, z)
    for i, name in enumerate(varying):
        if name not in there:
            raise ValueError(f"{name!r} cannot be varied here; choose one of {', '.join(there)}.")
        if name in varying[:i]:
            raise ValueError(f"{name!r} is given twice; choose two different names.")
        low, high = limits(system, psi, name)
        if not all(np.isfinite(v) and low <= v <= high for v in spans[i]):
            raise ValueError(f"values of {name} are beyond {low:g} to {high:g}; give values between these.")
    return TypedClasses(system, psi, z, varying)
