"""Psi = 1: e_Psi is the projection of the hemisphere itself."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from .record import UNDERFLOW_BOUND, Array, Family, Kernel


@dataclass(frozen=True)
class Constant(Kernel):
    """Psi = 1: e_Psi is the projection of the hemisphere itself."""

    limit: float = 1.0

    def value(self, lib: Any, s: Any) -> Any:
        return 0.0 * lib.minimum(s, 0.0) + 1.0

    def slope(self, lib: Any, s: Any) -> Any:
        return 0.0 * lib.minimum(s, 0.0)

    def root(self, lib: Any, zeta: Any) -> Any:
        return 0.0 * zeta + 1.0

    def kappa(self, lib: Any, zeta: Any) -> Any:
        return 0.0 * zeta

    def inverse(self, lib: Any, w: Any) -> Any:
        return w


def derivatives(s: Array, _: float) -> tuple[Array, Array, Array]:
    """First three derivatives of Psi."""
    zero = np.zeros_like(s)
    return zero, zero, zero


def gain(r2, w, _):
    """``e_Psi = gain p`` at ``|p|^2 = r2``."""
    return 1.0 / math.sqrt(max(r2 + w * w, UNDERFLOW_BOUND))


FAMILY = Family(
    name="constant", title="1", formula="1", kernel=Constant, gain=gain, derivatives=derivatives,
    compared=(0.0,), identity=True,
)  # fmt: skip
