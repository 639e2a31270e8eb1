"""What stands still at one value of the parameter."""

from __future__ import annotations

from collections import Counter
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...layer_problem.critical import CriticalSet
from ...layer_problem.equator import EquatorEquilibria
from ...layer_problem.problem import LayerProblem
from ...layer_problem.vary import varied
from ...psi.function import Psi

Array = NDArray[np.float64]
_ANGLES = 2.0 * np.pi * np.arange(256) / 256
_CIRCLE = np.stack([np.cos(_ANGLES), np.sin(_ANGLES)], axis=-1)


class State:
    """What stands still at one value; each part is found when it is asked for."""

    def __init__(self, system: Any, psi: Psi, name: str, value: float, z: ArrayLike) -> None:
        self.value = value
        at, psi_at, z_at = varied(system, psi, z, name, value)
        self._problem = LayerProblem(at.at(z_at), psi_at)

    @property
    def equator(self) -> EquatorEquilibria:
        """The limit directions."""
        return self._problem.equator

    @cached_property
    def near_direction(self) -> float:
        """Smallest |Theta| at which it turns back before zero: where two limit directions are about to appear."""
        U = self._problem.at.U(_CIRCLE)
        value = _CIRCLE[:, 0] * U[:, 1] - _CIRCLE[:, 1] * U[:, 0]
        size, before, after = np.abs(value), np.roll(value, 1), np.roll(value, -1)
        turns = (size <= np.abs(before)) & (size <= np.abs(after)) & (before * value > 0.0) & (after * value > 0.0)
        if not turns.any():
            return float(size.max())
        # by the parabola through three samples
        rise, bend = np.abs(after) - np.abs(before), np.abs(before) - 2.0 * size + np.abs(after)
        return float((size[turns] - rise[turns] ** 2 / (8.0 * np.maximum(bend[turns], 1e-300))).min())

    @property
    def critical(self) -> tuple[CriticalSet, ...]:
        """The critical sets."""
        return self._problem.critical

    @property
    def exponent(self) -> float | None:
        """Of a closed equator; None where there is none."""
        cycle = self._problem.equator_cycle
        return None if cycle is None else cycle.exponent

    def part(self, i: int) -> Any:
        """Return what does not change along a piece: of the equator (0), critical sets (1), a closed equator (2)."""
        if i == 0:
            return Counter(self.equator.kind(k) for k in range(len(self.equator)))
        if i == 1:
            return Counter(C.kind for C in self.critical)
        return None if self.exponent is None else int(np.sign(self.exponent))

    def difference(self, other: State) -> int | None:
        """First part that is not that of the other; None if all are."""
        return next((i for i in range(3) if self.part(i) != other.part(i)), None)
