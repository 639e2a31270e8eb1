"""A sentence of the registry."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Sentence:
    """One sentence."""

    says: str  # with {fields}
    when: str  # when it is said
