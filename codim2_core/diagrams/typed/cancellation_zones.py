"""Zones along a parameter in which U loses its digits, and in which no equilibria are sought.

A formula such as ``(F(eta) - F(1))/(1 - eta)`` goes smoothly through eta = 1, but beside it its digits are lost: there
limit directions and critical sets come and go by rounding, which a finite difference of U shows and no derivative does.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...expressions.arrays import program
from ...layer_problem.vary import vary
from ...psi.function import Psi
from ...systems.bounds import slow_values
from ...systems.typed_at_z import Frozen
from .state import State

_TEST_ANGLES = 2.0 * np.pi * np.arange(32) / 32
_TEST_POINTS = np.stack([np.cos(_TEST_ANGLES), np.sin(_TEST_ANGLES)], axis=-1)
#: Of the span: so near, and at no even steps, U is a parabola but for its rounding.
_TEST_OFFSETS = 1e-14 * np.array([-3.0, -1.3, 0.0, 1.7, 3.1])
_PARABOLA_BASIS = np.vander(_TEST_OFFSETS / _TEST_OFFSETS.max(), 3)
_RESIDUAL_PROJECTOR = np.eye(len(_TEST_OFFSETS)) - _PARABOLA_BASIS @ np.linalg.pinv(_PARABOLA_BASIS)
_MIN_ROUGHNESS = 1e-11  # of |U|: less moves no zero that is told from its neighbours
_SMOOTH_OFFSETS = 2.0 ** np.arange(-32.0, -5.0)  # of the span: how far from a rough value one that is not is looked for


class RoughError(ArithmeticError):
    """The result at a value is rounding error; `zone` is where it may be."""

    def __init__(self, zone: tuple[float, float]) -> None:
        super().__init__(zone)
        self.zone = zone


class States:
    """States along a parameter outside of zones in which U is rounding.

    Parameters
    ----------
    system, psi, name, z
        As of `diagrams.bifurcation_diagram`.
    span : (low, high)
    """

    def __init__(self, system: Any, psi: Psi, name: str, span: tuple[float, float], z: ArrayLike) -> None:
        self._given, self._span = (system, psi, z, name), span
        self._zones: list[tuple[float, float]] = []
        self._known: dict[float, State] = {}

    def __call__(self, value: float) -> State:
        """Find the equilibria at a value, or at the nearest beside a zone; RoughError where it is undefined."""
        system, psi, z, name = self._given
        for low, high in self._zones:
            if low < value < high:
                value = low if value - low <= high - value else high
        if value not in self._known:
            try:
                self._known[value] = State(system, psi, name, value, z)
            except ValueError:
                self.check(value)
                raise
        return self._known[value]

    def check(self, value: float) -> None:
        """Raise RoughError where U is rounding at a value, as a change of states found there then is.

        In a zone that is left out already a change is one from its one side to the other.
        """
        if self._is_clear(value) or any(low < value < high for low, high in self._zones):
            return
        (low, high), ends = self._span, []
        for side in (-1.0, 1.0):
            beside = (value + side * (high - low) * _SMOOTH_OFFSETS).tolist()
            ends.append(next((v for v in beside if not low < v < high or self._is_clear(v)), None))
        if None not in ends:
            raise RoughError((max(ends[0], low), min(ends[1], high)))

    def leave_out(self, zone: tuple[float, float]) -> None:
        """Tell nothing within a zone from now on."""
        self._zones.append(zone)

    def _is_clear(self, value: float) -> bool:
        (low, high), U = self._span, []
        for near in np.clip(value + (high - low) * _TEST_OFFSETS, low, high).tolist():
            at, _, z_at = vary(*self._given, near)
            frozen = at if at.frozen else Frozen(at.typed, slow_values(z_at, at.m, needed=False))
            U.append(program(frozen.key).evaluate(_TEST_POINTS)[:, :, 0])
        values: NDArray[np.float64] = np.array(U)
        return bool(np.abs(np.tensordot(_RESIDUAL_PROJECTOR, values, 1)).max() <= _MIN_ROUGHNESS * np.abs(values).max())
