"""The public names of both packages as pages for Sphinx's autodoc, and docstrings with the paper's printed labels."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterable
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import codim2_core
from codim2_core.paper import PRINTED

_LABEL = re.compile(r"\b(" + "|".join(map(re.escape, sorted(PRINTED, key=len, reverse=True))) + r")\b")
_CODE = re.compile(r"(`+[^`]*`+)")

#: Sub-modules of the core that are public, and what each is for.
MODULES = {
    "psi": "Regularisation functions",
    "bifurcations": "Bifurcations in the plane (f₁, f₂)",
    "examples": "Example systems",
    "hemisphere": "Charts of the hemisphere",
    "mechanics": "From a mechanism to its system",
    "reference": "Motions whose values are known",
}


def write_reference(folder: Path) -> None:
    """Write the pages of the reference into a folder of sources."""
    core = [name for name in codim2_core.__all__ if not inspect.ismodule(getattr(codim2_core, name))]
    app = import_module(__name__.partition(".")[0])  # its face imports what is asked for: no circle
    pages = {
        "core": _page("codim2_core", "Names of `codim2_core`", _public_members(codim2_core, core)),
        "app": _page("codim2_app", "Names of `codim2_app`", _public_members(app, app.__all__)),
    }
    for name, title in MODULES.items():
        module = getattr(codim2_core, name)
        own = [one for one in module.__all__ if one not in codim2_core.__all__]
        pages[name] = _page(module.__name__, f"{title}: `codim2_core.{name}`", _public_members(module, own))
    for name, text in pages.items():
        (folder / f"api-{name}.rst").write_text(text, encoding="utf-8")


def _public_members(module: ModuleType, names: Iterable[str]) -> list[tuple[str, Any]]:
    return sorted(((name, getattr(module, name)) for name in names), key=lambda one: one[0].lower())


def _page(module: str, title: str, names: list[tuple[str, Any]]) -> str:
    title = title.replace("`", "``")
    parts = [f"{title}\n{'=' * len(title)}\n\n.. currentmodule:: {module}\n"]
    for name, value in names:
        if inspect.isclass(value):
            parts.append(f".. autoclass:: {name}\n   :members:\n")
        elif callable(value):
            parts.append(f".. autofunction:: {name}\n")
        else:
            parts.append(f".. py:data:: {name}\n\n   {_summary(value)}\n")
    return "\n".join(parts)


def _summary(value: Any) -> str:
    if isinstance(value, dict) or hasattr(value, "keys"):
        return "A mapping: " + ", ".join(f"``{key}``" for key in value)
    return f"``{type(value).__name__}``"


def print_labels(_app: Any, _what: str, _name: str, _value: Any, _options: Any, lines: list[str]) -> None:
    """Put what the paper's labels are called in print into a docstring, whose |p| is a modulus; called by autodoc."""
    lines[:] = [_escape_bars(_LABEL.sub(lambda found: PRINTED[found[1]][0], line)) for line in lines]


def _escape_bars(line: str) -> str:
    """Return a line in which bars outside of code stand for themselves."""
    return "".join(part if part.startswith("`") else part.replace("|", "\\|") for part in _CODE.split(line))
