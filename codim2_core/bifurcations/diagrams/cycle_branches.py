"""Branches of limit cycles along one parameter."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ...results.words import say
from ...systems.psi.function import Psi
from ..continuation.branch_ends import MarkedValue
from ..continuation.branches import continue_cycles
from ..continuation.result import CycleBranches

__all__ = ["cycle_branches"]


def cycle_branches(
    system: Any,
    psi: Psi,
    along: str,
    spans: Sequence[tuple[float, float]],
    z: tuple[float, ...],
    marked: Sequence[MarkedValue],
) -> CycleBranches:
    """Continue the limit cycles along one parameter."""
    parts = [continue_cycles(system, psi, along, span, z, marked) for span in spans]
    if len(parts) == 1:
        return parts[0]
    whole = spans[0][0], spans[-1][1]
    reason = f" {say('elsewhere')} ".join(dict.fromkeys(part.reason for part in parts))
    notes = tuple(note for part in parts for note in part.notes)
    return CycleBranches(along, whole, tuple(branch for part in parts for branch in part), reason, notes)
