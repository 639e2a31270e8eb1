"""Equilibria at single values of a parameter: found exactly there, and compared with those at other values."""

from __future__ import annotations

from collections import Counter
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...portrait.layer_problem.critical import CriticalSet
from ...portrait.layer_problem.disc_zeros import disc_zeros
from ...portrait.layer_problem.equator import EquatorEquilibria
from ...portrait.layer_problem.problem import LayerProblem
from ...portrait.layer_problem.vary import vary
from ...results.arrays import Array
from ...systems.psi.function import Psi

_TEST_PLACES = 0.97 * np.stack([np.cos(np.arange(32.0)), np.sin(np.arange(32.0))], axis=-1)
#: Of the span: so near, and at no even steps, U is a parabola but for its rounding.
_TEST_OFFSETS = 1e-14 * np.array([-3.0, -1.3, 0.0, 1.7, 3.1])
_PARABOLA_BASIS = np.vander(_TEST_OFFSETS / _TEST_OFFSETS.max(), 3)
_RESIDUAL_PROJECTOR = np.eye(len(_TEST_OFFSETS)) - _PARABOLA_BASIS @ np.linalg.pinv(_PARABOLA_BASIS)
_MIN_ROUGHNESS = 1e-11  # of |U|: less moves no zero that is distinct from its neighbours
_SMOOTH_OFFSETS = 2.0 ** np.arange(-32.0, -5.0)  # of the span: how far from a rough value one that is not is looked for


class State:
    """Equilibria at one value of a parameter."""

    def __init__(self, problem: LayerProblem, value: float) -> None:
        self.value, self._problem = value, problem
        self.equator: EquatorEquilibria = problem.equator
        self.critical: tuple[CriticalSet, ...] = problem.critical
        cycle = problem.equator_cycle
        self.exponent = None if cycle is None else cycle.exponent
        kinds = [self.equator.kind(k) for k in range(len(self.equator))]
        sign = None if cycle is None else int(np.sign(cycle.exponent))
        self.parts = Counter(kinds), Counter(C.kind for C in self.critical), sign
        self.places = on_circle(self.equator.theta)

    @cached_property
    def plain(self) -> bool:
        """Whether nothing is degenerate here within rounding."""
        on = self.equator
        firm = on.proven and not (on.radially_degenerate.any() or (on.multiplicity > 1).any()) and self.parts[2] != 0
        return firm and all(C.kind.split()[0] in ("stable", "unstable", "saddle") for C in self.critical)

    @property
    def turn(self) -> float:
        """Angle from the axes of a matrix as given to those of this system."""
        return self._problem.at.turn

    @property
    def proven(self) -> bool:
        """Whether no limit direction and no critical set is missed, for certain."""
        return self._problem.at.affine is not None or (self.equator.proven and disc_zeros(self._problem.at.key).proven)

    def difference(self, other: State) -> int | None:
        """First part that is not that of the other; None if all are."""
        return next((i for i in range(3) if self.parts[i] != other.parts[i]), None)


class States:
    """States of a system along one of its parameters, each found once."""

    def __init__(self, system: Any, psi: Psi, name: str, span: tuple[float, float], z: ArrayLike) -> None:
        self._given, self.span = (system, psi, z, name), span
        self.width = span[1] - span[0]
        self._known: dict[float, State | None] = {}
        self._rough: list[tuple[float, float]] = []
        self.refusal: ValueError | None = None

    def __call__(self, value: float) -> State | None:
        """Find the equilibria at a value; None where U is not finite, or is all rounding."""
        if any(low < value < high for low, high in self._rough):
            return None
        if value not in self._known:
            try:
                self._known[value] = State(self._problem(value), value)
            except ValueError as error:
                self.refusal, self._known[value] = error, None
        return self._known[value]

    def _problem(self, value: float) -> LayerProblem:
        at, psi, z = vary(*self._given, value)
        return LayerProblem(at.at(z), psi)

    def between(self, low: float, high: float) -> list[State]:
        """Return the states known from one value to another, in order."""
        known = [v for v in self._known if low <= v <= high]
        return [state for v in sorted(known) if (state := self(v)) is not None]

    def leave_out(self, low: float, high: float) -> None:
        """Find no state between two values from now on."""
        self._rough.append((low, high))

    def leave_out_rounding(self, value: float) -> bool:
        """Leave out a zone about a value in which U is all rounding, if there is one.

        A formula such as (F(q) - F(1))/(1 - q) goes smoothly through q = 1, but next to it equilibria come and go by
        rounding, which a finite difference of U shows and no derivative does.
        """
        if self._is_clear(value):
            return False
        (low, high), ends = self.span, []
        for side in (-1.0, 1.0):
            shifted = (value + side * self.width * _SMOOTH_OFFSETS).tolist()
            ends.append(next((v for v in shifted if not low < v < high or self._is_clear(v)), None))
        if None in ends:
            return False
        self.leave_out(max(ends[0], low), min(ends[1], high))
        return True

    def _is_clear(self, value: float) -> bool:
        near = np.clip(value + self.width * _TEST_OFFSETS, *self.span).tolist()
        try:
            U = np.array([self._problem(v).at.U(_TEST_PLACES) for v in near])
        except ValueError:
            return False
        return bool(np.abs(np.tensordot(_RESIDUAL_PROJECTOR, U, 1)).max() <= _MIN_ROUGHNESS * np.abs(U).max())


def on_circle(theta: Array) -> Array:
    """Return (cos, sin) of angles, (..., 2)."""
    return np.stack([np.cos(theta), np.sin(theta)], axis=-1)
