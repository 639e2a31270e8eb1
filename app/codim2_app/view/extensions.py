"""Installed packages that add to the explorer: examples, families of Ψ, presets, panels, lessons.

A package names a function as an entry point of the group "codim2": it is called once a process, and registers.
"""

from __future__ import annotations

from functools import cache
from importlib.metadata import entry_points

GROUP = "codim2"


@cache
def register_all() -> tuple[str, ...]:
    """Call the functions of all packages, once; return a sentence for each that fails, and go on without it."""
    failed = []
    for one in entry_points(group=GROUP):
        try:
            one.load()()
        except Exception as error:  # whatever a package does, the explorer starts
            failed.append(f"The extension {one.name} ({one.value}) is left out: {type(error).__name__}: {error}")
    return tuple(failed)
