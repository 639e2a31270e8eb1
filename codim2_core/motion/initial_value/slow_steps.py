"""The steps of a slide along a critical set: a motion of (e, z) whose right-hand side is the slow flow.

Cheap bounds rule out, for many steps at once, that the slide ends within them.

What turns negative where a slide ends is taken at five points of each step, and bounded between them by the polynomial
through these, as `events.monotone_fractions` does.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...numerics.dense import StepArray
from ...results.arrays import Array
from ...systems.psi.constructors import constant
from ...systems.psi.function import Psi
from .events import chebyshev_coefficients
from .field import Field
from .functions import FieldFunctions, called_back, functions_of
from .kernels.slow import SLOPES, SLOW_EXTENT, SLOW_RATES, VALUE, flow, sets
from .line import InvariantLine
from .motion_steps import MotionSteps
from .slow_manifold import solve_critical

SAFE_DEGREE = 4
LEFT_OUT = 8.0
FOLD_MARGIN = 1e-8  # det D_e U, or what turns with it in a line, in units of its entries: a smaller one counts as zero
SAFE_NODES = 0.5 - 0.5 * np.cos(math.pi * np.arange(SAFE_DEGREE + 1) / SAFE_DEGREE)
COEFFICIENTS = np.array([chebyshev_coefficients(row) for row in np.eye(SAFE_DEGREE + 1)])


def _stays_positive(values: Array) -> NDArray[np.bool_]:
    """Whether a gauge (k, 5) is positive along each step: its polynomial's mean exceeds the rest, and the remainder."""
    of = values @ COEFFICIENTS
    sizes = np.abs(of[:, 1:])
    return of[:, 0] > sizes.sum(axis=1) + LEFT_OUT * sizes[:, -2:].sum(axis=1)  # not for NaN


def dissipation(D: Array) -> Array:
    """Return the least rate (...) at which friction takes energy from slips: of -(D + D^T)/2, D = D_e U (..., 2, 2)."""
    a, d, b = D[..., 0, 0], D[..., 1, 1], 0.5 * (D[..., 0, 1] + D[..., 1, 0])
    return -0.5 * (a + d) - np.hypot(0.5 * (a - d), b)


@dataclass(frozen=True)
class StepRequirements:
    """Requirements on the steps of a slide."""

    psi: Psi
    sign: float  # of det D_e U where the slide begins
    n: Array | None  # (2,) Along the invariant line that the motion stays in
    reach: float = 1.0  # |e| up to which it slides: above 1 at rest by static friction, while D_e U is dissipative

    def steps(self, e: Array, D: Array) -> list[bool]:
        """Tell for k steps, with e (k, 5, 2) and D_e U (k, 5, 2, 2) at their `SAFE_NODES`."""
        r = np.hypot(e[..., 0], e[..., 1])
        gap = (1.0 - r) * (1.0 + r)
        safe = _stays_positive((self.reach - r) * (self.reach + r))
        margin = FOLD_MARGIN * np.abs(D).max(axis=(2, 3))
        if self.n is not None:
            return (safe & _stays_positive(-np.einsum("i,kdij,j->kd", self.n, D, self.n) - margin)).tolist()
        margin *= margin / FOLD_MARGIN
        safe &= _stays_positive(self.sign * (D[..., 0, 0] * D[..., 1, 1] - D[..., 0, 1] * D[..., 1, 0]) - margin)
        if self.reach > 1.0:
            return (safe & _stays_positive(dissipation(D))).tolist()
        if not safe.any():
            return safe.tolist()
        n = np.where(r[..., None] > 0.0, e / np.where(r > 0.0, r, 1.0)[..., None], (1.0, 0.0))
        radial = np.einsum("kdi,kdij,kdj->kd", n, D, n)
        across = D[..., 0, 0] + D[..., 1, 1] - radial
        stable = _stays_positive(-radial) & _stays_positive(
            -across
        )  # tr J is a sum of both, each times a positive number
        if not stable[safe].all():
            ratio, inside = np.ones_like(r), (r > 0.0) & (gap > 0.0)
            along, tangential = self.psi.jacobian_factors(self.psi.radius(np.minimum(r[inside], 1.0), gap[inside]))
            ratio[inside] = along / tangential
            stable |= _stays_positive(-(across + ratio * radial))
        return (safe & stable).tolist()


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
