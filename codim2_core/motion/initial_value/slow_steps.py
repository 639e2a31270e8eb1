"""The steps of a slide along a critical set: a motion of (e, z) whose right-hand side is the slow flow."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ...numerics.dense import StepArray
from ...results.arrays import Array
from ...systems.psi.constructors import constant
from .field import Field
from .functions import FieldFunctions, called_back, functions_of
from .kernels.slow import SLOPES, SLOW_EXTENT, SLOW_RATES, VALUE, flow, sets
from .line import InvariantLine
from .motion_steps import MotionSteps
from .slow_manifold import solve_critical

SLOW_STEPS_PER_CALL = 64  # steps that one call fills in


class SlowSteps(MotionSteps):
    """One slide under way."""

    def __init__(
        self,
        field: Field,
        e: Array,
        line: InvariantLine | None,
        span: tuple[float, float],
        z: Array,
        rtol: float,
        floor: float,
        most: int,
        **how: Any,
    ) -> None:
        def rate(state: Array) -> Array:
            return np.array(field.value(*state[:2].tolist(), 0.0, 0.0, *state[2:].tolist()))

        self.field, first = field, np.concatenate([e, z])
        # eps is read as the size by which errors of e are measured: 1 and more.
        super().__init__(functions_of(field, constant()), rate, 1.0, line, span, first, rtol, floor, most, **how)
        own = self.functions.addresses
        self.S[VALUE], self.S[SLOPES], self.S[SLOW_RATES] = *own[:2].view(float), len(z)
        self._flow = flow()
        self.addresses = np.array([*(one.address for one in self._flow), own[2]], np.int64)

    def begin_at(self, y: Array) -> None:
        """Put e on the set, from which the dense output may have parted before a push that it did not see."""
        e = solve_critical(self.field, y[:2], y[2:])
        if e is not None:
            y[:2] = e

    def sets(self, steps: StepArray, u: Array) -> tuple[Array, Array]:
        """Return e (k, d, 2) and D_e U (k, d, 2, 2) at d fractions of steps."""
        first = np.concatenate([steps.first[None], steps.ends[:-1]])
        powers = u[:, None] ** np.arange(1, steps.polynomials.shape[2] + 1)
        points = first[:, None, :] + np.einsum("kij,dj->kdi", steps.polynomials, powers)
        points, places = points.reshape(-1, points.shape[2]), points.shape[:2]
        e, D = sets(self.S, points)
        return e.reshape(*places, 2), D.reshape(*places, 2, 2)


def critical_sets_near(functions: FieldFunctions, points: Array) -> tuple[Array, Array]:
    """Return the critical sets e (k, 2) near points (k, 2 + m), (e, z), NaN for none, and D_e U (k, 2, 2)."""
    S = np.zeros(SLOW_EXTENT)
    functions.enter(S)
    S[VALUE], S[SLOPES], S[SLOW_RATES] = *functions.addresses[:2].view(float), points.shape[1] - 2
    return sets(S, points)


def steps_of_z(
    rate: Callable[[Array], Array],
    slopes: Callable[[Array], Array],
    span: tuple[float, float],
    z: Array,
    rtol: float,
    floor: float,
    most: int,
    **how: Any,
) -> MotionSteps:
    """Return a motion on Sigma of which only z moves, at a rate that Python gives."""
    m = len(z)

    def value(*at: float) -> list[float]:
        return [0.0, 0.0, *rate(np.array(at[4:])).tolist()]

    def derivatives(*at: float) -> list[float]:
        found = np.zeros((2 + m, 4 + m))
        found[2:, 4:] = slopes(np.array(at[4:]))
        return found.ravel().tolist()

    first = np.concatenate([np.zeros(2), z])
    return MotionSteps(
        called_back(m, value, derivatives), lambda state: np.array(value(0.0, 0.0, *state)), 1.0, None, span, first,
        rtol, floor, most, **how,
    )  # fmt: skip
