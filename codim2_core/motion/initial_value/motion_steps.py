"""The steps of a motion, explicit or implicit, whichever costs less (`kernels.motion`)."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache

import numpy as np

from ...numerics.dense import StepArray
from ...numerics.radau import BlowUpError, StepsTooShortError, TooManyStepsError, tableau, too_short
from ...results.arrays import Array
from ...results.words import say
from ...systems.psi.function import Psi, direction
from .field import Field
from .functions import FieldFunctions
from .inspection import Inspection
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
    LONGEST_STEP,
    NEXT,
    ONLY,
    SHORT,
    STEPS_LEFT,
    STEPS_TRIED,
    SWITCHED,
    UNDEFINED,
    follow_steps,
)
from .kernels.slow import SLOW_EXTENT
from .line import InvariantLine

STEPS_PER_CALL, FIRST_STEPS = 256, 16  # steps that one call fills in, and that the first one does
MAX_RETRIES = 20  # of one step, ever shorter, before it is kept for what it is
LEAST_CUT = 1e-12  # of a step: a shorter part of it is not kept


@lru_cache(maxsize=1)
def numbers_of_tableau() -> Array:
    """Return the numbers of Radau IIA as `kernels.radau.tableau_of` reads them."""
    table = tableau()
    return np.concatenate([[table.gamma], table.nodes, table.A.ravel(), table.error, table.fit.ravel()])


def rate_at(field: Field, psi: Psi | None, eps: float, line: InvariantLine | None, state: Array) -> Array:
    """Return the rate (2 + m,) at a state (2 + m,), in Python: kept in the invariant line, if there is one."""
    at = state[None, :2]
    e = direction(psi, eps, at)[0]
    rate = np.array(field.value(*e.tolist(), *state.tolist()))
    if line is not None:
        rate[:2] = line.n @ rate[:2] * line.n
    return rate


def failure(code: int, t: float, state: Array, rate: Callable[[Array], Array], least: float = 0.0) -> Exception | None:
    """Say why a motion has ended at a state (n,) before its time; None where it has not."""
    if code == LIMIT:
        return TooManyStepsError()
    if code == BLOWN_UP:
        return BlowUpError(say("blow-up time", t=t))
    if code == UNDEFINED:
        return StepsTooShortError(say("undefined from", t=t))
    return too_short(state, rate(state), t, least) if code == SHORT else None


class MotionSteps:
    """One motion under way, which stops where the formulas switch, if its steps are inspected."""

    def __init__(
        self,
        functions: FieldFunctions,
        rate: Callable[[Array], Array],  # of a state, in Python: it says why the motion ends
        eps: float,  # 0 outside Sigma: it then stops as near to Sigma as `kernels.motion.arrived` says
        line: InvariantLine | None,
        span: tuple[float, float],
        first: Array,
        rtol: float,
        floor: float,  # errors of x and y are measured by rho, those of z by |z| + floor
        most: int,  # steps tried before `TooManyStepsError`
        *,
        farthest: float = 0.0,  # the largest rho so far, of a motion outside Sigma
        h: float = 0.0,  # the first step, 0 if it is not known
        least: float = 0.0,  # a shorter step ends the motion
        longest: float = math.inf,
        implicit: bool = False,  # every step is; the slopes are requested where it begins, and where each step ends
        inspection: Inspection | None = None,
    ) -> None:
        self.inspection, self.switch, self._evaluated = inspection, None, 0.0
        self.leaves_line, self._retries = False, 0
        self.functions, self.addresses, self.rate = functions, functions.addresses, rate
        self.numbers = np.array([eps, rtol, floor, *line_directions([line])[0]])
        self.S = np.zeros(SLOW_EXTENT)
        functions.enter(self.S)
        self.y, self.clock, self.control = np.array(first), np.array([span[0], 0.0, span[1], 0.0]), np.zeros(CONTROL)
        self.control[[NEXT, STEPS_LEFT, FARTHEST_RHO, LEAST_STEP, IMPLICIT]] = h, most, farthest, least, ONLY * implicit
        self.control[LONGEST_STEP] = longest
        self.code = CHUNK_FULL

    @property
    def evaluations(self) -> int:
        """Evaluations of the field so far."""
        return int(self._evaluated + self.clock[3])

    def chunks(self, size: int = STEPS_PER_CALL) -> Iterator[StepArray]:
        """Step to the end, so many steps at a time; raises BlowUpError, TooManyStepsError and StepsTooShortError."""
        n, most = len(self.y), size
        if self.inspection is not None:  # what follows a cut, or a switch, is lost
            size = min(size, 4 * FIRST_STEPS if self.inspection.guards is None else FIRST_STEPS)
        while self.code in (CHUNK_FULL, AT_SIGMA):  # who has arrived asks for no more
            starts, lengths = np.empty(size), np.empty(size)
            ends, polynomials = np.empty((size, n)), np.empty((size, n, DENSE_DEGREE))
            begin, self._began = self.y.copy(), float(self.clock[0])
            farthest = float(self.control[FARTHEST_RHO])
            self.code, filled = follow_steps(
                self.addresses, self.numbers, numbers_of_tableau(), self.S, self.y, self.clock, self.control, starts,
                lengths, ends, polynomials,
            )  # fmt: skip
            self.functions.check()
            part = StepArray(begin, starts[:filled], lengths[:filled], ends[:filled], polynomials[:filled])
            if self.inspection is not None:
                part = self._inspected(part, self.inspection, farthest)
            if self.code == FINISHED:
                lengths[filled - 1] = self.clock[2] - starts[filled - 1]  # it ends then, to the last digit
            yield part
            size = min(2 * size, most)
        error = failure(self.code, float(self.clock[0]), self.y, self.rate, self.control[LEAST_STEP])
        if error is not None:
            raise error

    def _inspected(self, part: StepArray, inspection: Inspection, farthest: float) -> StepArray:
        """Return the steps to keep, and go back to the end of these; before them rho was at most `farthest`."""
        ended = (self.y, float(self.clock[0])) if self.code == UNDEFINED else None
        cut = inspection.look(part, ended, float(self.control[LEAST_STEP]))
        if cut is None:
            self._retries = 0
            return part
        stays = cut.step == 0 and cut.u <= LEAST_CUT and cut.switch is None and not cut.leaves_line
        self._retries = self._retries + 1 if stays else 0
        if self._retries > MAX_RETRIES:
            inspection.undecided += 1
            return part
        part = part.upto(cut.step, cut.u if cut.u > LEAST_CUT else 0.0)
        self.switch, self.leaves_line = cut.switch, cut.leaves_line
        self.code = CHUNK_FULL if cut.switch is None and not cut.leaves_line else SWITCHED
        last = len(part.lengths) - 1
        if cut.passed is not None and last >= 0:
            part.ends[last] = cut.passed
        self.y[:] = part.ends[last] if last >= 0 else part.first
        self._evaluated += self.clock[3]
        self.clock[:] = self._began if last < 0 else part.starts[last] + part.lengths[last], 0.0, self.clock[2], 0.0
        # It begins anew, as what was learnt from later steps misleads.
        self.control[[NEXT, STEPS_TRIED]] = cut.h, 0.0
        self.control[FARTHEST_RHO] = max(farthest, float(np.hypot(*part.ends[:, :2].T).max(initial=0.0)))
        self.control[IMPLICIT] = ONLY * (self.control[IMPLICIT] == ONLY)
        self.begin_at(self.y)
        return part

    def begin_at(self, y: Array) -> None:
        """Correct the state where the motion begins anew: it is as it is."""


def line_directions(lines: Sequence[InvariantLine | None]) -> Array:
    """Return the direction (k, 2) of the invariant line of each motion, 0 where there is none."""
    return np.array([(0.0, 0.0) if line is None else line.n for line in lines], float).reshape(-1, 2)
