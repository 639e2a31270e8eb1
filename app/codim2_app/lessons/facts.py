"""Facts of a scene that a lesson can ask about: each computed by the core, when it is requested.

To add a fact is one entry of `FACTS`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from codim2_core.scene import Scene
from codim2_core.systems.coefficients import Coefficients

Fact = str | float | int | bool | tuple[str, ...] | None


def _count(values: Any) -> int:
    return int(np.count_nonzero(values))


def _count_kinds(scene: Scene, *beginnings: str) -> int:
    return sum(C.kind.startswith(beginnings) for C in scene["critical"])


def _only(scene: Scene) -> Any:
    """Return the critical set where there is exactly one."""
    found = scene["critical"]
    return found[0] if len(found) == 1 else None


def _of_only(read: Callable[[Any], Fact]) -> Callable[[Scene], Fact]:
    def fact(scene: Scene) -> Fact:
        C = _only(scene)
        return None if C is None else read(C)

    return fact


def _slow_fact(scene: Scene) -> float | None:
    C = _only(scene)
    return float(C.slow_flow[0]) if C is not None and len(C.slow_flow) else None


def _fastest(scene: Scene) -> float | None:
    return max((float(C.slow_flow[0]) for C in scene["critical"] if _slides(C)), default=None)


def _slides(C: Any) -> bool:
    return C.kind.startswith("stable") and len(C.slow_flow) > 0


def _force_ratio(scene: Scene) -> float | None:
    at = scene.coefficients
    if not isinstance(at, Coefficients) or at.a * at.d + at.b * at.b == 0.0:
        return None
    return float(np.hypot(*np.linalg.solve(at.A, at.f)))


def _equator_fact(scene: Scene) -> str:
    if scene["equator"].all_directions:
        return "every direction"
    cycle = scene["equator_cycle"]
    if cycle is None:
        return "limit directions"
    return "attracting" if cycle.exponent < 0.0 else "repelling" if cycle.exponent > 0.0 else "neutral"


def _verdicts(scene: Scene) -> tuple[str, ...]:
    return tuple(sorted({outcome.verdict for outcome in scene["outcomes"]}))


#: Every fact: how a student reads it, what it says (for the authors of lessons), and how it is read off a scene.
FACTS: dict[str, tuple[str, str, Callable[[Scene], Fact]]] = {
    "case": ("case", "the case of the e-linear system: I, II, III, or None", lambda s: s["name"].case),
    "name": ("portrait", "the name of the portrait, such as CM4", lambda s: s["name"].name),
    "degenerate": (
        "degenerate",
        "names of what a small change would destroy",
        lambda s: tuple(item.name for item in s["name"].degeneracies),
    ),
    "limit_directions": ("limit directions", "number of limit directions", lambda s: len(s["equator"].theta)),
    "equator": (
        "equator",
        "limit directions, every direction, attracting, repelling, neutral (a closed orbit)",
        _equator_fact,
    ),
    "arriving": (
        "limit directions with λ_ρ < 0",
        "limit directions with λ_ρ < 0",
        lambda s: _count(s["equator"].lambda_rho < 0.0),
    ),
    "leaving": (
        "limit directions with λ_ρ > 0",
        "limit directions with λ_ρ > 0",
        lambda s: _count(s["equator"].lambda_rho > 0.0),
    ),
    "angularly_attracting": (
        "limit directions with λ_θ < 0",
        "limit directions with λ_θ < 0",
        lambda s: _count(s["equator"].lambda_theta < 0.0),
    ),
    "along_an_open_set": (
        "limit directions with both negative",
        "limit directions along which an open set of trajectories arrives",
        lambda s: _count((s["equator"].lambda_rho < 0.0) & (s["equator"].lambda_theta < 0.0)),
    ),
    "critical_sets": ("critical sets", "number of critical sets", lambda s: len(s["critical"])),
    "stable": ("stable critical sets", "number of stable critical sets", lambda s: _count_kinds(s, "stable")),
    "unstable": ("unstable nodes and foci", "number of unstable nodes and foci", lambda s: _count_kinds(s, "unstable")),
    "saddles": ("saddles", "number of critical sets that are saddles", lambda s: _count_kinds(s, "saddle")),
    "kind": ("kind of C", "the kind of the only critical set", _of_only(lambda C: C.kind)),
    "trace": ("tr J", "tr J of the only critical set", _of_only(lambda C: float(C.trace))),
    "determinant": ("det J", "det J of the only critical set", _of_only(lambda C: float(C.determinant))),
    "radius": ("|e| on C", "|e| of the only critical set", _of_only(lambda C: float(np.hypot(*C.e)))),
    "slow_flow": ("z′ on C", "z' on the only critical set", _slow_fact),
    "fastest": ("fastest z′ of stable sliding", "the largest z' on a stable critical set", _fastest),
    "force_ratio": ("|A⁻¹f|", "|A^-1 f| of the e-linear system: it slides below 1", _force_ratio),
    "cycles": ("limit cycles", "number of limit cycles found", lambda s: len(s["cycles"])),
    "stable_cycles": (
        "stable limit cycles",
        "number of stable limit cycles found",
        lambda s: sum(bool(c.stable) for c in s["cycles"]),
    ),
    "verdicts": ("approaches", "what becomes of approaches: slide, cycle, cross, misses, undecided", _verdicts),
}
FACT_NAMES = frozenset(FACTS)
#: Facts that need compiled trajectories.
COMPILED = frozenset({"cycles", "stable_cycles", "verdicts"})


def facts_of(scene: Scene, names: Iterable[str]) -> dict[str, Fact]:
    """Return the facts of these names.

    Parameters
    ----------
    scene : Scene
    names : iterable of str
        Keys of `FACTS`.
    """
    return {name: FACTS[name][2](scene) for name in sorted(set(names))}
