"""A public name, imported when it is first requested."""

from __future__ import annotations

from importlib import import_module

from .arguments import checked_functions
from .presets.named import named_setting


def find_public(package: str, home: str, name: str) -> object:
    """Return what a module of a package calls `name`; a function comes with the checks of what it is given."""
    one = {name: getattr(import_module(f".{home}", package), name)}
    return (one | checked_functions(package, one, one, named_setting))[name]
