"""The public names of both packages by topic, a page a function with its results."""

from __future__ import annotations

import inspect
from collections.abc import Iterable, Iterator
from importlib import import_module
from types import ModuleType, UnionType
from typing import Any, NamedTuple, get_args

import codim2_core

#: Topics of the core: title, what is found there, and its pages, each a function (or a class) with what it returns.
TOPICS: dict[str, tuple[str, str, tuple[str, ...]]] = {
    "systems": (
        "Systems",
        "What is studied: the paper's normal form, a system of your own formulas, the paper's figures.",
        ("ELinear", "System Frozen", "Coefficients", "Psi", "presets Preset", "SystemLike PsiLike"),
    ),
    "portraits": (
        "Portraits",
        "All that one phase portrait has: its name, its equilibria, its curves and orbits.",
        (
            "classify Classification Degeneracy", "equator_equilibria EquatorEquilibria", "equator_cycle EquatorCycle",
            "critical_sets CriticalSet", "nullclines NullclineBranch", "trajectories Trajectories",
            "separatrices Separatrices Separatrix", "approach_outcomes", "basins Basins", "Scene",
        ),
    ),
    "cycles": (
        "Limit cycles",
        "Limit cycles of the layer problem, proofs of their number, and what a law of friction changes.",
        ("limit_cycles LimitCycles LimitCycle", "prove_portrait Proof", "compare_laws LawVerdicts LawVerdict"),
    ),
    "motions": (
        "Motions in time",
        "Motions for ε > 0 and in the limit ε → 0, and motions that repeat themselves.",
        (
            "simulate Simulation SimulationStatus Phase Variation", "simulate_nonsmooth", "Event", "contact_events",
            "periodic_motion PeriodicMotion PeriodicStatus", "response_curve ResponseCurve",
            "lyapunov_exponents LyapunovExponents", "delays Delay",
        ),
    ),
    "sliding": (
        "Sliding along Σ",
        "The slow flow on critical sets, and the candidates of the Filippov convention.",
        ("sliding_flow", "slow_portrait SlowPortrait", "filippov_sliding FilippovSliding"),
    ),
    "parameters": (
        "Over parameters",
        "What changes along one parameter and over two.",
        ("branches Branches", "atlas Atlas AtlasCurve AtlasPoint AtlasRegion"),
    ),
    "counting": (
        "Counting and checking",
        "Censuses of random systems, and the paper's claims evaluated on one system.",
        ("census Census", "certificates"),
    ),
}  # fmt: skip

#: Sub-modules of the core that are public, and what each is for; each is a topic too.
MODULES = {
    "psi": "Regularisation functions Ψ",
    "bifurcations": "Bifurcations in the plane (f₁, f₂)",
    "examples": "Example systems",
    "mechanics": "From a mechanism to its system",
    "hemisphere": "Charts of the hemisphere",
    "reference": "Motions whose values are known",
}


class Topic(NamedTuple):
    """A topic: its pages, each a function with what it returns, and the other names of its module."""

    key: str
    title: str
    about: str
    module: ModuleType
    pages: list[list[str]]
    others: Iterable[str] = ()
    prefix: str = ""

    def page(self, names: list[str]) -> str:
        """Return the name of the page of a function."""
        return f"api-{self.prefix}{names[0].lower()}"


def topics() -> Iterator[Topic]:
    """Yield all topics of the reference."""
    for key, (title, about, pages) in TOPICS.items():
        yield Topic(key, title, about, codim2_core, [page.split() for page in pages])
    for key, title in MODULES.items():
        module = getattr(codim2_core, key)
        own = sorted((name for name in module.__all__ if name not in codim2_core.__all__), key=str.lower)
        about = f"``codim2_core.{key}``: {first_line(module)}"
        yield Topic(key, title, about, module, *_split_functions(module, own), prefix=f"{key}-")
    app = import_module(__name__.partition(".")[0])  # its face imports on first use: no circle
    about = "What ``codim2_app`` adds in a notebook: the live page, pictures and tables."
    yield Topic("app", "In a notebook", about, app, [[name] for name in app.__all__], prefix="app-")


def _split_functions(module: ModuleType, names: Iterable[str]) -> tuple[list[list[str]], list[str]]:
    """Return the functions of a module, which have a page each, and its other names, which stay together."""
    functions = [name for name in names if inspect.isroutine(getattr(module, name))]
    return [[name] for name in functions], [name for name in names if name not in functions]


def first_line(value: Any) -> str:
    """Return the first sentence of a docstring; of a value, what it is."""
    if not (inspect.isroutine(value) or inspect.isclass(value) or inspect.ismodule(value)):
        return _summary(value)
    return (inspect.getdoc(value) or "").split("\n\n")[0].replace("\n", " ")


def _summary(value: Any) -> str:
    if isinstance(value, dict) or hasattr(value, "keys"):
        return "A mapping: " + ", ".join(f"``{key}``" for key in value)
    if isinstance(value, UnionType):  # what a function may be given
        return "One of " + ", ".join(f"``{one.__name__}``" for one in get_args(value)) + "."
    return f"``{type(value).__name__}``"
