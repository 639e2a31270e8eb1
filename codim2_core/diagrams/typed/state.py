"""Equilibria of a general system at one value of a parameter, and those that are about to appear."""

from __future__ import annotations

import math
from collections import Counter
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import Array
from ...expressions.arrays import program
from ...layer_problem.critical import CriticalSet
from ...layer_problem.disc_zeros import disc_zeros
from ...layer_problem.equator import EquatorEquilibria
from ...layer_problem.problem import LayerProblem
from ...layer_problem.vary import vary
from ...psi.function import Psi

__all__ = ["State", "WindingTest"]

WindingTest = tuple[Array, Array, Array]  # places (k, 2) in the disc, sizes (k,), Theta or U there

_EQUATOR_ANGLES = 2.0 * np.pi * np.arange(256) / 256
_CIRCLE = np.stack([np.cos(_EQUATOR_ANGLES), np.sin(_EQUATOR_ANGLES)], axis=-1)
_NET_SIDE = 25
_NET = np.stack(np.meshgrid(*2 * [np.linspace(-1.0, 1.0, _NET_SIDE)]), axis=-1)  # of the disc, where |U| is looked at
_IN_DISC = np.hypot(_NET[..., 0], _NET[..., 1]) < 1.0 + 1.0 / _NET_SIDE
_MAX_NEWTON, _MAX_CORRECTION, _ZERO_TOLERANCE, _DIFFERENCE_STEP = 6, 0.1, 1e-9, 1e-4
_STENCIL = _DIFFERENCE_STEP * np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])


class State:
    """Equilibria at one value; each part is computed when it is first read."""

    def __init__(self, system: Any, psi: Psi, name: str, value: float, z: ArrayLike) -> None:
        self.value = value
        at, psi_at, z_at = vary(system, psi, z, name, value)
        self._problem = LayerProblem(at.at(z_at), psi_at)

    def _field(self, e: Array) -> tuple[Array, Array]:
        """U (..., 2) and D_e U (..., 2, 2) at e (..., 2), compiled."""
        rows = np.asarray(program(self._problem.at.key).evaluate(e.reshape(-1, 2)), float).reshape(*e.shape[:-1], 2, 3)
        return rows[..., 0], rows[..., 1:]

    @property
    def equator(self) -> EquatorEquilibria:
        """The limit directions."""
        return self._problem.equator

    @cached_property
    def near_directions(self) -> WindingTest:
        """Return where |Theta| has a positive minimum, and its size: there two limit directions may appear."""
        U, _ = self._field(_CIRCLE)
        value = _CIRCLE[:, 0] * U[:, 1] - _CIRCLE[:, 1] * U[:, 0]
        size, before, after = np.abs(value), np.roll(value, 1), np.roll(value, -1)
        turns = (size <= np.abs(before)) & (size <= np.abs(after)) & (before * value > 0.0) & (after * value > 0.0)
        # by the parabola through three samples
        before, size, after = (np.abs(v)[turns] for v in (before, value, after))
        rise, bend = after - before, before - 2.0 * size + after
        size = size - np.where(bend > 0.0, rise, 0.0) ** 2 / (8.0 * np.where(bend > 0.0, bend, 1.0))
        return _CIRCLE[turns], size, value[turns, None]

    @cached_property
    def near_sets(self) -> WindingTest:
        """Return where |U| has a positive minimum in the disc, and its size: there two critical sets may appear."""
        size = np.hypot(*np.moveaxis(self._field(_NET)[0], -1, 0))
        padded = np.pad(size, 1, constant_values=math.inf)
        around = [padded[i : i + _NET_SIDE, j : j + _NET_SIDE] for i in range(3) for j in range(3) if (i, j) != (1, 1)]
        e = _NET[(size <= np.min(around, axis=0)) & _IN_DISC]
        for _ in range(_MAX_NEWTON):
            beside = e[:, None] + _STENCIL  # Newton on half the gradient of |U|^2, downhill
            U, DU = self._field(beside)
            slope = np.einsum("knji,knj->kni", DU, U)
            bend = (slope[:, 1:3] - slope[:, 3:]) / (2.0 * _DIFFERENCE_STEP)
            if not np.isfinite(bend).all():
                return e[:0], np.zeros(0), e[:0]
            rate, way = np.linalg.eigh(bend + np.swapaxes(bend, 1, 2))
            along = np.einsum("kji,kj->ki", way, slope[:, 0]) / np.maximum(0.5 * abs(rate), 1e-300)
            e = e - np.einsum("kij,kj->ki", way, np.clip(along, -_MAX_CORRECTION, _MAX_CORRECTION))
        U = self._field(e)[0]
        left = np.hypot(*U.T)
        turns = (np.hypot(*e.T) < 1.0) & (left > _ZERO_TOLERANCE * size.max())
        return e[turns], left[turns], U[turns]

    @property
    def critical(self) -> tuple[CriticalSet, ...]:
        """The critical sets."""
        return self._problem.critical

    @property
    def exponent(self) -> float | None:
        """Return the exponent of a closed equator; None where there is none."""
        cycle = self._problem.equator_cycle
        return None if cycle is None else cycle.exponent

    @property
    def plain(self) -> bool:
        """Whether nothing is degenerate here within rounding."""
        firm = self.equator.proven and not (
            self.equator.radially_degenerate.any() or (self.equator.multiplicity > 1).any()
        )
        return firm and all(C.kind.split()[0] in ("stable", "unstable", "saddle") for C in self.critical)

    @property
    def proven(self) -> bool:
        """Whether no limit direction and no critical set is missed, for certain."""
        return self.equator.proven and disc_zeros(self._problem.at.key).proven

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
