"""What is long for the loop is done for one visitor at a time, and gives way to whoever waits for an answer."""

from __future__ import annotations

from typing import Any

from ..frame.later import OneByOne


def one_by_one(application: Any) -> OneByOne:
    """Return what lets in those for whom a Tornado application does what is long."""
    return application.settings.setdefault("codim2_one_by_one", OneByOne())
