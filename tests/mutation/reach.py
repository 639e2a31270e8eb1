"""Which tests reach which functions, and what they cost."""

from __future__ import annotations

import cProfile
import functools
import os
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .processes import ROOT
from .targets import FOLDERS

PACKAGES = {short: f"codim2_{short}" for short in FOLDERS}
Function = tuple[str, str, int]  # file, name, line


def imported_as(path: Path) -> str:
    """Return the name by which a file of the packages is imported."""
    folder, *parts = path.relative_to(ROOT).with_suffix("").parts
    short = next(short for short, one in FOLDERS.items() if one == folder)
    return ".".join([PACKAGES[short], *parts]).removesuffix(".__init__")


@dataclass
class Reach:
    """What one passing test costs, and which functions (file, name, line) it enters."""

    cost: float
    entered: frozenset[tuple[str, str, int]]


OURS = tuple(str(ROOT / folder) + os.sep for folder in FOLDERS.values())


def entered_in(profile: cProfile.Profile) -> frozenset[Function]:
    """Functions of the packages that were entered while a profile was taken."""
    codes = [one.code for one in profile.getstats() if not isinstance(one.code, str)]
    return frozenset((c.co_filename, c.co_qualname, c.co_firstlineno) for c in codes if c.co_filename.startswith(OURS))


def noting(found: set[Function]) -> Callable[[Any, str, object], None]:
    """Note the same, slowly, but so that others may note what they want as well."""

    def enter(frame: Any, event: str, _argument: object) -> None:
        code = frame.f_code
        if event == "call" and code.co_filename.startswith(OURS):
            found.add((code.co_filename, code.co_qualname, code.co_firstlineno))

    return enter


@functools.cache
def _reads(file: str, path: str) -> bool:
    """Whether a file of tests imports a module by its name: its constants are read where no function is entered."""
    package, _, module = imported_as(Path(path)).rpartition(".")
    names = rf"^(from|import) {re.escape(package)}\.{module}\b|^from {re.escape(package)} import .*\b{module}\b"
    return bool(re.search(names, (ROOT / file).read_text(), re.MULTILINE))


def reaching(reach: dict[str, Reach], keys: set[tuple[str, str, int]] | None, path: str, seconds: float) -> list[str]:
    """Tests that enter one of these functions, quickest first, that take so long together.

    None, for what runs on import: tests that enter any function of the file, or read its constants.
    """
    met = [
        name
        for name, one in reach.items()
        if (
            one.entered & keys
            if keys is not None
            else any(file == path for file, _, _ in one.entered) or _reads(name.split("::")[0], path)
        )
    ]
    found, cost = [], 0.0
    for name in sorted(met, key=lambda name: reach[name].cost):
        cost += reach[name].cost
        if found and cost > seconds:
            break
        found.append(name)
    return found
