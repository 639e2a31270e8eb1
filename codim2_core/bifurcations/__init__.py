"""Many settings: curves in a plane of parameters, diagrams along one, atlases over two, censuses.

The public names are the bifurcations of the e-linear system in the plane (f1, f2), for given a, b, d and Psi (Section
4.4). The saddle-node curve of equator equilibria and the ellipse |A^-1 f| = 1 are closed forms and cut the plane into
the regions of `regions`, which do not depend on Psi. `hopf` and `node_focus` depend on Psi (Case III), one root a
point. Limit cycles vanish on `cycle_folds`, and at the equator on `closed_equator` and `heteroclinic`; these three are
followed by continuation, which takes seconds where the others take milliseconds.
"""

from typing import TYPE_CHECKING

from ..systems.presets.presets import find_public

if TYPE_CHECKING:  # for those who read types; `_HOMES` gives Python the same
    from .plane.curve import BifurcationCurve, SpecialPoint
    from .plane.parameter_changes import ParameterChange, hill_changes, parameter_changes
    from .plane.plane_curves import (
        closed_equator,
        critical_boundary,
        cycle_folds,
        heteroclinic,
        hopf,
        node_focus,
        saddle_node,
    )
    from .plane.regions import Region, regions

__all__ = [
    "BifurcationCurve", "ParameterChange", "Region", "SpecialPoint", "closed_equator", "critical_boundary",
    "cycle_folds", "heteroclinic", "hill_changes", "hopf", "node_focus", "parameter_changes", "regions",
    "saddle_node",
]  # fmt: skip

_HOMES = {
    "plane.curve": "BifurcationCurve SpecialPoint",
    "plane.parameter_changes": "ParameterChange hill_changes parameter_changes",
    "plane.plane_curves": ("closed_equator critical_boundary cycle_folds heteroclinic hopf node_focus saddle_node"),
    "plane.regions": "Region regions",
}
_HOME = {name: home for home, names in _HOMES.items() for name in names.split()}

if not TYPE_CHECKING:

    def __getattr__(name: str) -> object:
        """Import a public name."""
        if name not in _HOME:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        return globals().setdefault(name, find_public(__name__, _HOME[name], name))


def __dir__() -> list[str]:
    """Return the public names, for the Tab key."""
    return list(__all__)
