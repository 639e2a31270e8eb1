"""Shooting: a motion over a period, how far its end is from its start, and the step of Newton's method.

A motion X(t) is periodic if ``X(T) = X(0) + a``, where a is how far the slow variables are on after a period: 0, or a
period of the formulas, as 2 pi of an angle. Where a period multiplies a change by more than 1e4, the motion is cut into
segments, each from a start X_1, ..., X_k of its own (Keller 1968; Ascher, Mattheij and Russell 1995). With S_i the
derivative of the end E_i of a segment by its start, and p_i its part of the period, Newton's step is

    S_i dX_i + p_i E_i' dT - dX_(i+1) = -(E_i - X_(i+1)),   X_(k+1) = X_1 + a,

in all but the clocks, whose start is kept, and where there is one, without dT; else with ``X_1' . dX_1 = 0`` as well,
because every point of a periodic motion is a start of it.

Floquet multipliers that are known are set: 1 of a shift in time, 0 of what is lost. The monodromy matrix is M = P_K ...
P_1, a product over steps. Its eigenvalues are those of the product begun at any other step: P_i ... P_1 P_K ...
P_(i+1). In the limit eps -> 0 this begins where most is lost. On a slide (x, y) = 0 and the state is z alone: two
multipliers are 0, the others are those of z by z. Where the motion crosses Sigma, (x, y) = 0 too, and a motion next to
it is given by z and by when it leaves, along e: one multiplier is 0. So zeros are exact, and not what rounding leaves
of them.

Where the motion is shot in segments, M = S_k ... S_1 is never multiplied out: large multipliers would drown small ones.
Sweeps of QR decompositions around the period, ``S_i Q_(i-1) = Q_i R_i`` (periodic Schur form: Bojanczyk, Golub and Van
Dooren 1992), turn Q_0 into an invariant basis, and each multiplier is a product of diagonal entries of R_i.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property, reduce
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ...numerics.assignment import assign
from ...results.arrays import Array, Complex
from ...results.words import say
from ...systems.kinds import AnySystem
from ...systems.psi.function import Psi
from ..initial_value.field import Field
from ..locations import place_on_hemisphere
from ..regularised import simulate_segments
from ..result import Simulation, SimulationStatus
from ..simulate import simulate
from ..variation.propagators import Variation
from .result import PeriodicStatus

SWEEPS = 8  # around the period
DEFLATED = 1e-11  # what a sweep still turns of a direction into those before it, where they are apart


def rate_at(formulas: Field, psi: Psi | None, run: Simulation, i: int) -> Array:
    """Rate (2 + m,) with which a motion goes on from the end of a step."""
    x, y, *z = run.states[i].tolist()
    if run.eps > 0.0:
        assert psi is not None
        e = place_on_hemisphere(psi, run.eps, x, y)[0]
    elif x or y:
        e = np.array([x, y]) / np.hypot(x, y)
    else:
        t = float(run.times[i])
        phase = next(one for one in reversed(run.phases) if one.t_start <= t and (one.kind != "slip" or one.t_end > t))
        e = phase.e(min(t, phase.t_end))
        found = np.array(formulas.value(*e.tolist(), x, y, *z))
        if phase.kind == "slide":
            found[:2] = 0.0
        return found
    return np.array(formulas.value(*e.tolist(), x, y, *z))


def start_of(run: Simulation, variation: Variation) -> tuple[int, Array]:
    """Step end at which most is lost, and a basis (2, k) of the changes of (x, y) that are left there."""
    plane = np.eye(2) if variation.within is None else variation.within[:2, :1]
    if run.eps > 0.0:
        return 0, plane
    on = (run.states[:, :2] == 0.0).all(axis=1)
    for phase in run.phases:
        if phase.kind == "slide" and phase.t_end > phase.t_start:
            within = on & (run.times >= phase.t_start) & (run.times <= phase.t_end)
            return int(np.argmax(within)), np.empty((2, 0))
    for phase in run.phases:
        if phase.kind == "cross":
            at = int(np.argmin(np.where(on, np.abs(run.times - phase.t_start), np.inf)))
            return at, phase.e(phase.t_start)[:, None]
    return 0, plane


def multipliers(
    formulas: Field, psi: Psi | None, run: Simulation, variation: Variation, clocks: NDArray[np.bool_],
    cuts: Sequence[int] = (0,),
) -> tuple[Complex, Array, int]:  # fmt: skip
    """Return the multipliers, largest first, their conditions (relative errors to first order), and how many are 0."""
    n = run.states.shape[1]
    steps = variation.propagators[:, :n, :n]
    i, plane = start_of(run, variation)
    slow = np.eye(n)[:, 2:] if variation.within is None else variation.within[:, 1:]
    slow = slow[:, ~slow[2:][clocks].any(axis=0)]
    basis = np.concatenate([np.concatenate([plane, np.zeros((n - 2, plane.shape[1]))]), slow], axis=1)

    def across(k: int) -> Array:  # the motion
        if clocks.any():
            return basis
        ahead = basis.T @ rate_at(formulas, psi, run, k)
        return basis @ np.linalg.qr(ahead[:, None], mode="complete")[0][:, 1:]

    steps, starts = [*steps[i:], *steps[:i]], [i, *cuts[1:]]
    bases = [across(k) for k in (*starts, i)]
    segments = [
        after.T @ reduce(lambda product, step: step @ product, steps[low - i : high - i], np.eye(n)) @ before
        for (low, high), (before, after) in zip(pairwise([*starts, i + len(steps)]), pairwise(bases), strict=True)
    ]
    found, conditions = _product_eigenvalues(segments)
    lost = (2 if variation.within is None else 1) - plane.shape[1]
    order = np.argsort(-np.abs(found), kind="stable")
    zeros = np.zeros(lost)
    return np.concatenate([found[order], zeros.astype(complex)]), np.concatenate([conditions[order], zeros]), lost


def _product_eigenvalues(factors: Sequence[Array]) -> tuple[Complex, Array]:
    """Eigenvalues of a product, the first factor acting first, and their condition.

    An error of a segment moves what is deflated by the same share: conditions are those of an error of the product.
    """
    if len(factors) == 1:
        return _eigenvalues(factors[0])
    n = len(factors[0])
    turned = first = upper = np.eye(n)
    for _ in range(SWEEPS):
        first, upper = turned, np.eye(n)
        for factor in factors:
            turned, right = np.linalg.qr(factor @ turned)
            upper = right @ upper
    mixed = first.T @ turned  # of the product in the basis `first`: mixed @ upper
    borders = [k for k in range(1, n) if np.abs(mixed[k:, :k]).max() < DEFLATED]
    blocks = [mixed[low:high, low:high] @ upper[low:high, low:high] for low, high in pairwise([0, *borders, n])]
    parts = [_eigenvalues(block) for block in blocks]
    sizes = [np.linalg.norm(block) for block in blocks]
    shares = [condition * size / max(sizes) for (_, condition), size in zip(parts, sizes, strict=True)]
    return np.concatenate([values for values, _ in parts]), np.concatenate(shares)


def _eigenvalues(matrix: Array) -> tuple[Complex, Array]:
    """Eigenvalues, and their condition 1/|l.r|, l and r the eigenvectors of length 1."""
    values, right = np.linalg.eig(matrix)
    try:
        left = np.linalg.inv(right)
    except np.linalg.LinAlgError:
        return values.astype(complex), np.full(len(values), np.inf)
    return values.astype(complex), np.linalg.norm(left, axis=1) * np.linalg.norm(right, axis=0)


def matching_distances(values: Complex, others: Complex) -> Array:
    """Distance of each value to its partner among as many others, partners being chosen to be close in all."""
    apart = np.abs(values[:, None] - others[None, :])
    return apart[np.arange(len(values)), assign(apart)]


MAX_SEGMENT_GROWTH = (
    1e4  # of a change along a segment, in units of the motion's size; where it is more there are more segments
)
NULL_SINGULAR_VALUE = (
    1e-8  # singular values of M - 1, or of M if that is larger, that count as 0: nothing moves, as in a family
)


class LostError(Exception):
    """A motion cannot be followed, or not be differentiated, over a period."""

    def __init__(self, status: PeriodicStatus, reason: str, run: Simulation) -> None:
        super().__init__(reason)
        self.status, self.run = status, run


@dataclass(frozen=True, eq=False)
class Shooting:
    """A boundary value problem: the unknowns and conditions of a periodic motion."""

    system: AnySystem
    psi: Psi | None
    eps: float  # 0 for the limit
    formulas: Field
    clocks: NDArray[np.bool_]  # (m,) Slow variables that move at a constant rate
    advance: Array  # (m,)
    period: float  # where its search begins
    floor: float  # what small z are measured by
    max_steps: int
    stiction: float = 1.0  # static over kinetic friction
    max_step: float = np.inf
    names: tuple[str, ...] = ()  # numbers of the system by which motions are differentiated too
    parts: tuple[float, ...] = (0.0,)  # where segments begin, as parts of the period; several for eps > 0 only

    @property
    def is_forced(self) -> bool:
        """Whether the period is known."""
        return bool(self.clocks.any())

    @cached_property
    def free(self) -> NDArray[np.bool_]:
        """Return which of (x, y, z) are unknown."""
        return np.concatenate([[True, True], ~self.clocks])

    def follow(self, starts: Array, period: float, rtol: float) -> tuple[Simulation, tuple[int, ...], Array]:
        """Follow a motion over a period from the starts of its segments (k, 2 + m): its run, cuts and ends."""
        options = {"rtol": rtol, "atol": rtol * self.floor, "max_steps": self.max_steps, "max_step": self.max_step}
        if self.eps == 0.0 or len(starts) == 1:
            span = (0.0, period)
            run = simulate(self.system, self.psi, starts[0], span, eps=self.eps, stiction=self.stiction, **options)
            return run, (0, len(run.times) - 1), run.states[-1:]
        assert self.psi is not None
        starts, times = starts.copy(), period * np.array([*self.parts, 1.0])
        starts[1:, 2:][:, self.clocks] = (starts[0, 2:] + np.outer(self.parts, self.advance))[1:, self.clocks]
        return simulate_segments(self.system, self.psi, starts, times, eps=self.eps, **options)

    def shot(self, starts: Array, period: float, rtol: float) -> Shot:
        """Follow a motion over a period, and differentiate it; LostError where it ends before or has no derivative."""
        run, cuts, ends = self.follow(np.atleast_2d(starts), period, rtol)
        if run.status is not SimulationStatus.T_END:
            raise LostError(PeriodicStatus.MOTION_ENDS, f"{say('motion ends early')} {run.reason}", run)
        variation = run.variation(*self.names)
        if variation.reason or not (np.isfinite(variation.rate).all() and np.isfinite(variation.last).all()):
            raise LostError(PeriodicStatus.NO_DERIVATIVE, f"{say('no derivative')} {variation.reason}".strip(), run)
        return Shot(self, run, period, variation, cuts, ends)

    def divide(self, run: Simulation, first: int, period: float, variation: Variation) -> tuple[Shooting, Array]:
        """Divide a motion, begun at a step end, where changes have grown: the problem, and starts (k, 2 + m)."""
        n, sizes, count = run.states.shape[1], _sizes(run, self), len(variation.propagators)
        scale = sizes / sizes[:, None]
        growth, cuts = np.eye(n), [first]
        for k in range(first, first + count) if self.eps > 0.0 else ():
            step = (variation.propagators[k % count, :n, :n] * scale)[np.ix_(self.free, self.free)]
            growth = step if k == cuts[-1] else step @ growth
            if k > cuts[-1] and np.linalg.norm(growth, 2) > MAX_SEGMENT_GROWTH:
                growth, cuts = step, [*cuts, k]
        starts = np.array([run.states[k % count] for k in cuts])
        times = np.array([run.times[k % count] + period * (k // count) for k in cuts])
        starts[:, 2:] += np.outer([k // count for k in cuts], self.advance)
        parts = (times - times[0]) / period
        return replace(self, parts=tuple(parts.tolist())), starts


@dataclass(frozen=True, eq=False)
class Shot:
    """A motion over what may be its period, with its derivatives; `cuts` and `ends` are those of its segments."""

    of: Shooting
    run: Simulation
    period: float
    variation: Variation
    cuts: tuple[int, ...]
    ends: Array

    @property
    def state(self) -> Array:
        """Its start."""
        return self.run.states[0]

    @property
    def starts(self) -> Array:
        """Those of its segments (k, 2 + m)."""
        return self.run.states[list(self.cuts[:-1])]

    @cached_property
    def sizes(self) -> Array:
        """Return the scales (2 + m,) by which a difference counts as small."""
        return _sizes(self.run, self.of)

    @cached_property
    def miss(self) -> Array:
        """Return the differences (k, 2 + m) of ends and the starts that follow."""
        starts = self.starts
        found = self.ends - np.roll(starts, -1, axis=0)
        found[-1, 2:] -= self.of.advance
        found[:, ~self.of.free] = 0.0
        return found

    @property
    def residual(self) -> float:
        """Its size."""
        return self.norm(self.sizes)

    def norm(self, sizes: Array) -> float:
        """Size of it, small being measured by `sizes`."""
        return float(np.abs(self.miss / sizes).max())

    def slopes(self, free: NDArray[np.bool_], sizes: Array) -> tuple[Array, Array, Array]:
        """Return the derivatives of what is missed of `free`: by the starts, by the period, and of segments by all."""
        k, n, q = len(self.ends), len(self.state), int(free.sum())
        steps, count = self.variation.propagators, self.variation.propagators.shape[1]
        segments = np.array([
            reduce(lambda product, step: step @ product, steps[low:high], np.eye(count))[:n]
            for low, high in pairwise(self.cuts)
        ])[:, free] / sizes[:, None]  # fmt: skip
        by_starts = np.zeros((k, q, k, q))
        for i in range(k):
            by_starts[i, :, i] += segments[i][:, :n][:, free] * sizes
            by_starts[i, :, (i + 1) % k] -= np.eye(q)
        rates = [rate_at(self.of.formulas, self.of.psi, self.run, cut) for cut in self.cuts[1:-1]]
        parts = np.diff([*self.of.parts, 1.0])
        by_period = np.array([*rates, self.variation.rate])[:, free] / sizes * parts[:, None]
        return by_starts.reshape(k * q, k * q), by_period, segments

    @cached_property
    def step(self) -> tuple[Array, float]:
        """Newton's step of the starts (k, 2 + m) and of the period."""
        free, sizes = self.of.free, self.sizes[self.of.free]
        matrix, ahead, _ = self.slopes(free, sizes)
        right = -(self.miss[:, free] / sizes).ravel()
        if not self.of.is_forced:
            behind = np.zeros(len(right))
            behind[: len(sizes)] = rate_at(self.of.formulas, self.of.psi, self.run, 0) * self.period / sizes
            matrix = np.block([[matrix, ahead.reshape(-1, 1) * self.period], [behind[None], np.zeros((1, 1))]])
            right = np.append(right, 0.0)
        found = _least_solution(matrix, right)
        change = np.zeros(self.ends.shape)
        change[:, free] = found[: self.ends[:, free].size].reshape(len(change), -1) * sizes
        return change, 0.0 if self.of.is_forced else float(found[-1]) * self.period

    @property
    def step_size(self) -> float:
        """Size of the step, in units of the motion's."""
        change, later = self.step
        return max(float(np.abs(change / self.sizes).max()), abs(later) / self.period)


def _sizes(run: Simulation, of: Shooting) -> Array:
    found = np.abs(run.states).max(axis=0) + of.floor
    found[:2] = np.hypot(*run.states[:, :2].T).max() + of.eps
    found[:2] = found[:2] if found[0] > 0.0 else 1.0
    return found


def _least_solution(matrix: Array, right: Array) -> Array:
    """Least solution of linear equations, exactly 0 in what couples to none whose right side is not 0."""
    linked = (matrix != 0.0) | (matrix != 0.0).T
    moved = right != 0.0
    for _ in right:
        moved = moved | linked[:, moved].any(axis=1)
    found = np.zeros(len(right))
    left, values, along = np.linalg.svd(matrix[np.ix_(moved, moved)])
    large = values > NULL_SINGULAR_VALUE * max(1.0, values.max(initial=0.0))
    found[moved] = along.T[:, large] @ ((left.T @ right[moved])[large] / values[large])
    return found
