"""Psi = exp(-s), inverted by Lambert's function."""

from __future__ import annotations

import math
from dataclasses import dataclass
from math import expm1
from typing import Any

import numpy as np

from .record import UNDERFLOW_BOUND, Array, Family, Kernel


@dataclass(frozen=True)
class Exponential(Kernel):
    """Psi = exp(-s): s = W(w^2), Lambert's function."""

    def value(self, lib: Any, s: Any) -> Any:
        return lib.exp(-s)

    def slope(self, lib: Any, s: Any) -> Any:
        return -lib.exp(-s)

    def root(self, lib: Any, zeta: Any) -> Any:
        z = lib.minimum(zeta, 1e3)  # exp(-z^2/2) is 0 from 39 on
        return lib.exp(-0.5 * z * z)

    def kappa(self, lib: Any, zeta: Any) -> Any:
        z = lib.minimum(zeta, 1e150)
        return z * z

    def inverse(self, lib: Any, w: Any) -> Any:
        log_w = lib.log(lib.maximum(w, 1e-140))  # for smaller w only `w` itself is used, below
        log_q = 2.0 * log_w
        # ln(1 + q), without forming q = w^2 where it would overflow
        L = lib.where(log_q > 600.0, log_q, lib.log1p(lib.exp(lib.minimum(log_q, 600.0))))
        s = lib.maximum(L * (1.0 - lib.log1p(L) / (2.0 + L)), UNDERFLOW_BOUND)  # Winitzki's guess, within 2 %
        for _ in range(2):  # Newton on s + ln s = ln q
            s = s / (1.0 + s) * (1.0 + log_q - lib.log(s))
        # small s: the rounding of ln q is as large as s, and zeta = w exp(-s/2) needs s only roughly
        zeta = lib.where(s > 0.05, lib.sqrt(lib.maximum(s, 0.0)), w * (1.0 - 0.5 * lib.minimum(s, 0.1)))
        return self.polish(lib, self.polish(lib, zeta, w), w)


def derivatives(s: Array, _: float) -> tuple[Array, Array, Array]:
    """First three derivatives of Psi."""
    u = np.exp(-s)
    return -u, u, -u


def gain(r2, w, _):
    """``e_Psi = gain p`` at ``|p|^2 = r2``."""
    w2 = w * w
    s = min(r2 / max(w2, UNDERFLOW_BOUND), 700.0)
    return 1.0 / math.sqrt(max(r2 + w2 * (1.0 + expm1(-s)), UNDERFLOW_BOUND))


FAMILY = Family(
    name="exponential", title="exp(−s)", formula="exp(-s)", kernel=Exponential, gain=gain, derivatives=derivatives,
    compared=(0.0,),
)  # fmt: skip
