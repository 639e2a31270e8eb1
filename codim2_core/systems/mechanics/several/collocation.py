"""One step of Radau IIA of order 9 for a mechanism with several contacts: Newton's method with exact slopes of e.

Where a slip is small, e is stiff: forces decide e, and e the slip. So e is an unknown of its own, ``|x| e = x``
(Andersen and others 2000, see `decision`): its slope is ``(1 - e n^T)/|x|``, n = x/|x|, with e as it was found last.

No stage is at the start of a step, so that a step may begin where a contact is at its set and about to slip: there
e = x/|x| is no function of the state, but its limit along the motion is known.

Inspect a step of a mechanism with several contacts: it passes no switch, and no formula varies between its stages.

A step sees M, Q, J, mu N and the rates of positions at its stages alone. Bounds of each along the dense output
(`numerics.along`) are compared with the polynomial through what the stages see: a push between two of them is found.
"""

from __future__ import annotations

from functools import cached_property
from typing import NamedTuple

import numpy as np

from ....formulas.arrays import path_program
from ....numerics.radau import Step, tableau
from ....results.arrays import Array
from .decision import Flags
from .field import ContactField, Law, Local, held_rank, within_disc

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


CHANGE_TOLERANCE, PER_RTOL = 1e-5, 30.0  # of a state: what a defect may change it by; of rtol, where that is larger
FORCE_TOLERANCE = 1e-4  # of the friction: the defect of a force while a contact sticks
RETRY_SHARE = 0.25  # of a part of a step that its stages do not explain: the next step


class Switch(NamedTuple):
    """The fraction of a step at which a guard vanishes, and its number."""

    u: float
    guard: int


class Inspection:
    """The inspection of the steps on one branch of the formulas."""

    def __init__(self, field: ContactField, rtol: float, atol: float) -> None:
        self.field, self.was_undecided, self.atol = field, False, atol
        self.tolerance = max(CHANGE_TOLERANCE, PER_RTOL * rtol)
        nodes = np.array([0.0, *tableau().nodes])
        powers = np.arange(1, len(nodes) + 1)
        self._to_integral = np.linalg.inv(nodes[:, None] ** (powers - 1)) / powers[:, None]

    @cached_property
    def _guards(self) -> tuple | None:
        guards = self.field.branch.guards
        return path_program(guards).arrays if guards else None

    def retry(self, step: Step, stages: Array, here: Local, sticks: Flags, speed: float) -> float | None:
        """Return the step to try instead, where formulas vary along this one as its stages do not see; else None."""
        from ....numerics.along import first_defect  # on first use: it loads the compiler

        moving = self.field.moving
        if not moving.any():
            return None
        seen = self.field.values(np.vstack([step.first, stages]))
        own = 2 + len(step.first) + np.arange(int(moving.sum()))
        path = self._path(step, len(seen) + 1, len(own))
        path[own, 1:] = step.h * (self._to_integral @ seen[:, moving]).T
        allowed = self._allowed(step, np.abs(seen).max(axis=0), here, sticks, speed)[:, None, moving]
        defect = np.zeros(4)
        found = first_defect(*self.field.moving_program.arrays, own, path[None], np.array([step.h]), *allowed, defect)
        self.was_undecided = bool(found and defect[3])
        return None if found else step.h * float(defect[0] if defect[0] > 0.0 else RETRY_SHARE * defect[1])

    def switch(self, step: Step) -> Switch | None:
        """Return the first switch that a step passes."""
        if self._guards is None:
            return None
        from ....numerics.along import zeros_along

        path, found, first = self._path(step, step.polynomial.shape[1] + 1, 0), np.empty((1, 2)), None
        for guard in range(len(self.field.branch.guards)):
            if zeros_along(*self._guards, path, guard, True, found) and (first is None or found[0, 0] < first.u):
                first = Switch(float(found[0, 0]), guard)
        return first

    def _path(self, step: Step, degree: int, more: int) -> Array:
        """Return polynomials of c and s, which no formula reads, of the state, and room for more."""
        n, d = step.polynomial.shape
        path = np.zeros((2 + n + more, max(degree, d + 1)))
        path[2 : 2 + n, 0], path[2 : 2 + n, 1 : d + 1] = step.first, step.polynomial
        return path

    def _allowed(self, step: Step, sizes: Array, here: Local, sticks: Flags, speed: float) -> Array:
        """Return the defects that are allowed of each row, as rates and as changes, and where both bounds count."""
        n, tolerance = self.field.n, self.tolerance
        speed = max(speed, float(np.abs(step.last[:n]).max()))
        arms, mass = float(np.abs(here.J).max()), float(np.abs(here.M).max())
        friction = FORCE_TOLERANCE * float(here.r.max()) if sticks.any() else 0.0
        partly = float(0 < held_rank(here, sticks) < n)
        q = np.abs([step.first[n:], step.last[n:]]).max(axis=0)
        M, Q, J, surface, r, moves, k = (place for place, _ in self.field.places)
        allowed = np.zeros((3, len(self.field.rows)))
        allowed[0, M], allowed[0, J], allowed[0, surface] = tolerance * mass, tolerance * arms, tolerance * speed
        allowed[:, Q] = [[friction * arms], [tolerance * mass * speed], [partly]]
        allowed[:, r] = [[friction], [tolerance * mass * speed / arms], [partly]]
        allowed[0, moves] = tolerance * np.maximum(sizes[moves], 1e-6 * speed)
        allowed[1, moves], allowed[1, k] = np.maximum(tolerance * q, self.atol), tolerance * speed * arms
        return allowed
