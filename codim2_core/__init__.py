"""The dynamics near isolated codimension-2 discontinuity sets: the numerical core.

Follows N. Cheesman, K. Uldall Kristiansen and S. J. Hogan, "Regularisation of isolated codimension-2
discontinuity sets". Numbers in docstrings, such as (2.7) or Theorem 3.1, are the paper's.

A public name is imported when it is first requested (PEP 562): a program loads what it uses.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:  # for those who read types; `_MODULES` and `_HOMES` tell Python the same
    from . import bifurcations
    from .bifurcations.atlases.atlas import atlas
    from .bifurcations.atlases.result import Atlas, AtlasCurve, AtlasPoint, AtlasRegion
    from .bifurcations.census.census import Census, census
    from .bifurcations.diagrams.equilibrium_branches import branches
    from .bifurcations.diagrams.result import Branches
    from .motion import reference
    from .motion.contact_events import contact_events
    from .motion.delay import Delay
    from .motion.initial_value.events import Event
    from .motion.limit.predicted_delays import delays
    from .motion.periodic.lyapunov import LyapunovExponents, lyapunov_exponents
    from .motion.periodic.response import response_curve
    from .motion.periodic.result import PeriodicMotion, PeriodicStatus, ResponseCurve
    from .motion.periodic.search import periodic_motion
    from .motion.result import Phase, Simulation, SimulationStatus
    from .motion.simulate import simulate, simulate_nonsmooth
    from .motion.variation.propagators import Variation
    from .portrait.approach_outcomes import approach_outcomes
    from .portrait.basins import Basins, basins
    from .portrait.classify import Classification, Degeneracy, classify
    from .portrait.cycles.friction_law_comparison import LawVerdict, LawVerdicts, compare_laws
    from .portrait.cycles.limit_cycles import LimitCycle, LimitCycles, limit_cycles
    from .portrait.cycles.proof.result import Proof
    from .portrait.layer_problem import hemisphere
    from .portrait.layer_problem.closed_equator import EquatorCycle, equator_cycle
    from .portrait.layer_problem.critical import CriticalSet, critical_sets
    from .portrait.layer_problem.equator import EquatorEquilibria, equator_equilibria
    from .portrait.nullcline.nullclines import NullclineBranch, nullclines
    from .portrait.orbits.trajectories import Trajectories, trajectories
    from .portrait.separatrices import Separatrices, Separatrix, separatrices
    from .portrait.sliding.along_z import slow_portrait
    from .portrait.sliding.filippov import FilippovSliding, filippov_sliding, sliding_flow
    from .portrait.sliding.slow_portrait_result import SlowPortrait
    from .portrait.theorems.certificates import certificates, prove_portrait
    from .scene import Scene
    from .systems import examples, mechanics, psi
    from .systems.coefficients import Coefficients
    from .systems.elinear import ELinear
    from .systems.kinds import PsiLike, SystemLike
    from .systems.presets.preset import Preset
    from .systems.presets.presets import presets
    from .systems.psi.function import Psi
    from .systems.typed import Frozen, System

__version__ = "0.1.0"

__all__ = [
    "Atlas", "AtlasCurve", "AtlasPoint", "AtlasRegion", "Basins", "Branches", "Census", "Classification",
    "Coefficients", "CriticalSet", "Degeneracy", "Delay", "ELinear", "EquatorCycle", "EquatorEquilibria", "Event",
    "FilippovSliding", "Frozen", "LawVerdict", "LawVerdicts", "LimitCycle", "LimitCycles", "LyapunovExponents",
    "NullclineBranch", "PeriodicMotion", "PeriodicStatus", "Phase", "Preset", "Proof", "Psi", "PsiLike",
    "ResponseCurve", "Scene", "Separatrices", "Separatrix", "Simulation", "SimulationStatus", "SlowPortrait",
    "System", "SystemLike", "Trajectories", "Variation", "approach_outcomes", "atlas", "basins", "bifurcations",
    "branches", "census", "certificates", "classify", "compare_laws", "contact_events", "critical_sets", "delays",
    "equator_cycle", "equator_equilibria", "examples", "filippov_sliding", "hemisphere", "limit_cycles",
    "lyapunov_exponents", "mechanics", "nullclines", "periodic_motion", "presets", "prove_portrait", "psi",
    "reference", "response_curve", "separatrices", "simulate", "simulate_nonsmooth", "sliding_flow",
    "slow_portrait", "trajectories",
]  # fmt: skip

_MODULES = {
    "bifurcations": "bifurcations",
    "examples": "systems.examples",
    "hemisphere": "portrait.layer_problem.hemisphere",
    "mechanics": "systems.mechanics",
    "psi": "systems.psi",
    "reference": "motion.reference",
}
_HOMES = {
    "bifurcations.atlases.atlas": "atlas",
    "bifurcations.atlases.result": "Atlas AtlasCurve AtlasPoint AtlasRegion",
    "bifurcations.census.census": "Census census",
    "bifurcations.diagrams.equilibrium_branches": "branches",
    "bifurcations.diagrams.result": "Branches",
    "motion.contact_events": "contact_events",
    "motion.delay": "Delay",
    "motion.initial_value.events": "Event",
    "motion.limit.predicted_delays": "delays",
    "motion.periodic.lyapunov": "LyapunovExponents lyapunov_exponents",
    "motion.periodic.response": "response_curve",
    "motion.periodic.result": "PeriodicMotion PeriodicStatus ResponseCurve",
    "motion.periodic.search": "periodic_motion",
    "motion.result": "Phase Simulation SimulationStatus",
    "motion.simulate": "simulate simulate_nonsmooth",
    "motion.variation.propagators": "Variation",
    "portrait.approach_outcomes": "approach_outcomes",
    "portrait.basins": "Basins basins",
    "portrait.classify": "Classification Degeneracy classify",
    "portrait.cycles.friction_law_comparison": "LawVerdict LawVerdicts compare_laws",
    "portrait.cycles.limit_cycles": "LimitCycle LimitCycles limit_cycles",
    "portrait.cycles.proof.result": "Proof",
    "portrait.layer_problem.critical": "CriticalSet critical_sets",
    "portrait.layer_problem.closed_equator": "EquatorCycle equator_cycle",
    "portrait.layer_problem.equator": "EquatorEquilibria equator_equilibria",
    "portrait.nullcline.nullclines": "NullclineBranch nullclines",
    "portrait.orbits.trajectories": "Trajectories trajectories",
    "portrait.separatrices": "Separatrices Separatrix separatrices",
    "portrait.sliding.along_z": "slow_portrait",
    "portrait.sliding.filippov": "FilippovSliding filippov_sliding sliding_flow",
    "portrait.sliding.slow_portrait_result": "SlowPortrait",
    "portrait.theorems.certificates": "certificates prove_portrait",
    "scene": "Scene",
    "systems.coefficients": "Coefficients",
    "systems.elinear": "ELinear",
    "systems.kinds": "PsiLike SystemLike",
    "systems.presets.preset": "Preset",
    "systems.presets.presets": "presets",
    "systems.psi.function": "Psi",
    "systems.typed": "Frozen System",
}
_HOME = {name: home for home, names in _HOMES.items() for name in names.split()}

if not TYPE_CHECKING:

    def __getattr__(name: str) -> object:
        """Import a public name."""
        from importlib import import_module

        if name in _MODULES:
            found = import_module(f".{_MODULES[name]}", __name__)
        elif name in _HOME:
            from .systems.presets.presets import find_public

            found = find_public(__name__, _HOME[name], name)
        else:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        return globals().setdefault(name, found)  # one object, whichever thread was first: pickle compares


def __dir__() -> list[str]:
    """Return the public names; the rooms that hold them are importable, but no part of the API."""
    return ["__version__", *__all__]
