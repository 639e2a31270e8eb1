"""The panels beside the picture: what the open one is sent in a frame. A closed panel costs nothing.

What is cheap goes with every frame. What is slower is computed beside the frames (`panel_jobs`) once the controls
rest; until the browser has it, its name is in ``header["late"]``, and the panel shows that what it has is old.
"""

from __future__ import annotations

from collections.abc import Callable

from . import (
    panel_along,
    panel_atlas,
    panel_basins,
    panel_diagram,
    panel_outcomes,
    panel_planes,
    panel_psi,
    panel_stack,
    panel_theorems,
    panel_time,
)
from .panel_draft import Draft


def add(draft: Draft) -> None:
    """Add what the open panel shows, and the approach outcomes where they are visible, to a frame."""
    name = draft.values["panel"]
    if name in _PANELS:
        _PANELS[name](draft)
    if "basins" in draft.values["layers"]:
        panel_basins.add(draft)
    if "outcomes" in draft.values["layers"] or name == "numbers":
        panel_outcomes.add(draft)


_PANELS: dict[str, Callable[[Draft], None]] = {
    "atlas": panel_atlas.add,
    "planes": panel_planes.add,
    "diagram": panel_diagram.add,
    "theorems": panel_theorems.add,
    "along": panel_along.add,
    "solid": panel_stack.add,
    "time": panel_time.add,
    "psi": panel_psi.add,
}
