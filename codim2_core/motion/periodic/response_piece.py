"""One piece of a response curve: its unknowns, measured by one motion, and its conditions with their slopes."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ...numerics.arclength import newton
from ...portrait.layer_problem.vary import vary
from ...results.arrays import Array
from ...systems.psi.constructors import constant
from ..initial_value.field import field
from ..result import Simulation
from .result import ResponseRow
from .shooting import LostError, Shooting, Shot, multipliers, rate_at

SAMPLES = 8  # places within a step, between which extremes are looked for
NEWTON_ROUNDS = 3  # of the place of an extreme within a step: its error is the square each time


def amplitude_of(run: Simulation) -> Array:
    """Return half of the difference of the extremes of x, y, z1, ..., zm over a motion, (2 + m,)."""
    motion = run.motion
    u = np.arange(1, SAMPLES + 1) / SAMPLES
    d = motion.polynomials.shape[2]
    powers = u[:, None] ** np.arange(1, d + 1)
    inside = motion.states[:-1, :, None] + np.einsum("kjd,sd->kjs", motion.polynomials, powers)
    found = np.empty((2, motion.states.shape[1]))
    for j in range(motion.states.shape[1]):
        for k, sign in enumerate((1.0, -1.0)):
            values = sign * inside[:, j]
            step, sample = np.unravel_index(int(values.argmax()), values.shape)
            best = max(float(values.max()), float((sign * motion.states[:, j]).max()))
            for at in {int(step), min(int(step) + 1, len(values) - 1)}:  # it may lie just behind a step's end
                best = max(
                    best, sign * _step_extreme(motion.polynomials[at, j], motion.states[at, j], float(u[sample]))
                )
            found[k, j] = sign * best
    return 0.5 * (found[0] - found[1])


def _step_extreme(polynomial: Array, start: float, u: float) -> float:
    """Return the value of a step's polynomial at the zero of its derivative next to u, within the step."""
    d = np.arange(1, len(polynomial) + 1)
    for _ in range(NEWTON_ROUNDS):
        slope = float((d * polynomial) @ u ** (d - 1.0))
        bend = float((d * (d - 1.0) * polynomial)[1:] @ u ** (d[1:] - 2.0))
        u = min(max(u - slope / bend, 0.0), 1.0) if bend else u
    return float(start + polynomial @ u**d)


PERIOD_STEP = 1e-6  # relative: for the slope of a period that is given
JUMPS = 1e-6, 1e-5, 1e-4, 1e-3  # of the span: how far beyond a corner, where a phase begins, the curve is sought again
MAX_JUMP = 0.1  # of the motion's size, by which it may differ there


@dataclass(frozen=True, eq=False)
class MotionFamily:
    """Boundary value problems along the parameter."""

    first: Shooting
    along: str
    span: tuple[float, float]
    period_of: Callable[[float], float]
    advance: Array | None
    rtol: float

    def at(self, value: float) -> Shooting:
        """Return the problem at a value."""
        system, _, _ = vary(self.first.system, constant(), (), self.along, value)
        formulas = field(system)
        rates = np.array([row.constant or 0.0 for row in formulas.rows[2:]])
        advance = rates * self.period_of(value) if self.advance is None else self.advance
        return replace(self.first, system=system, formulas=formulas, advance=advance, names=(self.along,))

    def clock(self, value: float) -> Array:
        """Return how long a period is (1,) and how far z is on after it (m,), at a value."""
        return np.array([self.forced_period(value), *self.at(value).advance])

    def forced_period(self, value: float) -> float:
        """Return the period that a clock gives."""
        if self.advance is None:
            return self.period_of(value)
        rows = self.at(value).formulas.rows[2:]
        i = int(np.argmax(self.first.clocks))
        return float(self.advance[i]) / float(rows[i].constant or math.nan)


