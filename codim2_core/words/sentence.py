"""A sentence of the registry."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Sentence:
    """One sentence.

    Attributes
    ----------
    says : str
        With {fields}.
    when : str
        When it is said.
    """

    says: str
    when: str
