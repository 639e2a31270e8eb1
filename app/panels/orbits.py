"""The panel "Orbits": the orbits that were launched, each with where it goes and where it comes from."""

from __future__ import annotations

from ..frame.draft import Draft
from .panel import Panel


def add(draft: Draft) -> None:
    """Nothing besides what every frame brings: `header["launched"]` goes with the layer of this name."""


PANEL = Panel(
    "orbits", "Orbits", add, "The orbits launched by a click on the picture: where each goes, and where it comes from."
)
