"""Motions with dry friction whose values are known: what a solver can be held against, and how near this one comes."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from .oscillators import OSCILLATING
from .record import Comparison, ExactValue, ReferenceMotion
from .rolling import ROLLING, SPINNING
from .sliding import SLIDING

__all__ = ["Comparison", "ExactValue", "ReferenceMotion", "catalogue"]


def __dir__() -> list[str]:
    """Return the public names, for the Tab key."""
    return list(__all__)


_MOTIONS = (*SLIDING, *ROLLING, *SPINNING, *OSCILLATING)
catalogue: Mapping[str, ReferenceMotion] = MappingProxyType({motion.key: motion for motion in _MOTIONS})
