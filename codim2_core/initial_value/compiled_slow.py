"""One slide along a critical set, compiled: a motion of (e, z) whose right-hand side is the slow flow."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..arrays import Array
from ..numerics.dense import StepArray
from ..numerics.growth import too_short
from ..numerics.radau import Problem, TooManyStepsError
from ..psi.constructors import constant
from .compiled_motion import CompiledMotion, failure
from .field import Field
from .kernels.motion import LEAST_STEP, SHORT
from .kernels.slow import SLOPES, SLOW_EXTENT, SLOW_RATES, VALUE, flow, sets
from .line import InvariantLine

SLOW_STEPS_PER_CALL = 64  # steps that one call fills in


class CompiledSlow(CompiledMotion):
    """One slide under way, compiled: its steps are of (e, z).

    Parameters
    ----------
    problem : Problem
        The slow flow in z, in Python.
    field : Field
    e : ndarray (2,)
        On the set at z.
    line, t_start, t_end, z, rtol, floor, h, most
        As in `CompiledMotion`.
    shortest : float
        A shorter step ends it.
    """

    chunk = SLOW_STEPS_PER_CALL

    def __init__(
        self,
        problem: Problem,
        field: Field,
        e: Array,
        line: InvariantLine | None,
        t_start: float,
        t_end: float,
        z: Array,
        rtol: float,
        floor: float,
        h: float,
        most: int,
        shortest: float,
    ) -> None:
        first = np.concatenate([e, z])
        # eps is read as the size by which errors of e are measured: 1 and more.
        super().__init__(problem, field, constant(), 1.0, line, t_start, t_end, first, rtol, floor, h, most)
        self.addresses = self.functions.addresses[:2].view(float)
        value, slopes = flow()
        self.motion = self.motion._replace(value=value.address, slopes=slopes.address)
        self.control[LEAST_STEP] = shortest

    def work(self) -> Any:
        """Return a workspace that holds what the slow flow reads there."""
        S = np.zeros(SLOW_EXTENT)
        S[VALUE : SLOPES + 1] = self.addresses
        S[SLOW_RATES] = len(self.y) - 2
        return super().work()._replace(S=S)

    def failure(self, code: int) -> TooManyStepsError | None:
        """Say why it has ended before its time."""
        t, z = float(self.clock[0]), self.y[2:]
        return (
            too_short(self.problem, t, z, self.control[LEAST_STEP])
            if code == SHORT
            else failure(self.problem, code, t, z)
        )

    def sets(self, steps: StepArray, u: Array) -> tuple[Array, Array]:
        """Return e (k, d, 2) and D_e U (k, d, 2, 2) at d fractions of steps."""
        first = np.concatenate([steps.first[None], steps.ends[:-1]])
        powers = u[:, None] ** np.arange(1, steps.polynomials.shape[2] + 1)
        points = first[:, None, :] + np.einsum("kij,dj->kdi", steps.polynomials, powers)
        e, D = sets(self.addresses, points.reshape(-1, points.shape[2]))
        return e.reshape(*points.shape[:2], 2), D.reshape(*points.shape[:2], 2, 2)
