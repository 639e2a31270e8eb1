"""Phases of a regularised motion: what of it is slip, slide or cross, read off its steps."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..numerics.radau import Step
from ..psi.function import Psi
from .field import Field
from .problem import direction
from .result import Phase

Array = NDArray[np.float64]

NEAR = 20.0  # |(x, y)| in units of eps within which a state is at Sigma
SLOW, REACH = 0.02, 1e4  # a state up to REACH eps away slides too, while |U| is below SLOW of U's size there
BRIEF = 20.0  # times NEAR eps/|U|: a stay at Sigma that is no longer is a crossing
HALVINGS = 40


def phases_of(
    field: Field, psi: Psi, eps: float, t_start: float, first: Array, taken: Sequence[Step]
) -> tuple[Phase, ...]:
    """Cut a motion into phases.

    Parameters
    ----------
    field : Field
    psi : Psi
    eps : float
    t_start : float
    first : ndarray (2 + m,)
    taken : sequence of Step
        The motion.

    Returns
    -------
    tuple of Phase
        Consecutive; "slide" where the state is within NEAR eps of Sigma, or slower than it could slip and within
        REACH eps of it; "cross" where that lasts only as long as passing through takes.
    """

    def near(state: Array) -> bool:
        return at_sigma(field, psi, eps, state)

    cuts: list[tuple[float, bool, Array]] = [(t_start, near(first), first)]
    for step in taken:
        inside = near(step.last)
        if inside != cuts[-1][1]:
            low, high = 0.0, 1.0
            for _ in range(HALVINGS):
                middle = 0.5 * (low + high)
                low, high = (low, middle) if near(step.at(middle)) == inside else (middle, high)
            cuts.append((step.start + high * step.h, inside, step.at(high)))
    t_end = max(taken[-1].end, t_start) if taken else t_start
    found: list[Phase] = []
    for i, (start, inside, state) in enumerate(cuts):
        end = cuts[i + 1][0] if i + 1 < len(cuts) else t_end
        last = i + 1 == len(cuts)
        kind = "slip"
        if inside:
            passing = BRIEF * NEAR * eps / max(_speed(field, psi, eps, state)[1], 1e-300)
            kind = "cross" if not last and i > 0 and end - start <= passing else "slide"
        found.append(Phase(kind, start, max(end, start), _reason(kind, i == 0, eps)))
    return tuple(found)


def at_sigma(field: Field, psi: Psi, eps: float, state: Array) -> bool:
    """Whether a state counts as sliding (or crossing): see `phases_of`."""
    r = math.hypot(state[0], state[1])
    if r <= NEAR * eps:
        return True
    if r > REACH * eps or eps > 1.0 / REACH:
        return False
    speed, size = _speed(field, psi, eps, state)
    return speed < SLOW * size


def _speed(field: Field, psi: Psi, eps: float, state: Array) -> tuple[float, float]:
    """Return |U| at the state, and its size: the largest |U| over e = 0 and four directions."""
    x, y, *z = state.tolist()
    here = field.value(*direction(psi, eps, x, y)[:2], x, y, *z)
    around = ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))
    sizes = [math.hypot(*field.value(c, s, x, y, *z)[:2]) for c, s in around]
    return math.hypot(*here[:2]), max((size for size in sizes if size == size), default=0.0)


def _reason(kind: str, initial: bool, eps: float) -> str:
    if initial:
        where = "outside Σ" if kind == "slip" else "at Σ"
        return f"The motion starts {where}."
    if kind == "slide":
        return f"Comes to within {NEAR:g} ε of Σ (ε = {eps:.3g}) and stays: sliding."
    if kind == "cross":
        return f"Passes Σ within {NEAR:g} ε (ε = {eps:.3g}): crossing."
    return f"Leaves Σ: further than {NEAR:g} ε away (ε = {eps:.3g})."
