"""Derive the system of a mechanism: mass matrix, contact point and coefficient of friction in, U and W out."""

from __future__ import annotations

from ..arguments import checked_functions
from .contact import contact
from .fit import Fit, fit
from .grip import Grip
from .mechanism import Mechanism
from .several.contacts import Contacts, contacts
from .several.result import ContactDecision, ContactMotion, ContactPhase, ContactStatus

__all__ = [
    "ContactDecision",
    "ContactMotion",
    "ContactPhase",
    "ContactStatus",
    "Contacts",
    "Fit",
    "Grip",
    "Mechanism",
    "contact",
    "contacts",
    "fit",
]

globals().update(checked_functions(__name__, globals(), ["fit"]))
