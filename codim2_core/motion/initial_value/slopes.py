"""U, W and their derivatives at many states at once, also by numbers of the system: what variations are made of."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...formulas.expression import Expression
from ...formulas.names import FAST_NAMES, SLOW_NAMES
from ...results.arrays import Array
from ...systems.kinds import AnySystem


@dataclass(frozen=True, eq=False)
class Slopes:
    """U and W of (2.7) and their exact derivatives as functions of arrays."""

    m: int  # the number of slow variables
    kept: tuple[tuple[str, float], ...]  # numbers of the system by which it is also differentiated, with their values
    rows: tuple[Expression, ...]  # the formulas of U and W, (2 + m,)
    derivatives: tuple[tuple[Expression, ...], ...]  # theirs by (c, s, x, y, z1, ..., zm, kept), (2 + m, 4 + m + q)

    def rates(self, e: Array, states: Array) -> Array:
        """(U, W) (k, 2 + m) at e (k, 2) and states (k, 2 + m)."""
        values = self._values(e, states)
        return np.stack([np.broadcast_to(row.evaluate(values), len(e)) for row in self.rows], axis=-1)

    def at(self, e: Array, states: Array) -> Array:
        """Their derivatives (k, 2 + m, 4 + m + q) at e (k, 2) and states (k, 2 + m)."""
        values = self._values(e, states)
        found = np.zeros((len(e), 2 + self.m, 4 + self.m + len(self.kept)))
        for i, row in enumerate(self.derivatives):
            for j, slope in enumerate(row):
                if slope.constant != 0.0:
                    found[:, i, j] = slope.evaluate(values)
        return found

    def of_state(self, e: Array, De: Array, states: Array) -> Array:
        """Differentiate them (k, 2 + m, 2 + m + q) by (x, y, z) and the kept numbers; (x, y) moves e as De says."""
        slopes = self.at(e, states)
        found = slopes[:, :, 2:].copy()
        found[:, :, :2] += slopes[:, :, :2] @ De
        return found

    def _values(self, e: Array, states: Array) -> dict[str, Array | float]:
        columns = (*e.T, *states.T)
        return dict(zip((*FAST_NAMES, *SLOW_NAMES[: self.m]), columns, strict=True)) | dict(self.kept)


def slopes_of(system: AnySystem, kept: Sequence[str] = ()) -> Slopes:
    """Return the derivatives of any system's field.

    Raises ValueError: A name is none of the system's; or as `ELinear.rows`.
    """
    for name in kept:
        if name not in system.variable:
            own = ", ".join(system.variable) or "none"
            raise ValueError(f"{name!r} is no number of this system; it has {own}.")
    rows = system.rows(kept)
    m = len(rows) - 2
    by = (*FAST_NAMES, *SLOW_NAMES[:m], *kept)
    derivatives = tuple(tuple(row.derivative(name) for name in by) for row in rows)
    return Slopes(m, tuple((name, system.value_of(name)) for name in kept), tuple(rows), derivatives)
