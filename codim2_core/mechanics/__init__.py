"""From a mechanism to its system: mass matrix, contact point and coefficient of friction in, U and W out."""

from __future__ import annotations

from .contact import contact
from .grip import Grip
from .mechanism import Mechanism

__all__ = ["Grip", "Mechanism", "contact"]
