"""Pass a critical set that loses its stability: the distance to its slow manifold is carried as logarithms.

In x2 = (x, y)/eps the slow manifold is x2 = M(z), and w = x2 - M obeys ``eps w' = J(z) w`` near it. Along the
eigenvectors of J, ``w = a1 v1 + a2 v2`` and ``eps (log a_i)' = lambda_i``. While the set attracts, w falls by
exp(-G/eps), far below any rounding; it has grown again where the integral of lambda is back at 0 (way in = way out), or
before, at the buffer point of a set that moves (`limit.delay`). M is found to O(eps^3); exactly if it does not move.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import chain
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..numerics.dense import StepArray, gather_steps
from ..numerics.radau import Step, TooManyStepsError, truncate_step
from ..numerics.sign_changes import root_between
from ..results.arrays import Array
from ..systems.psi.function import Psi, smoothed_direction
from .initial_value.field import Field
from .initial_value.functions import functions_of
from .initial_value.line import InvariantLine
from .initial_value.motion_steps import CONTACT, Inspection
from .initial_value.slow_manifold import solve_critical
from .initial_value.slow_steps import critical_sets_near, steps_of_z
from .limit.delay import Growth, NotAnalyticError
from .locations import inverse_gain

CLOSE = 1e-4  # w, below which the flow near the manifold is linear
DEEP = math.log(1e-6)  # log w: where it is larger, ordinary steps resolve it
LOWEST_LOG, NEVER = -700.0, -1e15  # log w: smaller ones are shown as this; of a mode that is exactly 0
MOVES = 1e-11  # of the slopes of U: a smaller drift of U by the slow flow is rounding
UNCHANGED = 1e-8  # w where the formulas switch, up to which the set is the same
NEAR_SET = 0.05  # in e: what is further from a critical set does not follow it
STILL = 1e-12  # of e: a set that moves by less does so by rounding
DERIVATIVE_STEP = 1e-4  # of the time, for dM/dt
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(4)
GAUSS = (0.5 * (1.0 + _NODES)).tolist(), (0.5 * _WEIGHTS).tolist()
FIT_NODES = 0.5 - 0.5 * np.cos(math.pi * np.arange(7) / 6.0)  # of a step, for M along it
TO_POWERS = np.linalg.inv(FIT_NODES[1:, None] ** np.arange(1, 7))
STEPS_PER_CALL = 4
LEVEL_NODES = tuple((np.arange(16) / 16.0).tolist())  # where the least distance is looked for


class SetLostError(Exception):
    """There is no critical set near where it was."""


LOST = (SetLostError, np.linalg.LinAlgError)


@dataclass(frozen=True)
class _Near:
    """The flow near a slow manifold at a z: M (2,), eigenvalues and vectors of J, z', whether the set moves."""

    M: Array
    rates: NDArray[np.complex128]
    modes: NDArray[np.complex128]
    W: Array
    moves: bool


class Passed(NamedTuple):
    """The passage: the steps of a part before it, its own, when it ends, and log w where the formulas switch.

    `turn` is when the set loses its stability; None if it does not. `failed`: why no more steps could be made.
    """

    before: StepArray
    steps: StepArray
    turn: float | None
    t_end: float
    logs: NDArray[np.complex128] | None
    failed: TooManyStepsError | None


