"""Motions with dry friction whose values are known: what a solver can be held against, and how near this one comes."""

from __future__ import annotations

from .catalogue import catalogue
from .record import Comparison, ExactValue, ReferenceMotion

__all__ = ["Comparison", "ExactValue", "ReferenceMotion", "catalogue"]


def __dir__() -> list[str]:
    """Return the public names, for the Tab key."""
    return list(__all__)
