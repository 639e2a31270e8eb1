"""Poles of U on the closed hemisphere: formulas whose divisors vanish there."""

from __future__ import annotations

import numpy as np

from ...formulas.expression import Expression
from ...formulas.tape import compact
from ...systems.frozen import FrozenSystem
from ...systems.typed_at_z import Frozen

_RADII, _ANGLES = np.linspace(0.0, 1.0, 17), np.linspace(0.0, 2.0 * np.pi, 257)
_NET = {"c": np.outer(_RADII, np.cos(_ANGLES)), "s": np.outer(_RADII, np.sin(_ANGLES))}


def has_pole(at: FrozenSystem) -> bool:
    """Whether a divisor in U changes its sign on a net over the disc |e| <= 1, or vanishes at a place of the net."""
    if not isinstance(at, Frozen):
        return False
    values = {**at.values, "x": 0.0, "y": 0.0, **_NET}
    for row in at.typed.U:
        for op, *args in row.tape:
            if op == "/":
                divisor = Expression(compact(list(row.tape), args[1])).evaluate(values)
                if not (divisor.min() > 0.0 or divisor.max() < 0.0):
                    return True
    return False
