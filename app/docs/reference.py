"""The public names of both packages by topic, a page a function with its results, for Sphinx's autodoc."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterable, Iterator
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

import codim2_core

_CODE = re.compile(r"(`+[^`]*`+)")

#: Topics of the core: title, what is found there, and its pages, each a function (or a class) with what it returns.
TOPICS: dict[str, tuple[str, str, tuple[str, ...]]] = {
    "systems": (
        "Systems",
        "What is studied: the paper's normal form, a system of your own formulas, the paper's figures.",
        ("ELinear", "System Frozen", "Coefficients", "Psi", "presets Preset"),
    ),
    "portraits": (
        "Portraits",
        "All that one phase portrait has: its name, what stands still, its curves and orbits.",
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
    app = import_module(__name__.partition(".")[0])  # its face imports what is asked for: no circle
    about = "What ``codim2_app`` adds in a notebook: the live page, pictures and tables."
    yield Topic("app", "In a notebook", about, app, [[name] for name in app.__all__], prefix="app-")


def _split_functions(module: ModuleType, names: Iterable[str]) -> tuple[list[list[str]], list[str]]:
    """Return the functions of a module, which have a page each, and its other names, which stay together."""
    functions = [name for name in names if inspect.isroutine(getattr(module, name))]
    return [[name] for name in functions], [name for name in names if name not in functions]


def write_reference(folder: Path) -> None:
    """Write the pages of the reference, for autodoc, into a folder of sources."""
    for topic in topics():
        module, rows = topic.module, []
        for names in topic.pages:
            page = topic.page(names)
            (folder / f"{page}.rst").write_text("\n".join(_function_page(module, names)), encoding="utf-8")
            rows.append((page, names[0], first_line(getattr(module, names[0]))))
        parts = [f"{topic.title}\n{'=' * 2 * len(topic.title)}\n\n{topic.about}\n"]
        parts.append(f".. currentmodule:: {module.__name__}\n")
        parts += [f":doc:`{name} <{page}>`\n   {line}\n" for page, name, line in rows]
        parts += _entries(module, topic.others)
        hidden = "\n".join(f"   {page}" for page, *_ in rows)
        parts.append(f".. toctree::\n   :hidden:\n\n{hidden}\n")
        (folder / f"reference-{topic.key}.rst").write_text("\n".join(parts), encoding="utf-8")


def _function_page(module: ModuleType, names: list[str]) -> Iterator[str]:
    yield f"{names[0]}\n{'=' * len(names[0])}\n\n.. currentmodule:: {module.__name__}\n"
    yield from _entries(module, names)


def _entries(module: ModuleType, names: Iterable[str]) -> Iterator[str]:
    for name in names:
        value = getattr(module, name)
        if inspect.isclass(value):
            yield f".. autoclass:: {name}\n   :members:\n"
        elif callable(value):
            yield f".. autofunction:: {name}\n"
        else:
            yield f".. py:data:: {name}\n\n   {_summary(value)}\n"


def first_line(value: Any) -> str:
    """Return the first sentence of a docstring; of a value, what it is."""
    if not (inspect.isroutine(value) or inspect.isclass(value) or inspect.ismodule(value)):
        return _summary(value)
    text = (inspect.getdoc(value) or "").split("\n\n")[0].replace("\n", " ")
    return _escape_bars(text)


def _summary(value: Any) -> str:
    if isinstance(value, dict) or hasattr(value, "keys"):
        return "A mapping: " + ", ".join(f"``{key}``" for key in value)
    return f"``{type(value).__name__}``"


def escape_bars(_app: Any, what: str, _name: str, _value: Any, _options: Any, lines: list[str]) -> None:
    """Let bars of a docstring, as in |p|, be those of a modulus; called by autodoc.

    Napoleon takes what is before the colon of a property's first line for its type: there it is a dash.
    """
    lines[:] = map(_escape_bars, lines)
    if what == "property" and lines:
        lines[0] = lines[0].replace(": ", " – ")


def _escape_bars(line: str) -> str:
    """Return a line in which bars outside of code stand for themselves."""
    return "".join(part if part.startswith("`") else part.replace("|", "\\|") for part in _CODE.split(line))
