"""The dynamics near isolated codimension-2 discontinuity sets: the numerical core.

Follows N. Cheesman, K. Uldall Kristiansen and S. J. Hogan, "Regularisation of isolated codimension-2
discontinuity sets"; docstrings give the paper's equation labels.
"""

from . import bifurcations, examples, hemisphere, psi
from .basins import Basins, basins
from .certificates import certificates
from .classify import Classification, Degeneracy, classify
from .critical import CriticalSet, critical_sets
from .cycles import LimitCycle, LimitCycles, limit_cycles
from .equator import EquatorCycle, EquatorEquilibria, equator_cycle, equator_equilibria
from .filippov import FilippovSliding, filippov_sliding
from .general import Frozen, System
from .nonsmooth import simulate_nonsmooth
from .nullclines import NullclineBranch, nullclines
from .outcomes import approach_outcomes
from .preset import Preset
from .presets import presets
from .regularisation import Psi
from .scene import Scene
from .separatrices import Separatrices, Separatrix, separatrices
from .simulate import simulate
from .simulation_result import Phase, Simulation
from .sliding import sliding_flow
from .slow import SlowPortrait, slow_portrait
from .systems import Coefficients, ELinear
from .trajectories import Trajectories, trajectories

__all__ = [
    "Basins",
    "Classification",
    "Coefficients",
    "CriticalSet",
    "Degeneracy",
    "ELinear",
    "EquatorCycle",
    "EquatorEquilibria",
    "FilippovSliding",
    "Frozen",
    "LimitCycle",
    "LimitCycles",
    "NullclineBranch",
    "Phase",
    "Preset",
    "Psi",
    "Scene",
    "Separatrices",
    "Separatrix",
    "Simulation",
    "SlowPortrait",
    "System",
    "Trajectories",
    "approach_outcomes",
    "basins",
    "bifurcations",
    "certificates",
    "classify",
    "critical_sets",
    "equator_cycle",
    "equator_equilibria",
    "examples",
    "filippov_sliding",
    "hemisphere",
    "limit_cycles",
    "nullclines",
    "presets",
    "psi",
    "separatrices",
    "simulate",
    "simulate_nonsmooth",
    "sliding_flow",
    "slow_portrait",
    "trajectories",
]
