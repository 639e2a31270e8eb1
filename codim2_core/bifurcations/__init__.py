"""Bifurcations of the e-linear system in the plane (f1, f2), for given a, b, d and Psi (Section 4.4).

The saddle-node curve of equator equilibria and the ellipse |A^-1 f| = 1 are closed forms and cut the plane into the
regions of `regions`, which do not depend on Psi. `hopf` and `node_focus` depend on Psi (Case III), one root a point.
Limit cycles vanish on `cycle_folds`, and at the equator on `closed_equator` and `heteroclinic`; these three are
followed by continuation, which takes seconds where the others take milliseconds.
"""

from __future__ import annotations

from ..arguments import checked_functions
from ..figures.named import named_setting
from .curve import BifurcationCurve, SpecialPoint
from .parameter_changes import ParameterChange, hill_changes, parameter_changes
from .plane_curves import (
    closed_equator,
    critical_boundary,
    cycle_folds,
    heteroclinic,
    hopf,
    node_focus,
    saddle_node,
)
from .regions import Region, regions

__all__ = [
    "BifurcationCurve",
    "ParameterChange",
    "Region",
    "SpecialPoint",
    "closed_equator",
    "critical_boundary",
    "cycle_folds",
    "heteroclinic",
    "hill_changes",
    "hopf",
    "node_focus",
    "parameter_changes",
    "regions",
    "saddle_node",
]

globals().update(checked_functions(__name__, globals(), __all__, named_setting))


def __dir__() -> list[str]:
    """Return the public names, for the Tab key."""
    return list(__all__)
