"""The steps of a slide along a critical set: a motion of (e, z) whose right-hand side is the slow flow."""

from __future__ import annotations

import numpy as np

from ..arrays import Array
from ..jit.interpreted import interpreted
from ..numerics.dense import StepArray
from ..psi.constructors import constant
from .field import Field
from .functions import functions_of
from .kernels.slow import SLOPES, SLOW_RATES, VALUE, flow, sets
from .line import InvariantLine
from .motion_steps import MotionSteps

SLOW_STEPS_PER_CALL = 64  # steps that one call fills in


class SlowSteps(MotionSteps):
    """One slide under way.

    Parameters
    ----------
    field : Field
    e : ndarray (2,)
        On the set at z.
    line, span, z, rtol, floor, most, h, least
        As in `MotionSteps`.
    """

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
        h: float,
        least: float,
    ) -> None:
        def rate(state: Array) -> Array:
            return np.array(field.value(*state[:2].tolist(), 0.0, 0.0, *state[2:].tolist()))

        first = np.concatenate([e, z])
        # eps is read as the size by which errors of e are measured: 1 and more.
        super().__init__(
            functions_of(field, constant()), rate, 1.0, line, span, first, rtol, floor, most, h=h, least=least
        )
        own = self.functions.addresses
        self.S[VALUE], self.S[SLOPES], self.S[SLOW_RATES] = *own[:2].view(float), len(z)
        self._flow = flow(self.is_at_hand)
        self.addresses = np.array([*(one.address for one in self._flow), own[2]], np.int64)

    def sets(self, steps: StepArray, u: Array) -> tuple[Array, Array]:
        """Return e (k, d, 2) and D_e U (k, d, 2, 2) at d fractions of steps."""
        first = np.concatenate([steps.first[None], steps.ends[:-1]])
        powers = u[:, None] ** np.arange(1, steps.polynomials.shape[2] + 1)
        points = first[:, None, :] + np.einsum("kij,dj->kdi", steps.polynomials, powers)
        find = sets if self.is_at_hand else interpreted(sets)
        with np.errstate(all="ignore"):
            e, D = find(self.S[VALUE : SLOPES + 1], points.reshape(-1, points.shape[2]))
        self.functions.count(0)
        return e.reshape(*points.shape[:2], 2), D.reshape(*points.shape[:2], 2, 2)
