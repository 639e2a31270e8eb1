"""Derive the system of a mechanism: mass matrix, contact point and coefficient of friction in, U and W out."""

from __future__ import annotations

from ..arguments import checked_functions
from .contact_force import ContactForce, Grip
from .fit import Fit, fit
from .friction_law import stribeck
from .mechanism import Mechanism, contact
from .several.contacts import Contacts, contacts
from .several.result import ContactDecision, ContactMotion, ContactPhase, ContactStatus

__all__ = [
    "ContactDecision", "ContactForce", "ContactMotion", "ContactPhase", "ContactStatus", "Contacts", "Fit", "Grip",
    "Mechanism", "contact", "contacts", "fit", "stribeck",
]  # fmt: skip

globals().update(checked_functions(__name__, globals(), ["fit"]))


def __dir__() -> list[str]:
    """Return the public names, for the Tab key."""
    return list(__all__)
