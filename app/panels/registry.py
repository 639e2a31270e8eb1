"""The panels beside the picture: what the open one is sent in a frame. A closed panel costs nothing.

What is cheap goes with every frame. What is slower is computed beside the frames (`frame.jobs`) once the controls
rest; until the browser has it, its name is in ``header["late"]``, and the panel shows that what it has is old.
"""

from __future__ import annotations

from collections.abc import Callable

from ..frame.draft import Draft
from . import along, atlas, basins, diagram, outcomes, planes, psi, stack, theorems, time


def add(draft: Draft) -> None:
    """Add what the open panel shows, and the approach outcomes where they are visible, to a frame."""
    name = draft.values["panel"]
    if name in _PANELS:
        _PANELS[name](draft)
    if "basins" in draft.values["layers"]:
        basins.add(draft)
    if "outcomes" in draft.values["layers"] or name == "numbers":
        outcomes.add(draft)


_PANELS: dict[str, Callable[[Draft], None]] = {
    "atlas": atlas.add,
    "planes": planes.add,
    "diagram": diagram.add,
    "theorems": theorems.add,
    "along": along.add,
    "solid": stack.add,
    "time": time.add,
    "psi": psi.add,
}
