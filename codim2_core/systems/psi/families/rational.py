"""Psi = 1/(1+s)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from .record import UNDERFLOW_BOUND, Array, Family, Kernel


@dataclass(frozen=True)
class Rational(Kernel):
    """Psi = 1/(1+s)."""

    def value(self, lib: Any, s: Any) -> Any:
        return 1.0 / (1.0 + s)

    def slope(self, lib: Any, s: Any) -> Any:
        u = 1.0 / (1.0 + s)
        return -u * u

    def root(self, lib: Any, zeta: Any) -> Any:
        return 1.0 / lib.hypot(1.0, zeta)

    def kappa(self, lib: Any, zeta: Any) -> Any:
        u = zeta / lib.hypot(1.0, zeta)
        return u * u

    def inverse(self, lib: Any, w: Any) -> Any:
        # s (1 + s) = w^2
        return w * lib.sqrt(2.0 / (1.0 + lib.hypot(1.0, 2.0 * w)))


def derivatives(s: Array, _: float) -> tuple[Array, Array, Array]:
    """First three derivatives of Psi."""
    u = 1.0 / (1.0 + s)
    return -(u**2), 2.0 * u**3, -6.0 * u**4


def gain(r2, w, _):
    """``e_Psi = gain p`` at ``|p|^2 = r2``."""
    w2 = w * w
    return 1.0 / math.sqrt(max(r2 + w2 * w2 / max(r2 + w2, UNDERFLOW_BOUND), UNDERFLOW_BOUND))


FAMILY = Family(
    name="rational", title="1/(1 + s)", formula="1/(1+s)", kernel=Rational, gain=gain, derivatives=derivatives,
    compared=(0.0,),
)  # fmt: skip
