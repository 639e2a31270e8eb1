"""The dynamics near isolated codimension-2 discontinuity sets: the numerical core.

Follows N. Cheesman, K. Uldall Kristiansen and S. J. Hogan, "Regularisation of isolated codimension-2
discontinuity sets". Numbers in docstrings, such as (2.7) or Theorem 3.1, are the paper's.

A public name is imported when it is first requested (PEP 562): a program loads what it uses.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:  # for those who read types; `_MODULES` and `_HOMES` tell Python the same
    from . import bifurcations, examples, mechanics, psi, reference
    from .atlases.atlas import Atlas, AtlasCurve, AtlasPoint, AtlasRegion, atlas
    from .counting.census import census
    from .counting.table import Census
    from .cycles.friction_law_comparison import LawVerdict, LawVerdicts, compare_laws
    from .cycles.limit_cycles import LimitCycle, LimitCycles, limit_cycles
    from .cycles.proof.result import Proof
    from .diagrams.bifurcation_diagram import branches
    from .diagrams.result import Branches
    from .figures.preset import Preset
    from .figures.presets import presets
    from .initial_value.events import Event
    from .layer_problem import hemisphere
    from .layer_problem.critical import CriticalSet, critical_sets
    from .layer_problem.equator import EquatorCycle, EquatorEquilibria, equator_cycle, equator_equilibria
    from .motion.contact_events import contact_events
    from .motion.delay import Delay
    from .motion.limit.predicted_delays import delays
    from .motion.periodic.lyapunov import LyapunovExponents, lyapunov_exponents
    from .motion.periodic.response import response_curve
    from .motion.periodic.response_result import ResponseCurve
    from .motion.periodic.result import PeriodicMotion, PeriodicStatus
    from .motion.periodic.search import periodic_motion
    from .motion.result import Phase, Simulation, SimulationStatus
    from .motion.simulate import simulate, simulate_nonsmooth
    from .motion.variation.result import Variation
    from .nullcline.nullclines import NullclineBranch, nullclines
    from .orbits.trajectories import Trajectories, trajectories
    from .portrait.approach_outcomes import approach_outcomes
    from .portrait.basins import Basins, basins
    from .portrait.classify import Classification, Degeneracy, classify
    from .portrait.separatrices import Separatrices, Separatrix, separatrices
    from .psi.function import Psi
    from .scene import Scene
    from .sliding.along_z import slow_portrait
    from .sliding.filippov import FilippovSliding, filippov_sliding
    from .sliding.flow import sliding_flow
    from .sliding.slow_portrait_result import SlowPortrait
    from .systems.coefficients import Coefficients
    from .systems.elinear import ELinear
    from .systems.typed import System
    from .systems.typed_at_z import Frozen
    from .theorems.certificates import certificates
    from .theorems.portrait_proof import prove_portrait

__version__ = "0.1.0"

__all__ = [
    "Atlas",
    "AtlasCurve",
    "AtlasPoint",
    "AtlasRegion",
    "Basins",
    "Branches",
    "Census",
    "Classification",
    "Coefficients",
    "CriticalSet",
    "Degeneracy",
    "Delay",
    "ELinear",
    "EquatorCycle",
    "EquatorEquilibria",
    "Event",
    "FilippovSliding",
    "Frozen",
    "LawVerdict",
    "LawVerdicts",
    "LimitCycle",
    "LimitCycles",
    "LyapunovExponents",
    "NullclineBranch",
    "PeriodicMotion",
    "PeriodicStatus",
    "Phase",
    "Preset",
    "Proof",
    "Psi",
    "ResponseCurve",
    "Scene",
    "Separatrices",
    "Separatrix",
    "Simulation",
    "SimulationStatus",
    "SlowPortrait",
    "System",
    "Trajectories",
    "Variation",
    "approach_outcomes",
    "atlas",
    "basins",
    "bifurcations",
    "branches",
    "census",
    "certificates",
    "classify",
    "compare_laws",
    "contact_events",
    "critical_sets",
    "delays",
    "equator_cycle",
    "equator_equilibria",
    "examples",
    "filippov_sliding",
    "hemisphere",
    "limit_cycles",
    "lyapunov_exponents",
    "mechanics",
    "nullclines",
    "periodic_motion",
    "presets",
    "prove_portrait",
    "psi",
    "reference",
    "response_curve",
    "separatrices",
    "simulate",
    "simulate_nonsmooth",
    "sliding_flow",
    "slow_portrait",
    "trajectories",
]

_MODULES = {
    "bifurcations": "bifurcations",
    "examples": "examples",
    "hemisphere": "layer_problem.hemisphere",
    "mechanics": "mechanics",
    "psi": "psi",
    "reference": "reference",
}
_HOMES = {
    "atlases.atlas": "Atlas AtlasCurve AtlasPoint AtlasRegion atlas",
    "counting.census": "census",
    "counting.table": "Census",
    "cycles.friction_law_comparison": "LawVerdict LawVerdicts compare_laws",
    "cycles.limit_cycles": "LimitCycle LimitCycles limit_cycles",
    "cycles.proof.result": "Proof",
    "diagrams.bifurcation_diagram": "branches",
    "diagrams.result": "Branches",
    "figures.preset": "Preset",
    "figures.presets": "presets",
    "initial_value.events": "Event",
    "layer_problem.critical": "CriticalSet critical_sets",
    "layer_problem.equator": "EquatorCycle EquatorEquilibria equator_cycle equator_equilibria",
    "motion.contact_events": "contact_events",
    "motion.delay": "Delay",
    "motion.limit.predicted_delays": "delays",
    "motion.periodic.lyapunov": "LyapunovExponents lyapunov_exponents",
    "motion.periodic.response": "response_curve",
    "motion.periodic.response_result": "ResponseCurve",
    "motion.periodic.result": "PeriodicMotion PeriodicStatus",
    "motion.periodic.search": "periodic_motion",
    "motion.result": "Phase Simulation SimulationStatus",
    "motion.simulate": "simulate simulate_nonsmooth",
    "motion.variation.result": "Variation",
    "nullcline.nullclines": "NullclineBranch nullclines",
    "orbits.trajectories": "Trajectories trajectories",
    "portrait.basins": "Basins basins",
    "portrait.classify": "Classification Degeneracy classify",
    "portrait.approach_outcomes": "approach_outcomes",
    "portrait.separatrices": "Separatrices Separatrix separatrices",
    "psi.function": "Psi",
    "scene": "Scene",
    "sliding.along_z": "slow_portrait",
    "sliding.filippov": "FilippovSliding filippov_sliding",
    "sliding.flow": "sliding_flow",
    "sliding.slow_portrait_result": "SlowPortrait",
    "systems.coefficients": "Coefficients",
    "systems.elinear": "ELinear",
    "systems.typed": "System",
    "systems.typed_at_z": "Frozen",
    "theorems.certificates": "certificates",
    "theorems.portrait_proof": "prove_portrait",
}
_HOME = {name: home for home, names in _HOMES.items() for name in names.split()}

if not TYPE_CHECKING:

    def __getattr__(name: str) -> object:
        """Import a public name; a function comes with the checks of what it is given."""
        from importlib import import_module

        if name in _MODULES:
            found = import_module(f".{_MODULES[name]}", __name__)
        elif name in _HOME:
            from .arguments import checked_functions
            from .figures.named import named_setting

            one = {name: getattr(import_module(f".{_HOME[name]}", __name__), name)}
            found = (one | checked_functions(__name__, one, one, named_setting))[name]
        else:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        return globals().setdefault(name, found)  # one object, whichever thread was first: pickle compares


def __dir__() -> list[str]:
    """Return the public names; the rooms that hold them are importable, but no part of the API."""
    return ["__version__", *__all__]
