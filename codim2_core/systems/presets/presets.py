"""The paper's figures as data, `presets.toml`.

``portrait`` is what the figure shows, (case, name, kinds of its critical sets); the tests hold every preset to it.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import replace
from difflib import get_close_matches
from importlib import import_module
from pathlib import Path
from types import MappingProxyType
from typing import Any

from ..arguments import checked_functions
from ..examples import catalogue
from ..examples.example import as_tuples
from .preset import Preset


class Named(dict[str, Preset]):
    """Presets by name; the error of a missing one lists the nearest names."""

    def __missing__(self, name: str) -> Preset:
        near = get_close_matches(str(name), self, n=3) or tuple(self)[:3]
        raise KeyError(f"{name!r} is no preset; the nearest names are {', '.join(near)}.")


def _read_presets(path: Path) -> Named:
    """Read the presets of a TOML file: its tables are groups, what they share and then their presets by name."""
    found = Named()
    for group in tomllib.loads(path.read_text("utf-8")).values():
        shared = {key: value for key, value in group.items() if not isinstance(value, dict)}
        for name in (key for key in group if key not in shared):
            values = {key: as_tuples(value) for key, value in (shared | group[name]).items()}
            values["portrait"] = tuple(part or None for part in values["portrait"])
            found[name] = Preset(name, **values)
    return found


_presets = _read_presets(Path(__file__).with_name("presets.toml"))
_LISTED = frozenset(_presets)
presets: Mapping[str, Preset] = MappingProxyType(_presets)  # by name, in the order of menus; grows with `register`


def register(preset: Preset) -> Preset:
    """List a preset of your own with the paper's figures, for this process.

    The same. Raises ValueError: It is no Preset, its name is missing or taken, or its system, Psi and z do not go
    together.
    """
    if not isinstance(preset, Preset):
        raise ValueError(f"preset is of type {type(preset).__name__}; give a Preset.")
    if not preset.name or not preset.title or preset.name in _presets:
        raise ValueError(f"the preset is named {preset.name!r}, {preset.title!r}; give a name of its own, and a title.")
    preset.psi.check()  # both say what is wrong, if anything is
    preset.system.at(preset.z)
    _presets[preset.name] = replace(preset, group=preset.group or "Your own")
    return _presets[preset.name]


def unregister(name: str) -> None:
    """Take a registered preset off the list; the paper's figures stay.

    Raises ValueError: There is no such preset, or it is the paper's.
    """
    if name not in _presets or name in _LISTED:
        raise ValueError(f"{name!r} is no preset that was registered.")
    del _presets[name]


def named_setting(name: str) -> dict[str, Any]:
    """Return system, Psi and z of a preset, or the system of an example, by name; ValueError with the names like it."""
    if name in presets:
        found = presets[name]
        return {"system": found.system, "psi": found.psi, "z": found.z}
    if name in catalogue:
        return {"system": catalogue[name].make()}
    near = get_close_matches(name, (*presets, *catalogue), n=3)
    like = f"the nearest names are {', '.join(near)}" if near else "`codim2 presets` lists the names"
    raise ValueError(f"system is {name[:40]!r}, no preset or example; {like}. Or give an ELinear or a System.")


def find_public(package: str, home: str, name: str) -> object:
    """Return what a module of a package calls `name`; a function comes with the checks of what it is given."""
    one = {name: getattr(import_module(f".{home}", package), name)}
    return (one | checked_functions(package, one, one, named_setting))[name]
