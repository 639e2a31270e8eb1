"""The variational equation in the limit eps -> 0: along slips and slides, with a saltation matrix where one begins.

A change of the start moves an arrival at Sigma by dt. What is known of the motion after it, at fixed times, is moved
with it: z by dt (W- - W+), and (x, y), if the motion leaves at once, by -dt U+. Where a critical set leaves through the
equator, both fields agree and the motion begins with no speed: nothing is added there. Where static friction lets go,
|e(z)| is at its reach, which gives dt: ``e.D_z e (dz + dt W-) = 0``.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, reduce
from itertools import pairwise
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...numerics.dense import Dense
from ...results.arrays import Array
from ...results.words import say
from ...systems.kinds import AnySystem
from ...systems.psi.function import Psi, outside
from ..initial_value.field import Slopes, slopes_of
from ..initial_value.line import InvariantLine
from .propagators import (
    Propagators,
    Variation,
    chain_propagators,
    pad_jacobians,
    past_jumps,
    propagators,
    shrinks_across,
    states_along,
)

StepIndices = NDArray[np.intp]

RTOL = 1e-10  # how far a part of a step and its halves may differ
EQUATOR_DISTANCE = 1e-6  # 1 - |e| at which a slide has ended there
LEAVES = 1e-13  # of the largest slope: what turns U out of a line by more than rounding
NEUTRAL_RATE = 1e-9  # lambda_theta, in units of U, up to which a line does not repel: all directions are alike
TINY = 1e-300
AT_REST = 1e-6  # |U| on a critical set, in units of its slopes: on a limit cycle e is a mean, where U is not zero


class Phase(Protocol):
    """The data of one phase of the motion that its variation needs."""

    @property
    def kind(self) -> str: ...  # noqa: D102
    @property
    def t_start(self) -> float: ...  # noqa: D102
    @property
    def t_end(self) -> float: ...  # noqa: D102
    def e(self, t: ArrayLike, /) -> Array: ...  # noqa: D102


def of_nonsmooth(
    system: AnySystem,
    psi: Psi | None,
    motion: Dense,
    phases: Callable[[], Sequence[Phase]],
    line: InvariantLine | None,
    jumps: Mapping[float, bool],
    names: Sequence[str],
) -> Variation:
    """Differentiate a motion by its start, and by numbers of its system."""
    course, legs = _Course(slopes_of(system, names), motion, None, jumps), list(_legs(motion, phases()))
    if line is not None and any(
        course.repels(leg, line.n) and not (following and course.shrinks(system, psi, leg, following, line.n))
        for leg, following in pairwise([*legs, None])
        if leg
    ):
        course = replace(course, n=line.n)
    start = course.line_projector.copy()
    if legs and legs[0].slides:
        start[:2] = 0.0
    fine, coarse, before, reason = [course.none.fine], [course.none.coarse], start, ""
    for leg, following in pairwise([*legs, None]):
        assert leg is not None
        found, reason = course.differentiate_leg(leg, following, before)
        before = reduce(lambda product, step: step @ product, found.fine, before)
        fine.append(found.fine)
        coarse.append(found.coarse)
        if reason:
            break
    matrices, longer = np.concatenate(fine), np.concatenate(coarse)
    for first in (matrices[:1], longer[:1]):
        first @= start
    matrices, longer, lost = past_jumps(matrices, longer, motion.times, jumps, course.slopes)
    reason, end = lost or reason, len(matrices)
    times, rate = motion.times[: end + 1], course.rate(legs, end)
    return chain_propagators(tuple(names), times, matrices, longer, rate, reason, course.line_basis)


@dataclass(frozen=True)
class _Leg:
    """Consecutive steps of one kind: a slide, or a slip from Sigma or from outside, to Sigma or to the end."""

    first: int
    last: int
    slides: tuple[Phase, ...]  # the phases of a slide; none for a slip
    from_sigma: bool
    to_sigma: bool
    left: bool  # it leaves Sigma with no speed, where a slide ended


def _legs(motion: Dense, phases: Sequence[Phase]) -> Iterator[_Leg]:
    """Cut a motion where it arrives at Sigma, and where it leaves."""
    on = (motion.states[:, :2] == 0.0).all(axis=1)
    sliding = on[:-1] & on[1:] & ~motion.polynomials[:, :2].any(axis=(1, 2))
    cuts = np.flatnonzero(on[1:-1] & ~(sliding[:-1] & sliding[1:])) + 1
    behind: tuple[Phase, ...] = ()
    for first, last in pairwise([0, *cuts.tolist(), len(sliding)]):
        start, end = float(motion.times[first]), float(motion.times[last])
        slides = [p for p in phases if p.kind == "slide" and start <= p.t_start <= end and start < p.t_end <= end]
        own = tuple(slides) if sliding[first] else ()
        left = first > 0 and bool(sliding[first - 1]) and not any(map(_is_let_go, behind))
        yield _Leg(first, last, own, bool(on[first]), bool(on[last]), left)
        behind = own[-1:]


@dataclass(frozen=True, eq=False)
class _Course:
    """A motion that is being differentiated, in the plane, or only in the line along n."""

    slopes: Slopes
    motion: Dense
    n: Array | None
    jumps: Mapping[float, bool]

    @property
    def size(self) -> int:
        """Return the length of the state together with that of the varied numbers."""
        return self.motion.states.shape[1] + len(self.slopes.kept)

    def differentiate_leg(self, leg: _Leg, following: _Leg | None, before: Array) -> tuple[Propagators, str]:
        """Differentiate the steps of a leg, and what happens at its end; say why it is not known further."""
        return self.slide(leg, following, before) if leg.slides else self.slip(leg, following, before)

    def slide(self, leg: _Leg, following: _Leg | None, before: Array) -> tuple[Propagators, str]:
        """Along a slide: ``z' = W(e(z), z)`` on the critical set e(z), (4.17)."""
        parts, first, reason = [self.none], leg.first, ""
        for phase, later in pairwise([*leg.slides, None]):
            assert phase is not None
            if not self.rests(phase):
                reason = say("variation on a cycle", t=phase.t_start)
                break
            last, jumps = leg.last, phase.t_end in self.jumps
            goes_on = later is not None or following is not None
            if later is not None or (goes_on and not jumps and not _at_equator(phase)):
                last = int(np.searchsorted(self.motion.times, phase.t_end, side="left"))
                reason = "" if jumps else say("variation past an end", t=phase.t_end)
            slopes = lambda steps, u, phase=phase: self.slide_slopes(phase, steps, u)
            found = self.propagate(range(first, last), slopes, before)
            parts.append(found)
            if reason or later is None:
                break
            before, first = reduce(lambda product, step: step @ product, found.fine, before), last
        found = Propagators(*(np.concatenate([getattr(one, of) for one in parts]) for of in ("fine", "coarse")))
        phase = leg.slides[-1]
        if following is not None and not reason and _is_let_go(phase) and phase.t_end not in self.jumps:
            matrix = self.letting_go(phase, following)
            for matrices in (found.fine, found.coarse):
                matrices[-1] = matrix @ matrices[-1]
        return found, reason

    def letting_go(self, phase: Phase, following: _Leg) -> Array:
        """Saltation matrix of the end of a slide where |e| is at the reach of static friction."""
        t = phase.t_end
        e, still, sooner = phase.e([t]), self.sliding_rate(phase, t), np.zeros(self.size)
        sooner[2:] = e[0] @ self.set_slopes(self.slopes.at(e, self.motion(t)[None]))[0]
        found = np.eye(self.size)
        found[: len(still)] += np.outer(self.initial_rate(following) - still, sooner / (sooner[: len(still)] @ still))
        return found

    def slip(self, leg: _Leg, following: _Leg | None, before: Array) -> tuple[Propagators, str]:
        """Along a slip, from where it leaves Sigma to where it arrives."""
        near = self.arrival_step(leg) if leg.to_sigma else leg.last
        coming = self.departure(leg) @ before if leg.from_sigma else before
        found = self.propagate(range(leg.first, near), self.slip_slopes, coming)
        if leg.from_sigma and len(found.fine):
            for matrices in (found.fine, found.coarse):
                matrices[0] = self.departure_matrix(leg, matrices[0])
        if not leg.to_sigma:
            return found, ""
        if following is None:
            return found, say("variation ends at Sigma", t=float(self.motion.times[near]))
        onward, still = (
            self.initial_rate(following),
            np.broadcast_to(np.eye(self.size), (leg.last - near, *before.shape)),
        )
        fine, coarse = np.concatenate([found.fine, still]), np.concatenate([found.coarse, still])
        fine[-1] = self.arrival(near, onward)
        earlier = near - 1 if near > leg.first and self.motion.states[near - 1, :2].any() else near
        coarse[earlier - leg.first : -1] = np.eye(self.size)
        coarse[-1] = self.arrival(earlier, onward)
        return Propagators(fine, coarse), ""

    def arrival_step(self, leg: _Leg) -> int:
        """Step of a leg to Sigma at whose beginning its arrival, straight on from there, is known best."""
        e, _ = outside(self.motion.states[leg.first : leg.last, :2])
        rho = np.hypot(*self.motion.states[leg.first : leg.last, :2].T)
        turns = np.append(np.abs(np.diff(e, axis=0)).max(axis=1), 0.0)
        turns[-1] = turns[-2] if len(turns) > 1 else 0.0
        apart = np.maximum(turns, rho / max(float(rho.max()), TINY))
        apart[: np.argmax(rho)] = np.inf
        return leg.first + int(np.argmin(apart))

    @property
    def none(self) -> Propagators:
        """No steps."""
        return Propagators(*np.zeros((2, 0, self.size, self.size)))

    def propagate(self, steps: range, jacobian: Callable[[StepIndices, Array], Array], before: Array) -> Propagators:
        """Solve along steps; x and y are measured by rho."""
        ends = slice(steps.start, steps.stop + 1)
        sizes = np.ones((len(steps) + 1, self.size))
        rho = np.hypot(*self.motion.states[ends, :2].T)
        sizes[:, :2] = rho[:, None] if rho.any() else 1.0
        lengths = self.motion.lengths[steps.start : steps.stop]
        return propagators(lambda i, u: jacobian(i + steps.start, u), lengths, sizes, RTOL, before)

    def slip_slopes(self, steps: StepIndices, u: Array) -> Array:
        """Jacobian of the slip at fractions of steps."""
        states = states_along(self.motion, steps, u)
        found = pad_jacobians(self.slopes.of_state(*outside(states[:, :2], self.n), states), u.shape)
        return found if self.n is None else self.line_projector @ found @ self.line_projector

    def slide_slopes(self, phase: Phase, steps: StepIndices, u: Array) -> Array:
        """Jacobian of the slow flow at fractions of steps."""
        times = self.motion.times[steps, None] + u * self.motion.lengths[steps, None]
        e = phase.e(np.clip(times.ravel(), phase.t_start, phase.t_end))
        D = self.slopes.at(e, states_along(self.motion, steps, u))
        slopes = np.zeros((len(e), 2 + self.slopes.m, self.size))
        slopes[:, 2:, 2:] = D[:, 2:, 4:] + D[:, 2:, :2] @ self.set_slopes(D)
        found = pad_jacobians(slopes, u.shape)
        return found if self.n is None else self.line_projector @ found @ self.line_projector

    def set_slopes(self, D: Array) -> Array:
        """D_z e (k, 2, m + q) of the critical set: ``D_e U de + D_z U dz = 0``."""
        De, Dz = D[:, :2, :2], D[:, :2, 4:]
        if self.n is None:
            return np.asarray(-np.linalg.solve(De, Dz), np.float64)
        return -self.n[:, None] * ((self.n @ Dz) / (self.n @ De @ self.n)[:, None])[:, None]

    @cached_property
    def line_projector(self) -> Array:
        """Projector on the changes that are not left out: those that stay in the line."""
        found = np.eye(self.size)
        if self.n is not None:
            found[:2, :2] = np.outer(self.n, self.n)
            leaves = np.append([False, False], self.leaves_line(self.n))
            found[leaves] = 0.0
        return found

    def leaves_line(self, n: Array) -> NDArray[np.bool_]:
        """Return which of z and the names (m + q,), if changed, turn U out of the line along n, or move the line."""
        states = self.motion.states
        D = self.slopes.at(outside(states[:, :2], n)[0], states)
        across = np.abs(D[:, :2].swapaxes(1, 2) @ [-n[1], n[0]]).max(axis=0, initial=0.0)
        sizes = np.abs(D).max(axis=0, initial=0.0)
        small = LEAVES * sizes.max(initial=0.0)
        found, moves = across[4:] > small, sizes[2:, 4:] > small
        for _ in moves:
            found |= moves[found[: len(moves)]].any(axis=0)
        return found

    @property
    def line_basis(self) -> Array | None:
        """Basis of the changes of the state that stay in the line; None without one."""
        if self.n is None:
            return None
        state = self.motion.states.shape[1]
        stays = [axis for axis in np.eye(state)[2:] if (self.line_projector[:state, :state] @ axis).any()]
        return np.stack([np.append(self.n, np.zeros(state - 2)), *stays], axis=1)

    def rests(self, phase: Phase) -> bool:
        """Whether it slides on a critical set, and not on a limit cycle around none."""
        e = phase.e([0.5 * (phase.t_start + phase.t_end)])
        state = self.motion(0.5 * (phase.t_start + phase.t_end))[None]
        U, D = self.slopes.rates(e, state)[0, :2], self.slopes.at(e, state)[0, :2, :2]
        if self.n is not None:
            U = self.n * (self.n @ U)
        return bool(np.abs(U).max() <= AT_REST * np.abs(D).max())

    def shrinks(self, system: AnySystem, psi: Psi | None, leg: _Leg, following: _Leg, n: Array) -> bool:
        """Whether of what turns away from the line along n as a slip arrives nothing is left, see `passage`."""
        if leg.slides or (leg.from_sigma and self.repels(replace(leg, to_sigma=False), n)):
            return False
        z = tuple(self.motion.states[leg.last, 2:].tolist())
        arriving, leaving = (
            math.atan2(*outside(self.motion.states[i : i + 1, :2])[0][0, ::-1].tolist())
            for i in (self.arrival_step(leg), following.first + 1)
        )
        return shrinks_across(system, psi, z, arriving, None if following.slides else leaving)

    def repels(self, leg: _Leg, n: Array) -> bool:
        """Whether what lies next to the line along n turns away from it: in a slide, or as it arrives or leaves."""
        across = np.array([-n[1], n[0]])
        if leg.slides:
            e, state = leg.slides[0].e([leg.slides[0].t_start]), self.motion.states[leg.first]
            return bool(across @ self.slopes.at(e, state[None])[0, :2, :2] @ across >= 0.0)
        near = [leg.first + 1] * leg.from_sigma + ([self.arrival_step(leg)] if leg.to_sigma else [])
        states = self.motion.states[near]
        e, _ = outside(states[:, :2])
        U, D = self.slopes.rates(e, states)[:, :2], self.slopes.at(e, states)[:, :2, :2]
        lambda_theta = across @ D @ across - (e * U).sum(axis=1)
        return bool((lambda_theta > NEUTRAL_RATE * np.abs(U).max(axis=1, initial=0.0)).any())

    def initial_rate(self, leg: _Leg) -> Array:
        """Rate of the state as a leg begins on Sigma."""
        if leg.slides:
            return self.sliding_rate(leg.slides[0], leg.slides[0].t_start)
        return self.motion.polynomials[leg.first, :, 0] / self.motion.lengths[leg.first]

    def sliding_rate(self, phase: Phase, t: float) -> Array:
        """Rate of the state in a slide."""
        found = self.slopes.rates(phase.e([t]), self.motion(t)[None])[0]
        found[:2] = 0.0
        return found

    def slipping_rate(self, state: Array) -> Array:
        """Rate of the state in a slip."""
        found = self.slopes.rates(outside(state[None, :2], self.n)[0], state[None])[0]
        if self.n is not None:
            found[:2] = self.n * (self.n @ found[:2])
        return found

    def arrival(self, step: int, onward: Array) -> Array:
        """Saltation matrix of an arrival, straight on from a step's beginning, where the motion goes on at a rate.

        What is across the way, at one distance from Sigma, falls as ``y ~ tau^a`` with the time to go, rho = v tau and
        ``a = -(t.D t)/v`` for D = D_e U and t across. The rates change by ``D_e (U, W) t y/rho`` meanwhile: in all, by
        ``-D_e (U, W) t/(t.D t)`` times y.
        """
        state = self.motion.states[step]
        n, e, rate = len(state), outside(state[None, :2], self.n)[0][0], self.slipping_rate(state)
        sooner, rest = np.zeros(self.size), np.eye(self.size)
        sooner[:2] = -e / (e @ rate[:2])
        across = np.array([-e[1], e[0]])
        D = self.slopes.at(e[None], state[None])[0, :, :2]
        falls = float(across @ D[:2] @ across)
        if self.n is None and falls < 0.0:
            rest[:n, :2] -= np.outer(D @ across / falls, across)
        to_section = np.eye(self.size)
        to_section[:n] += np.outer(rate, sooner)
        whole = rest @ to_section
        found, later = to_section @ whole, sooner + sooner @ whole
        found[:2] = 0.0
        found[:n] -= np.outer(onward, later)
        return found

    def departure(self, leg: _Leg) -> Array:
        """Matrix from a change of the state where it leaves Sigma to that of z where and when it leaves."""
        start = np.eye(self.size)
        start[:2, :2] = 0.0
        start[2 : 2 + self.slopes.m] += np.outer(self.initial_rate(leg)[2:], self.later(leg))
        return start

    def later(self, leg: _Leg) -> Array:
        """Return the change of the time of leaving by a change of the state; where a slide ended, (x, y) has none."""
        found, onward = np.zeros(self.size), self.initial_rate(leg)[:2]
        if not leg.left:
            found[:2] = -onward / (onward @ onward) if onward.any() else math.nan
        return found

    def departure_matrix(self, leg: _Leg, first: Array) -> Array:
        """Make the matrix of the first step away from Sigma: who leaves later is where it was before."""
        found = first @ self.departure(leg)
        rate = self.slipping_rate(self.motion.states[leg.first + 1])
        found[: len(rate)] -= np.outer(rate, self.later(leg))
        return found

    def rate(self, legs: Sequence[_Leg], end: int) -> Array:
        """Rate of the state at the end of the last known step."""
        state = self.motion.states[end]
        if state[:2].any():
            return self.slipping_rate(state)
        t = float(self.motion.times[end])
        slides = [one for leg in legs if leg.first < end <= leg.last for one in leg.slides if one.t_start <= t]
        return self.sliding_rate(slides[-1], t) if slides else np.full(len(state), np.nan)


def _at_equator(phase: Phase) -> bool:
    """Whether the critical set has come to the equator, or to static friction's reach, at the end of a slide."""
    return bool(1.0 - np.hypot(*phase.e(phase.t_end)) < EQUATOR_DISTANCE)


def _is_let_go(phase: Phase) -> bool:
    """Whether a slide ends at the reach of static friction."""
    return bool(np.hypot(*phase.e(phase.t_end)) > 1.0 + EQUATOR_DISTANCE)
