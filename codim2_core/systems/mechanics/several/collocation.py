"""One step of Radau IIA of order 9 for a mechanism with several contacts: Newton's method with exact slopes of e.

Where a slip is small, e is stiff: forces decide e, and e the slip. So e is an unknown of its own, ``|x| e = x``
(Andersen and others 2000, see `decision`): its slope is ``(1 - e n^T)/|x|``, n = x/|x|, with e as it was found last.

No stage is at the start of a step, so that a step may begin where a contact is at its set and about to slip: there
e = x/|x| is no function of the state, but its limit along the motion is known.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ....numerics.radau import Step, tableau
from ....results.arrays import Array
from .decision import Flags
from .field import ContactField, Law, Local, within_disc

MAX_NEWTON_ROUNDS = 12
SETTLED = 0.1  # e - x/|x| of a slip
STAGE_TOLERANCE = 0.01  # last correction of the stages, in units of the error allowed in a step


class Collocated(NamedTuple):
    """A step, its error in units of what is allowed, its stages, and what holds there."""

    step: Step
    error: float
    places: Array
    stages: list[Local]


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
    """Return one step from Y, with Y' and e (c, 2) there; None if Newton's method fails."""
    table, n = tableau(), len(Y)
    inverse = np.linalg.inv(table.A) / h
    smooth, slip = field.smooth_slopes(Y, e, sticks)
    Z, size, duals = guess, np.inf, [e] * len(guess)
    for _ in range(MAX_NEWTON_ROUNDS):
        places = field.at_all(Y + Z)
        own = [law.e(one.x) for one in places]
        gains = [law.slope(one.x, dual) for one, dual in zip(places, duals, strict=True)]
        F = np.array([field.rate(one, e, sticks) for one, e in zip(places, own, strict=True)])
        slopes = [
            smooth + field.friction_slope(one, gain, sticks, slip) for one, gain in zip(places, gains, strict=True)
        ]
        matrix = np.kron(inverse, np.eye(n))
        for i, slope in enumerate(slopes):
            matrix[i * n : (i + 1) * n, i * n : (i + 1) * n] -= slope
        if not (np.isfinite(matrix).all() and np.isfinite(F).all()):
            return None
        try:
            change = np.linalg.solve(matrix, (F - inverse @ Z).ravel()).reshape(Z.shape)
        except np.linalg.LinAlgError:  # a slip has become 0
            return None
        Z = Z + change
        moved = [np.einsum("cij,cjy,y->ci", gain, slip, one) for gain, one in zip(gains, change, strict=True)]
        duals = [within_disc(one + more) for one, more in zip(own, moved, strict=True)]
        before, size = size, float(np.sqrt(((change / scale) ** 2).mean(axis=1).max()))
        agree = np.abs(np.array(duals) - own)[:, ~sticks].max(initial=0.0) < SETTLED  # else a contact sticks there
        if agree and (size < STAGE_TOLERANCE or (size < 1.0 and size**2 < STAGE_TOLERANCE * before)):
            break
    else:
        return None
    raw = table.gamma * h * rate + table.error @ Z
    # a contact that begins to slip within the step is stiff at its start alone, where the filter would hide the error
    errors = (np.linalg.solve(np.eye(n) - table.gamma * h * slope, raw) for slope in (slopes[0], slopes[-1]))
    error = max(float(np.sqrt(((one / scale) ** 2).mean())) for one in errors)
    step = Step(t, h, Y, Y + Z[-1], (table.fit @ Z).T)
    return Collocated(step, error, Y + Z, field.at_all(Y + Z))
