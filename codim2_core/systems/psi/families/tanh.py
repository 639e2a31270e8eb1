"""Psi = s/sinh^2 sqrt(s), that is |e_Psi| = tanh(zeta), Figure 5."""

from __future__ import annotations

import math
from dataclasses import dataclass
from math import expm1
from typing import Any

import numpy as np

from .record import UNDERFLOW_BOUND, Array, Family, Kernel

_CONTOUR = np.exp(2j * np.pi * np.arange(32) / 32)


@dataclass(frozen=True)
class Tanh(Kernel):
    """Psi = s/sinh(sqrt s)^2: |e_Psi| = tanh(zeta)."""

    def value(self, lib: Any, s: Any) -> Any:
        u = self.root(lib, lib.sqrt(s))
        return u * u

    def slope(self, lib: Any, s: Any) -> Any:
        s = lib.minimum(s, 1e9)  # exp(-2 sqrt s) is 0 long before
        return -self.value(lib, s) * self._kappa_over_s(lib, s)

    def root(self, lib: Any, zeta: Any) -> Any:
        # zeta/sinh(zeta) by expm1, which neither cancels at 0 nor overflows
        z = lib.maximum(lib.minimum(zeta, 1e4), UNDERFLOW_BOUND)
        return 2.0 * z * lib.exp(-z) / -lib.expm1(-2.0 * z)

    def kappa(self, lib: Any, zeta: Any) -> Any:
        z = lib.minimum(zeta, 1e150)
        return z * z * self._kappa_over_s(lib, z * z)

    @staticmethod
    def _kappa_over_s(lib: Any, s: Any) -> Any:
        """(zeta coth zeta - 1)/zeta^2: Lambert's continued fraction (no cancellation) for s < 4."""
        t = lib.minimum(s, 4.0)
        fraction = 23.0
        for odd in (21.0, 19.0, 17.0, 15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0):
            fraction = odd + t / fraction
        zeta = lib.sqrt(lib.maximum(s, 4.0))
        coth_part = (zeta * (1.0 + 2.0 / lib.expm1(lib.minimum(2.0 * zeta, 700.0))) - 1.0) / lib.maximum(s, 4.0)
        return lib.where(s < 4.0, 1.0 / fraction, coth_part)

    def inverse(self, lib: Any, w: Any) -> Any:
        return lib.asinh(w)


def derivatives(s: Array, _: float) -> tuple[Array, Array, Array]:
    """First three derivatives of Psi, analytic for s > -pi^2: Cauchy's integral on a unit circle."""
    w = s[:, None] + _CONTOUR
    root = np.sqrt(w)
    decay = np.exp(-2.0 * root)
    values = 4.0 * w * decay / (1.0 - decay) ** 2
    first, second, third = (math.factorial(j) * (values * _CONTOUR**-j).mean(axis=1).real for j in (1, 2, 3))
    return first, second, third


def gain(r2, w, _):
    """``e_Psi = gain p`` at ``|p|^2 = r2``: e = tanh(zeta) p/|p|, with zeta = |p|/w."""
    r = max(math.sqrt(r2), 1e-150)
    m = expm1(-2.0 * min(r / max(abs(w), UNDERFLOW_BOUND), 350.0))
    return -m / ((2.0 + m) * r)


FAMILY = Family(
    name="tanh", title="s/sinh²√s", formula="s/sinh(sqrt(s))**2", kernel=Tanh, gain=gain, derivatives=derivatives,
    compared=(0.0,),
)  # fmt: skip
