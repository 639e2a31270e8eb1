"""The layers of a picture: which inputs each reads, and how it is made from a setting."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from ..portrait.approach_outcomes import outcomes_of
from ..portrait.classify import portrait, portrait_name
from ..portrait.cycles.limit_cycles import closed_orbits, cycles_of
from ..portrait.layer_problem.eigendirections import find_eigendirections
from ..portrait.layer_problem.problem import find_critical, find_equator, find_equator_cycle, find_location
from ..portrait.nullcline.conics import Conics, conics_of
from ..portrait.nullcline.nullclines import Seen, inside_nullclines, outside_nullclines
from ..portrait.separatrices import separatrices_of
from ..portrait.sliding.filippov import flow_on
from ..portrait.theorems.certificates import Certificate, certificates_of
from .launched_orbits import SceneSetting, continuations, launched_orbits, orbits, seeds_of


@dataclass(frozen=True, slots=True)
class Recipe:
    """One layer: the names of the inputs it reads, and how it is made.

    What a layer finds in ``setting.problem`` is kept for the others (`found_once`): here it is computed.
    """

    inputs: tuple[str, ...]
    compute: Callable[[SceneSetting], Any]


# The values that layers read, as keys: `plane` is (a, b, d, f1, f2) at z, or the formulas of U and the numbers that
# they read, with where limit directions are counted from: z itself reaches nothing but what looks along z, `place`.
INPUTS: Mapping[str, Callable[[SceneSetting], Hashable]] = {
    "plane": lambda s: (s.coefficients.key, s.cut),
    "slow": lambda s: s.coefficients.slow_key,
    "place": lambda s: (s.system, s.z) if s.system.moves_with_z else None,
    "psi": lambda s: (s.psi.family, s.psi.parameter, s.psi.text),  # what makes two equal, as numbers and text
    "inner seeds": lambda s: (s.count, s.window) if s.seeds is None else seeds_of(s, outside=False).tobytes(),
    "outer seeds": lambda s: (s.count, s.window) if s.seeds is None else seeds_of(s, outside=True).tobytes(),
    "launch": lambda s: s.launch.tobytes(),
    "time": lambda s: (s.t_max, s.length),
    "tolerance": lambda s: (s.rtol, s.atol),
    "view": lambda s: s.view,
    "pixel": lambda s: s.pixel,
    "closely": lambda s: seen_closely(s),
}
#: Pixels across what is seen.
ACROSS = 720
_STEPPED = ("time", "tolerance", "pixel")


def seen_closely(setting: SceneSetting) -> Seen | None:
    """Return what is looked at more closely than the whole picture, whether something moves or not."""
    if setting.window is None:
        return None
    left, right, bottom, top = setting.window
    pixel = max(right - left, top - bottom) / ACROSS
    return Seen(setting.window, pixel) if pixel < 2.0 * setting.view / ACROSS else None


def _certificates(setting: SceneSetting) -> tuple[Certificate, ...]:
    system = None if setting.system.frozen else setting.system
    return certificates_of(setting.problem, cycles_of(setting.problem), system, setting.z)


def _conics(setting: SceneSetting) -> Conics:
    closely = seen_closely(setting)
    return conics_of(setting.problem, setting.view, None if closely is None else closely.pixel)


layers: Mapping[str, Recipe] = MappingProxyType(
    {
        "equator": Recipe(("plane",), lambda s: find_equator.compute(s.problem)),
        "equator_cycle": Recipe(("plane",), lambda s: find_equator_cycle.compute(s.problem)),
        "location": Recipe(("plane",), lambda s: find_location.compute(s.problem)),
        "critical": Recipe(("plane", "slow", "psi"), lambda s: find_critical.compute(s.problem)),
        "slow_flow": Recipe(("plane", "slow"), lambda s: flow_on(s.coefficients, s.problem.critical)),
        "name": Recipe(("plane", "slow", "psi"), lambda s: portrait_name.compute(s.problem)),
        "classification": Recipe(("plane", "slow", "psi"), lambda s: portrait.compute(s.problem)),
        "eigendirections": Recipe(("plane", "psi"), lambda s: find_eigendirections(s.problem)),
        "nullclines_inside": Recipe(
            ("plane", "psi", "closely"), lambda s: inside_nullclines(s.problem, seen_closely(s))
        ),
        "nullclines_outside": Recipe(
            ("plane", "view", "closely"), lambda s: outside_nullclines(s.problem, s.view, seen_closely(s))
        ),
        "conics": Recipe(("plane", "view", "closely"), _conics),
        "inside": Recipe(("plane", "psi", "inner seeds", *_STEPPED), lambda s: orbits(s, outside=False)),
        "outside": Recipe(("plane", "outer seeds", "view", *_STEPPED), lambda s: orbits(s, outside=True)),
        "continuations": Recipe(("plane", "psi", *_STEPPED), continuations),
        "closed_orbits": Recipe(("plane", "psi"), lambda s: closed_orbits.compute(s.problem)),
        "cycles": Recipe(("plane", "slow", "psi"), lambda s: cycles_of.compute(s.problem)),
        "launched": Recipe(
            ("plane", "psi", "launch", "view", "pixel"),
            lambda s: launched_orbits(s.problem, s.launch, view=s.view, pixel=s.pixel),
        ),
        "separatrices": Recipe(
            ("plane", "psi", "tolerance", "pixel"),
            lambda s: separatrices_of(s.problem, rtol=s.rtol, pixel=s.pixel),
        ),
        "outcomes": Recipe(("plane", "slow", "psi"), lambda s: outcomes_of.compute(s.problem)),
        "certificates": Recipe(("plane", "slow", "psi", "place"), _certificates),
    }
)

#: Layers that a public function returns as well, by the name of that function.
LAYER_OF_FUNCTION: Mapping[str, str] = MappingProxyType(
    {
        "equator_equilibria": "equator", "critical_sets": "critical", "sliding_flow": "slow_flow",
        "classify": "classification", "limit_cycles": "cycles", "approach_outcomes": "outcomes",
    }
)  # fmt: skip
