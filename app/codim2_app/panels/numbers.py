"""The panel "Numbers": tables of what every frame carries, and the approach outcomes."""

from __future__ import annotations

from ..picture.slow_layers import outcomes
from .panel import Panel

PANEL = Panel(
    "numbers", "Numbers", outcomes.add, "Limit directions, critical sets and limit cycles, each with its numbers."
)
