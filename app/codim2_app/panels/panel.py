"""The interface of a panel next to the picture."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..picture.frame.frame_context import FrameContext

PANEL_SCRIPTS = Path(__file__).parents[1] / "static" / "panels"


@dataclass(frozen=True)
class Panel:
    """A panel: its tab, what a frame brings while it is open, and the script that draws it."""

    key: str  # its name in the address and in ``register("KEY", ...)`` of its script
    title: str  # the word on its tab
    add: Callable[[FrameContext], None]  # adds to a frame under way what the open panel shows
    tip: str = ""  # what is seen in it, in one sentence, for the tab's tooltip
    # what its script gets as ``tools.settings``; JSON
    settings: Mapping[str, Any] = field(default_factory=dict)
    folder: Path = PANEL_SCRIPTS  # where KEY.js is and, if the panel has rules of its own, KEY.css

    @property
    def script(self) -> Path:
        """Return the panel's ES module."""
        return self.folder / f"{self.key}.js"

    @property
    def style(self) -> str:
        """Return the panel's rules; "" if it has none."""
        path = self.folder / f"{self.key}.css"
        return path.read_text(encoding="utf-8") if path.is_file() else ""
