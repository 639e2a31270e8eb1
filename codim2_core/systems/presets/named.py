"""A system by its name: a preset's, with its Psi and z, or an example's."""

from __future__ import annotations

from difflib import get_close_matches
from typing import Any

from ..examples import catalogue
from .presets import presets


def named_setting(name: str) -> dict[str, Any]:
    """Return what a name stands for: ``{"system": ..., "psi": ..., "z": ...}`` of a preset, "system" of an example.

    Raises ValueError: There is neither; the message has the names that are like it.
    """
    if name in presets:
        found = presets[name]
        return {"system": found.system, "psi": found.psi, "z": found.z}
    if name in catalogue:
        return {"system": catalogue[name].make()}
    near = get_close_matches(name, (*presets, *catalogue), n=3)
    like = f"the nearest names are {', '.join(near)}" if near else "`codim2 presets` lists the names"
    raise ValueError(f"system is {name[:40]!r}, no preset or example; {like}. Or give an ELinear or a System.")
