"""Motions in the limit eps -> 0 followed compiled, as far as safe signs decide what comes next: `kernels.course`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import Array
from ..numerics.dense import Dense
from ..psi.constructors import constant
from ..psi.function import Psi
from .field import Field
from .functions import functions_of
from .kernels.explicit import DENSE_DEGREE
from .kernels.hybrid_run import PHASE_NUMBERS, TOLD, follow_courses
from .kernels.slow import flow
from .line import InvariantLine
from .motion_steps import line_directions, numbers_of_tableau, shared_out


@dataclass(frozen=True)
class Segment:
    """A phase that has been followed.

    Attributes
    ----------
    kind : int
        SLIP, SLIDE or LEAVE of `kernels.course`: LEAVE is a slip away from Sigma.
    first, last : int
        Steps of the motion that it begins with and ends before.
    theta : float
        Angle of the arrival that a slide begins with, or at which it leaves.
    """

    kind: int
    first: int
    last: int
    theta: float


@dataclass(frozen=True, eq=False)
class DecidedMotion:
    """A motion as far as it is decided.

    Attributes
    ----------
    motion : Dense
    sets : ndarray (k, 2)
        e at its times, where it slides.
    legs : tuple of Segment
    onward : int
        What comes next where it is handed over, as `Leg.kind`; WHOLE of `kernels.course` where nothing does.
    theta : float
        Of that.
    evaluations : int
    """

    motion: Dense
    sets: Array
    legs: tuple[Segment, ...]
    onward: int
    theta: float
    evaluations: int


def run_hybrid(
    field: Field,
    psi: Psi | None,
    lines: Sequence[InvariantLine | None],
    first: Array,
    span: tuple[float, float],
    rtol: float,
    floor: float,
    most: int,
) -> list[DecidedMotion]:
    """Follow one motion from each state outside Sigma; of many, on all cores.

    Parameters
    ----------
    field : Field
    psi : Psi or None
        None: only what every Psi gives is decided.
    lines : sequence of k InvariantLine or None
    first : ndarray (k, n)
    span : (t_start, t_end)
    rtol, floor, most
        As in `MotionSteps`.
    """
    own = constant() if psi is None else psi
    outside, inside = functions_of(field, constant(), many=True), functions_of(field, own, many=True)
    addresses = np.array([*outside.addresses, *(one.address for one in flow()), inside.addresses[2]], np.int64)
    numbers = np.array([rtol, floor, *span, own.parameter, field.is_affine, psi is not None], float)
    along = line_directions(lines)

    def part(cut: slice) -> list[DecidedMotion]:
        found = follow_courses(addresses, numbers, numbers_of_tableau(), along[cut], first[cut], float(most))
        times, lengths, states, polynomials, sets, phases, told = found
        return _split_motions(times, lengths, states, polynomials, sets, phases, told, first.shape[1])

    return shared_out(part, len(first))


def _split_motions(
    times: Array, lengths: Array, states: Array, polynomials: Array, sets: Array, phases: Array, told: Array, n: int
) -> list[DecidedMotion]:
    """Cut what `follow_courses` returns into motions, without copying."""
    states, polynomials = states.reshape(-1, n), polynomials.reshape(-1, n, DENSE_DEGREE)
    sets = sets.reshape(-1, 2)
    for array in (times, lengths, states, polynomials, sets):
        array.flags.writeable = False
    legs = [
        Segment(int(kind), int(a), int(b), theta) for _, kind, a, b, theta in phases.reshape(-1, PHASE_NUMBERS).tolist()
    ]
    found, row, leg = [], 0, 0
    for steps, count, onward, theta, evaluations in told.reshape(-1, TOLD).tolist():
        last, next_leg = row + int(steps), leg + int(count)
        motion = Dense(times[row : last + 1], states[row : last + 1], lengths[row:last], polynomials[row:last])
        own = tuple(legs[leg:next_leg])
        found.append(DecidedMotion(motion, sets[row : last + 1], own, int(onward), theta, int(evaluations)))
        row, leg = last + 1, next_leg
    return found
