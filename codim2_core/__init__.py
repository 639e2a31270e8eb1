"""The dynamics near isolated codimension-2 discontinuity sets: the numerical core.

Follows N. Cheesman, K. Uldall Kristiansen and S. J. Hogan, "Regularisation of isolated codimension-2
discontinuity sets"; docstrings give the paper's equation labels.
"""

from . import hemisphere, psi
from .classify import Classification, Degeneracy, classify
from .critical import CriticalSet, critical_sets
from .equator import EquatorCycle, EquatorEquilibria, equator_cycle, equator_equilibria
from .nullclines import NullclineBranch, nullclines
from .presets import Preset, presets
from .regularisation import Psi
from .scene import Scene
from .sliding import sliding_flow
from .systems import Coefficients, ELinear
from .trajectories import Trajectories, trajectories

__all__ = [
    "Classification",
    "Coefficients",
    "CriticalSet",
    "Degeneracy",
    "ELinear",
    "EquatorCycle",
    "EquatorEquilibria",
    "NullclineBranch",
    "Preset",
    "Psi",
    "Scene",
    "Trajectories",
    "classify",
    "critical_sets",
    "equator_cycle",
    "equator_equilibria",
    "hemisphere",
    "nullclines",
    "presets",
    "psi",
    "sliding_flow",
    "trajectories",
]
