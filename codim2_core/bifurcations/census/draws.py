"""Distributions from which a census draws its systems. A new one is a function here, and a line in `DRAWS`."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from ...systems.kinds import AnySystem
from ...systems.typed import System

#: Draws systems: (random generator, how many) to coefficients (n, 5), or to a sequence of systems.
Draw = Callable[[np.random.Generator, int], "NDArray[np.float64] | Sequence[AnySystem]"]

_MONOMIALS = ("1", "c", "s", "c^2", "c*s", "s^2")
_COEFFICIENT_NAMES = tuple(f"{row}{i}" for row in "uv" for i in range(len(_MONOMIALS)))
_U = tuple(" + ".join(f"{row}{i}*{term}" for i, term in enumerate(_MONOMIALS)) for row in "uv")


def normal(rng: np.random.Generator, count: int) -> NDArray[np.float64]:
    """Draw a, b, d, f1, f2 independently from the standard normal distribution; (count, 5)."""
    return rng.standard_normal((count, 5))


def quadratic(rng: np.random.Generator, count: int) -> list[AnySystem]:
    """Draw systems quadratic in e, whose twelve coefficients (of 1, c, s, c^2, c s, s^2) are standard normal."""
    empty = System(U=_U, parameters=dict.fromkeys(_COEFFICIENT_NAMES, 0.0))
    drawn = rng.standard_normal((count, len(_COEFFICIENT_NAMES)))
    return [empty.evolve(parameters=dict(zip(_COEFFICIENT_NAMES, row, strict=True))) for row in drawn.tolist()]


DRAWS: dict[str, Draw] = {"normal": normal, "quadratic": quadratic}
