"""One step of Radau IIA of order 9 for a mechanism with several contacts: Newton's method with exact slopes of e.

No stage is at the start of a step, so that a step may begin where a contact is at its set and about to slip: there
e = x/|x| is no function of the state, but its limit along the motion is known.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...arrays import Array
from ...numerics.radau import Step, tableau
from .decision import Flags
from .field import ContactField, Law, Local

MAX_NEWTON_ROUNDS = 12
STAGE_TOLERANCE = 0.01  # last correction of the stages, in units of the error allowed in a step


class Collocated(NamedTuple):
    """A step, its error in units of what is allowed, and what holds at its stages."""

    step: Step
    error: float
    stages: tuple[Local, ...]


def collocate(
    field: ContactField,
    law: Law,
    t: float,
    Y: Array,
    h: float,
    rate: Array,
    e: Array,
    sticks: Flags,
    guess: Array,
    scale: Array,
) -> Collocated | None:
    """Return one step from Y, with Y' and e (c, 2) there; None if Newton's method fails.

    Parameters
    ----------
    guess : (5, N)
        Stages less Y.
    scale : (N,)
        Error allowed.
    """
    table, n = tableau(), len(Y)
    inverse = np.linalg.inv(table.A) / h
    smooth, slip = field.smooth_slopes(Y, e, sticks)
    Z, size = guess, np.inf
    for _ in range(MAX_NEWTON_ROUNDS):
        places = field.at_all(Y + Z)
        F = np.array([field.rate(one, law.e(one.x), sticks) for one in places])
        slopes = [smooth + field.friction_slope(one, law.slope(one.x), sticks, slip) for one in places]
        matrix = np.kron(inverse, np.eye(n))
        for i, slope in enumerate(slopes):
            matrix[i * n : (i + 1) * n, i * n : (i + 1) * n] -= slope
        if not (np.isfinite(matrix).all() and np.isfinite(F).all()):
            return None
        change = np.linalg.solve(matrix, (F - inverse @ Z).ravel()).reshape(Z.shape)
        Z = Z + change
        before, size = size, float(np.sqrt(((change / scale) ** 2).mean(axis=1).max()))
        if size < STAGE_TOLERANCE or (size < 1.0 and size**2 < STAGE_TOLERANCE * before):
            break
    else:
        return None
    raw = table.gamma * h * rate + table.error @ Z
    # a contact that begins to slip within the step is stiff at its start alone, where the filter would hide the error
    errors = (np.linalg.solve(np.eye(n) - table.gamma * h * slope, raw) for slope in (slopes[0], slopes[-1]))
    error = max(float(np.sqrt(((one / scale) ** 2).mean())) for one in errors)
    step = Step(t, h, Y, Y + Z[-1], (table.fit @ Z).T)
    return Collocated(step, error, tuple(field.at_all(Y + Z)))
