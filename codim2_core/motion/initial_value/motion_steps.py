"""The steps of a motion, explicit or implicit, whichever costs less (`kernels.motion`).

They are inspected: none passes a switch of the formulas, and each solves its equations all along. An error estimate
sees U at the stages of a step alone: a push between two of them, or a load that is switched on after the last, escapes
it. Bounds of U along the dense output see all of it (`numerics.along`). Polynomials of low degree need none: they vary
no faster than their variables, which the estimate sees.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...formulas.arrays import path_program, polynomial_degree
from ...formulas.expression import Expression
from ...formulas.names import FAST_NAMES, SLOW_NAMES
from ...numerics.along import first_defect, zeros_along
from ...numerics.dense import StepArray
from ...numerics.radau import BlowUpError, StepsTooShortError, TooManyStepsError, tableau, too_short
from ...results.arrays import Array
from ...results.words import say
from ...systems.psi.function import Psi, direction
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

CHANGE_TOLERANCE, PER_RTOL = 1e-5, 30.0  # of the state: what a defect may change it by; of rtol, where that is larger
RATE_TOLERANCE = 1e-3  # of D_e U: the defect of a slide that leaves its critical set where it is
MARGIN_SHARE = 0.25  # of 1 - |e|, in the same unit
ACROSS = 1e-9  # of U: a larger part across an invariant line is no rounding
ROUNDED_RATE = 1e-12  # of D_e U: what bounds of U, which are taken to rounding, may part from a slip by
STIFF_RADIUS = 0.1  # of D_e U times a step: where a slip is nearer to Sigma, e turns back within the step
CONTACT = 20.0  # r in units of eps, up to which a regularised motion is held by friction
SHORTENED, ULPS = 1e-11, 8.0  # of the time: a step before a switch that none can pass; how near that is
LEAST_STEPS = 4.0  # of the shortest ones: as near is a switch that no step can pass
PASSED_SHARE = 8.0  # of how near that is: how far past it the motion goes on
RETRY_SHARE = 0.25  # of a part in which a step fails: the next one that is tried
PLAIN_DEGREE = 4  # of polynomials that hide nothing between the stages of a step
NODES = 0.5 - 0.5 * np.cos(math.pi * np.arange(DENSE_DEGREE + 1) / DENSE_DEGREE)
TO_POWERS = np.linalg.inv(NODES[:, None] ** np.arange(DENSE_DEGREE + 1))


class Cut(NamedTuple):
    """The first place at which steps cannot be kept: the step, its fraction, the next step to try, the switch there.

    `leaves_line`: a load pushes the motion out of its invariant line. `passed`: the state on the other side of a switch
    that no step can pass.
    """

    step: int
    u: float
    h: float
    switch: int | None
    leaves_line: bool = False
    passed: Array | None = None


@lru_cache(maxsize=64)
def _hiding_rows(rows: tuple[Expression, ...], m: int) -> NDArray[np.intp]:
    """Return the rows that are no polynomials of low degree."""
    names = (*FAST_NAMES, *SLOW_NAMES[:m])
    degrees = [polynomial_degree((row,), names) for row in rows]
    return np.flatnonzero([degree is None or degree > PLAIN_DEGREE for degree in degrees])


class Inspection:
    """The inspection of one motion."""

    def __init__(
        self,
        field: Field,
        psi: Psi | None,
        eps: float,
        line: InvariantLine | None,
        rtol: float,
        floor: float,
        slide: bool = False,
        at: Array | None = None,
    ) -> None:
        self.at = at
        self.field, self.psi, self.eps, self.line, self.floor, self.is_slide = (
            field,
            psi,
            eps,
            line,
            floor,
            slide or at is not None,
        )
        self.rtol, self.tolerance = rtol, max(CHANGE_TOLERANCE, PER_RTOL * rtol)
        self.guards = path_program(field.branch.guards) if field.branch.guards else None
        self.hiding = _hiding_rows(field.rows, field.m)
        self.is_plain = not len(self.hiding)
        self.program = None if self.is_plain else path_program(tuple(field.rows[i] for i in self.hiding))
        self.reads_e = any(name in row.names for row in field.rows[2:] for name in ("c", "s"))
        self.near = 0.0
        self.undecided = 0  # steps that could not be bounded, so that only samples speak for them

    def look(self, steps: StepArray, ended: tuple[Array, float] | None = None, least: float = 0.0) -> Cut | None:
        """Return where steps cannot be kept, or None; `ended`: where and when none could be made; `least`: shortest."""
        self.near = LEAST_STEPS * least
        if not len(steps.lengths):
            if ended is None or self.guards is None:
                return None
            state, t = ended
            e = state[:2] if self.is_slide else self._directions(state[None, :, None])[0, :, 0]
            return self._unreachable_switch(0, np.concatenate([e, state]), t)
        first = np.concatenate([steps.first[None], steps.ends[:-1]])
        broken = ~np.isfinite(steps.polynomials).all(axis=(1, 2))  # a stage beyond the step, of its dense output
        if self.is_plain and self.guards is None and not broken.any():
            return None
        states = np.concatenate([first[:, :, None], steps.polynomials], axis=2)
        if self.at is not None:
            states[:, :2, 0] = self.at
        e = states[:, :2] if self.is_slide else self._directions(states)
        paths = np.concatenate([e, states], axis=1)
        if self.is_slide:
            paths[:, 2:4] = 0.0
        ends = np.stack([first, steps.ends])
        defect = np.zeros(4)
        whole = int(np.argmax(broken)) if broken.any() else len(paths)
        k = whole
        if self.program is not None:
            allowed = self._allowed(ends, paths[:, :2].sum(axis=2), steps.lengths)
            k = first_defect(
                *self.program.arrays, 2 + self.hiding, paths[:whole], steps.lengths[:whole],
                *(one[:whole, self.hiding] for one in allowed), defect,
            )  # fmt: skip
            self.undecided += int(defect[3])
        cut = Cut(whole, 0.0, float(RETRY_SHARE * steps.lengths[whole]), None) if whole < len(paths) else None
        if k < whole:
            leaves = self._leaves_line(paths[k], defect[0] + 0.5 * defect[1])
            cut = Cut(k, float(defect[0]), float(RETRY_SHARE * defect[1] * steps.lengths[k]), None, leaves)
        return self._first_switch(steps, paths[: min(k + 1, whole)], cut)

    def _leaves_line(self, path: Array, u: float) -> bool:
        """Whether U leads out of the invariant line at a place of a step."""
        if self.line is None:
            return False
        at = path @ u ** np.arange(path.shape[1])
        c, s, x, y, *z = at.tolist()
        U = np.array(self.field.value(c, s, x, y, *z)[:2])
        allowed = max(ACROSS * float(np.abs(U).max()), self._rounded_rate(at))
        return abs(float(self.line.n[0] * U[1] - self.line.n[1] * U[0])) > allowed

    def _guard(self, g: int, at: Array) -> tuple[float, float]:
        """Return a guard and its rate at (c, s, x, y, z1, ...)."""
        c, s, *state = at.tolist()
        guard, values = self.field.branch.guards[g], self.field.values((c, s), state)
        rates = dict(zip(list(values)[2:], self.field.value(c, s, *state), strict=True))
        rate = sum(float(guard.derivative(name).evaluate(values)) * rates[name] for name in guard.names)
        return float(guard.evaluate(values)), rate

    def _rounded_rate(self, at: Array) -> float:
        """Return how large a rate of x and y may come of rounding at (c, s, x, y, z1, ...)."""
        c, s, x, y, *z = at.tolist()
        return ROUNDED_RATE * float(np.abs(self.field.jacobian(c, s, x, y, z)[:2, :2]).max())

    def _directions(self, states: Array) -> Array:
        """Return polynomials (k, 2, d) of e along steps, through its values at d places."""
        at = (states[:, :2] @ (NODES[:, None] ** np.arange(states.shape[2])).T).swapaxes(1, 2).reshape(-1, 2)
        e = direction(self.psi, self.eps, at, None if self.line is None else self.line.n).reshape(-1, len(NODES), 2)
        found = (e - e[:, :1]).swapaxes(1, 2) @ TO_POWERS.T  # what is constant stays so, to the last digit
        found[:, :, 0] = e[:, 0]
        return found

    def _allowed(self, ends: Array, e: Array, lengths: Array) -> tuple[Array, Array, Array]:
        """Return the defects that are allowed, as rates and changes (k, rows), and where both bounds count."""
        k, n = ends.shape[1:]
        changes = self.tolerance * (np.abs(ends).max(axis=0) + self.floor)
        rates, both = np.zeros((k, n)), np.zeros((k, n))
        r = np.hypot(ends[..., 0], ends[..., 1])
        held = np.ones(k, bool) if self.is_slide else (r <= CONTACT * self.eps).all(axis=0) & (self.eps > 0.0)
        changes[:, :2] = self.tolerance * np.hypot(r, self.eps).max(axis=0)[:, None]
        if self.eps == 0.0 and not self.is_slide:
            rounded = self._rounded_rate(np.concatenate([e[0], ends[0, 0]]))
            stiff = r.max(axis=0) < STIFF_RADIUS * lengths * rounded / ROUNDED_RATE
            rates[:, :2] = np.where(stiff, max(1.0, PER_RTOL * self.rtol / ROUNDED_RATE), 1.0)[:, None] * rounded
        if held.any():
            z = ends[0, np.argmax(held), 2:]
            at = e[held]
            slopes = self.field.jacobian(float(at[0, 0]), float(at[0, 1]), 0.0, 0.0, z.tolist())[:2, :2]
            scale = float(np.abs(slopes).max())
            if not 0.0 < scale < math.inf:  # no friction
                return rates, changes, both
            margin = np.maximum(RATE_TOLERANCE, MARGIN_SHARE * (1.0 - np.hypot(*at.T)))
            rates[held, :2] = scale * margin[:, None]
            if self.reads_e:
                both[held, :2], changes[held, :2] = 1.0, self.tolerance * scale
            elif self.is_slide:
                changes[held, :2] = 0.0
        return rates, changes, both

    def _unreachable_switch(self, k: int, at: Array, t: float) -> Cut | None:
        """Return a switch that is a rounding of the time after step k: formulas such as sqrt(abs(t)) end there."""
        near = max(self.near, ULPS * math.ulp(t))
        for g in range(len(self.field.branch.guards)):
            value, rate = self._guard(g, at)
            if 0.0 <= value <= -rate * near:
                passed = at[2:] + PASSED_SHARE * near * np.array(self.field.value(*at.tolist()))
                return Cut(k, 1.0, 0.0, g, passed=passed)
        return None

    def _first_switch(self, steps: StepArray, paths: Array, cut: Cut | None) -> Cut | None:
        """Return the first guard that turns negative before a cut, or that cut."""
        if self.guards is None:
            return cut
        found = np.empty((1, 2))
        for k, path in enumerate(paths):
            for g in range(len(self.guards.roots)):
                here = zeros_along(*self.guards.arrays, path, g, True, found)
                sooner = here and (cut is None or (k, found[0, 0]) < (cut.step, cut.u))
                at = path @ found[0, 0] ** np.arange(path.shape[1])
                if sooner and self._guard(g, at)[1] <= 0.0:  # else rounding has put it off where its branch began
                    cut = Cut(k, float(found[0, 0]), 0.0, g)
            if cut is None and steps.lengths[k] < SHORTENED * (1.0 + abs(steps.starts[k])):
                cut = self._unreachable_switch(k, path.sum(axis=1), float(steps.starts[k] + steps.lengths[k]))
            if cut is not None and cut.step == k:
                return cut
        return cut


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
