"""Pass close to x = y = 0 where that is invariant: the distance to it is carried as a logarithm.

In an invariant line, with U = 0 at e = 0 for every z, ``r' = r (lambda(z)/eps + O(r/eps))`` near r = 0, with lambda the
derivative of U along the line. While the line attracts, r falls by exp(-G/eps), far below any rounding; it has grown
again where the integral of lambda is back at 0. So ``eps log r`` is one more slow variable, and r keeps its sign.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..arrays import Array
from ..initial_value.field import Field
from ..initial_value.inspection import Inspection
from ..initial_value.line import InvariantLine
from ..initial_value.motion_steps import MotionSteps
from ..initial_value.slow_steps import steps_of_z
from ..numerics.dense import StepArray
from ..numerics.radau import Step, TooManyStepsError
from ..numerics.root_between import root_between
from ..psi.function import Psi

CLOSE = 1e-4  # r in units of eps, below which the flow is linear
LEVEL_NODES = tuple((np.arange(16) / 16.0).tolist())  # of a step, where the least r is looked for
LOWEST_LOG, LEAST_RADIUS = -700.0, 1e-300  # log(r/eps), r: smaller ones are shown as these


@dataclass(frozen=True)
class RestingDistance:
    """A motion in an invariant line whose point x = y = 0 is invariant too."""

    field: Field
    psi: Psi
    eps: float
    line: InvariantLine
    t_end: float
    rtol: float
    floor: float

    def arrival(self, part: StepArray) -> tuple[int, float] | None:
        """Return the step and its fraction at which r is small while the line attracts; None if it is not."""
        along = np.concatenate([part.first[None], part.ends])[:, :2] @ self.line.n
        for k in np.flatnonzero((np.abs(along[1:]) < CLOSE * self.eps) & (along[:-1] != 0.0)).tolist():
            if self.rate(part.ends[k, 2:])[0] >= 0.0:
                continue
            if abs(along[k]) <= CLOSE * self.eps:
                return k, 0.0
            way, side = part.polynomials[k, :2].T @ self.line.n, math.copysign(1.0, along[k])
            powers = np.arange(1, len(way) + 1)
            gap = lambda u: side * (along[k] + float(way @ u**powers)) - CLOSE * self.eps  # noqa: B023
            return k, root_between(gap, 0.0, 1.0, 1e-12)
        return None

    def rate(self, z: Array) -> Array:
        """Return the rates of eps log r and of z."""
        gain = float(self.psi.jacobian_factors(0.0)[0])
        found = np.array(self.field.value(0.0, 0.0, 0.0, 0.0, *z.tolist()))
        found[1] = gain * self.line.slope(0.0, z)
        return found[1:]

    def passage(self, part: StepArray, k: int, u: float, most: int) -> Iterator[StepArray]:
        """Yield the steps up to where r is small, and those until it has grown again, or to the end."""
        began, part = float(part.starts[0]), part.upto(k, u)
        if len(part.lengths):
            yield part
            t, state = float(part.starts[-1] + part.lengths[-1]), part.ends[-1]
        else:
            t, state = began, part.first
        taken, failed = [], None
        try:
            for step in self._steps(state, t, most):
                taken.append(step)  # noqa: PERF402 (what came before an error is kept)
        except TooManyStepsError as error:
            failed = error
        if taken:
            yield StepArray(state, *(np.array(column) for column in zip(*taken, strict=True)))
        if failed is not None:
            raise failed

    def _steps(self, state: Array, t: float, most: int) -> Iterator[tuple[float, float, Array, Array]]:
        """Yield start, length, end and polynomial of steps of (x, y, z), r far below eps."""
        along = float(state[:2] @ self.line.n)
        side, top = math.copysign(1.0, along), self.eps * math.log(CLOSE)
        first = np.concatenate([[self.eps * math.log(max(abs(along), LEAST_RADIUS) / self.eps)], state[2:]])
        motion = steps_of_z(
            lambda z: self.rate(z[1:]), self._slopes, (t, self.t_end), first, self.rtol, self.floor, most
        )
        before = state[:2]
        for step in self._up_to_switch(motion):
            u, level = 1.0, lambda u, step=step: float(step.at(u)[2]) - top
            if level(1.0) > 0.0:  # it has grown again after it was least
                least = min(LEVEL_NODES, key=level)
                u = root_between(level, least, 1.0, 1e-14) if level(least) < 0.0 else 1.0
            last = step.at(u)
            size = min(max(float(last[2]) / self.eps, LOWEST_LOG), 0.0)
            end = side * self.eps * math.exp(size) * self.line.n
            way = step.polynomial * u ** np.arange(1, step.polynomial.shape[1] + 1)
            way[:2] = 0.0
            way[:2, 0], before = end - before, end
            yield step.start, u * step.h, np.concatenate([end, last[3:]]), np.concatenate([way[:2], way[3:]])
            if level(1.0) > 0.0:
                return

    def _up_to_switch(self, motion: MotionSteps) -> Iterator[Step]:
        """Yield the steps of (eps log r, z) until the formulas switch."""
        inspection = Inspection(self.field, self.psi, self.eps, self.line, self.rtol, self.floor, at=np.zeros(2))
        rest = lambda array: np.delete(array, 2, axis=array.ndim - 1)
        for part in motion.chunks():
            ways = np.delete(part.polynomials, 2, axis=1)
            cut = inspection.look(StepArray(rest(part.first), part.starts, part.lengths, rest(part.ends), ways))
            yield from part if cut is None else part.upto(cut.step, cut.u)
            if cut is not None:
                return

    def _slopes(self, z: Array) -> Array:
        """Return the derivatives of the rates by (eps log r, z); that of lambda, which is never stiff, as 0."""
        found = np.zeros((len(z), len(z)))
        found[1:, 1:] = self.field.jacobian(0.0, 0.0, 0.0, 0.0, z[1:].tolist())[2:, 4:]
        return found
