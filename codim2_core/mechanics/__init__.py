"""Derive the system of a mechanism: mass matrix, contact point and coefficient of friction in, U and W out."""

from __future__ import annotations

from ..arguments import guarded
from .contact import contact
from .fit import Fit, fit
from .grip import Grip
from .mechanism import Mechanism

__all__ = ["Fit", "Grip", "Mechanism", "contact", "fit"]

globals().update(guarded(__name__, globals(), ["fit"]))
