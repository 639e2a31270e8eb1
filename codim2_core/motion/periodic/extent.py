"""Half of what lies between the extremes of a motion, to the digits of its polynomials."""

from __future__ import annotations

import numpy as np

from ...results.arrays import Array
from ..result import Simulation

SAMPLES = 8  # places within a step, between which extremes are looked for
NEWTON_ROUNDS = 3  # of the place of an extreme within a step: its error is the square each time


def swing(run: Simulation) -> Array:
    """Return half of the difference of the extremes of x, y, z1, ..., zm over a motion, (2 + m,).

    The extreme among samples is refined by Newton's method for the derivative of the step's polynomial.
    """
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
