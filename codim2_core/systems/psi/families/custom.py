"""A Psi that the user types: the family whose formula is not known before."""

from __future__ import annotations

from .record import Family

FAMILY = Family(name="custom", title="your own …", formula="")
