"""The way out of Sigma along a limit direction."""

from __future__ import annotations

import numpy as np

from ...numerics.radau import STAGES, Step
from ...results.arrays import Array
from ...results.words import say
from ...systems.psi.constructors import constant
from .field import Field
from .functions import functions_of
from .kernels import departure_step
from .kernels.slow import SET_PLACE, SLOPES, SLOW_EXTENT, VALUE
from .line import InvariantLine


def polynomial_of(*terms: Array) -> Array:
    """Return a step's polynomial from its terms, from the linear one on."""
    polynomial = np.zeros((len(terms[0]), STAGES))
    for k, term in enumerate(terms):
        polynomial[:, k] = term
    return polynomial


def leave(
    field: Field, theta: float, t: float, z: Array, t_end: float, line: InvariantLine | None = None
) -> Step | str:
    """Leave Sigma along a limit direction with lambda_rho > 0, or one whose lambda_rho just turns positive.

    The first, short step; or why there is none, as a sentence. Shapes: z (m,).
    """
    functions, m = functions_of(field, constant()), len(z)
    S, linear, square = np.zeros(SLOW_EXTENT), np.zeros(2 + m), np.zeros(2 + m)
    functions.enter(S)
    S[VALUE : SLOPES + 1], S[SET_PLACE + 4 : SET_PLACE + 4 + m] = functions.addresses[:2].view(float), z
    n1, n2 = (0.0, 0.0) if line is None else line.vector
    h = float(departure_step.leave(S, m, n1, n2, theta, t_end - t, linear, square))
    if not h > 0.0:
        key = "repels angularly" if h == departure_step.REPELS_ANGULARLY else "nothing leaves"
        return say(key, theta=theta)
    first = np.concatenate([np.zeros(2), z])
    return Step(t, h, first, first + linear + square, polynomial_of(linear, square))
