"""The dynamics near isolated codimension-2 discontinuity sets: the numerical core.

Follows N. Cheesman, K. Uldall Kristiansen and S. J. Hogan, "Regularisation of isolated codimension-2
discontinuity sets"; docstrings give the paper's equation labels.
"""

from . import bifurcations, examples, psi
from .arguments import guarded
from .counting.census import census
from .counting.table import Census
from .cycles.limit_cycles import LimitCycle, LimitCycles, limit_cycles
from .figures.preset import Preset
from .figures.presets import presets
from .initial_value.events import Event
from .layer_problem import hemisphere
from .layer_problem.critical import CriticalSet, critical_sets
from .layer_problem.equator import EquatorCycle, EquatorEquilibria, equator_cycle, equator_equilibria
from .motion.nonsmooth import simulate_nonsmooth
from .motion.regularised import simulate
from .motion.result import Phase, Simulation, SimulationStatus
from .nullcline.nullclines import NullclineBranch, nullclines
from .orbits.trajectories import Trajectories, trajectories
from .portrait.basins import Basins, basins
from .portrait.classify import Classification, Degeneracy, classify
from .portrait.outcomes import approach_outcomes
from .portrait.separatrices import Separatrices, Separatrix, separatrices
from .psi.function import Psi
from .scene import Scene
from .sliding.along import slow_portrait
from .sliding.filippov import FilippovSliding, filippov_sliding
from .sliding.flow import sliding_flow
from .sliding.slow_portrait_result import SlowPortrait
from .systems.coefficients import Coefficients
from .systems.elinear import ELinear
from .systems.typed import System
from .systems.typed_at_z import Frozen
from .theorems.certificates import certificates

__version__ = "0.1.0"

__all__ = [
    "Basins",
    "Census",
    "Classification",
    "Coefficients",
    "CriticalSet",
    "Degeneracy",
    "ELinear",
    "EquatorCycle",
    "EquatorEquilibria",
    "Event",
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
    "SimulationStatus",
    "SlowPortrait",
    "System",
    "Trajectories",
    "approach_outcomes",
    "basins",
    "bifurcations",
    "census",
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


globals().update(guarded(__name__, globals(), __all__))


def __dir__() -> list[str]:
    """Return the public names; the rooms that hold them are importable, but no part of the API."""
    return ["__version__", *__all__]
