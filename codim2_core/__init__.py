"""The dynamics near isolated codimension-2 discontinuity sets: the numerical core.

Follows N. Cheesman, K. Uldall Kristiansen and S. J. Hogan, "Regularisation of isolated codimension-2
discontinuity sets"; docstrings give the paper's equation labels.
"""

from . import bifurcations, examples, hemisphere, psi
from .certificates import certificates
from .classify import Classification, Degeneracy, classify
from .critical import CriticalSet, critical_sets
from .cycles import LimitCycle, LimitCycles, limit_cycles
from .equator import EquatorCycle, EquatorEquilibria, equator_cycle, equator_equilibria
from .general import Frozen, System
from .nullclines import NullclineBranch, nullclines
from .outcomes import approach_outcomes
from .preset import Preset
from .presets import presets
from .regularisation import Psi
from .scene import Scene
from .separatrices import Separatrices, Separatrix, separatrices
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
    "Frozen",
    "LimitCycle",
    "LimitCycles",
    "NullclineBranch",
    "Preset",
    "Psi",
    "Scene",
    "Separatrices",
    "Separatrix",
    "System",
    "Trajectories",
    "approach_outcomes",
    "bifurcations",
    "certificates",
    "classify",
    "critical_sets",
    "equator_cycle",
    "equator_equilibria",
    "examples",
    "hemisphere",
    "limit_cycles",
    "nullclines",
    "presets",
    "psi",
    "separatrices",
    "sliding_flow",
    "trajectories",
]