@dataclass
class Passage:
    """The passage of a motion by one critical set."""

    formulas: Field  # on the branch of the motion
    psi: Psi
    eps: float
    line: InvariantLine | None  # that the motion stays in
    t_end: float  # as in `MotionSteps`
    rtol: float
    floor: float
    carried: NDArray[np.complex128] | None = None  # (2,) log w where the formulas have just switched
    e: Array = field(default_factory=lambda: np.zeros(2))  # (2,) Of the set, where it was found last
    # the leading real part of the eigenvalues, in units of a positive number, at the last step end that was looked
    # at; NaN if no set is followed there
    growth: float = math.nan
    followed: int = 0  # steps before the loss of stability on which w was less than `CLOSE`

    def __post_init__(self) -> None:
        if self.carried is not None:
            self.growth = -1.0  # so that a set that repels after the switch is passed at once

    def pass_by(self, parts: Sequence[StepArray], part: StepArray, most: int) -> Passed | None:
        """Pass the set where it loses its stability in a part; None where none does, or w is not far below rounding.

        `parts` are the steps before, from the last switch on. In an invariant line whose point x = y = 0 is invariant
        too, the passage begins where w is small, so that rounding takes no motion to the other side.
        """
        if not len(part.lengths):
            return None
        states = np.concatenate([part.first[None], part.ends])
        growth = self._growth(states)
        growth[0] = self.growth if math.isfinite(self.growth) else growth[0]
        self.growth = float(growth[-1])
        turns = (growth[:-1] < 0.0) & (growth[1:] > 0.0)
        arrives = np.zeros_like(turns)
        if self.line is not None and self.formulas.rests and self.carried is None:
            along = np.hypot(*states[:, :2].T) / self.eps
            arrives = (growth[1:] < 0.0) & (along[1:] < CLOSE) & (along[:-1] > 0.0)
        for k in np.flatnonzero(turns | arrives).tolist():
            u = self._arrival(part, k) if arrives[k] else 0.0
            until = part.upto(k, u)
            state, t = until.ends[-1] if len(until.lengths) else part.first, float(part.starts[k] + u * part.lengths[k])
            with suppress(*LOST):
                logs = self._logs([*parts, until], state)
                if arrives[k] or logs.real.max() < DEEP:
                    passed = self._steps(until, [*parts, until], state, t, logs, most)
                    if passed is not None:
                        return passed
        return None

    def _turn(self, step: Step) -> float | None:
        """Return when the set begins to repel within a step; None if it does not."""
        rate = lambda u: float(self.near(step.at(u)[2:], 1).rates.real.max())
        if not rate(0.0) < 0.0 < rate(1.0):
            return None
        return step.start + step.h * root_between(rate, 0.0, 1.0, 1e-14)

    def _arrival(self, part: StepArray, k: int) -> float:
        """Return the fraction of step k at which w, about 0, is `CLOSE`."""
        first, way = part.ends[k - 1] if k else part.first, part.polynomials[k]
        powers = np.arange(1, way.shape[1] + 1)
        gap = lambda u: math.hypot(*(first[:2] + way[:2] @ u**powers)) - CLOSE * self.eps
        return root_between(gap, 0.0, 1.0, 1e-12) if gap(0.0) > 0.0 > gap(1.0) else 0.0

    def _growth(self, states: Array) -> Array:
        """Return the growth (k,) at states; NaN where no set is followed."""
        found = np.full(len(states), math.nan)
        near = np.flatnonzero(np.hypot(*states[:, :2].T) <= CONTACT * self.eps)
        if not len(near):
            return found
        own = smoothed_direction(self.psi, self.eps, states[near, :2])[0]
        e, D = critical_sets_near(functions_of(self.formulas, self.psi), np.column_stack([own, states[near, 2:]]))
        r = np.hypot(*e.T)
        follows = (np.hypot(*(e - own).T) < NEAR_SET) & (r < 1.0)
        near, e, D, r = near[follows], e[follows], D[follows], r[follows]
        if self.line is not None:
            found[near] = np.einsum("i,kij,j->k", self.line.n, D, self.line.n)
            return found
        radial, tangential = self.psi.jacobian_factors(self.psi.radius(r, (1.0 - r) * (1.0 + r)))
        n = np.divide(e, r[:, None], out=np.zeros_like(e), where=r[:, None] > 0.0)
        De = tangential[:, None, None] * np.eye(2) + (radial - tangential)[:, None, None] * n[:, :, None] * n[:, None]
        J = D @ De
        trace, determinant = J[:, 0, 0] + J[:, 1, 1], J[:, 0, 0] * J[:, 1, 1] - J[:, 0, 1] * J[:, 1, 0]
        found[near] = 0.5 * trace + np.sqrt(np.maximum(0.25 * trace * trace - determinant, 0.0))
        return found

    def _logs(self, parts: Sequence[StepArray], state: Array) -> NDArray[np.complex128]:
        """Return log w (2,) along both modes at the end of some steps, with its phase as the imaginary part."""
        grown, self.followed = np.zeros(2, complex), 0
        self.e = smoothed_direction(self.psi, self.eps, state[None, :2])[0][0]
        here = self.near(state[2:])
        if here.moves and not here.rates.imag.any():  # it exchanges stability: terms of order eps part the sets
            raise SetLostError
        w = state[:2] / self.eps - here.M
        for step in (step for steps in reversed(parts) for step in reversed(tuple(steps))):
            if math.hypot(*w) >= CLOSE:
                break
            for u, weight in zip(*GAUSS, strict=True):
                grown += step.h * weight * self.near(step.at(u)[2:], 1).rates
            here = self.near(step.first[2:])
            w = step.first[:2] / self.eps - here.M
            self.followed += 1
        if self.carried is not None and math.hypot(*w) < UNCHANGED:
            return self.carried + grown / self.eps
        return self._start(w, here, grown)

    def _start(self, w: Array, here: _Near, grown: NDArray[np.complex128]) -> NDArray[np.complex128]:
        """Return log w after its modes have grown."""
        if self.line is not None:
            own = np.array([w @ self.line.n, 0.0], complex)
        else:
            own = np.linalg.lstsq(here.modes, w.astype(complex))[0]
        return np.array([cmath.log(a) if a else complex(NEVER) for a in own.tolist()]) + grown / self.eps

    def near(self, z: Array, order: int = 2) -> _Near:
        """Return the flow near the slow manifold, to O(eps^(order + 1)), at z; raises SetLostError."""
        if self.line is not None and self.formulas.rests:
            return self._at_rest(self.line, z)
        M, J, moves = self._manifold(z, order)
        at = self.eps * M
        e = smoothed_direction(self.psi, self.eps, at[None])[0][0]
        W = np.array(self.formulas.value(*e.tolist(), *at.tolist(), *z.tolist())[2:])
        if self.line is not None:
            n = self.line.n
            rates, modes = np.full(2, n @ J @ n, complex), np.column_stack([n, np.zeros(2)]).astype(complex)
        else:
            rates, modes = _eigensystem(J)
        return _Near(M, rates, modes, W, moves)

    def _at_rest(self, line: InvariantLine, z: Array) -> _Near:
        """Return the flow near x = y = 0 in an invariant line, where it is invariant too."""
        rate = float(self.psi.jacobian_factors(0.0)[0]) * line.slope(0.0, z)
        W = np.array(self.formulas.value(0.0, 0.0, 0.0, 0.0, *z.tolist())[2:])
        modes = np.column_stack([line.n, np.zeros(2)]).astype(complex)
        return _Near(np.zeros(2), np.full(2, rate, complex), modes, W, False)

    def _manifold(self, z: Array, order: int) -> tuple[Array, Array, bool]:
        """Return M (2,) to O(eps^(order + 1)) and J (2, 2) at z, and whether the critical set moves."""
        slow, U = z.tolist(), np.array(self.formulas.value(*self.e.tolist(), 0.0, 0.0, *z.tolist())[:2])
        e = solve_critical(self.formulas, self.e, z) if U.any() else self.e
        if e is None or not math.hypot(*e) < 1.0:
            raise SetLostError
        self.e = e
        zeta, n, De = inverse_gain(self.psi, e)
        D = self.formulas.jacobian(float(e[0]), float(e[1]), 0.0, 0.0, slow)
        J = D[:2, :2] @ De + self.eps * D[:2, 2:4]
        drift = D[:2, 4:] @ np.array(self.formulas.value(*e.tolist(), 0.0, 0.0, *slow)[2:])
        M, moves = zeta * n, bool(np.abs(drift).max() > MOVES * np.abs(D[:2]).max())
        if order == 0 or not (moves or D[:2, 2:4].any()):
            return M, J, moves
        velocity = self._velocity(z, order - 1) if order > 1 else -np.linalg.solve(D[:2, :2] @ De, drift)
        for _ in range(2):  # eps x2' = U, by Newton's method
            at = self.eps * M
            own, slope = smoothed_direction(self.psi, self.eps, at[None])
            c, s, x, y = np.concatenate([own[0], at]).tolist()
            U = np.array(self.formulas.value(c, s, x, y, *slow)[:2])
            D = self.formulas.jacobian(c, s, x, y, slow)
            J = self.eps * (D[:2, :2] @ slope[0] + D[:2, 2:4])
            M = M + np.linalg.solve(J, self.eps * velocity - U)
        return M, J, moves

    def _velocity(self, z: Array, order: int) -> Array:
        """Return dM/dt along the slow flow."""
        W = np.array(self.formulas.value(*self.e.tolist(), 0.0, 0.0, *z.tolist())[2:])
        e, ends = self.e, []
        for sign in (-1.0, 1.0):
            ends.append(self._manifold(z + sign * DERIVATIVE_STEP * W, order)[0])
            self.e = e
        return (ends[1] - ends[0]) / (2.0 * DERIVATIVE_STEP)

    def _steps(
        self,
        until: StepArray,
        parts: Sequence[StepArray],
        state: Array,
        t: float,
        logs: NDArray[np.complex128],
        most: int,
    ) -> Passed | None:
        """Follow the slow manifold from a state until w has grown again, or to the end, or to a switch."""
        first = np.concatenate([self.eps * logs.real, self.eps * logs.imag, state[2:]])
        motion = steps_of_z(self._rate, self._slopes, (t, self.t_end), first, self.rtol, self.floor, most)
        inspection = Inspection(self.formulas, self.psi, self.eps, self.line, self.rtol, self.floor, slide=True)
        taken, places, left, carried, turn, failed = list[Step](), [self._place(state[2:])], None, None, None, None
        try:
            for step in chain.from_iterable(motion.chunks(STEPS_PER_CALL)):
                before, u = (taken[-1].last[:2] if taken else state[:2]), self._grown(step)
                slide, shown = self._shown(step, u, before)
                cut = inspection.look(gather_steps([slide], len(state)))
                if cut is not None:
                    u *= cut.u
                    slide, shown = self._shown(step, u, before)
                    last = step.at(u)
                    carried = (last[2:4] + 1j * last[4:6]) / self.eps
                if turn is None:
                    turn = self._turn(shown)
                taken.append(shown)
                places.append(slide.last[:2])
                left = shown.end if u < 1.0 and cut is None else None
                if u < 1.0:
                    break
        except LOST:
            pass
        except TooManyStepsError as error:
            failed = error
        if not taken:
            return None
        way = self._buffer(parts, taken, places, t)
        if way is not None and (left is None or way < left):
            i = next(i for i, step in enumerate(taken) if step.end >= way)
            last = truncate_step(taken[i], (way - taken[i].start) / taken[i].h)
            here = self.near(last.last[2:])
            end = self.eps * (here.M + CLOSE * here.modes[:, 0].real)
            taken = [*taken[:i], last._replace(last=np.concatenate([end, last.last[2:]]))]
            left, carried = way, None
        return Passed(until, gather_steps(taken, len(state)), turn, taken[-1].end, carried, failed)

    def _buffer(
        self, parts: Sequence[StepArray], taken: Sequence[Step], places: Sequence[Array], turn: float
    ) -> float | None:
        """Return when the buffer point ends the delay of a set that moves; None where none does, or none is known."""
        if self.line is not None or len(taken) < 2 or np.ptp(places, axis=0).max() < STILL:
            return None
        before = [step for part in parts for step in part][-self.followed :]
        with suppress(NotAnalyticError, *LOST):
            first = [self._place(step.first[2:]) for step in reversed(before)][::-1]
            growth = Growth(self.formulas.whole or self.formulas, self.psi, [*before, *taken], [*first, *places])
            # What the buffer leaves behind, w of ``eps w' = lambda w - eps M'`` past its saddle point, lambda = 0.
            speed = math.hypot(*self._velocity(taken[0].first[2:], 0))
            slope = abs(float(np.diff(growth.rate([turn - DERIVATIVE_STEP, turn + DERIVATIVE_STEP]))[0]))
            w = math.sqrt(math.tau * self.eps * 2.0 * DERIVATIVE_STEP / slope) * speed
            way = growth.way_out(turn, self.eps * math.log(CLOSE / w))
            return None if way is None or way.buffer is None else way.t
        return None

    def _place(self, z: Array) -> Array:
        """Return e (2,) of the set at z."""
        self._manifold(z, 0)
        return self.e

    def _rate(self, y: Array) -> Array:
        here = self.near(y[4:])
        return np.concatenate([here.rates.real, here.rates.imag, here.W])

    def _slopes(self, y: Array) -> Array:
        """Return the derivatives of the rates, of those of z only: no others are ever stiff."""
        found = np.zeros((len(y), len(y)))
        found[4:, 4:] = self.formulas.jacobian(float(self.e[0]), float(self.e[1]), 0.0, 0.0, y[4:].tolist())[2:, 4:]
        return found

    def _grown(self, step: Step) -> float:
        """Return the fraction of a step at which w has grown to `CLOSE` after it was least; 1 if it has not."""
        top = self.eps * math.log(CLOSE)
        level = lambda u: float(step.at(u)[2:4].max()) - top
        if level(1.0) <= 0.0:
            return 1.0
        least = min(LEVEL_NODES, key=level)
        return root_between(level, least, 1.0, 1e-14) if level(least) < 0.0 else 1.0

    def _shown(self, step: Step, u: float, before: Array) -> tuple[Step, Step]:
        """Return the part of a step up to its fraction u as one of (e, z) in the limit, and as one of (x, y, z)."""
        way = step.polynomial[6:] * u ** np.arange(1, step.polynomial.shape[1] + 1)
        e, M = [], []
        for node in FIT_NODES.tolist():
            M.append(self._manifold(step.at(u * node)[6:], 2)[0])
            e.append(self.e)
        last = step.at(u)
        end = self.eps * (M[-1] + self._distance(last[2:4], last[4:6], self.near(last[6:]).modes))
        places = self.eps * np.array(M[1:])
        places[-1] = end
        if not np.ptp(M, axis=0).any():  # it does not move
            places = before + (end - before) * FIT_NODES[1:, None]
        slide, shown = (
            np.vstack([np.pad(polynomial, ((0, 0), (0, way.shape[1] - polynomial.shape[1]))), way])
            for polynomial in ((TO_POWERS @ (np.array(e[1:]) - e[0])).T, (TO_POWERS @ (places - before)).T)
        )
        z = step.first[6:]
        return (
            Step(step.start, u * step.h, np.concatenate([e[0], z]), np.concatenate([e[-1], last[6:]]), slide),
            Step(step.start, u * step.h, np.concatenate([before, z]), np.concatenate([end, last[6:]]), shown),
        )

    def _distance(self, logs: Array, phases: Array, modes: NDArray[np.complex128]) -> Array:
        """Return w (2,) of eps log w and eps times its phase (2,), along the modes."""
        sizes = np.exp(np.clip(logs / self.eps, LOWEST_LOG, 0.0))
        return (modes @ (sizes * np.exp(1j * phases / self.eps))).real


def _eigensystem(J: Array) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    """Return the eigenvalues (2,) of J and its eigenvectors in columns, that of the larger real part first.

    Where one axis is invariant they are those of the axes in their order, as they may pass each other.
    """
    (a, b), (c, d) = J.tolist()
    if b == 0.0 or c == 0.0:
        rates = [complex(a), complex(d)]
    else:
        root = cmath.sqrt(0.25 * (a - d) ** 2 + b * c)
        rates = [0.5 * (a + d) + root, 0.5 * (a + d) - root]
    if b == c == 0.0:
        return np.array(rates), np.eye(2, dtype=complex)
    columns = [(b, rate - a) if abs(b) >= abs(c) else (rate - d, c) for rate in rates]
    modes = np.array(columns, complex).T
    return np.array(rates), modes / np.sqrt((np.abs(modes) ** 2).sum(axis=0))