@dataclass(frozen=True, eq=False)
class Piece:
    """Unknowns measured by one motion: (X_i - X_ref)/sizes, T/T_ref - 1 without a clock, and the part of the span.

    The X_i are the starts of its segments, mostly one.

    What is exactly 0, and stays so whatever else is changed, as across an invariant line, is none of the `free` ones:
    so rounding does not lead out of it.
    """

    family: MotionFamily
    starts: Array
    parts: tuple[float, ...]
    sizes: Array
    period: float
    normal: Array
    free: NDArray[np.bool_]

    @property
    def forced(self) -> bool:
        """Whether a clock gives the period."""
        return self.family.first.is_forced

    def unknowns(self, starts: Array, period: float, value: float) -> Array:
        """Return the unknowns (n,) of a motion: starts, period where none is given, parameter."""
        low, high = self.family.span
        moved = ((starts - self.starts) / self.sizes)[:, self.free].ravel()
        more = [] if self.forced else [period / self.period - 1.0]
        return np.array([*moved, *more, (value - low) / (high - low)])

    def motion_of(self, v: Array) -> tuple[Array, float, float]:
        """Return starts, period and value of unknowns."""
        (low, high), starts = self.family.span, self.starts.copy()
        n = starts[:, self.free].size
        starts[:, self.free] += v[:n].reshape(len(starts), -1) * self.sizes[self.free]
        value = low + float(v[-1]) * (high - low)
        period = self.family.forced_period(value) if self.forced else self.period * (1.0 + float(v[n]))
        return starts, period, value

    def starts_on(self, run: Simulation, period: float, value: float, part: float) -> Array:
        """Return where segments would begin on another motion: at the same clock, or from a part of its period on."""
        advance = self.family.at(value).advance
        if self.forced:
            k = int(np.argmax(self.family.first.clocks))
            part = float((self.starts[0, 2 + k] - run.states[0, 2 + k]) / advance[k])
        times = part + np.array(self.parts)
        starts = run.dense(times % 1.0 * period)
        starts[:, 2:] += np.outer(times // 1.0, advance)
        return starts

    def at(self, value: float) -> Shooting:
        """Return the problem at a value, in the segments of the piece."""
        return replace(self.family.at(value), parts=self.parts)

    def shot(self, v: Array) -> Shot:
        """Follow the motion of unknowns over a period; LostError where that cannot be."""
        starts, period, value = self.motion_of(v)
        return self.at(value).shot(starts, period, self.family.rtol)

    def condition(self, v: Array) -> tuple[Array, Array]:
        """Conditions with all slopes; NaN where the motion cannot be followed."""
        count = len(v)
        try:
            shot = self.shot(v)
        except (LostError, ValueError):
            return np.full(count - 1, math.nan), np.full((count - 1, count), math.nan)
        free, n = self.free, len(shot.state)
        sizes, width = self.sizes[free], self.family.span[1] - self.family.span[0]
        by_starts, by_period, segments = shot.slopes(free, sizes)
        slope, rows = np.zeros((count - 1, count)), len(by_starts)
        slope[:rows, :rows] = by_starts
        by_value = segments[:, :, n]
        if self.forced:
            period, *advance = self.clock_slope(self.motion_of(v)[2])
            moved = np.outer(self.parts, np.where(shot.of.clocks, advance, 0.0))  # the clocks at the starts
            by_value = by_value + by_period * period + np.einsum("iqm,im->iq", segments[:, :, 2:n], moved)
        else:
            slope[:rows, rows] = by_period.ravel() * self.period
            slope[rows, : len(sizes)] = self.normal[free]
        slope[:rows, -1] = by_value.ravel() * width
        value = (shot.miss[:, free] / sizes).ravel()
        return (value if self.forced else np.append(value, self.normal[free] @ v[: len(sizes)])), slope

    def clock_slope(self, value: float) -> Array:
        """Return the derivative of the period that is given, and of how far z is on after it."""
        step = PERIOD_STEP * max(abs(value), self.family.span[1] - self.family.span[0])
        before, after = (self.family.clock(value + sign * step) for sign in (-1.0, 1.0))
        return (after - before) / (2.0 * step)


def measure_piece(family: MotionFamily, run: Simulation, period: float, value: float) -> tuple[Piece, float]:
    """Measure by a motion, begun anew where it is farthest from Sigma; at which part of the period that is."""
    i, own = int(np.argmax(np.hypot(*run.states[:-1, :2].T))), family.at(value)
    own, starts = own.divide(run, i, period, run.variation()) if own.eps > 0.0 else (own, run.states[i : i + 1].copy())
    part = float(run.times[i]) / period
    if own.is_forced:  # near time 0, so that a change of a frequency changes the phase little
        k, advance = int(np.argmax(own.clocks)), own.advance
        starts[:, 2:] -= advance * np.round(starts[0, 2 + k] / advance[k])
    shot = own.shot(starts, period, family.rtol)
    ahead = rate_at(own.formulas, own.psi, shot.run, 0) / shot.sizes
    coupled = np.column_stack([shot.variation.last, shot.variation.rate, shot.miss.T]) != 0.0
    coupled[:, : len(ahead)] &= ~np.eye(len(ahead), dtype=bool)
    free = own.free & ((starts != 0.0).any(axis=0) | coupled.any(axis=1))
    normal = ahead / max(float(np.linalg.norm(ahead)), 1e-300)
    return Piece(family, starts, own.parts, shot.sizes, period, normal, free), part


def response_row(piece: Piece, v: Array, onward: float) -> ResponseRow | None:
    """Return the motion of unknowns; None where it cannot be followed."""
    try:
        shot = piece.shot(v)
    except (LostError, ValueError):
        return None
    own = shot.of
    values, _, _ = multipliers(own.formulas, own.psi, shot.run, shot.variation, own.clocks, shot.cuts[:-1])
    _, period, value = piece.motion_of(v)
    kinds = [phase.kind for phase in shot.run.phases]
    if len(kinds) > 1 and kinds[0] == kinds[-1]:  # one phase, in which it starts
        kinds.pop()
    return ResponseRow(value, period, shot.state, amplitude_of(shot.run), values, tuple(kinds), onward)


def at_value(piece: Piece, start: Array, value: float) -> Array | None:
    """Find the motion at a value of the last unknown, near a start (n - 1,); None if there is none."""

    def condition(u: Array) -> tuple[Array, Array]:
        found, slope = piece.condition(np.append(u, value))
        return found, slope[:, :-1]

    found = newton(condition, start, MAX_JUMP)
    return None if found is None else np.append(found, value)


def jump_corner(piece: Piece, before: Array, last: Array) -> Array | None:
    """Find the curve beyond a place where it has a corner, as where a stick begins; None if it is not seen there."""
    way = math.copysign(1.0, float(last[-1] - before[-1]))
    for value in (float(last[-1]) + way * jump for jump in JUMPS):
        found = at_value(piece, last[:-1], value) if 0.0 <= value <= 1.0 else None
        if found is not None:
            return found
    return None
