"""The steps of a motion, explicit or implicit, whichever costs less (`kernels.motion`)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache

import numpy as np

from ..arrays import Array
from ..numerics.dense import StepArray
from ..numerics.growth import BlowUpError, too_short
from ..numerics.radau import StepsTooShortError, TooManyStepsError, tableau
from ..psi.function import Psi
from ..stepping.field_parameters import PSI
from ..words import say
from .field import Field
from .functions import FieldFunctions
from .kernels.explicit import DENSE_DEGREE
from .kernels.motion import (
    AT_SIGMA,
    BLOWN_UP,
    CHUNK_FULL,
    CONTROL,
    FARTHEST_RHO,
    FINISHED,
    IMPLICIT,
    LEAST_STEP,
    LIMIT,
    NEXT,
    ONLY,
    SHORT,
    STEPS_LEFT,
    UNDEFINED,
    follow_steps,
)
from .kernels.slow import SLOW_EXTENT
from .line import InvariantLine
from .slopes import outside, smoothed_direction

STEPS_PER_CALL = 256  # steps that one call fills in


@lru_cache(maxsize=1)
def numbers_of_tableau() -> Array:
    """Return the numbers of Radau IIA as `kernels.stages.tableau_of` reads them."""
    table = tableau()
    return np.concatenate([[table.gamma], table.nodes, table.A.ravel(), table.error, table.fit.ravel()])


def rate_at(field: Field, psi: Psi | None, eps: float, line: InvariantLine | None, state: Array) -> Array:
    """Return the rate (2 + m,) at a state (2 + m,), in Python: kept in the invariant line, if there is one."""
    at = state[None, :2]
    e = (outside(at) if eps == 0.0 or psi is None else smoothed_direction(psi, eps, at))[0][0]
    rate = np.array(field.value(*e.tolist(), *state.tolist()))
    if line is not None:
        rate[:2] = line.n @ rate[:2] * line.n
    return rate


def failure(code: int, t: float, state: Array, rate: Callable[[Array], Array], least: float = 0.0) -> Exception | None:
    """Say why a motion has ended before its time; None where it has not.

    Parameters
    ----------
    code : int
        Of `integrate_motion`.
    t : float
    state : ndarray (n,)
        The last ones.
    rate : callable
        Of the state.
    least : float
        The shortest step.
    """
    if code == LIMIT:
        return TooManyStepsError()
    if code == BLOWN_UP:
        return BlowUpError(say("blow-up time", t=t))
    if code == UNDEFINED:
        return StepsTooShortError(say("undefined from", t=t))
    return too_short(state, rate(state), t, least) if code == SHORT else None


class MotionSteps:
    """One motion under way.

    Parameters
    ----------
    functions : FieldFunctions
    rate : callable
        The rate of a state in Python: it says why the motion ends.
    eps : float
        0 outside Sigma: it then stops where it is as close to Sigma as `kernels.motion.arrived` says.
    line : InvariantLine or None
        The invariant line it stays in.
    span : (t_start, t_end)
    first : ndarray (n,)
    rtol, floor : float
        Errors of x and y are measured by rho, those of z by |z| + floor; times rtol they may be made in a step.
    most : int
        Steps tried before `TooManyStepsError`.
    farthest : float
        The largest rho so far, of a motion outside Sigma.
    h, least : float
        The first step, 0 if it is not known; a shorter one than `least` ends the motion.
    implicit : bool
        Every step is: the slopes are then asked for once where it begins, and where each step ends.
    """

    def __init__(
        self,
        functions: FieldFunctions,
        rate: Callable[[Array], Array],
        eps: float,
        line: InvariantLine | None,
        span: tuple[float, float],
        first: Array,
        rtol: float,
        floor: float,
        most: int,
        *,
        farthest: float = 0.0,
        h: float = 0.0,
        least: float = 0.0,
        implicit: bool = False,
    ) -> None:
        self.functions, self.addresses, self.rate = functions, functions.addresses, rate
        self.numbers = np.array([eps, rtol, floor, *line_directions([line])[0]])
        self.S = np.zeros(SLOW_EXTENT)
        self.S[PSI] = functions.parameter
        self.y, self.clock, self.control = np.array(first), np.array([span[0], 0.0, span[1], 0.0]), np.zeros(CONTROL)
        self.control[[NEXT, STEPS_LEFT, FARTHEST_RHO, LEAST_STEP, IMPLICIT]] = h, most, farthest, least, ONLY * implicit
        self.code = CHUNK_FULL

    @property
    def evaluations(self) -> int:
        """Evaluations of the field so far."""
        return int(self.clock[3])

    def chunks(self, size: int = STEPS_PER_CALL) -> Iterator[StepArray]:
        """Step to the end, so many steps at a time.

        Raises
        ------
        BlowUpError
            The state grows beyond all bounds in no time.
        TooManyStepsError, StepsTooShortError
        """
        n = len(self.y)
        while self.code in (CHUNK_FULL, AT_SIGMA):  # who has arrived asks for no more
            starts, lengths = np.empty(size), np.empty(size)
            ends, polynomials = np.empty((size, n)), np.empty((size, n, DENSE_DEGREE))
            begin, before = self.y.copy(), self.evaluations
            self.code, filled = follow_steps(
                self.addresses, self.numbers, numbers_of_tableau(), self.S, self.y, self.clock, self.control, starts,
                lengths, ends, polynomials,
            )  # fmt: skip
            self.functions.count(self.evaluations - before)
            if self.code == FINISHED:
                lengths[filled - 1] = self.clock[2] - starts[filled - 1]  # it ends then, to the last digit
            yield StepArray(begin, starts[:filled], lengths[:filled], ends[:filled], polynomials[:filled])
        error = failure(self.code, float(self.clock[0]), self.y, self.rate, self.control[LEAST_STEP])
        if error is not None:
            raise error


def line_directions(lines: Sequence[InvariantLine | None]) -> Array:
    """Return the direction (k, 2) of the invariant line of each motion, 0 where there is none."""
    return np.array([(0.0, 0.0) if line is None else line.n for line in lines], float).reshape(-1, 2)
